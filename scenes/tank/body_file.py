"""Surfaces, beams and floats as a file of lines and polygons for ParaView."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.shape_curves import FloatSection, SurfaceCurve
from hydroelastic.output.vtu import write_vtu

# Numbers of the array `part`.
_CURVES = {"free_surface": 1, "interface": 2, "body": 3}
_FLOAT = 4

Array = NDArray[np.float64]


def displacement_of(surfaces: Iterable[SurfaceCurve], floats: Iterable[FloatSection]) -> Array:
    """Return the displacement of every point, m, in the order of `write_bodies`, shape (points, 3)."""
    zero = np.zeros
    moved = [np.column_stack([zero(len(one.x)), one.displacement, zero(len(one.x))]) for one in surfaces]
    moved += [np.column_stack([one.displacement, zero(len(one.displacement))]) for one in floats]
    return np.concatenate([zero((0, 3)), *moved])


def write_bodies(
    path: Path,
    surfaces: Iterable[SurfaceCurve],
    floats: Iterable[FloatSection],
    arrays: Mapping[str, Array],
) -> None:
    """Write a VTU file of surfaces of liquids and beams, as lines, and of floats, as polygons, at rest; in m.

    The array `part` of its cells is 1 on a free surface, 2 on an interface, 3 on a beam, 4 on a float.
    """
    points: list[Array] = [np.zeros((0, 3))]
    cells: list[tuple[str, NDArray[np.int64]]] = []
    parts: list[NDArray[np.int64]] = []
    count = 0
    for curve in surfaces:
        points.append(np.column_stack([curve.x, np.full(len(curve.x), curve.level), np.zeros(len(curve.x))]))
        places = count + np.arange(len(curve.x))
        cells.append(("line", np.column_stack([places[:-1], places[1:]])))
        parts.append(np.full(len(places) - 1, _CURVES[curve.kind]))
        count += len(places)
    for section in floats:
        points.append(np.column_stack([section.contour, np.zeros(len(section.contour))]))
        cells.append(("polygon", count + np.arange(len(section.contour))[None]))
        parts.append(np.array([_FLOAT]))
        count += len(section.contour)
    # Small files, of which there are many: compressing them takes longer than writing them.
    write_vtu(path, np.concatenate(points), cells, arrays, {"part": np.concatenate(parts)}, compressed=False)
