"""Mode shapes as pictures, and as files for ParaView."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Literal

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hydroelastic.fem.closed.section import SectionSolution
from hydroelastic.fem.progress import Report
from hydroelastic.fem.shape_curves import FloatSection, SectionField, SurfaceCurve
from hydroelastic.output.plots import PictureOptions, Sheets
from hydroelastic.output.reading import Reading
from hydroelastic.output.tank import quantities as tank
from hydroelastic.output.vtu import write_collection, write_vtu
from hydroelastic.physics.dofs import body_name
from hydroelastic.scenes.tank.body_file import displacement_of, write_bodies

# Number of lowest modes that are always shown.
_LOWEST = 2
# Part of the elastic energy below which a mode does not count as bending.
_BENDS = 0.005
_KINDS: dict[str, Literal["free_surface", "interface", "body"]] = {
    "free_surface": "free_surface",
    "interface": "interface",
    "body": "body",
}


def _mode_title(number: int, mode: Reading) -> str:
    omega, frequency, bending = mode[tank.MODE_OMEGA], mode[tank.FREQUENCY], mode[tank.BENDING]
    share = f" ({100 * bending:.0f} % bending)" if bending >= _BENDS else ""
    period = f"T = {2.0 * np.pi / omega:.4g} s"
    return f"Mode {number}: ω = {omega:.6g} rad/s, {frequency:.4g} Hz, {period}, {mode[tank.KIND]}{share}"


def _growing_title(number: int, mode: Reading) -> str:
    rate = mode[tank.GROWTH_RATE]
    return f"Growing mode {number}: σ = {rate:.6g} 1/s, doubles in {np.log(2.0) / rate:.4g} s, {mode[tank.KIND]}"


def pictures(solution: SectionSolution, samples: xr.Dataset, summary: Reading) -> list[SectionField]:
    """What is drawn of each mode, the growing ones last."""
    titles = [_mode_title(number, mode) for number, mode in enumerate(summary[tank.MODES], 1)]
    titles += [_growing_title(number, mode) for number, mode in enumerate(summary[tank.GROWING], 1)]
    physical, top = solution.physical, solution.physical.levels[-1]
    depths, two = [layer.depth for layer in physical.layers], len(physical.layers) > 1
    lid = [(piece.start, piece.end) for piece in top.pieces if top.kind == "rigid" and piece.body is None]
    return [
        SectionField(
            points=samples.position.values,
            triangles=samples.vertex.values,
            liquid=samples.liquid.values,
            potential=samples.potential.values[number],
            displacement=samples.displacement.values[number],
            surfaces=surfaces,
            floats=floats,
            title=title,
            length=physical.length,
            depth=depths[0],
            upper_depth=depths[1] if two else 0.0,
            densities=tuple(layer.density for layer in physical.layers) if two else (),
            lid=tuple(lid),
        )
        for number, (title, (surfaces, floats)) in enumerate(zip(titles, _moved(solution), strict=True))
    ]


def _moved(solution: SectionSolution) -> Iterator[tuple[tuple[SurfaceCurve, ...], tuple[FloatSection, ...]]]:
    """The surfaces, beams and floats in each mode, the growing ones last."""
    shapes, length = solution.shapes, solution.physical.length
    hulls = {body_name(index + 1): body.hull for index, body in solution.tank.floats.items()}
    for prefix in ("", "growing_"):
        for mode in range(shapes.sizes.get(f"{prefix}mode", 0)):
            curves, floats = [], []
            for name, moved in shapes.data_vars.items():
                quantity, _, place = str(name).removeprefix(prefix).partition("_of_")
                if moved.dims[0] != f"{prefix}mode" or not place:
                    continue
                if quantity == "displacement":
                    hull = hulls[place]
                    left, right = hull.waterplane
                    slit = np.array([[left, y] for y in hull.slit]) * length if hull.is_thin else None
                    floats.append(
                        FloatSection(
                            contour=shapes[f"contour_of_{place}"].values,
                            displacement=moved.values[mode],
                            waterplane=(left * length, right * length),
                            slit=slit,
                        )
                    )
                else:
                    curves.append(
                        SurfaceCurve(
                            kind=_KINDS[place.rpartition("_")[0]],
                            x=shapes[f"position_on_{place}"].values,
                            displacement=moved.values[mode],
                            level=moved.attrs["level_at_rest"],
                        )
                    )
            yield tuple(curves), tuple(floats)


def mode_names(solution: SectionSolution) -> list[str]:
    """Names of the modes in files: numbers from 1, of growing modes with the prefix growing_."""
    sizes = solution.shapes.sizes
    return [
        f"{prefix}{number:03d}" for prefix in ("", "growing_") for number in range(1, 1 + sizes.get(f"{prefix}mode", 0))
    ]


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


def draw_all(
    solution: SectionSolution,
    samples: xr.Dataset,
    summary: Reading,
    folder: Path,
    options: PictureOptions,
    report: Report,
) -> None:
    """Draw every mode, and all of them on one sheet, into a folder, animate some if requested; report the progress."""
    from hydroelastic.output.fields import animate_motion, draw_sections

    drawn, sheets = pictures(solution, samples, summary), Sheets(folder=folder, title="", options=options)
    names = [name if name.startswith("growing") else f"mode_{name}" for name in mode_names(solution)]
    draw_sections(drawn, names, sheets, report)
    for number in animated_modes(summary) if options.animate else ():
        report(f"animation of mode {number + 1}")
        animate_motion(drawn[number], names[number], sheets)


def write_fields(solution: SectionSolution, samples: xr.Dataset, folder: Path) -> None:
    """Write the shape of every mode as VTU files for ParaView, in metres.

    ``modes.vtu`` has ψ, ∇ψ and the number of each cell's liquid; ``bodies.vtu``, of surfaces, beams and floats, their
    displacements under the same names. ``modes.pvd`` plays the modes, ``bodies_001.vtu`` and so on, by their
    frequencies.
    """
    folder.mkdir()
    data, names = {}, mode_names(solution)

    def in_space(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.column_stack([vectors, np.zeros(len(vectors))])

    for name, potential, displacement in zip(names, samples.potential.values, samples.displacement.values, strict=True):
        data[f"potential_{name}"] = potential
        data[f"displacement_{name}"] = in_space(displacement)
    cells = [("triangle", samples.vertex.values)]
    # Compressed it would be a quarter smaller, and take as long as the solution.
    liquids = {"liquid": samples.liquid.values}
    write_vtu(folder / "modes.vtu", in_space(samples.position.values), cells, data, liquids, compressed=False)
    shown = list(_moved(solution))
    moved = {f"displacement_{name}": displacement_of(*own) for name, own in zip(names, shown, strict=True)}
    if moved:
        write_bodies(folder / "bodies.vtu", *shown[0], moved)
        omegas = solution.dataset.omega.values[: solution.shapes.sizes.get("mode", 0)]
        files = {f"bodies_{name}.vtu": moved[f"displacement_{name}"] for name in names[: len(omegas)]}
        for file, displacement in files.items():
            write_bodies(folder / file, *shown[0], {"displacement": displacement})
        write_collection(folder / "modes.pvd", [(omega, 0, file) for omega, file in zip(omegas, files, strict=True)])
