"""Curved cells follow the exact curve to the order of their degree, conform, and are turned nowhere."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import pi, radians

import basix
import basix.ufl
import numpy as np
import pytest
from numpy.typing import NDArray
from outlines import FLOAT, LOWER, UPPER, Circle, circle_tank, thin_float_tank

from hydroelastic.meshes.build import build_mesh
from hydroelastic.meshes.geometry_nodes import geometry_nodes
from hydroelastic.meshes.nested import halved
from hydroelastic.meshes.outline import Curve, Outline, Region
from hydroelastic.meshes.tagged_mesh import MeshError, TaggedMesh

TURNS = [pi / 6.0, pi / 12.0, pi / 24.0]


def element(degree: int) -> basix.finite_element.FiniteElement:
    return basix.create_element(
        basix.ElementFamily.P, basix.CellType.triangle, degree, basix.LagrangeVariant.gll_warped
    )


def curved_determinants(mesh: TaggedMesh, order: int = 20) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Weights and the Jacobian's determinant at quadrature points of the curved cells, positive as meshed."""
    assert mesh.curved is not None
    points, weights = basix.make_quadrature(basix.CellType.triangle, order)
    _, by_x, by_y = element(mesh.curved.degree).tabulate(1, points)[..., 0]
    along, across = by_x @ mesh.curved.nodes, by_y @ mesh.curved.nodes
    return weights, across[..., 0] * along[..., 1] - across[..., 1] * along[..., 0]


def area(mesh: TaggedMesh, name: str) -> float:
    """Of one liquid, curved cells included."""
    a, b, c = (mesh.points[mesh.cells[:, corner]] for corner in range(3))
    areas = 0.5 * ((c - a)[:, 0] * (b - a)[:, 1] - (c - a)[:, 1] * (b - a)[:, 0])
    if mesh.curved is not None:
        weights, determinants = curved_determinants(mesh)
        areas[mesh.curved.cells] = determinants @ weights
    return float(areas[mesh.cell_tags == mesh.cell_names[name]].sum())


def series(circle: Circle, degree: int) -> list[TaggedMesh]:
    """Meshes without rings: the elements of an arc are alike, and errors have one order."""
    outline = circle_tank(circle)
    curves = tuple(replace(curve, size=0.2) if curve.path is None else curve for curve in outline.curves)
    outline = replace(outline, curves=curves, graded_points=())
    return [build_mesh(outline, bulk_size=0.2, geometry_degree=degree, largest_turn=turn) for turn in TURNS]


def fitted_order(meshes: list[TaggedMesh], values: list[float]) -> float:
    """Order of values in the length of the elements on the float, which are alike."""
    counts = [np.sum(mesh.facet_tags == mesh.facet_names[FLOAT]) for mesh in meshes]
    return -float(np.polyfit(np.log(counts), np.log(np.abs(values)), 1)[0])


def points_on_curved_edges(mesh: TaggedMesh, fractions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points of the polynomial edges on the float, at parts of the reference edge, shape (edges, points, 2)."""
    assert mesh.curved is not None
    on_float = {
        tuple(pair) for pair in np.sort(mesh.facets[mesh.facet_tags == mesh.facet_names[FLOAT]], axis=1).tolist()
    }
    corners = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    found = []
    for cell, nodes in zip(mesh.cells[mesh.curved.cells], mesh.curved.nodes, strict=True):
        for first, second in ((0, 1), (1, 2), (2, 0)):
            if tuple(sorted((int(cell[first]), int(cell[second])))) in on_float:
                reference = np.outer(1.0 - fractions, corners[first]) + np.outer(fractions, corners[second])
                found.append(element(mesh.curved.degree).tabulate(0, reference)[0, :, :, 0] @ nodes)
    return np.array(found)


@pytest.mark.slow_but("2")
@pytest.mark.parametrize("degree", [1, 2, 3])
def test_areas_converge_with_twice_the_degree(degree: int) -> None:
    """Gauss-Lobatto points integrate the area over a chord: its error falls like h^{2k}."""
    circle = Circle(contact_angle=radians(110))
    meshes, errors = series(circle, degree), []
    for mesh in meshes:
        errors.append(area(mesh, LOWER) - (0.4 - circle.immersed))
        assert area(mesh, UPPER) == pytest.approx(0.3 - circle.area + circle.immersed, abs=3.0 * abs(errors[-1]))
    assert fitted_order(meshes, errors) == pytest.approx(2 * degree, abs=0.1)
    # Measured at 15 degrees: 1.5e-4, 1.4e-7, 1.1e-10 of the area; doubled.
    assert abs(errors[1]) < {1: 3e-4, 2: 3e-7, 3: 3e-10}[degree]


@pytest.mark.slow_but("2-4")
@pytest.mark.parametrize(("degree", "order"), [(1, 2), (2, 4), (3, 4), (4, 6)])
def test_the_deviation_has_the_order_of_interpolation(degree: int, order: int) -> None:
    """k + 1, and one more for even k, since a circle is even over each chord; the normals lose one."""
    meshes = series(Circle(), degree)
    assert fitted_order(meshes, [mesh.deviation.distance for mesh in meshes]) == pytest.approx(order, abs=0.1)
    assert fitted_order(meshes, [mesh.deviation.angle for mesh in meshes]) == pytest.approx(order - 1, abs=0.1)


@pytest.mark.slow_but("3")
@pytest.mark.parametrize("degree", [2, 3, 5])
def test_the_deviation_is_that_of_the_curved_edges_from_the_circle(degree: int) -> None:
    circle = Circle()
    mesh = build_mesh(circle_tank(circle), bulk_size=0.2, geometry_degree=degree)
    edges = points_on_curved_edges(mesh, np.linspace(0.0, 1.0, 15))
    away = np.hypot(edges[..., 0] - circle.centre, edges[..., 1] - circle.height) - circle.radius
    # Both are sampled at some points: the largest values differ by little.
    assert mesh.deviation.distance == pytest.approx(np.abs(away).max(), rel=0.1)


@pytest.mark.slow_but("3")
@pytest.mark.parametrize("degree", [2, 3, 4, 5])
def test_nodes_of_curved_edges_lie_on_the_curve_and_corners_stay(degree: int) -> None:
    """An ellipse's elements are not even: edges passed the wrong way would miss it."""
    half_width, half_height = 0.1, 0.2
    mesh = build_mesh(stretched(half_width, half_height), bulk_size=0.2, geometry_degree=degree)
    assert mesh.curved is not None
    assert np.array_equal(mesh.curved.nodes[:, :3], mesh.points[mesh.cells[mesh.curved.cells]])
    nodes = basix.create_element(
        basix.ElementFamily.P, basix.CellType.interval, degree, basix.LagrangeVariant.gll_warped
    ).points[:, 0]
    edges = points_on_curved_edges(mesh, nodes)
    assert len(edges) == len(mesh.curved.cells)
    level = ((edges[..., 0] - 0.5) / half_width) ** 2 + (edges[..., 1] / half_height) ** 2
    # Rounding of coordinates of order one over a half width of 0.1.
    assert level == pytest.approx(np.ones(level.shape), abs=1e-13)


@pytest.mark.slow_but("2-20", "5-160")
@pytest.mark.parametrize("contact", [20, 60, 90, 120, 160])
@pytest.mark.parametrize("degree", [2, 5])
def test_curved_cells_are_turned_nowhere(contact: int, degree: int) -> None:
    mesh = build_mesh(circle_tank(Circle(contact_angle=radians(contact))), bulk_size=0.2, geometry_degree=degree)
    _, determinants = curved_determinants(mesh)
    assert determinants.min() > 0.0
    assert (determinants.min(axis=1) / determinants.max(axis=1)).min() > 0.05


def ellipse(half_width: float, half_height: float, first: float, last: float) -> Callable[..., NDArray[np.float64]]:
    def path(parameters: NDArray[np.float64]) -> NDArray[np.float64]:
        angles = first + (last - first) * parameters
        return np.column_stack([0.5 + half_width * np.cos(angles), half_height * np.sin(angles)])

    return path


def stretched(half_width: float, half_height: float) -> Outline:
    """The tank with a circle of radius 0.1, made an ellipse whose ends stay where they are, or moved to its width."""
    outline = circle_tank(Circle(radius=half_width))
    first, second = pi, 2.0 * pi
    curves = []
    for curve in outline.curves:
        if curve.name == FLOAT:
            below = curve.start[0] < curve.end[0]
            span = (first, second) if below else (0.0, pi)
            curve = replace(curve, path=ellipse(half_width, half_height, *span))
        curves.append(curve)
    return replace(outline, curves=tuple(curves))


@pytest.mark.slow_but("0.01-0.2")
@pytest.mark.parametrize(("half_width", "half_height"), [(0.1, 0.2), (0.01, 0.2), (0.2, 0.01)])
def test_slender_ellipses_have_their_area(half_width: float, half_height: float) -> None:
    """Ends with a radius of curvature of b²/a, down to 0.0005."""
    mesh = build_mesh(stretched(half_width, half_height), bulk_size=0.2, geometry_degree=5)
    missing = 0.7 - area(mesh, LOWER) - area(mesh, UPPER)
    # Of degree 10 in elements of 30 degrees; measured 2e-10 of the ellipse.
    assert missing == pytest.approx(pi * half_width * half_height, rel=1e-8)


def uneven(curve: Curve) -> Curve:
    """The same curve, passed slowly at first and quickly at last."""
    path = curve.path
    assert path is not None
    return replace(curve, path=lambda parameters: path(parameters**2 * (1.5 - 0.5 * parameters)))


def test_how_a_path_is_passed_does_not_matter() -> None:
    outline = circle_tank(Circle())
    other = replace(outline, curves=tuple(uneven(curve) if curve.path else curve for curve in outline.curves))
    first, second = (build_mesh(one, bulk_size=0.2, geometry_degree=4) for one in (outline, other))
    assert len(first.cells) == pytest.approx(len(second.cells), rel=0.05)
    assert second.deviation.distance == pytest.approx(first.deviation.distance, rel=0.3)
    assert area(second, LOWER) == pytest.approx(area(first, LOWER), rel=1e-9)


@pytest.mark.slow_but("3")
@pytest.mark.parametrize("degree", [2, 3, 4])
def test_neighbours_agree_on_the_nodes_that_they_share(degree: int) -> None:
    mesh = build_mesh(circle_tank(Circle()), bulk_size=0.2, geometry_degree=degree)
    points, cells, found = geometry_nodes(mesh)
    assert found == degree
    assert mesh.curved is not None
    straight = np.column_stack([1.0 - element(degree).points.sum(axis=1), element(degree).points])
    expected = straight @ mesh.points[mesh.cells]
    expected[mesh.curved.cells] = mesh.curved.nodes
    assert points[cells] == pytest.approx(expected, abs=2e-16)
    assert np.array_equal(points[: len(mesh.points)], mesh.points)
    # Nodes, edges and triangles of two discs, each liquid being one: Euler's formula.
    edges = len(mesh.points) + len(mesh.cells) - 2
    inner = (degree - 1) * (degree - 2) // 2
    assert len(points) == len(mesh.points) + (degree - 1) * edges + inner * len(mesh.cells)
    assert np.array_equal(np.unique(cells), np.arange(len(points)))


def test_straight_outlines_have_no_curved_cells() -> None:
    mesh = build_mesh(thin_float_tank(), bulk_size=0.2, geometry_degree=4)
    assert mesh.curved is None
    assert mesh.deviation.distance == mesh.deviation.angle == 0.0
    assert geometry_nodes(mesh)[2] == 1


def test_scaling_keeps_the_shape_of_curved_cells() -> None:
    mesh = build_mesh(circle_tank(Circle()), bulk_size=0.2, geometry_degree=3)
    scaled = mesh.scaled(10.0)
    assert mesh.curved is not None
    assert scaled.curved is not None
    assert np.array_equal(scaled.curved.nodes, 10.0 * mesh.curved.nodes)
    assert scaled.deviation.distance == 10.0 * mesh.deviation.distance
    assert scaled.deviation.angle == mesh.deviation.angle


def test_curved_meshes_are_not_halved() -> None:
    mesh = build_mesh(circle_tank(Circle()), bulk_size=0.2, geometry_degree=3)
    with pytest.raises(MeshError, match="not halved"):
        halved(mesh)


def test_an_inner_curve_that_is_not_cut_bends_the_cells_on_both_sides() -> None:
    """A square divided by a sine wave into halves."""
    a, b, c, d, e, f = (0.0, -0.5), (1.0, -0.5), (1.0, 0.0), (1.0, 0.5), (0.0, 0.5), (0.0, 0.0)
    sides = zip((a, b, c, d, e, f), (b, c, d, e, f, a), strict=True)
    wave = Curve(name="", start=f, end=c, path=lambda t: np.column_stack([t, 0.1 * np.sin(2.0 * pi * t)]), size=0.1)
    outline = Outline(
        curves=(*(Curve(name="wall", start=start, end=end) for start, end in sides), wave),
        regions=(
            Region(name=LOWER, loop=((0, True), (1, True), (6, False), (5, True))),
            Region(name=UPPER, loop=((6, True), (2, True), (3, True), (4, True))),
        ),
    )
    mesh = build_mesh(outline, bulk_size=0.2, geometry_degree=5)
    assert mesh.curved is not None
    tags = mesh.cell_tags[mesh.curved.cells]
    assert np.sum(tags == mesh.cell_names[LOWER]) == np.sum(tags == mesh.cell_names[UPPER]) > 8
    assert area(mesh, LOWER) == pytest.approx(0.5, rel=1e-9)
    # One node at each place of the wave, on either side the same.
    points, cells, _ = geometry_nodes(mesh)
    assert len(np.unique(np.round(points, 12), axis=0)) == len(points)
    assert points[cells[mesh.curved.cells]] == pytest.approx(mesh.curved.nodes, abs=2e-16)
