"""Resonance of a hanging string: where the steady motion under f = Δ sin ωt is largest.

The amplitude at the free end is 1/|J₀(R√(ω² − 2iαω))|. With little damping it is largest at ω = Ω_k, the frequency
without damping (not at √(Ω_k² − α²)), where it is 1/(|J₁(μ_k)| R α); without damping the motion there grows as t.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.special import j1

from hydroelastic.modal.string.closed_form import natural_frequencies, natural_frequency, steady_amplitude
from hydroelastic.physics.string import HangingString


@dataclass(frozen=True, kw_only=True)
class StringResonance:
    """The resonance of one mode."""

    mode: int  # its number k, counted from 1
    natural_frequency: float  # Ω_k, 1/s, without damping
    free_frequency: float  # √(Ω_k² − α²) of the damped free motion, 1/s; 0 for an aperiodic mode
    # ω of the largest amplitude at the free end between the neighbouring antiresonances, 1/s; Ω_k without damping, and
    # not a number where drag leaves no peak
    peak_frequency: float
    peak_amplitude: float  # that amplitude over Δ; infinite without damping: the motion grows as t
    estimate: float  # 1/(|J₁(μ_k)| R α), which the peak tends to with little damping


def string_resonance(string: HangingString, number: int) -> StringResonance:
    """Return the resonance of mode k = number, counted from 1."""
    natural = natural_frequency(string, number)
    zero = natural * string.travel_time
    squared = (natural - string.damping) * (natural + string.damping)
    peak, amplitude, estimate = natural, math.inf, math.inf
    if string.damping > 0:
        peak, amplitude = _peak(string, natural)
        estimate = 1 / (abs(float(j1(zero))) * string.travel_time * string.damping)
    return StringResonance(
        mode=number,
        natural_frequency=natural,
        free_frequency=math.sqrt(max(0.0, squared)),
        peak_frequency=peak,
        peak_amplitude=amplitude,
        estimate=estimate,
    )


def nearest_resonance(string: HangingString, omega: float) -> StringResonance:
    """Return the resonance whose Ω_k is nearest to ω (1/s)."""
    if not (omega >= 0 and math.isfinite(omega)):
        raise ValueError(f"omega is {omega}: it must be finite and not negative")
    frequencies = natural_frequencies(string, int(omega * string.travel_time / math.pi) + 2)
    return string_resonance(string, int(np.argmin(np.abs(frequencies - omega))) + 1)


def _peak(string: HangingString, natural: float) -> tuple[float, float]:
    """Return the place and height of the largest amplitude at the free end within half a distance of modes."""
    half = math.pi / (2 * string.travel_time)
    low, high = max(0.0, natural - half), natural + half

    def height(omega: float) -> float:
        return float(steady_amplitude(string, omega, 0.0)[0])

    # The peak is as narrow as α: Brent's method is given its neighbourhood.
    grid = np.unique(np.concatenate([np.linspace(low, high, 65), natural + string.damping * np.linspace(-2, 2, 41)]))
    grid = grid[(grid >= low) & (grid <= high)]
    best = int(np.argmax([height(omega) for omega in grid]))
    if best in (0, len(grid) - 1):
        return math.nan, math.nan
    # Of the distance from there: the tolerance of the method is relative to what it varies.
    found = minimize_scalar(
        lambda offset: -height(grid[best] + offset),
        bounds=(grid[best - 1] - grid[best], grid[best + 1] - grid[best]),
        method="bounded",
        options={"xatol": 1e-6 * string.damping},
    )
    return float(grid[best] + found.x), -float(found.fun)
