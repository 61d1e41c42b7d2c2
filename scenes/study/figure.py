"""The figure of a study: error against seconds and against unknowns, with the slopes that theory expects."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np

from hydroelastic.fem.study.row import Family, StudyRow
from hydroelastic.fem.study.theory import expected_order, expected_remainders
from hydroelastic.output.plots import BLUE, GREEN, GREY, ORANGE, PURPLE, SKY, VERMILLION, Sheets
from hydroelastic.scenes.study.run import Study

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Degrees beyond the usual ones take a ramp of lightness; families differ in dashes, degrees in markers besides.
_DEGREES = {1: SKY, 2: ORANGE, 3: PURPLE, 4: VERMILLION}
_RAMP = {5: "#F5C6A5", 6: "#D9A07A", 7: "#B87B52", 8: "#8F5A36", 9: "#633B20", 10: "#3A200F"}
# How far below a series its theory is drawn.
_APART = 0.4
_MARKERS = {1: "v", 2: "s", 3: "D", 4: "^", 5: "P", 6: "X", 7: "p", 8: "h", 9: "8", 10: "d"}


def draw_study(study: Study, sheets: Sheets) -> None:
    """Write the figure as ``study``."""
    with sheets.sheet("study", "error against cost", width=13.0, height=6.0) as figure:
        left, right = figure.subplots(1, 2, sharey=True)
        for (family, degree), group in groupby(study.rows, key=_series_of):
            rows = list(group)
            style = _style(family, degree, rows)
            left.loglog([row.seconds for row in rows], [row.error for row in rows], **style)
            right.loglog([row.unknowns for row in rows], [row.error for row in rows], **style)
        _draw_floor((left, right), study)
        _draw_gain(right, study)
        _draw_orders(right, study)
        left.set_xlabel("time, s (tolerance asked: of all that a run does)")
        right.set_xlabel("number of unknowns")
        left.set_ylabel(f"largest relative error of {study.scene.accuracy.modes} frequencies")
        figure.legend(*right.get_legend_handles_labels(), loc="outside right center", handlelength=3.5)


def _draw_floor(panels: tuple[Axes, ...], study: Study) -> None:
    if not study.rows:
        return
    floor = max(row.floor for row in study.rows)
    bottom = 0.3 * min(floor, *(row.error for row in study.rows))
    for axes in panels:
        axes.axhspan(bottom, floor, color="#f0f0f0", zorder=0)
        axes.set_ylim(bottom=bottom)
        _remark(axes, "rounding, or the reference's own error", 0.01, 0.01, ha="left", va="bottom")


def _remark(axes: Axes, words: str, x: float, y: float, **alignment: Any) -> None:
    axes.text(x, y, words, transform=axes.transAxes, color=GREY, fontsize=9, **alignment)


def _series_of(row: StudyRow) -> tuple[Family, int]:
    """Family and degree; series that go through the degrees are one."""
    return row.family, row.degree if row.family in ("uniform", "algebraic") else 0


def _style(family: Family, degree: int, rows: list[StudyRow]) -> dict[str, Any]:
    if family == "geometric":
        label = f"geometric, degree {rows[0].degree} to {rows[-1].degree}"
        return {"color": BLUE, "marker": "o", "linewidth": 2.0, "label": label}
    if family == "tolerance":
        label = f"tolerance asked, {_power(rows[0])} to {_power(rows[-1])}"
        return {"color": GREEN, "marker": "*", "markersize": 9, "linewidth": 2.0, "label": label}
    uniform = family == "uniform"
    return {
        **{"color": (_DEGREES | _RAMP)[degree], "marker": _MARKERS[degree], "linewidth": 1.3},
        **({"linestyle": "--", "markerfacecolor": "white"} if uniform else {}),
        "label": f"uniform, degree {degree}" if uniform else f"algebraic, degree {degree}, β = {rows[0].grading:.3g}",
    }


def _power(row: StudyRow) -> str:
    return f"{row.tolerance:.0e}".replace("e-0", "e-")


def _draw_orders(axes: Axes, study: Study) -> None:
    """A slope from one point of the empty upper right corner for every order that theory expects."""
    series = {(row.degree, row.grading) for row in study.rows if row.grading is not None}
    orders = sorted({expected_order(study.tank, degree, grading) for degree, grading in series})
    if not orders:
        return
    (left, right), (low, high) = np.log10(axes.get_xlim()), np.log10(axes.get_ylim())
    start, top = left + 0.68 * (right - left), high - 0.07 * (high - low)
    # In two dimensions unknowns grow like the square of 1/h.
    length = min(0.22 * (right - left), 0.3 * (high - low) / (0.5 * orders[-1]))
    _remark(axes, "orders of theory in the element size h", 0.99, 0.99, ha="right", va="top")
    for order in orders:
        end, bottom = start + length, top - 0.5 * order * length
        axes.plot([10**start, 10**end], [10**top, 10**bottom], color=GREY, linewidth=0.9)
        axes.annotate(f"$h^{{{order:g}}}$", (10**end, 10**bottom), (4, 0), textcoords="offset points", va="center",
                      color=GREY)  # fmt: skip
    axes.set_xlim(10**left, 10**right)
    axes.set_ylim(10**low, 10**high)


def _draw_gain(axes: Axes, study: Study) -> None:
    """What the best polynomials on the rings would gain, below the series of geometric rings."""
    rows = [row for row in study.rows_of("geometric") if row.error > row.floor]
    left = expected_remainders(study.tank, [row.degree for row in rows]) if rows else None
    if left is None:
        return
    errors = _APART * rows[-1].error * left / left[-1]
    style: dict[str, Any] = {"color": BLUE, "linewidth": 1.2, "label": "slope of theory, geometric rings"}
    axes.loglog([row.unknowns for row in rows], errors, ":", **style)
