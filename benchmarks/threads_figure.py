"""The threads' figure: error against seconds, a panel for each thread, and the tension of the jumper."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil
from pathlib import Path
from typing import Any

from hydroelastic.benchmarks.cases import Code, Variant
from hydroelastic.benchmarks.report import NAMES
from hydroelastic.benchmarks.rows import Row
from hydroelastic.benchmarks.threads import TENSION_TIMES, Reference, jumper_tension

_STYLES: dict[tuple[Code, Variant], tuple[str, str, str]] = {
    ("thread field", "certified"): ("#c0392b", "o", "-"),
    ("thread field", "one run"): ("#c0392b", "s", ":"),
    ("thread catenary", "closed form"): ("#e59866", "*", ""),
    ("moorpy", "closed form"): ("#2e8b57", "^", "-"),
    ("moorpy", "catenaries"): ("#2e8b57", "v", ":"),
    ("moordyn", "lumped"): ("#1f6fb2", "D", "-"),
    ("moordyn", "relaxed"): ("#1f6fb2", "x", "--"),
    ("moordyn", "relaxed in motion"): ("#1f6fb2", "+", ":"),
}
_OPINIONS: dict[Reference, tuple[str, str]] = {
    "field": ("#c0392b", "-"),
    "MoorDyn": ("#1f6fb2", "--"),
    "OrcaFlex": ("#555555", ":"),
}
_COLUMNS = 4
# Exact to the last digit is drawn there.
_LEAST = 1e-16


def draw_threads(rows: Sequence[Row], path: Path) -> None:
    """Write the figure as PNG."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    names = list(dict.fromkeys(row.case.tank for row in rows))
    count = len(names) + 2  # tensions and the legend
    lines = ceil(count / _COLUMNS)
    figure = Figure(figsize=(3.9 * _COLUMNS, 3.9 * lines), layout="constrained")
    FigureCanvasAgg(figure)
    panels = figure.subplots(lines, _COLUMNS, squeeze=False).ravel()
    handles: dict[str, Any] = {}
    for panel, name in zip(panels, names, strict=False):
        for (code, variant), (colour, marker, dashes) in _STYLES.items():
            series = [row for row in rows if (row.case.tank, row.case.code, row.case.variant) == (name, code, variant)]
            if not series:
                continue
            label = f"{NAMES[code]}, {variant}" if variant != "closed form" or code == "moorpy" else NAMES[code]
            (handles[label],) = panel.loglog(
                [row.median for row in series],
                [max(row.error, _LEAST) for row in series],
                color=colour,
                marker=marker,
                linestyle=dashes,
                markersize=5,
            )
        panel.set_title(name, fontsize=11)
        panel.grid(which="major", color="#dddddd", linewidth=0.6)
        panel.set_xlabel("seconds, one thread")
        panel.set_ylabel("relative error")
    _draw_tension(panels[len(names)])
    for panel in panels[len(names) + 1 :]:
        panel.set_axis_off()
    panels[len(names) + 1].legend(handles.values(), handles.keys(), frameon=False, loc="center left", fontsize=10)
    figure.savefig(path, dpi=100)


def _draw_tension(panel: Any) -> None:
    for name, (colour, dashes) in _OPINIONS.items():
        label = f"{name}, digitised" if name == "OrcaFlex" else f"{name}, fine run"
        panel.plot(TENSION_TIMES, jumper_tension(name) / 1e3, color=colour, linestyle=dashes, label=label)
    panel.set_title("top tension of the moved jumper", fontsize=11)
    panel.grid(color="#dddddd", linewidth=0.6)
    panel.set_xlabel("time, s")
    panel.set_ylabel("kN")
    panel.legend(frameon=False, fontsize=9)
