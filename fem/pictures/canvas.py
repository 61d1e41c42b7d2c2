"""A window of pyvista without a screen: it draws coloured triangles and text, page after page.

Opening a window and building its shaders takes a tenth of a second, drawing a page a fortieth: one window serves for
all pages. pyvista is imported inside `Canvas`, so that a run without pictures does not load it.
"""

from __future__ import annotations

import ctypes
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pyvista

Horizontal = Literal["left", "center", "right"]
Vertical = Literal["bottom", "center", "top"]

_MESA_LIBRARIES = ("libOSMesa.so", "libOSMesa.so.8", "libOSMesa.so.6", "osmesa.dll", "libOSMesa.dll")


class NoRendererError(RuntimeError):
    """Neither an X server nor EGL nor OSMesa can render on this computer."""


@dataclass(frozen=True, kw_only=True)
class TextLine:
    """A line of text.

    Attributes:
        text: what is written.
        position: pixels from the lower left corner of the page.
        size: height of the font in pixels.
        horizontal: which part of the turned text stands at the position.
        vertical: the same upwards.
        angle: degrees.
        colour: red, green, blue in 0…255.
    """

    text: str
    position: tuple[float, float]
    size: float
    horizontal: Horizontal
    vertical: Vertical
    angle: float
    colour: tuple[int, int, int]


class Canvas:
    """A render window; a context manager that frees it.

    Raises:
        NoRendererError: no library of this computer can render.
    """

    def __init__(self) -> None:
        """Open a window."""
        import pyvista

        self._font = _font_file()
        with quiet_vtk():
            self._plotter = pyvista.Plotter(off_screen=True, lighting="none")
            self._window = self._plotter.render_window
            _require_renderer(self._window.GetClassName())
        # The shapes bring soft edges of their own.
        self._window.SetMultiSamples(0)
        self._renderer = self._plotter.renderer
        self._renderer.set_background("white")
        # Triangles are drawn in their order, each over those before it: nothing is to be sorted by depth.
        self._renderer.SetUseOIT(False)

    def __enter__(self) -> Canvas:
        """Return the canvas itself."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Free the window."""
        self._plotter.close()

    def text_width(self, text: str, size: float) -> float:
        """Width of a line of text in pixels."""
        extent = [0.0, 0.0]
        self._text_actor(text, size).GetSize(self._renderer, extent)
        return extent[0]

    def pixels(
        self,
        width: int,
        height: int,
        points: NDArray[np.float64],
        triangles: NDArray[np.int64],
        colours: NDArray[np.uint8],
        lines: Sequence[TextLine],
    ) -> NDArray[np.uint8]:
        """Draw a page: triangles in their order, then text.

        Args:
            width: of the page in pixels.
            height: the same.
            points: pixels from the lower left corner, shape (points, 2).
            triangles: shape (triangles, 3).
            colours: red, green, blue and opacity of each point in 0…255, shape (points, 4).
            lines: the text.

        Returns:
            Red, green, blue in 0…255, shape (height, width, 3), the uppermost row first.
        """
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkCommonCore import vtkUnsignedCharArray

        self._renderer.RemoveAllViewProps()
        self._renderer.AddActor(_triangle_actor(points, triangles, colours))
        for line in lines:
            self._renderer.AddViewProp(self._written(line))
        self._window.SetSize(width, height)
        self._look_at_page(width, height)
        values = vtkUnsignedCharArray()
        with quiet_vtk():
            self._window.Render()
            self._window.GetPixelData(0, 0, width - 1, height - 1, 0, values, 0)
        upwards: NDArray[np.uint8] = vtk_to_numpy(values).reshape(height, width, 3)
        return upwards[::-1]

    def _look_at_page(self, width: int, height: int) -> None:
        camera = self._renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetPosition(0.5 * width, 0.5 * height, 1.0)
        camera.SetFocalPoint(0.5 * width, 0.5 * height, 0.0)
        camera.SetParallelScale(0.5 * height)
        camera.SetClippingRange(0.5, 1.5)

    def _written(self, line: TextLine) -> pyvista.Text:
        actor = self._text_actor(line.text, line.size)
        actor.prop.color = line.colour
        actor.prop.orientation = line.angle
        actor.prop.justification_horizontal = line.horizontal
        actor.prop.justification_vertical = line.vertical
        actor.position = line.position
        return actor

    def _text_actor(self, text: str, size: float) -> pyvista.Text:
        import pyvista

        # VTK would set what stands between dollar signs as a formula, and what a bar divides as columns.
        actor = pyvista.Text(text.replace("$", r"\$").replace("|", "∣"))
        actor.prop.set_font_file(self._font)
        actor.prop.font_size = max(round(size), 6)
        return actor


def _triangle_actor(
    points: NDArray[np.float64], triangles: NDArray[np.int64], colours: NDArray[np.uint8]
) -> pyvista.Actor:
    """All triangles of a page as one actor: one for each shape would cost more than the drawing."""
    import pyvista

    space = np.column_stack([points, np.zeros(len(points))]).astype(np.float32)
    mesh = pyvista.PolyData.from_regular_faces(space, triangles)
    mesh.point_data.set_array(colours, "colours")
    mesh.point_data.active_scalars_name = "colours"
    mapper = pyvista.DataSetMapper(dataset=mesh)
    mapper.SetColorModeToDirectScalars()
    actor = pyvista.Actor(mapper=mapper)
    actor.prop.lighting = False
    actor.ForceTranslucentOn()
    return actor


def _font_file() -> str:
    """A font with Greek letters and superscripts, which VTK's own fonts leave out silently: that of matplotlib."""
    font = Path("mpl-data", "fonts", "ttf", "DejaVuSans.ttf")
    # Without an import, which takes a tenth of a second, where the fonts lie beside the code.
    package = find_spec("matplotlib")
    if package is not None and package.origin is not None:
        beside = Path(package.origin).parent / font
        if beside.is_file():
            return str(beside)
    import matplotlib

    return str(Path(matplotlib.get_data_path(), *font.parts[1:]))


@contextmanager
def quiet_vtk() -> Iterator[None]:
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
