"""Which of the report's words a result takes, by what its summary holds."""

from __future__ import annotations

from typing import Literal, TypeAlias, cast

from hydroelastic.output.level_tank import quantities as level_tank
from hydroelastic.output.open_water import quantities as water
from hydroelastic.output.provenance import SCENE, Summary, read_summary
from hydroelastic.output.quantities import Group
from hydroelastic.output.reading import Reading
from hydroelastic.output.roll import quantities as roll
from hydroelastic.output.string import quantities as string
from hydroelastic.output.tank import quantities as tank
from hydroelastic.output.thread import quantities as thread

Family: TypeAlias = Literal["tank", "level tank", "open water", "string", "thread", "roll"]


def family_of(summary: Summary) -> Family:
    """Return the family: open water is that of two kinds of scenes, and the kind "tank" has two families."""
    if water.RADIATION.key in summary:
        return "open water"
    kind = read_summary(summary)[SCENE]["kind"]
    return "level tank" if kind == "tank" and tank.FLOATS.key not in summary else cast(Family, kind)


def reading_of(summary: Summary) -> Reading:
    """Return a summary as it is read by the quantities of its family."""
    return read_summary(summary, _DECLARED[family_of(summary)][0])


def size_of(summary: Summary) -> Reading:
    """Return the size of the problem."""
    size: Reading = reading_of(summary)[_DECLARED[family_of(summary)][1]]
    return size


# All quantities of each family, and among them the size.
_DECLARED: dict[Family, tuple[Group, Group]] = {
    "tank": (tank.TANK, tank.SIZE),
    "level tank": (level_tank.LEVEL_TANK, level_tank.SIZE),
    "open water": (water.OPEN_WATER, water.SIZE),
    "string": (string.HANGING_STRING, string.SIZE),
    "thread": (thread.THREAD, thread.SIZE),
    "roll": (roll.ROLL, roll.SIZE),
}
