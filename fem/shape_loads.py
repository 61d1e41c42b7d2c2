"""Loads ∫φᵢ q of a body's shapes, and ∫q, on the potential, by quadrature on the facets of a surface.

The shapes are given as functions, not in the potential's space: high dry modes oscillate within an element, and a load
that is not integrated exactly costs the Ritz property that eigenvalues come from above. The number of points therefore
follows the shortest wave among the shapes.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import ceil

import basix
import numpy as np

from hydroelastic.fem.facets import FacetGroup, facet_groups
from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.fem.surfaces import Body

# Gauss points beyond what the polynomial and half a radian each need; the error then falls faster than exponentially.
_SPARE_POINTS = 8
# Relative to the facet's length: corners of curved cells may miss a point by rounding.
_AT_CORNER = 1e-3


def shape_loads(liquid: LiquidSpace, body: Body) -> np.ndarray:
    """Integrate every shape of a body against every basis function of ψ."""
    (loads,) = loads_with_fluxes(liquid, (body,))
    return loads[:-1]


def loads_with_fluxes(liquid: LiquidSpace, bodies: Sequence[Body]) -> list[np.ndarray]:
    """Return `shape_loads` of bodies that have one wetted surface in common, as the symmetric and the antisymmetric
    shapes of one have, each with ∫q in a last row, as by `surface_load`; facets are gone through once (collective)."""
    first = bodies[0]
    wavenumber = max(body.wavenumber for body in bodies)
    sizes = [body.size for body in bodies]
    loads = np.zeros((sum(sizes) + 1, len(liquid.layer_of)))
    pieces = [
        (own, facet_quadrature(liquid, own, wavenumber, int(corner)))
        for group in facet_groups(liquid, first.surface)
        for corner, own in _by_corner(first, group)
    ]
    if pieces:
        # The shapes are evaluated once for all facets.
        points, normals = (
            np.concatenate(part, axis=1) for part in zip(*((one.points, one.normals) for _, one in pieces), strict=True)
        )
        values = np.vstack([*(body.shapes(points, normals) for body in bodies), np.ones((1, points.shape[1]))])
        stops = np.cumsum([quadrature.points.shape[1] for _, quadrature in pieces])[:-1]
        for (group, quadrature), own in zip(pieces, np.split(values, stops, axis=1), strict=True):
            # Others vanish on the facet.
            places = liquid.facet_dofs(group.place)
            basis = potential_basis(liquid, quadrature.reference)[:, places]
            parts = quadrature.weights * own.reshape(-1, *quadrature.weights.shape) @ basis
            np.add.at(loads.T, liquid.space.dofmap.list[group.cells][:, places], parts.transpose(1, 2, 0))
    *of_bodies, flux = np.split(liquid.numbering.summed(loads), np.cumsum(sizes))
    return [np.vstack([own, flux]) for own in of_bodies]


def _by_corner(body: Body, group: FacetGroup) -> Iterator[tuple[int, FacetGroup]]:
    """The facets of a group by the number of their corner at which shapes are singular, or −1."""
    at_corner = singular_corner(body, group)
    for corner in np.unique(at_corner):
        yield int(corner), group.subset(at_corner == corner)


def surface_load(liquid: LiquidSpace, names: tuple[str, ...]) -> np.ndarray:
    """Integrate every basis function of ψ over named surfaces."""
    load = np.zeros((1, len(liquid.layer_of)))
    for name in names:
        for group in facet_groups(liquid, name):
            local, weights = basix.make_quadrature(group.facet_type, 2 * liquid.degree)
            reference = group.reference_points(local)
            _, measures = group.normals(reference)
            dofs = liquid.space.dofmap.list[group.cells]
            weights = weights * liquid.geometry.weight(group.physical_points(reference)[..., 0])
            np.add.at(load[0], dofs, (measures * weights) @ potential_basis(liquid, reference))
    total: np.ndarray = liquid.numbering.summed(load)[0]
    return total


def potential_basis(liquid: LiquidSpace, reference: np.ndarray) -> np.ndarray:
    """Basis functions of ψ at points of the reference cell, shape (points, functions)."""
    table: np.ndarray = liquid.space.element.basix_element.tabulate(0, reference)[0, :, :, 0]
    return table


def singular_corner(body: Body, group: FacetGroup) -> np.ndarray:
    """Number of the corner of each facet at which the shapes of a body have no bounded slope, or −1."""
    found = np.full(len(group.cells), -1)
    if body.singular_points is not None:
        corners = group.physical_points(group.reference_corners)
        length = np.linalg.norm(corners[:, 1:] - corners[:, :1], axis=2).max(axis=1)
        for number in range(corners.shape[1]):
            away = np.linalg.norm(corners[:, number, None] - body.singular_points, axis=2).min(axis=1)
            found[away < _AT_CORNER * length] = number
    return found


def _clustered(local: np.ndarray, weights: np.ndarray, corner: int) -> tuple[np.ndarray, np.ndarray]:
    """Quadrature on a line by t = s² from one of its ends: integrands like t^{-1/2} there become smooth."""
    s = local[:, 0] if corner == 0 else 1.0 - local[:, 0]
    t = s**2 if corner == 0 else 1.0 - s**2
    return t[:, None], 2.0 * s * weights


@dataclass(frozen=True, kw_only=True)
class FacetQuadrature:
    """Quadrature on facets of a body.

    Attributes:
        reference: points on the reference cell, shape (points, dim).
        points: the same on each facet, in the unit of the mesh, shape (gdim, facets × points).
        normals: outward unit normals of the liquid there, of the same shape.
        weights: quadrature weights times the measure of the facets, in the unit of the mesh, and the weight of the
            geometry, shape (facets, points).
    """

    reference: np.ndarray
    points: np.ndarray
    normals: np.ndarray
    weights: np.ndarray


def facet_quadrature(
    liquid: LiquidSpace, group: FacetGroup, wavenumber: float, singular_corner: int
) -> FacetQuadrature:
    """Quadrature for functions of a wavenumber times polynomials of ψ's degree."""
    count = ceil(0.5 * liquid.degree + 0.5 * wavenumber * group.longest) + _SPARE_POINTS
    if singular_corner >= 0:
        # In s the basis has twice the degree.
        count += liquid.degree
    local, weights = basix.make_quadrature(group.facet_type, 2 * count - 1)
    if singular_corner >= 0:
        local, weights = _clustered(local, weights, singular_corner)
    reference = group.reference_points(local)
    points = group.physical_points(reference)
    normals, measures = group.normals(reference)
    normals = np.broadcast_to(normals, points.shape)
    return FacetQuadrature(
        reference=reference,
        points=points.reshape(-1, points.shape[-1]).T,
        normals=normals.reshape(-1, points.shape[-1]).T,
        weights=measures * weights * liquid.geometry.weight(points[..., 0]),
    )
