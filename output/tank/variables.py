"""Arrays of a closed tank in `dataset.nc`: shapes of modes along surfaces and bodies, and matrices of floats."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import xarray as xr

from hydroelastic.output.quantities import array
from hydroelastic.output.variables import Variable, attributes_of

# fmt: off
# A table: as many arguments on a line as fit.
_MODE = array("mode", "number of the mode", None, "mode",
    note="`growing_mode`, of motions that grow, whose arrays begin so")
_PLACE = array("position_on_{place}", "distance from the left wall", "m", "position_on_{place}")
_SURFACE = array("elevation_of_{place}", "upward elevation of a free surface or interface", "m",
    "mode position_on_{place}", note="`free_surface_1`, `interface_1` …, numbered from the left; all shapes are "
    "[normalised](../conventions.md#normalisation-and-names)")
_BEAM = array("deflection_of_{place}", "upward deflection of a beam", "m", "mode position_on_{place}",
    note="`body_1` …, its number")
_MOTION = array("motion", "motion of the floats", "m", "mode dof", of_roll=("rad",), note="heave, sway, roll")
_CONTOUR = array("contour_of_{place}", "contour of a float at rest", "m", "point_on_{place} axis")
_MOVED = array("displacement_of_{place}", "displacement of the contour of a float", "m", "mode point_on_{place} axis")
_OF_MOTIONS = "influenced_dof radiating_dof"
_MASSES = array("inertia_matrix", "inertia of the floats", "kg/m", _OF_MOTIONS, of_roll=("kg", "kg m"))
_STIFFNESS = array("hydrostatic_stiffness", "hydrostatic stiffness of the floats", "N/m^2", _OF_MOTIONS,
    of_roll=("N/m", "N"))
_ADDED = array("infinite_frequency_added_mass", "added mass at infinite frequency", "kg/m", _OF_MOTIONS,
    of_roll=("kg", "kg m"))
ARRAYS = (_MODE, _PLACE, _SURFACE, _BEAM, _MOTION, _CONTOUR, _MOVED, _MASSES, _STIFFNESS, _ADDED)
"""The declarations; a place is that of a piece of a surface, or a body."""
# fmt: on


def tank_variables(data: xr.Dataset, shapes: xr.Dataset) -> Iterator[Variable]:
    """Yield the shapes of all modes, the growing ones apart, and the matrices of floats.

    Args:
        data: the Dataset of the solution.
        shapes: its shapes, in the names of ``dataset.nc``.
    """
    for dimension in ("mode", "growing_mode"):
        if dimension in shapes.sizes:
            numbers = np.arange(1, shapes.sizes[dimension] + 1, dtype=np.int32)
            yield Variable(name=dimension, dimensions=(dimension,), values=numbers, attributes=attributes_of(_MODE))
    matrices = data[[name for name in (_ADDED.key,) if name in data]]
    turning = any(str(dof).endswith("Roll") for dof in shapes.get("dof", xr.DataArray()).values.ravel())
    for name, values in {**shapes.variables, **matrices.variables}.items():
        key = str(name).removeprefix("growing_")
        quantity = next((one for one in ARRAYS if key.startswith(one.key.partition("{")[0])), None)
        attributes = {} if quantity is None else attributes_of(quantity if turning else replace(quantity, of_roll=()))
        if quantity is not None or values.dims == (name,):
            yield Variable(
                name=str(name),
                dimensions=tuple(map(str, values.dims)),
                values=values.values,
                attributes={**attributes, **values.attrs},
            )
