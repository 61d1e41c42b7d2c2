"""The tanks on scikit-fem: graded quadrilaterals of any degree, static condensation in NumPy, SciPy's factorization.

What was tried, and measured on one thread for ten modes of the tank base_s0 at an error near 1e-8. The first of each
is used:

- Element: `ElementQuadP` on quadrilaterals; `ElementTriP4`, its highest on triangles, on the same mesh cut in two and
  refined (five times the seconds at 1e-6, and its error falls more slowly).
- Local matrices: one product of arrays for each shape that an element has, for in the plane ∫∇ψ·∇q does not depend on
  its size; the same for all elements (twice to three times the seconds); `BilinearForm`, which calls Python for each
  pair of basis functions (four times).
- Matrix: unknowns inside of elements condensed; all unknowns in the factorization (1.6 times the seconds).
- Factorization: SuperLU of SciPy with the ordering for symmetric matrices. SciPy has no other.

Around each end of the beam lie nested half squares that shrink by a constant ratio. Each ring is four trapezoids (two
where the end lies at a wall), similar to those of the next ring, and all else is a grid of rectangles. Edges shared by
two elements run in the same direction in both, as elements of high degree without orientation tables need it.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import scipy.sparse
import scipy.sparse.linalg
import skfem
from skfem.element import ElementLinePp, ElementQuadP

from hydroelastic.benchmarks.tank_top import (
    MODES,
    RING_RATIO,
    Array,
    Resolution,
    Tank,
    dry_shapes,
    frequencies,
    resolution,
)

_GROWTH = 1.5
# Vertices between which the four edges of ElementQuadP run.
_EDGE_STARTS = np.array([0, 1, 3, 0])
_EDGE_ENDS = np.array([1, 2, 2, 3])


def tank(given: Tank, degree: int, halves: bool) -> tuple[Array, int]:
    """Return the ten lowest frequencies, from the mesh on, and the number of unknowns."""
    asked = resolution(given, degree, 0.5, 0.4, 2)
    length = given["length"] * (0.5 if halves else 1.0)
    nodes, quads = _graded_quads(length, given["depth"], (given["start"], given["start"] + given["beam_length"]), asked)
    mesh = skfem.MeshQuad(np.ascontiguousarray(nodes.T), np.ascontiguousarray(quads.T), validate=False)
    space, skeleton = _skeleton(mesh, degree)
    top, mass, water, loads = _surface(given, mesh, space, asked)
    constant = (top < mesh.nvertices).astype(float)
    found = []
    for half in ("even", "odd") if halves else ("",):
        free = np.ones(skeleton.shape[0], dtype=bool)
        if half == "odd":
            middle = np.flatnonzero((mesh.p[0][mesh.facets] == length).all(axis=0))
            free[mesh.facets[:, middle]] = False
            free[space.facet_dofs[:, middle]] = False
        else:
            free[np.argmin(mesh.p[1])] = False
        kept = np.flatnonzero(free[top])
        found.append(
            frequencies(
                *(given, half, mass[kept][:, kept], np.flatnonzero(np.isin(kept, water)), loads[kept], constant[kept]),
                _answer(skeleton, np.flatnonzero(free), top[kept]),
            )
        )
    return np.sort(np.concatenate(found))[:MODES], int(space.N) + len(water) + asked.shapes


def _answer(skeleton: Any, unknowns: Array, dofs: Array) -> Any:
    factor = scipy.sparse.linalg.splu(
        skeleton[unknowns][:, unknowns],
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
    places, load = np.searchsorted(unknowns, dofs), np.zeros(len(unknowns))

    def answer(values: Array) -> Array:
        load[places] = values
        return factor.solve(load)[places]

    return answer


def _skeleton(mesh: Any, degree: int) -> tuple[Any, Any]:
    """Unknowns, and ∫∇ψ·∇q with the unknowns inside of elements condensed; those come last."""
    corners = mesh.p[:, mesh.t]
    edges = corners - corners[:, :1]
    shapes = np.round((edges / np.hypot(*edges[:, 1])).transpose(2, 0, 1).reshape(mesh.nelements, -1), 9)
    _, examples, kinds = np.unique(shapes, axis=0, return_index=True, return_inverse=True)
    basis = skfem.CellBasis(mesh, ElementQuadP(degree), elements=examples, quadrature=_gauss_square(degree + 1))
    gradients = np.stack([np.asarray(field[0].grad) for field in basis.basis]).transpose(2, 0, 1, 3)
    flat = gradients.reshape(*gradients.shape[:2], -1)
    weighted = (gradients * basis.dx[:, None, None, :]).reshape(flat.shape)
    local = np.matmul(weighted, flat.transpose(0, 2, 1))
    count = 4 * degree
    outer, mixed, inner = local[:, :count, :count], local[:, count:, :count], local[:, count:, count:]
    condensed = (outer - np.matmul(mixed.transpose(0, 2, 1), np.linalg.solve(inner, mixed)))[kinds.ravel()]
    dofs = basis.dofs.element_dofs[:count].T
    size = int(dofs.max()) + 1
    rows, columns = np.repeat(dofs, count, axis=1).ravel(), np.tile(dofs, (1, count)).ravel()
    return basis.dofs, scipy.sparse.coo_matrix((condensed.ravel(), (rows, columns)), shape=(size, size)).tocsc()


def _gauss_square(count: int) -> tuple[Array, Array]:
    points, weights = _gauss(count)
    x, y = np.meshgrid(points, points, indexing="ij")
    return np.vstack([x.ravel(), y.ravel()]), np.outer(weights, weights).ravel()


def _gauss(count: int) -> tuple[Array, Array]:
    points, weights = np.polynomial.legendre.leggauss(count)
    return 0.5 * (points + 1.0), 0.5 * weights


def _surface(given: Tank, mesh: Any, space: Any, asked: Resolution) -> tuple[Array, Array, Array, Array]:
    """Unknowns of the top; and on them ∫φφ over the water, those of the water, ∫φW over the beam."""
    facets = np.flatnonzero((mesh.p[1][mesh.facets] == 0.0).all(axis=0))
    elements = mesh.f2t[0][facets]
    place = np.argmax(mesh.t2f[:, elements] == facets, axis=0)
    first, last = mesh.t[_EDGE_STARTS[place], elements], mesh.t[_EDGE_ENDS[place], elements]
    top, places = np.unique(np.vstack([first, last, space.facet_dofs[:, facets]]).T, return_inverse=True)
    dofs, size = places.reshape(len(facets), -1), len(top)
    starts, ends = mesh.p[0][first], mesh.p[0][last]
    points, weights = _gauss(asked.degree + 6)
    element = ElementLinePp(asked.degree)
    basis = np.stack([element.lbasis(points[None, :], number)[0] for number in range(asked.degree + 1)])
    s = (0.5 * (starts + ends) - given["start"]) / given["beam_length"]
    under = (s > 0.0) & (s < 1.0)
    lengths, wet = np.abs(ends - starts), dofs[~under]
    mass = ((basis * weights) @ basis.T) * lengths[~under][:, None, None]
    rows, columns = np.repeat(wet, wet.shape[1], axis=1).ravel(), np.tile(wet, (1, wet.shape[1])).ravel()
    along = (starts[under, None] + (ends - starts)[under, None] * points - given["start"]) / given["beam_length"]
    values = dry_shapes(asked.shapes, np.clip(along, 0.0, 1.0))
    loads = np.zeros((size, asked.shapes))
    np.add.at(loads, dofs[under], np.matmul(basis * weights, values.transpose(1, 2, 0)) * lengths[under][:, None, None])
    whole = scipy.sparse.coo_matrix((mass.ravel(), (rows, columns)), shape=(size, size)).tocsr()
    return top, whole, np.unique(wet), loads


def _graded_quads(length: float, depth: float, beam: tuple[float, float], asked: Resolution) -> tuple[Array, Array]:
    """Mesh 0 < x < length, −depth < y < 0: nodes, shape (nodes, 2), and their numbers by quadrilateral."""
    tips = [tip for tip in beam if tip <= length]
    distances = [abs(tip - other) for tip in tips for other in (0.0, length, *tips) if tip != other]
    width = min(0.5 * min(distances), 0.5 * depth, asked.water_size)
    cuts = np.unique(
        np.clip([0.0, length, *(tip + step for tip in tips for step in (-width, 0.0, width))], 0.0, length)
    )
    columns = np.unique(
        np.concatenate(
            [
                _between(left, right, width, asked.beam_size if beam[0] <= left < beam[1] else asked.water_size)
                for left, right in pairwise(cuts)
            ]
        )
    )
    rows = _downwards(width, depth, 3.0 * max(asked.water_size, asked.beam_size))
    corners = [
        [(left, low), (right, low), (right, high), (left, high)]
        for left, right in pairwise(columns)
        for number, (high, low) in enumerate(pairwise(rows))
        if number > 0 or all(abs(0.5 * (left + right) - tip) > width for tip in tips)
    ]
    for tip in tips:
        radii = width * RING_RATIO ** np.arange(asked.rings, -1, -1.0)
        if tip < length:
            corners += _right_rings(tip, radii)
        if tip > 0.0:
            corners += _left_rings(tip, radii)
    points = np.array(corners).reshape(-1, 2)
    _, first, quads = np.unique(np.round(points / width, 12), axis=0, return_index=True, return_inverse=True)
    return points[first], quads.reshape(-1, 4)


def _between(start: float, end: float, width: float, size: float) -> Array:
    """Columns from start to end: as wide as the rings at both ends, growing to the largest size in between."""
    places = np.linspace(start, end, 257)
    nearest = np.minimum(places - start, end - places)
    density = 1.0 / np.minimum(size, width + _GROWTH * nearest)
    passed = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]) * np.diff(places))])
    count = max(1, round(passed[-1]))
    columns: Array = np.interp(np.linspace(0.0, passed[-1], count + 1), passed, places)
    columns[[0, -1]] = start, end
    return columns


def _downwards(width: float, depth: float, size: float) -> Array:
    """Rows from the top to the bottom, the first as high as the rings."""
    heights = [width]
    while sum(heights) < depth:
        heights.append(min(size, (1.0 + _GROWTH) * heights[-1]))
    total = sum(heights[1:])
    scale = (depth - width) / total if total else 1.0
    rows: Array = -np.cumsum([0.0, heights[0], *(scale * height for height in heights[1:])])
    rows[-1] = -depth
    return rows


def _right_rings(tip: float, radii: Array) -> Array:
    inner = radii[0]
    corners = [[(tip, -inner), (tip + inner, -inner), (tip + inner, 0.0), (tip, 0.0)]]
    for a, b in pairwise(radii):
        corners.append([(tip + a, -a), (tip + b, -b), (tip + b, 0.0), (tip + a, 0.0)])
        corners.append([(tip, -a), (tip, -b), (tip + b, -b), (tip + a, -a)])
    return corners


def _left_rings(tip: float, radii: Array) -> Array:
    inner = radii[0]
    corners = [[(tip - inner, -inner), (tip, -inner), (tip, 0.0), (tip - inner, 0.0)]]
    for a, b in pairwise(radii):
        corners.append([(tip - a, -a), (tip - b, -b), (tip, -b), (tip, -a)])
        corners.append([(tip - a, -a), (tip - a, 0.0), (tip - b, 0.0), (tip - b, -b)])
    return corners
