"""Values of functions along surfaces of a mesh, and on small triangles.

On a facet a function and the abscissa are polynomials of one parameter 0 ≤ t ≤ 1, known at the same Lagrange points;
where x(t) = x, also in cells with r = sᵐ, t follows by bisection.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any

import basix
import numpy as np
import xarray as xr
from dolfinx import fem
from mpi4py import MPI
from numpy.typing import NDArray

from hydroelastic.fem.cells import cell_corners, cell_jacobians, cell_positions, owned_cells
from hydroelastic.fem.core.liquid import Liquid

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

# Halvings of the unit interval down to rounding.
_HALVINGS = 54
# Ends of facets that miss an abscissa by less are there.
_ROUNDING = 1e-12
# A Jacobian below this part of the cell's largest is that of a corner r = sᵐ; the distance from its middle, of 1, at
# which the gradient is taken instead.
_FLAT, _NEAR = 1e-10, 0.95


def along_level(liquid: Liquid, functions: Sequence[fem.Function], name: str, layer: int, x: Array) -> Array:
    """Functions on the facets of a name at abscissas, shape (functions, points); NaN beside them (collective).

    Where a slit crosses the line, values are those of the side on which the other abscissas lie.

    Args:
        liquid: whose functions they are.
        functions: of its space.
        name: of facets on which x is monotonic.
        layer: index of the layer.
        x: abscissas, shape (points,).
    """
    trace = liquid.trace(name, layer)
    known = np.zeros((*trace.facets.shape, len(functions)))
    own = (trace.facets >= liquid.first) & (trace.facets < liquid.first + liquid.owned)
    for number, function in enumerate(functions):
        known[own, number] = function.x.array[trace.facets[own] - liquid.first]
    liquid.comm.Allreduce(MPI.IN_PLACE, known)
    abscissas = trace.points[..., 0]
    middles = abscissas.mean(axis=1)
    facet_of = np.full(len(x), -1)
    for facet in np.argsort((middles > x.min()) & (middles < x.max()), kind="stable"):
        left, right = abscissas[facet, [0, -1]]
        facet_of[(x >= left - _ROUNDING) & (x <= right + _ROUNDING)] = facet
    there = np.flatnonzero(facet_of >= 0)
    places = abscissas[facet_of[there]]
    low: Array = np.zeros(len(there))
    high: Array = np.ones(len(there))
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        below = np.einsum("pn,pn->p", _basis(places.shape[1] - 1, middle), places) < x[there]
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    found = np.full((len(functions), len(x)), np.nan)
    basis = _basis(places.shape[1] - 1, 0.5 * (low + high))
    found[:, there] = np.einsum("pn,pnm->mp", basis, known[facet_of[there]])
    return found


def tessellated(liquid: Liquid, functions: Sequence[fem.Function]) -> xr.Dataset | None:
    """Functions and their gradients on small triangles, on rank 0; ``None`` on others (collective).

    Each cell is divided for itself, a larger one more finely. At the corner of a cell r = sᵐ the gradient may be
    infinite: its value is that nearby.

    Returns:
        `position` (point, axis), `vertex` (triangle, corner), numbers of points, `liquid` (triangle), from 1,
        `potential` (mode, point) and `displacement` (mode, point, axis).
    """
    mesh = liquid.mesh.mesh
    cells = owned_cells(mesh)
    corners = cell_corners(mesh, cells)
    size = np.sqrt(np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])))
    largest = liquid.comm.allreduce(size.max(initial=0.0), op=MPI.MAX)
    parts = np.select([size > 0.25 * largest, size > 0.05 * largest, size > 0.01 * largest], [10, 6, 4], 2)
    pieces = [_tessellated(liquid, functions, cells[parts == count], int(count)) for count in np.unique(parts)]
    gathered = liquid.comm.gather(pieces, root=0)
    if gathered is None:
        return None
    points, triangles, layers, potential, gradient = zip(
        *(piece for process in gathered for piece in process), strict=True
    )
    offsets = np.cumsum([0, *map(len, points)])
    vertices = [own + offset for own, offset in zip(triangles, offsets[:-1], strict=True)]
    return xr.Dataset(
        {
            "position": (("point", "axis"), np.concatenate(points)),
            "vertex": (("triangle", "corner"), np.concatenate(vertices)),
            "liquid": ("triangle", 1 + np.concatenate(layers)),
            "potential": (("mode", "point"), np.concatenate(potential, axis=1)),
            "displacement": (("mode", "point", "axis"), np.concatenate(gradient, axis=1)),
        }
    )


def _tessellated(
    liquid: Liquid, functions: Sequence[fem.Function], cells: Indices, count: int
) -> tuple[Array, Indices, Indices, Array, Array]:
    """Cells divided into count² triangles."""
    mesh, element = liquid.mesh.mesh, liquid.space.element.basix_element
    i, j = (own.ravel() for own in np.meshgrid(*[np.arange(count + 1)] * 2, indexing="ij"))
    inside = i + j <= count
    i, j = i[inside], j[inside]
    reference = np.column_stack([i, j]) / count
    number = np.full((count + 2, count + 2), -1)
    number[i, j] = np.arange(len(i))
    upright = np.column_stack([number[i, j], number[i + 1, j], number[i, j + 1]])
    inverted = np.column_stack([number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]])
    triangles = np.concatenate([own[(own >= 0).all(axis=1)] for own in (upright, inverted)])
    dofs = liquid.space.dofmap.list[cells]
    values = np.array([function.x.array[dofs] for function in functions]).reshape(len(functions), *dofs.shape)
    potential = values @ element.tabulate(0, reference)[0, :, :, 0].T
    is_corner = np.isin(i, (0, count)) & np.isin(j, (0, count))
    gradients = []
    for points in (reference, np.where(is_corner[:, None], 1.0 / 3.0 + _NEAR * (reference - 1.0 / 3.0), reference)):
        slopes = np.stack([values @ own[:, :, 0].T for own in element.tabulate(1, points)[1:]], axis=-1)
        jacobians = np.broadcast_to(cell_jacobians(mesh, cells, points), (len(cells), len(points), 2, 2))
        areas = np.abs(np.linalg.det(jacobians))
        is_flat = areas <= _FLAT * areas.max(axis=1, initial=0.0, keepdims=True)
        inverses = np.linalg.inv(np.where(is_flat[..., None, None], np.eye(2), jacobians))
        gradients.append((np.einsum("mcpj,cpji->mcpi", slopes, inverses), is_flat))
    gradient = np.where(gradients[0][1][..., None], gradients[1][0], gradients[0][0])
    offsets = len(reference) * np.arange(len(cells))
    return (
        cell_positions(mesh, cells, reference).reshape(-1, 2),
        (offsets[:, None, None] + triangles).reshape(-1, 3),
        np.repeat(liquid.layer_of_cell[cells], len(triangles)),
        potential.reshape(len(functions), -1),
        gradient.reshape(len(functions), -1, 2),
    )


@cache
def _interval(degree: int) -> tuple[Any, Indices]:
    """Lagrange's element of an interval, and its points from left to right."""
    element = basix.create_element(
        basix.ElementFamily.P, basix.CellType.interval, degree, basix.LagrangeVariant.gll_warped
    )
    return element, np.argsort(element.points[:, 0])


def _basis(degree: int, t: Array) -> Array:
    element, order = _interval(degree)
    return np.asarray(element.tabulate(0, t[:, None])[0, :, order, 0].T)
