"""A white page of pixels that pyvista renders off screen: coloured fields, strokes, ribbons, arrows and text.

Page coordinates are pixels from the lower left corner, y upwards. All lines are thin triangles, because the widths
of OpenGL lines depend on the driver. Later layers cover earlier ones.
"""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pyvista

Array = NDArray[np.float64]
Horizontal = Literal["left", "center", "right"]
Vertical = Literal["bottom", "center", "top"]

INK = "#1a1a1a"
GREY = "#5a5a5a"

_MESA_LIBRARIES = ("libOSMesa.so", "libOSMesa.so.8", "libOSMesa.so.6", "osmesa.dll", "libOSMesa.dll")


class NoRendererError(RuntimeError):
    """Neither an X server nor EGL nor OSMesa can render on this computer."""


class Page:
    """One image under construction; a context manager that frees the render window.

    Args:
        width: pixels.
        height: pixels.

    Raises:
        NoRendererError: no library of this computer can render.
    """

    def __init__(self, *, width: int, height: int) -> None:
        """Open a render window."""
        import pyvista

        self.width = width
        self.height = height
        self._layer = 0.0
        self._batches: dict[float, list[tuple[Array, NDArray[np.uint8]]]] = {}
        self._font = _font_file()
        with _quiet_vtk():
            self._plotter = pyvista.Plotter(off_screen=True, window_size=[width, height])
            _require_renderer(self._plotter)
            # Multisampling is not available in software rendering; supersampling is everywhere.
            self._plotter.enable_anti_aliasing("ssaa")
        self._plotter.set_background("white")

    def __enter__(self) -> Page:
        """Return the page itself."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Free the render window."""
        self._plotter.close()

    def save(self, path: Path) -> None:
        """Render the page and write it as a PNG file."""
        self._add_batches()
        camera = self._plotter.camera
        camera.parallel_projection = True
        centre = (self.width / 2, self.height / 2)
        camera.position = (*centre, 1000.0)
        camera.focal_point = (*centre, 0.0)
        camera.up = (0.0, 1.0, 0.0)
        camera.parallel_scale = self.height / 2
        camera.clipping_range = (1.0, 2000.0)
        with _quiet_vtk():
            self._plotter.screenshot(str(path))

    def field(self, mesh: pyvista.PolyData, *, values: str, limit: float, colours: Array) -> None:
        """Fill the triangles of a mesh in page coordinates with colours of a point field.

        Args:
            mesh: triangles.
            values: name of the point field.
            limit: the colours span −limit to limit.
            colours: colours of equal intervals, red, green, blue in 0…1, shape (colours, 3).
        """
        from matplotlib.colors import ListedColormap

        self._layer += 1.0
        self._plotter.add_mesh(
            mesh.translate((0.0, 0.0, self._layer), inplace=False),
            scalars=values,
            cmap=ListedColormap(colours),
            n_colors=len(colours),
            clim=(-limit, limit),
            lighting=False,
            show_scalar_bar=False,
            reset_camera=False,
        )

    def triangles(self, corners: Array, *, colour: str, opacity: float = 1.0) -> None:
        """Fill triangles, corners of shape (triangles, 3, 2)."""
        import pyvista

        rgb = np.array(pyvista.Color(colour).int_rgb, dtype=np.uint8)
        self._batch(corners, np.broadcast_to(rgb, (len(corners), 3)), opacity)

    def strokes(self, ends: Array, *, stroke: float, colour: str) -> None:
        """Draw straight strokes of a width in pixels; ends of shape (strokes, 2, 2).

        Supersampling sees half pixels: a thin upright line of another width would change its shade along the way.
        """
        self.triangles(stroke_triangles(ends, max(0.5 * round(2.0 * stroke), 1.0)), colour=colour)

    def ribbon(self, curve: Array, *, stroke: float, colour: str) -> None:
        """Draw a continuous curve of shape (points, 2) with a width in pixels."""
        left, right = offset_curves(curve, stroke)
        self.triangles(band_triangles(left, right), colour=colour)

    def swatches(self, edges: Array, bottom: float, top: float, colours: Array) -> None:
        """Fill neighbouring rectangles, from edge to edge, each with its colour (red, green, blue in 0…1)."""
        corners = band_triangles(
            np.column_stack([edges, np.full(len(edges), bottom)]), np.column_stack([edges, np.full(len(edges), top)])
        )
        self._batch(corners, np.round(255 * np.vstack([colours, colours])).astype(np.uint8), 1.0)

    def text(
        self,
        position: tuple[float, float],
        text: str,
        *,
        size: float,
        horizontal: Horizontal = "center",
        vertical: Vertical = "center",
        angle: float = 0.0,
        colour: str = INK,
    ) -> None:
        """Write a line of text; the alignment refers to the turned text, the angle is in degrees."""
        actor = self._text_actor(text, size)
        actor.prop.color = colour
        actor.prop.orientation = angle
        actor.prop.justification_horizontal = horizontal
        actor.prop.justification_vertical = vertical
        actor.position = position
        self._plotter.add_actor(actor, reset_camera=False, render=False)

    def text_width(self, text: str, size: float) -> float:
        """Width of a line of text in pixels."""
        extent = [0.0, 0.0]
        self._text_actor(text, size).GetSize(self._plotter.renderer, extent)
        return extent[0]

    def _text_actor(self, text: str, size: float) -> pyvista.Text:
        import pyvista

        actor = pyvista.Text(text)
        actor.prop.set_font_file(self._font)
        actor.prop.font_size = max(round(size), 6)
        return actor

    def _batch(self, corners: Array, rgb: NDArray[np.uint8], opacity: float) -> None:
        """Keep triangles for one common actor: an actor for each of them would cost more than the rendering."""
        self._layer += 1.0
        height = np.full((len(corners), 3, 1), self._layer)
        self._batches.setdefault(opacity, []).append((np.concatenate([corners, height], axis=2), rgb))

    def _add_batches(self) -> None:
        import pyvista

        for opacity, batches in self._batches.items():
            points = np.concatenate([corners for corners, _ in batches]).reshape(-1, 3)
            if len(points):
                faces = np.insert(np.arange(len(points)).reshape(-1, 3), 0, 3, axis=1)
                mesh = pyvista.PolyData(points, faces.ravel())
                mesh.cell_data["colour"] = np.vstack([rgb for _, rgb in batches])
                self._plotter.add_mesh(
                    mesh, scalars="colour", rgb=True, opacity=opacity, lighting=False, reset_camera=False
                )
        self._batches.clear()


def triangle_mesh(points: Array, triangles: NDArray[np.integer]) -> pyvista.PolyData:
    """Triangles in the plane z = 0; points of shape (points, 2), triangles of shape (triangles, 3)."""
    import pyvista

    space = np.column_stack([points, np.zeros(len(points))])
    faces = np.column_stack([np.full(len(triangles), 3), triangles]).ravel()
    return pyvista.PolyData(space, faces)


def stroke_triangles(ends: Array, stroke: float) -> Array:
    """Two triangles for each stroke with ends (strokes, 2, 2), shape (triangles, 3, 2)."""
    ends = ends.reshape(-1, 2, 2)
    normal = 0.5 * stroke * _normals(ends[:, 1] - ends[:, 0])
    a, b, c, d = ends[:, 0] - normal, ends[:, 1] - normal, ends[:, 1] + normal, ends[:, 0] + normal
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def dashes(start: tuple[float, float], end: tuple[float, float], *, dash: float, gap: float) -> Array:
    """Strokes of a dashed straight line, shape (dashes, 2, 2)."""
    a, b = np.array(start), np.array(end)
    length = float(np.hypot(*(b - a)))
    begin = np.arange(0.0, length, dash + gap)
    finish = np.minimum(begin + dash, length)
    along = np.stack([begin, finish], axis=1) / max(length, 1e-12)
    return a + along[:, :, None] * (b - a)


def offset_curves(curve: Array, stroke: float) -> tuple[Array, Array]:
    """The two edges of a ribbon around a curve of shape (points, 2)."""
    steps = np.diff(curve, axis=0)
    keep = np.concatenate([[True], np.hypot(*steps.T) > 1e-6])
    curve = curve[keep]
    if len(curve) < 2:
        return curve, curve
    normals = _normals(np.diff(curve, axis=0))
    corner = _normals_mean(np.vstack([normals[:1], normals]), np.vstack([normals, normals[-1:]]))
    return curve - 0.5 * stroke * corner, curve + 0.5 * stroke * corner


def band_triangles(lower: Array, upper: Array) -> Array:
    """Triangles between two curves with the same number of points, shape (triangles, 3, 2)."""
    a, b, c, d = lower[:-1], lower[1:], upper[1:], upper[:-1]
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def arrow_triangles(centres: Array, vectors: Array, *, stroke: float) -> Array:
    """Triangles of flat arrows centred at points (arrows, 2), vectors in pixels, shape (triangles, 3, 2)."""
    length = np.hypot(*vectors.T)
    direction = vectors / np.maximum(length, 1e-12)[:, None]
    normal = np.column_stack([-direction[:, 1], direction[:, 0]])
    # Short arrows get a smaller head, so that they still look like arrows.
    head = np.minimum(4.5 * stroke, 0.5 * length)[:, None]
    tip, tail = centres + 0.5 * vectors, centres - 0.5 * vectors
    neck = tip - head * direction
    shafts = stroke_triangles(np.stack([tail, neck], axis=1), stroke)
    heads = np.stack([tip, neck + 0.42 * head * normal, neck - 0.42 * head * normal], axis=1)
    return np.concatenate([shafts, heads])


def _normals(steps: Array) -> Array:
    length = np.maximum(np.hypot(*steps.T), 1e-12)
    return np.column_stack([-steps[:, 1], steps[:, 0]]) / length[:, None]


def _normals_mean(before: Array, after: Array) -> Array:
    """Mitre of two unit normals; its length is bounded where the curve turns back."""
    mean = before + after
    length = np.maximum(np.hypot(*mean.T), 1e-12)
    mitre = np.minimum(2.0 / length, 1.5)
    return mean / length[:, None] * mitre[:, None]


def _font_file() -> str:
    """A font with Greek letters and superscripts, which VTK's own fonts leave out silently."""
    import matplotlib

    return str(Path(matplotlib.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf")


@contextmanager
def _quiet_vtk() -> Iterator[None]:
    """Hold back warnings: VTK tries X, EGL and OSMesa in turn and reports each that is absent."""
    from vtkmodules.vtkCommonCore import vtkLogger

    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)
    try:
        yield
    finally:
        vtkLogger.SetStderrVerbosity(verbosity)


def _require_renderer(plotter: pyvista.Plotter) -> None:
    """Refuse before VTK renders without a library, which would end the process."""
    if plotter.render_window.GetClassName() != "vtkOSOpenGLRenderWindow":
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
