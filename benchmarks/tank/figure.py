"""The figure: error against seconds, a panel for each tank."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil

from hydroelastic.benchmarks.cases import Code, Variant
from hydroelastic.benchmarks.error_curves import CurveStyle, plot_errors
from hydroelastic.benchmarks.page import NAMES
from hydroelastic.benchmarks.rows import Row
from hydroelastic.benchmarks.tank.cases import tank_named
from hydroelastic.output.plots import BLUE, GREEN, GREY, VERMILLION, Sheets, label_axes

_STYLES: dict[tuple[Code, Variant], tuple[CurveStyle, str]] = {
    ("hydroelastic", "certified"): (
        CurveStyle(colour=VERMILLION, marker="o"),
        "with estimate, count and\npressure-release tone",
    ),
    ("hydroelastic modes", "modes alone"): (
        CurveStyle(colour=VERMILLION, marker="o", dashes=":", hollow=True),
        "mesh to modes",
    ),
    ("ngsolve", "whole"): (CurveStyle(colour=BLUE, marker="s"), "whole tank"),
    ("ngsolve", "halves"): (CurveStyle(colour=BLUE, marker="s", dashes=":", hollow=True), "two halves"),
    ("scikit-fem", "whole"): (CurveStyle(colour=GREEN, marker="^"), "whole tank"),
    ("scikit-fem", "halves"): (CurveStyle(colour=GREEN, marker="^", dashes=":", hollow=True), "two halves"),
    ("lower bound", "bare"): (
        CurveStyle(colour=GREY, marker="x", dashes="--"),
        "factorization\nand solutions alone",
    ),
}
_COLUMNS = 3


def draw_speed(rows: Sequence[Row], sheets: Sheets, name: str) -> None:
    """Draw the figure of that name."""
    tanks = list(dict.fromkeys(row.case.tank for row in rows))
    columns = min(_COLUMNS, len(tanks) + 1)
    lines = ceil((len(tanks) + 1) / columns)  # the last panel holds the legend
    heading = "ten lowest frequencies of tanks with a beam, error against time"
    with sheets.sheet(name, heading, width=4.3 * columns, height=0.4 + 4.0 * lines) as figure:
        panels = figure.subplots(lines, columns, sharex=True, sharey=True, squeeze=False).ravel()
        for panel, tank in zip(panels, tanks, strict=False):
            for (code, variant), (style, what) in _STYLES.items():
                wanted = (tank, code, variant)
                series = [row for row in rows if (row.case.tank, row.case.code, row.case.variant) == wanted]
                plot_errors(panel, series, style, f"{NAMES[code]}, {what}")
            panel.set_title(_described(tank))
            # Shared axes hide the numbers of panels that have others below them; the last row may be short.
            panel.tick_params(labelbottom=True, labelleft=True)
            label_axes(panel, "time from mesh to frequencies, s", "largest relative error of ω", legend="")
        for panel in panels[len(tanks) :]:
            panel.set_axis_off()
        handles, labels = panels[0].get_legend_handles_labels()
        panels[len(tanks)].legend(handles, labels, loc="center left")


def _described(name: str) -> str:
    beam = tank_named(name).beam
    restoring = "with" if beam.hydrostatic else "without"
    return (
        f"{name}: beam from {beam.start:g} to {beam.start + beam.length:g} m\n"
        f"in a tank of {beam.tank_length:g} m, {restoring} restoring"
    )
