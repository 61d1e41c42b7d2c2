"""The figure of a study of thinness: how the differences of thin and exact boundary fall."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from hydroelastic.fem.study.thinness import QUANTITIES, ThinnessRow
from hydroelastic.output.pictures.colours import BLUE, GREEN, ORANGE, PURPLE, VERMILLION
from hydroelastic.output.pictures.curves import GREY, Sheets

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_STYLES = {
    "heave": (BLUE, "o"),
    "modal mass": (PURPLE, "D"),
    "added mass": (VERMILLION, "s"),
    "wave 1": (GREEN, "^"),
    "wave 2": (ORANGE, "v"),
}
# Slopes of theory are drawn over so many times the smallest width.
_REACH = 6.0


def draw_thinness(rows: Sequence[ThinnessRow], sheets: Sheets) -> None:
    """Write the differences over the thinness, and those of waves over half width/tank length, as ``thinness``."""
    waves = [name for name in QUANTITIES if name.startswith("wave")]
    with sheets.sheet("thinness", "thin against exact boundary", width=12.0, height=5.5) as figure:
        left, right = figure.subplots(1, 2, sharey=True)
        for axes, names, label in (
            (left, [name for name in QUANTITIES if name not in waves], "half width l over half height"),
            (right, waves, "half width l over tank length"),
        ):
            for name in names:
                _draw_quantity(axes, rows, name)
            axes.set_xlabel(label)
            axes.legend()
        left.set_ylabel("relative difference |thin/exact − 1|")


def _draw_quantity(axes: Axes, rows: Sequence[ThinnessRow], name: str) -> None:
    """Differences, and the slope of theory through the thinnest one."""
    has_it = [row for row in rows if name in row.compared]
    if not has_it:
        return
    x = [row.breadth if name.startswith("wave") else row.thinness for row in has_it]
    y = [abs(row.compared[name].difference) for row in has_it]
    color, marker = _STYLES[name]
    words, power = QUANTITIES[name]
    axes.loglog(x, y, color=color, marker=marker, label=words.split(",")[0])
    end = (x[-1] * _REACH, y[-1] * _REACH**power)
    axes.loglog((x[-1], end[0]), (y[-1], end[1]), ":", color=GREY, linewidth=1.0)
    axes.annotate(rf"$\propto l^{{{power:g}}}$", end, xytext=(2, 5), textcoords="offset points", color=GREY)
