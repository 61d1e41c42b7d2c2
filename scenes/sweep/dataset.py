"""A sweep as one labelled dataset, whose dimensions are the varied keys."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from hydroelastic.scenes.output.provenance import versions
from hydroelastic.scenes.sweep.branches import branch_variables
from hydroelastic.scenes.sweep.run import SolvedSweep

if TYPE_CHECKING:
    import xarray


def sweep_dataset(solved: SolvedSweep, table: xarray.Dataset) -> xarray.Dataset:
    """Return all quantities on the grid of a sweep.

    Args:
        solved: the points.
        table: their quantities, the points along the first dimension.
    """
    import xarray

    axes = solved.grid.axes
    dims = tuple(axis.name for axis in axes)

    def on_grid(values: Any) -> np.ndarray:
        array = np.asarray(values)
        return array.reshape(*solved.grid.shape, *array.shape[1:])

    status = [point.status for point in solved.points]
    reason = ["; ".join(point.reasons) for point in solved.points]
    variables: dict[str, Any] = {
        "status": (dims, on_grid(status), {"long_name": "ok, unconverged or failed"}),
        "reason": (dims, on_grid(reason), {"long_name": "why a point is not ok"}),
    }
    for name, one in table.data_vars.items():
        variables[str(name)] = ((*dims, *one.dims[1:]), on_grid(one.values), one.attrs)
    variables |= branch_variables(solved)
    coordinates: dict[str, Any] = {axis.name: (axis.name, list(axis.values), {"key": axis.key}) for axis in axes}
    coordinates |= {str(name): one for name, one in table.coords.items() if one.dims != ("point",)}
    scene = json.dumps(solved.scene.model_dump(mode="json"), ensure_ascii=False)
    return xarray.Dataset(
        variables,
        coordinates,
        {
            "Conventions": "CF-1.8",
            "title": solved.scene.title,
            "source": f"hydroelastic {versions()['hydroelastic']}",
            "status": solved.status,
            "scene": scene,
        },
    )
