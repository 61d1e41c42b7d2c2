"""The moving string in fixed axes: numbered pictures, and an animation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hydroelastic.modal.string.solution import StringSolution
from hydroelastic.output.plots import BLUE, FRAMES, SECONDS, PictureOptions, label_axes, style, write_gif
from hydroelastic.scenes.string.drawn import columns_of

if TYPE_CHECKING:
    from matplotlib.backends.backend_agg import FigureCanvasAgg

HEIGHT = "height above the free end, m"
"""What the axis of all pictures of the string says."""

_MOTION_FRAMES = 60
_ANIMATION_DPI = 80


def draw_frames(solution: StringSolution, numbers: Sequence[int], folder: Path, options: PictureOptions) -> None:
    """Draw the string at some of its times, numbered as players of sequences expect."""
    for place, canvas in enumerate(_frames(solution, numbers, options.scale)):
        canvas.figure.savefig(folder / f"frame_{place:04d}.png", dpi=options.dpi)


def animate_string(solution: StringSolution, path: Path, options: PictureOptions) -> None:
    """Draw the motion at evenly spread times as a GIF that begins again at its end."""
    numbers = columns_of(solution, np.linspace(solution.times[0], solution.times[-1], _MOTION_FRAMES))
    if len(numbers) < 2:
        return
    pages = []
    for canvas in _frames(solution, numbers, options.scale, _ANIMATION_DPI):
        canvas.draw()
        pages.append(np.array(canvas.buffer_rgba())[:, :, :3])
    write_gif(pages, path, seconds=SECONDS / FRAMES * len(pages))


def _frames(
    solution: StringSolution, numbers: Sequence[int], scale: float, dpi: float = 100.0
) -> Iterator[FigureCanvasAgg]:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    with style():
        figure = Figure(figsize=(5.0 * scale, 6.0 * scale), dpi=dpi, layout="constrained")
        canvas = FigureCanvasAgg(figure)
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
            yield canvas
