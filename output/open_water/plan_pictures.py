"""Pictures of the waves around solids of revolution, seen from above."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hydroelastic.fem.open_water.plan_waves import PlanWaves
from hydroelastic.output.plots import BODY, BODY_EDGE, SEQUENCE, part_of_colours
from hydroelastic.output.plots import Sheets
from hydroelastic.output.plots import PictureOptions

# Points across a picture, and shades of its colours.
_POINTS, _SHADES = 401, 20
# Numbers beside a scale of colours.
_TICKS = 7


def draw_plan_waves(waves: PlanWaves, title: str, folder: Path, options: PictureOptions) -> None:
    """Draw the elevation at t = 0 and its amplitude as ``plan_<name>.png``."""
    from matplotlib.patches import Annulus, Circle
    from matplotlib.ticker import MaxNLocator

    edge = float(waves.radii[-1])
    x = np.linspace(-edge, edge, _POINTS)
    elevation = waves.elevation(*np.meshgrid(x, x))
    sheets = Sheets(folder=folder, title=title, options=options)
    with sheets.sheet(f"plan_{waves.name}", waves.title, width=13.0, height=6.4) as figure:
        size = np.nanmax(np.abs(elevation))
        panels = (
            (elevation.real, "elevation at t = 0, m/m", part_of_colours("RdBu_r", 0.0, 1.0), (-size, size)),
            (np.abs(elevation), "amplitude of the elevation, m/m", SEQUENCE, (np.nanmin(np.abs(elevation)), size)),
        )
        for axes, (values, label, colours, (low, high)) in zip(figure.subplots(1, 2), panels, strict=True):
            image = axes.contourf(x, x, values, np.linspace(low, high, _SHADES + 1), cmap=colours)
            for inner, outer in waves.waterplanes:
                shape = Annulus((0.0, 0.0), outer, outer - inner) if inner else Circle((0.0, 0.0), outer)
                shape.set(facecolor=BODY, edgecolor=BODY_EDGE, zorder=3)
                axes.add_patch(shape)
            for radii, _ in waves.plates:
                for radius in filter(None, (radii[0], radii[-1])):
                    axes.add_patch(Circle((0.0, 0.0), radius, fill=False, edgecolor=BODY_EDGE, zorder=3))
            axes.set_aspect("equal")
            axes.set_xlabel("x, m, along the waves")
            axes.set_ylabel("y, m")
            figure.colorbar(image, ax=axes, label=label, shrink=0.8, ticks=MaxNLocator(_TICKS))
