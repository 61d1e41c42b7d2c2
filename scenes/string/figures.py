"""The motion of a hanging string as PNG files: over height and time, its shapes, its modes, frames of an animation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from hydroelastic.modal.string.solution import Floats, StringSolution
from hydroelastic.output.line_sequence import frame_numbers
from hydroelastic.output.plots import (
    BLUE,
    COLOURS,
    DASHES,
    FRAMES,
    GREY,
    SECONDS,
    PictureOptions,
    Sheets,
    label_axes,
    part_of_colours,
    pixels,
    sequence_colours,
    style,
    write_gif,
)
from hydroelastic.scenes.models.string_parts import DEFAULT_POSITIONS, DEFAULT_TIMES
from hydroelastic.scenes.string.results import StringResult
from hydroelastic.scenes.string.solve import solve_series

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SHOWN_SHAPES = 9
_SHOWN_MODES = 5
# Quantile of |U| that limits the colour scale: a few peaks at focuses would dominate it.
_QUANTILE = 0.995
# Times this quantile a value is a peak.
_PEAK = 1.5
_FEW_POSITIONS = 20
# Part of the largest |U| of a shape by which neighbouring positions beside a front differ where the string jumps there.
_JUMP = 0.1

HEIGHT = "height above the free end, m"
"""What the axis of all pictures of the string says."""

_MOTION_FRAMES = 60
_ANIMATION_DPI = 80

# Numbers of times and of positions from which a motion and a shape are drawn smooth.
_ENOUGH_TIMES = 61
_ENOUGH_POSITIONS = 61
# Positions and times at which the fronts of a step are lines and no stairs.
_OF_FRONTS = (301, 801)


def draw_string(result: StringResult, folder: Path, options: PictureOptions) -> None:
    """Draw ``space_time.png``, ``shapes.png``, ``modes.png``, and frames in ``frames/``, into an existing folder.

    ``motion.gif`` is drawn if asked.
    """
    sheets = Sheets(folder=folder, title=result.scene.title, options=options)
    times, drawn = result.solution.times, drawn_solution(result)
    if len(drawn.positions) > 1 and len(drawn.times) > 1:
        _draw_space_time(drawn, sheets)
        _draw_modes(drawn, sheets)
    _draw_shapes(drawn, times, sheets)
    if result.scene.output.frames:
        (folder / "frames").mkdir()
        numbers = frame_numbers(result.scene.output.frames, len(times))
        draw_frames(drawn, columns_of(drawn, times[numbers]), folder / "frames", options)
    if options.animate:
        animate_string(drawn, folder / "motion.gif", options)


def _draw_space_time(solution: StringSolution, sheets: Sheets) -> None:
    """U over time and height; blue to red, white at rest; the first front dashed."""
    from matplotlib.colors import Normalize
    from matplotlib.image import NonUniformImage

    displacement = _bridged(solution.times, solution.displacement, solution.trusted)
    low, high = _colour_limits(displacement)
    limit = max(-low, high)
    beyond = 2 * int(displacement.max() > high) + int(displacement.min() < low)
    with sheets.sheet("space_time", "displacement over time and height", width=10.0, height=6.0) as figure:
        axes = figure.subplots()
        colours = part_of_colours("RdBu_r", 0.5 + 0.5 * low / limit, 0.5 + 0.5 * high / limit)
        sides = (solution.times[0], solution.times[-1]), (solution.positions[0], solution.positions[-1])
        norm = Normalize(low, high)
        picture = NonUniformImage(axes, interpolation="bilinear", cmap=colours, norm=norm, extent=sides[0] + sides[1])
        picture.set_data(solution.times, solution.positions, displacement)
        axes.add_image(picture)
        figure.colorbar(picture, ax=axes, label="displacement U, m", extend=("neither", "min", "max", "both")[beyond])
        front = solution.string.arrival_times(solution.positions)
        axes.plot(front, solution.positions, "--", color="black", linewidth=1.0, label="first wave front")
        axes.grid(visible=False)
        axes.set(xlim=sides[0], ylim=sides[1])
        label_axes(axes, "time t, s", HEIGHT)


def _colour_limits(displacement: Floats) -> tuple[float, float]:
    """Limits of the colour scale of U, with zero between them; a few peaks may exceed them."""
    sizes = np.abs(displacement)
    usual, largest = float(np.quantile(sizes, _QUANTILE)), float(sizes.max())
    limit = (largest if largest < _PEAK * usual else usual) or largest
    low, high = max(float(displacement.min()), -limit), min(float(displacement.max()), limit)
    # A string at rest is white.
    return (min(low, 0.0), max(high, 0.0)) if limit else (-1.0, 1.0)


def _bridged(along: Floats, displacement: Floats, trusted: np.ndarray) -> Floats:
    """U along its rows, with what cannot be trusted beside a front replaced by what lies between its neighbours.

    At a front U jumps, or grows without bound: a few values taken there by chance would look like spots.
    """
    bridged = displacement.copy()
    for row, known in zip(bridged, trusted, strict=True):
        if known.any():
            row[~known] = np.interp(along[~known], along[known], row[known])
    return bridged


def _draw_shapes(solution: StringSolution, times: Floats, sheets: Sheets) -> None:
    """The string at a few of some times, from light to dark; dotted across a front, where its course is not known."""
    places = columns_of(solution, times[frame_numbers(_SHOWN_SHAPES, len(times))])
    known = solution.trusted[:, places]
    bridged = _bridged(solution.positions, solution.displacement[:, places].T, known.T)
    with sheets.sheet("shapes", "shapes at some times", width=6.5, height=7.5) as figure:
        axes = figure.subplots()
        for place, curve, sure, colour in zip(places, bridged, known.T, sequence_colours(len(places)), strict=True):
            label = f"{solution.times[place]:.4g} s"
            axes.plot(curve, solution.positions, ":", color=colour, linewidth=1.2)
            # At t = 0 the end has jumped, and both sides of the front are known.
            jumps = np.abs(np.diff(curve)) > _JUMP * np.abs(curve).max()
            cuts = 1 + np.flatnonzero(jumps & solution.beside_fronts[1:, place] & solution.beside_fronts[:-1, place])
            shape = np.insert(np.where(sure, curve, np.nan), cuts, np.nan)
            heights = np.insert(solution.positions, cuts, np.nan)
            axes.plot(shape, heights, **_drawn(solution), color=colour, label=label)
        if not known.all():
            axes.plot([], [], ":", color=GREY, linewidth=1.2, label="across a front")
        label_axes(axes, "displacement U, m", HEIGHT, legend="beside", heading="time t")
        axes.locator_params(axis="x", nbins=6)


def _draw_modes(solution: StringSolution, sheets: Sheets) -> None:
    motions = solution.free_motions
    with sheets.sheet("modes", "free motions", width=6.5, height=7.5) as figure:
        axes = figure.subplots()
        axes.axvline(0.0, color=GREY, linewidth=0.8)
        for number, (shape, root) in enumerate(zip(motions.shapes[:_SHOWN_MODES], motions.roots, strict=False)):
            oscillation = f"ω = {root.imag:.5g} rad/s" if root.imag else "aperiodic"
            decay = f", decay {-root.real:.4g} 1/s" if root.real else ""
            style = {"color": COLOURS[number], "linestyle": DASHES[number % len(DASHES)]} | _drawn(solution)
            axes.plot(shape, solution.positions, **style, label=f"{number + 1}: {oscillation}{decay}")
        label_axes(axes, "displacement over the largest one", HEIGHT)


def _drawn(solution: StringSolution) -> dict[str, Any]:
    return {"marker": "o" if len(solution.positions) <= _FEW_POSITIONS else None}


def draw_frames(solution: StringSolution, numbers: Sequence[int], folder: Path, options: PictureOptions) -> None:
    """Draw the string at some of its times, numbered as players of sequences expect."""
    for number, figure in enumerate(_frames(solution, numbers, options.scale, options.dpi)):
        pixels(figure).save(folder / f"frame_{number:04d}.png")


def animate_string(solution: StringSolution, path: Path, options: PictureOptions) -> None:
    """Draw the motion at evenly spread times as a GIF that begins again at its end."""
    numbers = columns_of(solution, np.linspace(solution.times[0], solution.times[-1], _MOTION_FRAMES))
    if len(numbers) < 2:
        return
    pages = [pixels(figure) for figure in _frames(solution, numbers, options.scale, _ANIMATION_DPI)]
    write_gif(pages, path, seconds=SECONDS / FRAMES * len(pages))


def _frames(solution: StringSolution, numbers: Sequence[int], scale: float, dpi: int) -> Iterator[Figure]:
    from matplotlib.figure import Figure

    with style():
        figure = Figure(figsize=(5.0 * scale, 6.0 * scale), dpi=dpi, layout="constrained")
        axes = figure.subplots()
        reach = 1.05 * max(solution.largest, 1e-300)
        axes.set_xlim(-reach, reach)
        axes.set_ylim(0.0, 1.02 * solution.string.length)
        (line,) = axes.plot([], [], color=BLUE, linewidth=2.0)
        (end,) = axes.plot([], [], "s", color="black", markersize=6)
        label_axes(axes, "displacement U, m", HEIGHT, legend="")
        title = axes.set_title(" ")
        # The layout is the same on all frames, and takes most of the time of one.
        figure.draw_without_rendering()
        figure.set_layout_engine("none")
        for column in numbers:
            line.set_data(solution.displacement[:, column], solution.positions)
            end.set_data([solution.displacement[-1, column]], [solution.positions[-1]])
            title.set_text(f"t = {solution.times[column]:.4g} s")
            yield figure


def drawn_solution(result: StringResult) -> StringSolution:
    """Return the same motion at more positions and times, including the requested ones.

    A series is summed again. A field solution is drawn as it is, since computing it again is expensive.
    """
    scene, solution = result.scene, result.solution
    few_positions = len(solution.positions) < _ENOUGH_POSITIONS
    few_times = len(solution.times) < _ENOUGH_TIMES
    jumps = scene.motion.kind == "step" and solution.times[-1] > 0.0
    if scene.method != "series" or not (few_positions or few_times or jumps):
        return solution
    positions, times = solution.positions, solution.times
    heights, instants = _OF_FRONTS if jumps else (DEFAULT_POSITIONS, DEFAULT_TIMES)
    if few_positions or jumps:
        positions = np.union1d(positions, scene.string.length * np.linspace(0.0, 1.0, heights) ** 2)
    if few_times or jumps:
        times = np.union1d(times, np.linspace(0.0, times[-1], instants))
    return solve_series(scene, positions, times)


def columns_of(solution: StringSolution, times: Floats) -> list[int]:
    """Return the columns of a solution that are nearest to times, each once and in their order."""
    return sorted({int(np.argmin(np.abs(solution.times - time))) for time in times})


def animation_notes(result: StringResult) -> tuple[str, ...]:
    """Return why there is no animation, or only a coarse one, and the key to set."""
    solution = result.solution
    if solution.times[-1] == 0.0:
        return ('the string is not animated: give [output] key "times" times after 0',)
    if result.scene.method != "series" and len(solution.times) < _ENOUGH_TIMES:
        return (
            f"the animation has {len(solution.times)} pages only, one for each time of the field solution: give "
            f'[output] key "times" {_ENOUGH_TIMES} or more',
        )
    return ()
