"""Quadrilaterals for a tank, refined geometrically towards the beam's ends: a mesh of NumPy alone, for the peers.

Around each end of the beam lie nested half squares that shrink by a constant ratio. Each ring is four trapezoids (two
where the end lies at a wall), similar to those of the next ring, and all else is a grid of rectangles. Edges shared by
two elements run in the same direction in both, as elements of high degree without orientation tables need it.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from hydroelastic.physics.arrays import FloatArray

_GROWTH = 1.5


@dataclass(frozen=True, kw_only=True)
class QuadGrading:
    """How fine the mesh is.

    Attributes:
        water_size: widest element at the water, m.
        beam_size: widest element under the beam, m.
        height: highest element, m.
        rings: rings around each end of the beam.
        ratio: of the sizes of successive rings.
    """

    water_size: float
    beam_size: float
    height: float
    rings: int
    ratio: float


@dataclass(frozen=True, kw_only=True)
class QuadMesh:
    """Nodes, shape (nodes, 2), and quadrilaterals, shape (elements, 4), counter-clockwise.

    Opposite edges 0→1 and 3→2, and 1→2 and 0→3, run in the directions that their neighbours give them as well.
    """

    nodes: FloatArray
    quads: np.ndarray


def graded_quads(length: float, depth: float, beam: tuple[float, float], grading: QuadGrading) -> QuadMesh:
    """Mesh 0 < x < length, −depth < y < 0."""
    tips = [tip for tip in beam if tip <= length]
    distances = [abs(tip - other) for tip in tips for other in (0.0, length, *tips) if tip != other]
    width = min(0.5 * min(distances), 0.5 * depth, grading.water_size)
    cuts = np.unique(
        np.clip([0.0, length, *(tip + step for tip in tips for step in (-width, 0.0, width))], 0.0, length)
    )
    columns = np.unique(
        np.concatenate(
            [
                _between(left, right, width, grading.beam_size if beam[0] <= left < beam[1] else grading.water_size)
                for left, right in pairwise(cuts)
            ]
        )
    )
    rows = _downwards(width, depth, grading.height)
    corners = [
        [(left, low), (right, low), (right, high), (left, high)]
        for left, right in pairwise(columns)
        for number, (high, low) in enumerate(pairwise(rows))
        if number > 0 or all(abs(0.5 * (left + right) - tip) > width for tip in tips)
    ]
    for tip in tips:
        radii = width * grading.ratio ** np.arange(grading.rings, -1, -1.0)
        if tip < length:
            corners += _right_rings(tip, radii)
        if tip > 0.0:
            corners += _left_rings(tip, radii)
    points = np.array(corners).reshape(-1, 2)
    _, first, quads = np.unique(np.round(points / width, 12), axis=0, return_index=True, return_inverse=True)
    return QuadMesh(nodes=points[first], quads=quads.reshape(-1, 4))


def _between(start: float, end: float, width: float, size: float) -> FloatArray:
    """Columns from start to end: as wide as the rings at both ends, growing to the largest size in between."""
    places = np.linspace(start, end, 257)
    nearest = np.minimum(places - start, end - places)
    density = 1.0 / np.minimum(size, width + _GROWTH * nearest)
    passed = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]) * np.diff(places))])
    count = max(1, round(passed[-1]))
    columns: FloatArray = np.interp(np.linspace(0.0, passed[-1], count + 1), passed, places)
    columns[[0, -1]] = start, end
    return columns


def _downwards(width: float, depth: float, size: float) -> FloatArray:
    """Rows from the top to the bottom, the first as high as the rings."""
    heights = [width]
    while sum(heights) < depth:
        heights.append(min(size, (1.0 + _GROWTH) * heights[-1]))
    total = sum(heights[1:])
    scale = (depth - width) / total if total else 1.0
    rows: FloatArray = -np.cumsum([0.0, heights[0], *(scale * height for height in heights[1:])])
    rows[-1] = -depth
    return rows


_Corners = list[list[tuple[float, float]]]


def _right_rings(tip: float, radii: FloatArray) -> _Corners:
    inner = radii[0]
    corners = [[(tip, -inner), (tip + inner, -inner), (tip + inner, 0.0), (tip, 0.0)]]
    for a, b in pairwise(radii):
        corners.append([(tip + a, -a), (tip + b, -b), (tip + b, 0.0), (tip + a, 0.0)])
        corners.append([(tip, -a), (tip, -b), (tip + b, -b), (tip + a, -a)])
    return corners


def _left_rings(tip: float, radii: FloatArray) -> _Corners:
    inner = radii[0]
    corners = [[(tip - inner, -inner), (tip, -inner), (tip, 0.0), (tip - inner, 0.0)]]
    for a, b in pairwise(radii):
        corners.append([(tip - a, -a), (tip - b, -b), (tip, -b), (tip, -a)])
        corners.append([(tip - a, -a), (tip - a, 0.0), (tip - b, 0.0), (tip - b, -b)])
    return corners
