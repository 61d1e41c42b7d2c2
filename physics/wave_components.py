"""Irregular waves as a sum of regular ones of random phases.

The frequencies are the middles, by energy, of N parts of the spectrum of equal energy, so that all have the amplitude
√(2m₀/N), and the sum has the variance m₀ of the spectrum within its band and no period in which it repeats.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hydroelastic.physics.wave_spectrum import WaveSpectrum

# Points of the integral of the spectrum over the frequency.
_POINTS = 20001


def wave_components(
    spectrum: WaveSpectrum, count: int, seed: int
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return frequencies ω, rad/s, amplitudes, m, and phases, rad, of regular waves, each of shape (count,).

    Args:
        count: N.
        seed: of NumPy's default generator, which draws the phases; the same gives the same waves.
    """
    omega: NDArray[np.float64] = np.linspace(*spectrum.band, _POINTS, dtype=np.float64)
    density = spectrum.density(omega)
    energy = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]) * np.diff(omega))])
    middles = (np.arange(count) + 0.5) / count * energy[-1]
    phases = np.random.default_rng(seed).uniform(0.0, 2.0 * np.pi, count)
    return np.interp(middles, energy, omega), np.full(count, np.sqrt(2.0 * energy[-1] / count)), phases
