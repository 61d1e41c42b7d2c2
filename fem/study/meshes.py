"""Meshes of the uniform and algebraically graded series of a tank, in units of the tank."""

from __future__ import annotations

from dataclasses import replace
from math import inf

from hydroelastic.fem.closed.outline import zero_potential_surfaces
from hydroelastic.fem.study.singular_points import plain_outline, singular_exponents
from hydroelastic.fem.tank.mesh import geometry_of, is_plain
from hydroelastic.fem.tank.singularities import singular_points
from hydroelastic.meshes.nested import NestedMeshes, outline_meshes, rectangle_meshes
from hydroelastic.meshes.outline import GradedPoint
from hydroelastic.physics.tank import Tank

# Elements of the first mesh along levels and floats, in tank lengths: six on the half of a beam as long as half the
# tank.
_COARSEST = 0.125
# Excess of β over p/α of theory: the contribution of the first rings to the error then falls like (1/n)^{2α}. Measured:
# with 0.3 the order 4 of degree 2 is 3.7 on meshes on which it is 3.9 with 1.
_MARGIN = 1.0


def full_order(degree: int, exponent: float) -> float:
    """Return β > p/α, with which meshes have the full order 2p at a singular point ψ ~ r^α."""
    return max(1.0, degree / exponent) + _MARGIN


def full_order_gradings(tank: Tank, meshes: NestedMeshes, degree: int) -> tuple[float, ...]:
    """Return β of each graded point of the meshes, with which all have the full order."""
    exponents = singular_exponents(tank)
    return tuple(
        full_order(degree, exponents[graded.point]) if graded.point in exponents else 1.0
        for graded in meshes.graded_points
    )


def coarsest_size(tank: Tank) -> float:
    """Return the largest element of the first mesh along levels and floats, in tank lengths, at most the depth."""
    return min(_COARSEST, tank.depth)


def nested_meshes(tank: Tank, *, half: bool) -> NestedMeshes:
    """Return the nested meshes of a tank with straight boundaries, or of its left half."""
    size = coarsest_size(tank)
    # Far from the levels ψ is nearly constant.
    bulk_size = _COARSEST * max(1.0, *(layer.depth for layer in tank.layers))
    if is_plain(tank):
        return rectangle_meshes(geometry_of(tank, half=half), size=size, bulk_size=bulk_size)
    outline = plain_outline(tank, size, half=half)
    points = singular_points(
        outline, zero_potential=zero_potential_surfaces(tank, infinite_frequency=False), continuous_pressure=False
    )
    graded_points = tuple(
        GradedPoint(point=point.point, inner=inf, outer=min(point.grading_distance, 0.45 * tank.depth))
        for point in points
    )
    return outline_meshes(replace(outline, graded_points=graded_points), bulk_size=bulk_size)
