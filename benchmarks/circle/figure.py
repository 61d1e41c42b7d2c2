"""The circle's figure: error against seconds, a panel for each frequency."""

from __future__ import annotations

from collections.abc import Sequence

from hydroelastic.benchmarks.cases import Code, Variant
from hydroelastic.benchmarks.circle.cases import LENGTHS
from hydroelastic.benchmarks.error_curves import CurveStyle, plot_errors
from hydroelastic.benchmarks.page import NAMES
from hydroelastic.benchmarks.rows import Row
from hydroelastic.output.plots import BLUE, SKY, VERMILLION, Sheets, label_axes

# The longer the cylinder, the darker.
_COLOURS = dict(zip(LENGTHS, (SKY, BLUE, "#0b2f52"), strict=True))


def draw_circle(rows: Sequence[Row], sheets: Sheets, name: str) -> None:
    """Draw the figure of that name."""
    frequencies = list(dict.fromkeys(row.case.tank for row in rows))
    heading = "half-immersed circle of radius a in deep water, K = ω²/g, error against time"
    with sheets.sheet(name, heading, width=max(4.3 * len(frequencies), 8.0)) as figure:
        panels = figure.subplots(1, len(frequencies), sharex=True, sharey=True, squeeze=False).ravel()
        for panel, frequency in zip(panels, frequencies, strict=True):
            for code, variant, length in dict.fromkeys((r.case.code, r.case.variant, r.case.length) for r in rows):
                series = [row for row in rows if _key(row) == (code, variant, length) and row.case.tank == frequency]
                plot_errors(panel, series, *_style(code, variant, length))
            panel.set_title(frequency)
            label_axes(panel, "time from scene or panels to numbers, s", "", legend="")
        panels[0].set_ylabel("relative error of heave or sway, the larger one")
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)


def _key(row: Row) -> tuple[Code, Variant, float]:
    return row.case.code, row.case.variant, row.case.length


def _style(code: Code, variant: Variant, length: float) -> tuple[CurveStyle, str]:
    if variant == "one length":
        style = CurveStyle(colour=_COLOURS[length], marker="s", dashes=":", hollow=True)
        return style, f"{NAMES[code]}, cylinder of {length:g} radii"
    if variant == "two lengths":
        style = CurveStyle(colour=_COLOURS[length], marker="s")
        return style, f"{NAMES[code]}, {length:g} less {length / 2:g} radii"
    return CurveStyle(colour=VERMILLION, marker="o"), f"{NAMES[code]}, with estimate and excitation"
