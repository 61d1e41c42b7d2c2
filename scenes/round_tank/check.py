"""Description of a tank of revolution, before anything is solved."""

from __future__ import annotations

from collections.abc import Iterator

from hydroelastic.fem.bodies.registry import ends_of_motions, expected_tones
from hydroelastic.fem.cost import Cost, cost
from hydroelastic.fem.tank.resolution import initial_resolution
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.output.open_water.bodies import bodies_at_rest_section
from hydroelastic.output.sections import Row, Section
from hydroelastic.scenes.errors import cannot_be_meshed
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.round_tank import OrderedTankScene


def check_round_tank(scene: OrderedTankScene) -> Iterator[Section]:
    """Yield what is asked, the tank, and the floats at rest."""
    asked = scene.accuracy
    expected = _cost(scene)
    outline = scene.bed
    if outline is None:
        bed = "level bed"
    elif outline == "sphere":
        depth, radius = scene.liquid[0].depth, scene.tank.length
        bed = f"bed that is part of a sphere of radius {0.5 * (radius**2 + depth**2) / depth:g} m"
    else:
        parts, part = len(outline) - 1, "cone" if scene.is_revolved else "plane"
        bed = f"bed of {parts} {part}s" if parts > 1 else f"bed that is a {part}"
    if scene.is_revolved:
        what = (
            f"A tank of revolution of radius {scene.tank.length:g} m with a {bed}, order by order in the half-plane "
            "(r, z): ψ cos nθ"
        )
        moved = ", heave in order 0, surge and pitch in order 1"
    else:
        what = (
            f"A section of {scene.tank.length:g} m with a {bed} over a width B = {scene.tank.width:g} m, order by "
            "order: ψ cos(nπs/B) across it"
        )
        moved = "; floats move in order 0"
    yield Section(
        title="What is asked",
        lines=(
            f"The lowest {asked.modes} modes to a relative error of {asked.tolerance:g} in frequency.",
            f"{what}{moved if scene.floats else ''}.",
            str(expected),
        ),
    )
    yield Section(title="Unknown fields", headings=("field", "where", "why"), rows=tuple(_unknowns(scene)))
    if scene.body:
        yield bodies_at_rest_section(physical_tank(scene))


def _cost(scene: OrderedTankScene) -> Cost:
    """By the mesh of order 0, in about as many orders as the plan of the highest mode has half waves, and two more."""
    from hydroelastic.fem.tank.mesh import make_mesh, unknown_count  # it brings gmsh

    tank, asked = physical_tank(scene).of_order(0).scaled(), scene.accuracy
    tones, motions = expected_tones(tank), ends_of_motions(tank)
    resolution = initial_resolution(tank, asked.tolerance, modes=asked.modes, tones=tones, motions=motions)
    try:
        mesh = make_mesh(tank, resolution)
    except MeshError as error:
        raise cannot_be_meshed(error, scene) from error
    unknowns = unknown_count(len(mesh.points), len(mesh.cells), resolution.degree, parts=len(tank.layers))
    return cost(unknowns, resolution.degree, asked.modes, "section", parts=2.0 * asked.modes**0.5 + 2.0)


def _unknowns(scene: OrderedTankScene) -> Iterator[Row]:
    where = "in the half-plane (r, z)" if scene.is_revolved else "in the section"
    yield "ψ", f"{where}, of each order", "an ideal liquid that starts from rest has a potential"
    if len(scene.liquid) > 1:
        yield "η", "on the interface of the liquids", "it keeps internal waves"
    if scene.tank.top == "free":
        yield "η", "on the still surface", "it keeps gravity waves"
    for index, body in scene.floats:
        yield f"motions of float {index + 1}", ", ".join(body.motions), "it is rigid"
    for index, plate in scene.plates:
        what = "it is rigid" if plate.rigid else "it bends in its dry modes of each order"
        yield f"w of plate {index + 1}", f"r from {plate.start:g} to {plate.end:g} m, w = Σ aᵢ Wᵢ(r) cos nθ", what
