"""Description of the model of a scene and of its first attempt, before anything is solved."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from hydroelastic.fem.bodies.registry import ends_of_motions, expected_tones
from hydroelastic.fem.cost import cost
from hydroelastic.fem.tank.resolution import (
    Resolution,
    infinite_frequency_resolution,
    initial_resolution,
    workable_tolerance,
)
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
    tolerance = scene.accuracy.tolerance
    tones = expected_tones(tank)
    motions = ends_of_motions(tank)
    resolution = initial_resolution(tank, tolerance, modes=scene.accuracy.modes, tones=tones, motions=motions)
    half = scene.mesh is None and is_mirror_image(tank)
    words, unknowns = _size(tank, resolution, user_mesh, half=half)
    yield f"First attempt: {words}."
    if user_mesh is not None and BAFFLE in user_mesh.facet_names:
        yield f"  The mesh has {user_mesh.facet_measure(BAFFLE):.5g} m of baffles, with ψ_n = 0 on both sides."
    if resolution.modes > scene.accuracy.modes:
        what = (
            "the modes that share the first elastic tone"
            if tank.elastic
            else "the mode with the largest motion of a float"
        )
        yield f"  {resolution.modes} modes are computed, to find {what}."
    dry_modes = "dry modes extend beyond that wave until their energy is negligible, " if tank.elastic else ""
    where = "tips" if not tank.hulls else "tips, corners and contact points"
    yield (
        f"  Enough for {tolerance:g}: elements follow the shortest wave of the modes reported and the degree, "
        f"{dry_modes}and the rings end where the singularity at the {where} is negligible. "
        "The solution estimates its errors and is refined accordingly."
    )
    workable = workable_tolerance(tolerance, tank.depth)
    if workable > tolerance:
        yield f"  Double precision cannot reach {tolerance:g} here: the tolerance is {workable:.0e} instead."
    limits = [
        *(["the first elastic tone"] if tank.elastic and tank.has_waves else []),
        *(["the added mass of the floats"] if tank.rigid and tank.has_infinite_frequency_limit else []),
    ]
    if limits:
        limit = infinite_frequency_resolution(tank, tolerance, tones) if scene.mesh is None else resolution
        size, more = _size(tank, limit, user_mesh, half=half, infinite_frequency=scene.mesh is None)
        unknowns += more
        two = "in the limit of infinite frequency, with ρψ continuous"
        where = "with ψ = 0 on the water" if len(tank.layers) == 1 else two
        yield f"In addition, {' and '.join(limits)} {where}: {size}."
        yield "  There are no waves to resolve, but a stronger singularity at the tips."
    yield str(cost(unknowns, resolution.degree, scene.accuracy.modes, "section", parts=1 + half))


def _user_mesh(scene: TankParts) -> TaggedMesh | None:
    if scene.mesh is None:
        return None
    # Only scenes with a user mesh need this import.
    from hydroelastic.scenes.tank.user_mesh import read_user_mesh

    return read_user_mesh(scene)


def _size(
    tank: Tank, resolution: Resolution, user_mesh: TaggedMesh | None, *, half: bool, infinite_frequency: bool = False
) -> tuple[str, int]:
    from hydroelastic.fem.tank.mesh import make_mesh, unknown_count

    mesh = (
        user_mesh
        if user_mesh is not None
        else make_mesh(tank, resolution, half=half, infinite_frequency=infinite_frequency)
    )
    where = " in half the tank" if half else ""
    twice = ", for symmetric and for antisymmetric modes" if half else ""
    layers = 1 if infinite_frequency else len(tank.layers)
    unknowns = unknown_count(len(mesh.points), len(mesh.cells), resolution.degree, parts=layers)
    parts = [
        f"degree {resolution.degree}",
        f"{len(mesh.cells)} triangles{where}",
        f"{unknowns} unknowns of ψ{twice}",
    ]
    if tank.elastic:
        parts.append(f"{' + '.join(str(resolution.shapes[index]) for index in tank.elastic)} dry modes")
    return ", ".join(parts), unknowns


def _request(scene: TankParts) -> str:
    source = "built-in mesh" if scene.mesh is None else f"mesh {scene.mesh.file}"
    return (
        f"The lowest {scene.accuracy.modes} modes to a relative error of {scene.accuracy.tolerance:g} "
        f"in frequency; {source}."
    )
