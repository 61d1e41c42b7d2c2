"""A thread in space, with its tension as colour: at rest, at times of a motion, and animated."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from scipy.interpolate import Akima1DInterpolator

from hydroelastic.fem.thread.modes import ThreadModes
from hydroelastic.fem.thread.motion_in_space import MotionInSpace
from hydroelastic.output.line_sequence import frame_numbers
from hydroelastic.output.plots import FRAMES, SECONDS
from hydroelastic.output.pictures.line import animate_line, draw_lines
from hydroelastic.output.pictures.line_view import DrawnLine, LineView, line_view
from hydroelastic.scenes.models.thread_tables import FixedEnd
from hydroelastic.scenes.thread.results import Floats, ThreadSolutionOfScene

# Points for each element of a curve that is drawn.
_SMOOTH = 8
# Pages of an animated motion, each as long as one of a mode.
_MOTION_FRAMES = 48
# Largest displacement of an animated mode, of the extent of the thread.
_AMPLITUDE = 0.08


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
