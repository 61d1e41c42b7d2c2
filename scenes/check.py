"""What a scene will be modelled as, said before anything is solved."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

from rich.console import Console
from rich.table import Table
from rich.text import Text

from hydroelastic.modal.dry_modes import free_free_roots
from hydroelastic.scenes.estimates import expected_tones
from hydroelastic.scenes.models import Beam, Segment, TankScene, top_segments
from hydroelastic.scenes.plan import (
    Resolution,
    companion_resolution,
    initial_resolution,
    workable_tolerance,
)
from hydroelastic.scenes.scaled_tank import ScaledTank, scaled_tank
from hydroelastic.scenes.symmetry import is_mirror_image

SURFACE_NAMES = {"free": "free surface", "rigid": "rigid lid", "pressure_release": "pressure release"}
SURFACE_CONDITIONS = {
    "free": "∂ψ/∂y = η, g η = ω² ψ",
    "rigid": "∂ψ/∂y = 0",
    "pressure_release": "ψ = 0",
}
BEAM_ENDS = {"free": "w″ = w‴ = 0 at its ends", "guided": "w′ = w‴ = 0 at its ends"}


def print_check(scene: TankScene, console: Console) -> None:
    """Print the surfaces, the unknown fields, the dimensionless groups and what to expect of a scene.

    Args:
        scene: a validated scene; nothing is meshed or solved.
        console: where to print.
    """
    # Text, not str: a title may hold brackets, which rich would read as markup.
    console.print(Text(scene.title or "Untitled scene", style="bold"))
    console.print(Text(_request(scene)))
    for table in (_boundary_table(scene), _unknown_table(scene), _group_table(scene)):
        console.print(table)
    for line in _sizes(scene):
        console.print(Text(line))
    for hint in hints(scene):
        console.print(Text(f"• {hint}"))


def _sizes(scene: TankScene) -> Iterator[str]:
    """What the first attempt is, and why it should be enough; the built-in meshes are made to count them."""
    tank = scaled_tank(scene)
    tolerance = scene.accuracy.tolerance
    resolution = initial_resolution(scene, modes=scene.accuracy.modes, tones=expected_tones(tank))
    half = scene.mesh is None and is_mirror_image(tank)
    yield f"First attempt: {_size(scene, tank, resolution, half=half)}."
    if resolution.modes > scene.accuracy.modes:
        yield f"  {resolution.modes} modes are looked at, to see where the energy of the first elastic tone gathers."
    yield (
        f"  Enough for {tolerance:g}: elements follow the shortest wave of the modes reported and the degree, "
        "dry modes reach past that wave until their energy has died out, and the rings end where the singularity at "
        "the tips no longer counts. The solution judges itself, and what falls short is refined."
    )
    workable = workable_tolerance(tolerance, tank.depth)
    if workable > tolerance:
        yield f"  Double precision will not keep {tolerance:g} here: {workable:.0e} is worked towards instead."
    if tank.beams and tank.top == "free" and _has_open_top(scene):
        size = _size(
            scene,
            tank,
            companion_resolution(tank, tolerance, expected_tones(tank)) if scene.mesh is None else resolution,
            half=half,
        )
        yield f"Beside it the first elastic tone with ψ = 0 on the water: {size}, hardly a wave, sharper tips."


def _size(scene: TankScene, tank: ScaledTank, resolution: Resolution, *, half: bool) -> str:
    parts = [f"degree {resolution.degree}"]
    if scene.mesh is None:
        from hydroelastic.scenes.tank_mesh import make_mesh, unknown_count

        mesh = make_mesh(tank, resolution, half=half)
        where = " in half the tank" if half else ""
        twice = ", for symmetric and for antisymmetric modes" if half else ""
        parts.append(f"{len(mesh.cells)} triangles{where}")
        parts.append(f"{unknown_count(len(mesh.points), len(mesh.cells), resolution.degree)} unknowns of ψ{twice}")
    if resolution.shapes:
        parts.append(f"{' + '.join(map(str, resolution.shapes))} dry modes")
    return ", ".join(parts)


def _request(scene: TankScene) -> str:
    source = "built-in mesh" if scene.mesh is None else f"mesh {scene.mesh.file}"
    return (
        f"The lowest {scene.accuracy.modes} modes to a relative error of {scene.accuracy.tolerance:g} "
        f"in frequency; {source}."
    )


def _table(title: str, *headings: str) -> Table:
    table = Table(title=title, title_justify="left")
    for heading in headings:
        table.add_column(heading)
    return table


def _boundary_table(scene: TankScene) -> Table:
    table = _table("Boundary of the liquid (top from left to right)", "surface", "from, m", "to, m", "condition")
    for segment in top_segments(scene):
        table.add_row(
            _surface_name(segment), f"{segment.start:g}", f"{segment.end:g}", _surface_condition(scene, segment)
        )
    table.add_row("walls", f"{0:g}", f"{scene.tank.length:g}", "∂ψ/∂x = 0")
    table.add_row("bottom, y = " + f"{-scene.liquid[0].depth:g} m", f"{0:g}", f"{scene.tank.length:g}", "∂ψ/∂y = 0")
    return table


def _surface_name(segment: Segment) -> str:
    return SURFACE_NAMES[segment.kind] if segment.body is None else f"beam {segment.body + 1}"


def _surface_condition(scene: TankScene, segment: Segment) -> str:
    if segment.body is None:
        return SURFACE_CONDITIONS[segment.kind]
    beam = scene.body[segment.body]
    restoring = " + ρ g w" if beam.hydrostatic else ""
    return f"∂ψ/∂y = w, EI w⁗{restoring} − ω² m w = ω² ρ ψ; {BEAM_ENDS[beam.ends]}"


def _unknown_table(scene: TankScene) -> Table:
    table = _table("Unknown fields", "field", "where", "why")
    table.add_row("ψ", "liquid", "displacement potential, ∇ψ is the displacement: Laplace's equation, pressure ω² ρ ψ")
    table.add_row(*_elevation_row(scene))
    for index, beam in enumerate(scene.body):
        table.add_row(f"a of beam {index + 1}", f"beam {index + 1}", _beam_basis(scene, beam))
    return table


def _elevation_row(scene: TankScene) -> tuple[str, str, str]:
    if not _has_open_top(scene):
        return "η: none", "–", "the beam covers the whole liquid"
    reasons = {
        "free": ("η", "free surface", "gravity waves, η = ω² ψ/g; with the bodies it spans the eigenproblem"),
        "rigid": ("η: none", "rigid lid", "the lid holds the liquid, so no gravity waves"),
        "pressure_release": ("η: none", "pressure release", "the liquid moves freely without weight: no gravity waves"),
    }
    return reasons[scene.tank.top]


def _beam_basis(scene: TankScene, beam: Beam) -> str:
    if beam.ends == "guided":
        return "w = Σ aᵢ φᵢ: elastic shapes cos(nπx/L), n ≥ 1; heave is held by the liquid's volume"
    if _volume_holds_heave(scene):
        return "w = Σ aᵢ φᵢ: pitch and elastic shapes free in vacuum; heave is held by the liquid's volume"
    return "w = Σ aᵢ φᵢ: heave, pitch and elastic shapes free in vacuum"


def _group_table(scene: TankScene) -> Table:
    table = _table("Dimensionless groups", "group", "value", "meaning")
    density, length = scene.liquid[0].density, scene.tank.length
    table.add_row("H/L", f"{scene.liquid[0].depth / length:.4g}", "depth over length of the tank")
    for index, beam in enumerate(scene.body):
        of_beam = f"beam {index + 1}: "
        stiffness = beam.flexural_rigidity / (density * scene.tank.gravity * beam.length**4)
        table.add_row("EI/(ρ g l⁴)", f"{stiffness:.4g}", of_beam + "bending over gravity")
        table.add_row("m/(ρ l)", f"{_mass_group(scene, beam):.4g}", of_beam + "its mass over that of ρ l²")
        table.add_row("l/L", f"{beam.length / length:.4g}", of_beam + "part of the tank that it covers")
        table.add_row("x₁/L", f"{beam.start / length:.4g}", of_beam + "left end")
    return table


def hints(scene: TankScene) -> tuple[str, ...]:
    """Return what to expect of the answer, one sentence or two each."""
    return tuple(hint for find in _HINTS for hint in find(scene))


def _symmetry(scene: TankScene) -> Iterator[str]:
    if is_mirror_image(scaled_tank(scene)):
        yield (
            "The scene is its own mirror image: modes are symmetric (∂ψ/∂x = 0 in the middle) or antisymmetric "
            "(ψ = 0 there), and half the tank holds either kind."
        )


def _zero_modes(scene: TankScene) -> Iterator[str]:
    count = zero_mode_count(scene)
    if count == 0:
        return
    cause = "Without hydrostatic restoring"
    if count == 1:
        yield f"{cause}, one motion, pitch, costs no energy: a mode of frequency zero, which is not reported."
    else:
        yield f"{cause}, {count} rigid motions cost no energy: modes of frequency zero, which are not reported."


def _sloshing(scene: TankScene) -> Iterator[str]:
    if not scene.body:
        yield "Pure sloshing has the exact answer ω² = g k tanh kH with k = nπ/L, to compare with."


def _walls(scene: TankScene) -> Iterator[str]:
    segments = top_segments(scene)
    if len(segments) == 1 and scene.body:
        if scene.tank.top != "free":
            yield f'The beam covers the whole liquid, so top = "{scene.tank.top}" has no effect.'
        return
    for segment, wall in ((segments[0], "left"), (segments[-1], "right")):
        if segment.body is not None:
            yield f"Beam {segment.body + 1} touches the {wall} wall: its end slides along it without friction."


def _shared_tone(scene: TankScene) -> Iterator[str]:
    """The elastic tone radiates into the sloshing modes unless it is slow or its beam heavy (docs, aquarium, § 4)."""
    if scene.tank.top != "free" or not _has_open_top(scene):
        return
    # In units of the tank λ = ω² L/g.
    for index, (beam, tone) in enumerate(zip(scene.body, expected_tones(scaled_tank(scene)), strict=True)):
        ratio = tone * beam.length / scene.tank.length
        if ratio > 1 and _mass_group(scene, beam) < 1:
            yield (
                f"Beam {index + 1}: ω² l/g of its first elastic tone is about {ratio:.2g}. Above one, the tone "
                "is shared between hybrid modes with sloshing; a run says how far (participation, runner-up)."
            )


def _hydrostatics(scene: TankScene) -> Iterator[str]:
    weight = scene.liquid[0].density * scene.tank.gravity
    for index, beam in enumerate(scene.body):
        ratio = weight / _bending_stiffness(beam)
        if beam.hydrostatic and ratio > 10:
            yield (
                f"Beam {index + 1} is soft: ρ g is {ratio:.3g} times the bending stiffness EI κ₁⁴ of its first elastic "
                "shape, so its lowest modes store little elastic energy."
            )
        elif not beam.hydrostatic and ratio > 0.1:
            yield (
                f"Beam {index + 1} is modelled without the hydrostatic restoring, ρ g, which is {ratio:.2g} times "
                "its bending stiffness EI κ₁⁴; hydrostatic = true gives higher frequencies."
            )


_HINTS: tuple[Callable[[TankScene], Iterator[str]], ...] = (
    _symmetry,
    _zero_modes,
    _sloshing,
    _walls,
    _shared_tone,
    _hydrostatics,
)


def zero_mode_count(scene: TankScene) -> int:
    """Return how many motions have neither stiffness nor, by the liquid's volume, a constraint.

    Each free beam without hydrostatics heaves and pitches at no cost. Unless ψ = 0 somewhere on the top, the
    volume of the liquid is conserved, which takes one heave away. Guided beams neither pitch nor, covering all, heave.
    """
    loose = sum(1 for beam in scene.body if not beam.hydrostatic and beam.ends == "free")
    if loose == 0:
        return 0
    volume_is_free = scene.tank.top == "pressure_release" and _has_open_top(scene)
    return 2 * loose if volume_is_free else 2 * loose - 1


def _has_open_top(scene: TankScene) -> bool:
    return any(segment.body is None for segment in top_segments(scene))


def _volume_holds_heave(scene: TankScene) -> bool:
    """Whether a lone beam can displace no liquid: nothing else on top could give way."""
    gives_way = scene.tank.top != "rigid" and _has_open_top(scene)
    return len(scene.body) == 1 and not gives_way


def _mass_group(scene: TankScene, beam: Beam) -> float:
    return beam.mass_per_length / (scene.liquid[0].density * beam.length)


def _bending_stiffness(beam: Beam) -> float:
    """Return EI κ₁⁴ of the first elastic shape, Pa/m."""
    return beam.flexural_rigidity * (_first_wavenumber(beam) / beam.length) ** 4


def _first_wavenumber(beam: Beam) -> float:
    """Return κ₁ l. Guided ends, cos(nπx/L): π; free ends: 4.73."""
    return math.pi if beam.ends == "guided" else float(free_free_roots(1)[0])
