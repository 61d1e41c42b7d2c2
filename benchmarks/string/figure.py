"""The string's figure: error against seconds, a panel for each motion."""

from __future__ import annotations

from collections.abc import Sequence

from hydroelastic.benchmarks.cases import STRING_CODES, Code
from hydroelastic.benchmarks.error_curves import CurveStyle, plot_errors
from hydroelastic.benchmarks.page import NAMES
from hydroelastic.benchmarks.rows import Row
from hydroelastic.output.plots import BLUE, GREY, VERMILLION, Sheets, label_axes

_STYLES: dict[Code, CurveStyle] = {
    "string field": CurveStyle(colour=VERMILLION, marker="o"),
    "string series": CurveStyle(colour=BLUE, marker="s"),
    "string sum": CurveStyle(colour=GREY, marker="^", dashes=":"),
}


def draw_strings(rows: Sequence[Row], sheets: Sheets, name: str) -> None:
    """Draw the figure of that name."""
    motions = list(dict.fromkeys(row.case.tank for row in rows))
    heading = "hanging string with its upper end moved, error against time"
    with sheets.sheet(name, heading, width=max(3.6 * len(motions), 7.0), height=5.0) as figure:
        panels = figure.subplots(1, len(motions), sharex=True, sharey=True, squeeze=False).ravel()
        for panel, motion in zip(panels, motions, strict=True):
            for code in STRING_CODES:
                series = [row for row in rows if row.case.code == code and row.case.tank == motion]
                plot_errors(panel, series, _STYLES[code], NAMES[code])
            panel.set_title(f"motion: {motion}")
            label_axes(panel, "time to all displacements, s", "", legend="")
        panels[0].set_ylabel("largest error over the largest displacement")
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
