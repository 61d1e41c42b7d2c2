"""A thread as PNG files: in space with its tension as colour, tension along it, modes, stability, frames in time."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import Akima1DInterpolator

from hydroelastic.fem.thread.modes import ThreadModes
from hydroelastic.fem.thread.motion_in_space import MotionInSpace
from hydroelastic.fem.thread.stability import Stability
from hydroelastic.output.line_sequence import frame_numbers
from hydroelastic.output.pictures.colours import BLUE, GREEN, VERMILLION
from hydroelastic.output.pictures.curves import COLOURS, DASHES, GREY, Sheets, label_axes, sequence_colours
from hydroelastic.output.pictures.gif import FRAMES, SECONDS
from hydroelastic.output.pictures.line import animate_line, draw_lines
from hydroelastic.output.pictures.line_view import DrawnLine, LineView, line_view
from hydroelastic.output.pictures.options import PictureOptions
from hydroelastic.output.variables import numbered
from hydroelastic.scenes.models.thread_tables import FixedEnd
from hydroelastic.scenes.thread.results import Floats, ThreadSolutionOfScene

if TYPE_CHECKING:
    from matplotlib.axes import Axes

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


def draw_thread(solution: ThreadSolutionOfScene, folder: Path, options: PictureOptions) -> None:
    """Draw ``equilibrium.png``, ``tension.png`` and pictures of each analysis into an existing folder.

    ``modes.png``, ``stability.png``, ``motion.png`` with ``tension_in_time.png``, frames in ``frames/``; those of a
    second analysis of a kind have a number.
    """
    sheets = Sheets(folder=folder, title=solution.scene.title, options=options)
    draw_equilibrium(solution, folder / "equilibrium.png", width=options.width)
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
            draw_frames(solution, motion, frames, width=options.width)
    if options.animate:
        _animate(solution, folder, width=options.animation_width)


def _animate(solution: ThreadSolutionOfScene, folder: Path, *, width: int) -> None:
    """Animate modes as ``oscillation_001.gif`` and so on, motions as ``motion.gif``; of a second analysis with _2."""
    for number, modes in enumerate(solution.modes):
        paths = [folder / numbered(f"oscillation_{mode:03d}", number, ".gif") for mode in range(1, _ANIMATED_MODES + 1)]
        animate_modes(solution, modes, paths, width=width)
    for number, motion in enumerate(solution.motions):
        animate_motion(solution, motion, folder / numbered("motion", number, ".gif"), width=width)


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
    places = sorted({int(place) for place in np.linspace(0, len(motion.times) - 1, _SHOWN_SHAPES).round()})
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


def draw_equilibrium(solution: ThreadSolutionOfScene, path: Path, *, width: int) -> None:
    """Draw the thread at rest; the width of the picture is in pixels."""
    tensions, name = tensions_at_rest(solution)
    points = solution.rest.positions
    view = _view(solution, points, tensions, name)
    draw_lines(view, [_drawn(solution, points, tensions, solution.scene.title)], [path], width=width)


def draw_frames(solution: ThreadSolutionOfScene, motion: MotionInSpace, folder: Path, *, width: int) -> None:
    """Draw a motion at evenly spread times, from one point of view; the width of the pictures is in pixels."""
    numbers = frame_numbers(solution.scene.output.frames, len(motion.times))
    view, lines = _in_time(solution, motion, numbers)
    draw_lines(view, lines, [folder / f"frame_{place:04d}.png" for place in range(len(numbers))], width=width)


def animate_motion(solution: ThreadSolutionOfScene, motion: MotionInSpace, path: Path, *, width: int) -> None:
    """Draw a motion as a GIF that begins again at its end."""
    view, lines = _in_time(solution, motion, frame_numbers(_MOTION_FRAMES, len(motion.times)))
    if len(lines) > 1:
        animate_line(view, lines, path, width=width, seconds=SECONDS / FRAMES * len(lines))


def animate_modes(solution: ThreadSolutionOfScene, modes: ThreadModes, paths: Sequence[Path], *, width: int) -> None:
    """Draw a period of each of the slowest oscillations as a GIF, as many as there are paths at the most.

    A decay or growth within the period is left out, and said to be so: the motion goes on without a jump.
    """
    tensions, unit = tensions_at_rest(solution)
    rest, extent = solution.rest.positions, float(np.max(np.ptp(solution.rest.positions, axis=0)))
    found = zip(modes.oscillating.values, modes.oscillating.shapes, paths, strict=False)
    for number, (root, shape, path) in enumerate(found, 1):
        displacement = _interpolated(modes.nodes, solution.frame.to_space(shape), solution.s)
        displacement *= _AMPLITUDE * extent / np.max(np.linalg.norm(displacement, axis=1))
        parts = np.arange(FRAMES) / FRAMES
        instants = [rest + (displacement * np.exp(2j * np.pi * part)).real for part in parts]
        title = f"{solution.scene.title}, mode {number}: ω = {root.imag:.5g} rad/s"
        change = f"; {'growth' if root.real > 0.0 else 'decay'} {abs(root.real):.3g} 1/s left out" if root.real else ""
        note = f"largest displacement drawn as {_AMPLITUDE * extent:.3g} m (arbitrary amplitude){change}"
        lines = [
            _drawn(solution, points, tensions, f"{title}, t = {part:.2f} T", note=note)
            for points, part in zip(instants, parts, strict=True)
        ]
        view = _view(solution, np.concatenate(instants), tensions, unit, "tension at rest")
        animate_line(view, lines, path, width=width)


def tensions_at_rest(solution: ThreadSolutionOfScene) -> tuple[Floats, str]:
    """Tensions in their unit, and its name."""
    rest = solution.rest
    name, size = tension_unit(rest.tensions)
    # Tensions below their error are drawn as zero.
    known = np.abs(rest.tensions) > rest.tension_error
    return np.where(known, rest.tensions, 0.0) / size, name


def _in_time(
    solution: ThreadSolutionOfScene, motion: MotionInSpace, numbers: Sequence[int]
) -> tuple[LineView, list[DrawnLine]]:
    name, size = tension_unit(motion.tensions)
    tensions = np.asarray(motion.tensions / size)
    asked = solution.scene.motions[next(i for i, one in enumerate(solution.motions) if one is motion)]
    lines = []
    for number in numbers:
        time = motion.times[number]
        released = tuple(release.end for release in asked.release if release.time <= time)
        title = f"{solution.scene.title}, t = {time:.4g} s"
        points, values = (smooth_curve(motion.nodes, one[number]) for one in (motion.positions, tensions))
        lines.append(_drawn(solution, points, values, title, released=released))
    return _view(solution, motion.positions.reshape(-1, 3), tensions, name), lines


def _view(
    solution: ThreadSolutionOfScene, points: Floats, values: Floats, unit: str, quantity: str = "tension"
) -> LineView:
    stream = solution.thread.stream
    return line_view(points, values, quantity, unit, None if stream is None else stream.velocity_at)


def _drawn(
    solution: ThreadSolutionOfScene,
    points: Floats,
    values: Floats,
    title: str,
    *,
    released: tuple[str, ...] = (),
    note: str = "",
) -> DrawnLine:
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
    return DrawnLine(
        points=points,
        values=values,
        fixed=np.concatenate(fixed) if fixed else np.empty((0, 3)),
        bodies=np.concatenate(bodies) if bodies else np.empty((0, 3)),
        title=title,
        note=note,
    )


def _interpolated(nodes: Floats, values: np.ndarray, s: Floats) -> np.ndarray:
    """Return values between nodes on curves that do not overshoot at kinks."""
    if np.iscomplexobj(values):
        return _interpolated(nodes, values.real, s) + 1j * _interpolated(nodes, values.imag, s)
    return np.asarray(Akima1DInterpolator(nodes, values, method="makima")(s))
