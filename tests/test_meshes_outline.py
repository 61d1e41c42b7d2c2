"""Meshes of several liquids with bodies: exact regions and groups, cut open where asked, graded, curved."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf, pi, radians

import basix
import basix.ufl
import gmsh
import numpy as np
import pytest
from numpy.typing import NDArray
from outlines import (
    FLOAT,
    INTERFACE,
    LOWER,
    UPPER,
    Circle,
    circle_tank,
    polygon,
    surface_slit,
    thin_float_tank,
    two_liquids,
)
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from hydroelastic.meshes.build import build_mesh
from hydroelastic.meshes.curve_nodes import straight_elements
from hydroelastic.meshes.distribute import geometry_nodes
from hydroelastic.meshes.edges import edges_of
from hydroelastic.meshes.geometry import BOTTOM, LEFT_WALL, LID, RIGHT_WALL, SYMMETRY_PLANE
from hydroelastic.meshes.outline import Curve, Outline, Point, Region
from hydroelastic.meshes.size_field import SizeField
from hydroelastic.meshes.tagged_mesh import TaggedMesh

BEAM = "body_1"

RATIO = 0.3

TIP = 1e-6

# A body with legs and a notched top: reentrant and other corners on either side of the interface.
LEGS: list[Point] = [
    (0.4, 0.0),
    (0.4, -0.1),
    (0.45, -0.1),
    (0.45, -0.03),
    (0.55, -0.03),
    (0.55, -0.1),
    (0.6, -0.1),
    (0.6, 0.0),
]

ROOF: list[Point] = [(0.6, 0.0), (0.6, 0.1), (0.5, 0.02), (0.4, 0.1), (0.4, 0.0)]

LEGS_AREA, ROOF_AREA = 0.2 * 0.1 - 0.1 * 0.07, 0.2 * 0.1 - 0.5 * 0.2 * 0.08


@dataclass(frozen=True)
class Case:
    """An outline of straight sides and what its mesh must be.

    The smallest angle is that of rings of ratio r = 0.3 in sectors of angle a, atan(r sin a/(1 - r cos a)): 17 degrees
    for 60, 15 for 45; less where a layer is thin or a notch narrow. Measured, less a degree or a quarter.
    """

    outline: Outline
    areas: dict[str, float]
    lengths: dict[str, float]
    smallest_angle: float = 14.0
    parts: int = 2


def walls(lower: float = 0.4, upper: float = 0.3) -> dict[str, float]:
    return {BOTTOM: 1.0, LID: 1.0, LEFT_WALL: lower + upper, RIGHT_WALL: lower + upper}


BEAM_PIECES = [(0.3, INTERFACE), (0.7, BEAM), (1.0, INTERFACE)]

ENDS = ((0.3, 0.0), (0.7, 0.0))

# Both sides of what is cut open count.
CASES = {
    "two liquids": Case(
        two_liquids(left=[(1.0, INTERFACE)]), {LOWER: 0.4, UPPER: 0.3}, {INTERFACE: 2.0} | walls(), smallest_angle=24.0
    ),
    "beam": Case(
        two_liquids(left=BEAM_PIECES, rings=ENDS), {LOWER: 0.4, UPPER: 0.3}, {INTERFACE: 1.2, BEAM: 0.8} | walls()
    ),
    "beam at the wall": Case(
        two_liquids(left=[(0.4, BEAM), (1.0, INTERFACE)], rings=((0.0, 0.0), (0.4, 0.0))),
        {LOWER: 0.4, UPPER: 0.3},
        {INTERFACE: 1.2, BEAM: 0.8} | walls(),
    ),
    "thin upper layer": Case(
        two_liquids(left=BEAM_PIECES, rings=ENDS, depths=(0.4, 0.01), size=0.02),
        {LOWER: 0.4, UPPER: 0.01},
        {INTERFACE: 1.2, BEAM: 0.8} | walls(0.4, 0.01),
        smallest_angle=11.0,
    ),
    "two thin layers": Case(
        two_liquids(left=BEAM_PIECES, rings=ENDS, depths=(0.01, 0.01), size=0.1),
        {LOWER: 0.01, UPPER: 0.01},
        {INTERFACE: 1.2, BEAM: 0.8} | walls(0.01, 0.01),
        smallest_angle=3.0,
    ),
    "polygon": Case(
        two_liquids(
            polygon(LEGS, ROOF),
            left=[(0.4, INTERFACE)],
            right=[(1.0, INTERFACE)],
            rings=(*LEGS, *ROOF[1:-1]),
        ),
        {LOWER: 0.4 - LEGS_AREA, UPPER: 0.3 - ROOF_AREA},
        {INTERFACE: 1.6, FLOAT: 0.54 + 0.2 + 2 * np.hypot(0.1, 0.08)} | walls(),
    ),
    "thin float": Case(thin_float_tank(), {LOWER: 0.4, UPPER: 0.3}, {INTERFACE: 2.0, FLOAT: 0.8} | walls()),
    "slit under a surface": Case(
        surface_slit(),
        {LOWER: 0.4},
        {"surface": 1.0, FLOAT: 0.4, BOTTOM: 1.0, LEFT_WALL: 0.4, RIGHT_WALL: 0.4},
        parts=1,
    ),
}


@pytest.fixture(scope="module", params=CASES)
def meshed(request: pytest.FixtureRequest) -> tuple[Case, TaggedMesh]:
    case = CASES[request.param]
    return case, build_mesh(case.outline, bulk_size=0.2, ring_ratio=RATIO)


def signed_areas(mesh: TaggedMesh) -> np.ndarray:
    a, b, c = (mesh.points[mesh.cells[:, corner]] for corner in range(3))
    areas: np.ndarray = 0.5 * ((c - a)[:, 0] * (b - a)[:, 1] - (c - a)[:, 1] * (b - a)[:, 0])
    return areas


def smallest_angle(mesh: TaggedMesh) -> float:
    """In degrees."""
    corners = mesh.points[mesh.cells]
    smallest = 180.0
    for corner in range(3):
        one, other = (corners[:, (corner + step) % 3] - corners[:, corner] for step in (1, 2))
        cosine = (one * other).sum(axis=1) / np.linalg.norm(one, axis=1) / np.linalg.norm(other, axis=1)
        smallest = min(smallest, float(np.degrees(np.arccos(cosine.max()))))
    return smallest


def cells_by_edge(mesh: TaggedMesh) -> tuple[np.ndarray, np.ndarray]:
    """The nodes of each edge and how many cells have it."""
    edges = edges_of(mesh.cells)
    return edges.nodes, np.bincount(edges.places.ravel())


def parts(mesh: TaggedMesh) -> np.ndarray:
    """Which part of the mesh each cell is in, cells hanging together through edges."""
    edges = edges_of(mesh.cells)
    cells = np.repeat(np.arange(len(mesh.cells)), 3)
    table = coo_array((np.ones(len(cells)), (cells, edges.places.ravel()))).tocsr()
    _, part = connected_components(table @ table.T, directed=False)
    return np.asarray(part)


def nodes_at(mesh: TaggedMesh, x: float, y: float) -> int:
    return int((mesh.points == [x, y]).all(axis=1).sum())


def test_regions_have_their_exact_area_and_all_triangles_turn_one_way(meshed: tuple[Case, TaggedMesh]) -> None:
    case, mesh = meshed
    areas = signed_areas(mesh)
    assert areas.min() > 0.0
    assert set(mesh.cell_names) == set(case.areas)
    for name, area in case.areas.items():
        # A sum of some thousand numbers, each right to a few units of its last place.
        assert areas[mesh.cell_tags == mesh.cell_names[name]].sum() == pytest.approx(area, rel=1e-13), name


def test_groups_have_their_exact_length_on_both_sides(meshed: tuple[Case, TaggedMesh]) -> None:
    case, mesh = meshed
    assert {name: mesh.facet_measure(name) for name in mesh.facet_names} == pytest.approx(case.lengths, rel=1e-12)


def test_edges_of_one_cell_are_the_facets_and_all_others_join_two(meshed: tuple[Case, TaggedMesh]) -> None:
    _, mesh = meshed
    nodes, cells = cells_by_edge(mesh)
    assert set(cells) == {1, 2}
    assert Counter(map(tuple, nodes[cells == 1].tolist())) == Counter(map(tuple, np.sort(mesh.facets, axis=1).tolist()))


def test_liquids_hang_together_and_are_apart_from_one_another(meshed: tuple[Case, TaggedMesh]) -> None:
    case, mesh = meshed
    part = parts(mesh)
    assert len(set(zip(part.tolist(), mesh.cell_tags.tolist(), strict=True))) == len(set(part)) == case.parts
    shared = set(mesh.cells[part == 0].ravel()) & set(mesh.cells[part != 0].ravel())
    assert not shared


def test_every_node_is_used_and_doubled_only_on_what_is_cut(meshed: tuple[Case, TaggedMesh]) -> None:
    case, mesh = meshed
    assert np.array_equal(np.unique(mesh.cells), np.arange(len(mesh.points)))
    cut = {curve.name for curve in case.outline.curves if curve.cut}
    on_cut = {tuple(point) for name in cut for point in mesh.facet_nodes(name).tolist()}
    copies = Counter(map(tuple, mesh.points.tolist()))
    assert {point for point, count in copies.items() if count > 1} <= on_cut


def test_triangles_are_well_shaped(meshed: tuple[Case, TaggedMesh]) -> None:
    case, mesh = meshed
    assert smallest_angle(mesh) > case.smallest_angle


def test_rings_shrink_by_one_ratio_to_the_size_asked_on_every_curve(meshed: tuple[Case, TaggedMesh]) -> None:
    case, mesh = meshed
    for graded in case.outline.graded_points:
        for curve in case.outline.curves:
            if graded.point in (curve.start, curve.end):
                other = np.array(curve.end if graded.point == curve.start else curve.start)
                away = np.unique(mesh.points, axis=0) - graded.point
                direction = (other - graded.point) / np.linalg.norm(other - graded.point)
                across = np.abs(away @ [-direction[1], direction[0]])
                along = away @ direction
                # Next to abscissae of order one distances of 1e-6 keep ten digits.
                rings = np.sort(along[(across < 1e-15) & (along > 0.0) & (along < 1e-3)])
                assert len(rings) > 2
                assert rings[0] <= TIP
                assert rings[1:] / rings[:-1] == pytest.approx(np.full(len(rings) - 1, 1.0 / RATIO), rel=1e-8)


def test_the_tips_of_a_slit_are_single_and_its_crossing_fourfold() -> None:
    mesh = build_mesh(thin_float_tank(height=0.2, position=0.4), bulk_size=0.2)
    assert nodes_at(mesh, 0.4, -0.2) == nodes_at(mesh, 0.4, 0.2) == 1
    assert nodes_at(mesh, 0.4, 0.0) == 4
    on_slit = mesh.points[(mesh.points[:, 0] == 0.4) & (mesh.points[:, 1] != 0.0)]
    places, copies = np.unique(on_slit, axis=0, return_counts=True)
    inside = np.abs(places[:, 1]) < 0.2
    assert np.all(copies[inside] == 2)
    assert np.all(copies[~inside] == 1)


@pytest.mark.parametrize(("point", "angle"), [((0.4, -0.1), 270), ((0.45, -0.03), 90), ((0.6, 0.0), 180)])
def test_sectors_at_corners_are_the_fewest_of_at_most_60_degrees(point: Point, angle: int) -> None:
    mesh = build_mesh(CASES["polygon"].outline, bulk_size=0.2)
    nodes = np.flatnonzero((mesh.points == point).all(axis=1))
    fans = sorted(int((mesh.cells == node).any(axis=1).sum()) for node in nodes)
    # Both liquids meet at the contact point, 90 degrees each.
    assert fans == {270: [5], 90: [2], 180: [2, 2]}[angle]


@pytest.mark.slow_but("False-20", "True-160")
@pytest.mark.parametrize("contact", [20, 45, 70, 90, 120, 160])
@pytest.mark.parametrize("half", [False, True])
def test_a_float_with_any_contact_angle_is_meshed_with_its_areas(contact: int, half: bool) -> None:
    circle = Circle(contact_angle=radians(contact))
    outline = circle_tank(circle, half=half)
    mesh = build_mesh(outline, bulk_size=0.2)
    # Polygons in the circle: an element that turns by θ leaves out (θ - sin θ)/2 R² < θ³/12 R², θ <= 30 degrees.
    missing = circle.radius**2 * 2 * pi * (pi / 6.0) ** 2 / 12.0
    part = 0.5 if half else 1.0
    for name, whole, inside in ((LOWER, 0.4, circle.immersed), (UPPER, 0.3, circle.area - circle.immersed)):
        area = signed_areas(mesh)[mesh.cell_tags == mesh.cell_names[name]].sum()
        assert 0.0 < area - part * (whole - inside) < part * missing
    # A wedge of 20 degrees is one sector; its rings have triangles of atan(r sin a/(1 - r cos a)) = 8.1 degrees.
    assert smallest_angle(mesh) > (7.5 if contact in (20, 160) else 10.0)
    assert (SYMMETRY_PLANE in mesh.facet_names) == half
    assert (RIGHT_WALL in mesh.facet_names) == (not half)


def test_nodes_of_rings_on_an_arc_lie_on_it_at_their_distance_from_the_corner() -> None:
    circle = Circle(contact_angle=radians(70))
    mesh = build_mesh(circle_tank(circle), bulk_size=0.2)
    nodes = np.unique(mesh.facet_nodes(FLOAT), axis=0)
    assert np.hypot(nodes[:, 0] - circle.centre, nodes[:, 1] - circle.height) == pytest.approx(
        np.full(len(nodes), circle.radius), rel=1e-14
    )
    away = nodes - circle.contacts[0]
    for side in (-1.0, 1.0):
        distances = np.sort(np.hypot(*away[side * away[:, 1] > 0.0].T))
        rings = distances[distances < 1e-3]
        assert len(rings) > 3
        assert rings[1:] / rings[:-1] == pytest.approx(np.full(len(rings) - 1, 1.0 / RATIO), rel=1e-8)


@pytest.mark.slow_but("lid-0.0001", "wall-0.01")
@pytest.mark.parametrize("gap", [1e-2, 1e-3, 1e-4])
@pytest.mark.parametrize("where", ["lid", "wall"])
def test_a_float_close_to_a_wall_is_meshed(gap: float, where: str) -> None:
    circle = Circle() if where == "lid" else Circle(centre=0.1 + gap)
    depths = (0.4, 0.1 + gap) if where == "lid" else (0.4, 0.3)
    mesh = build_mesh(circle_tank(circle, depths=depths), bulk_size=0.2, geometry_degree=4)
    assert signed_areas(mesh).min() > 0.0


def test_the_same_outline_gives_the_same_mesh() -> None:
    first = build_mesh(circle_tank(Circle()), bulk_size=0.2, geometry_degree=3)
    build_mesh(thin_float_tank(), bulk_size=0.2)
    second = build_mesh(circle_tank(Circle()), bulk_size=0.2, geometry_degree=3)
    assert first.points.tobytes() == second.points.tobytes()
    assert np.array_equal(first.cells, second.cells)
    assert np.array_equal(first.facets, second.facets)
    assert first.curved is not None
    assert second.curved is not None
    assert first.curved.nodes.tobytes() == second.curved.nodes.tobytes()


def test_options_of_an_earlier_mesh_do_not_change_the_next_one() -> None:
    first = build_mesh(circle_tank(Circle()), bulk_size=0.5)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.01)
    assert np.array_equal(build_mesh(circle_tank(Circle()), bulk_size=0.5).cells, first.cells)


def test_corners_beside_one_another_have_rings_that_fit() -> None:
    """Rings asked for are far too large for the corners' distance of 0.01, and for the depth."""
    ends = ((0.495, 0.0), (0.505, 0.0))
    outline = two_liquids(left=[(0.495, INTERFACE), (0.505, BEAM), (1.0, INTERFACE)], rings=ends, depths=(0.4, 0.02))
    outline = replace(outline, graded_points=tuple(replace(graded, outer=inf) for graded in outline.graded_points))
    mesh = build_mesh(outline, bulk_size=0.2)
    assert signed_areas(mesh).sum() == pytest.approx(0.42, rel=1e-13)
    edges = mesh.points[mesh.facets[mesh.facet_tags == mesh.facet_names[BEAM]]]
    # The outermost rings reach to 0.45 of the way; between them one element is left.
    assert np.linalg.norm(edges[:, 1] - edges[:, 0], axis=1).max() < 0.45 * 0.01


def test_no_small_size_on_a_line_is_overlooked() -> None:
    """A size of 1e-6 at one point of a line is found wherever it is; elements grow by a third of the distance."""
    starts, ends = np.array([[0.0, 0.0]]), np.array([[1.0, 0.0]])
    for place in np.random.default_rng(3).uniform(0.05, 0.95, 8):
        size = SizeField(bulk_size=0.25, growth=0.7, straight=[], rings=[((float(place), 0.0), 1e-6)], bends=[])
        (parts,) = straight_elements(starts, ends, size)
        lengths = np.diff(parts)
        assert lengths[np.searchsorted(parts, place) - 1] < 2e-6
        # Neighbours differ by a factor of 1 + 0.34 and a little.
        assert np.exp(np.abs(np.diff(np.log(lengths))).max()) < 1.5
        assert lengths.max() <= 0.25


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
