"""The colours of a field on triangles, rendered by VTK without a screen."""

from __future__ import annotations

import ctypes
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
        Red, green, blue in 0…255, and opacity, shape (height, width, 4), the uppermost row first; white beside the
        triangles.

    Raises:
        NoRendererError: no library of this computer can render.
    """
    return open_window().rendered(mesh, limit, corners, size)


class _Window:
    """Two layers of triangles in front of a camera, in plain colours.

    VTK itself imports in a quarter of the time that the plotter of pyvista needs.
    """

    def __init__(self) -> None:
        """Open a window without a screen."""
        # The first one provides the classes that render.
        import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
        from vtkmodules.util.numpy_support import numpy_to_vtk
        from vtkmodules.vtkCommonCore import vtkLogger, vtkLookupTable
        from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

        # VTK tries X, EGL and OSMesa in turn and reports each that is absent.
        verbosity = vtkLogger.GetCurrentVerbosityCutoff()
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)
        try:
            self._window = vtkRenderWindow()
            _require_renderer(self._window.GetClassName())
            self._window.SetOffScreenRendering(True)
            self._window.Initialize()
        finally:
            vtkLogger.SetStderrVerbosity(verbosity)
        # Plain colours, whose edges walls and surfaces cover: smoothing would take four times as long.
        self._window.SetMultiSamples(0)
        colours = vtkLookupTable()
        colours.SetTable(numpy_to_vtk(mode_colours()(np.arange(256), bytes=True), deep=True))
        self._mapper = vtkPolyDataMapper()
        self._mapper.SetLookupTable(colours)
        self._mapper.InterpolateScalarsBeforeMappingOn()
        renderer = vtkRenderer()
        renderer.SetBackground(1.0, 1.0, 1.0)
        renderer.SetBackgroundAlpha(1.0)
        self._window.AddRenderer(renderer)
        for self._behind in (vtkActor(), vtkActor()):
            self._behind.SetMapper(self._mapper)
            self._behind.GetProperty().LightingOff()
            renderer.AddActor(self._behind)
        self._camera = renderer.GetActiveCamera()
        self._camera.ParallelProjectionOn()

    def rendered(
        self, mesh: pyvista.PolyData, limit: float, corners: tuple[float, float, float, float], size: tuple[int, int]
    ) -> NDArray[np.uint8]:
        """Render as :func:`render_field`."""
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkCommonCore import vtkUnsignedCharArray

        left, right, bottom, top = corners
        across, up, height = 0.5 * (left + right), 0.5 * (bottom + top), top - bottom
        pixel = (right - left) / size[0]
        self._behind.SetPosition(pixel * _BEHIND[0], pixel * _BEHIND[1], -pixel)
        self._mapper.SetInputData(mesh)
        self._mapper.SetScalarRange(-limit, limit)
        self._camera.SetFocalPoint(across, up, 0.0)
        self._camera.SetPosition(across, up, 2.0 * height)
        self._camera.SetParallelScale(0.5 * height)
        self._camera.SetClippingRange(height, 3.0 * height)
        self._window.SetSize(*size)
        self._window.Render()
        page = vtkUnsignedCharArray()
        self._window.GetRGBACharPixelData(0, 0, size[0] - 1, size[1] - 1, 0, page, 0)
        image: NDArray[np.uint8] = vtk_to_numpy(page).reshape(size[1], size[0], 4)
        return image[::-1]


open_window = cache(_Window)
"""The one window of a process: opening it and building its shaders takes longer than drawing."""


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
