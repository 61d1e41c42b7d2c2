"""The quantities of a sweep: all numbers, words and truth values of its points, as labelled variables.

This is the only place where a sweep asks what results there are.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from hydroelastic.output.joined_variables import joined, numbered_along
from hydroelastic.output.provenance import Summary
from hydroelastic.output.quantities import Group
from hydroelastic.output.summary_variables import summary_variables
from hydroelastic.output.variables import Variable, merged
from hydroelastic.scenes.errors import Problem, SceneError, shown_value
from hydroelastic.scenes.words import proposal

POINT = "point"
"""The dimension along which the points lie; of a variable that has it, it is the first."""


def quantities(
    summaries: Sequence[Summary | None], arrays: Sequence[Sequence[Variable] | None], kind: Group
) -> list[Variable]:
    """Return the values of all points."""
    points = Group(POINT, "the points", kind.parts, dimension=POINT, prefix="")
    of_summaries = summary_variables({POINT: list(summaries)}, Group("", "a sweep", (points,)))
    parts = [list(numbered_along(POINT, part, number)) for number, part in enumerate(arrays, 1) if part]
    found = joined(parts, {POINT: range(1, len(arrays) + 1)})
    variables = (replace(one, is_coordinate=False) for one in found)
    return merged(*([one for one in all_of if one.name != POINT] for all_of in (of_summaries, variables)))


def columns(variables: Iterable[Variable], most: int = 100) -> dict[str, np.ndarray]:
    """Return variables as columns of a table, one entry for each point, by name.

    Entries along a further dimension are numbered from 1: ``omega_3`` is that of the third mode. Of complex numbers
    there is the magnitude: ``RAO_abs_5``.
    """
    found = {}
    for one in variables:
        if one.dimensions[:1] != (POINT,):
            continue
        is_complex = one.values.dtype.kind == "c"
        table = (np.abs(one.values) if is_complex else one.values).reshape(len(one.values), -1)
        if table.shape[1] <= most:
            for place, column in zip(np.ndindex(one.values.shape[1:]), table.T, strict=True):
                numbers = [index + 1 for index, size in zip(place, one.values.shape[1:], strict=True) if size > 1]
                found["_".join(map(str, (one.name, *["abs"] * is_complex, *numbers)))] = column
    return found


# The first of these whose first name a table has is shown where nothing is asked for.
_MAIN = (
    ("first_elastic_omega", "first_elastic_participation", "first_elastic_pressure_release_omega"),
    ("omega_1", "omega_2", "omega_3"),
    ("response_largest_displacement",),
    ("equilibrium_largest_tension",),
    ("response_largest_angle_degrees",),
)
_NAMED = 12


def shown_columns(table: Mapping[str, Any], show: tuple[str, ...]) -> tuple[str, ...]:
    """Return the columns to show: those asked for, or else the main ones of the kind of scene."""
    numbers = [name for name in table if np.issubdtype(np.asarray(table[name]).dtype, np.number)]
    for name in show:
        if name.replace(".", "_") not in numbers:
            raise SceneError(
                Problem(
                    key="show",
                    value=shown_value(name),
                    wrong="it holds no numbers" if name in table else "there is no such quantity",
                    allowed="a column of sweep.csv with numbers",
                    remedy=proposal(name, numbers) or f"There are {', '.join(numbers[:_NAMED])} …",
                    argument=True,
                )
            )
    if show:
        return tuple(name.replace(".", "_") for name in show)
    # A tone that lies above the modes of every point is not one to show.
    filled = [name for name in numbers if not np.all(np.isnan(table[name]))]
    found = next((names for known in (filled, numbers) for names in _MAIN if names[0] in known), tuple(numbers[-1:]))
    return tuple(name for name in found if name in numbers)
