"""How the figures of the benchmark draw what was measured: error against seconds, on logarithmic axes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from hydroelastic.benchmarks.rows import Row

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Exact to the last digit is drawn there.
_LEAST = 1e-16


@dataclass(frozen=True, kw_only=True)
class CurveStyle:
    """How the answers of one code are drawn.

    Attributes:
        colour: of the code.
        marker: of its answers.
        dashes: between them.
        hollow: whether the markers are.
    """

    colour: str
    marker: str
    dashes: str = "-"
    hollow: bool = False


def plot_errors(panel: Axes, rows: Sequence[Row], style: CurveStyle, label: str) -> None:
    """Draw error against seconds of one code; without rows only the entry of the legend."""
    panel.loglog(
        [row.median for row in rows],
        [max(row.error, _LEAST) for row in rows],
        color=style.colour,
        marker=style.marker,
        linestyle=style.dashes,
        markerfacecolor="white" if style.hollow else style.colour,
        label=label,
    )
