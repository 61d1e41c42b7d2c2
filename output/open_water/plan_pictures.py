"""Pictures of the waves around solids of revolution and round plates: from above, and in space by VTK."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from hydroelastic.fem.open_water.plan_waves import MovingSolid, PlanWaves
from hydroelastic.output.plots import (
    BODY,
    BODY_EDGE,
    INK,
    SEQUENCE,
    Sheets,
    new_page,
    page_style,
    part_of_colours,
    plotter,
    show_image,
    write_caption,
    write_title,
)

if TYPE_CHECKING:
    import pyvista

_ANGLES = np.linspace(0.0, 2.0 * np.pi, 181)
# Radius of the water in space, and the amplitude of its waves, in radii of the bodies; at most their slope.
_SEEN, _AMPLITUDE, _SLOPE = 6.0, 0.25, 0.35


def draw_plan_waves(waves: PlanWaves, sheets: Sheets) -> None:
    """Draw the elevation at t = 0 and its amplitude as ``plan_<name>.png``."""
    from matplotlib.patches import Annulus, Circle
    from matplotlib.ticker import MaxNLocator

    x = np.linspace(-1.0, 1.0, 401) * float(waves.radii[-1])
    elevation = waves.elevation(*np.meshgrid(x, x))
    amplitude = np.abs(elevation)
    size = np.nanmax(amplitude)
    panels = (
        (elevation.real, "elevation at t = 0, m/m", part_of_colours("RdBu_r", 0.0, 1.0), -size),
        (amplitude, "amplitude of the elevation, m/m", SEQUENCE, np.nanmin(amplitude)),
    )
    with sheets.sheet(f"plan_{waves.name}", waves.title, width=13.0, height=6.4) as figure:
        for axes, (values, label, colours, low) in zip(figure.subplots(1, 2), panels, strict=True):
            image = axes.contourf(x, x, values, np.linspace(low, size, 21), cmap=colours)
            for inner, outer in waves.waterplanes:
                shape = Annulus((0.0, 0.0), outer, outer - inner) if inner else Circle((0.0, 0.0), outer)
                shape.set(facecolor=BODY, edgecolor=BODY_EDGE, zorder=3)
                axes.add_patch(shape)
            for radius in (radius for radii, _ in waves.plates for radius in (radii[0], radii[-1]) if radius):
                axes.add_patch(Circle((0.0, 0.0), radius, fill=False, edgecolor=BODY_EDGE, zorder=3))
            axes.set_aspect("equal")
            axes.set_xlabel("x, m, along the waves")
            axes.set_ylabel("y, m")
            figure.colorbar(image, ax=axes, label=label, shrink=0.8, ticks=MaxNLocator(7))


def draw_wave_view(waves: PlanWaves, sheets: Sheets) -> None:
    """Draw water and bodies at t = 0 as ``view_<name>.png``."""
    import pyvista

    radius = max(outer for _, outer in _occupied(waves))
    amplitude, width = min(_AMPLITUDE * radius, _SLOPE / waves.wavenumber), sheets.options.width
    scene = plotter((width, round(0.475 * width)))
    surfaces = list(_surfaces(waves, amplitude, min(float(waves.radii[-1]), _SEEN * radius)))
    limit = max(float(np.nanmax(np.abs(surface["elevation"]))) for surface, _ in surfaces)
    for surface, is_plate in surfaces:
        scene.add_mesh(
            surface, scalars="elevation", cmap=part_of_colours("RdBu_r", 0.1, 0.9), clim=(-limit, limit),
            smooth_shading=True, specular=0.1 if is_plate else 0.4, opacity=1.0 if is_plate else 0.8,
            show_scalar_bar=False,
        )  # fmt: skip
        for row in (0, -1) if is_plate else ():
            edge = np.column_stack([axis[row].ravel() for axis in (surface.x, surface.y, surface.z)])
            scene.add_mesh(pyvista.lines_from_points(edge), color=INK, line_width=2.0)
    for solid in waves.solids:
        scene.add_mesh(_revolved(solid, amplitude), color=BODY, smooth_shading=True, split_sharp_edges=True)
    # Waves come from the left.
    scene.view_vector((-0.5, -1.7, 0.75), viewup=(0.0, 0.0, 1.0))
    scene.camera.zoom(2.2)
    with page_style():
        figure = new_page(width, 9.3)
        show_image(figure, scene, 0.0, 0.8, 16.0, 7.6)
        write_title(figure, f"{sheets.title}, ω = {waves.omega:.5g} rad/s, T = {2.0 * np.pi / waves.omega:.4g} s")
        words = f"Water and bodies at t = 0 in waves of {amplitude:.3g} m amplitude from the left, true to scale."
        write_caption(figure, words)
        sheets.save(figure, f"view_{waves.name}")


def _occupied(waves: PlanWaves) -> list[tuple[float, float]]:
    return [*waves.waterplanes, *((float(radii[0]), float(radii[-1])) for radii, _ in waves.plates)]


def _surfaces(waves: PlanWaves, amplitude: float, edge: float) -> Iterator[tuple[pyvista.StructuredGrid, bool]]:
    """The water between bodies up to a radius, and the plates, each with whether it is one."""
    start = 0.0
    for inner, outer in sorted([*_occupied(waves), (edge, edge)]):
        if inner > start:
            yield _ring(waves, start, inner, amplitude), False
        if outer > inner and (inner, outer) not in waves.waterplanes:
            yield _ring(waves, inner, outer, amplitude), True
        start = outer


def _ring(waves: PlanWaves, inner: float, outer: float, amplitude: float) -> pyvista.StructuredGrid:
    import pyvista

    inside = np.linspace(inner, outer, max(round(260 * (outer - inner) / waves.radii[-1]), 8))
    # At an edge the elevation is that of the side that is drawn.
    sampled = np.clip(inside, inner + 1e-9 * outer, outer * (1.0 - 1e-9))
    cosine, sine = np.cos(_ANGLES), np.sin(_ANGLES)
    height = amplitude * waves.elevation(np.outer(sampled, cosine), np.outer(sampled, sine)).real
    grid = pyvista.StructuredGrid(np.outer(inside, cosine), np.outer(inside, sine), height)
    grid["elevation"] = height.ravel(order="F")
    return grid


def _revolved(solid: MovingSolid, amplitude: float) -> pyvista.StructuredGrid:
    """The surface of a body, displaced as at t = 0."""
    import pyvista

    r, level = solid.outline[:, :1], solid.outline[:, 1:]
    x, y, z = r * np.cos(_ANGLES), r * np.sin(_ANGLES), level + 0.0 * _ANGLES
    surge, heave, pitch = (amplitude * motion.real for motion in map(complex, (solid.surge, solid.heave, solid.pitch)))
    return pyvista.StructuredGrid(x + surge - pitch * (z - solid.centre), y, z + heave + pitch * x)
