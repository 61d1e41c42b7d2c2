"""The figure: error against seconds, a panel for each tank."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil
from pathlib import Path

from hydroelastic.benchmarks.cases import Code, Variant
from hydroelastic.benchmarks.report import NAMES
from hydroelastic.benchmarks.rows import Row

_STYLES: dict[tuple[Code, Variant], tuple[str, str, str, str]] = {
    ("hydroelastic", "certified"): ("#c0392b", "o", "-", "with estimate, count and companion"),
    ("ngsolve", "whole"): ("#1f6fb2", "s", "-", "whole tank"),
    ("ngsolve", "halves"): ("#1f6fb2", "s", ":", "two halves"),
    ("scikit-fem", "whole"): ("#2e8b57", "^", "-", "whole tank"),
    ("scikit-fem", "halves"): ("#2e8b57", "^", ":", "two halves"),
    ("lower bound", "bare"): ("#777777", "x", "--", "factorization and solutions alone"),
}
_COLUMNS = 3


def draw_speed(rows: Sequence[Row], path: Path) -> None:
    """Write the figure as PNG."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    tanks = list(dict.fromkeys(row.case.tank for row in rows))
    columns = min(_COLUMNS, len(tanks) + 1)
    lines = ceil((len(tanks) + 1) / columns)  # the last panel holds the legend
    figure = Figure(figsize=(4.3 * columns, 3.9 * lines), layout="constrained")
    FigureCanvasAgg(figure)
    panels = figure.subplots(lines, columns, sharex=True, sharey=True, squeeze=False).ravel()
    for panel, tank in zip(panels, tanks, strict=False):
        for (code, variant), (colour, marker, dashes, what) in _STYLES.items():
            series = [row for row in rows if (row.case.tank, row.case.code, row.case.variant) == (tank, code, variant)]
            panel.loglog(
                [row.median for row in series],
                [row.error for row in series],
                color=colour,
                marker=marker,
                linestyle=dashes,
                markersize=5,
                markerfacecolor="white" if variant == "halves" else colour,
                label=f"{NAMES[code]}, {what}",
            )
        panel.set_title(tank, fontsize=11)
        panel.grid(which="major", color="#dddddd", linewidth=0.6)
        # Shared axes hide the numbers of panels that have others below them; the last row may be short.
        panel.tick_params(labelbottom=True, labelleft=True)
        panel.set_xlabel("seconds, mesh to eigenvalues, one thread")
        panel.set_ylabel("largest relative error of ten ω")
    for panel in panels[len(tanks) :]:
        panel.set_axis_off()
    handles, labels = panels[0].get_legend_handles_labels()
    panels[len(tanks)].legend(handles, labels, frameon=False, loc="center left", fontsize=10)
    figure.savefig(path, dpi=130)
