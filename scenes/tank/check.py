"""Description of the model of a scene and of its first attempt, before anything is solved."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from hydroelastic.fem.closed.discretization import (
    Discretization,
    discretization_of_limit,
    discretization_of_modes,
    sought_modes,
    workable_tolerance,
)
from hydroelastic.fem.closed.outline import singular_points, tank_outline, tank_triangles
from hydroelastic.fem.cost import cost
from hydroelastic.fem.tank.mesh import unknown_count
from hydroelastic.meshes.geometry import BAFFLE
from hydroelastic.meshes.tagged_mesh import MeshError, TaggedMesh
from hydroelastic.output.sections import Section
from hydroelastic.physics.symmetry import is_mirror_image
from hydroelastic.physics.tank import Tank
from hydroelastic.scenes.errors import cannot_be_meshed
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank_parts import TankParts
from hydroelastic.scenes.tank.check_hints import hints
from hydroelastic.scenes.tank.check_tables import boundary_table, group_table, hydrostatics_table, unknown_table


def check_tank(scene: TankParts) -> Iterator[Section]:
    """Yield the description of a closed tank, the size of its model, and hints; only the built-in meshes are made."""
    try:
        sizes = tuple(_sizes(scene))
    except MeshError as error:
        raise cannot_be_meshed(error, scene) from error
    return modelled_tank(scene, requests=(_request(scene),), scale=Section(title="Size", lines=sizes))


def modelled_tank(scene: TankParts, *, requests: Iterable[str], scale: Section) -> Iterator[Section]:
    """Yield the surfaces, the unknown fields, the dimensionless groups, hydrostatics of floats, and hints."""
    yield Section(title="What is asked", lines=tuple(requests))
    yield boundary_table(scene)
    yield unknown_table(scene)
    yield group_table(scene)
    at_rest = hydrostatics_table(scene)
    if at_rest.rows:
        yield at_rest
    yield scale
    expected = hints(scene)
    if expected:
        yield Section(title="What to expect", notes=expected)


def _sizes(scene: TankParts) -> Iterator[str]:
    """Yield the first attempt, and why it should be enough; the built-in meshes are made to count their unknowns."""
    tank, user_mesh = physical_tank(scene).scaled(), _user_mesh(scene)
    tolerance, workable = scene.accuracy.tolerance, workable_tolerance(scene.accuracy.tolerance, tank.depth)
    sought = sought_modes(tank, scene.accuracy.modes)
    half = scene.mesh is None and is_mirror_image(tank)
    discretization = discretization_of_modes(tank, workable, sought)
    words, unknowns = _size(tank, discretization, user_mesh, half=half)
    yield f"First attempt: {words}."
    if user_mesh is not None and BAFFLE in user_mesh.facet_names:
        yield f"  The mesh has {user_mesh.facet_measure(BAFFLE):.5g} m of baffles, with ψ_n = 0 on both sides."
    if sought.modes > scene.accuracy.modes:
        what = (
            "the modes that share the first elastic tone"
            if tank.elastic
            else "the mode with the largest motion of a float"
        )
        yield f"  {sought.modes} modes are computed, to find {what}."
    dry_modes = "dry modes extend beyond that wave until their energy is negligible, " if tank.elastic else ""
    where = "tips" if not tank.hulls else "tips, corners and contact points"
    yield (
        f"  Enough for {tolerance:g}: elements follow the shortest wave of the modes reported and the degree, "
        f"{dry_modes}and those at the {where} follow the singularity there. "
        "The solution estimates its errors and is refined accordingly."
    )
    if workable > tolerance:
        yield f"  Double precision cannot reach {tolerance:g} here: the tolerance is {workable:.0e} instead."
    limits = [
        *(["the first elastic tone"] if tank.elastic and tank.has_waves else []),
        *(["the added mass of the floats"] if tank.rigid and tank.has_infinite_frequency_limit else []),
    ]
    if limits:
        size, more = _size(tank, discretization_of_limit(tank, workable), user_mesh, half=half, released=True)
        unknowns += more
        two = "in the limit of infinite frequency, with ρψ continuous"
        where = "with ψ = 0 on the water" if len(tank.layers) == 1 else two
        yield f"In addition, {' and '.join(limits)} {where}: {size}."
        yield "  There are no waves to resolve, but a stronger singularity at the tips."
    yield str(cost(unknowns, discretization.degree, scene.accuracy.modes, "section", parts=1 + half))


def _user_mesh(scene: TankParts) -> TaggedMesh | None:
    if scene.mesh is None:
        return None
    # Only scenes with a user mesh need this import.
    from hydroelastic.scenes.tank.user_mesh import read_user_mesh

    return read_user_mesh(scene)


def _size(
    tank: Tank, own: Discretization, user_mesh: TaggedMesh | None, *, half: bool, released: bool = False
) -> tuple[str, int]:
    if user_mesh is not None:
        meshes = [user_mesh.cells]
    else:
        outline = tank_outline(tank, own.sizes, half=half)
        meshes = tank_triangles(tank, outline, singular_points(tank, half=half, released=released), own).of_layers()
    cells = sum(map(len, meshes))
    unknowns = sum(unknown_count(len(np.unique(mesh)), len(mesh), own.degree) for mesh in meshes)
    where = " in half the tank" if half else ""
    twice = ", for symmetric and for antisymmetric modes" if half else ""
    parts = [f"degree {own.degree}", f"{cells} triangles{where}", f"{unknowns} unknowns of ψ{twice}"]
    if tank.elastic:
        parts.append(f"{' + '.join(str(own.dry_modes[index]) for index in tank.elastic)} dry modes")
    return ", ".join(parts), unknowns


def _request(scene: TankParts) -> str:
    source = "built-in mesh" if scene.mesh is None else f"mesh {scene.mesh.file}"
    return (
        f"The lowest {scene.accuracy.modes} modes to a relative error of {scene.accuracy.tolerance:g} "
        f"in frequency; {source}."
    )
