"""The circle's figure: error against seconds, a panel for each frequency."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from hydroelastic.benchmarks.cases import Code, Variant
from hydroelastic.benchmarks.circle import LENGTHS
from hydroelastic.benchmarks.report import NAMES
from hydroelastic.benchmarks.rows import Row

_COLOURS = {LENGTHS[0]: "#8fb8de", LENGTHS[1]: "#1f6fb2", LENGTHS[2]: "#0b2f52"}


def draw_circle(rows: Sequence[Row], path: Path) -> None:
    """Write the figure as PNG."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    names = list(dict.fromkeys(row.case.tank for row in rows))
    figure = Figure(figsize=(4.3 * len(names), 4.8), layout="constrained")
    FigureCanvasAgg(figure)
    panels = figure.subplots(1, len(names), sharex=True, sharey=True, squeeze=False).ravel()
    for panel, name in zip(panels, names, strict=True):
        for code, variant, length in dict.fromkeys((r.case.code, r.case.variant, r.case.length) for r in rows):
            series = [row for row in rows if _key(row) == (code, variant, length) and row.case.tank == name]
            colour, marker, dashes, label = _style(code, variant, length)
            panel.loglog(
                [row.median for row in series],
                [row.error for row in series],
                color=colour,
                marker=marker,
                linestyle=dashes,
                markersize=5,
                label=label,
            )
        panel.set_title(name, fontsize=11)
        panel.grid(which="major", color="#dddddd", linewidth=0.6)
        panel.set_xlabel("seconds, scene or panels to numbers, one thread")
    panels[0].set_ylabel("relative error of heave or sway, the larger one")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, frameon=False, loc="outside lower center", ncols=3, fontsize=9)
    figure.savefig(path, dpi=100)


def _key(row: Row) -> tuple[Code, Variant, float]:
    return row.case.code, row.case.variant, row.case.length


def _style(code: Code, variant: Variant, length: float) -> tuple[str, str, str, str]:
    """Colour, marker, dashes and label."""
    if variant == "one length":
        return _COLOURS[length], "s", ":", f"{NAMES[code]}, cylinder of {length:g} radii"
    if variant == "two lengths":
        return _COLOURS[length], "s", "-", f"{NAMES[code]}, {length:g} less {length / 2:g} radii"
    return "#c0392b", "o", "-", f"{NAMES[code]}, with estimate and excitation"
