"""Fields on plane triangles as pixels: which triangle each pixel shows is found once for all fields on a mesh."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from matplotlib.colors import Colormap
from numpy.typing import NDArray

Array = NDArray[np.float64]

# Triangles are larger by this part of a pixel: where a cell is cut more finely than its neighbour, their triangles
# would leave out a pixel here and there.
_SLACK = 0.05
# Shades of a scale that has one more at its end, for what rounding takes beyond it.
_BEYOND = 8
_STRIP = 32
_WHITE = np.full(4, 255, dtype=np.uint8)


class Same:
    """A thing as the key of a cache: only itself equals it."""

    def __init__(self, thing: Any) -> None:
        """Keep the thing, so that no other one gets its place in memory."""
        self.thing = thing

    def __hash__(self) -> int:
        return id(self.thing)

    def __eq__(self, other: object) -> bool:
        """Return whether both are of the same thing, not of equal ones."""
        return isinstance(other, Same) and other.thing is self.thing


@dataclass(frozen=True, kw_only=True, eq=False)
class Raster:
    """Triangles in a rectangle of pixels.

    Attributes:
        points: corners in pixels from the upper left corner of the rectangle, x to the right, y downwards; shape
            (points, 2).
        triangles: shape (triangles, 3).
        size: width and height in pixels.
    """

    points: Array
    triangles: NDArray[np.integer]
    size: tuple[int, int]

    @cached_property
    def _runs(self) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]:
        """Runs of pixels, row by row, with their middles in one triangle: its number or −1, first pixel, how many."""
        width, height = self.size
        # Middles of pixels at whole numbers; corners of each triangle from the uppermost down.
        corners = (self.points - 0.5)[self.triangles]
        corners = np.take_along_axis(corners, np.argsort(corners[:, :, 1], axis=1)[:, :, None], axis=1)
        (x, y), spans = corners.transpose(2, 1, 0), np.diff(corners, axis=1, append=corners[:, :1]).transpose(2, 1, 0)
        slopes = spans[0] / np.where(spans[1] == 0.0, np.inf, spans[1])
        upper, lower = _within(y[0], y[2], height)
        rows = lower - upper
        triangle = np.repeat(np.arange(len(rows)), rows)
        row = np.arange(len(triangle)) + (lower - np.cumsum(rows))[triangle]
        level = np.clip(row, y[0, triangle], y[2, triangle])
        # The edge from the last corner to the first one passes all rows, each of the others some.
        edge = (level >= y[1, triangle]).astype(np.intp)
        one, other = (x[side, triangle] + slopes[side, triangle] * (level - y[side, triangle]) for side in (edge, 2))
        starts, ends = (
            row * width + column for column in _within(np.minimum(one, other), np.maximum(one, other), width)
        )
        # Of those that begin at the same pixel the longest counts, which is the last one.
        order = np.lexsort((ends, starts))
        order = order[(starts < ends)[order]]
        owners, starts, ends = (np.append(first, of[order]) for first, of in ((-1, triangle), (0, starts), (0, ends)))
        # Triangles share no more pixels than those at their edges: beyond the last end until there is nothing.
        ends = np.maximum.accumulate(ends)
        gaps = np.flatnonzero(ends < np.append(starts[1:], width * height))
        owners, starts = np.insert(owners, gaps + 1, -1), np.insert(starts, gaps + 1, ends[gaps])
        # Each row begins a run.
        rows = width * np.arange(1, height)
        places = np.searchsorted(starts, rows, side="right")
        owners, starts = np.insert(owners, places, owners[places - 1]), np.insert(starts, places, rows)
        return owners, starts, np.diff(starts, append=width * height)

    @cached_property
    def _weights(self) -> Array:
        """Parts of the values at the corners in a, b and c of a + bx + cy on a triangle; shape (triangles, 3, 3)."""
        first, *others = self.points[self.triangles].transpose(1, 2, 0)
        (x1, y1), (x2, y2) = (other - first for other in others)
        area = x1 * y2 - x2 * y1
        # A triangle without an area shows one value.
        area[area == 0.0] = np.inf
        b, c = np.array([y1 - y2, y2, -y1]) / area, np.array([x2 - x1, -x2, x1]) / area
        a = np.eye(3)[:, :1] - b * first[0] - c * first[1]
        return np.ascontiguousarray(np.stack([a, b, c]).transpose(2, 0, 1))

    def _planes(self, values: Array) -> Array:
        """a, b and c of a + bx + cy on triangles, for values at the points; shape (triangles, 3)."""
        return np.einsum("tij,tj->ti", self._weights, values[self.triangles])

    def at(self, places: Array, values: Array) -> Array:
        """Interpolate vectors at the points, shape (points, n), to places in pixels; NaN beside the triangles."""
        column, row = np.floor(places).astype(int).T
        owners, starts, _ = self._runs
        owner = owners[np.searchsorted(starts, row * self.size[0] + column, side="right") - 1]
        terms = np.column_stack([np.where(owner < 0, np.nan, 1.0), places])
        return np.column_stack([(self._planes(component)[owner] * terms).sum(axis=1) for component in values.T])

    def coloured(self, values: Array, limit: float, colours: Colormap) -> NDArray[np.uint8]:
        """Colour the values at the points, from −limit to limit."""
        # Rounding leaves the ends of the scale by a little. What belongs to no triangle, the last one, is white.
        scale = colours(np.arange(colours.N + _BEYOND), bytes=True)
        shades = np.vstack([scale, _WHITE]).view(np.uint32).ravel()
        planes = self._planes(0.5 * colours.N * (1.0 + values / limit))
        planes = np.vstack([planes, [len(shades), 0.0, 0.0]])
        width, height = self.size
        owners, starts, lengths = self._runs
        image, x = np.empty((height, width), dtype=np.uint32), np.arange(0.5, width, dtype=np.float32)
        # Strips that fit into a processor's own memory, in single precision: a thousandth of a shade.
        for top in range(0, height, _STRIP):
            runs = slice(*np.searchsorted(starts, [width * top, width * (top + _STRIP)]))
            along, across, up = planes.take(owners[runs], axis=0).T
            lines = np.column_stack([along + up * (starts[runs] // width + 0.5), across]).astype(np.float32)
            lines = np.repeat(lines, lengths[runs], axis=0).reshape(-1, width, 2)
            shade = lines[:, :, 1] * x
            shade += lines[:, :, 0]
            shades.take(shade.astype(np.intp), out=image[top : top + _STRIP], mode="clip")
        return image.view(np.uint8).reshape(height, width, 4)


def _within(low: Array, high: Array, count: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """The first one of 0 … count − 1 that lies from low to high, and the one after the last; the same if none does."""
    first = np.ceil(np.clip(low - _SLACK, 0.0, count)).astype(np.intp)
    return first, np.maximum(np.floor(np.clip(high + _SLACK, -1.0, count - 1.0)).astype(np.intp) + 1, first)
