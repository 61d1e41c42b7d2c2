"""Quantities by the printed and by the corrected formulas, as docs/errata_string_and_roll.md shows them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from uniform_strings import uniform_string

from hydroelastic.modal.beam.paper_model import PrintedAndCorrected
from hydroelastic.modal.roll.motion import roll_response
from hydroelastic.modal.roll.paper import (
    ALL_ROLL_SLIPS,
    PRINTED_ROLL,
    PRINTED_TRAIN,
    RollSlip,
    paper_roll_angle,
    printed_roll_constants,
)
from hydroelastic.modal.string.paper import (
    critical_damping,
    few_terms_error,
    lowest_oscillating_mode,
    ramp_motion,
    resonance_frequency,
    sine_amplitude,
    smooth_motion,
    static_series,
    static_slope,
    step_motion,
)
from hydroelastic.physics.ship import Ship
from hydroelastic.physics.string import HangingString
from hydroelastic.physics.string_motions import Ramp, Sine, Smooth, Step


@dataclass(frozen=True)
class Number:
    """A quantity, the erratum that it belongs to, and both its values."""

    erratum: int
    quantity: str
    values: Callable[[], PrintedAndCorrected]


def row(number: Number) -> str:
    """The line of the page's table."""
    values = number.values()
    return f"| {number.erratum} | {number.quantity} | {values.printed:.5g} | {values.corrected:.5g} |"


def _string(damping: float, length: float = 1.0) -> HangingString:
    return uniform_string(length=length, damping=damping)


STRING_NUMBERS = (
    Number(1, "damping from which mode 1 is aperiodic, 1/s", lambda: critical_damping(_string(0.0))),
    Number(2, "lowest mode that oscillates, a = 30 1/s", lambda: lowest_oscillating_mode(_string(30.0))),
    Number(5, "I₀ at x/g = 0.05 s², p = 0.7, a = 0.4 1/s", lambda: static_series(_string(0.4), 0.7, 0.05 * 9.81)),
    Number(6, "its derivative by p there, s", lambda: static_slope(_string(0.4), 0.7, 0.05 * 9.81)),
    Number(8, "U/V, s, ramp, a = 3 1/s, x = 0.25 m, t = 1 s", lambda: ramp_motion(_string(3.0), 1.0, 0.25, 1.0)),
    Number(10, "ω of the largest motion at x = 0, a = 2 1/s", lambda: resonance_frequency(_string(2.0), 1)),
    Number(11, "A/Δ at x = 0.1 m, a = 0.5 1/s, ω = 5 rad/s", lambda: sine_amplitude(_string(0.5), 5.0, 0.1)),
    Number(
        13,
        "U/Δ, smooth, a = 2, b = 1.6 1/s, x = 0.3 m, t = 1.2 s",
        lambda: smooth_motion(_string(2.0), Smooth(amplitude=1.0, rate=1.6), 0.3, 1.2),
    ),
    Number(
        14,
        "U/Δ, smooth, a = 1, b = 1.2 1/s, x = 0.05 m, t = 0.6 s",
        lambda: smooth_motion(_string(1.0), Smooth(amplitude=1.0, rate=1.2), 0.05, 0.6),
    ),
    Number(15, "U/Δ, step, a = 0, x = 0.25 m, t = 1.1 s", lambda: step_motion(_string(0.0), 1.0, 0.25, 1.1)),
    Number(16, "error of 3 terms, ramp, a = 0", lambda: few_terms_error(_string(0.0), Ramp(speed=1.0), 3)),
    Number(
        16,
        "error of 3 terms, sine of 10 √(g/l), a = 0",
        lambda: few_terms_error(_string(0.0), Sine(amplitude=1.0, omega=10.0 * math.sqrt(9.81)), 3),
    ),
    Number(
        16,
        "error of 3 terms, step, a = √(g/l)",
        lambda: few_terms_error(_string(math.sqrt(9.81)), Step(amplitude=1.0), 3),
    ),
)


def _largest(slips: object) -> PrintedAndCorrected:
    """Largest difference between the motion with some slips and the right one, over 54.6 s; no difference is right."""
    times = np.linspace(0.0, 54.6, 10921)[1:]
    printed = paper_roll_angle(PRINTED_ROLL, PRINTED_TRAIN, times, slips)  # type: ignore[arg-type]
    corrected = roll_response(PRINTED_ROLL, PRINTED_TRAIN, times).angle
    return PrintedAndCorrected(printed=float(np.abs(printed - corrected).max()), corrected=0.0)


def _angle(time: float) -> PrintedAndCorrected:
    return PrintedAndCorrected(
        printed=float(paper_roll_angle(PRINTED_ROLL, PRINTED_TRAIN, time)),
        corrected=float(roll_response(PRINTED_ROLL, PRINTED_TRAIN, time).angle),
    )


def _at_critical_damping() -> PrintedAndCorrected:
    """φ at 20 s; the paper has none."""
    k = PRINTED_ROLL.natural_frequency
    return PrintedAndCorrected(
        printed=math.nan,
        corrected=float(roll_response(Ship(natural_frequency=k, damping=k), PRINTED_TRAIN, 20.0).angle),
    )


def _difference_of_dampings() -> PrintedAndCorrected:
    """Between n = 0.6 k and 0.96 k; the paper sees none."""
    times = np.linspace(0.0, 54.6, 10921)
    k = PRINTED_ROLL.natural_frequency
    one, other = (
        roll_response(Ship(natural_frequency=k, damping=factor * k), PRINTED_TRAIN, times).angle
        for factor in (0.6, 0.96)
    )
    return PrintedAndCorrected(printed=0.0, corrected=float(np.abs(one - other).max()))


ROLL_NUMBERS = (
    Number(1, "λ of the first wave", lambda: printed_roll_constants(PRINTED_ROLL, 8.2)["lambda"]),
    Number(1, "largest error by this alone", lambda: _largest({RollSlip.LAMBDA})),
    Number(2, "α of the first wave", lambda: printed_roll_constants(PRINTED_ROLL, 8.2)["alpha"]),
    Number(2, "largest error by this alone", lambda: _largest({RollSlip.ALPHA})),
    Number(3, "β of a wave of 30 s", lambda: printed_roll_constants(PRINTED_ROLL, 30.0)["beta"]),
    Number(
        4,
        "largest error by this alone",
        lambda: _largest({RollSlip.THIRD_BRANCH_ARGUMENT, RollSlip.THIRD_BRANCH_DECAY}),
    ),
    Number(4, "largest error by all of them", lambda: _largest(ALL_ROLL_SLIPS)),
    Number(4, "φ at 5 s", lambda: _angle(5.0)),
    Number(4, "φ at 10 s", lambda: _angle(10.0)),
    Number(4, "φ at 20 s", lambda: _angle(20.0)),
    Number(6, "φ at 20 s, n = k", _at_critical_damping),
    Number(8, "largest difference between n = 0.6 k and 0.96 k", _difference_of_dampings),
)
