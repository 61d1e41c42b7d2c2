"""A thread as PNG files: in space with its tension as colour, tension along it, modes, stability, frames in time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import Akima1DInterpolator

from hydroelastic.fem.thread.modes import ThreadModes
from hydroelastic.fem.thread.motion_in_space import MotionInSpace
from hydroelastic.fem.thread.stability import Stability
from hydroelastic.output.line_sequence import frame_numbers
from hydroelastic.output.plots import (
    BLUE,
    BODY,
    BODY_EDGE,
    COLOURS,
    DASHES,
    FRAMES,
    GREEN,
    GREY,
    INK,
    PAGE,
    SECONDS,
    SEQUENCE,
    SKY,
    VERMILLION,
    PictureOptions,
    Sheets,
    add_colour_bar,
    arrow_key,
    few,
    label_axes,
    new_page,
    page_box,
    page_style,
    part_of_colours,
    pixels,
    sequence_colours,
    write_caption,
    write_gif,
    write_keys,
    write_meaning,
    write_title,
)
from hydroelastic.output.variables import numbered
from hydroelastic.scenes.models.thread_tables import FixedEnd
from hydroelastic.scenes.thread.results import Floats, ThreadSolutionOfScene

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SHOWN_MODES = 6
_SHOWN_SHAPES = 9
_ANIMATED_MODES = 3
# Of the largest displacement: smaller components are not drawn.
_MOVES = 1e-3
_ALONG = "distance from end A along the thread, m"

# Points for each element of a curve that is drawn.
_SMOOTH = 8
# Pages of an animated motion, each as long as one of a mode.
_MOTION_FRAMES = 48
# Largest displacement of an animated mode, of the extent of the thread.
_AMPLITUDE = 0.08
# Room around the box, and the height of one in space, inches of a page; arrows of the stream, the longest of the
# diagonal of the box.
_LEFT, _RIGHT, _FOOTER, _HEADING, _HIGHEST = 1.5, 0.6, 2.85, 0.85, 9.9
_ARROWS, _ARROW = 7, 0.14
_GRID, _SHADOW = "#d4d4d8", "#c4c4ca"
_MARK: dict[str, Any] = {"linestyle": "none", "markersize": 14.4, "zorder": 5.0, "clip_on": False}
_HELD = _MARK | {"marker": "s", "color": INK, "label": "held end"}
_BODY = _MARK | {"marker": "o", "color": BODY, "markeredgecolor": BODY_EDGE, "markeredgewidth": 2.2, "label": "body"}


def draw_thread(solution: ThreadSolutionOfScene, folder: Path, options: PictureOptions) -> None:
    """Draw ``equilibrium.png``, ``tension.png`` and pictures of each analysis into an existing folder.

    ``modes.png``, ``stability.png``, ``motion.png`` with ``tension_in_time.png``, frames in ``frames/``; those of a
    second analysis of a kind have a number.
    """
    sheets = Sheets(folder=folder, title=solution.scene.title, options=options)
    draw_equilibrium(solution, sheets)
    _draw_tension(solution, sheets)
    for number, modes in enumerate(solution.modes):
        _draw_modes(solution, modes, sheets, numbered("modes", number))
    for number, sweep in enumerate(solution.stability):
        _draw_stability(sweep, sheets, numbered("stability", number))
    for number, motion in enumerate(solution.motions):
        _draw_motion(motion, sheets, numbered("motion", number))
        _draw_tension_in_time(motion, sheets, numbered("tension_in_time", number))
        if solution.scene.output.frames:
            frames = folder / numbered("frames", number)
            frames.mkdir()
            draw_frames(solution, motion, replace(sheets, folder=frames))
    if options.animate:
        _animate(solution, sheets)


def _animate(solution: ThreadSolutionOfScene, sheets: Sheets) -> None:
    """Animate modes as ``oscillation_001.gif`` and so on, motions as ``motion.gif``; of a second analysis with _2."""
    for number, modes in enumerate(solution.modes):
        names = [numbered(f"oscillation_{mode:03d}", number) for mode in range(1, _ANIMATED_MODES + 1)]
        animate_modes(solution, modes, names, sheets)
    for number, motion in enumerate(solution.motions):
        animate_motion(solution, motion, numbered("motion", number), sheets)


def _draw_tension(solution: ThreadSolutionOfScene, sheets: Sheets) -> None:
    tensions, unit = tensions_at_rest(solution)
    with sheets.sheet("tension", "tension at rest", width=8.0) as figure:
        axes = figure.subplots()
        axes.plot(solution.s, tensions, color=BLUE)
        label_axes(axes, _ALONG, f"tension, {unit}", legend="")


def _draw_modes(solution: ThreadSolutionOfScene, modes: ThreadModes, sheets: Sheets, name: str) -> None:
    """Displacements along the thread: in the plane of the equilibrium, or along x and z, and across."""
    count = min(_SHOWN_MODES, len(modes.oscillating.values))
    if count == 0:
        return
    shapes = solution.frame.to_space(modes.oscillating.shapes[:count])
    rows = (count + 1) // 2
    with sheets.sheet(name, "free motions about the equilibrium", width=11.0, height=2.4 * rows + 1.2) as figure:
        panels = figure.subplots(rows, 2, squeeze=False, sharex=True, sharey=True).ravel()
        for number, (axes, shape) in enumerate(zip(panels, shapes, strict=False)):
            _plot_mode(axes, modes.nodes, shape)
            root = modes.oscillating.values[number]
            decay = f", decay {-root.real:.4g} 1/s" if root.real else ""
            axes.set_title(f"Mode {number + 1}: ω = {root.imag:.5g} rad/s{decay}")
        panels[0].set_ylim(-1.1, 1.1)
        for axes in panels[count:]:
            axes.set_visible(False)
        for axes in panels[max(count - 2, 0) : count]:
            # Shared axes hide the numbers of panels that have others below them; the last row may be short.
            axes.tick_params(labelbottom=True)
            axes.set_xlabel(_ALONG)
        for place, words in enumerate(("along x", "along y", "along z")):
            panels[0].plot([], [], color=COLOURS[place], label=words)
        if any(line.get_linestyle() == "--" for axes in panels for line in axes.get_lines()):
            panels[0].plot([], [], "--", color=GREY, label="a quarter of a period later")
        figure.legend(loc="outside lower center", ncols=4)
        figure.supylabel("displacement over the largest one", fontsize="medium")


def _plot_mode(axes: Axes, nodes: Floats, shape: NDArray[np.complex128]) -> None:
    """The components that move, and a quarter of a period later, if they then do."""
    largest = float(np.max(np.linalg.norm(shape, axis=1)))
    s = smooth_curve(nodes, nodes)
    for part, dashes in ((shape.real, "-"), (shape.imag, "--")):
        for place, component in enumerate(smooth_curve(nodes, np.asarray(part / largest, dtype=np.float64)).T):
            if np.max(np.abs(component)) > _MOVES:
                axes.plot(s, component, dashes, color=COLOURS[place])


def _draw_stability(sweep: Stability, sheets: Sheets, name: str) -> None:
    """Draw real and imaginary parts of the roots against the stream; of a conjugate pair that with Im λ > 0."""
    with sheets.sheet(name, "free motions exp(λt) against the stream", width=8.0, height=7.5) as figure:
        upper, lower = figure.subplots(2, 1, sharex=True)
        for number, branch in enumerate(_different(sweep.roots)):
            # Dashes let one see two that lie on each other.
            style: dict[str, Any] = {"color": COLOURS[number % len(COLOURS)], "marker": "."}
            style |= {"linestyle": DASHES[number % len(DASHES)], "label": f"free motion {number + 1}"}
            upper.plot(sweep.values, branch.imag, **style)
            lower.plot(sweep.values, branch.real, **style)
        lower.axhline(0.0, color=GREY, linewidth=0.9)
        for number, threshold in enumerate(sweep.thresholds):
            for axes in (upper, lower):
                dashes = DASHES[1 + number % 3]
                axes.axvline(threshold.value, color="black", linestyle=dashes, linewidth=1.3)
            lower.plot([], [], dashes, color="black", label=f"{threshold.kind} at {threshold.value:.5g}")
        label_axes(upper, "", "frequency |Im λ|, rad/s", legend="")
        label_axes(lower, "factor of the stream", "growth Re λ, 1/s", legend="below")


def _different(roots: NDArray[np.complex128]) -> list[NDArray[np.complex128]]:
    """Roots without those that are conjugate to another one at all values, shape (roots, values)."""
    kept: list[NDArray[np.complex128]] = []
    for branch in roots.T:
        upwards = branch.real + 1j * np.abs(branch.imag)
        if not any(np.allclose(upwards, other, rtol=1e-6, atol=1e-9, equal_nan=True) for other in kept):
            kept.append(upwards)
    return kept


def _draw_motion(motion: MotionInSpace, sheets: Sheets, name: str) -> None:
    """The thread at a few times, seen along y, or from three sides if it leaves the plane; how far it has moved."""
    places = few(len(motion.times), _SHOWN_SHAPES)
    spread = np.ptp(motion.positions.reshape(-1, 3), axis=0)
    sides = [(0, 2)] if spread[1] < 1e-6 * spread.max() else [(0, 2), (1, 2), (0, 1)]
    s = smooth_curve(motion.nodes, motion.nodes)
    first = smooth_curve(motion.nodes, motion.positions[0])
    # Four panels stand two by two: side by side their text would be too small.
    rows = (len(sides) + 1) // 2
    with sheets.sheet(name, "shapes at some times", width=12.0, height=0.6 + 4.8 * rows) as figure:
        *panels, last = figure.subplots(rows, 2).ravel()
        for place, colour in zip(places, sequence_colours(len(places)), strict=True):
            label = f"{motion.times[place]:.4g} s"
            shape = smooth_curve(motion.nodes, motion.positions[place])
            for axes, (across, up) in zip(panels, sides, strict=True):
                axes.plot(shape[:, across], shape[:, up], color=colour)
            last.plot(s, np.linalg.norm(shape - first, axis=1), color=colour, label=label)
        for axes, (across, up) in zip(panels, sides, strict=True):
            axes.set_aspect("equal", adjustable="datalim")
            label_axes(axes, f"{'xyz'[across]}, m", f"{'xyz'[up]}, m", legend="")
        label_axes(last, _ALONG, "distance moved since the first time, m", legend="beside", heading="time t")


def _draw_tension_in_time(motion: MotionInSpace, sheets: Sheets, name: str) -> None:
    extremes, times = motion.extremes, motion.step_ends
    unit, size = tension_unit(np.concatenate([extremes.highest, extremes.lowest]))
    with sheets.sheet(name, "tension in time", width=9.0, height=4.8) as figure:
        axes = figure.subplots()
        # Where the smallest or largest tension is that of an end, it shows beside that one's narrower line.
        beneath: dict[str, Any] = {"linewidth": 5.0, "alpha": 0.4}
        axes.plot(times, extremes.lowest / size, color=GREEN, label="smallest along the thread", **beneath)
        axes.plot(times, extremes.highest / size, color=GREY, label="largest along the thread", **beneath)
        axes.plot(times, extremes.end_tensions[:, 0] / size, color=BLUE, label="end A")
        axes.plot(times, extremes.end_tensions[:, 1] / size, "--", color=VERMILLION, label="end B")
        label_axes(axes, "time t, s", f"tension, {unit}")


@dataclass(frozen=True)
class _Line:
    """A thread: points, m, shape (n, 3), its tensions there, held ends and bodies, title and note of its picture."""

    points: Floats
    tensions: Floats
    held: Floats
    bodies: Floats
    title: str
    note: str


def tension_unit(tensions: Floats) -> tuple[str, float]:
    """The unit in which tensions are shown, and how many newtons it is."""
    largest = float(np.max(np.abs(tensions)))
    if largest >= 1e7:
        return "MN", 1e6
    return ("kN", 1e3) if largest >= 1e4 else ("N", 1.0)


def smooth_curve(nodes: Floats, points: Floats) -> Floats:
    """Return points on a curve through all nodes that does not overshoot at kinks."""
    fine = np.interp(np.linspace(0.0, len(nodes) - 1.0, _SMOOTH * (len(nodes) - 1) + 1), np.arange(len(nodes)), nodes)
    return _interpolated(nodes, points, fine)


def draw_equilibrium(solution: ThreadSolutionOfScene, sheets: Sheets) -> None:
    """Draw the thread at rest."""
    tensions, unit = tensions_at_rest(solution)
    line = _line(solution, solution.rest.positions, tensions, solution.scene.title)
    _draw_lines(_View(solution, line.points, tensions, f"tension, {unit}"), [line], ["equilibrium"], sheets)


def draw_frames(solution: ThreadSolutionOfScene, motion: MotionInSpace, sheets: Sheets) -> None:
    """Draw a motion at evenly spread times, from one point of view, as PNG files."""
    numbers = frame_numbers(solution.scene.output.frames, len(motion.times))
    view, lines = _in_time(solution, motion, numbers)
    frames = replace(sheets, options=replace(sheets.options, formats=("png",)))
    _draw_lines(view, lines, [f"frame_{number:04d}" for number in range(len(numbers))], frames)


def animate_motion(solution: ThreadSolutionOfScene, motion: MotionInSpace, name: str, sheets: Sheets) -> None:
    """Draw a motion as a GIF that begins again at its end."""
    view, lines = _in_time(solution, motion, frame_numbers(_MOTION_FRAMES, len(motion.times)))
    if len(lines) > 1:
        _animate_lines(view, lines, name, sheets)


def animate_modes(solution: ThreadSolutionOfScene, modes: ThreadModes, names: Sequence[str], sheets: Sheets) -> None:
    """Draw a period of each of the slowest oscillations as a GIF, as many as there are names at the most.

    A decay or growth within the period is left out, and said to be so: the motion goes on without a jump.
    """
    tensions, unit = tensions_at_rest(solution)
    rest, extent = solution.rest.positions, float(np.max(np.ptp(solution.rest.positions, axis=0)))
    found = zip(modes.oscillating.values, modes.oscillating.shapes, names, strict=False)
    for number, (root, shape, name) in enumerate(found, 1):
        displacement = _interpolated(modes.nodes, solution.frame.to_space(shape), solution.s)
        displacement *= _AMPLITUDE * extent / np.max(np.linalg.norm(displacement, axis=1))
        parts = np.arange(FRAMES) / FRAMES
        instants = [rest + (displacement * np.exp(2j * np.pi * part)).real for part in parts]
        title = f"{solution.scene.title}, mode {number}: ω = {root.imag:.5g} rad/s, T = {2.0 * np.pi / root.imag:.4g} s"
        change = f"; {'growth' if root.real > 0.0 else 'decay'} {abs(root.real):.3g} 1/s left out" if root.real else ""
        note = f"; largest displacement drawn as {_AMPLITUDE * extent:.3g} m (arbitrary amplitude){change}"
        lines = [
            _line(solution, points, tensions, f"{title}, t = {part:.2f} T", note=note)
            for points, part in zip(instants, parts, strict=True)
        ]
        view = _View(solution, np.concatenate(instants), tensions, f"tension at rest, {unit}")
        _animate_lines(view, lines, name, sheets)


def tensions_at_rest(solution: ThreadSolutionOfScene) -> tuple[Floats, str]:
    """Tensions in their unit, and its name."""
    rest = solution.rest
    name, size = tension_unit(rest.tensions)
    # Tensions below their error are drawn as zero.
    known = np.abs(rest.tensions) > rest.tension_error
    return np.where(known, rest.tensions, 0.0) / size, name


def _in_time(
    solution: ThreadSolutionOfScene, motion: MotionInSpace, numbers: Sequence[int]
) -> tuple[_View, list[_Line]]:
    name, size = tension_unit(motion.tensions)
    tensions = np.asarray(motion.tensions / size)
    asked = solution.scene.motions[next(i for i, one in enumerate(solution.motions) if one is motion)]
    lines = []
    for number in numbers:
        time = motion.times[number]
        released = tuple(release.end for release in asked.release if release.time <= time)
        title = f"{solution.scene.title}, t = {time:.4g} s"
        points, values = (smooth_curve(motion.nodes, one[number]) for one in (motion.positions, tensions))
        lines.append(_line(solution, points, values, title, released=released))
    return _View(solution, motion.positions.reshape(-1, 3), tensions, f"tension, {name}"), lines


def _line(
    solution: ThreadSolutionOfScene,
    points: Floats,
    values: Floats,
    title: str,
    *,
    released: tuple[str, ...] = (),
    note: str = "",
) -> _Line:
    scene, s = solution.scene, np.linspace(0.0, solution.scene.thread.length, len(points))
    s = solution.s if len(points) == len(solution.s) else s
    ends = {"a": (scene.ends.a, points[:1]), "b": (scene.ends.b, points[-1:])}
    fixed = [place for name, (end, place) in ends.items() if isinstance(end, FixedEnd) and name not in released]
    bodies = [
        place
        for end, place in ends.values()
        if not isinstance(end, FixedEnd) and (end.weight or end.drag_area or end.mass or end.kind == "surface")
    ]
    bodies += [
        np.array([[np.interp(load.at, s, column) for column in points.T]])
        for load in scene.load
        if s[0] <= load.at <= s[-1]
    ]
    none = np.empty((0, 3))
    return _Line(points, values, np.vstack([none, *fixed]), np.vstack([none, *bodies]), title, note)


class _View:
    """What stays the same on all pictures of a thread: the box, the scale of colours, the stream beside."""

    def __init__(self, solution: ThreadSolutionOfScene, points: Floats, values: Floats, quantity: str) -> None:
        low, high = points.min(axis=0), points.max(axis=0)
        size = float(np.max(high - low))
        # Strokes stay within the box, and what is almost straight is not shown in a slit.
        margin = np.maximum(0.04 * size, 0.5 * (0.2 * size - (high - low)))
        self.flat = bool(high[1] - low[1] < 1e-6 * size)
        floor, top = (low[2], high[2]) if high[2] - low[2] > 0.2 * size else (low[2] - margin[2], high[2] + margin[2])
        self.low, self.high, self.quantity = low - margin, high + margin, quantity
        if self.flat:
            self.low[1] = self.high[1] = points[0, 1]
        least, most = float(values.min()), float(values.max())
        half = (0.5 * abs(most) or 1.0) if most - least <= 1e-9 * abs(most) else 0.0
        self.colours = least - half, most + half
        self.starts = self.vectors = np.empty((0, 3))
        self.fastest, stream = 0.0, solution.thread.stream
        if stream is not None:
            # Below the lowest point there may be the bed: the stream is not shown as if the sea went on.
            heights = np.linspace(floor, top, _ARROWS + 2)[1:-1]
            middle = 0.5 * (self.low + self.high)
            velocities = np.asarray(
                stream.velocity_at(np.column_stack([np.tile(middle[:2], (_ARROWS, 1)), heights])), float
            )
            speeds = np.linalg.norm(velocities, axis=1)
            self.fastest = float(speeds.max())
            seen = speeds > 1e-3 * self.fastest
            upstream = (self.low if velocities[:, 0].mean() >= 0.0 else self.high)[0]
            self.starts = np.column_stack([np.full(_ARROWS, upstream), np.full(_ARROWS, middle[1]), heights])[seen]
            longest = _ARROW * float(np.linalg.norm(self.high - self.low))
            self.vectors = longest / (self.fastest or 1.0) * velocities[seen]


def _draw_lines(view: _View, lines: Sequence[_Line], names: Sequence[str], sheets: Sheets) -> None:
    with page_style():
        for line, name in zip(lines, names, strict=True):
            sheets.save(_page(view, line, sheets.options.width), name)


def _animate_lines(view: _View, lines: Sequence[_Line], name: str, sheets: Sheets) -> None:
    with page_style():
        pages = [pixels(_page(view, line, sheets.options.animation_width)) for line in lines]
    seconds, kept = SECONDS / FRAMES * len(lines), part_of_colours(SEQUENCE, 0.0, 1.0)
    write_gif(pages, sheets.folder / f"{name}.gif", seconds=seconds, kept=kept)


def _page(view: _View, line: _Line, width: int) -> Figure:
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize
    from matplotlib.lines import Line2D

    room = PAGE - _LEFT - _RIGHT
    across, _, up = view.high - view.low
    scale = min(room / across, _HIGHEST / up)
    wide, high = (scale * across, scale * up) if view.flat else (room, _HIGHEST)
    figure = new_page(width, round(_FOOTER + high + _HEADING, 2))
    box = page_box(figure, _LEFT + 0.5 * (room - wide), _FOOTER, wide, high)
    coloured = ScalarMappable(Normalize(*view.colours), SEQUENCE)
    (_draw_plane if view.flat else _draw_space)(figure, box, view, line, coloured)
    keys = [Line2D([], [], color="#21918c", lw=4.7, path_effects=_outlined(), label="thread")]
    keys += [Line2D([], [], **style) for points, style in ((line.held, _HELD), (line.bodies, _BODY)) if len(points)]
    keys += [] if view.flat else [Line2D([], [], color=_SHADOW, lw=2.9, label="shadow straight below")]
    if view.fastest > 0.0:
        words = f"stream, longest arrow {view.fastest:.3g} m/s"
        keys.append(arrow_key(SKY, words))
    write_keys(figure, keys)
    add_colour_bar(figure, coloured)
    write_meaning(figure, view.quantity)
    sight = "seen along y" if view.flat else "parallel projection, seen from −x, −y and above"
    write_title(figure, line.title)
    write_caption(figure, f"{sight}; drawn to scale{line.note}")
    return figure


def _draw_plane(figure: Figure, box: Any, view: _View, line: _Line, coloured: Any) -> None:
    from matplotlib.collections import LineCollection

    axes = figure.add_axes(box, xlim=(view.low[0], view.high[0]), ylim=(view.low[2], view.high[2]))
    axes.grid(color=_GRID)
    axes.spines[:].set(color=_GRID, visible=True)
    axes.set_xlabel("x, m")
    axes.set_ylabel("z, m")
    axes.locator_params(nbins=8, steps=(1, 2, 5, 10))
    starts, vectors = (of[:, [0, 2]].T for of in (view.starts, view.vectors))
    axes.quiver(*starts, *vectors, color=SKY, angles="xy", scale_units="xy", scale=1.0, units="inches", width=0.04,
                headwidth=3.8, headlength=4.5, headaxislength=4.5)  # fmt: skip
    axes.add_collection(LineCollection(list(_pieces(line.points[:, [0, 2]])), **_stroke(line, coloured)), autolim=False)
    axes.plot(*line.held[:, [0, 2]].T, **_HELD)
    axes.plot(*line.bodies[:, [0, 2]].T, **_BODY)


def _draw_space(figure: Figure, box: Any, view: _View, line: _Line, coloured: Any) -> None:
    """The line seen from the left in front and above, and its shadow straight below it."""
    from matplotlib.ticker import MaxNLocator
    from mpl_toolkits.mplot3d.art3d import Line3DCollection

    axes: Any = figure.add_axes(box, projection="3d", proj_type="ortho", azim=-119.0, elev=21.5, computed_zorder=False)
    sides = view.high - view.low
    for axis, low, high, side in zip("xyz", view.low, view.high, sides, strict=True):
        getattr(axes, f"set_{axis}lim")(low, high, view_margin=0.0)
        getattr(axes, f"set_{axis}label")(f"{axis}, m", labelpad=19.0)
        own = getattr(axes, f"{axis}axis")
        # Labels of a short side would cover each other.
        own.set_major_locator(MaxNLocator(max(2, round(8.0 * side / sides.max())), steps=(1, 2, 5, 10)))
        own.set_pane_color("white")
        own.line.set_color(GREY)
        axes.tick_params(axis, grid_color=_GRID)
    axes.set_box_aspect(sides)
    axes.grid(True)
    if len(view.starts):
        axes.quiver(*view.starts.T, *view.vectors.T, color=SKY, lw=2.9, arrow_length_ratio=0.2)
    x, y, z = line.points.T
    axes.plot(x, y, np.full(len(z), view.low[2]), zorder=1.5, color=_SHADOW, lw=2.9)
    axes.add_collection3d(Line3DCollection(_pieces(line.points), **_stroke(line, coloured)), autolim=False)
    axes.plot(*line.held.T, **_HELD)
    axes.plot(*line.bodies.T, **_BODY)
    _fit(figure, axes, box, view)


def _fit(figure: Figure, axes: Any, box: tuple[float, float, float, float], view: _View) -> None:
    """Let the box and its scales fill their room: first to the size, then to the middle."""
    from matplotlib.transforms import Bbox
    from mpl_toolkits.mplot3d.proj3d import proj_transform

    left, bottom, width, height = box
    corners = np.array(list(product(*zip(view.low, view.high, strict=True))))
    for zoomed in (True, False):
        figure.draw_without_rendering()
        x, y, _ = proj_transform(*corners.T, axes.get_proj())
        edges = axes.transData.transform(np.column_stack([x, y]))
        scales = [axis.get_tightbbox() for axis in (axes.xaxis, axes.yaxis, axes.zaxis)]
        drawn = Bbox.union([Bbox([edges.min(axis=0), edges.max(axis=0)]), *scales])
        drawn = drawn.transformed(figure.transFigure.inverted())
        if zoomed:
            axes.set_box_aspect(view.high - view.low, zoom=min(width / drawn.width, height / drawn.height))
        else:
            x0, y0 = 2.0 * left + 0.5 * width, 2.0 * bottom + 0.5 * height
            axes.set_position((x0 - 0.5 * (drawn.x0 + drawn.x1), y0 - 0.5 * (drawn.y0 + drawn.y1), width, height))


def _pieces(points: Floats) -> Floats:
    """A curve as its pieces, shape (pieces, 3, coordinates): each goes on to the next, or their joints would show."""
    return np.stack([points[:-1], points[1:], np.concatenate([points[2:], points[-1:]])], axis=1)


def _stroke(line: _Line, coloured: Any) -> dict[str, Any]:
    colours = coloured.to_rgba(0.5 * (line.tensions[:-1] + line.tensions[1:]))
    return {"colors": colours, "linewidths": 4.7, "path_effects": _outlined(), "clip_on": False, "zorder": 4.0}


def _outlined() -> list[Any]:
    from matplotlib.patheffects import withStroke

    return [withStroke(linewidth=6.5, foreground="#2a2a2a")]


def _interpolated(nodes: Floats, values: np.ndarray, s: Floats) -> np.ndarray:
    """Return values between nodes on curves that do not overshoot at kinks."""
    if np.iscomplexobj(values):
        return _interpolated(nodes, values.real, s) + 1j * _interpolated(nodes, values.imag, s)
    return np.asarray(Akima1DInterpolator(nodes, values, method="makima")(s))
