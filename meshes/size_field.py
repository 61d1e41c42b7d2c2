"""Element size wanted at a point: those of the sources, growing with the distance from each."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import inf

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.outline import Curve, Point

# Up to so many sources are evaluated one by one at a single point: NumPy takes longer.
_FEW = 16

FEW = 64
"""Number of sources that are evaluated together: NumPy takes about as long for one."""


@dataclass(frozen=True, kw_only=True)
class Discs:
    """Round sources: within a disc elements have its size."""

    centres: NDArray[np.float64]  # centres (x, y) in the unit of the outline, shape (n, 2)
    radii: NDArray[np.float64]  # radii in the unit of the outline, shape (n,)
    sizes: NDArray[np.float64]  # sizes of elements in the unit of the outline, shape (n,)


class SizeField:
    """h(x) = min(bulk size, h_i + growth · max(|x − source i| − r_i, 0)) over all sources i.

    Sources are straight curves with a size (r_i = 0), the corners with their rings (r_i = h_i is the outermost radius)
    and short pieces of curved ones.
    """

    def __init__(
        self,
        *,
        bulk_size: float,
        growth: float,
        straight: list[Curve],
        rings: list[tuple[Point, float]],
        bends: list[Discs],
    ) -> None:
        self._bulk_size = bulk_size
        corners = np.array([centre for centre, _ in rings]).reshape(-1, 2)
        outermost = np.array([radius for _, radius in rings])
        discs = [Discs(centres=corners, radii=outermost, sizes=outermost), *bends]
        centres = np.concatenate([_complex(part.centres) for part in discs])
        self._sources = Sources(
            starts=np.concatenate([_complex(np.array([curve.start for curve in straight]).reshape(-1, 2)), centres]),
            ends=np.concatenate([_complex(np.array([curve.end for curve in straight]).reshape(-1, 2)), centres]),
            radii=np.concatenate([np.zeros(len(straight)), *(part.radii for part in discs)]),
            sizes=np.concatenate([[curve.size for curve in straight], *(part.sizes for part in discs)]),
            growth=growth,
        )

    def __call__(self, x: float, y: float) -> float:
        if len(self._sources.sizes) <= _FEW:
            return min(self._bulk_size, self._sources.least_at(complex(x, y)))
        return float(self._sources.least(np.array([complex(x, y)]), self._bulk_size)[0])

    def along(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Element size at points of shape (n, 2)."""
        return self._sources.least(_complex(points), self._bulk_size)


def _complex(points: NDArray[np.float64]) -> NDArray[np.complex128]:
    return points[:, 0] + 1j * points[:, 1]


@dataclass(frozen=True, kw_only=True)
class Sources:
    """Line segments, or points, with round ends: within its radius of one the size is its own, farther away it grows.

        h_i(z) = size_i + growth · max(|z − segment i| − radius_i, 0)

    Lengths are in the unit of the mesh, points (x, y) are complex numbers x + iy.
    """

    starts: NDArray[np.complex128]  # first points of the segments, shape (n,)
    ends: NDArray[np.complex128]  # last points, shape (n,); the same for a single point
    radii: NDArray[np.float64]  # shape (n,)
    sizes: NDArray[np.float64]  # shape (n,)
    growth: float  # increase of the size per unit of distance

    def least(self, points: NDArray[np.complex128], most: float) -> NDArray[np.float64]:
        """The least size at points, or ``most`` where all sizes are greater, both of shape (points,)."""
        found = np.full(len(points), most)
        self._lower(points, found)
        return found

    def least_at(self, point: complex) -> float:
        """The least size of all sources at one point, without NumPy."""
        least = inf
        for start, span, along, radius, size in self._listed:
            away = point - start
            away -= min(max((away * along).real, 0.0), 1.0) * span
            least = min(least, size + self.growth * max(abs(away) - radius, 0.0))
        return least

    @cached_property
    def _listed(self) -> list[tuple[complex, complex, complex, float, float]]:
        arrays = self.starts, *self._spans, self.radii, self.sizes
        return list(zip(*(array.tolist() for array in arrays), strict=True))

    def _lower(self, points: NDArray[np.complex128], found: NDArray[np.float64]) -> None:
        """Replace sizes found so far by smaller ones; of many sources only the near ones are evaluated."""
        if not self._halves:
            np.minimum(found, self._values(points), out=found)
            return
        near = self._floor(points) < found
        some, least = points[near], found[near]
        one, other = self._halves
        first = one._floor(some) <= other._floor(some)
        for nearer, farther, chosen in ((one, other, first), (other, one, ~first)):
            if chosen.any():
                part, own = some[chosen], least[chosen]
                nearer._lower(part, own)
                farther._lower(part, own)
                least[chosen] = own
        found[near] = least

    def _values(self, points: NDArray[np.complex128]) -> NDArray[np.float64]:
        """The least size of all sources at points, each source evaluated."""
        away = points[:, None] - self.starts
        spans, along = self._spans
        away -= np.clip((away * along).real, 0.0, 1.0) * spans
        beyond = np.maximum(np.abs(away) - self.radii, 0.0)
        least: NDArray[np.float64] = (self.sizes + self.growth * beyond).min(axis=1, initial=np.inf)
        return least

    @cached_property
    def _spans(self) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
        spans = self.ends - self.starts
        squares = np.abs(spans) ** 2
        return spans, spans.conj() / np.where(squares > 0.0, squares, 1.0)

    def _floor(self, points: NDArray[np.complex128]) -> NDArray[np.float64]:
        """A lower bound of all sizes at points, from their distance from the box around all sources."""
        middle, half, floor = self._box
        away = points - middle
        outside = np.hypot(
            np.maximum(np.abs(away.real) - half.real, 0.0), np.maximum(np.abs(away.imag) - half.imag, 0.0)
        )
        bound: NDArray[np.float64] = floor + self.growth * outside
        return bound

    @cached_property
    def _box(self) -> tuple[complex, complex, float]:
        """Middle and half the extent of the box around all sources with their radii, and the least of their sizes."""
        x, y = (np.array([part(self.starts), part(self.ends)]) for part in (np.real, np.imag))
        lows = complex((x - self.radii).min(), (y - self.radii).min())
        highs = complex((x + self.radii).max(), (y + self.radii).max())
        return 0.5 * (lows + highs), 0.5 * (highs - lows), float(self.sizes.min())

    @cached_property
    def _halves(self) -> tuple[Sources, ...]:
        """The sources of both halves of the box; none if there are few."""
        if len(self.sizes) <= FEW:
            return ()
        middles, half = self.starts + self.ends, self._box[1]
        order = np.argsort(middles.real if half.real >= half.imag else middles.imag, kind="stable")
        return tuple(
            Sources(
                starts=self.starts[some],
                ends=self.ends[some],
                radii=self.radii[some],
                sizes=self.sizes[some],
                growth=self.growth,
            )
            for some in np.array_split(order, 2)
        )
