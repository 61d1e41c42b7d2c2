"""The scene of a hanging string: its model with all checks."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from pydantic import model_validator
from pydantic_core import InitErrorDetails

from hydroelastic.scenes.models.limits import is_at_most, shown_most
from hydroelastic.scenes.models.problems import problem_at, require_fit
from hydroelastic.scenes.models.scene_model import LARGEST
from hydroelastic.scenes.models.string_parts import StringParts

MOST_POINTS = 1_000_000
"""Places times times of one response."""

MOST_TABLE_ROWS = 20_000

FASTEST = 3000.0
"""Largest ωR, βR and αR: the series of a faster motion, or of more damping, has more terms than are worth it."""

FASTEST_FIELD = 300.0
"""Largest ωR and βR of a field solution, whose elements follow the waves."""

LONGEST = {"series": 1e4, "field": 200.0}
"""Largest time of a response in travel times of a wave along the string, by method."""


def string_outweighs_its_displaced_liquid(scene: StringParts) -> Iterator[InitErrorDetails]:
    """A string lighter than the liquid that it displaces is not under tension."""
    string = scene.string
    if string.displaced_mass >= string.linear_density:
        yield problem_at(
            ("string", "displaced_mass"),
            string.displaced_mass,
            "the string would float up",
            allowed=f"less than linear_density = {string.linear_density:g} kg/m",
        )
    if string.tip_displaced_mass >= string.tip_mass > 0.0 or string.tip_displaced_mass > string.tip_mass:
        yield problem_at(
            ("string", "tip_displaced_mass"),
            string.tip_displaced_mass,
            "the body on the free end would float up",
            allowed=f"less than tip_mass = {string.tip_mass:g} kg",
        )


def method_is_available(scene: StringParts) -> Iterator[InitErrorDetails]:
    """The series needs a uniform resistance and a free lower end."""
    if scene.accuracy.method == "series" and not scene.string.physical.has_closed_form:
        yield problem_at(
            ("accuracy", "method"),
            "series",
            "there is no series with a tip mass or a resistance that varies",
            allowed='"auto" or "field"',
        )


def table_can_be_followed(scene: StringParts) -> Iterator[InitErrorDetails]:
    """A motion by a table has one table, whose times ascend from 0."""
    motion = scene.motion
    if motion.kind != "table":
        return
    written = motion.times is not None or motion.values is not None
    if (motion.file is not None) == written:
        wrong = "it is given beside times and values" if written else "it is missing"
        value = str(motion.file) if written else None
        yield problem_at(("motion", "file"), value, wrong, allowed="either file, or times and values")
        return
    if motion.file is None and len(motion.times or ()) != len(motion.values or ()):
        numbers = f"{len(motion.times or ())} times, {len(motion.values or ())} values"
        yield problem_at(("motion", "values"), None, f"there are {numbers}", allowed="as many values as times")
        return
    key = ("motion", "times" if motion.file is None else "file")
    value = None if motion.file is None else str(motion.file)
    try:
        table = scene.table
    except ValueError as error:
        yield problem_at(key, value, str(error))
        return
    assert table is not None
    least = 4 if motion.interpolation == "cubic" else 2
    if not least <= len(table) <= MOST_TABLE_ROWS:
        allowed = f"{least} to {MOST_TABLE_ROWS} rows"
        yield problem_at(key, value, f"it holds {len(table)} rows", allowed=allowed)
        return
    if table[0][0] != 0.0:
        yield problem_at(key, value, f"its first time is {table[0][0]:g}", allowed="a table that begins at t = 0")
    for row, (before, after) in enumerate(pairwise(table), start=2):
        if after[0] <= before[0]:
            wrong = f"the time of row {row} is not greater than that before it"
            yield problem_at(key, value, wrong, allowed="times that go up")
            return


def travel_time_is_finite(scene: StringParts) -> Iterator[InitErrorDetails]:
    """The travel time of a wave along the string is a finite number."""
    travel = scene.string.physical.travel_time
    longest = LARGEST / LONGEST["series"]
    if not is_at_most(travel, longest):
        wrong = f"a wave would take {travel:g} s along the string"
        remedy = "Make the string shorter, or gravity stronger"
        yield problem_at(
            ("string", "length"), scene.string.length, wrong, allowed=f"up to {longest:g} s", remedy=remedy
        )


def output_is_in_range(scene: StringParts) -> Iterator[InitErrorDetails]:
    """Positions lie on the string and times within the table of the motion; the number of values is limited."""
    length, times = scene.string.length, scene.times
    if scene.positions[-1] > length:
        yield problem_at(
            ("output", "positions"),
            scene.positions[-1],
            "it lies above the upper end",
            allowed=f"0 to length = {length:.12g} m",
        )
    table = scene.table
    if table is not None and times[-1] > table[-1][0]:
        yield problem_at(
            ("output", "times"),
            times[-1],
            "the table of the motion ends before",
            allowed=f"up to {shown_most(table[-1][0])} s",
        )
    number = LONGEST[scene.method]
    longest = number * scene.string.physical.travel_time
    if not is_at_most(times[-1], longest):
        yield problem_at(
            ("output", "times"),
            times[-1],
            f"it is more than {number:g} travel times of a wave",
            allowed=f"up to {shown_most(longest)} s",
        )
    if len(scene.positions) * len(times) > MOST_POINTS:
        yield problem_at(
            ("output", "times"),
            len(times),
            f"with {len(scene.positions)} positions there are too many points",
            allowed=f"positions times times up to {MOST_POINTS}",
        )


def motion_is_not_too_fast(scene: StringParts) -> Iterator[InitErrorDetails]:
    """Rates lie within what the allowed terms or elements resolve."""
    travel, motion = scene.string.physical.travel_time, scene.motion
    limit = (FASTEST if scene.method == "series" else FASTEST_FIELD) / travel
    rates: list[tuple[tuple[str, str], float]] = []
    if motion.kind == "sine":
        rates.append((("motion", "omega"), motion.omega))
    if motion.kind == "smooth":
        rates.append((("motion", "rate"), motion.rate))
    for place, rate in rates:
        if not is_at_most(rate, limit):
            yield problem_at(
                place, rate, "it is too fast for waves on this string", allowed=f"up to {shown_most(limit)} 1/s here"
            )
    heaviest = max(scene.string.resistance.bottom, scene.string.resistance.top)
    most = FASTEST / travel * scene.string.physical.inertia
    if not is_at_most(heaviest, most):
        yield problem_at(
            ("string", "resistance"), heaviest, "it is too large", allowed=f"up to {shown_most(most)} kg/(m·s) here"
        )


STAGES = (
    (string_outweighs_its_displaced_liquid, table_can_be_followed),
    (travel_time_is_finite,),
    (method_is_available, output_is_in_range, motion_is_not_too_fast),
)
"""Checks in stages: a later one needs what the earlier ones have found in order."""


class StringScene(StringParts):
    """A heavy string that hangs in a resisting medium while its upper end is moved.

    Raises:
        SceneError: if a value is not allowed or the parts do not fit together.
    """

    @model_validator(mode="after")
    def _parts_fit(self) -> StringScene:
        require_fit(self, STAGES)
        return self
