"""Energy of a plate in the polynomials that its basis leaves out, from those it keeps."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.plan.rectangle_body import RectangleBody
from hydroelastic.modal.plate.rectangle import bending_energies

# Of the energy in the last polynomials, the part that the others do not take over if those are left out; measured:
# 1/13 to 1/18.
_REARRANGED = 0.25
# The same where waves are just resolved, and the decay above which corners limit it.
_RESOLVED, _SLOW = 0.8, 0.5
# Slowest decay of the energy with two more polynomials along each side.
_SLOWEST = 0.6


def geometric_tail(last: NDArray[np.float64], before: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the remainder of a geometric series after its last term, of which none falls slower than some."""
    decay = np.minimum(last / np.maximum(before, np.finfo(float).tiny), _SLOWEST)
    tail: NDArray[np.float64] = last * decay / (1.0 - decay)
    return tail


def missing_after(last: NDArray[np.float64], before: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the energy that a basis lacks, from that in its last polynomials and in those before them.

    Where corners limit the decay, it is a part of the remainder of the series. Where the polynomials just resolve a
    wave the energy falls at once, and with a few fewer of them the others take over nothing: it is that of the last
    ones, measured on a plate as soft as D/(ρgl⁴) = 2e-7.
    """
    decay = last / np.maximum(before, np.finfo(float).tiny)
    at_once = _RESOLVED * last * np.clip((_SLOW - decay) / (0.5 * _SLOW), 0.0, 1.0)
    missing: NDArray[np.float64] = np.maximum(_REARRANGED * geometric_tail(last, before), at_once)
    return missing


def rectangle_energies(body: RectangleBody, amplitudes: NDArray[np.float64]) -> NDArray[np.float64]:
    """Estimate the potential energy, of bending and hydrostatic, that a rectangle's basis lacks.

    Of a soft plate the hydrostatic part is the larger one.

    Args:
        body: the plate.
        amplitudes: of its shapes in some modes, shape (modes, shapes).

    Returns:
        The energy of each mode, shape (modes,).
    """
    if not body.plate.is_elastic or not body.body.size:
        return np.zeros(len(amplitudes))
    table = np.einsum("ks,smn->kmn", amplitudes, body.coefficients)
    last, before = (_energies_beyond(body, table, dropped) for dropped in (2, 4))
    return missing_after(last, before - last)


def _energies_beyond(body: RectangleBody, table: NDArray[np.float64], dropped: int) -> NDArray[np.float64]:
    """Potential energy in the last polynomials along either side, shape (modes,)."""
    rest = table.copy()
    rest[:, : table.shape[1] - dropped, : table.shape[2] - dropped] = 0.0
    energies = bending_energies(body.outline.size, body.plate.poisson_ratio, rest)
    return energies * body.plate.flexural_rigidity + float(body.plate.hydrostatic) * (rest**2).sum(axis=(1, 2))
