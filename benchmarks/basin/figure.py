"""The basin's figure: error against seconds."""

from __future__ import annotations

from collections.abc import Sequence

from hydroelastic.benchmarks.cases import Code, Variant
from hydroelastic.benchmarks.error_curves import CurveStyle, plot_errors
from hydroelastic.benchmarks.page import NAMES
from hydroelastic.benchmarks.rows import Row
from hydroelastic.output.plots import BLUE, SKY, VERMILLION, Sheets, label_axes

_STYLES: dict[tuple[Code, Variant], CurveStyle] = {
    ("basin field", "certified"): CurveStyle(colour=VERMILLION, marker="o"),
    ("basin field", "triangles"): CurveStyle(colour=VERMILLION, marker="^", dashes="--"),
    ("ngsolve plan", "quarters"): CurveStyle(colour=BLUE, marker="s"),
    ("ngsolve volume", "quarters"): CurveStyle(colour=SKY, marker="D", dashes=":"),
}


def draw_basins(rows: Sequence[Row], sheets: Sheets, name: str) -> None:
    """Draw the figure of that name."""
    with sheets.sheet(name, "plate in a basin, error against time", width=8.0) as figure:
        panel = figure.subplots()
        for (code, variant), style in _STYLES.items():
            series = [row for row in rows if (row.case.code, row.case.variant) == (code, variant)]
            label = f"{NAMES[code]}, on triangles" if variant == "triangles" else NAMES[code]
            plot_errors(panel, series, style, label)
        label_axes(
            panel, "time from scene or mesh to frequencies, s", "largest error of 12 frequencies", legend="beside"
        )
