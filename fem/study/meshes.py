"""The meshes of the uniform and algebraic series of a tank, in its own units."""

from __future__ import annotations

from dataclasses import replace
from math import inf

from hydroelastic.fem.study.corners import corner_exponents, plain_outline
from hydroelastic.fem.tank.mesh import geometry_of, is_plain
from hydroelastic.fem.tank.outline import grounded_names
from hydroelastic.fem.tank.singularities import singular_points
from hydroelastic.meshes.nested import NestedMeshes, outline_meshes, rectangle_meshes
from hydroelastic.meshes.outline import Corner
from hydroelastic.physics.tank import Tank

# Elements of the first mesh along levels and floats, in tank lengths: six on the half of a beam as long as half the
# tank.
_COARSEST = 0.125
# How far β exceeds the p/α of theory: what is left of the first rings in the error then falls like (1/n)^{2α}.
# Measured: with 0.3 instead the order 4 of degree 2 still is 3.7 on the meshes where it is 3.9.
_MARGIN = 1.0


def full_order(degree: int, exponent: float) -> float:
    """β > p/α that brings the full order 2p at a corner where ψ ~ r^α."""
    return max(1.0, degree / exponent) + _MARGIN


def full_order_gradings(tank: Tank, meshes: NestedMeshes, degree: int) -> tuple[float, ...]:
    """β of each corner of the meshes, so that all of them keep the full order."""
    exponents = corner_exponents(tank)
    return tuple(
        full_order(degree, exponents[corner.point]) if corner.point in exponents else 1.0 for corner in meshes.corners
    )


def coarsest_size(tank: Tank) -> float:
    """Largest element of the first mesh along levels and floats: that of a thin layer is no longer than it is deep."""
    return min(_COARSEST, tank.depth)


def nested_meshes(tank: Tank, *, half: bool) -> NestedMeshes:
    """The meshes of a tank with straight boundaries, or of its left half."""
    size = coarsest_size(tank)
    # Far from the levels nothing moves.
    bulk_size = _COARSEST * max(1.0, *(layer.depth for layer in tank.layers))
    if is_plain(tank):
        return rectangle_meshes(geometry_of(tank, half=half), size=size, bulk_size=bulk_size)
    outline = plain_outline(tank, size, half=half)
    points = singular_points(
        outline, grounded=grounded_names(tank, infinite_frequency=False), continuous_pressure=False
    )
    corners = tuple(Corner(point=point.point, inner=inf, outer=min(point.reach, 0.45 * tank.depth)) for point in points)
    return outline_meshes(replace(outline, corners=corners), bulk_size=bulk_size)
