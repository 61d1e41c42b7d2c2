"""The arrays of open water in ``dataset.nc``."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from hydroelastic.output.joined_variables import joined, numbered_along, record_variables
from hydroelastic.output.open_water.irregular import SPECTRUM
from hydroelastic.output.open_water.quantities import (
    DECAY,
    OPEN_WATER,
    RADIATION,
    RESONANCE,
    RESPONSE,
    motions_of,
)
from hydroelastic.output.open_water.time_quantities import IMPULSE_RESPONSE, MOTION
from hydroelastic.output.variables import Variable, array_variables
from hydroelastic.output.whole_units import of_whole_solids

_GROUPS = (RADIATION, RESPONSE, RESONANCE, DECAY, SPECTRUM, IMPULSE_RESPONSE, MOTION)

COMMENT = (
    "exp(-i omega t); sections per metre of width, solids and plates of revolution whole; "
    "x along the waves, heave upwards, roll anticlockwise"
)
"""Signs and units of all arrays."""


def open_variables(solution: Any) -> list[Variable]:
    """Return the arrays of a solution, several analyses of a kind joined by their frequencies and wave directions.

    A dimension `wave` is there only where waves travel on two levels, `analysis` only with several analyses of
    another kind than radiation and response.
    """
    motions = motions_of(*solution.radiation, *solution.impulse_response) or motions_of(
        *solution.response, *solution.spectrum
    )
    others = motions_of(*solution.resonance, *solution.decay, *solution.motion)
    with_rolls = any(dof.is_rotation for dof in (*motions, *others))
    parts = {
        group.key: [list(record_variables(group, one, with_rolls=with_rolls)) for one in group.of(solution)]
        for group in (map(of_whole_solids, _GROUPS) if solution.tank.geometry.is_whole else _GROUPS)
    }
    for kind in ("resonance", "decay", "spectrum", "impulse_response", "motion"):
        if len(parts[kind]) > 1:
            parts[kind] = [list(numbered_along("analysis", part, number)) for number, part in enumerate(parts[kind], 1)]
    names, other_names = ([dof.capitalised for dof in dofs] for dofs in (motions, others))
    labels = {"radiating_dof": names, "influenced_dof": names, "dof": other_names}
    found = joined([part for kind in parts.values() for part in kind], labels)
    single = {one.name for one in found if one.name in ("wave", "outgoing_wave") and len(one.values) == 1}
    return [*(_without(one, single) for one in found), *array_variables(OPEN_WATER, solution)]


def _without(variable: Variable, single: set[str]) -> Variable:
    axes = tuple(axis for axis, name in enumerate(variable.dimensions) if name in single)
    return replace(
        variable,
        dimensions=tuple(name for name in variable.dimensions if name not in single),
        values=variable.values.squeeze(axes),
        is_coordinate=variable.is_coordinate or variable.name in single,
    )
