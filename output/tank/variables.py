"""Arrays of a closed tank in `dataset.nc`: shapes of modes along surfaces and bodies, and matrices of floats."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.tank.solve import TankSolution
from hydroelastic.output.quantities import Quantity, array
from hydroelastic.output.variables import Variable, attributes_of
from hydroelastic.physics.dofs import MOTIONS, body_name, dof_names

if TYPE_CHECKING:
    from hydroelastic.fem.tank.mode_shapes import ModeShapes


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


def tank_variables(solution: TankSolution, shapes: ModeShapes) -> Iterator[Variable]:
    """Yield the shapes of all modes, the growing ones apart, and the matrices of floats."""
    asked = len(shapes.curves) - shapes.growing
    for modes, prefix in ((slice(0, asked), ""), (slice(asked, None), "growing_")):
        if shapes.curves[modes]:
            yield from _modes(solution, shapes, modes, prefix)
    if solution.tank.rigid:
        yield from _matrices(solution)


def _modes(solution: TankSolution, shapes: ModeShapes, modes: slice, prefix: str) -> Iterator[Variable]:
    """Shapes of some of the modes; their names and that of the dimension of modes begin with the prefix."""
    yield _variable(_MODE, np.arange(1, len(shapes.curves[modes]) + 1, dtype=np.int32), prefix=prefix)
    names = _curve_names(solution, shapes)
    for name, curves in zip(names, zip(*shapes.curves[modes], strict=True), strict=True):
        yield _variable(_PLACE, curves[0].x, name)
        moved = [curve.displacement for curve in curves]
        found = _variable(_BEAM if curves[0].kind == "body" else _SURFACE, moved, name, prefix)
        yield replace(found, attributes={**found.attributes, "level_at_rest": curves[0].level})
    for index, sections in zip(solution.tank.rigid, zip(*shapes.floats[modes], strict=True), strict=True):
        yield Variable(name="axis", dimensions=("axis",), values=np.array(["x", "y"]))
        yield _variable(_CONTOUR, sections[0].contour, body_name(index + 1))
        yield _variable(_MOVED, [section.displacement for section in sections], body_name(index + 1), prefix)
    if solution.tank.rigid:
        yield from _labels(solution, "dof")
        motions = [np.concatenate(motions) for motions in shapes.motions[modes]]
        yield _variable(_MOTION, motions, prefix=prefix, turning=bool(_turns(solution).any()))


def _variable(quantity: Quantity, values: Any, place: str = "", prefix: str = "", *, turning: bool = True) -> Variable:
    name, *dimensions = (text.format(place=place) for text in (quantity.key, *quantity.dimensions))
    return Variable(
        name=f"{prefix}{name}",
        dimensions=tuple(f"{prefix}mode" if one == "mode" else one for one in dimensions),
        values=np.asarray(values),
        attributes=attributes_of(quantity if turning else replace(quantity, of_roll=())),
    )


def _curve_names(solution: TankSolution, shapes: ModeShapes) -> list[str]:
    """Names of curves: beams, which are first, by their numbers among the bodies; pieces of a level from the left."""
    names, counts = [body_name(index + 1) for index in solution.tank.elastic], Counter[str]()
    for curve in shapes.curves[0][len(names) :]:
        counts[curve.kind] += 1
        names.append(f"{curve.kind}_{counts[curve.kind]}")
    return names


def _labels(solution: TankSolution, dimension: str) -> Iterator[Variable]:
    """The motions of all floats along a dimension, in Capytaine's names."""
    dofs = dof_names(() if body.is_elastic else body.rigid_motions for body in solution.tank.bodies)
    yield Variable(name=dimension, dimensions=(dimension,), values=np.array([dof.capitalised for dof in dofs]))


def _turns(solution: TankSolution) -> NDArray[np.float64]:
    return np.concatenate([body.is_rotation for body in solution.tank.floats.values()])


def _matrices(solution: TankSolution) -> Iterator[Variable]:
    """Inertia and hydrostatics of the floats, and their added mass at infinite frequency, in Capytaine's names."""
    # Without floats it is not needed, and takes a while to import.
    from scipy.linalg import block_diag

    floats, units, turns = solution.tank.floats.values(), solution.units, _turns(solution)
    masses = units.density * units.length ** (2.0 + turns[:, None] + turns)
    places = [[MOTIONS.index(motion) for motion in body.motions] for body in floats]
    inertia = block_diag(*(np.diag(body.inertia[place]) for body, place in zip(floats, places, strict=True)))
    stiffness = block_diag(
        *(body.hydrostatics.stiffness[np.ix_(place, place)] for body, place in zip(floats, places, strict=True))
    )
    matrices = [(_MASSES, inertia * masses), (_STIFFNESS, stiffness * masses * units.frequency**2)]
    if solution.added_mass is not None:
        matrices.append((_ADDED, solution.added_mass.matrix * masses))
    for quantity, matrix in matrices:
        yield _variable(quantity, matrix, turning=bool(turns.any()))
    for dimension in _MASSES.dimensions:
        yield from _labels(solution, dimension)
