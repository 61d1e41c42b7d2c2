"""Low-frequency series of H in infinitely deep liquids, used below the frequencies that the mesh resolves.

With κ = kb, b the length of the basin, and L = ln p on a line p = −iω of the complex plane,

    H = C + D L + κ (E + F L + G L²) + O(κ² L²),        C … G real,    D = −(2/π) lim b/ω,

the expansion for long waves: C and D are those of a source at the body, further terms those of higher multipoles. The
coefficients are fitted to H at a few frequencies; their error at twice the highest of these estimates the neglected
terms. Over a bed H of a section has no logarithm, and the mesh resolves all frequencies. The waves of a solid of
revolution spread in two directions: H has the logarithm over a bed, and in deep water D = 0.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import isinf, pi, sqrt

import numpy as np

from hydroelastic.fem.open_water.basin import open_basin
from hydroelastic.modal.tank_estimates import two_layers
from hydroelastic.physics.tank import Tank

SPREAD = 2.0
"""The coefficients are fitted from the lowest frequency of the mesh to this multiple of it."""

# κ at the lowest frequency of the mesh.
_LONG = 1e-4
# Number of frequencies of the fit.
_POINTS = 5
# Over a bed: lowest frequency of the mesh times the last time, below which H hardly affects the motion.
_LOWEST_OVER_A_BED = 0.02


@dataclass(frozen=True, kw_only=True)
class LowFrequencySeries:
    """The low-frequency series of H. Shapes: m body unknowns."""

    unit: float  # the frequency |ω| at which κ is scaled to 1 and Re L = 0
    coefficients: np.ndarray  # C, D, E, F, G, shape (5, m, m)
    misfit: float  # relative error of H by the rest of the series, an upper estimate

    def hydrodynamic(self, omegas: np.ndarray) -> np.ndarray:
        """Return H at ω of shape (n,): shape (n, m, m)."""
        values: np.ndarray = np.tensordot(_terms(omegas / self.unit), self.coefficients, axes=1)
        return values

    @property
    def damping_over_frequency(self) -> np.ndarray:
        """lim b/ω for ω → 0, shape (m, m)."""
        slow: np.ndarray = -0.5 * pi * self.coefficients[1]
        return slow


def low_frequency_series(hydrodynamics: Callable[[np.ndarray], np.ndarray], lowest: complex) -> LowFrequencySeries:
    """Fit the series to H at a few low ω."""
    omegas = lowest * np.append(np.linspace(1.0, SPREAD, _POINTS), 2.0 * SPREAD)
    values = hydrodynamics(omegas)
    unit = SPREAD * abs(lowest)
    terms, flat = _terms(omegas / unit), values.reshape(len(omegas), -1)
    known, wanted = (np.vstack([part[:-1].real, part[:-1].imag]) for part in (terms, flat))
    coefficients = np.linalg.lstsq(known, wanted, rcond=None)[0]
    return LowFrequencySeries(
        unit=unit,
        coefficients=coefficients.reshape(-1, *values.shape[1:]),
        misfit=float(np.abs(terms[-1] @ coefficients - flat[-1]).max() / np.abs(flat[-1]).max()),
    )


def _terms(omegas: np.ndarray) -> np.ndarray:
    """1, L, κ, κL, κL² at ω of shape (n,): shape (n, 5)."""
    logarithm, kappa = np.log(-1j * omegas), omegas**2
    return np.stack([np.ones_like(kappa), logarithm, kappa, kappa * logarithm, kappa * logarithm**2], axis=1)


def lowest_meshed_frequency(water: Tank, latest: float) -> float:
    """Return the lowest frequency that the mesh must resolve, rad/s."""
    if not has_low_frequency_series(water):
        return _LOWEST_OVER_A_BED / latest
    layers, extent = two_layers(water), open_basin(water, 0.0).units.length
    buoyancy = (layers.density_below - layers.density_above) / (layers.density_below + layers.density_above)
    # In shallow water (kb)² is small, and over a deep bed (kH)².
    lengths = [extent, *(max(layer.depth, extent**2 / layer.depth) for layer in water.layers if not isinf(layer.depth))]
    return sqrt(_LONG * layers.gravity * buoyancy / max(lengths))


def has_low_frequency_series(water: Tank) -> bool:
    """Whether H has the series for long waves: in infinitely deep liquids, and about an axis."""
    return water.geometry.is_revolved or is_infinitely_deep(water)


def is_infinitely_deep(water: Tank) -> bool:
    """Whether all liquids are infinitely deep."""
    return all(isinf(layer.depth) for layer in water.layers)
