"""The scene of a ship on a swell: its model with all checks."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from math import pi, radians, sqrt

from pydantic import model_validator
from pydantic_core import InitErrorDetails

from hydroelastic.scenes.models.limits import is_at_most, is_within, shown_most, shown_range
from hydroelastic.scenes.models.problems import problem_at, require_fit
from hydroelastic.scenes.models.roll_parts import RollParts
from hydroelastic.scenes.models.scene_model import LARGEST

MOST_WAVES = 100_000

SHORTEST, LONGEST = 1e-4, 1e4
"""Range of a wave's period in natural periods."""

STEEPEST = 0.443
"""Largest slope of a wave, rad: π times the height over the length, 0.141, of the highest wave in deep water
(Michell, Phil. Mag. 36, 1893). A steeper one breaks."""

HEAVIEST = 1e6
"""Largest n/k."""

MOST_LEVELS = 100

MOST_PERIODS = 100_000
"""Largest time of a motion in natural periods."""

MOST_STEPS = 500_000
"""Of the integration in time with quadratic damping, roughly."""

LEAST_QUADRATIC_TOLERANCE = 1e-11
"""What the integration in time keeps at best."""
"""Checks in stages: a later one needs what the earlier ones have found in order."""


class RollScene(RollParts):
    """A ship that rolls on a swell.

    Raises:
        SceneError: if a value is not allowed or the parts do not fit together.
    """

    @model_validator(mode="after")
    def _parts_fit(self) -> RollScene:
        require_fit(self, STAGES)
        return self


def frequency_is_given_once(scene: RollParts) -> Iterator[InitErrorDetails]:
    """Exactly one of period, frequency and section gives the natural frequency."""
    roll = scene.roll
    given = [name for name in ("natural_period", "natural_frequency", "section") if getattr(roll, name) is not None]
    if len(given) != 1:
        key = given[1] if given else "natural_period"
        wrong = f"it is given beside {given[0]}" if given else "it is missing"
        value = getattr(roll, key)
        yield problem_at(
            ("roll", key),
            str(value) if key == "section" else value,
            wrong,
            allowed="one of natural_period, natural_frequency and section",
        )
    if roll.damping is not None and roll.damping_ratio is not None:
        yield problem_at(
            ("roll", "damping_ratio"),
            roll.damping_ratio,
            "it is given beside damping",
            allowed="one of the two, or none",
        )


def waves_can_be_read(scene: RollParts) -> Iterator[InitErrorDetails]:
    """Waves are given in the scene or by a table of positive periods."""
    if scene.train is None:
        return
    key, value = ("train", "file"), str(scene.train.file)
    if scene.wave:
        yield problem_at(key, value, "it is given beside [[wave]]", allowed="one of the two")
        return
    try:
        waves = scene.waves
    except ValueError as error:
        yield problem_at(key, value, str(error))
        return
    if not waves:
        yield problem_at(key, value, "it holds no waves", allowed="at least one row: period, slope")
    for row, (period, _) in enumerate(waves, start=1):
        if period <= 0.0:
            yield problem_at(
                key, value, f"the period of row {row} is {period:g}", allowed="a positive number of seconds"
            )
            return


def ship_is_excited(scene: RollParts) -> Iterator[InitErrorDetails]:
    """There are waves, or the ship is released from an angle."""
    if not scene.waves and scene.roll.angle == scene.roll.rate == 0.0:
        yield problem_at(
            ("wave",), None, "there is none, and the ship is at rest", allowed="waves, or an angle or a rate at t = 0"
        )
    if len(scene.waves) > MOST_WAVES:
        place = ("wave",) if scene.train is None else ("train", "file")
        yield problem_at(place, None, f"there are {len(scene.waves)} waves", allowed=f"up to {MOST_WAVES}")


def waves_are_not_too_steep(scene: RollParts) -> Iterator[InitErrorDetails]:
    """No wave is steeper than a breaking one; this also detects slopes in degrees."""
    for number, (_, slope) in enumerate(scene.waves):
        if abs(slope) <= STEEPEST:
            continue
        in_table = scene.train is not None
        subject = f"the slope of wave {number + 1}, {slope:g} rad, is" if in_table else "it is"
        yield problem_at(
            ("train", "file") if in_table else ("wave", number, "slope"),
            str(scene.train.file) if scene.train is not None else slope,
            f"{subject} steeper than any wave at sea",
            allowed=f"up to {STEEPEST:g} rad; deep-water waves break there",
            remedy=f"The unit is rad: {slope:g} degrees are {radians(slope):.4g}",
        )
        return


def rates_are_comparable(scene: RollParts) -> Iterator[InitErrorDetails]:
    """Ratios of periods and damping lie within the range of double precision."""
    frequency = scene.natural_frequency
    if frequency is None:
        return
    period = 2.0 * pi / frequency
    for number, (wave, _) in enumerate(scene.waves):
        if not is_within(wave, SHORTEST * period, LONGEST * period):
            place = ("wave", number, "period") if scene.train is None else ("train", "file")
            allowed = f"{shown_range(SHORTEST * period, LONGEST * period)} s beside a natural period of {period:g} s"
            yield problem_at(
                place, wave if scene.train is None else None, f"a wave of {wave:g} s is too far off", allowed=allowed
            )
            return
    damping = scene.damping(frequency)
    if damping is not None and not is_at_most(damping, HEAVIEST * frequency):
        key = "damping" if scene.roll.damping is not None else "damping_ratio"
        yield problem_at(("roll", key), getattr(scene.roll, key), "it is too large", allowed=f"n up to {HEAVIEST:g} k")


def motion_can_be_followed(scene: RollParts) -> Iterator[InitErrorDetails]:
    """The motion ends after t = 0, within the limits of oscillations and of steps of the integrator."""
    frequency = scene.natural_frequency
    if scene.output.times is not None and scene.output.times[-1] == 0.0:
        yield problem_at(("output", "times"), 0.0, "the motion has no duration", allowed="a last time above 0")
        return
    if scene.roll.quadratic_damping > 0.0 and scene.accuracy.tolerance < LEAST_QUADRATIC_TOLERANCE:
        yield problem_at(
            ("accuracy", "tolerance"),
            scene.accuracy.tolerance,
            "with quadratic damping it is too small",
            allowed=f"from {LEAST_QUADRATIC_TOLERANCE:g}",
        )
    if frequency is None:
        return
    last = scene.last_time(frequency)
    longest = MOST_PERIODS * 2.0 * pi / frequency
    if not is_at_most(last, min(longest, LARGEST)):
        allowed = f"up to {shown_most(min(longest, LARGEST))} s, or {MOST_PERIODS} natural periods if that is less"
        yield problem_at(("output", "times"), last, "it is too late", allowed=allowed)
    elif scene.roll.quadratic_damping > 0.0 and _steps(scene, frequency, last) > MOST_STEPS:
        yield problem_at(
            ("roll", "quadratic_damping"),
            scene.roll.quadratic_damping,
            "with these waves and times the integration in time would take too many steps",
            allowed=f"about {MOST_STEPS} steps",
            remedy="Shorten the motion or the train, or lower the damping",
        )


def _steps(scene: RollParts, frequency: float, last: float) -> float:
    """Approximate number of steps of an explicit integrator: ten per radian of the fastest oscillation or decay.

    Where quadratic damping dominates, the rate follows from d φ'² = k² a, and decays are as fast as d|φ'|.
    """
    roll = scene.roll
    steepest = max((abs(slope) for _, slope in scene.waves), default=0.0)
    driven = frequency * sqrt(roll.quadratic_damping * max(steepest, abs(roll.angle)))
    linear = 2.0 * (scene.damping(frequency) or 0.0)
    fastest = max(frequency, linear, driven, roll.quadratic_damping * abs(roll.rate))
    waves = sum(max(2.0 * pi, fastest * period) for period, _ in scene.waves)
    rest = max(last - sum(period for period, _ in scene.waves), 0.0)
    return waves + fastest * rest


def levels_differ(scene: RollParts) -> Iterator[InitErrorDetails]:
    """Levels of angle ascend, and their number is limited."""
    levels = scene.output.levels
    if len(levels) > MOST_LEVELS:
        yield problem_at(("output", "levels"), None, f"there are {len(levels)}", allowed=f"up to {MOST_LEVELS}")
    if any(after <= before for before, after in pairwise(levels)):
        yield problem_at(("output", "levels"), None, "they do not go up", allowed="levels in ascending order")


STAGES = (
    (frequency_is_given_once, waves_can_be_read),
    (ship_is_excited, waves_are_not_too_steep, rates_are_comparable, levels_differ),
    (motion_can_be_followed,),
)
