"""The minimum of many functions that grow with the distance from their boxes, by a bounding-volume hierarchy."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import hypot
from typing import TypeAlias

Box: TypeAlias = tuple[float, float, float, float]
"""Left, right, low, high."""

FEW = 8
"""Number of sources up to which a box is not divided further."""


@dataclass(frozen=True, kw_only=True)
class Source:
    """A function of a point that is at least its floor plus the growth times the distance from its box.

    Attributes:
        box: its bounding box.
        floor: see above.
        value: x, y → its value.
    """

    box: Box
    floor: float
    value: Callable[[float, float], float]


@dataclass(frozen=True, kw_only=True)
class Sources:
    """A hierarchy of sources for the minimum of their values: only near sources are evaluated.

    Attributes:
        sources: all of them.
        growth: of each with the distance from its box, at least.
    """

    sources: Sequence[Source]
    growth: float

    def least(self, x: float, y: float, most: float) -> float:
        """Return the least size at a point (x, y), in the unit of the mesh, or ``most`` where all sizes are greater."""
        found = most
        waiting = [(self._floor(x, y), self)] if self.sources else []
        while waiting:
            floor, group = waiting.pop()
            if floor >= found:
                continue
            if group._halves:
                one, other = ((half._floor(x, y), half) for half in group._halves)
                # The last source is evaluated first.
                waiting += (other, one) if one[0] <= other[0] else (one, other)
            else:
                found = min(found, *(source.value(x, y) for source in group.sources))
        return found

    def _floor(self, x: float, y: float) -> float:
        left, right, low, high, floor = self._whole
        return floor + self.growth * hypot(max(left - x, 0.0, x - right), max(low - y, 0.0, y - high))

    @cached_property
    def _whole(self) -> tuple[float, float, float, float, float]:
        """The box around all sources, and the least of their floors."""
        lefts, rights, lows, highs = zip(*(source.box for source in self.sources), strict=True)
        return min(lefts), max(rights), min(lows), max(highs), min(source.floor for source in self.sources)

    @cached_property
    def _halves(self) -> tuple[Sources, ...]:
        """The sources of both halves of the box; none if there are few."""
        if len(self.sources) <= FEW:
            return ()
        left, right, low, high, _ = self._whole
        first, last = (0, 1) if right - left >= high - low else (2, 3)
        ordered = sorted(self.sources, key=lambda source: source.box[first] + source.box[last])
        middle = len(ordered) // 2
        return tuple(Sources(sources=part, growth=self.growth) for part in (ordered[:middle], ordered[middle:]))
