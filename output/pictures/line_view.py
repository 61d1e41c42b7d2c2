"""What of a line's surroundings is drawn, the same on all pictures of it: the box, the scale of colours, the stream."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_ARROWS = 7
# Of the size of the line, on each side of it: its strokes and marks stay within the box.
_MARGIN = 0.04
# Sides of the box: a line that is almost straight is not shown in a slit.
_LEAST_SIDE = 0.2
# A line that leaves a plane y = const by less than this part of its size is seen along y.
_FLAT = 1e-6


@dataclass(frozen=True, kw_only=True)
class LineView:
    """What stays the same on all pictures of a line.

    Attributes:
        low: lower corner of what is shown, m, shape (3,).
        high: upper corner, m; the same y for a line that is seen along y.
        colours: limits of the colour scale.
        quantity: what the colours say.
        measure: the unit of it.
        stream: heights, m, and velocities, m/s, of the stream that is drawn beside; shapes (n,) and (n, 3).
    """

    low: Array
    high: Array
    colours: tuple[float, float]
    quantity: str
    measure: str
    stream: tuple[Array, Array] | None = None

    @property
    def flat(self) -> bool:
        """Whether the line lies in a plane y = const, and is seen along y."""
        return bool(self.low[1] == self.high[1])

    @property
    def diagonal(self) -> float:
        """Of what is shown, m."""
        return float(np.linalg.norm(self.high - self.low))

    @property
    def fastest(self) -> float:
        """Largest speed of the stream, m/s."""
        return 0.0 if self.stream is None else float(np.max(np.linalg.norm(self.stream[1], axis=1)))


@dataclass(frozen=True, kw_only=True)
class DrawnLine:
    """A line and what is on it.

    Attributes:
        points: m, shape (n, 3).
        values: by which it is coloured, shape (n,).
        fixed: points that are held, shape (k, 3).
        bodies: points that carry something, shape (m, 3).
        title: above the picture.
        note: what else the caption says.
    """

    points: Array
    values: Array
    fixed: Array
    bodies: Array
    title: str
    note: str = ""


def line_view(
    points: Array,
    values: Array,
    quantity: str,
    measure: str,
    velocity_at: Callable[[Array], NDArray[np.floating[Any]]] | None = None,
) -> LineView:
    """A view that holds all positions."""
    low, high = points.min(axis=0), points.max(axis=0)
    size = float(np.max(high - low))
    floor, top = low[2], high[2]
    margin = np.maximum(_MARGIN * size, 0.5 * (_LEAST_SIDE * size - (high - low)))
    flat = high[1] - low[1] < _FLAT * size
    low, high = low - margin, high + margin
    if top - floor <= _LEAST_SIDE * size:
        floor, top = low[2], high[2]
    if flat:
        low[1] = high[1] = points[0, 1]
    stream = None
    if velocity_at is not None:
        # Below the lowest point there may be the bed: the stream is not shown as if the sea went on.
        heights = np.linspace(floor, top, _ARROWS + 2)[1:-1]
        places = np.column_stack([np.full(_ARROWS, v) for v in 0.5 * (low + high)[:2]] + [heights])
        stream = heights, velocity_at(places).astype(np.float64)
    lowest, highest = float(values.min()), float(values.max())
    if highest - lowest <= 1e-9 * abs(highest):
        # A scale about one value; about zero it ends at 1.
        half = 0.5 * abs(highest) or 1.0
        lowest, highest = lowest - half, highest + half
    return LineView(low=low, high=high, colours=(lowest, highest), quantity=quantity, measure=measure, stream=stream)
