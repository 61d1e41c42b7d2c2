"""What of a line's surroundings is drawn, the same on all pictures of it: the box, the scale of colours, the stream."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_ARROWS = 7
# Sides of the box: a line that is almost straight is not shown in a slit.
_LEAST_SIDE = 0.2
# A line that leaves a plane y = const by less than this part of its size is seen along y.
_FLAT = 1e-6
# Of a step of labels.
_ROUNDING = 1e-6


@dataclass(frozen=True, kw_only=True)
class LineView:
    """What stays the same on all pictures of a line.

    Attributes:
        low: lower corner of what is shown, m, shape (3,).
        high: upper corner, m; the same y for a line that is seen along y.
        steps: from one labelled value of each axis to the next, m.
        colours: limits of the colour scale.
        quantity: what the colours say.
        measure: the unit of it.
        stream: heights, m, and velocities, m/s, of the stream that is drawn beside; shapes (n,) and (n, 3).
    """

    low: Array
    high: Array
    steps: tuple[float, float, float]
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

    def ticks(self, axis: int) -> Array:
        """Labelled values on an axis, m: whole steps between its ends."""
        step = self.steps[axis]
        first, last = self.low[axis] / step, self.high[axis] / step
        return step * np.arange(np.ceil(first - _ROUNDING), np.floor(last + _ROUNDING) + 1.0)


def line_view(
    points: Array,
    values: Array,
    quantity: str,
    measure: str,
    velocity_at: Callable[[Array], NDArray[np.floating[Any]]] | None = None,
) -> LineView:
    """A view that holds all positions.

    Args:
        points: all positions that will be drawn, m, shape (n, 3).
        values: all values that will be drawn.
        quantity: what they are.
        measure: their unit.
        velocity_at: velocities, shape (n, 3), of points, shape (n, 3), of the stream; ``None`` for a liquid at rest.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    size = float(np.max(high - low))
    floor, top = low[2], high[2]
    margin = np.maximum(0.02 * size, 0.5 * (_LEAST_SIDE * size - (high - low)))
    flat = high[1] - low[1] < _FLAT * size
    scales = [_scale(*limits, size / 10.0) for limits in zip(low - margin, high + margin, strict=True)]
    low = np.array([first for first, _, _ in scales])
    high = np.array([last for _, last, _ in scales])
    if top - floor > _LEAST_SIDE * size:
        # Below the lowest point there may be the bed: nothing is shown as if the sea went on.
        low[2] = floor
    else:
        floor, top = low[2], high[2]
    if flat:
        low[1] = high[1] = points[0, 1]
    stream = None
    if velocity_at is not None:
        heights = np.linspace(floor, top, _ARROWS + 2)[1:-1]
        places = np.column_stack([np.full(_ARROWS, v) for v in 0.5 * (low + high)[:2]] + [heights])
        stream = heights, velocity_at(places).astype(np.float64)
    lowest, highest = float(values.min()), float(values.max())
    if highest - lowest <= 1e-9 * abs(highest):
        # A scale about one value; about zero it ends at 1.
        half = 0.5 * abs(highest) or 1.0
        lowest, highest = lowest - half, highest + half
    return LineView(
        low=low,
        high=high,
        steps=(scales[0][2], scales[1][2], scales[2][2]),
        colours=(lowest, highest),
        quantity=quantity,
        measure=measure,
        stream=stream,
    )


def _scale(low: float, high: float, least: float) -> tuple[float, float, float]:
    """Round ends of a scale that holds an interval, and its step."""
    rough = max((high - low) / 7.0, least)
    unit = 10.0 ** np.floor(np.log10(rough))
    step = float(next(unit * factor for factor in (1.0, 2.0, 2.5, 5.0, 10.0) if unit * factor >= rough))
    first, last = int(np.floor(low / step)), int(np.ceil(high / step))
    return first * step, last * step, step
