"""Views in space of the waves around solids of revolution and round plates, which move in them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.open_water.plan_waves import MovingSolid, PlanWaves
from hydroelastic.output.plots import BODY, INK, diverging_colours
from hydroelastic.output.plots import PictureOptions
from hydroelastic.output.plots import WIDTH, FieldImage, new_page, pixels, save, write_caption, write_title
from hydroelastic.output.plots import require_renderer

if TYPE_CHECKING:
    import pyvista

# Sizes in pixels of a page that is 1600 pixels wide.
_HEIGHT, _ABOVE, _BELOW = 760, 90, 80
# From where the water is seen; waves come from the left.
_FROM = (-0.5, -1.7, 0.75)
_ZOOM = 2.2
# Radius of the water that is seen, in radii of the bodies.
_SEEN = 6.0
# Circles across the water, and angles around it.
_CIRCLES, _ANGLES = 260, 181
# Amplitude of the waves that are drawn, in radii of the bodies, and at most their slope.
_AMPLITUDE, _SLOPE = 0.25, 0.35


def draw_wave_view(waves: PlanWaves, title: str, folder: Path, options: PictureOptions) -> None:
    """Draw water and bodies at t = 0 as ``view_<name>.png``."""
    amplitude = min(_AMPLITUDE * max(outer for _, outer in _occupied(waves)), _SLOPE / waves.wavenumber)
    scale = options.width / WIDTH
    figure = new_page(_HEIGHT + _ABOVE + _BELOW, options.width)
    size = round(WIDTH * scale), round(_HEIGHT * scale)
    figure.add_artist(FieldImage(_view(waves, amplitude, size), 0, round(_BELOW * scale)))
    write_title(figure, f"{title}, ω = {waves.omega:.5g} rad/s")
    write_caption(
        figure, f"Water and bodies at t = 0 in waves of {amplitude:.3g} m amplitude from the left, true to scale."
    )
    save(pixels(figure), folder / f"view_{waves.name}.png")


def _view(waves: PlanWaves, amplitude: float, size: tuple[int, int]) -> NDArray[np.uint8]:
    # Without a library that renders, VTK would end the process.
    require_renderer()
    import pyvista

    plotter = pyvista.Plotter(off_screen=True, window_size=list(size))
    plotter.set_background("white")
    plotter.enable_parallel_projection()
    edge = min(float(waves.radii[-1]), _SEEN * max(outer for _, outer in _occupied(waves)))
    surfaces = list(_surfaces(waves, amplitude, edge))
    limit = max(float(np.nanmax(np.abs(surface["elevation"]))) for surface, _ in surfaces)
    for surface, is_plate in surfaces:
        plotter.add_mesh(
            surface,
            scalars="elevation",
            cmap=diverging_colours(-0.8, 0.8),
            clim=(-limit, limit),
            smooth_shading=True,
            specular=0.1 if is_plate else 0.4,
            opacity=1.0 if is_plate else 0.8,
            show_scalar_bar=False,
        )
        for row in (0, -1) if is_plate else ():
            # At the axis it is a point.
            edge_line = np.column_stack([axis[row].ravel() for axis in (surface.x, surface.y, surface.z)])
            plotter.add_mesh(pyvista.lines_from_points(edge_line), color=INK, line_width=2.0)
    for solid in waves.solids:
        plotter.add_mesh(_revolved(solid, amplitude), color=BODY, smooth_shading=True, split_sharp_edges=True)
    plotter.view_vector(_FROM, viewup=(0.0, 0.0, 1.0))
    plotter.camera.zoom(_ZOOM)
    image = np.asarray(plotter.screenshot(return_img=True))
    plotter.close()
    return image


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

    count = max(round(_CIRCLES * (outer - inner) / waves.radii[-1]), 8)
    # At an edge the elevation is that of the side that is drawn.
    inside = np.linspace(inner, outer, count)
    sampled = np.clip(inside, inner + 1e-9 * outer, outer * (1.0 - 1e-9))
    angles = np.linspace(0.0, 2.0 * np.pi, _ANGLES)
    cosine, sine = np.cos(angles), np.sin(angles)
    height = amplitude * waves.elevation(np.outer(sampled, cosine), np.outer(sampled, sine)).real
    grid = pyvista.StructuredGrid(np.outer(inside, cosine), np.outer(inside, sine), height)
    grid["elevation"] = height.ravel(order="F")
    return grid


def _revolved(solid: MovingSolid, amplitude: float) -> pyvista.StructuredGrid:
    """The surface of a body, displaced as at t = 0."""
    import pyvista

    angles = np.linspace(0.0, 2.0 * np.pi, _ANGLES)
    r, level = solid.outline[:, :1], solid.outline[:, 1:]
    x, y, z = r * np.cos(angles), r * np.sin(angles), level + 0.0 * angles
    surge, heave, pitch = (amplitude * motion.real for motion in map(complex, (solid.surge, solid.heave, solid.pitch)))
    return pyvista.StructuredGrid(x + surge - pitch * (z - solid.centre), y, z + heave + pitch * x)
