"""Results of a closed tank as labelled arrays: the shape of each mode, and the matrices of floats."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import block_diag

from hydroelastic.output.dof_units import INERTIA_UNITS, MOTION_UNITS, STIFFNESS_UNITS
from hydroelastic.output.labelled import Labelled, labelled
from hydroelastic.output.summary_names import SummaryNames
from hydroelastic.physics.dofs import Dof, body_name, dof_names
from hydroelastic.physics.motions import MOTIONS

if TYPE_CHECKING:
    import xarray

    from hydroelastic.fem.pictures.mode import FloatSection, SurfaceCurve
    from hydroelastic.fem.tank.mode_shapes import ModeShapes
    from hydroelastic.fem.tank.solve import TankSolution

TANK_NAMES = SummaryNames(
    by_place={
        "modes": ("mode",),
        "first_elastic_by_body": ("elastic_body",),
        "floats": ("float",),
        "floats.motions": ("float_motion",),
        "floats.modes": ("float_mode",),
        "floats.centre_of_mass": ("axis",),
        "floats.waterplane": ("side",),
        "floats.estimates": ("float_estimate",),
        "floats.printed_constants": ("printed_constant",),
        "growing": ("growing_mode",),
        "estimates": ("estimate",),
        "exact": ("exact_mode",),
    },
    prefixes={
        "modes": "",
        "first_elastic_by_body": "first_elastic",
        "floats": "float",
        "floats.modes": "float_mode",
        "floats.estimates": "float_estimate",
        "floats.printed_constants": "constant",
        "estimates": "estimate",
    },
    # The first tone of the first beam is among those of all beams.
    reported_by_arrays=frozenset({"first_elastic", "floats.high_frequency.added_mass"}),
)


def tank_dataset(solution: TankSolution, shapes: ModeShapes) -> xarray.Dataset:
    """Return the shapes of all modes along surfaces and bodies, and the matrices of floats.

    Args:
        solution: the field solution.
        shapes: mode shapes, in SI units.
    """
    # xarray takes a while to import.
    import xarray

    asked = len(shapes.curves) - shapes.growing
    parts = [
        _modes(solution, shapes, slice(0, asked), "mode", ""),
        _modes(solution, shapes, slice(asked, None), "growing_mode", "growing_"),
        _matrices(solution),
    ]
    return xarray.merge(parts, join="exact", compat="no_conflicts")


def _modes(solution: TankSolution, shapes: ModeShapes, modes: slice, dimension: str, prefix: str) -> xarray.Dataset:
    """Shapes of some of the modes, along a dimension of the modes."""
    import xarray

    found = xarray.Dataset()
    if not shapes.curves[modes]:
        return found
    numbers = np.arange(1, len(shapes.curves[modes]) + 1, dtype=np.int32)
    found = found.assign_coords({dimension: (dimension, numbers, {"long_name": "number of the mode"})})
    names = _curve_names(solution, shapes.curves[0])
    for name, curves in zip(names, zip(*shapes.curves[modes], strict=True), strict=True):
        found = found.merge(_curve(name, curves, dimension, prefix))
    for index, sections in zip(solution.tank.rigid, zip(*shapes.floats[modes], strict=True), strict=True):
        found = found.merge(_section(body_name(index + 1), sections, dimension, prefix))
    if solution.tank.rigid:
        dofs = [dof.capitalised for dof in _dofs(solution)]
        amplitudes = np.array([np.concatenate(motions) for motions in shapes.motions[modes]])
        said = {
            "long_name": "motion of the floats",
            "units": MOTION_UNITS[any(dof.is_rotation for dof in _dofs(solution))],
        }
        found = found.assign({f"{prefix}motion": ((dimension, "dof"), amplitudes, said)}).assign_coords(dof=dofs)
    return found


def _curve_names(solution: TankSolution, curves: tuple[SurfaceCurve, ...]) -> list[str]:
    """Names of curves: beams, which are first, by their numbers among the bodies; pieces of a level from the left."""
    names, counts = [body_name(index + 1) for index in solution.tank.elastic], Counter[str]()
    for curve in curves[len(names) :]:
        counts[curve.kind] += 1
        names.append(f"{curve.kind}_{counts[curve.kind]}")
    return names


def _curve(name: str, curves: tuple[SurfaceCurve, ...], dimension: str, prefix: str) -> xarray.Dataset:
    what, along = "deflection" if curves[0].kind == "body" else "elevation", f"position_on_{name}"
    displaced, moved = f"{prefix}{what}_of_{name}", np.array([curve.displacement for curve in curves])
    found = labelled(
        {displaced: ((dimension, along), moved, "m", f"upward {what} of {name}")},
        {along: (along, curves[0].x, "m", "distance from the left wall")},
    )
    found[displaced].attrs["level_at_rest"] = curves[0].level
    return found


def _section(name: str, sections: tuple[FloatSection, ...], dimension: str, prefix: str) -> xarray.Dataset:
    point = f"point_on_{name}"
    moved = np.array([section.displacement for section in sections])
    along = (dimension, point, "axis")
    return labelled(
        {
            f"{prefix}displacement_of_{name}": (along, moved, "m", f"displacement of the contour of {name}"),
            f"contour_of_{name}": ((point, "axis"), sections[0].contour, "m", f"contour of {name} at rest"),
        },
        {},
        {"axis": ("x", "y")},
    )


def _dofs(solution: TankSolution) -> tuple[Dof, ...]:
    """Motions of all floats."""
    return dof_names(() if body.is_elastic else body.rigid_motions for body in solution.tank.bodies)


def _matrices(solution: TankSolution) -> xarray.Dataset:
    """Inertia and hydrostatics of the floats, and their added mass at infinite frequency, in Capytaine's names."""
    import xarray

    floats, units = solution.tank.floats.values(), solution.units
    if not floats:
        return xarray.Dataset()
    dofs = [dof.capitalised for dof in _dofs(solution)]
    turns = np.concatenate([body.is_rotation for body in floats])
    masses = units.density * units.length ** (2.0 + turns[:, None] + turns)
    places = [[MOTIONS.index(motion) for motion in body.motions] for body in floats]
    inertia = block_diag(*(np.diag(body.inertia[place]) for body, place in zip(floats, places, strict=True)))
    stiffness = block_diag(*(body.stiffness[np.ix_(place, place)] for body, place in zip(floats, places, strict=True)))
    turning, rows = bool(turns.any()), ("influenced_dof", "radiating_dof")
    said = "hydrostatic stiffness of the floats"
    matrices: dict[str, Labelled] = {
        "inertia_matrix": (rows, inertia * masses, INERTIA_UNITS[turning], "inertia of the floats"),
        "hydrostatic_stiffness": (rows, stiffness * masses * units.frequency**2, STIFFNESS_UNITS[turning], said),
    }
    if solution.added_mass is not None:
        added, said = solution.added_mass.matrix * masses, "added mass at infinite frequency"
        matrices["infinite_frequency_added_mass"] = (rows, added, INERTIA_UNITS[turning], said)
    return labelled(matrices, {}, dict.fromkeys(rows, dofs))
