"""Pictures of a sweep: a veering diagram of followed modes, curves of quantities against a key, maps over two keys."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hydroelastic.output.plots import (
    BLUE,
    COLOURS,
    DASHES,
    GREEN,
    GREY,
    SEQUENCE,
    VERMILLION,
    PictureOptions,
    Sheets,
    label_axes,
    part_of_colours,
    plot_curve,
)
from hydroelastic.scenes.sweep.contents import SweepContents
from hydroelastic.scenes.sweep.lines import Line, is_logarithmic, place_of
from hydroelastic.scenes.sweep.quantities import shown_columns

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PICTURE = "sweep"

_MARKS = {"crossing": ("x", GREEN), "veering": ("o", GREY), "unresolved": ("^", VERMILLION)}
# Widths of curves without and with all of the first elastic tone, points.
_WIDTHS = 0.9, 5.0


def draw_sweep(sweep: SweepContents, folder: Path, options: PictureOptions, show: tuple[str, ...]) -> None:
    """Write ``sweep.png``, or other formats: a veering diagram, or curves, or maps over two keys."""
    solved = sweep.solved
    axes = solved.grid.axes
    names = shown_columns(sweep.columns, show)
    sheets = Sheets(folder=folder, title=solved.scene.title, options=options)
    heading = f"sweep over {' and '.join(axis.key for axis in axes)}"
    if len(axes) == 1 and solved.lines and not show:
        with sheets.sheet(PICTURE, heading, width=10.0, height=7.0) as figure:
            _draw_veerings(figure, sweep, solved.lines[0])
        return
    maps = len(axes) == 2 and all(axis.is_number and len(axis.values) > 1 for axis in axes)
    with sheets.sheet(PICTURE, heading, width=9.0, height=2.0 + 3.2 * len(names)) as figure:
        (_draw_maps if maps else _draw_curves)(figure, sweep, names)


def _draw_veerings(figure: Figure, sweep: SweepContents, line: Line) -> None:
    """Frequencies of the followed modes; colour and width tell their part in the first elastic tone."""
    from matplotlib.collections import LineCollection

    (axis,) = sweep.solved.grid.axes
    followed = line.followed
    x, omega = np.array(line.values), followed.of_branches("omega")
    beams = len(followed.modes[0].participation)
    # Of all beams together.
    parts = sum((np.nan_to_num(followed.participation(beam)) for beam in range(beams)), np.zeros_like(omega))
    panel = figure.subplots()
    segments, shares = [], []
    for curve, part in zip(omega.T, parts.T, strict=True):
        points = np.column_stack([x, curve])
        segments.append(np.stack([points[:-1], points[1:]], axis=1))
        shares.append(0.5 * (part[:-1] + part[1:]))
    drawn, share = np.concatenate(segments), np.concatenate(shares)
    order = np.argsort(share)
    colours = part_of_colours(SEQUENCE, 0.85, 0.0)
    widths = _WIDTHS[0] + (_WIDTHS[1] - _WIDTHS[0]) * np.clip(share[order], 0.0, 1.0)
    lines = LineCollection(list(drawn[order]), cmap=colours, array=share[order], linewidths=widths, capstyle="round")
    lines.set_clim(0.0, 1.0)
    panel.add_collection(lines)
    if beams:
        figure.colorbar(lines, ax=panel, label="part in the first elastic tone", pad=0.02)
        release = np.array([one.pressure_release for one in followed.modes])
        for beam in range(beams):
            label = "pressure-release tone" if beam == 0 else None
            panel.plot(x, release[:, beam], "--", color=BLUE, linewidth=1.2, label=label)
    _draw_estimates(panel, sweep)
    for kind, (marker, colour) in _MARKS.items():
        met = [(place_of(one, axis), one.omega) for one in line.encounters if one.kind == kind]
        if met:
            panel.plot(*np.array(met).T, marker, color=colour, fillstyle="none", markersize=7, label=kind)
    highest = max(modes.omega[min(followed.count, len(modes.omega)) - 1] for modes in followed.modes)
    # Above the modes asked for there are others up to the first elastic tone, if it is not too high.
    tones = np.concatenate([modes.pressure_release for modes in followed.modes])
    highest = max(highest, *tones[tones < np.nanmax(omega)], 0.0)
    panel.set_ylim(0.0, 1.03 * highest)
    panel.set_xlim(x[0], x[-1])
    if is_logarithmic(axis):
        panel.set_xscale("log")
    label_axes(panel, axis.key, "ω, rad/s")


def _draw_estimates(panel: Axes, sweep: SweepContents) -> None:
    """The first elastic tone by older theories, where they were asked for."""
    from hydroelastic.output.tank.quantities import ESTIMATE_OMEGA, ESTIMATES

    variables = {one.name: one for one in sweep.variables}
    estimate, omega = ESTIMATES.dimension, ESTIMATE_OMEGA.name_behind(ESTIMATES.name_behind(""))
    if omega not in variables:
        return
    (axis,) = sweep.solved.grid.axes
    for number, (name, values) in enumerate(zip(variables[estimate].values, variables[omega].values.T, strict=True)):
        dashes, colour = DASHES[1 + number // len(COLOURS) % (len(DASHES) - 1)], COLOURS[number % len(COLOURS)]
        panel.plot(axis.values, values, dashes, color=colour, linewidth=0.8, label=str(name))


def _draw_curves(figure: Figure, sweep: SweepContents, names: Sequence[str]) -> None:
    """Quantities against the first key, a curve for each combination of the others."""
    first, *others = sweep.solved.grid.axes
    points = sweep.solved.grid.points
    places = np.array(first.values) if first.is_number else np.array([str(value) for value in first.values])
    panels = figure.subplots(len(names), 1, sharex=True, squeeze=False)[:, 0]
    for panel, name in zip(panels, names, strict=True):
        values = np.asarray(sweep.columns[name], dtype=float).reshape(len(places), -1)
        for number, column in enumerate(values.T):
            label = ", ".join(f"{axis.key} = {points[number][axis.key]}" for axis in others)
            plot_curve(panel, places, column, number, label)
        if is_logarithmic(first):
            panel.set_xscale("log")
        across = first.key if panel is panels[-1] else ""
        label_axes(panel, across, _named(sweep, name), legend="beside" if others else "")


def _draw_maps(figure: Figure, sweep: SweepContents, names: Sequence[str]) -> None:
    across, up = sweep.solved.grid.axes
    panels = figure.subplots(len(names), 1, sharex=True, squeeze=False)[:, 0]
    for panel, name in zip(panels, names, strict=True):
        values = np.ma.masked_invalid(np.asarray(sweep.columns[name], dtype=float).reshape(sweep.solved.grid.shape))
        colours = part_of_colours(SEQUENCE, 0.95, 0.05)
        drawn = panel.pcolormesh(across.values, up.values, values.T, cmap=colours, shading="nearest")
        figure.colorbar(drawn, ax=panel, label=_named(sweep, name))
        if min(values.shape) > 2 and values.count() == values.size and np.ptp(values) > 0.0:
            panel.clabel(panel.contour(across.values, up.values, values.T, colors="black", linewidths=0.6), fontsize=8)
        panel.set_xscale("log" if is_logarithmic(across) else "linear")
        panel.set_yscale("log" if is_logarithmic(up) else "linear")
        label_axes(panel, across.key if panel is panels[-1] else "", up.key, legend="")


def _named(sweep: SweepContents, column: str) -> str:
    found = [one for one in sweep.quantities if column == one.name or column.startswith(f"{one.name}_")]
    unit = max(found, key=lambda one: len(one.name)).attributes.get("units", "1") if found else "1"
    return column if unit == "1" else f"{column}, {unit}"
