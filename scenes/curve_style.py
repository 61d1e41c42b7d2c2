"""How curves are drawn."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Okabe and Ito's colours, which colour-blind readers tell apart; curves differ in dashes besides.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
DASHES = ("-", "--", "-.", ":")
GRID = {"which": "major", "color": "#dddddd", "linewidth": 0.6}


@contextmanager
def figure_file(title: str, path: Path, *, width: float, height: float = 5.4) -> Iterator[Figure]:
    """Give a figure to draw into; it is written to a PNG file when the block ends well."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    yield figure
    # A dollar sign would begin a formula.
    figure.suptitle(title.replace("$", r"\$"))
    figure.savefig(path, dpi=130)


def dress(axes: Axes, across: str, up: str, *, legend: bool = True) -> None:
    """Name the axes, with units, and put a legend below."""
    axes.set_xlabel(across)
    axes.set_ylabel(up)
    axes.grid(**GRID)  # type: ignore[arg-type]
    axes.spines[["top", "right"]].set_visible(False)
    if legend:
        axes.legend(frameon=False, handlelength=3.0, loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=2)


def plot_curve(axes: Axes, x: np.ndarray, y: np.ndarray, number: int, label: str) -> None:
    """A curve, with markers where there are few points."""
    axes.plot(
        x,
        y,
        DASHES[number // len(COLOURS) % len(DASHES)],
        color=COLOURS[number % len(COLOURS)],
        marker="o" if len(x) <= 20 else None,
        markersize=4,
        linewidth=1.6,
        label=label,
    )
