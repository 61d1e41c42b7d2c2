"""Mode shapes as pictures, and as files for ParaView."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hydroelastic.fem.pictures.mode import ModePicture
from hydroelastic.fem.progress import Report
from hydroelastic.fem.tank.mode_shapes import ModeShapes
from hydroelastic.output.pictures.options import PictureOptions
from hydroelastic.output.reading import Reading
from hydroelastic.output.tank import quantities as tank
from hydroelastic.output.vtu import write_collection, write_vtu
from hydroelastic.scenes.tank.body_file import displacement_of, write_bodies

# Number of lowest modes that are always shown.
_LOWEST = 2
# Part of the elastic energy below which a mode does not count as bending.
_BENDS = 0.005


def mode_title(number: int, mode: Reading) -> str:
    """Title of a mode's picture."""
    omega, frequency, bending = mode[tank.MODE_OMEGA], mode[tank.FREQUENCY], mode[tank.BENDING]
    share = f" ({100 * bending:.0f} % bending)" if bending >= _BENDS else ""
    return f"Mode {number}: ω = {omega:.6g} rad/s, {frequency:.4g} Hz, {mode[tank.KIND]}{share}"


def growing_title(number: int, mode: Reading) -> str:
    """Title of a growing mode's picture."""
    rate = mode[tank.GROWTH_RATE]
    return f"Growing mode {number}: σ = {rate:.6g} 1/s, doubles in {np.log(2.0) / rate:.4g} s, {mode[tank.KIND]}"


def pictures(shapes: ModeShapes, summary: Reading) -> list[ModePicture]:
    """One picture for each mode, the growing ones last."""
    titles = [mode_title(number, mode) for number, mode in enumerate(summary[tank.MODES], 1)]
    titles += [growing_title(number, mode) for number, mode in enumerate(summary[tank.GROWING], 1)]
    two = len(shapes.depths) > 1
    return [
        ModePicture(
            points=shapes.liquid.points,
            triangles=shapes.liquid.triangles,
            potential=shapes.liquid.potential[number],
            displacement=shapes.liquid.displacement[number],
            surfaces=shapes.curves[number],
            floats=shapes.floats[number],
            title=title,
            length=shapes.length,
            depth=shapes.depths[0],
            upper_depth=shapes.depths[1] if two else 0.0,
            densities=shapes.densities if two else (),
            lid=shapes.lid,
        )
        for number, title in enumerate(titles)
    ]


def mode_names(shapes: ModeShapes) -> list[str]:
    """Names of the modes in files: numbers from 1, of growing modes with the prefix growing_."""
    names = [f"{number + 1:03d}" for number in range(len(shapes.curves) - shapes.growing)]
    return names + [f"growing_{number + 1:03d}" for number in range(shapes.growing)]


def animated_modes(summary: Reading) -> list[int]:
    """Places of the lowest two modes, of the lowest mode of each kind, and of the one with the largest part of
    bending."""
    modes = summary[tank.MODES]
    chosen = set(range(min(_LOWEST, len(modes))))
    kinds = [mode[tank.KIND] for mode in modes]
    chosen |= {kinds.index(kind) for kind in kinds}
    bending = [mode[tank.BENDING] for mode in modes]
    if max(bending, default=0.0) >= _BENDS:
        chosen.add(bending.index(max(bending)))
    return sorted(chosen)


def draw_all(shapes: ModeShapes, summary: Reading, folder: Path, options: PictureOptions, report: Report) -> None:
    """Draw every mode, and all of them on one sheet, into a folder, animate some if requested, and report the progress.

    Animations are half as wide as pictures, which keeps them small.
    """
    # Who only wants the fields does without what draws.
    from hydroelastic.output.pictures.modes import animate_mode, draw_mode, draw_overview

    drawn = pictures(shapes, summary)
    # The sheet takes the longest to save.
    draw_overview(drawn, folder / "overview.png", width=options.width)
    for number, (picture, name) in enumerate(zip(drawn, mode_names(shapes), strict=True), 1):
        report(f"picture {number} of {len(drawn)}")
        file = name if name.startswith("growing") else f"mode_{name}"
        draw_mode(picture, folder / f"{file}.png", width=options.width)
    for place in animated_modes(summary) if options.animate else ():
        report(f"animation of mode {place + 1}")
        animate_mode(drawn[place], folder / f"mode_{place + 1:03d}.gif", width=options.animation_width)


def write_fields(shapes: ModeShapes, omegas: list[float], folder: Path) -> None:
    """Write the shape of every mode as VTU files for ParaView, in metres.

    ``modes.vtu`` has ψ, ∇ψ and the number of each cell's liquid; ``bodies.vtu``, of surfaces, beams and floats, their
    displacements under the same names. ``modes.pvd`` plays the modes, ``bodies_001.vtu`` and so on, by their
    frequencies.
    """
    folder.mkdir()
    data = {}
    for name, potential, displacement in zip(
        mode_names(shapes), shapes.liquid.potential, shapes.liquid.displacement, strict=True
    ):
        data[f"potential_{name}"] = potential
        data[f"displacement_{name}"] = np.column_stack([displacement, np.zeros(len(displacement))])
    points = np.column_stack([shapes.liquid.points, np.zeros(len(shapes.liquid.points))])
    cells = [("triangle", shapes.liquid.triangles)]
    # Compressed it would be a quarter smaller, and take as long as the solution.
    write_vtu(folder / "modes.vtu", points, cells, data, {"liquid": shapes.liquid.liquid}, compressed=False)
    moved = {
        f"displacement_{name}": displacement_of(curves, floats)
        for name, curves, floats in zip(mode_names(shapes), shapes.curves, shapes.floats, strict=True)
    }
    if moved:
        write_bodies(folder / "bodies.vtu", shapes.curves[0], shapes.floats[0], moved)
        files = {f"bodies_{name}.vtu": moved[f"displacement_{name}"] for name in mode_names(shapes)[: len(omegas)]}
        for file, displacement in files.items():
            write_bodies(folder / file, shapes.curves[0], shapes.floats[0], {"displacement": displacement})
        entries = sorted(zip(omegas, files, strict=True))
        write_collection(folder / "modes.pvd", [(omega, 0, file) for omega, file in entries])
