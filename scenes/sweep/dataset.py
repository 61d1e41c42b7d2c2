"""A sweep as labelled variables, whose dimensions are the varied keys."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from hydroelastic.output.provenance import versions
from hydroelastic.output.variables import Variable, merged
from hydroelastic.scenes.sweep.branches import branch_variables
from hydroelastic.scenes.sweep.quantities import POINT
from hydroelastic.scenes.sweep.run import SolvedSweep

if TYPE_CHECKING:
    import xarray


def sweep_variables(solved: SolvedSweep, of_points: Iterable[Variable]) -> list[Variable]:
    """Return all quantities on the grid of a sweep, and the followed modes."""
    axes = solved.grid.axes
    along = tuple(axis.name for axis in axes)

    def on_grid(one: Variable) -> Variable:
        if one.dimensions[:1] != (POINT,):
            return one
        values = one.values.reshape(*solved.grid.shape, *one.values.shape[1:])
        return replace(one, dimensions=(*along, *one.dimensions[1:]), values=values)

    places = (
        Variable(name=axis.name, dimensions=(axis.name,), values=np.array(axis.values), attributes={"key": axis.key})
        for axis in axes
    )
    said = {
        "status": ([point.status for point in solved.points], "ok, unconverged or failed"),
        "reason": (["; ".join(point.reasons) for point in solved.points], "why a point is not ok"),
    }
    told = (
        Variable(name=name, dimensions=(POINT,), values=np.array(values), attributes={"long_name": meaning})
        for name, (values, meaning) in said.items()
    )
    return merged(places, map(on_grid, (*told, *of_points)), branch_variables(solved))


def sweep_attributes(solved: SolvedSweep) -> dict[str, Any]:
    """Return the attributes of the dataset as a whole."""
    return {
        "Conventions": "CF-1.8",
        "title": solved.scene.title,
        "source": f"hydroelastic {versions()['hydroelastic']}",
        "status": solved.status,
        "scene": json.dumps(solved.scene.model_dump(mode="json"), ensure_ascii=False),
    }


def as_dataset(variables: Iterable[Variable], attributes: dict[str, Any]) -> xarray.Dataset:
    """Return variables as a dataset of xarray, with complex numbers."""
    # The import takes a while.
    import xarray

    found = {one.name: (one.dimensions, one.values, dict(one.attributes)) for one in variables}
    places = {name: one for name, one in found.items() if one[0] == (name,)}
    return xarray.Dataset({name: one for name, one in found.items() if name not in places}, places, attributes)
