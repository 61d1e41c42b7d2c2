"""Loads ∫φᵢ q of a body's shapes, and ∫q, on the potential, by quadrature on the facets of a surface.

The shapes are given as functions, not in the potential's space: high dry modes oscillate within an element, and a load
that is not integrated exactly costs the Ritz property that eigenvalues come from above. The number of points therefore
follows the shortest wave among the shapes.
"""

from __future__ import annotations

from math import ceil

import basix
import numpy as np
from dolfinx import la

from hydroelastic.fem.facets import FacetGroup, facet_groups
from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.fem.surfaces import Body

# Gauss points beyond what the polynomial and half a radian each need; the error then falls faster than exponentially.
_SPARE_POINTS = 8


def shape_loads(liquid: LiquidSpace, body: Body) -> np.ndarray:
    """Integrate every shape of a body against every basis function of ψ.

    Args:
        liquid: space of ψ on straight simplices.
        body: the body.

    Returns:
        ∫φᵢ q, owned entries, shape (functions, owned unknowns) (collective).
    """
    index_map = liquid.space.dofmap.index_map
    loads = np.zeros((body.size, index_map.size_local + index_map.num_ghosts))
    for group in facet_groups(liquid, body.surface):
        _add_loads(liquid, body, group, loads)
    return _summed_over_processes(liquid, loads)


def surface_load(liquid: LiquidSpace, names: tuple[str, ...]) -> np.ndarray:
    """Integrate every basis function of ψ over named surfaces.

    Returns:
        ∫q, owned entries (collective).
    """
    index_map = liquid.space.dofmap.index_map
    load = np.zeros((1, index_map.size_local + index_map.num_ghosts))
    for name in names:
        for group in facet_groups(liquid, name):
            local, weights = basix.make_quadrature(group.facet_type, liquid.degree)
            basis = _basis(liquid, group.reference_points(local))
            dofs = liquid.space.dofmap.list[group.cells]
            np.add.at(load[0], dofs, _measure_ratio(group.edges())[:, None] * (weights @ basis))
    total: np.ndarray = _summed_over_processes(liquid, load)[0]
    return total


def _measure_ratio(edges: np.ndarray) -> np.ndarray:
    """Measure of each facet over that of the reference facet."""
    ratio: np.ndarray = np.sqrt(np.linalg.det(np.einsum("fid,fjd->fij", edges, edges)))
    return ratio


def _basis(liquid: LiquidSpace, reference: np.ndarray) -> np.ndarray:
    """Basis functions of ψ at points of the reference cell, shape (points, functions)."""
    table: np.ndarray = liquid.space.element.basix_element.tabulate(0, reference)[0, :, :, 0]
    return table


def _add_loads(liquid: LiquidSpace, body: Body, group: FacetGroup, loads: np.ndarray) -> None:
    edges = group.edges()
    scale = _measure_ratio(edges)
    radians = body.wavenumber * np.linalg.norm(edges, axis=2).max(initial=0.0)
    count = ceil(0.5 * liquid.degree + 0.5 * radians) + _SPARE_POINTS
    local, weights = basix.make_quadrature(group.facet_type, 2 * count - 1)
    reference = group.reference_points(local)
    basis = _basis(liquid, reference)
    points = group.physical_points(reference).reshape(-1, edges.shape[2])
    # dolfinx hands three coordinates to functions of a point, whatever the dimension.
    padded = np.zeros((3, len(points)))
    padded[: points.shape[1]] = points.T
    dofs = liquid.space.dofmap.list[group.cells]
    for number in range(body.size):
        values = body.shapes(padded, number).reshape(len(group.cells), -1)
        np.add.at(loads[number], dofs, (scale[:, None] * values * weights) @ basis)


def _summed_over_processes(liquid: LiquidSpace, loads: np.ndarray) -> np.ndarray:
    index_map = liquid.space.dofmap.index_map
    vector = la.vector(index_map)
    owned = np.empty((len(loads), index_map.size_local))
    for number, load in enumerate(loads):
        vector.array[:] = load
        vector.scatter_reverse(la.InsertMode.add)
        owned[number] = vector.array[: index_map.size_local]
    return owned
