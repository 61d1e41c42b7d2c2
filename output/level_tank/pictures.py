"""Pictures of modes of a tank in three dimensions: the displaced surface, lit, and its contours from above."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from matplotlib.tri import Triangulation
from numpy.typing import NDArray

from hydroelastic.fem.progress import Report
from hydroelastic.output.level_tank.quantities import FREQUENCY, KIND, MODE_OMEGA, MODES, MULTIPLICITY, ORDER
from hydroelastic.output.level_tank.sample import SampledModes, SampledTank
from hydroelastic.output.pictures.colours import INK, mode_colours
from hydroelastic.output.pictures.gif import FRAMES, SECONDS, write_gif
from hydroelastic.output.pictures.options import PictureOptions
from hydroelastic.output.pictures.page import (
    POINT,
    WIDTH,
    FieldImage,
    new_page,
    pixels,
    place,
    save,
    write_caption,
    write_title,
)
from hydroelastic.output.pictures.rendering import require_renderer
from hydroelastic.output.reading import Reading

if TYPE_CHECKING:
    import pyvista

# Sizes in pixels of a page that is 1600 pixels wide.
_VIEW, _HEIGHT, _ABOVE, _BELOW = 900, 620, 90, 80
# The largest displacement, in extents of the plan.
_RAISED = 0.12
_CONTOURS = 21
# From where the surface is seen, and the part of the view that it fills.
_FROM = np.array([-1.0, -1.6, 1.1])
_FILLED = 0.95
# Number of lowest modes that are animated.
_ANIMATED = 2


def draw_level_tank(tank: SampledTank, folder: Path, options: PictureOptions, report: Report) -> None:
    """Draw every mode, the first one of a pair, into a folder, and animate the lowest if requested."""
    drawn = [place for place, name in enumerate(tank.sample.names) if not name.endswith("_sin")]
    for place_of, mode in zip(drawn, tank.summary[MODES], strict=True):
        number = tank.sample.numbers[place_of] + 1
        report(f"picture {number} of {len(drawn)}")
        title = _title(number, mode)
        page = mode_page(tank.sample, place_of, title, width=options.width)
        save(page, folder / f"mode_{number:03d}.png")
        if options.animate and number <= _ANIMATED:
            report(f"animation of mode {number}")
            phases = np.arange(FRAMES) / FRAMES
            pages = [
                mode_page(
                    tank.sample,
                    place_of,
                    f"{title}, t = {part:.2f} T",
                    width=options.animation_width,
                    factor=float(np.cos(2.0 * np.pi * part)),
                ).copy()
                for part in phases
            ]
            write_gif(pages, folder / f"mode_{number:03d}.gif", seconds=SECONDS, kept=mode_colours())


def _title(number: int, mode: Reading) -> str:
    order = "" if mode[ORDER] is None else f", n = {mode[ORDER]}"
    pair = ", one of a pair" if mode[MULTIPLICITY] == 2 else ""
    return f"Mode {number}: ω = {mode[MODE_OMEGA]:.6g} rad/s, {mode[FREQUENCY]:.4g} Hz{order}, {mode[KIND]}{pair}"


def mode_page(sample: SampledModes, shape: int, title: str, *, width: int, factor: float = 1.0) -> NDArray[np.uint8]:
    """Return the picture of a mode as pixels, shape (height, width, 4)."""
    elevation = sample.elevations[shape]
    limit = float(np.abs(elevation).max()) or 1.0
    relative = factor * elevation / limit
    scale = width / WIDTH
    figure = new_page(_HEIGHT + _ABOVE + _BELOW, width)
    size = round(_VIEW * scale), round(_HEIGHT * scale)
    figure.add_artist(FieldImage(_view(sample, relative, size), 0, round(_BELOW * scale)))
    _contours(figure, sample, relative)
    write_title(figure, title)
    outlined = "; plates are outlined" if sample.plate_of_triangles.any() else ""
    write_caption(figure, f"Displacement over the largest one{outlined}. Left: raised for visibility.")
    return pixels(figure)


def _view(sample: SampledModes, relative: NDArray[np.float64], size: tuple[int, int]) -> NDArray[np.uint8]:
    # Without a library that renders, VTK would end the process.
    require_renderer()
    import pyvista

    extent = float(np.ptp(sample.points, axis=0).max())
    points = np.column_stack([sample.points, _RAISED * extent * relative])
    plotter = pyvista.Plotter(off_screen=True, window_size=list(size))
    plotter.set_background("white")
    for number in np.unique(sample.plate_of_triangles):
        part = _surface(points, sample.triangles[sample.plate_of_triangles == number], relative)
        plotter.add_mesh(
            part,
            scalars="displacement",
            cmap=mode_colours(),
            clim=(-1.0, 1.0),
            smooth_shading=True,
            specular=0.4 if number == 0 else 0.1,
            show_scalar_bar=False,
        )
    edges = _edges(sample)
    if len(edges):
        lines = pyvista.PolyData(points, lines=np.column_stack([np.full(len(edges), 2), edges]).ravel())
        plotter.add_mesh(lines, color=INK, line_width=2.0)
    _look_at(plotter.camera, sample, _RAISED * extent, size)
    image = np.asarray(plotter.screenshot(return_img=True))
    plotter.close()
    return image


def _look_at(camera: pyvista.Camera, sample: SampledModes, raised: float, size: tuple[int, int]) -> None:
    """Turn a camera so that the surface fills the view, raised or lowered by any part of the largest displacement."""
    forwards = -_FROM / np.linalg.norm(_FROM)
    rightwards = np.cross(forwards, [0.0, 0.0, 1.0])
    rightwards /= np.linalg.norm(rightwards)
    upwards = np.cross(rightwards, forwards)
    seen = np.array([sample.points @ axis[:2] for axis in (rightwards, upwards)])
    low, high = seen.min(axis=1), seen.max(axis=1)
    width, height = high - low + [0.0, 2.0 * raised * upwards[2]]
    middle = rightwards * 0.5 * (low[0] + high[0]) + upwards * 0.5 * (low[1] + high[1])
    camera.parallel_projection = True
    camera.position, camera.focal_point = middle - 4.0 * np.hypot(width, height) * forwards, middle
    camera.up = (0.0, 0.0, 1.0)
    camera.parallel_scale = 0.5 * max(height, width * size[1] / size[0]) / _FILLED
    camera.clipping_range = (1.0 * np.hypot(width, height), 7.0 * np.hypot(width, height))


def _surface(
    points: NDArray[np.float64], triangles: NDArray[np.int64], relative: NDArray[np.float64]
) -> pyvista.PolyData:
    import pyvista

    mesh = pyvista.PolyData.from_regular_faces(points, triangles)
    mesh["displacement"] = relative
    return mesh


def _contours(figure: Figure, sample: SampledModes, relative: NDArray[np.float64]) -> None:
    """Contours from above with a colour bar, to the right of the view."""
    side = WIDTH - _VIEW - 200.0
    axes = figure.add_axes(place(figure, _VIEW + 60.0, _BELOW + 0.5 * (_HEIGHT - side), side, side))
    levels = np.linspace(-1.0, 1.0, _CONTOURS)
    for number in np.unique(sample.plate_of_triangles):
        triangulation = Triangulation(
            sample.points[:, 0], sample.points[:, 1], sample.triangles[sample.plate_of_triangles == number]
        )
        filled = axes.tricontourf(triangulation, relative, levels, cmap=mode_colours())
        axes.tricontour(triangulation, relative, levels[::2], colors=INK, linewidths=0.5)
    for edge in _edges(sample):
        axes.plot(*sample.points[edge].T, color=INK, linewidth=1.6)
    axes.set_aspect("equal")
    # Points are a little inside the pieces of the plan.
    axes.use_sticky_edges = False
    axes.margins(1e-6)
    axes.tick_params(labelsize=17.0 * POINT)
    axes.set_xlabel("x, m", fontsize=18.0 * POINT)
    axes.set_ylabel("y, m", fontsize=18.0 * POINT)
    bar = figure.colorbar(
        filled, cax=figure.add_axes(place(figure, WIDTH - 110.0, _BELOW + 0.5 * (_HEIGHT - side), 24.0, side))
    )
    bar.set_ticks([-1.0, 0.0, 1.0])
    bar.ax.tick_params(labelsize=17.0 * POINT)


def _edges(sample: SampledModes) -> NDArray[np.int64]:
    """The edges of plates that belong to one triangle only: numbers of their ends, shape (edges, 2)."""
    own = sample.triangles[sample.plate_of_triangles > 0]
    pairs = np.sort(np.vstack([own[:, [0, 1]], own[:, [1, 2]], own[:, [2, 0]]]), axis=1)
    # In the middle of a disc, and where an angle begins again, points coincide.
    _, same = np.unique(np.round(sample.points / np.ptp(sample.points), 9), axis=0, return_inverse=True)
    named = np.sort(same.ravel()[pairs], axis=1)
    _, first, counts = np.unique(named, axis=0, return_index=True, return_counts=True)
    alone = pairs[first[counts == 1]]
    found: NDArray[np.int64] = alone[same.ravel()[alone[:, 0]] != same.ravel()[alone[:, 1]]]
    return found
