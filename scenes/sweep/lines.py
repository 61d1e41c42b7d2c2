"""Lines of a sweep along its first key, on which the modes of closed tanks are followed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import exp, log
from typing import Any

import numpy as np

from hydroelastic.fem.sweep.encounters import Encounter, encounters
from hydroelastic.fem.sweep.follow import FollowedModes, follow
from hydroelastic.scenes.sweep.axes import Axis, Grid
from hydroelastic.scenes.sweep.point import SolvedPoint

Point = dict[str, Any]

# A few values are no curve, and following modes between them would take many more.
_FEWEST = 4
# Values that span more than this factor are followed by their logarithm.
_WIDE = 10.0
_DIGITS = 13


@dataclass(frozen=True, kw_only=True)
class Line:
    """The modes along the first key, at one combination of the values of the others.

    Attributes:
        others: values of the other keys.
        values: of the first key, at which there are modes, ascending; those that were added among them.
        followed: the modes there, by the logarithm of the value if `is_logarithmic`.
        encounters: where they meet, by the value of the key.
    """

    others: Point
    values: tuple[float, ...]
    followed: FollowedModes
    encounters: tuple[Encounter, ...]


def is_logarithmic(axis: Axis) -> bool:
    """Whether values of an axis are spaced by ratios rather than by differences."""
    return axis.is_number and min(axis.values) > 0.0 and max(axis.values) > _WIDE * min(axis.values)


def followed_lines(
    grid: Grid,
    points: Sequence[SolvedPoint],
    solve: Callable[[list[Point]], Sequence[SolvedPoint]],
    *,
    count: int,
    most: int,
) -> tuple[Line, ...]:
    """Follow the modes along each line of a grid, none with few values or with values that are no numbers."""
    first = grid.axes[0]
    if not first.is_number or len(first.values) < _FEWEST:
        return ()
    logarithmic = is_logarithmic(first)
    across = len(grid) // len(first.values)
    lines = []
    for column in range(across):
        rows = grid.points[column::across]
        others = {key: value for key, value in rows[0].items() if key != first.key}
        # The values are kept beside their logarithms: those that were given must not be rounded.
        values = {_place(row[first.key], logarithmic): float(row[first.key]) for row in rows}

        def solved(places: Sequence[float], others: Point = others, values: dict[float, float] = values) -> list[Any]:
            values |= {place: float(f"{exp(place) if logarithmic else place:.{_DIGITS}g}") for place in places}
            return [point.modes for point in solve([{first.key: values[place]} | others for place in places])]

        modes = [point.modes for point in points[column::across]]
        followed = follow(list(values), modes, solved, count=count, most=most)
        if followed is not None:
            most -= int(np.sum(followed.refined))
            lines.append(
                Line(
                    others=others,
                    values=tuple(values[place] for place in followed.values),
                    followed=followed,
                    encounters=encounters(followed),
                )
            )
    return tuple(lines)


def _place(value: float, logarithmic: bool) -> float:
    return log(value) if logarithmic else float(value)


def place_of(encounter: Encounter, axis: Axis) -> float:
    """Return the value of the first key at an encounter."""
    return exp(encounter.at) if is_logarithmic(axis) else encounter.at
