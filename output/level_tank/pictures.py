"""Pictures of modes of a tank in three dimensions: the displaced surface in space by VTK, its contours from above."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.progress import Report
from hydroelastic.output.level_tank.quantities import FREQUENCY, KIND, MODE_OMEGA, MODES, MULTIPLICITY, ORDER
from hydroelastic.output.level_tank.sample import SampledModes, SampledTank
from hydroelastic.output.plots import (
    FRAMES,
    INK,
    Sheets,
    mode_colours,
    new_page,
    page_box,
    page_style,
    pixels,
    plotter,
    show_image,
    write_caption,
    write_gif,
    write_title,
)
from hydroelastic.output.reading import Reading

if TYPE_CHECKING:
    import pyvista
    from matplotlib.figure import Figure

# The largest displacement, in extents of the plan; number of lowest modes that are animated.
_RAISED, _ANIMATED = 0.12, 2
# Width and height of the view in space, and of the contours, inches of a page.
_VIEW, _HEIGHT, _BELOW, _SIDE = 9.0, 6.2, 0.8, 5.0
_FROM = np.array([-1.0, -1.6, 1.1])


def draw_level_tank(tank: SampledTank, sheets: Sheets, report: Report) -> None:
    """Draw every mode, the first one of a pair, and animate the lowest if requested."""
    drawn = [shape for shape, name in enumerate(tank.sample.names) if not name.endswith("_sin")]
    with page_style():
        for shape, mode in zip(drawn, tank.summary[MODES], strict=True):
            number = tank.sample.numbers[shape] + 1
            report(f"picture {number} of {len(drawn)}")
            title, name = _title(number, mode), f"mode_{number:03d}"
            sheets.save(_page(tank.sample, shape, title, sheets.options.width), name)
            if sheets.options.animate and number <= _ANIMATED:
                report(f"animation of mode {number}")
                width = sheets.options.animation_width
                pages = (
                    _page(tank.sample, shape, f"{title}, t = {part:.2f} T", width, float(np.cos(2.0 * np.pi * part)))
                    for part in np.arange(FRAMES) / FRAMES
                )
                write_gif(map(pixels, pages), sheets.folder / f"{name}.gif", kept=mode_colours())


def _title(number: int, mode: Reading) -> str:
    order = "" if mode[ORDER] is None else f", n = {mode[ORDER]}"
    pair = ", one of a pair" if mode[MULTIPLICITY] == 2 else ""
    numbers = f"ω = {mode[MODE_OMEGA]:.6g} rad/s, {mode[FREQUENCY]:.4g} Hz, T = {1.0 / mode[FREQUENCY]:.4g} s"
    return f"Mode {number}: {numbers}{order}, {mode[KIND]}{pair}"


def _page(sample: SampledModes, shape: int, title: str, width: int, factor: float = 1.0) -> Figure:
    elevation = sample.elevations[shape]
    relative = factor * elevation / (float(np.abs(elevation).max()) or 1.0)
    figure = new_page(width, _HEIGHT + _BELOW + 0.9)
    scene = _scene(sample, relative, (round(_VIEW * figure.dpi), round(_HEIGHT * figure.dpi)))
    show_image(figure, scene, 0.0, _BELOW, _VIEW, _HEIGHT)
    _contours(figure, sample, relative)
    write_title(figure, title)
    outlined = "; plates are outlined" if sample.plate_of_triangles.any() else ""
    write_caption(figure, f"Displacement over the largest one{outlined}. Left: raised for visibility.")
    return figure


def _scene(sample: SampledModes, relative: NDArray[np.float64], size: tuple[int, int]) -> pyvista.Plotter:
    scene = plotter(size)
    import pyvista

    extent = float(np.ptp(sample.points, axis=0).max())
    points = np.column_stack([sample.points, _RAISED * extent * relative])
    for number in np.unique(sample.plate_of_triangles):
        part = pyvista.PolyData.from_regular_faces(points, sample.triangles[sample.plate_of_triangles == number])
        part["displacement"] = relative
        scene.add_mesh(
            part, scalars="displacement", cmap=mode_colours(), clim=(-1.0, 1.0), smooth_shading=True,
            specular=0.4 if number == 0 else 0.1, show_scalar_bar=False,
        )  # fmt: skip
    edges = _edges(sample)
    if len(edges):
        lines = pyvista.PolyData(points, lines=np.column_stack([np.full(len(edges), 2), edges]).ravel())
        scene.add_mesh(lines, color=INK, line_width=2.0)
    # The same view of the surface raised or lowered by any part of the largest displacement.
    forwards = -_FROM / np.linalg.norm(_FROM)
    rightwards = np.cross(forwards, [0.0, 0.0, 1.0])
    rightwards /= np.linalg.norm(rightwards)
    axes = np.array([rightwards, np.cross(rightwards, forwards)])
    seen = sample.points @ axes[:, :2].T
    low, high = seen.min(axis=0), seen.max(axis=0)
    wide, tall = high - low + [0.0, 2.0 * _RAISED * extent * axes[1, 2]]
    middle, away = 0.5 * (low + high) @ axes, 4.0 * np.hypot(wide, tall)
    scene.camera.position, scene.camera.focal_point, scene.camera.up = middle - away * forwards, middle, (0.0, 0.0, 1.0)
    scene.camera.parallel_scale = 0.5 * max(tall, wide * size[1] / size[0]) / 0.95
    scene.camera.clipping_range = (0.25 * away, 1.75 * away)
    return scene


def _contours(figure: Figure, sample: SampledModes, relative: NDArray[np.float64]) -> None:
    """Contours from above with a colour bar, to the right of the view."""
    from matplotlib.tri import Triangulation

    bottom = _BELOW + 0.5 * (_HEIGHT - _SIDE)
    axes = figure.add_axes(page_box(figure, _VIEW + 0.6, bottom, _SIDE, _SIDE))
    levels = np.linspace(-1.0, 1.0, 21)
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
    axes.spines[:].set_visible(True)
    axes.set_xlabel("x, m", size=13.0)
    axes.set_ylabel("y, m", size=13.0)
    bar = figure.colorbar(filled, cax=figure.add_axes(page_box(figure, 14.9, bottom, 0.24, _SIDE)))
    bar.set_ticks([-1.0, 0.0, 1.0])
    for scales in (axes, bar.ax):
        scales.tick_params(labelsize=12.0)


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
