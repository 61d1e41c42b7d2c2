"""A white page of pixels on which coloured fields, strokes, ribbons, arrows and text are put.

Page coordinates are pixels from the lower left corner, y upwards. What comes later covers what is there; text covers
all.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.pictures import shapes as picture_shapes
from hydroelastic.fem.pictures.canvas import Canvas, Horizontal, TextLine, Vertical
from hydroelastic.fem.pictures.colours import rgb
from hydroelastic.fem.pictures.liquid import LiquidField
from hydroelastic.fem.pictures.png import png_bytes
from hydroelastic.fem.pictures.shapes import Array, Shape

INK = "#1a1a1a"
GREY = "#5a5a5a"
WHITE = "#ffffff"


class Page:
    """One image under construction.

    Args:
        canvas: renders it.
        width: pixels.
        height: pixels.
    """

    def __init__(self, canvas: Canvas, *, width: int, height: int) -> None:
        """Take an empty page."""
        self.width = width
        self.height = height
        self._canvas = canvas
        self._points: list[Array] = [np.empty((0, 2))]
        self._triangles: list[NDArray[np.int64]] = [np.empty((0, 3), dtype=np.int64)]
        self._colours: list[NDArray[np.uint8]] = [np.empty((0, 4), dtype=np.uint8)]
        self._count = 0
        self._lines: list[TextLine] = []

    def save(self, path: Path) -> None:
        """Render the page and write it as a PNG file."""
        path.write_bytes(png_bytes(self.pixels()))

    def pixels(self) -> NDArray[np.uint8]:
        """Render the page: red, green, blue in 0…255, shape (height, width, 3), the uppermost row first."""
        return self._canvas.pixels(
            self.width,
            self.height,
            np.concatenate(self._points),
            np.concatenate(self._triangles),
            np.concatenate(self._colours),
            self._lines,
        )

    def field(self, field: LiquidField, *, limit: float, colours: Array) -> None:
        """Fill triangles with the colours of a field.

        Args:
            field: ψ, or ρψ, in page coordinates.
            limit: the colours span −limit to limit.
            colours: at equal steps, red, green, blue in 0…1, shape (colours, 3).
        """
        at = np.linspace(-limit, limit, len(colours))
        shades = np.column_stack([np.interp(field.potential, at, channel) for channel in colours.T])
        rgba = np.column_stack([shades, np.ones(len(shades))])
        # Where a cell is cut more finely than its neighbour, their triangles leave out a pixel here and there. What
        # shows through is the same field, moved so that its own gaps lie elsewhere.
        self._put(np.add(field.points, [0.3, 0.4]), field.triangles, rgba)
        self._put(field.points, field.triangles, rgba)

    def gradient(self, edges: Array, bottom: float, top: float, colours: Array) -> None:
        """Fill a rectangle with colours (red, green, blue in 0…1) at its upright edges, and between them."""
        low, high = (np.column_stack([edges, np.full(len(edges), y)]) for y in (bottom, top))
        shape = picture_shapes.band(low, high)
        left, right = colours[:-1, None], colours[1:, None]
        shades = np.concatenate([left, right, right, left], axis=1).reshape(-1, 3)
        self._put(shape.points, shape.triangles, np.column_stack([shades, shape.opacity]))

    def band(self, lower: Array, upper: Array, *, colour: str, opacity: float = 1.0) -> None:
        """Fill the area between two curves with the same number of points (points, 2)."""
        self._fill(picture_shapes.band(lower, upper), colour, opacity)

    def area(self, corners: Array, *, colour: str, opacity: float = 1.0) -> None:
        """Fill a closed polygon of shape (corners, 2)."""
        self._fill(picture_shapes.area(corners), colour, opacity)

    def strokes(self, ends: Array, *, stroke: float, colour: str, joined: bool = False) -> None:
        """Draw straight strokes of a width in pixels; ends of shape (strokes, 2, 2), see `picture_shapes.strokes`."""
        self._fill(picture_shapes.strokes(ends, stroke, joined=joined), colour)

    def ribbon(self, curve: Array, *, stroke: float, colour: str) -> None:
        """Draw a continuous curve of shape (points, 2) with a width in pixels."""
        self._fill(picture_shapes.ribbon(curve, stroke), colour)

    def coloured_ribbon(self, curve: Array, colours: Array, *, stroke: float) -> None:
        """Draw a continuous curve of shape (points, 2) with colours (red, green, blue in 0…1) at its points."""
        apart = picture_shapes.moves_on(curve)
        shape = picture_shapes.ribbon(curve, stroke)
        # A ribbon goes on a little beyond both ends.
        shades = np.pad(colours[apart], ((1, 1), (0, 0)), mode="edge").repeat(4, axis=0)
        if len(shape.points):
            self._put(shape.points, shape.triangles, np.column_stack([shades, shape.opacity]))

    def arrows(self, centres: Array, vectors: Array, *, stroke: float, colour: str) -> None:
        """Draw flat arrows centred at points (arrows, 2), vectors in pixels."""
        for shape in picture_shapes.arrows(centres, vectors, width=stroke):
            self._fill(shape, colour)

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
        red, green, blue = (round(255 * value) for value in rgb(colour))
        self._lines.append(
            TextLine(
                text=text,
                position=position,
                size=size,
                horizontal=horizontal,
                vertical=vertical,
                angle=angle,
                colour=(red, green, blue),
            )
        )

    def text_width(self, text: str, size: float) -> float:
        """Width of a line of text in pixels."""
        return self._canvas.text_width(text, size)

    def _fill(self, shape: Shape, colour: str, opacity: float = 1.0) -> None:
        same = np.broadcast_to(rgb(colour), (len(shape.points), 3))
        self._put(shape.points, shape.triangles, np.column_stack([same, opacity * shape.opacity]))

    def _put(self, points: Array, triangles: NDArray[np.integer], colours: Array) -> None:
        self._points.append(points)
        self._triangles.append(triangles.astype(np.int64) + self._count)
        self._colours.append(np.round(255.0 * colours).astype(np.uint8))
        self._count += len(points)
