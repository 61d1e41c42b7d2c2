"""The threads' figure: error against seconds, a panel for each thread, and the tension of the jumper."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil
from typing import TYPE_CHECKING, Any

from hydroelastic.benchmarks.cases import Code, Variant
from hydroelastic.benchmarks.error_curves import CurveStyle, plot_errors
from hydroelastic.benchmarks.page import NAMES
from hydroelastic.benchmarks.rows import Row
from hydroelastic.benchmarks.thread.cases import TENSION_TIMES, Reference, jumper_tension
from hydroelastic.output.plots import BLUE, GREEN, GREY, ORANGE, VERMILLION, Sheets, label_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_STYLES: dict[tuple[Code, Variant], CurveStyle] = {
    ("thread field", "certified"): CurveStyle(colour=VERMILLION, marker="o"),
    ("thread field", "one run"): CurveStyle(colour=VERMILLION, marker="s", dashes=":", hollow=True),
    ("thread catenary", "closed form"): CurveStyle(colour=ORANGE, marker="*", dashes=""),
    ("moorpy", "closed form"): CurveStyle(colour=GREEN, marker="^"),
    ("moorpy", "catenaries"): CurveStyle(colour=GREEN, marker="v", dashes=":", hollow=True),
    ("moordyn", "lumped"): CurveStyle(colour=BLUE, marker="D"),
    ("moordyn", "relaxed"): CurveStyle(colour=BLUE, marker="x", dashes="--"),
    ("moordyn", "relaxed in motion"): CurveStyle(colour=BLUE, marker="+", dashes=":"),
}
_OPINIONS: dict[Reference, tuple[str, str]] = {
    "field": (VERMILLION, "-"),
    "MoorDyn": (BLUE, "--"),
    "OrcaFlex": (GREY, ":"),
}
_COLUMNS = 4


def draw_threads(rows: Sequence[Row], sheets: Sheets, name: str) -> None:
    """Draw the figure of that name."""
    threads = list(dict.fromkeys(row.case.tank for row in rows))
    lines = ceil((len(threads) + 2) / _COLUMNS)  # tensions and the legend
    heading = "flexible threads, error of end forces at rest, of tension or place in motion, against time"
    with sheets.sheet(name, heading, width=3.9 * _COLUMNS, height=0.4 + 3.9 * lines) as figure:
        panels = figure.subplots(lines, _COLUMNS, squeeze=False).ravel()
        handles: dict[str, Any] = {}
        for panel, thread in zip(panels, threads, strict=False):
            for (code, variant), style in _STYLES.items():
                wanted = (thread, code, variant)
                series = [row for row in rows if (row.case.tank, row.case.code, row.case.variant) == wanted]
                if series:
                    named = variant != "closed form" or code == "moorpy"
                    plot_errors(panel, series, style, f"{NAMES[code]}, {variant}" if named else NAMES[code])
            handles |= {line.get_label(): line for line in panel.get_lines()}
            panel.set_title(thread)
            label_axes(panel, "time, s", "relative error", legend="")
        _draw_tension(panels[len(threads)])
        for panel in panels[len(threads) + 1 :]:
            panel.set_axis_off()
        panels[len(threads) + 1].legend(handles.values(), handles.keys(), loc="center left")


def _draw_tension(panel: Axes) -> None:
    for name, (colour, dashes) in _OPINIONS.items():
        label = f"{name}, digitised" if name == "OrcaFlex" else f"{name}, fine run"
        panel.plot(TENSION_TIMES, jumper_tension(name) / 1e3, color=colour, linestyle=dashes, label=label)
    panel.set_title("top tension of the moved jumper")
    label_axes(panel, "time, s", "tension, kN", legend="")
    panel.legend(loc="upper left")
