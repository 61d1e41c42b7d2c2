"""The string's figure: error against seconds, a panel for each motion."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from hydroelastic.benchmarks.cases import STRING_CODES, Code
from hydroelastic.benchmarks.report import NAMES
from hydroelastic.benchmarks.rows import Row

_STYLES: dict[Code, tuple[str, str, str]] = {
    "string field": ("#c0392b", "o", "-"),
    "string series": ("#1f6fb2", "s", "-"),
    "string sum": ("#7f8c8d", "^", ":"),
}


def draw_strings(rows: Sequence[Row], path: Path) -> None:
    """Write the figure as PNG."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    motions = list(dict.fromkeys(row.case.tank for row in rows))
    figure = Figure(figsize=(3.6 * len(motions), 4.6), layout="constrained")
    FigureCanvasAgg(figure)
    panels = figure.subplots(1, len(motions), sharex=True, sharey=True, squeeze=False).ravel()
    for panel, motion in zip(panels, motions, strict=True):
        for code in STRING_CODES:
            series = [row for row in rows if row.case.code == code and row.case.tank == motion]
            colour, marker, dashes = _STYLES[code]
            panel.loglog(
                [row.median for row in series],
                [row.error for row in series],
                color=colour,
                marker=marker,
                linestyle=dashes,
                markersize=5,
                label=NAMES[code],
            )
        panel.set_title(motion, fontsize=11)
        panel.grid(which="major", color="#dddddd", linewidth=0.6)
        panel.set_xlabel("seconds, one thread")
    panels[0].set_ylabel("largest error over the largest displacement")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, frameon=False, loc="outside lower center", ncols=3, fontsize=9)
    figure.savefig(path, dpi=100)
