"""Pictures of a sweep: curves of quantities against one key, contours over two."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from hydroelastic.output.pictures.curves import Sheets, label_axes, plot_curve
from hydroelastic.output.pictures.options import PictureOptions
from hydroelastic.scenes.errors import Problem, SceneError, shown_value
from hydroelastic.scenes.sweep.run import SolvedSweep
from hydroelastic.scenes.words import proposal

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PICTURE = "sweep"

# The first of these that a table has is shown where nothing is asked for.
_MAIN = (
    ("first_elastic_omega", "first_elastic_participation", "first_elastic_pressure_release_omega"),
    ("omega_1", "omega_2", "omega_3"),
    ("response_largest_displacement",),
    ("equilibrium_largest_tension",),
    ("response_largest_angle_degrees",),
)


def shown_columns(table: Any, show: tuple[str, ...]) -> tuple[str, ...]:
    """Return the columns to show: those asked for, or else the main ones of the kind of scene.

    Raises:
        SceneError: if there is no such column, or it does not hold numbers.
    """
    numbers = [name for name in table if np.issubdtype(table[name].dtype, np.number)]
    for name in show:
        if name.replace(".", "_") not in numbers:
            raise SceneError(
                Problem(
                    key="--show",
                    value=shown_value(name),
                    wrong="it holds no numbers" if name in table else "there is no such quantity",
                    allowed="a column of sweep.csv with numbers",
                    remedy=proposal(name, numbers) or f"There are {', '.join(numbers[:12])} …",
                )
            )
    if show:
        return tuple(name.replace(".", "_") for name in show)
    found = next((names for names in _MAIN if names[0] in numbers), tuple(numbers[-1:]))
    return tuple(name for name in found if name in numbers)


def draw_sweep(solved: SolvedSweep, table: Any, folder: Path, options: PictureOptions, show: tuple[str, ...]) -> None:
    """Write ``sweep.png``, or other formats.

    Args:
        solved: the points.
        table: one row for each, a data frame.
        folder: an existing folder.
        options: formats and sizes.
        show: names of quantities; the main ones by default.
    """
    names = shown_columns(table, show)
    sheets = Sheets(folder=folder, title=solved.scene.title, options=options)
    heading = f"sweep over {' and '.join(axis.key for axis in solved.grid.axes)}"
    with sheets.sheet(PICTURE, heading, width=9.0, height=2.0 + 3.2 * len(names)) as figure:
        _draw_curves(figure, solved, table, names)


def _draw_curves(figure: Figure, solved: SolvedSweep, table: Any, names: tuple[str, ...]) -> None:
    first, *others = solved.grid.axes
    panels = figure.subplots(len(names), 1, sharex=True, squeeze=False)[:, 0]
    for axes, name in zip(panels, names, strict=True):
        values = table[name].to_numpy(dtype=float).reshape(len(first.values), -1)
        for number, column in enumerate(values.T):
            row = solved.grid.points[number]
            label = ", ".join(f"{axis.key} = {row[axis.key]}" for axis in others)
            plot_curve(axes, np.array(first.values), column, number, label)
        label_axes(axes, first.key if axes is panels[-1] else "", name, legend="beside" if others else "")
