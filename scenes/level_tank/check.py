"""Description of the model of a tank in three dimensions, before anything is solved."""

from __future__ import annotations

from collections.abc import Iterator

from hydroelastic.fem.cost import DIRECT_UNKNOWNS, cost, free_memory
from hydroelastic.fem.level_bed.resolution import expected_eigenvalue, line_nodes, line_resolution, workable
from hydroelastic.fem.level_bed.separation import separated
from hydroelastic.output.digits import number
from hydroelastic.output.level_tank.floats import floats_at_rest, floats_section
from hydroelastic.output.sections import Row, Section
from hydroelastic.physics.level_tank import Box, Cylinder, FilePlan, LevelTank
from hydroelastic.physics.obstacles import VerticalBaffle
from hydroelastic.physics.plate import Disc
from hydroelastic.physics.volume_tank import SlopingBed, VolumeTank
from hydroelastic.scenes.errors import cannot_be_meshed
from hydroelastic.scenes.level_tank.solve import misplacements, require_treated
from hydroelastic.scenes.models.level_tank import LevelTankScene
from hydroelastic.scenes.models.level_tank_physics import physical_level_tank

_TRIANGLES = 2.3  # with the size of a square's side, in it
MOST_CHECKED = 200_000
"""Tetrahedra that are made for a check: gmsh makes 27,000 in a second."""
_TOPS = {
    "free": "gψ_z = ω²ψ, a free surface with waves",
    "rigid": "ψ_z = 0, a rigid lid",
    "pressure_release": "ψ = 0, without gravity waves",
}


def check_level_tank(scene: LevelTankScene) -> Iterator[Section]:
    """Yield what is asked, the boundaries, the unknowns, the plates' dimensionless groups, and the size."""
    require_treated(scene)
    tank = physical_level_tank(scene)
    asked = scene.accuracy
    yield Section(
        title="What is asked",
        lines=(f"The lowest {asked.modes} modes to a relative error of {asked.tolerance:g} in frequency.",),
    )
    yield from floats_section(floats_at_rest(tank))
    yield Section(title="Boundaries", headings=("boundary", "condition"), rows=tuple(_boundaries(tank)))
    yield Section(title="Unknown fields", headings=("field", "where", "why"), rows=tuple(_unknowns(tank)))
    if tank.plates:
        yield Section(
            title="Plates",
            headings=("plate", "outline", "area, m²", "D/(ρ g A²)", "m/(ρ √A)", "hydrostatic", "edge at walls"),
            rows=tuple(_plates(scene, tank)),
        )
    yield Section(title="Size", lines=tuple(_size(scene, tank)))


def _boundaries(tank: LevelTank) -> Iterator[Row]:
    plan = tank.plan
    bed = tank.bed if isinstance(tank, VolumeTank) else None
    if isinstance(plan, Box):
        yield f"four walls around {plan.length:g} m × {plan.width:g} m", "ψ_n = 0"
    elif isinstance(plan, Cylinder):
        yield f"wall of radius {plan.radius:g} m", "ψ_r = 0"
        if plan.inner_radius:
            yield f"inner wall of radius {plan.inner_radius:g} m", "ψ_r = 0"
    elif isinstance(plan, FilePlan):
        yield f"walls and bed of {plan.file.name}, {plan.measures}", "ψ_n = 0"
    else:
        yield f"{len(plan.points)} walls around the plan", "ψ_n = 0"
    if isinstance(bed, SlopingBed):
        yield f"sloping bed, {tank.depth:g} m deep in the middle", "ψ_n = 0"
    elif bed is not None:
        yield f"bed through {len(bed.points)} points, up to {tank.depth:g} m deep", "ψ_n = 0"
    elif not isinstance(plan, FilePlan):
        yield f"level bed, {tank.depth:g} m deep", "ψ_z = 0"
    if isinstance(tank, VolumeTank):
        yield from _inside(tank)
    beside = "bodies" if isinstance(tank, VolumeTank) and tank.floats else "plates"
    yield f"top beside the {beside}", _TOPS[tank.top]
    for index, plate in enumerate(tank.plates, 1):
        motion = "ψ_z = w, which bends" if plate.is_elastic else "ψ_z = w, heave and pitch"
        yield f"plate {index}", motion


def _inside(tank: VolumeTank) -> Iterator[Row]:
    for index, outline in enumerate(tank.columns, 1):
        size = f"radius {outline.radius:g} m" if isinstance(outline, Disc) else "{:g} m × {:g} m".format(*outline.size)
        yield f"column {index} of {size}", "ψ_n = 0"
    for index, baffle in enumerate(tank.baffles, 1):
        kind = "vertical" if isinstance(baffle, VerticalBaffle) else "horizontal"
        yield f"{kind} baffle {index}", "ψ_n = 0 on both sides, between which ψ jumps"
    if tank.lower is not None and tank.interface is not None:
        jump = f"g[ρψ_z] = ω²[ρψ], {tank.lower.density:g} kg/m³ under {tank.density:g} kg/m³"
        yield f"interface, {-tank.interface:g} m deep", jump
    for index, solid in enumerate(tank.floats, len(tank.plates) + 1):
        yield f"float {index}, {solid.shape} of {solid.draught:g} m draught", f"ψ_n = u·n, {', '.join(solid.motions)}"


def _unknowns(tank: LevelTank) -> Iterator[Row]:
    if isinstance(tank, VolumeTank):
        yield "ψ", "in all of the liquid", "Laplace's equation on tetrahedra"
    else:
        yield "ψ", "on the surface", "over a level bed it follows below as cosh k(z + H)/cosh kH of each part"
    if tank.top == "free":
        yield "η", "water", "it keeps gravity waves"
    if isinstance(tank, VolumeTank) and tank.lower is not None:
        yield "η of the interface", "between the liquids", "it keeps internal waves"
    for index, plate in enumerate(tank.plates, 1):
        what = "its dry modes" if plate.is_elastic else "its rigid motions"
        yield f"w of plate {index}", what, "smooth, so that a few functions are enough"


def _plates(scene: LevelTankScene, tank: LevelTank) -> Iterator[Row]:
    for index, (given, plate) in enumerate(zip(scene.plates, tank.plates, strict=True), 1):
        area = plate.outline.area
        stiffness = plate.flexural_rigidity / (tank.density * tank.gravity * area**2)
        yield (
            str(index),
            given.outline,
            number(area),
            f"{stiffness:.3g}" if plate.is_elastic else "rigid",
            f"{plate.mass_per_area / (tank.density * area**0.5):.3g}",
            "yes" if plate.hydrostatic else "no",
            plate.edge,
        )


def _size(scene: LevelTankScene, tank: LevelTank) -> Iterator[str]:
    scaled = tank.scaled()
    asked = scene.accuracy
    if isinstance(scaled, VolumeTank):
        yield from _size_of_volume(scene, scaled, asked.tolerance, asked.modes)
        return
    separation = separated(scaled)
    if separation is None:
        yield from _size_of_plan(scaled, asked.tolerance, asked.modes)
        return
    tolerance = workable(asked.tolerance)
    highest = expected_eigenvalue(scaled, asked.modes, multiplicity=separation.multiplicity(1))
    resolution = line_resolution(scaled, separation, tolerance, highest)
    elements = len(line_nodes(separation, resolution, scaled.depth)) - 1
    along = "r, cos nθ and sin nθ about the axis" if separation.round else "x, cos nπy/B across"
    yield f"Upright tank with a level bed: one problem for each order n along {along}, exact in depth; no volume mesh."
    shapes = f", {' + '.join(map(str, resolution.shapes))} dry modes" if any(resolution.shapes) else ""
    yield (
        f"First attempt, each order: degree {resolution.degree}, {elements} elements, "
        f"{elements * resolution.degree + 1} unknowns of ψ{shapes}."
    )
    yield "  Orders are added until none can have a lower frequency than the modes found."
    yield "  Each is solved with one degree and one layer at the edges more too, from which its error follows."
    if tolerance > asked.tolerance:
        yield f"  Double precision cannot reach {asked.tolerance:g}: the tolerance is {tolerance:.0e} instead."
    unknowns, orders = elements * resolution.degree + 1, 2.0 * asked.modes**0.5 + 2.0
    yield str(cost(unknowns, resolution.degree, asked.modes, "level bed", orders))


def _size_of_plan(tank: LevelTank, tolerance: float, modes: int) -> Iterator[str]:
    from hydroelastic.fem.level_bed.choice import MODEL_WORDS
    from hydroelastic.fem.plan.plan import plan_resolution

    words = MODEL_WORDS["plan"]
    yield f"{words[0].upper()}{words[1:]}; no volume mesh."
    resolution = plan_resolution(tank, tolerance, expected_eigenvalue(tank, modes))
    layers = f"{resolution.layers} layers on each side of an edge"
    polynomials = " + ".join(map(str, resolution.polynomials))
    shapes = f", {polynomials} polynomials along each direction of the plates" if polynomials else ""
    yield f"First attempt: degree {resolution.degree}, {layers}{shapes}."
    yield "  Walls and plates with a plane of symmetry leave two problems of a half of the tank, with two planes four."
    yield "  The decay of ψ with the degree, and a bound for the poles, show the error of each mode."
    edges = resolution.layers * sum(4.0 * plate.outline.area**0.5 for plate in tank.plates) / resolution.size
    unknowns = 0.5 * resolution.degree**2 * (_TRIANGLES * tank.plan.area / resolution.size**2 + 2.0 * edges)
    yield str(cost(unknowns, resolution.degree, modes, "plan"))


def _size_of_volume(scene: LevelTankScene, tank: VolumeTank, tolerance: float, modes: int) -> Iterator[str]:
    from hydroelastic.fem.level_bed.choice import MODEL_WORDS
    from hydroelastic.fem.volume.distribution import unfolded_volume
    from hydroelastic.fem.volume.model import volume_mirrors
    from hydroelastic.fem.volume.resolution import expected_unknowns, volume_resolution, with_refinements
    from hydroelastic.meshes.plan_loops import image_count
    from hydroelastic.meshes.tagged_mesh import MeshError, TooManyCellsError
    from hydroelastic.meshes.tetrahedra import unknown_count
    from hydroelastic.meshes.volume import MOST_CELLS

    words = MODEL_WORDS["volume"]
    yield f"{words[0].upper()}{words[1:]}."
    mirrors = volume_mirrors(tank)
    resolution = volume_resolution(tank, tolerance, modes, mirrors)
    sizes, degree, parts = with_refinements(tank, resolution.sizes, mirrors), resolution.degree, image_count(mirrors)
    shapes = f", {' + '.join(map(str, resolution.polynomials))} polynomials along each direction of the plates"
    if parts > 1:
        yield f"  Planes of symmetry leave {parts} problems on {'a half' if parts == 2 else 'a quarter'} of the tank."
    refinements, about = 0, ""
    try:
        with misplacements():
            made = unfolded_volume(tank, sizes, mirrors, MOST_CHECKED)
        refinements = sizes.refinements if made.surfaces else 0
        cells, unknowns = len(made.noded.cells) * 8**refinements, unknown_count(made.noded, degree, refinements)
    except TooManyCellsError as error:
        if error.cells > MOST_CELLS:
            raise cannot_be_meshed(error, scene) from error
        about, cells = "too large to be meshed here, by its sizes about ", error.cells * 8**sizes.refinements
        unknowns = round(cells * degree**3 / 6.0)
    except MeshError as error:
        raise cannot_be_meshed(error, scene) from error
    yield (
        f"First attempt: {about}degree {degree}, {cells} tetrahedra, {unknowns} unknowns"
        f"{shapes if resolution.polynomials else ''}."
    )
    if refinements:
        yield f"  gmsh makes {cells // 8**refinements}, which all processes refine {refinements} times together."
    layered, free = bool(sizes.layers), free_memory()
    solver = "a factorization" if layered or unknowns <= DIRECT_UNKNOWNS else "multigrid over the polynomial degree"
    yield f"  Laplace's equation by {solver}."
    expected = cost(unknowns, degree, modes, "volume", parts, layered)
    if expected.memory > free:
        yield (
            f"  That needs {expected.memory / 1e9:.1f} GB, more than the {free / 1e9:.1f} GB that are free: "
            "a run ends at once. Ask for a larger tolerance or fewer modes."
        )
    usual = volume_resolution(tank, tolerance, modes, mirrors, severity=1.0)
    if usual != resolution:
        unknowns = round(expected_unknowns(tank, usual, mirrors))
        expected = cost(unknowns, usual.degree, modes, "volume", parts, bool(usual.sizes.layers))
        yield f"  Where it shows that the edges ask for more, about {unknowns:.1g} unknowns follow."
    yield str(expected)
    shown = "The decay of ψ with the degree" if resolution.degree > 2 else "What the third degree adds to ψ"
    yield f"  {shown}, and the volume of curved cells, show the error; where it is too large"
    yield "  cells are made smaller at the edges of plates, elsewhere, or at curved walls."
