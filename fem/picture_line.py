"""Lines in space as PNG files: a thread as a tube coloured by its tension, what holds it, the stream beside it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.picture_canvas import quiet_vtk

if TYPE_CHECKING:
    import pyvista

_WIDTH, _HEIGHT = 1100, 850
_FONT = 10
# Of the diagonal of what is shown.
_TUBE, _END, _BODY, _ARROW = 0.0035, 0.012, 0.009, 0.16
_ARROWS = 7
# Sides of the box: a line that is almost straight is not shown in a slit.
_LEAST_SIDE = 0.2
_STREAM = "#56B4E9"
_AXES = ("x, m", "y, m", "z, m")


@dataclass(frozen=True, kw_only=True)
class LineView:
    """What stays the same on all pictures of a line.

    Attributes:
        low: lower corner of what is shown, m, shape (3,).
        high: upper corner, m.
        labels: how many on each axis, both ends among them.
        colours: limits of the colour scale.
        unit: what the colours say, with its unit.
        stream: heights, m, and velocities, m/s, of the stream that is drawn beside; shapes (n,) and (n, 3).
    """

    low: NDArray[np.float64]
    high: NDArray[np.float64]
    labels: tuple[int, int, int]
    colours: tuple[float, float]
    unit: str
    stream: tuple[NDArray[np.float64], NDArray[np.float64]] | None = None

    @property
    def diagonal(self) -> float:
        """Of what is shown, m."""
        return float(np.linalg.norm(self.high - self.low))


@dataclass(frozen=True, kw_only=True)
class DrawnLine:
    """A line and what is on it.

    Attributes:
        points: m, shape (n, 3).
        values: by which it is coloured, shape (n,).
        fixed: points that are held, shape (k, 3).
        bodies: points that carry something, shape (m, 3).
        title: above the picture.
    """

    points: NDArray[np.float64]
    values: NDArray[np.float64]
    fixed: NDArray[np.float64]
    bodies: NDArray[np.float64]
    title: str


def draw_lines(view: LineView, lines: Sequence[DrawnLine], paths: Sequence[Path]) -> None:
    """Draw pictures of one view with one window.

    Args:
        view: what stays the same.
        lines: one for each picture.
        paths: PNG files, as many.
    """
    import pyvista

    with quiet_vtk():
        plotter = pyvista.Plotter(off_screen=True, window_size=[_WIDTH, _HEIGHT])
        plotter.set_background("white")
        _set_scene(plotter, view)
        for line, path in zip(lines, paths, strict=True):
            _put_line(plotter, view, line)
            plotter.screenshot(str(path))
        plotter.close()


def _set_scene(plotter: pyvista.Plotter, view: LineView) -> None:
    """The box with its scales, the stream, the camera."""
    import pyvista

    box = pyvista.Box(bounds=np.column_stack([view.low, view.high]).ravel())
    plotter.add_mesh(box, opacity=0.0, reset_camera=True, render=False)
    flat = view.high[1] - view.low[1] < 0.02 * view.diagonal
    names = dict(zip(("xtitle", "ytitle", "ztitle"), _AXES, strict=True))
    plotter.show_bounds(
        bounds=np.column_stack([view.low, view.high]).ravel(),
        grid="back",
        location="outer",
        color="#444444",
        font_size=_FONT,
        show_yaxis=not flat,
        show_ylabels=not flat,
        n_xlabels=view.labels[0],
        n_ylabels=view.labels[1],
        n_zlabels=view.labels[2],
        fmt="%.5g",
        render=False,
        **names,
    )
    if view.stream is not None:
        _put_stream(plotter, view)
    centre = 0.5 * (view.low + view.high)
    direction = np.array([0.0, -1.0, 0.0]) if flat else np.array([-0.55, -1.0, 0.35])
    plotter.camera.focal_point = centre
    plotter.camera.position = centre + direction / np.linalg.norm(direction) * 3.0 * view.diagonal
    plotter.camera.up = (0.0, 0.0, 1.0)
    plotter.enable_parallel_projection()
    wide, high = view.high[0] - view.low[0], view.high[2] - view.low[2]
    # Half of what is seen upwards: room for labels, on the right for the scale of colours.
    scale = max(0.66 * high, 0.72 * wide * _HEIGHT / _WIDTH) if flat else 0.58 * view.diagonal
    plotter.camera.parallel_scale = scale


def _put_stream(plotter: pyvista.Plotter, view: LineView) -> None:
    """Arrows of the velocity at a few heights, at the upstream side of the box."""
    import pyvista

    assert view.stream is not None
    heights, velocities = view.stream
    fastest = float(np.max(np.linalg.norm(velocities, axis=1)))
    if fastest == 0.0:
        return
    mean = velocities.mean(axis=0)
    corner = np.where(mean >= 0.0, view.low, view.high)
    centre = 0.5 * (view.low + view.high)
    for height, velocity in zip(heights, velocities, strict=True):
        speed = float(np.linalg.norm(velocity))
        if speed < 1e-3 * fastest:
            continue
        length = _ARROW * view.diagonal * speed / fastest
        start = np.array([corner[0], centre[1], height])
        arrow = pyvista.Arrow(
            start=start,
            direction=velocity / speed,
            scale=length,
            tip_length=min(0.25, 0.03 * view.diagonal / length),
            tip_radius=0.008 * view.diagonal / length,
            shaft_radius=0.0025 * view.diagonal / length,
        )
        plotter.add_mesh(arrow, color=_STREAM, opacity=0.9, render=False)
    plotter.add_text(
        f"stream, longest arrow {fastest:.3g} m/s", position=(0.04, 0.9), viewport=True, font_size=10, color="#2a7fb0"
    )


def _put_line(plotter: pyvista.Plotter, view: LineView, line: DrawnLine) -> None:
    """The thread and what is on it, in place of the one before."""
    import pyvista

    tube: Any = pyvista.lines_from_points(line.points)
    tube["values"] = line.values
    tube = tube.tube(radius=_TUBE * view.diagonal, n_sides=14)
    plotter.add_mesh(
        tube,
        scalars="values",
        cmap="viridis",
        clim=view.colours,
        name="thread",
        reset_camera=False,
        render=False,
        smooth_shading=True,
        scalar_bar_args={
            "title": view.unit,
            "vertical": True,
            "color": "#222222",
            "title_font_size": 17,
            "label_font_size": 15,
            "fmt": "%.4g",
            "position_x": 0.9,
            "position_y": 0.25,
            "width": 0.045,
            "height": 0.5,
            "n_labels": 5,
        },
    )
    for name, points, radius, colour in (
        ("fixed", line.fixed, _END, "#222222"),
        ("bodies", line.bodies, _BODY, "#D55E00"),
    ):
        if len(points):
            marks = pyvista.PolyData(points).glyph(
                geom=pyvista.Cube(x_length=1.6, y_length=1.6, z_length=1.6) if name == "fixed" else pyvista.Sphere(),
                scale=False,
                factor=radius * view.diagonal,
                orient=False,
            )
            plotter.add_mesh(marks, color=colour, name=name, reset_camera=False, render=False)
        else:
            plotter.remove_actor(name, render=False)
    plotter.add_text(line.title, position=(0.04, 0.94), viewport=True, font_size=13, color="#222222", name="title")


def view_of(
    points: NDArray[np.float64], values: NDArray[np.float64], unit: str, velocity_at: Any | None = None
) -> LineView:
    """A view that holds all positions.

    Args:
        points: all positions that will be drawn, m, shape (n, 3).
        values: all values that will be drawn.
        unit: what they are, with their unit.
        velocity_at: velocities, shape (n, 3), of points, shape (n, 3), of the stream; ``None`` for a liquid at rest.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    size = float(np.max(high - low))
    margin = np.maximum(0.02 * size, 0.5 * (_LEAST_SIDE * size - (high - low)))
    flat = high[1] - low[1] < 1e-6 * size
    scales = [_scale(*limits, size / 10.0) for limits in zip(low - margin, high + margin, strict=True)]
    low = np.array([first for first, _, _ in scales])
    high = np.array([last for _, last, _ in scales])
    if flat:
        low[1], high[1] = points[0, 1] - 1e-3 * size, points[0, 1] + 1e-3 * size
    stream = None
    if velocity_at is not None:
        heights = np.linspace(low[2], high[2], _ARROWS + 2)[1:-1]
        places = np.column_stack([np.full(_ARROWS, v) for v in 0.5 * (low + high)[:2]] + [heights])
        stream = heights, velocity_at(places)
    lowest, highest = float(values.min()), float(values.max())
    if highest - lowest <= 1e-9 * abs(highest):
        # A scale about one value; about zero it ends at 1.
        half = 0.5 * abs(highest) or 1.0
        lowest, highest = lowest - half, highest + half
    return LineView(
        low=low,
        high=high,
        labels=(scales[0][2], scales[1][2], scales[2][2]),
        colours=(lowest, highest),
        unit=unit,
        stream=stream,
    )


def _scale(low: float, high: float, least: float) -> tuple[float, float, int]:
    """Round ends of a scale that holds an interval, and how many labels it has."""
    rough = max((high - low) / 7.0, least)
    unit = 10.0 ** np.floor(np.log10(rough))
    step = float(next(unit * factor for factor in (1.0, 2.0, 2.5, 5.0, 10.0) if unit * factor >= rough))
    first, last = int(np.floor(low / step)), int(np.ceil(high / step))
    return first * step, last * step, last - first + 1
