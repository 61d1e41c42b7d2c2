"""A thread as PNG files: in space with its tension as colour, tension along it, modes, stability, frames in time."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.thread.modes import ThreadModes
from hydroelastic.fem.thread.motion_in_space import MotionInSpace
from hydroelastic.fem.thread.stability import Stability
from hydroelastic.output.plots import (
    BLUE,
    COLOURS,
    DASHES,
    GREEN,
    GREY,
    VERMILLION,
    PictureOptions,
    Sheets,
    few,
    label_axes,
    sequence_colours,
)
from hydroelastic.output.variables import numbered
from hydroelastic.scenes.thread.line_pictures import (
    animate_modes,
    animate_motion,
    draw_equilibrium,
    draw_frames,
    smooth_curve,
    tension_unit,
    tensions_at_rest,
)
from hydroelastic.scenes.thread.results import Floats, ThreadSolutionOfScene

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_SHOWN_MODES = 6
_SHOWN_SHAPES = 9
_ANIMATED_MODES = 3
# Of the largest displacement: smaller components are not drawn.
_MOVES = 1e-3
_ALONG = "distance from end A along the thread, m"


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
