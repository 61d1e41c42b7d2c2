"""A thread as PNG files: in space with its tension as colour, tension along it, modes, stability, frames in time."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.interpolate import Akima1DInterpolator

from hydroelastic.fem.picture_line import DrawnLine, LineView, draw_lines, view_of
from hydroelastic.fem.thread_modes import ThreadModes
from hydroelastic.fem.thread_stability import Stability
from hydroelastic.scenes.curve_style import COLOURS, GRID, dress, figure_file
from hydroelastic.scenes.line_sequence import frame_numbers
from hydroelastic.scenes.model_thread_parts import FixedEnd
from hydroelastic.scenes.thread_files import numbered
from hydroelastic.scenes.thread_model import stream_of
from hydroelastic.scenes.thread_results import Floats, FollowedMotion, ThreadSolutionOfScene

_SHOWN_MODES = 6
_SHOWN_SHAPES = 9
# Points for each element of a curve that is drawn.
_SMOOTH = 8


def draw_thread(solution: ThreadSolutionOfScene, folder: Path) -> None:
    """Draw ``equilibrium.png``, ``tension.png`` and pictures of each analysis into an existing folder.

    ``modes.png``, ``stability.png``, ``motion.png`` with ``tension_in_time.png``, frames in ``frames/``; those of a
    second analysis of a kind have a number.
    """
    _draw_equilibrium(solution, folder / "equilibrium.png")
    _draw_tension(solution, folder / "tension.png")
    for number, modes in enumerate(solution.modes):
        _draw_modes(solution, modes, folder / numbered("modes", number, ".png"))
    for number, sweep in enumerate(solution.stability):
        _draw_stability(solution, sweep, folder / numbered("stability", number, ".png"))
    for number, motion in enumerate(solution.motions):
        _draw_motion(solution, motion, folder / numbered("motion", number, ".png"))
        _draw_tension_in_time(solution, motion, folder / numbered("tension_in_time", number, ".png"))
        if solution.scene.output.frames:
            frames = folder / numbered("frames", number)
            frames.mkdir()
            _draw_frames(solution, motion, frames)


def _unit(tensions: Floats) -> tuple[str, float]:
    """The unit in which tensions are shown, and how many newtons it is."""
    largest = float(np.max(np.abs(tensions)))
    if largest >= 1e7:
        return "MN", 1e6
    return ("kN", 1e3) if largest >= 1e4 else ("N", 1.0)


def _divided(values: Floats, unit: float) -> Floats:
    return np.asarray(values / unit, dtype=np.float64)


def _draw_equilibrium(solution: ThreadSolutionOfScene, path: Path) -> None:
    rest = solution.rest
    name, size = _unit(rest.tensions)
    # What is smaller than its error is nothing, and has no colour.
    tensions = _divided(np.where(np.abs(rest.tensions) > rest.tension_error, rest.tensions, 0.0), size)
    view = _view(solution, rest.positions, tensions, f"tension, {name}")
    draw_lines(view, [_drawn(solution, rest.positions, tensions, solution.scene.title)], [path])


def _view(solution: ThreadSolutionOfScene, points: Floats, values: Floats, unit: str) -> LineView:
    stream = stream_of(solution.scene)
    return view_of(points, values, unit, None if stream is None else stream.velocity_at)


def _drawn(
    solution: ThreadSolutionOfScene, points: Floats, values: Floats, title: str, *, released: tuple[str, ...] = ()
) -> DrawnLine:
    """The thread with marks at ends that are held, and at bodies."""
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
    )


def _draw_tension(solution: ThreadSolutionOfScene, path: Path) -> None:
    """Tension and curvature along the thread."""
    name, size = _unit(solution.rest.tensions)
    with figure_file(solution.scene.title, path, width=8.0) as figure:
        axes = figure.subplots()
        axes.plot(solution.s, solution.rest.tensions / size, color=COLOURS[0], linewidth=1.8)
        dress(axes, "distance from end A along the thread, m", f"tension, {name}", legend=False)


def _draw_modes(solution: ThreadSolutionOfScene, modes: ThreadModes, path: Path) -> None:
    """Displacements along the thread: in the plane of the equilibrium, or along x and z, and across."""
    count = min(_SHOWN_MODES, len(modes.oscillating.values))
    if count == 0:
        return
    shapes = solution.frame.outside(modes.oscillating.shapes[:count])
    with figure_file(solution.scene.title, path, width=11.0, height=2.3 * ((count + 1) // 2) + 0.6) as figure:
        panels = figure.subplots((count + 1) // 2, 2, squeeze=False, sharex=True).ravel()
        for place, (axes, shape) in enumerate(zip(panels, shapes, strict=False)):
            largest = float(np.max(np.linalg.norm(shape, axis=1)))
            s = _smooth(modes.nodes, modes.nodes)
            real, later = (_smooth(modes.nodes, part / largest) for part in (shape.real, shape.imag))
            for number, label in enumerate(("x", "y", "z")):
                axes.plot(s, real[:, number], color=COLOURS[number], label=label)
                if np.max(np.abs(later[:, number])) > 1e-3:
                    axes.plot(s, later[:, number], "--", color=COLOURS[number])
            root = modes.oscillating.values[place]
            decay = f", decay {-root.real:.4g} 1/s" if root.real else ""
            axes.set_title(f"{place + 1}: ω = {root.imag:.5g} rad/s{decay}", fontsize=10)
            axes.grid(**GRID)
            axes.spines[["top", "right"]].set_visible(False)
        for axes in panels[count:]:
            axes.set_visible(False)
        panels[0].legend(frameon=False, ncols=3, fontsize=9, loc="best")
        figure.supxlabel("distance from end A along the thread, m", fontsize=10)
        figure.supylabel("displacement, largest 1; dashed a quarter of a period later", fontsize=10)


def _draw_stability(solution: ThreadSolutionOfScene, sweep: Stability, path: Path) -> None:
    """Real and imaginary parts of the roots against the stream."""
    with figure_file(solution.scene.title, path, width=8.0, height=7.0) as figure:
        upper, lower = figure.subplots(2, 1, sharex=True)
        for axes, part, label in (
            (upper, sweep.roots.imag, "Im λ, rad/s"),
            (lower, sweep.roots.real, "Re λ, 1/s: growth above 0"),
        ):
            axes.axhline(0.0, color=GRID["color"], linewidth=1.0)
            for number, branch in enumerate(part.T):
                axes.plot(sweep.values, branch, ".-", color=COLOURS[number % len(COLOURS)], markersize=4, linewidth=1.2)
            for threshold in sweep.thresholds:
                axes.axvline(threshold.value, color="#444444", linestyle=":", linewidth=1.2)
            dress(axes, "", label, legend=False)
        for threshold in sweep.thresholds:
            upper.annotate(
                f"{threshold.kind} {threshold.value:.5g}",
                (threshold.value, 0.98),
                xycoords=("data", "axes fraction"),
                rotation=90,
                fontsize=9,
                ha="right",
                va="top",
            )
        lower.set_xlabel("factor of the stream")


def _draw_motion(solution: ThreadSolutionOfScene, motion: FollowedMotion, path: Path) -> None:
    """Shapes of the thread at a few times, seen along y, or from three sides if it leaves the plane."""
    from matplotlib import colormaps

    places = sorted({int(place) for place in np.linspace(0, len(motion.times) - 1, _SHOWN_SHAPES).round()})
    spread = np.ptp(motion.positions.reshape(-1, 3), axis=0)
    sides = [(0, 2)] if spread[1] < 1e-6 * spread.max() else [(0, 2), (1, 2), (0, 1)]
    with figure_file(solution.scene.title, path, width=1.5 + 5.0 * len(sides), height=5.5) as figure:
        for axes, (across, up) in zip(np.atleast_1d(figure.subplots(1, len(sides))), sides, strict=True):
            for number, place in enumerate(places):
                colour = colormaps["viridis_r"](0.1 + 0.9 * number / max(len(places) - 1, 1))
                shape = _smooth(motion.nodes, motion.positions[place])
                axes.plot(shape[:, across], shape[:, up], color=colour, label=f"{motion.times[place]:.4g} s")
            axes.set_aspect("equal", adjustable="datalim")
            dress(axes, f"{'xyz'[across]}, m", f"{'xyz'[up]}, m", legend=False)
        axes.legend(frameon=False, loc="center left", bbox_to_anchor=(1.0, 0.5))


def _smooth(nodes: Floats, points: Floats) -> Floats:
    """Points on a curve through all nodes, that does not swing about a kink."""
    fine = np.interp(np.linspace(0.0, len(nodes) - 1.0, _SMOOTH * (len(nodes) - 1) + 1), np.arange(len(nodes)), nodes)
    return np.asarray(Akima1DInterpolator(nodes, points, method="makima")(fine), dtype=np.float64)


def _draw_tension_in_time(solution: ThreadSolutionOfScene, motion: FollowedMotion, path: Path) -> None:
    name, size = _unit(motion.tensions)
    with figure_file(solution.scene.title, path, width=9.0, height=4.8) as figure:
        axes = figure.subplots()
        axes.plot(motion.times, motion.tensions[:, 0] / size, color=COLOURS[0], label="end A")
        axes.plot(motion.times, motion.tensions[:, -1] / size, "--", color=COLOURS[1], label="end B")
        axes.plot(motion.times, motion.tensions.min(axis=1) / size, ":", color=COLOURS[2], label="smallest")
        dress(axes, "t, s", f"tension, {name}")


def _draw_frames(solution: ThreadSolutionOfScene, motion: FollowedMotion, folder: Path) -> None:
    """The thread in space at evenly spread times, from one point of view."""
    name, size = _unit(motion.tensions)
    tensions = _divided(motion.tensions, size)
    view = _view(solution, motion.positions.reshape(-1, 3), tensions, f"tension, {name}")
    numbers = frame_numbers(solution.scene.output.frames, len(motion.times))
    asked = solution.scene.motions[next(i for i, one in enumerate(solution.motions) if one is motion)]
    lines = []
    for number in numbers:
        time = motion.times[number]
        released = tuple(release.end for release in asked.release if release.time <= time)
        title = f"{solution.scene.title}, t = {time:.4g} s"
        points, values = _smooth(motion.nodes, motion.positions[number]), _smooth(motion.nodes, tensions[number])
        lines.append(_drawn(solution, points, values, title, released=released))
    draw_lines(view, lines, [folder / f"frame_{place:04d}.png" for place in range(len(numbers))])
