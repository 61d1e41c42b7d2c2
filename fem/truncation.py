"""Frequency error from truncating the dry-mode basis of a body.

Leaving out a shape of stiffness k and amplitude a raises λ by the part k a²/λ of the mode's potential energy that it
holds. Those parts fall like n⁻⁸ with the number n of the shape (measured, n⁻⁷ for their sum), so the remainder follows
from the last shapes kept.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from hydroelastic.fem.surfaces import Body
from hydroelastic.physics.dofs import Dof

_ORDER = 7.0


def truncation_errors(bodies: tuple[Body, ...], amplitudes: np.ndarray, eigenvalues: np.ndarray) -> np.ndarray:
    """Estimate (λ_h − λ)/λ by the shapes that the bases leave out."""
    errors = np.zeros(len(eigenvalues))
    first = 0
    for body in bodies:
        last = first + body.size
        parts = body.stiffness * amplitudes[:, first:last] ** 2 / eigenvalues[:, None]
        errors += omitted(parts[:, elastic_places(body.dofs)])
        first = last
    return errors


@lru_cache(maxsize=16)
def elastic_places(dofs: tuple[Dof, ...]) -> np.ndarray:
    """Return the places of the elastic degrees of freedom."""
    places = np.flatnonzero([dof.is_elastic for dof in dofs])
    places.flags.writeable = False
    return places


def omitted(parts: np.ndarray) -> np.ndarray:
    """Estimate the sum beyond the last of some energy parts, shape (…, shapes)."""
    count = parts.shape[-1]
    if count == 0:
        return np.zeros(parts.shape[:-1])
    # An even number, for shapes of one parity may take no part; more of them where single ones may vanish by chance.
    recent = 2 * max(1, count // 12)
    # Measured: a quarter of the sum over the last quarter is never far above the tail, nor below it while n⁻⁸ has not
    # set in.
    tail: np.ndarray = np.maximum(
        parts[..., -recent:].mean(axis=-1) * count / _ORDER, 0.25 * parts[..., -max(1, count // 4) :].sum(axis=-1)
    )
    return 1.2 * tail
