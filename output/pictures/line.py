"""Lines in space as PNG files: a thread coloured by its tension, what holds it, what it carries, the stream beside."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator
from matplotlib.transforms import Bbox
from mpl_toolkits.mplot3d.art3d import Line3DCollection
from mpl_toolkits.mplot3d.proj3d import proj_transform

from hydroelastic.output.pictures.colours import BODY, BODY_EDGE, GREY, INK, SEQUENCE, SKY
from hydroelastic.output.pictures.gif import SECONDS, write_gif
from hydroelastic.output.pictures.line_view import Array, DrawnLine, LineView
from hydroelastic.output.pictures.page import (
    FOOTER,
    HEADING,
    KEYS,
    POINT,
    WIDTH,
    ColourBar,
    arrow_key,
    exponent_of,
    new_page,
    pixels,
    place,
    save,
    write_caption,
    write_keys,
    write_title,
)

_SHADOW, _GRID, _EDGE = "#c4c4ca", "#d4d4d8", "#2a2a2a"
# Length of the longest arrow of the stream, of the diagonal of the box.
_ARROW = 0.14
# Room at the left and the right of the box, and the height of one in space over the width of the page.
_LEFT, _RIGHT, _HIGHEST = 150.0, 60.0, 0.62
# The middle of the scale of colours stands for all of it in a key.
_MIDDLE = "#21918c"
_MARK: dict[str, Any] = {"linestyle": "none", "markeredgewidth": 3.0 * POINT, "zorder": 5.0, "clip_on": False}
_HELD = _MARK | {"marker": "s", "markersize": 20.0 * POINT, "color": INK, "label": "held end"}
_BODY = _MARK | {
    "marker": "o",
    "markersize": 20.0 * POINT,
    "color": BODY,
    "markeredgecolor": BODY_EDGE,
    "label": "body",
}
_AXIS: dict[str, Any] = {"fontsize": 23.0 * POINT}


def draw_lines(view: LineView, lines: Sequence[DrawnLine], paths: Sequence[Path], *, width: int = 1600) -> None:
    """Draw pictures of one view."""
    for line, path in zip(lines, paths, strict=True):
        save(pixels(_page(view, line, width)), path)


def animate_line(
    view: LineView, lines: Sequence[DrawnLine], path: Path, *, width: int = 800, seconds: float = SECONDS
) -> None:
    """Draw pictures of one view as the pages of a GIF that repeats itself."""
    from matplotlib import colormaps

    write_gif([pixels(_page(view, line, width)) for line in lines], path, seconds=seconds, kept=colormaps[SEQUENCE])


def _page(view: LineView, line: DrawnLine, width: int) -> Figure:
    room, highest = WIDTH - _LEFT - _RIGHT, _HIGHEST * WIDTH
    across, _, up = view.high - view.low
    per_metre = min(room / across, highest / up)
    drawn = (per_metre * across, per_metre * up) if view.flat else (room, highest)
    figure = new_page(round(FOOTER + drawn[1] + HEADING), width)
    box = place(figure, _LEFT + 0.5 * (room - drawn[0]), FOOTER, *drawn)
    (_draw_plane if view.flat else _draw_space)(figure, box, view, line)
    keys: list[Artist] = [
        Line2D([], [], color=_MIDDLE, lw=6.5 * POINT, path_effects=_outlined(9.0), label="thread"),
        *(Line2D([], [], **style) for points, style in ((line.fixed, _HELD), (line.bodies, _BODY)) if len(points)),
    ]
    keys += [] if view.flat else [Line2D([], [], color=_SHADOW, lw=4.0 * POINT, label="shadow straight below")]
    if view.fastest > 0.0:
        keys.append(arrow_key(SKY, f"stream, longest arrow {view.fastest:.3g} m/s"))
    sight = "seen along y" if view.flat else "parallel projection, seen from −x, −y and above"
    write_title(figure, line.title)
    write_keys(figure, keys, KEYS)
    write_caption(figure, "; ".join(filter(None, [f"{sight}; drawn to scale", line.note])))
    exponent = exponent_of(*view.colours)
    bar = ColourBar(figure, SEQUENCE, meaning=view.quantity, measure=view.measure, exponent=exponent)
    bar.span(figure, *view.colours)
    return figure


def _draw_plane(figure: Figure, box: tuple[float, float, float, float], view: LineView, line: DrawnLine) -> None:
    axes = figure.add_axes(box, xlim=(view.low[0], view.high[0]), ylim=(view.low[2], view.high[2]))
    axes.grid(color=_GRID, lw=1.4 * POINT)
    axes.set_axisbelow(True)
    axes.spines[:].set_color(_GRID)
    axes.tick_params(labelsize=21.0 * POINT, length=8.0 * POINT, width=1.6 * POINT)
    axes.set_xlabel("x, m", **_AXIS)
    axes.set_ylabel("z, m", **_AXIS)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(MaxNLocator(8, steps=(1, 2, 5, 10)))
    starts, vectors = _stream(view)
    axes.quiver(
        *starts[:, [0, 2]].T, *vectors[:, [0, 2]].T, color=SKY, angles="xy", scale_units="xy", scale=1.0,
        units="inches", width=4.0 * POINT / 72.0, headwidth=3.8, headlength=4.5, headaxislength=4.5,
    )  # fmt: skip
    plane = line.points[:, [0, 2]]
    axes.add_collection(LineCollection([*_pieces(plane)], **_coloured(view, line)), autolim=False)
    axes.plot(*line.fixed[:, [0, 2]].T, **_HELD)
    axes.plot(*line.bodies[:, [0, 2]].T, **_BODY)


def _draw_space(figure: Figure, box: tuple[float, float, float, float], view: LineView, line: DrawnLine) -> None:
    """The line seen from the left in front and above, and its shadow straight below it."""
    axes: Any = figure.add_axes(box, projection="3d", proj_type="ortho", azim=-119.0, elev=21.5, computed_zorder=False)
    sides = view.high - view.low
    for axis, low, high, side in zip("xyz", view.low, view.high, sides, strict=True):
        getattr(axes, f"set_{axis}lim")(low, high, view_margin=0.0)
        getattr(axes, f"set_{axis}label")(f"{axis}, m", labelpad=26.0 * POINT, **_AXIS)
        own = getattr(axes, f"{axis}axis")
        # Labels of a short side would cover each other.
        own.set_major_locator(MaxNLocator(max(2, round(8.0 * side / sides.max())), steps=(1, 2, 5, 10)))
        own.set_pane_color("white")
        own.line.set_color(GREY)
        axes.tick_params(axis, labelsize=21.0 * POINT, grid_color=_GRID)
    axes.set_box_aspect(sides)
    starts, vectors = _stream(view)
    if len(starts):
        axes.quiver(*starts.T, *vectors.T, color=SKY, lw=4.0 * POINT, arrow_length_ratio=0.2)
    x, y, z = line.points.T
    axes.plot(x, y, np.full(len(z), view.low[2]), zorder=1.5, color=_SHADOW, lw=4.0 * POINT)
    axes.add_collection3d(Line3DCollection(_pieces(line.points), **_coloured(view, line)), autolim=False)
    axes.plot(*line.fixed.T, **_HELD)
    axes.plot(*line.bodies.T, **_BODY)
    _fit(figure, axes, box, sides, view)


def _fit(figure: Figure, axes: Any, box: tuple[float, float, float, float], sides: Array, view: LineView) -> None:
    """Let the box and its scales fill their room: first to the size, then to the middle."""
    left, bottom, width, height = box
    corners = np.array(list(product(*zip(view.low, view.high, strict=True))))
    for zoomed in (True, False):
        figure.draw_without_rendering()
        x, y, _ = proj_transform(*corners.T, axes.get_proj())
        edges = axes.transData.transform(np.column_stack([x, y]))
        scales = [axis.get_tightbbox() for axis in (axes.xaxis, axes.yaxis, axes.zaxis)]
        pixels_of_box = Bbox.union([Bbox([edges.min(axis=0), edges.max(axis=0)]), *scales])
        drawn = pixels_of_box.transformed(figure.transFigure.inverted())
        if zoomed:
            axes.set_box_aspect(sides, zoom=min(width / drawn.width, height / drawn.height))
        else:
            x0, y0 = 2.0 * left + 0.5 * width, 2.0 * bottom + 0.5 * height
            axes.set_position((x0 - 0.5 * (drawn.x0 + drawn.x1), y0 - 0.5 * (drawn.y0 + drawn.y1), width, height))


def _pieces(points: Array) -> Array:
    """A curve as its pieces, shape (pieces, 3, coordinates): each goes on to the next, or their joints would show."""
    return np.stack([points[:-1], points[1:], np.concatenate([points[2:], points[-1:]])], axis=1)


def _coloured(view: LineView, line: DrawnLine) -> dict[str, Any]:
    return {
        "array": 0.5 * (line.values[:-1] + line.values[1:]),
        "norm": Normalize(*view.colours),
        "cmap": SEQUENCE,
        "linewidths": 6.5 * POINT,
        "path_effects": _outlined(9.0),
        "clip_on": False,
        "zorder": 4.0,
    }


def _outlined(width: float) -> list[Any]:
    return [withStroke(linewidth=width * POINT, foreground=_EDGE)]


def _stream(view: LineView) -> tuple[Array, Array]:
    """Starts and vectors in m of arrows at a few heights, that begin at the upstream side of the box."""
    if view.stream is None or view.fastest == 0.0:
        return np.empty((0, 3)), np.empty((0, 3))
    heights, velocities = view.stream
    upstream = np.where(velocities.mean(axis=0) >= 0.0, view.low, view.high)
    middle = np.full(len(heights), 0.5 * (view.low + view.high)[1])
    starts = np.column_stack([np.full(len(heights), upstream[0]), middle, heights])
    seen = np.linalg.norm(velocities, axis=1) > 1e-3 * view.fastest
    return starts[seen], _ARROW * view.diagonal / view.fastest * velocities[seen]
