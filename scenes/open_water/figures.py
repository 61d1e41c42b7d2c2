"""Curves of a solution of open water as pictures."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from hydroelastic.fem.open_water.irregular_results import SpectrumTable
from hydroelastic.fem.open_water.results import DecayTable, RadiationTable, ResonanceTable, ResponseTable
from hydroelastic.fem.time_domain.results import ImpulseResponseTable, MotionTable
from hydroelastic.output.open_water.quantities import directional_scattering, scattering_width
from hydroelastic.output.plots import (
    BLUE,
    COLOURS,
    GREY,
    PictureOptions,
    Sheets,
    few,
    label_axes,
    plot_curve,
    sequence_colours,
)
from hydroelastic.physics.dofs import Dof
from hydroelastic.scenes.open_water.results import OpenSolution

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_MOST_DEFLECTIONS, _MOST_DIRECTIONS = 6, 5
# Angles of a polar plot.
_AROUND = 361
_MOST_CURVES, _MOST_CURVES_IN_TIME, _MOST_MOTIONS = 8, 6, 12
# Of forces each wave has a curve: a legend of more would leave them no room.
_MOST_FORCES = 6
# Times whose steps differ so much are spread logarithmically.
_SPREAD = 5.0
# A peak over less than this part of the frequencies leaves the axes where it is so many times as high as all else.
_NARROW, _HIGH = 0.02, 2.5
_FREQUENCY = "angular frequency ω, rad/s"


def draw_open(solution: OpenSolution, folder: Path, options: PictureOptions) -> None:
    """Draw what the solution holds: one figure for each analysis, and one for each beam in waves."""
    sheets = Sheets(folder=folder, title=solution.scene.title, options=options)
    for number, radiation in enumerate(solution.radiation, 1):
        _draw_radiation(radiation, sheets, f"radiation_{number}", solution.tank.geometry.is_whole)
    for number, response in enumerate(solution.response, 1):
        _draw_response(response.curve or response, sheets, f"response_{number}")
        _draw_directions(response, sheets, f"scattering_{number}")
        for place, plate in enumerate(response.plates):
            _draw_deflection(response, place, sheets, f"deflection_{number}_body_{plate.body + 1}")
    others: tuple[tuple[str, Any, Callable[[Any, Sheets, str], None]], ...] = (
        ("resonance", solution.resonance, _draw_resonances), ("decay", solution.decay, _draw_decay),
        ("spectrum", solution.spectrum, _draw_spectrum), ("motion", solution.motion, _draw_motion),
        ("impulse_response", solution.impulse_response, _draw_impulse_response),
    )  # fmt: skip
    for kind, tables, draw in others:
        for number, table in enumerate(tables, 1):
            draw(table, sheets, f"{kind}_{number}")


def _draw_spectrum(table: SpectrumTable, sheets: Sheets, name: str) -> None:
    """Spectra of the waves and of the responses, those of one unit together."""
    units = list(dict.fromkeys(one.unit for one in table.responses))
    with sheets.sheet(name, table.waves, width=5.5 * (1 + len(units)), height=6.0) as figure:
        first, *others = figure.subplots(1, 1 + len(units), squeeze=False)[0]
        plot_curve(first, table.omega, table.density, 0, "waves")
        label_axes(first, _FREQUENCY, "S, m²·s/rad")
        for axes, unit in zip(others, units, strict=True):
            own = [place for place, one in enumerate(table.responses) if one.unit == unit][:_MOST_CURVES]
            for number, place in enumerate(own):
                words = Dof(table.quantities[place]).words
                plot_curve(axes, table.omega, table.response_density[:, place], number, words)
            # Strain has the unit 1.
            squared = "" if unit == "1" else f"{unit}²·" if unit.isalpha() else f"({unit})²·"
            label_axes(axes, _FREQUENCY, f"spectrum of the response, {squared}s/rad")


def _draw_radiation(table: RadiationTable, sheets: Sheets, name: str, is_whole: bool) -> None:
    """Diagonals of a and b and the force of waves over finite ω: a row for displacements, and one for rotations."""
    order = np.argsort(table.omega)
    order = order[np.isfinite(table.omega[order])]
    if not len(order):
        return
    omega = table.omega[order]
    rows = _by_unit(table.dofs)
    heading = "added mass, radiation damping, force per metre of waves from the left"
    with sheets.sheet(name, heading, width=15.0, height=0.9 + 4.9 * len(rows)) as figure:
        panels = figure.subplots(len(rows), 3, squeeze=False)
        for (left, right, last), (turns, places) in zip(panels, rows, strict=True):
            far = table.infinite_frequency_added_mass
            for number in places[:_MOST_MOTIONS]:
                mass, words = table.added_mass[order, number, number], table.dofs[number].words
                plot_curve(left, omega, np.where(np.isfinite(mass), mass, np.nan), number, words)
                plot_curve(right, omega, table.radiation_damping[order, number, number], number, words)
                if far is not None:
                    left.axhline(far[number, number], color=COLOURS[number % len(COLOURS)], linewidth=0.9, ls=":")
            _plot_forces(last, table, order, places)
            if far is not None:
                left.plot([], [], ":", color=GREY, linewidth=0.9, label="limit for ω → ∞")
            if len(places) > _MOST_MOTIONS:
                left.set_title(f"the first {_MOST_MOTIONS} of {len(places)} motions")
            mass_name, unit = ("added inertia", "kg·m") if turns else ("added mass", "kg/m")
            force = "N/m" if turns else "N/m²"
            if is_whole:
                unit, force = ("kg·m²", "N") if turns else ("kg", "N/m")
            label_axes(left, _FREQUENCY, f"{mass_name} a, {unit}")
            damping_unit = "kg/(m·s)" if unit == "kg/m" else f"{unit}/s"
            label_axes(right, _FREQUENCY, f"radiation damping b, {damping_unit}")
            label_axes(last, _FREQUENCY, f"excitation {'moment' if turns else 'force'} |f|, {force}")


def _plot_forces(axes: Axes, table: RadiationTable, order: np.ndarray, places: list[int]) -> None:
    """The sizes of the forces of waves from the left on some motions, of each wave a curve."""
    for number in places[: max(_MOST_FORCES // len(table.waves), 1)]:
        for incident, which in enumerate(_incident(table)):
            force = np.abs(table.excitation_force[order, incident, 0, number])
            place = number + incident * len(table.dofs)
            plot_curve(axes, table.omega[order], force, place, table.dofs[number].words + which)


def _draw_response(table: ResponseTable, sheets: Sheets, name: str) -> None:
    """Waves that leave, and motions: displacements and rotations, whose units differ."""
    order = np.argsort(table.omega)
    largest = np.argsort(-np.abs(table.amplitudes).max(axis=(0, 1)), kind="stable")
    largest = largest[: max(_MOST_CURVES // len(table.waves), 1)]
    groups = [(turns, [place for place in places if place in largest]) for turns, places in _by_unit(table.dofs)]
    groups = [(turns, places) for turns, places in groups if places]
    heading = f"response per metre of waves from the {table.waves_from}"
    with sheets.sheet(name, heading, width=5.5 * (1 + len(groups)), height=6.0) as figure:
        first, *others = figure.subplots(1, 1 + len(groups))
        if table.partial_waves is None:
            _plot_waves(first, table, order)
        else:
            _plot_widths(first, table, order)
        number = 0
        for axes, (turns, places) in zip(others, groups, strict=True):
            sizes = {table.dofs[motion].words + which: np.abs(table.amplitudes[order, incident, motion])
                     for motion in places for incident, which in enumerate(_incident(table))}  # fmt: skip
            _plot_sizes(axes, table.omega[order], sizes, number)
            number += len(sizes)
            label_axes(axes, _FREQUENCY, "size of rotation, rad/m" if turns else "size of motion, m/m")
            if len(largest) < len(table.dofs):
                axes.set_title(f"the {len(largest)} largest of {len(table.dofs)} motions")


def _plot_waves(axes: Axes, table: ResponseTable, order: np.ndarray) -> None:
    number = 0
    for incident, wave in enumerate(table.waves):
        for outgoing, other in enumerate(table.waves):
            which = f", {wave} to {other}" if len(table.waves) > 1 else ""
            for ratio, label in ((table.reflection, "reflection |R|"), (table.transmission, "transmission |T|")):
                assert ratio is not None
                plot_curve(axes, table.omega[order], np.abs(ratio[order, incident, outgoing]), number, label + which)
                number += 1
    label_axes(axes, _FREQUENCY, "size of elevation, m/m")


def _plot_widths(axes: Axes, table: ResponseTable, order: np.ndarray) -> None:
    """Power that solids of revolution scatter and absorb, over that of a metre of crest."""
    sizes, scattered = {}, scattering_width(table)
    if scattered is not None:
        sizes["scattering width"] = scattered[order, 0]
    if table.absorption.any():
        sizes["capture width"] = table.absorption[order, 0] / table.wavenumbers[order, 0]
    _plot_sizes(axes, table.omega[order], sizes)
    label_axes(axes, _FREQUENCY, "width, m")


def _plot_sizes(axes: Axes, omega: np.ndarray, sizes: dict[str, np.ndarray], first: int = 0) -> None:
    """Sizes over ascending ω. Narrow peaks far above all else leave the axes, and the legend tells their height."""
    limit = _HIGH * max((_passed(omega, size) for size in sizes.values()), default=0.0)
    for number, (words, size) in enumerate(sizes.items(), first):
        peak = int(np.argmax(size))
        height = f", up to {size[peak]:.3g} at {omega[peak]:.4g} rad/s" if size[peak] > limit > 0.0 else ""
        plot_curve(axes, omega, size, number, words + height)
        if height:
            axes.set_ylim(-0.05 * limit, limit)


def _passed(omega: np.ndarray, size: np.ndarray) -> float:
    """The size that is passed over the part `_NARROW` of the frequencies."""
    descending = np.argsort(-size)
    widths = np.gradient(omega)[descending] if len(omega) > 1 else np.ones(1)
    place = np.searchsorted(np.cumsum(widths), _NARROW * widths.sum())
    return float(size[descending[place]])


def _draw_directions(table: ResponseTable, sheets: Sheets, name: str) -> None:
    """Where solids of revolution scatter power to, over its mean, from the direction of the waves to the right."""
    angles = np.linspace(0.0, 2.0 * np.pi, _AROUND, dtype=np.float64)
    found, width = directional_scattering(table, angles), scattering_width(table)
    if found is None or width is None:
        return
    with sheets.sheet(name, "directions of the scattered power, over the mean", width=8.0) as figure:
        axes = figure.subplots(subplot_kw={"projection": "polar"})
        scattering = np.flatnonzero(width[:, 0] > 0.0)
        shown = scattering[np.argsort(table.omega[scattering])]
        shown = shown[few(len(shown), _MOST_DIRECTIONS)]
        for row, colour in zip(shown, sequence_colours(len(shown)), strict=True):
            label = f"ω = {table.omega[row]:.4g} rad/s, σ = {width[row, 0]:.3g} m"
            axes.plot(angles, 2.0 * np.pi * found[row, 0] / width[row, 0], color=colour, label=label)
        axes.set_xlabel("θ from the direction of the waves")
        axes.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0))


def _incident(table: RadiationTable | ResponseTable) -> list[str]:
    return [f", {wave} wave" if len(table.waves) > 1 else "" for wave in table.waves]


def _draw_deflection(table: ResponseTable, place: int, sheets: Sheets, name: str) -> None:
    """|w| along a beam at a few frequencies, one panel for each wave that comes."""
    plate = table.plates[place]
    order = np.argsort(table.omega)
    shown = order[few(len(order), _MOST_DEFLECTIONS)]
    heading = f"deflection of body {plate.body + 1} per metre of waves from the {table.waves_from}"
    with sheets.sheet(name, heading, width=7.5 * len(table.waves)) as figure:
        panels = figure.subplots(1, len(table.waves), squeeze=False)[0]
        for incident, (axes, which) in enumerate(zip(panels, _incident(table), strict=True)):
            for row, colour in zip(shown, sequence_colours(len(shown)), strict=True):
                size = np.abs(plate.deflection[row, incident])
                axes.plot(plate.positions, size, color=colour, label=f"ω = {table.omega[row]:.4g} rad/s")
            label_axes(axes, "x, m", f"size of deflection, m/m{which}")
            axes.set_ylim(bottom=0.0)


def _draw_resonances(table: ResonanceTable, sheets: Sheets, name: str) -> None:
    if not len(table.omega):
        return
    with sheets.sheet(name, "resonances, free motions exp(−iωt)", width=8.0) as figure:
        axes = figure.subplots()
        # The real axis is where nothing dies out.
        axes.axhline(0.0, color=GREY, linewidth=0.9)
        axes.plot(table.omega.real, table.omega.imag, "o", color=BLUE, markersize=7)
        for omega, label in zip(table.omega, table.labels, strict=True):
            # On the left of points at the right edge, so that the words stay inside.
            left = omega.real > 0.5 * (table.omega.real.min() + table.omega.real.max())
            # Above points at the lower edge, below others, for the same reason.
            above = omega.imag < 0.5 * table.omega.imag.min()
            axes.annotate("\n".join(_resonance_words(omega, label)), (omega.real, omega.imag),
                          (-8 if left else 8, 4 if above else -4), textcoords="offset points", fontsize=9,
                          va="bottom" if above else "top", ha="right" if left else "left")  # fmt: skip
        axes.margins(0.2)
        label_axes(axes, "Re ω, rad/s", "Im ω, 1/s: decay below 0", legend="")


def _resonance_words(omega: complex, label: Dof) -> Iterator[str]:
    yield label.words
    yield f"{omega.real:.4g} {_signed(omega.imag)}i"
    if omega.real:
        yield f"period {2.0 * np.pi / omega.real:.4g} s"
        if omega.imag < 0.0:
            # e^(Im ω T) of the amplitude is left after a period T.
            yield f"{100.0 * np.exp(2.0 * np.pi * omega.imag / omega.real):.3g} % left after one"


def _signed(value: float) -> str:
    return f"{'−' if value < 0.0 else '+'} {abs(value):.4g}"


def _draw_decay(table: DecayTable, sheets: Sheets, name: str) -> None:
    """The motions over time, and the one let go on logarithmic axes, where an algebraic tail is straight."""
    released = int(np.argmax(np.abs(table.initial)))
    order = np.argsort(table.times)
    times, displacement = table.times[order], table.displacement[order]
    groups = [(turns, _moving(displacement, places, table)) for turns, places in _by_unit(table.dofs)]
    groups = [(turns, places) for turns, places in groups if places]
    heading = f"free motion after release in {table.dofs[released].words}"
    with sheets.sheet(name, heading, width=6.0 * (1 + len(groups))) as figure:
        *panels, last = figure.subplots(1, 1 + len(groups))
        for axes, (turns, places) in zip(panels, groups, strict=True):
            for number in places:
                plot_curve(axes, times, displacement[:, number], number, table.dofs[number].words)
            label_axes(axes, "time t, s", f"{'rotation, rad' if turns else 'displacement, m'}")
            steps = np.diff(times[times > 0.0])
            if len(steps) and steps.max() > _SPREAD * steps.min():
                # On an even axis late times would be too sparse to follow the motion.
                axes.set_xscale("log")
        _draw_tail(last, table, released)


def _moving(displacement: np.ndarray, places: list[int], table: DecayTable) -> list[int]:
    """Motions of one unit that differ from zero by more than their error: others would be a line at zero."""
    released = int(np.argmax(np.abs(table.initial)))
    error = float(table.absolute_error.max())
    return [place for place in places if place == released or np.abs(displacement[:, place]).max() > error]


def _draw_tail(axes: Axes, table: DecayTable, released: int) -> None:
    """The size of the motion let go, its error, and the algebraic tail that waves give it."""
    order = np.argsort(table.times)
    order = order[table.times[order] > 0.0]
    times, motion = table.times[order], np.abs(table.displacement[order, released])
    if np.count_nonzero(motion) < 2:
        axes.set_axis_off()
        return
    unit, name = "rad" if table.dofs[released].is_rotation else "m", table.dofs[released].words
    axes.loglog(times, motion, ".-", markersize=4, color=COLOURS[released % len(COLOURS)], label=f"|{name}|")
    axes.loglog(times, table.absolute_error[order], ":", color=GREY, label="estimated error")
    if table.tail is not None:
        tail = abs(table.tail)
        power = "⁴" if table.tail_power == 4 else "²"
        label = f"tail {tail:.3g} {unit}·s{power}/t{power}"
        axes.loglog(times, tail / times**table.tail_power, "--", color=GREY, label=label)
        low = max(0.1 * float(motion[motion > 0.0].min()), 1e-16)
        axes.set_ylim(low, 10.0 * float(motion.max()))
    label_axes(axes, "time t, s", f"size of the displacement, {unit}")


def _by_unit(dofs: tuple[Dof, ...]) -> list[tuple[bool, list[int]]]:
    """Places of the motions that are rotations, rad, and of the others, m; those first that come first."""
    turns = [motion.is_rotation for motion in dofs]
    return [(kind, [place for place, turn in enumerate(turns) if turn == kind]) for kind in dict.fromkeys(turns)]


def _draw_impulse_response(table: ImpulseResponseTable, sheets: Sheets, name: str) -> None:
    """The diagonal of K, and the error of what it gives back over the frequency."""
    order = np.argsort(table.times)
    groups = _by_unit(table.dofs)
    with sheets.sheet(name, "impulse responses of radiation", width=6.0 * (1 + len(groups))) as figure:
        *panels, last = figure.subplots(1, 1 + len(groups))
        for axes, (turns, places) in zip(panels, groups, strict=True):
            for motion in places[:_MOST_CURVES_IN_TIME]:
                values = table.impulse_response[order, motion, motion]
                plot_curve(axes, table.times[order], values, motion, table.dofs[motion].words)
            label_axes(axes, "time t, s", "impulse response K, N" if turns else "impulse response K, N/m²")
        plot_curve(last, table.omega, table.causality_error, 0, "a and b by K")
        plot_curve(last, table.omega, table.ogilvie_error, 1, "a∞ by Ogilvie's relation")
        last.axhline(table.relative_error, color=GREY, linewidth=0.9, linestyle=":", label="estimated error")
        last.set(xscale="log", yscale="log")
        label_axes(last, "angular frequency ω, rad/s", "difference over the largest a + ib/ω")


def _draw_motion(table: MotionTable, sheets: Sheets, name: str) -> None:
    """The waves, and below them the motions over time, with those without a beginning."""
    groups = _by_unit(table.dofs)
    heading = f"motion {table.beginning}"
    with sheets.sheet(name, heading, width=10.0, height=1.2 + 2.8 * (1 + len(groups))) as figure:
        first, *panels = figure.subplots(1 + len(groups), 1, sharex=True)
        first.plot(table.times, table.elevation, color=GREY)
        first.set_ylabel("elevation η, m")
        for axes, (turns, places) in zip(panels, groups, strict=True):
            for motion in places[:_MOST_CURVES_IN_TIME]:
                axes.plot(table.times, table.steady[:, motion], color=GREY, linewidth=0.8, linestyle=":")
                plot_curve(axes, table.times, table.displacement[:, motion], motion, table.dofs[motion].words)
            axes.plot([], [], ":", color=GREY, linewidth=0.8, label="without a beginning, by the frequency domain")
            label_axes(axes, "time t, s", "rotation, rad" if turns else "displacement, m", legend="beside")
