"""Mesh and assemble the field model of open water for a range of frequencies."""

from __future__ import annotations

from dataclasses import replace
from math import isfinite

from hydroelastic.fem.closed.outline import zero_on_axis, zero_potential_surfaces
from hydroelastic.fem.liquid import LiquidSpace, liquid_space
from hydroelastic.fem.open_water.basin import AbsorbingLayer, OpenBasin, open_basin, sized_absorbing_layer
from hydroelastic.fem.open_water.field_model import ANGLE, ANGLE_OVER_A_BED, GROWTH, Band, OpenModel, scaling_of
from hydroelastic.fem.open_water.pencil import build_open_pencil
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.tank.field_model import distributed_mesh, moving_surfaces, tank_layers, whole_bodies
from hydroelastic.fem.tank.mesh import graded_outline, unknown_count
from hydroelastic.fem.tank.resolution import (
    Resolution,
    radians,
    resolution_for,
    sharpest_exponent,
    workable_tolerance,
)
from hydroelastic.meshes.build import build_mesh
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.meshes.geometry import FAR_END
from hydroelastic.meshes.open_sea import extended, with_far_ends
from hydroelastic.meshes.tagged_mesh import TaggedMesh
from hydroelastic.modal.liquid.travelling_waves import travelling_waves
from hydroelastic.physics.local_waves import moving_parts
from hydroelastic.physics.tank import Tank

# Where only one coordinate is rotated, polynomials in a layer of cells converge more slowly.
_GROWTH_OVER_A_BED = 2.0

# Innermost rings at the corners of sections over those of tanks: errors there are relative to the waves, which move
# bodies by up to several times their height. Measured on a barge at tolerances from 1e-3 to 1e-5, its resonance
# included: 0.7 to 2 tolerances with those of tanks, a twelfth of it with these.
_TIPS = 0.25
# An upper liquid deeper than this, in radians of an interface wave, decouples its surface from that wave.
_DECOUPLED = 20.0


def first_resolution(water: Tank, tolerance: float, band: Band, *, drawn: float | None = None) -> Resolution:
    """Return the initial resolution of open water, or of the length of a picture."""
    basin = open_basin(water, band.wavenumbers(water)[1], drawn=drawn, reach=band.reach)
    tank = basin.tank
    length = basin.units.length
    shortest = {wave.branch: wave.wavenumber * length for wave in travelling_waves(basin.layers, band.highest)}
    squared = (band.highest / basin.units.frequency) ** 2
    meshed, flexural = [], []
    for level in tank.levels:
        own = max(shortest.values())
        if level.below == 1 and own * tank.layers[1].depth > _DECOUPLED:
            own = shortest.get("surface", 0.0)
        for piece in level.pieces:
            bent = max((moving.wavenumber(squared) for moving in moving_parts(tank, level, piece)), default=0.0)
            flexural.append(bent if piece.body is not None else 0.0)
            # Waves scattered under a beam are as short as the incident ones.
            meshed.append(0.0 if piece.body in tank.hulls else max(own, flexural[-1]))
    tolerance = workable_tolerance(tolerance, tank.depth)
    exponent = sharpest_exponent(tank, infinite_frequency=False)
    # The dry modes of a beam follow from its flexural waves alone.
    shapes = resolution_for(tank, tolerance, tuple(flexural), exponent=exponent).shapes
    resolution = resolution_for(tank, tolerance, tuple(meshed), exponent=exponent)
    if exponent < 1.0 and not tank.geometry.is_revolved:
        resolution = resolution.with_tips(_TIPS)
    return replace(resolution, shapes=shapes)


def open_model(
    problem: OpenWaterProblem,
    band: Band,
    resolution: Resolution,
    *,
    angle: float | None = None,
    drawn: float | None = None,
) -> OpenModel:
    """Mesh and assemble open water (collective)."""
    basin, absorbing_layer = _laid(problem.tank, problem.tolerance, band, resolution, angle=angle, drawn=drawn)
    tank = basin.tank
    mesh = distributed_mesh(problem.comm, lambda: open_mesh(basin, resolution, absorbing_layer))
    liquid = _liquid(basin, resolution, mesh)
    pencil = build_open_pencil(
        liquid,
        scaling_of(basin, absorbing_layer),
        bodies=whole_bodies(tank, resolution.shapes),
        surfaces=moving_surfaces(mesh, tank),
    )
    return OpenModel(
        basin=basin,
        resolution=resolution,
        absorbing_layer=absorbing_layer,
        shortest=band.wavenumbers(problem.tank)[1] * basin.units.length,
        tolerance=problem.tolerance,
        pencil=pencil,
        attachments=problem.tank.attachments,
    )


def first_size(water: Tank, tolerance: float, band: Band) -> tuple[int, int, int]:
    """Return cells, degree and unknowns of ψ of the first mesh of `open_model`, which is made on this process."""
    resolution = first_resolution(water, tolerance, band)
    basin, absorbing_layer = _laid(water, tolerance, band, resolution, angle=None, drawn=None)
    mesh = open_mesh(basin, resolution, absorbing_layer)
    return len(mesh.cells), resolution.degree, unknown_count(len(mesh.points), len(mesh.cells), resolution.degree)


def _laid(
    water: Tank, tolerance: float, band: Band, resolution: Resolution, *, angle: float | None, drawn: float | None
) -> tuple[OpenBasin, AbsorbingLayer]:
    wavenumbers = band.wavenumbers(water)
    basin = open_basin(water, wavenumbers[1], drawn=drawn, reach=band.reach)
    length = basin.units.length
    tolerance = workable_tolerance(tolerance, basin.tank.depth)
    has_bed = any(isfinite(depth) for depth in basin.depths)
    if angle is None:
        angle = ANGLE_OVER_A_BED if has_bed else ANGLE
    absorbing_layer = sized_absorbing_layer(
        basin,
        (wavenumbers[0] * length, wavenumbers[1] * length),
        first=radians(resolution.degree, tolerance),
        growth=_GROWTH_OVER_A_BED if has_bed else GROWTH,
        angle=angle,
        tolerance=tolerance,
    )
    return basin, absorbing_layer


def _liquid(basin: OpenBasin, resolution: Resolution, mesh: TankMesh) -> LiquidSpace:
    tank = basin.tank
    zero_potential = (FAR_END, *zero_potential_surfaces(tank, infinite_frequency=False), *zero_on_axis(tank))
    return liquid_space(mesh, resolution.degree, zero_potential, tank_layers(tank), geometry=tank.geometry)


def open_mesh(
    basin: OpenBasin, resolution: Resolution, absorbing_layer: AbsorbingLayer, *, infinite_frequency: bool = False
) -> TaggedMesh:
    """Return the mesh of the basin by gmsh with its absorbing layer, on the calling process."""
    curved = any(not hull.is_thin for hull in basin.tank.hulls.values())
    mesh = build_mesh(
        graded_outline(basin.tank, resolution, half=False, infinite_frequency=infinite_frequency),
        bulk_size=resolution.bulk_size,
        ring_ratio=resolution.ring_ratio,
        geometry_degree=resolution.degree if curved else 1,
    )
    for sides, stage in absorbing_layer.stages(basin):
        mesh = extended(mesh, sides, stage)
    return with_far_ends(mesh, basin.far_sides)
