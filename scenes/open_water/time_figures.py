"""Curves over time of a solution of open water: impulse responses, and motions in waves."""

from __future__ import annotations

from typing import Any

import numpy as np

from hydroelastic.fem.time_domain.results import ImpulseResponseTable, MotionTable
from hydroelastic.output.plots import GREY, Sheets, label_axes, plot_curve
from hydroelastic.physics.dofs import Dof

_MOST_CURVES = 6


def draw_over_time(solution: Any, sheets: Sheets) -> None:
    """Draw a figure for each impulse response and motion analysis: ``impulse_response_1``, ``motion_1`` and so on."""
    for number, response in enumerate(solution.impulse_response, 1):
        _draw_impulse_response(response, sheets, f"impulse_response_{number}")
    for number, motion in enumerate(solution.motion, 1):
        _draw_motion(motion, sheets, f"motion_{number}")


def by_unit(dofs: tuple[Dof, ...]) -> list[tuple[bool, list[int]]]:
    """Places of the motions that are rotations, rad, and of the others, m; those first that come first."""
    turns = [motion.is_rotation for motion in dofs]
    return [(kind, [place for place, turn in enumerate(turns) if turn == kind]) for kind in dict.fromkeys(turns)]


def _draw_impulse_response(table: ImpulseResponseTable, sheets: Sheets, name: str) -> None:
    """The diagonal of K, and the error of what it gives back over the frequency."""
    order = np.argsort(table.times)
    groups = by_unit(table.dofs)
    with sheets.sheet(name, "impulse responses of radiation", width=6.0 * (1 + len(groups))) as figure:
        *panels, last = figure.subplots(1, 1 + len(groups))
        for axes, (turns, places) in zip(panels, groups, strict=True):
            for motion in places[:_MOST_CURVES]:
                values = table.impulse_response[order, motion, motion]
                plot_curve(axes, table.times[order], values, motion, table.dofs[motion].words)
            label_axes(axes, "time t, s", "impulse response K, N" if turns else "impulse response K, N/m²")
        for number, (errors, label) in enumerate(
            ((table.causality_error, "a and b by K"), (table.ogilvie_error, "a∞ by Ogilvie's relation"))
        ):
            plot_curve(last, table.omega, errors, number, label)
        last.axhline(table.relative_error, color=GREY, linewidth=0.9, linestyle=":", label="estimated error")
        last.set_xscale("log")
        last.set_yscale("log")
        label_axes(last, "angular frequency ω, rad/s", "difference over the largest a + ib/ω")


def _draw_motion(table: MotionTable, sheets: Sheets, name: str) -> None:
    """The waves, and below them the motions over time, with those without a beginning."""
    groups = by_unit(table.dofs)
    heading = f"motion {table.beginning}"
    with sheets.sheet(name, heading, width=10.0, height=1.2 + 2.8 * (1 + len(groups))) as figure:
        first, *panels = figure.subplots(1 + len(groups), 1, sharex=True)
        first.plot(table.times, table.elevation, color=GREY)
        first.set_ylabel("elevation η, m")
        for axes, (turns, places) in zip(panels, groups, strict=True):
            for motion in places[:_MOST_CURVES]:
                axes.plot(table.times, table.steady[:, motion], color=GREY, linewidth=0.8, linestyle=":")
                plot_curve(axes, table.times, table.displacement[:, motion], motion, table.dofs[motion].words)
            axes.plot([], [], ":", color=GREY, linewidth=0.8, label="without a beginning, by the frequency domain")
            label_axes(axes, "time t, s", "rotation, rad" if turns else "displacement, m", legend="beside")
