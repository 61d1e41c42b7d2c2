"""Quantities of a ship that rolls on a swell."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees, exp, pi
from typing import TYPE_CHECKING, Protocol

from hydroelastic.modal.roll.solution import RollSolution
from hydroelastic.output.provenance import PROCESSES
from hydroelastic.output.quantities import Group, Quantity, array
from hydroelastic.physics.ship import Ship

if TYPE_CHECKING:
    from hydroelastic.fem.section_roll import SectionRoll

LINEAR_UP_TO = 0.5
"""Angle, rad, up to which restoring is taken to be linear. A righting arm like sin φ is 4 % below φ there."""


class RolledShip(Protocol):
    """What the quantities are taken from."""

    @property
    def solution(self) -> RollSolution:
        """The motion."""

    @property
    def section(self) -> SectionRoll | None:
        """Roll of the section by its field solution, if there is one."""

    @property
    def levels(self) -> Sequence[float]:
        """Levels whose exceedances are counted, rad."""


def regime(ship: Ship) -> str:
    """Return the name of the regime of linear damping."""
    k, n = ship.natural_frequency, ship.damping
    if n == 0.0:
        return "undamped"
    return "underdamped" if n < k else "critically damped" if n == k else "overdamped"


def logarithmic_decrement(ship: Ship) -> float:
    """Return δ = 2πn/√(k² − n²), the logarithm of the ratio of two largest angles a period apart."""
    return 2.0 * pi * ship.damping / ship.damped_frequency


def _swings_above(ship: RolledShip) -> list[dict[str, float]]:
    return [{"level": level, "swings": ship.solution.statistics.swings_above(level)} for level in ship.levels]


# fmt: off
# A table: as many arguments on a line as fit.
SHIP = Group("ship", "the ship", (
    Quantity("natural_period", "natural period", "s", "2π/k", value=lambda ship: 2.0 * pi / ship.natural_frequency),
    Quantity("natural_frequency", "natural frequency", "rad/s", "k"),
    DAMPING := Quantity("damping", "damping", "1/s", "n"),
    Quantity("damping_ratio", "damping ratio", "1", "n/k", value=lambda ship: ship.damping / ship.natural_frequency),
    Quantity("regime", "regime of linear damping", value=regime),
    QUADRATIC_DAMPING := Quantity("quadratic_damping", "quadratic damping", "1/rad", "d"),
), record=lambda result: result.solution.ship)
FREE_DECAY = Group("free_decay", "decay of free oscillations by linear damping", (
    Quantity("period", "period of free motion", "s", value=lambda ship: 2.0 * pi / ship.damped_frequency),
    Quantity("logarithmic_decrement", "logarithmic decrement", "1", value=logarithmic_decrement),
    Quantity("ratio_of_swings", "ratio of successive swings", "1",
        value=lambda ship: exp(-0.5 * logarithmic_decrement(ship))),
),  record=lambda result: result.solution.ship if result.solution.ship.damped_frequency else None,
    note="`null` where they do not oscillate")
SECTION = Group("section", "roll of the section by its field solution, per metre of length", (
    TITLE := Quantity("title", "title of the section", printed=False),
    Quantity("natural_frequency", "natural frequency", "rad/s", "k", error="relative_error"),
    Quantity("stiffness", "stiffness", "N", "C"),
    Quantity("inertia", "inertia of the body", "kg m", "I"),
    Quantity("added_inertia", "added inertia", "kg m", "a"),
    Quantity("wave_damping", "wave damping", "kg m/s", "b", note="`null` in a closed tank"),
    Quantity("damping", "damping by waves", "1/s", "n", note="`null` in a closed tank"),
    Quantity("relative_error", "estimated error, of k and of the whole inertia", "1", shown=".1e", contract=False),
    FOLLOWERS := Quantity("followers", "motions that follow the roll without force", printed=False,
        dimensions=("follower",)),
), note="`null` without a section")
EXCEEDANCES = Group("exceedances", "swings above levels", (
    LEVEL := Quantity("level", "level", "rad"),
    Quantity("swings", "swings above it", "1", note="largest angles between zeros"),
), record=_swings_above, dimension="exceedance", prefix="exceedance")
# Largest angles are rounded for reading; summary.json has all digits.
RESPONSE = Group("response", "the motion", (
    WAVES := Quantity("waves", "number of waves", "1", value=lambda it: len(it.solution.train.periods), printed=False),
    Quantity("end_of_waves", "end of the last wave", "s", value=lambda it: float(it.solution.train.starts[-1]),
        printed=False),
    UNTIL := Quantity("until", "last time", "s", value=lambda it: float(it.solution.motion.times[-1]), shown=".6g",
        printed=False),
    LARGEST_ANGLE := Quantity("largest_angle", "largest angle", "rad",
        value=lambda it: it.solution.statistics.largest_angle, error="relative_error", digits=6),
    LARGEST_ANGLE_DEGREES := Quantity("largest_angle_degrees", "largest angle", "degree",
        value=lambda it: degrees(it.solution.statistics.largest_angle), error="relative_error", digits=6),
    RESTORING_IS_LINEAR := Quantity("restoring_is_linear", f"whether the largest angle is at most {LINEAR_UP_TO} rad",
        value=lambda it: abs(it.solution.statistics.largest_angle) <= LINEAR_UP_TO, printed=False),
    TIME_OF_LARGEST_ANGLE := Quantity("time_of_largest_angle", "time of the largest angle", "s",
        value=lambda it: it.solution.statistics.largest_time, note="between the times of the output too"),
    Quantity("root_mean_square", "root mean square", "rad", value=lambda it: it.solution.statistics.root_mean_square),
    Quantity("swings", "swings", "1", value=lambda it: len(it.solution.statistics.swing_angles)),
    Quantity("significant_angle", "mean of the largest third of swings", "rad",
        value=lambda it: it.solution.statistics.significant_angle),
    Quantity("absolute_error", "estimated error of the angle", "rad",
        value=lambda it: it.solution.angle_error + it.solution.ship_error, printed=False, contract=False),
    Quantity("relative_error", "estimated error of the angle, of the largest", "1",
        value=lambda it: it.solution.relative_error, shown=".1e", contract=False),
    EXCEEDANCES,
), record=lambda result: result)
_ARRAYS = (
    array("time", "time", "s", "time", lambda it: it.solution.motion.times),
    array("wave_slope", "slope of the waves", "rad", "time",
        lambda it: it.solution.train.slope(it.solution.motion.times)),
    array("angle", "angle of roll", "rad", "time", lambda it: it.solution.motion.angle),
    array("rate", "rate of roll", "rad/s", "time", lambda it: it.solution.motion.rate),
    array("acceleration", "acceleration of roll", "rad/s^2", "time", lambda it: it.solution.motion.acceleration),
)
ROLL = Group("", "a ship that rolls on a swell", (
    SHIP, FREE_DECAY, SECTION, RESPONSE,
    SIZE := Group("size", "size of the problem", (
        TIMES := Quantity("times", "number of times", "1", value=lambda it: len(it.solution.motion.times)),
        Quantity("waves", "number of waves", "1", value=lambda it: len(it.solution.train.periods)),
        PROCESSES,
    ), record=lambda result: result, contract=False),
    *_ARRAYS,
))
