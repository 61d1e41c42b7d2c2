"""The colours of a field on triangles, rendered by pyvista without a screen."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from hydroelastic.output.pictures.colours import mode_colours

if TYPE_CHECKING:
    import pyvista

_MESA_LIBRARIES = ("libOSMesa.so", "libOSMesa.so.8", "libOSMesa.so.6", "osmesa.dll", "libOSMesa.dll")
# Where a cell is cut more finely than its neighbour, their triangles leave out a pixel here and there. What shows
# through is the same field, moved by so many pixels that its own gaps lie elsewhere.
_BEHIND = (0.3, 0.4)


class NoRendererError(RuntimeError):
    """Neither an X server nor EGL nor OSMesa can render on this computer."""


def render_field(
    mesh: pyvista.PolyData, limit: float, corners: tuple[float, float, float, float], size: tuple[int, int]
) -> NDArray[np.uint8]:
    """Colour the active scalars of plane triangles.

    Args:
        mesh: the triangles, at z = 0.
        limit: the colours of modes span −limit to limit.
        corners: what is shown: left, right, bottom and top.
        size: width and height in pixels.

    Returns:
        Red, green, blue in 0…255, shape (height, width, 3), the uppermost row first; white beside the triangles.

    Raises:
        NoRendererError: no library of this computer can render.
    """
    plotter = open_plotter()
    left, right, bottom, top = corners
    pixel = (right - left) / size[0]
    plotter.actors["behind"].position = (pixel * _BEHIND[0], pixel * _BEHIND[1], -pixel)
    mapper = plotter.actors["field"].mapper
    mapper.dataset = mesh
    mapper.scalar_range = (-limit, limit)
    camera = plotter.camera
    camera.up = (0.0, 1.0, 0.0)
    camera.focal_point = (0.5 * (left + right), 0.5 * (bottom + top), 0.0)
    camera.position = (0.5 * (left + right), 0.5 * (bottom + top), 2.0 * (top - bottom))
    camera.parallel_scale = 0.5 * (top - bottom)
    camera.clipping_range = (top - bottom, 3.0 * (top - bottom))
    # pyvista's own setter would render at once.
    plotter.render_window.SetSize(*size)
    with _quiet():
        plotter.render()
        return np.asarray(plotter.image)


@cache
def open_plotter() -> pyvista.Plotter:
    """The one window of a process: opening it and building its shaders takes longer than drawing.

    Raises:
        NoRendererError: no library of this computer can render.
    """
    import pyvista

    with _quiet():
        plotter = pyvista.Plotter(off_screen=True, lighting="none")
        _require_renderer(plotter.render_window.GetClassName())
        plotter.enable_parallel_projection()
        # Plain colours, whose edges walls and surfaces cover: smoothing would take four times as long.
        plotter.render_window.SetMultiSamples(0)
        plotter.renderer.SetUseOIT(False)
        colours = pyvista.LookupTable(mode_colours())
        mapper = pyvista.DataSetMapper(pyvista.Triangle())
        mapper.lookup_table = colours
        mapper.interpolate_before_map = True
        for name in ("behind", "field"):
            plotter.add_actor(pyvista.Actor(mapper=mapper), name=name, reset_camera=False)
            plotter.actors[name].prop.lighting = False
        plotter.set_background("white")
        # Until it has been shown, it renders nothing and has no image.
        plotter.show(auto_close=False)
    return plotter


@contextmanager
def _quiet() -> Iterator[None]:
    """Hold back warnings: VTK tries X, EGL and OSMesa in turn and reports each that is absent."""
    from vtkmodules.vtkCommonCore import vtkLogger

    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)
    try:
        yield
    finally:
        vtkLogger.SetStderrVerbosity(verbosity)


def _require_renderer(window: str) -> None:
    """Refuse before VTK renders without a library, which would end the process, judging by the window's class."""
    if window != "vtkOSOpenGLRenderWindow":
        return
    for name in _MESA_LIBRARIES:
        try:
            ctypes.CDLL(name)
        except OSError:
            continue
        return
    raise NoRendererError(
        "pictures need a library that renders without a screen: install EGL (libegl1 on Debian and Ubuntu) "
        "or OSMesa (libosmesa6)"
    )
