"""The motion of a hanging string as PNG files: over height and time, its shapes, its modes, frames of an animation."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hydroelastic.scenes.curve_style import COLOURS, GRID, dress, figure_file
from hydroelastic.scenes.line_sequence import frame_numbers
from hydroelastic.scenes.string_fronts import travel_times
from hydroelastic.scenes.string_results import StringSolution

_SHOWN_SHAPES = 9
_SHOWN_MODES = 5
# Above this quantile of |U| a few peaks at focuses would leave the rest without colour.
_QUANTILE = 0.995


def draw_string(solution: StringSolution, folder: Path) -> None:
    """Draw ``space_time.png``, ``shapes.png``, ``modes.png``, and frames in ``frames/``, into an existing folder."""
    if len(solution.positions) > 1 and len(solution.times) > 1:
        _draw_space_time(solution, folder / "space_time.png")
        _draw_modes(solution, folder / "modes.png")
    _draw_shapes(solution, folder / "shapes.png")
    if solution.scene.output.frames:
        (folder / "frames").mkdir()
        _draw_frames(solution, folder / "frames")


def _draw_space_time(solution: StringSolution, path: Path) -> None:
    """U over time and height; blue to red, white at rest; the first front dashed."""
    limit = float(np.quantile(np.abs(solution.displacement), _QUANTILE)) or solution.largest or 1.0
    with figure_file(solution.scene.title, path, width=10.0, height=6.0) as figure:
        axes = figure.subplots()
        picture = axes.pcolormesh(
            solution.times,
            solution.positions,
            solution.displacement,
            cmap="RdBu_r",
            vmin=-limit,
            vmax=limit,
            shading="gouraud",
            rasterized=True,
        )
        figure.colorbar(
            picture, ax=axes, label="displacement U, m", extend="both" if limit < solution.largest else "neither"
        )
        string = solution.scene.string
        arrival = string.travel_time - travel_times(string, solution.positions)
        axes.plot(arrival, solution.positions, "--", color="black", linewidth=1.0, label="first front")
        axes.set_xlim(solution.times[0], solution.times[-1])
        axes.set_xlabel("t, s")
        axes.set_ylabel("height above the free end, m")
        axes.legend(loc="upper right", frameon=True)


def _draw_shapes(solution: StringSolution, path: Path) -> None:
    """The string at a few times, from light to dark."""
    places = sorted({int(place) for place in np.linspace(0, len(solution.times) - 1, _SHOWN_SHAPES).round()})
    with figure_file(solution.scene.title, path, width=6.5, height=7.5) as figure:
        from matplotlib import colormaps

        axes = figure.subplots()
        for place, column in enumerate(places):
            colour = colormaps["viridis_r"](0.1 + 0.9 * place / max(len(places) - 1, 1))
            label = f"{solution.times[column]:.4g} s"
            axes.plot(solution.displacement[:, column], solution.positions, color=colour, linewidth=1.6, label=label)
        dress(axes, "displacement U, m", "height above the free end, m")
        axes.legend(frameon=False, loc="center left", bbox_to_anchor=(1.0, 0.5))


def _draw_modes(solution: StringSolution, path: Path) -> None:
    motions = solution.motions
    with figure_file(solution.scene.title, path, width=6.5, height=7.5) as figure:
        axes = figure.subplots()
        axes.axvline(0.0, color=GRID["color"], linewidth=1.0)
        for number, shape in enumerate(motions.shapes[:_SHOWN_MODES]):
            label = f"{number + 1}: ω = {motions.frequencies[number]:.5g} rad/s"
            if not motions.roots[number].imag:
                label += ", aperiodic"
            axes.plot(shape, solution.positions, color=COLOURS[number % len(COLOURS)], linewidth=1.6, label=label)
        dress(axes, "shape, largest 1", "height above the free end, m", legend=False)
        axes.legend(frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=2)


def _draw_frames(solution: StringSolution, folder: Path) -> None:
    """The string at evenly spread times, in one frame of axes, numbered as players of sequences expect."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5.0, 6.0), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    reach = 1.05 * max(solution.largest, 1e-300)
    axes.set_xlim(-reach, reach)
    axes.set_ylim(0.0, 1.02 * solution.scene.string.length)
    (line,) = axes.plot([], [], color=COLOURS[0], linewidth=2.0)
    (end,) = axes.plot([], [], "s", color="black", markersize=6)
    dress(axes, "displacement U, m", "height above the free end, m", legend=False)
    title = axes.set_title(" ")
    for place, column in enumerate(frame_numbers(solution.scene.output.frames, len(solution.times))):
        line.set_data(solution.displacement[:, column], solution.positions)
        end.set_data([solution.displacement[-1, column]], [solution.positions[-1]])
        title.set_text(f"t = {solution.times[column]:.4g} s")
        figure.savefig(folder / f"frame_{place:04d}.png", dpi=100)
