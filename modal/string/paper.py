"""The paper on a string in a resisting medium: its printed formulas beside corrected ones, and the list of errata.

Slips that a scan may have made are left out. Notation: a = α, μ_k, Ω_k = μ_k/R, w_k = √(Ω_k² − a²).
"""

from __future__ import annotations

import math

import numpy as np
from scipy.special import jv

from hydroelastic.modal.beam.paper_model import Erratum, PrintedAndCorrected
from hydroelastic.modal.bessel_zeros import bessel_zeros
from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.string.closed_form import (
    bessel_ratio,
    first_oscillating_mode,
    natural_frequencies,
    natural_frequency,
    participations,
    relative_roots,
    steady_amplitude,
    transfer,
)
from hydroelastic.modal.string.partial_sum import partial_sum
from hydroelastic.modal.string.resonance import string_resonance
from hydroelastic.modal.string.response import string_response
from hydroelastic.modal.string.truncation import weights
from hydroelastic.physics.string import HangingString
from hydroelastic.physics.string_motions import Motion, Ramp, Smooth, Step

STRING_SOURCE = (
    'A. N. Obukhov, V. A. Palamarchuk, "On transverse displacements of a string in a medium with resistance '
    'proportional to the velocity of its section" (in Russian)'
)
# Of the series of differences between both, which fall as 1/k³.
TERMS = 4096


def critical_damping(string: HangingString) -> PrintedAndCorrected:
    """Return the damping from which mode 1 is aperiodic (erratum 1): √(gμ₁/2l), Ω₁ = (μ₁/2)√(g/l), 1/s."""
    zero = float(bessel_zeros(1)[0])
    return PrintedAndCorrected(
        printed=math.sqrt(string.apparent_gravity / string.length * zero / 2),
        corrected=natural_frequency(string, 1),
    )


def lowest_oscillating_mode(string: HangingString) -> PrintedAndCorrected:
    """Return the number of the lowest mode that oscillates (erratum 2).

    Printed: the lowest k with α ≤ √(gμ_k/2l). Corrected: the lowest k with α < Ω_k.
    """
    zero = 2 * string.length * string.damping**2 / string.apparent_gravity
    printed = int(np.searchsorted(bessel_zeros(int(zero / math.pi) + 2), zero, side="left")) + 1
    return PrintedAndCorrected(printed=printed, corrected=first_oscillating_mode(string))


def static_series(string: HangingString, exponent: float, position: float) -> PrintedAndCorrected:
    """Return I₀(2√(xs/g)), s = p² + 2ap, by the terms that are given (erratum 5): 1 − xs/g, 1 + xs/g + (xs/g)²/4.

    Args:
        string: the string; its length is not used.
        exponent: p, 1/s.
        position: x, m.
    """
    term = position / string.apparent_gravity * exponent * (exponent + 2 * string.damping)
    return PrintedAndCorrected(printed=1 - term, corrected=1 + term + term**2 / 4)


def static_slope(string: HangingString, exponent: float, position: float) -> PrintedAndCorrected:
    """Return d/dp of the same (erratum 6): −(x/g)(p + a), 2(x/g)(p + a) + (x/g)² s (p + a), s.

    Args:
        string: the string; its length is not used.
        exponent: p, 1/s.
        position: x, m.
    """
    height, sum_ = position / string.apparent_gravity, exponent + string.damping
    term = height * exponent * (exponent + 2 * string.damping)
    return PrintedAndCorrected(printed=-height * sum_, corrected=height * sum_ * (2 + term))


def ramp_motion(string: HangingString, speed: float, position: float, time: float) -> PrintedAndCorrected:
    """Return U(x, t), m, under f = Vt by (28) (erratum 8).

    Mode k has the amplitude V B_k/(Ω_k √(1 − …)), printed with 4al/(gμ_k) there, corrected with 4a²l/(gμ_k²).

    Args:
        string: the string.
        speed: V, m/s.
        position: x, m.
        time: t, s.

    Raises:
        NoEstimateError: if the printed root is not real, or a mode is aperiodic: (28) has no such modes.
    """
    _check_all_oscillate(string)
    zeros, frequencies = bessel_zeros(TERMS), natural_frequencies(string, TERMS)
    under_root = 1 - 4 * string.damping * string.length / (string.apparent_gravity * zeros)
    if under_root[0] <= 0:
        raise NoEstimateError(f"the printed root of mode 1 is that of {under_root[0]:.3g}")
    value = float(string_response(string, Ramp(speed=speed), position, time).values[0, 0])
    damped = np.sqrt((frequencies - string.damping) * (frequencies + string.damping))
    phase = np.arctan2(string.damping**2 - damped**2, 2 * string.damping * damped)
    shapes = participations(zeros, relative_roots(string, [position]))[0] * weights(np.arange(1, TERMS + 1), TERMS)
    motion = shapes * math.exp(-string.damping * time) * np.cos(damped * time - phase)
    excess = float(motion @ (1 / (frequencies * np.sqrt(under_root)) - 1 / damped))
    return PrintedAndCorrected(printed=value + speed * excess, corrected=value)


def sine_amplitude(string: HangingString, omega: float, position: float) -> PrintedAndCorrected:
    """Return A(x)/Δ of the steady motion under f = Δ sin ωt by (41) (erratum 11): |J₀(μr)|², |J₀(μr)|/|J₀(μ)|.

    Args:
        string: the string.
        omega: ω, 1/s; μ = R√(ω² − 2iaω).
        position: x, m.
    """
    corrected = float(steady_amplitude(string, omega, position)[0])
    argument = string.travel_time * np.sqrt(omega**2 - 2j * string.damping * omega)
    printed = abs(jv(0, argument * float(relative_roots(string, position)))) ** 2
    return PrintedAndCorrected(printed=float(printed), corrected=corrected)


def resonance_frequency(string: HangingString, number: int) -> PrintedAndCorrected:
    """Return ω of the largest steady motion of the free end near mode k (erratum 10): √(Ω_k² − a²), its true place.

    Raises:
        NoEstimateError: if mode k is aperiodic, or drag leaves no peak.
    """
    found = string_resonance(string, number)
    if not (found.free_frequency > 0 and math.isfinite(found.peak_frequency)):
        raise NoEstimateError(f"mode {number} has no peak")
    return PrintedAndCorrected(printed=found.free_frequency, corrected=found.peak_frequency)


def smooth_motion(string: HangingString, motion: Smooth, position: float, time: float) -> PrintedAndCorrected:
    """Return U(x, t), m, under f = Δ(1 − e^{−bt})² by (49) and (51) (errata 13 and 14).

    Printed: the second quasi-static term has z₂ = 4√(lb²/g (1 − 2a/b)), corrected 4√(lb²/g (1 − a/b)); and phases with
    principal arctangents, which turn the sign of every mode where a/2 < b < a.

    Args:
        string: the string.
        motion: Δ and b.
        position: x, m.
        time: t, s.

    Raises:
        NoEstimateError: if a mode is aperiodic, or a phase is that of a division by 0: b = a or 2b = a.
    """
    _check_all_oscillate(string)
    rate, damping = motion.rate, string.damping
    if damping in (rate, 2 * rate):
        raise NoEstimateError("the printed phases divide by b − a and 2b − a")
    corrected = float(string_response(string, motion, position, time).values[0, 0])
    decay = math.exp(-rate * time)
    first, second = transfer(string, [-rate, -2 * rate], position)[0].real
    argument = 2 * string.travel_time * np.sqrt(np.array([rate * (rate - 2 * damping)], dtype=complex))
    printed_second = float(bessel_ratio(argument, relative_roots(string, [position]))[0, 0].real)
    modes = corrected - motion.amplitude * (1 - 2 * first * decay + second * decay**2)
    sign = math.copysign(1.0, (rate - damping) * (2 * rate - damping))
    forced = motion.amplitude * (1 - 2 * first * decay + printed_second * decay**2)
    return PrintedAndCorrected(printed=forced + sign * modes, corrected=corrected)


def step_motion(string: HangingString, amplitude: float, position: float, time: float) -> PrintedAndCorrected:
    """Return U(x, t), m, under f = Δ by (52) (erratum 15): Δ(1 − Σ …), Δ(1 − 2 Σ …).

    Args:
        string: the string.
        amplitude: Δ, m.
        position: x, m.
        time: t, s.
    """
    corrected = float(string_response(string, Step(amplitude=amplitude), position, time).values[0, 0])
    return PrintedAndCorrected(printed=(amplitude + corrected) / 2, corrected=corrected)


def few_terms_error(string: HangingString, motion: Motion, terms: int) -> PrintedAndCorrected:
    """Return the largest error of a sum of a few modes over the largest |U|, for t up to 4R (erratum 16).

    Printed: 0.15, the larger of the "10 to 15 %" that 2 or 3 terms should have. Corrected: on a grid of 81 positions
    and 400 times.

    Args:
        string: the string.
        motion: that of the upper end.
        terms: N of the plain sum.
    """
    positions = string.length * np.linspace(0, 1, 81) ** 2
    times = 4 * string.travel_time * (np.arange(400) + 0.5) / 400
    exact = string_response(string, motion, positions, times)
    error = partial_sum(string, motion, positions, times, terms) - exact.values
    return PrintedAndCorrected(printed=0.15, corrected=float(np.abs(error).max() / np.abs(exact.values).max()))


def _check_all_oscillate(string: HangingString) -> None:
    if first_oscillating_mode(string) > 1:
        raise NoEstimateError("mode 1 is aperiodic: the paper has no phases for it")


STRING_ERRATA: tuple[Erratum, ...] = (
    Erratum(
        number=1,
        printed="all modes oscillate for λ < ρ √((g/l) μ₁/2)",
        corrected="λ < ρ (μ₁/2) √(g/l), that is α < Ω₁",
        consequence="Between 1.097 and 1.202 √(g/l) mode 1 is taken for aperiodic, and oscillates.",
    ),
    Erratum(
        number=2,
        printed="modes from k₁ oscillate for ρ √((g/l) μ₁/2) < λ ≤ ρ √((g/l) μ_{k₁}/2)",
        corrected="Ω_{k₁−1} ≤ α < Ω_{k₁}",
        consequence="With heavy damping modes far too high are named; equality is critical, and mode k₁ aperiodic.",
    ),
    Erratum(
        number=3,
        printed="(13), (14): the roots of (12) are simple and p_k = −a ± iw_k are conjugate",
        corrected="real for a > Ω_k, −Ω_k²/(a + s) and −(a + s); double for a = Ω_k",
        consequence="(28), (40) and (51) divide by 0 at a = Ω_k, and lose digits close to it.",
    ),
    Erratum(
        number=4,
        printed="(16): without 1/(r − 1)!",
        corrected="with 1/(r − 1)!",
        consequence="None for r ≤ 2, for which it is used.",
    ),
    Erratum(
        number=5,
        printed="(21): I₀ = 1 − (x/g)s + …, s = p² + 2ap",
        corrected="1 + (x/g)s + (x/g)²s²/4 + …",
        consequence="The series is that of J₀; (23), which is right, does not follow.",
    ),
    Erratum(
        number=6,
        printed="(22): derivative −(x/g)(p + a) + …",
        corrected="2(x/g)(p + a) + (x/g)²s(p + a) + …",
        consequence="As number 5.",
    ),
    Erratum(
        number=7,
        printed="(25): middle member (g/l) μ_k²/2",
        corrected="(g/l) μ_k²/4",
        consequence="None: the last member is right.",
    ),
    Erratum(
        number=8,
        printed="(28): √(1 − 4al/(gμ_k))",
        corrected="√(1 − 4a²l/(gμ_k²))",
        consequence="The dimensions do not agree; amplitudes are wrong, and not real for long strings.",
    ),
    Erratum(
        number=9,
        printed="(29), (38): arctangents that divide by a",
        corrected="ψ = −π/2 for a = 0 in (29); atan2(−2aw_k, ω² + a² − w_k²) in (38)",
        consequence="No phase without damping.",
    ),
    Erratum(
        number=10,
        printed="after (40): resonance at ω = w_k, with a bounded amplitude",
        corrected="largest at ω ≈ Ω_k, about Δ/(|J₁(μ_k)| R a); without damping it grows as t",
        consequence="The frequency is too low, more so with more damping.",
    ),
    Erratum(
        number=11,
        printed="(41): A = |J₀(μr) J̄₀(μ)|²/|J₀(μ)|²",
        corrected="A = Δ |J₀(μr)|/|J₀(μ)|",
        consequence="A square of a ratio, without Δ: the amplitude near a resonance is missed.",
    ),
    Erratum(
        number=12,
        printed="(43) and (52): the series converge uniformly on (0, l)",
        corrected="not at the upper end in (43), and not at the fronts in (52)",
        consequence="A step's front is a jump (l/x)^{1/4} e^{−at_f}, and has no bound at x = 0, t = R, 3R, …",
    ),
    Erratum(
        number=13,
        printed="(49): ψ_k = arctan(a/w) + arctan(w/(b − a)) + arctan(w/(2b − a)), k = 0, 1, …",
        corrected="atan2(a, w) + atan2(w, b − a) + atan2(w, 2b − a), k = 1, 2, …",
        consequence="All modes have the wrong sign for a/2 < b < a, and no phase for b = a and b = a/2.",
    ),
    Erratum(
        number=14,
        printed="(51), (53) to (55): z₂ = 4 √(lb²/g (1 − 2a/b))",
        corrected="z₂ = 4 √(lb²/g (1 − a/b))",
        consequence="The term of e^{−2bt} is wrong with any damping, without bound where J₀(|z₂|) is near 0.",
    ),
    Erratum(
        number=15,
        printed="(52): U = Δ[1 − Σ …]",
        corrected="U = Δ[1 − 2 Σ …]",
        consequence="Half of the step is there before its front.",
    ),
    Erratum(
        number=16,
        printed="2 or 3 terms of the series have an error of 10 to 15 %",
        corrected="true of ramps and slow motions only",
        consequence="The error of fast sines is as large as the motion, and of a step no smaller than its jump.",
    ),
)
