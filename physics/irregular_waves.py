"""Statistics of linear responses in irregular waves, from complex transfer functions at some frequencies.

A response r has the spectrum |T|² S and, with mₙ = ∫ |T|² S ωⁿ dω,

    significant amplitude              2 √m₀
    zero-crossing period               2π √(m₀/m₂)
    most probable largest amplitude    √(2 m₀ ln N),  N = duration/(zero-crossing period), as in a narrow band

T between its samples is a cubic spline of real and imaginary part; moments are Gauss sums over the intervals between
samples and edges of S, in which T S is smooth. Errors of a moment come from sampling (the difference of splines through
all and through every other sample, half of which is told), from the waves beyond both ends
(with T as at the end, whose magnitude falls beyond) and from the transfer functions.

Source: M. K. Ochi, Ocean Waves (1998); M. S. Longuet-Higgins, J. Mar. Res. 11 (1952) 245.

Irregular waves as a sum of regular ones of random phases.

The frequencies are the middles, by energy, of N parts of the spectrum of equal energy, so that all have the amplitude
√(2m₀/N), and the sum has the variance m₀ of the spectrum within its band and no period in which it repeats.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from hydroelastic.physics.wave_spectrum import WaveSpectrum

Floats = NDArray[np.float64]

_ORDERS = (0, 1, 2)
# Points of Gauss's rule on each interval.
_POINTS = 6
# Part of the difference of splines that is told as the error: where the finer one resolves a resonance, a fifteenth is.
_SHARE = 0.5

# Points of the integral of the spectrum over the frequency.
_FREQUENCIES = 20001


@dataclass(frozen=True, kw_only=True)
class Statistics:
    """Statistics of q responses. Each is of shape (q,); units are those of the responses, and s."""

    moments: Floats  # m₀, m₁, m₂, shape (3, q)
    significant_amplitude: Floats  # mean of the highest third of the amplitudes
    zero_crossing_period: Floats  # mean time between upward crossings of zero, s; NaN where nothing moves
    largest_amplitude: Floats  # most probable largest amplitude in the duration
    sampling_error: Floats  # relative error of the significant amplitude by the sampling of transfer functions
    truncation_error: Floats  # by the waves beyond both ends of the frequencies
    transfer_error: Floats  # by the errors of the transfer functions

    @property
    def relative_error(self) -> Floats:
        """Relative error of the significant amplitude by all causes."""
        total: Floats = self.sampling_error + self.truncation_error + self.transfer_error
        return total


def moments(
    spectrum: WaveSpectrum, omegas: np.ndarray, transfer: np.ndarray, orders: tuple[int, ...] = _ORDERS
) -> Floats:
    """Return ∫ |T|² S ωⁿ dω between the first and the last frequency, shape (orders, q).

    Args:
        omegas: ascending, at least four, rad/s, shape (n,).
        transfer: T at these, shape (n, q).
        orders: n.
    """
    edges = np.union1d(omegas, [edge for edge in spectrum.edges if omegas[0] < edge < omegas[-1]])
    nodes, weights = np.polynomial.legendre.leggauss(_POINTS)
    half = 0.5 * np.diff(edges)[:, None]
    points = (0.5 * (edges[1:] + edges[:-1])[:, None] + half * nodes).ravel()
    measure = (half * weights).ravel() * spectrum.density(points)
    squares = np.abs(CubicSpline(omegas, transfer)(points)) ** 2
    found: Floats = np.array([(measure * points**order) @ squares for order in orders])
    return found


def statistics(
    spectrum: WaveSpectrum,
    omegas: np.ndarray,
    transfer: np.ndarray,
    errors: np.ndarray,
    duration: float,
    ends: np.ndarray | None = None,
) -> Statistics:
    """Return the statistics of linear responses.

    Args:
        omegas: frequencies, ascending, at least eight, rad/s, shape (n,).
        transfer: responses per unit elevation, shape (n, q).
        errors: their absolute errors, shape (n, q).
        duration: of the sea state, s.
        ends: |T| below the first and above the last frequency, shape (2, q); by default that at these.
    """
    found = moments(spectrum, omegas, transfer)
    coarse = np.union1d(np.arange(0, len(omegas), 2), [len(omegas) - 1])
    rough = moments(spectrum, omegas[coarse], transfer[coarse], (0,))[0]
    energy = found[0]
    beyond = np.abs(transfer[[0, -1]] if ends is None else ends) ** 2 * [
        [spectrum.below(omegas[0], 0)],
        [spectrum.tail(omegas[-1], 0)],
    ]
    by_transfer = moments(spectrum, omegas, np.sqrt(2.0 * np.abs(transfer) * errors + errors**2).astype(complex), (0,))

    def relative(change: Floats) -> Floats:
        """Relative change of √m₀ by a change of m₀."""
        with np.errstate(divide="ignore", invalid="ignore"):
            part: Floats = np.where(energy > 0.0, 0.5 * change / energy, 0.0)
        return part

    with np.errstate(divide="ignore", invalid="ignore"):
        period = 2.0 * pi * np.sqrt(energy / found[2])
        # At least one cycle.
        largest = np.sqrt(2.0 * energy * np.log(np.maximum(duration / period, np.e)))
    return Statistics(
        moments=found,
        significant_amplitude=2.0 * np.sqrt(energy),
        zero_crossing_period=period,
        largest_amplitude=np.where(energy > 0.0, largest, 0.0),
        sampling_error=relative(_SHARE * np.abs(rough - energy)),
        truncation_error=relative(beyond.sum(axis=0)),
        transfer_error=relative(by_transfer[0]),
    )


def wave_components(
    spectrum: WaveSpectrum, count: int, seed: int
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return frequencies ω, rad/s, amplitudes, m, and phases, rad, of regular waves, each of shape (count,).

    Args:
        count: N.
        seed: of NumPy's default generator, which draws the phases; the same gives the same waves.
    """
    omega: NDArray[np.float64] = np.linspace(*spectrum.band, _FREQUENCIES, dtype=np.float64)
    density = spectrum.density(omega)
    energy = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]) * np.diff(omega))])
    middles = (np.arange(count) + 0.5) / count * energy[-1]
    phases = np.random.default_rng(seed).uniform(0.0, 2.0 * np.pi, count)
    return np.interp(middles, energy, omega), np.full(count, np.sqrt(2.0 * energy[-1] / count)), phases
