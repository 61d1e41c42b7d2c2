"""Curves of a solution of open water as PNG files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hydroelastic.scenes.curve_style import COLOURS, dress, figure_file, plot_curve
from hydroelastic.scenes.open_results import DecayTable, OpenSolution, RadiationTable, ResonanceTable, ResponseTable
from hydroelastic.scenes.open_tables import motion_name

if TYPE_CHECKING:
    pass

_OTHER = "#555555"
_MOST_DEFLECTIONS = 6


def draw_open(solution: OpenSolution, folder: Path) -> None:
    """Draw what the solution holds: one figure for each analysis, and one for each beam in waves.

    Args:
        solution: the solution.
        folder: an existing folder, for ``radiation_1.png``, ``response_1.png``, ``deflection_1_body_1.png``,
            ``resonance_1.png``, ``decay_1.png`` and so on.
    """
    title = solution.scene.title
    for number, radiation in enumerate(solution.radiation, 1):
        _draw_radiation(radiation, title, folder / f"radiation_{number}.png")
    for number, response in enumerate(solution.response, 1):
        _draw_response(response, title, folder / f"response_{number}.png")
        for place, plate in enumerate(response.plates):
            name = f"deflection_{number}_body_{plate.body + 1}.png"
            _draw_deflection(response, place, title, folder / name)
    for number, resonance in enumerate(solution.resonance, 1):
        _draw_resonances(resonance, title, folder / f"resonance_{number}.png")
    for number, decay in enumerate(solution.decay, 1):
        _draw_decay(decay, title, folder / f"decay_{number}.png")


def _draw_radiation(table: RadiationTable, title: str, path: Path) -> None:
    """Diagonals of a and b over finite ω, each over its largest value: motions have different units."""
    order = np.argsort(table.omega)
    order = order[np.isfinite(table.omega[order])]
    if not len(order):
        return
    omega = table.omega[order]
    with figure_file(title, path, width=11.0) as figure:
        left, right = figure.subplots(1, 2)
        for number, motion in enumerate(table.dofs):
            mass, damping = (matrix[order, number, number] for matrix in (table.added_mass, table.radiation_damping))
            unit = "kg·m" if motion.endswith("roll") else "kg/m"
            for axes, values, of in ((left, mass, unit), (right, damping, f"{unit}/s")):
                largest = _largest(values)
                plot_curve(axes, omega, values / largest, number, f"{motion_name(motion)} ({largest:.4g} {of})")
            if table.infinite_frequency_added_mass is not None:
                far = table.infinite_frequency_added_mass[number, number] / _largest(mass)
                left.axhline(far, color=COLOURS[number % len(COLOURS)], linewidth=0.7, linestyle=":")
        dress(left, "ω, rad/s", "added mass over its largest value (dotted: ω → ∞)")
        dress(right, "ω, rad/s", "radiation damping over its largest value")


def _largest(values: np.ndarray) -> float:
    """Largest finite value, which may be negative; the added mass of very long waves may be infinite."""
    return float(np.abs(values[np.isfinite(values)]).max(initial=0.0)) or 1.0


def _draw_response(table: ResponseTable, title: str, path: Path) -> None:
    order = np.argsort(table.omega)
    omega = table.omega[order]
    with figure_file(title, path, width=11.0) as figure:
        left, right = figure.subplots(1, 2)
        number = 0
        for incident, wave in enumerate(table.waves):
            for outgoing, other in enumerate(table.waves):
                which = f", {wave} to {other}" if len(table.waves) > 1 else ""
                plot_curve(left, omega, np.abs(table.reflection[order, incident, outgoing]), number, f"|R|{which}")
                plot_curve(
                    left, omega, np.abs(table.transmission[order, incident, outgoing]), number + 1, f"|T|{which}"
                )
                number += 2
        number = 0
        for motion, dof in enumerate(table.dofs[: len(COLOURS)]):
            for incident, wave in enumerate(table.waves):
                which = f", {wave} wave" if len(table.waves) > 1 else ""
                plot_curve(
                    right, omega, np.abs(table.amplitudes[order, incident, motion]), number, motion_name(dof) + which
                )
                number += 1
        dress(left, "ω, rad/s", "ratio of elevations")
        dress(right, "ω, rad/s", f"|motion| per unit elevation, waves from the {table.waves_from}")


def _draw_deflection(table: ResponseTable, place: int, title: str, path: Path) -> None:
    """|w| along a beam at a few frequencies, one panel for each wave that comes."""
    plate = table.plates[place]
    order = np.argsort(table.omega)
    shown = order[np.unique(np.linspace(0, len(order) - 1, min(len(order), _MOST_DEFLECTIONS)).round().astype(int))]
    with figure_file(title, path, width=7.5 * len(table.waves)) as figure:
        panels = figure.subplots(1, len(table.waves), squeeze=False)[0]
        for incident, (axes, wave) in enumerate(zip(panels, table.waves, strict=True)):
            for number, row in enumerate(shown):
                axes.plot(
                    plate.positions,
                    np.abs(plate.deflection[row, incident]),
                    color=COLOURS[number % len(COLOURS)],
                    linewidth=1.6,
                    label=f"ω = {table.omega[row]:.4g} rad/s",
                )
            which = f", {wave} wave" if len(table.waves) > 1 else ""
            dress(axes, "x, m", f"|deflection| of body {plate.body + 1} per unit elevation{which}")
            axes.set_ylim(bottom=0.0)


def _draw_resonances(table: ResonanceTable, title: str, path: Path) -> None:
    if not len(table.omega):
        return
    with figure_file(title, path, width=7.5) as figure:
        axes = figure.subplots()
        axes.plot(table.omega.real, table.omega.imag, "o", color=COLOURS[0], markersize=6)
        for omega, label in zip(table.omega, table.labels, strict=True):
            axes.annotate(
                motion_name(label), (omega.real, omega.imag), xytext=(6, 4), textcoords="offset points", fontsize=9
            )
        # The real axis is where nothing dies out.
        axes.axhline(0.0, color=_OTHER, linewidth=0.9)
        axes.margins(0.15)
        dress(axes, "Re ω, rad/s", "Im ω, 1/s", legend=False)


def _draw_decay(table: DecayTable, title: str, path: Path) -> None:
    """The motions over time; in the inset the one let go on logarithmic axes, where an algebraic tail is straight."""
    released = int(np.argmax(np.abs(table.initial)))
    order = np.argsort(table.times)
    times = table.times[order]
    with figure_file(title, path, width=9.0) as figure:
        axes = figure.subplots()
        for number, motion in enumerate(table.dofs):
            unit = "rad" if motion.endswith("roll") else "m"
            plot_curve(axes, times, table.displacement[order, number], number, f"{motion_name(motion)}, {unit}")
        dress(axes, "t, s", "displacement after release", legend=False)
        axes.legend(frameon=False, handlelength=3.0, loc="lower right")
        later = times > 0.0
        motion = np.abs(table.displacement[order, released])[later]
        if np.count_nonzero(motion) < 2:
            return
        inset = axes.inset_axes((0.55, 0.55, 0.43, 0.42))
        inset.loglog(times[later], motion, color=COLOURS[released % len(COLOURS)], linewidth=1.2)
        inset.loglog(times[later], table.absolute_error[order][later], ":", color=_OTHER, linewidth=1.0)
        if table.tail is not None:
            inset.loglog(times[later], abs(table.tail) / times[later] ** 2, "--", color=_OTHER, linewidth=1.0)
            low = max(0.1 * float(motion[motion > 0.0].min()), 1e-16)
            inset.set_ylim(low, 10.0 * float(motion.max()))
        inset.set_title("dashed: tail/t²; dotted: error", fontsize=8, color=_OTHER)
        inset.tick_params(labelsize=7)
