"""The buoys' figure: error against seconds, a panel for each."""

from __future__ import annotations

from collections.abc import Sequence

from hydroelastic.benchmarks.cases import Code, Variant
from hydroelastic.benchmarks.error_curves import CurveStyle, plot_errors
from hydroelastic.benchmarks.page import NAMES
from hydroelastic.benchmarks.rows import Row
from hydroelastic.output.plots import BLUE, SKY, VERMILLION, Sheets, label_axes

_STYLES: dict[tuple[Code, Variant], tuple[CurveStyle, str]] = {
    ("hydroelastic buoy", "certified"): (CurveStyle(colour=VERMILLION, marker="o"), ", with estimate and excitation"),
    ("capytaine buoy", "without lid"): (CurveStyle(colour=SKY, marker="s"), ", symmetric panels"),
    ("capytaine buoy", "with lid"): (CurveStyle(colour=SKY, marker="s", dashes=":", hollow=True), ", with a lid"),
    ("open-flash", "matched"): (CurveStyle(colour=BLUE, marker="^"), ", matched expansions"),
}


def draw_buoys(rows: Sequence[Row], sheets: Sheets, name: str) -> None:
    """Draw the figure of that name."""
    buoys = list(dict.fromkeys(row.case.tank for row in rows))
    heading = "heaving solids of revolution of radius a, K = ω²/g, error against time"
    with sheets.sheet(name, heading, width=max(4.3 * len(buoys), 8.0)) as figure:
        panels = figure.subplots(1, len(buoys), sharex=True, sharey=True, squeeze=False).ravel()
        for panel, buoy in zip(panels, buoys, strict=True):
            for (code, variant), (style, words) in _STYLES.items():
                series = [
                    row for row in rows if (row.case.code, row.case.variant, row.case.tank) == (code, variant, buoy)
                ]
                if series:
                    plot_errors(panel, series, style, NAMES[code] + words)
            panel.set_title(buoy)
            label_axes(panel, "time from scene or panels to numbers, s", "", legend="")
        panels[0].set_ylabel("relative error of heave")
        handles = {
            label: line for panel in panels for line, label in zip(*panel.get_legend_handles_labels(), strict=True)
        }
        figure.legend(list(handles.values()), list(handles), loc="outside lower center", ncols=2)
