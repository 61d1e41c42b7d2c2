"""Curved cells at the circles of a plan: in bands with nodes at polar coordinates, beside them with one arc."""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.curved_cells import geometry_element, smallest_jacobian
from hydroelastic.meshes.plan_bands import Band
from hydroelastic.meshes.plan_loops import CircleLoop
from hydroelastic.meshes.tagged_mesh import CurvedCells, MeshError

# Smallest Jacobian of an accepted curved cell, relative to the straight cell.
_SMALLEST_JACOBIAN = 0.05


def curved_cells(
    points: NDArray[np.float64], cells: NDArray[np.int64], bands: list[Band], degree: int
) -> CurvedCells | None:
    """Return the geometry of the cells at circles; ``None`` where all cells are straight."""
    circles = [band for band in bands if isinstance(band.loop, CircleLoop)]
    if not circles:
        return None
    element = geometry_element(degree)
    barycentric = np.column_stack([1.0 - element.points.sum(axis=1), element.points])
    chosen, nodes = [], []
    for band in circles:
        loop = band.loop
        assert isinstance(loop, CircleLoop)
        columns = len(band.places)
        local = cells - band.first
        inside = (local >= 0) & (local < columns * len(band.distances))
        whole = np.flatnonzero(inside.all(axis=1))
        # A gmsh cell may have all corners on one circle; a band's have two rows.
        rows = local // columns
        in_band = whole[np.ptp(rows[whole], axis=1) == 1]
        angle = 2.0 * pi * band.places[local[in_band] % columns]
        angle = angle[:, :1] + (angle - angle[:, :1] + pi) % (2.0 * pi) - pi
        radius = loop.radius + band.distances[rows[in_band]]
        turned, away = angle @ barycentric.T, radius @ barycentric.T
        chosen.append(in_band)
        nodes.append(loop.centre + away[..., None] * np.stack([np.cos(turned), np.sin(turned)], axis=-1))
        beside = np.flatnonzero((inside.sum(axis=1) >= 2) & ~np.isin(np.arange(len(cells)), in_band))
        bent, moved = _beside_arcs(points, cells[beside], local[beside], inside[beside], band, barycentric, degree)
        chosen.append(beside[bent])
        nodes.append(moved[bent])
    # A cell that touches two circles keeps the displacement of each.
    straight = np.einsum("nb,cbd->cnd", barycentric, points[cells])
    total = straight.copy()
    for some, places in zip(chosen, nodes, strict=True):
        np.add.at(total, some, places - straight[some])
    bent_cells = np.unique(np.concatenate(chosen))
    found = CurvedCells(degree=degree, cells=bent_cells, nodes=total[bent_cells])
    if smallest_jacobian(found) < _SMALLEST_JACOBIAN:
        raise MeshError("a cell at a circle is too narrow to follow it: ask for smaller elements there")
    return found


def _beside_arcs(
    points: NDArray[np.float64],
    cells: NDArray[np.int64],
    local: NDArray[np.int64],
    inside: NDArray[np.bool_],
    band: Band,
    barycentric: NDArray[np.float64],
    degree: int,
) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Nodes of cells with an edge on the outermost or innermost circle of a band; see `curved_cells`."""
    columns = len(band.places)
    element = geometry_element(degree)
    inner = np.asarray(element.points[np.array(element.entity_dofs[1][2], dtype=np.int64), 0])
    nodes = np.einsum("nb,cbd->cnd", barycentric, points[cells])
    bent = np.full(len(cells), False)
    for start, end in ((0, 1), (1, 2), (2, 0)):
        row, column = local[:, [start, end]] // columns, local[:, [start, end]] % columns
        step = np.abs(column[:, 1] - column[:, 0])
        along = (step == 1) | (band.closed & (step == columns - 1))
        here = inside[:, start] & inside[:, end] & (row[:, 0] == row[:, 1]) & along
        first, second = points[cells[here, start]], points[cells[here, end]]
        angles = 2.0 * pi * band.places[column[here]]
        sweep = (angles[:, 1] - angles[:, 0] + pi) % (2.0 * pi) - pi
        turned = angles[:, :1] + sweep[:, None] * inner
        radius = np.linalg.norm(first - band.loop.centre, axis=1)[:, None]  # type: ignore[union-attr]
        arc = band.loop.centre + radius[..., None] * np.stack([np.cos(turned), np.sin(turned)], axis=-1)  # type: ignore[union-attr]
        away = arc - first[:, None] - inner[None, :, None] * (second - first)[:, None]
        values = away / (inner * (1.0 - inner))[None, :, None]
        fit = np.linalg.inv(np.polynomial.chebyshev.chebvander(2.0 * inner - 1.0, len(inner) - 1))
        across = np.polynomial.chebyshev.chebvander(barycentric[:, end] - barycentric[:, start], len(inner) - 1)
        weight = (barycentric[:, start] * barycentric[:, end])[:, None] * (across @ fit)
        nodes[here] += np.einsum("nk,ckd->cnd", weight, values)
        bent |= here
    return bent, nodes
