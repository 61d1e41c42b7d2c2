"""Meshes of plans, layers in volumes, series of halved meshes, frames around a basin: what they fill, and with what."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from mpi4py import MPI

from hydroelastic.fem.cells import cell_jacobians, cell_positions
from hydroelastic.meshes.distribute import TankMesh, distribute_mesh
from hydroelastic.meshes.geometry import (
    BOTTOM,
    FAR_END,
    FREE_SURFACE,
    LEFT_WALL,
    LIQUID,
    RIGHT_WALL,
    tank_geometry,
)
from hydroelastic.meshes.nested import NestedMeshes, halved, outline_meshes, rectangle_meshes
from hydroelastic.meshes.open_sea import CellLayers, extended, with_far_ends
from hydroelastic.meshes.outline import Curve, GradedPoint, Outline, Region
from hydroelastic.meshes.plan import plan_mesh
from hydroelastic.meshes.plan_loops import CircleLoop, Loop, Mirrors, PlanRegion, PolygonLoop
from hydroelastic.meshes.tagged_mesh import TaggedMesh
from hydroelastic.meshes.tetrahedra import mesh_volume, smallest_jacobians
from hydroelastic.meshes.volume import VolumeSizes, volume_mesh
from hydroelastic.physics.level_tank import Box, Cylinder
from hydroelastic.physics.obstacles import VerticalBaffle
from hydroelastic.physics.plate import Disc, Plate, Rectangle
from hydroelastic.physics.volume_tank import VolumeTank


def _box(left: float, right: float, low: float, high: float) -> PolygonLoop:
    return PolygonLoop(corners=np.array([[left, low], [right, low], [right, high], [left, high]]))


def _circle(radius: float, x: float = 0.0, y: float = 0.0) -> CircleLoop:
    return CircleLoop(centre=np.array([x, y]), radius=radius)


def _meshed(wall: Loop, *plates: PlanRegion, layers: int = 3, mirrors: Mirrors = (None, None)) -> TankMesh:
    mesh = plan_mesh(
        PlanRegion(name="water", outside=wall),
        plates,
        size=0.25,
        layers=layers,
        thickness=0.1,
        geometry_degree=6,
        mirrors=mirrors,
    )
    return distribute_mesh(MPI.COMM_SELF, mesh)


def _area(mesh: TankMesh, name: str) -> float:
    import basix

    reference, weights = basix.make_quadrature(basix.CellType.triangle, 14)
    measures = np.linalg.det(cell_jacobians(mesh.mesh, mesh.cells(name), reference))
    assert measures.min() > 0.0 or measures.max() < 0.0
    if measures.shape[1] == 1:
        measures = np.broadcast_to(measures, (len(measures), len(weights)))
    return float(np.abs(measures @ weights).sum())


def test_a_plate_between_walls_has_its_area_and_layers() -> None:
    mesh = _meshed(_box(0.0, 1.0, 0.0, 0.8), PlanRegion(name="plate", outside=_box(0.3, 0.7, 0.25, 0.55)))
    assert _area(mesh, "plate") == pytest.approx(0.12, rel=1e-13)
    assert _area(mesh, "water") == pytest.approx(0.68, rel=1e-13)
    corners = cell_positions(mesh.mesh, mesh.cells("water"), np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]))
    left = (np.abs(corners[..., 1] - 0.4) < 0.151) & (corners[..., 0] < 0.3 + 1e-9)
    beside = np.unique(np.round(0.3 - corners[..., 0][left], 9))
    # Layers of ratio 0.2 left of the plate.
    assert beside[:4] == pytest.approx([0.0, 0.004, 0.02, 0.1], abs=1e-9)


@pytest.mark.parametrize("mirrors", [(None, None), (None, 0.4)])
def test_rectangles_may_touch_and_span_walls_beside_a_narrow_gap(mirrors: Mirrors) -> None:
    strip, corner = _box(0.3, 0.5, 0.0, 0.8), _box(0.501, 1.0, 0.0, 0.8)
    if mirrors == (None, None):
        corner = _box(0.501, 1.0, 0.0, 0.3)
    plates = (PlanRegion(name="strip", outside=strip), PlanRegion(name="corner", outside=corner))
    mesh = _meshed(_box(0.0, 1.0, 0.0, 0.8), *plates, mirrors=mirrors)
    share = 0.5 ** sum(mirror is not None for mirror in mirrors)
    areas = {"strip": 0.16, "corner": 0.499 * (0.3 if share == 1.0 else 0.8)}
    areas["water"] = 0.8 - sum(areas.values())
    for name, area in areas.items():
        assert _area(mesh, name) == pytest.approx(share * area, rel=1e-12)


def test_layers_thinner_than_the_sagitta_of_their_arcs_do_not_fold() -> None:
    mesh = _meshed(_circle(1.0), PlanRegion(name="plate", outside=_circle(0.4)), layers=6)
    # Arcs of geometry degree 6: measured 1e-13.
    assert _area(mesh, "plate") == pytest.approx(0.16 * np.pi, rel=1e-11)
    assert _area(mesh, "water") == pytest.approx(0.84 * np.pi, rel=1e-11)


def test_the_hole_of_a_ring_is_water() -> None:
    mesh = _meshed(_circle(1.0), PlanRegion(name="plate", outside=_circle(0.8), inside=(_circle(0.4),)))
    assert _area(mesh, "plate") == pytest.approx(0.48 * np.pi, rel=1e-11)
    assert _area(mesh, "water") == pytest.approx(0.52 * np.pi, rel=1e-11)


def test_a_plate_that_covers_the_plan_leaves_no_water() -> None:
    wall = _circle(1.0)
    mesh = _meshed(wall, PlanRegion(name="plate", outside=wall))
    assert "water" not in mesh.cell_names
    assert _area(mesh, "plate") == pytest.approx(np.pi, rel=1e-11)


def test_corners_of_more_than_half_a_turn_are_refined() -> None:
    corner = PolygonLoop(corners=np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 0.5], [0.5, 0.5], [0.5, 1.0], [0.0, 1.0]]))
    mesh = _meshed(corner)
    corners = cell_positions(mesh.mesh, mesh.cells("water"), np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]))
    sizes = np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1)
    near = np.linalg.norm(corners - [0.5, 0.5], axis=2).min(axis=1) < 1e-12
    assert near.any()
    assert _area(mesh, "water") == pytest.approx(0.75, rel=1e-13)
    assert sizes[near].max() < 0.02


MIRRORS: list[Mirrors] = [(0.0, None), (None, 0.0), (0.0, 0.0)]

SYMMETRIC = {
    "disc": (_circle(1.0), PlanRegion(name="plate", outside=_circle(0.4))),
    "ring": (_circle(1.0), PlanRegion(name="plate", outside=_circle(0.7), inside=(_circle(0.3),))),
    "cross": (
        _box(-1.0, 1.0, -0.8, 0.8),
        PlanRegion(
            name="plate",
            outside=PolygonLoop(
                corners=np.array(
                    [
                        [0.0, -0.4],
                        [0.1, -0.1],
                        [0.5, 0.0],
                        [0.1, 0.1],
                        [0.0, 0.4],
                        [-0.1, 0.1],
                        [-0.5, 0.0],
                        [-0.1, -0.1],
                    ]
                )
            ),
        ),
    ),
}


@pytest.mark.parametrize("mirrors", MIRRORS)
@pytest.mark.parametrize("name", SYMMETRIC)
def test_a_part_between_mirror_planes_has_its_share_of_each_region(name: str, mirrors: Mirrors) -> None:
    wall, plate = SYMMETRIC[name]
    whole = _meshed(wall, plate)
    part = _meshed(wall, plate, mirrors=mirrors)
    share = 0.5 ** sum(mirror is not None for mirror in mirrors)
    for region in ("plate", "water"):
        assert _area(part, region) == pytest.approx(share * _area(whole, region), rel=1e-12)
    # All of it lies on one side, and the planes are its edges: a quarter has no node off them by rounding.
    for axis, mirror in enumerate(mirrors):
        if mirror is not None:
            places = part.mesh.geometry.x[:, axis]
            assert abs(places.min()) < 1e-15


def test_a_narrow_gap_between_circles_is_meshed() -> None:
    # Without shorter arcs the sagitta of a quarter's chord is wider than the gap.
    mesh = _meshed(_circle(1.0), PlanRegion(name="plate", outside=_circle(0.98)))
    assert _area(mesh, "water") == pytest.approx((1.0 - 0.98**2) * np.pi, rel=1e-9)


def test_walls_are_graded_towards_obtuse_corners_and_not_towards_right_ones() -> None:
    angles = np.arange(6) * np.pi / 3.0
    hexagon = PolygonLoop(corners=np.column_stack([np.cos(angles), np.sin(angles)]))
    square = PolygonLoop(corners=np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]))
    nodes = np.array([0.01, 0.02, 0.04, 0.08, 0.16])
    assert len(hexagon.graded_corners) == 6
    assert not len(square.graded_corners)
    # ψ ~ r^{3/2} takes the three largest nodes at both ends of a side.
    places = hexagon.places(10.0, np.zeros(0), nodes)
    assert places[:8] == pytest.approx([0.0, 0.04, 0.08, 0.16, 0.84, 0.92, 0.96, 1.0])
    assert square.places(10.0, np.zeros(0), nodes) == pytest.approx([0.0, 1.0, 2.0, 3.0])


def test_cells_between_two_close_discs_follow_their_arcs() -> None:
    discs = [PlanRegion(name=f"disc {x}", outside=_circle(0.2, x, 0.4)) for x in (0.29, 0.71)]
    mesh = _meshed(_box(0.0, 1.0, 0.0, 0.8), *discs, layers=1)
    # Of 28 arcs of geometry degree 6: measured 1e-13.
    assert _area(mesh, "water") == pytest.approx(0.8 - 0.08 * np.pi, rel=1e-11)


FACES = np.array([(1, 2, 3), (0, 2, 3), (0, 1, 3), (0, 1, 2)])

SIZES = VolumeSizes(edge=0.3, bulk=0.3, geometry=4, layers=2)


def plate(outline: Disc | Rectangle) -> Plate:
    return Plate(outline=outline, flexural_rigidity=1.0, mass_per_area=0.0)


@pytest.mark.parametrize("round_", [False, True])
def test_layers_fill_the_volume_and_fit_together(round_: bool) -> None:
    """Of a rectangle with corners in a box, and of a disc in a cylinder, whose cells are curved."""
    outline = Disc(radius=0.4) if round_ else Rectangle(position=(0.5, 0.4), size=(0.4, 0.3))
    plan = Cylinder(radius=1.0) if round_ else Box(length=1.0, width=0.8)
    tank = VolumeTank(plan=plan, depth=0.4, density=1.0, gravity=1.0, plates=(plate(outline),))
    plain = volume_mesh(tank, replace(SIZES, layers=0)).noded
    mesh = volume_mesh(tank, SIZES).noded
    assert len(mesh.cells) > 2 * len(plain.cells)
    assert mesh_volume(mesh) == pytest.approx(mesh_volume(plain), rel=1e-12)
    # Each face has two cells, or one and lies on the boundary, whose groups have the area that they had; a curved face
    # between its corners less.
    faces, counts = np.unique(np.sort(mesh.cells[:, FACES].reshape(-1, 3), axis=1), axis=0, return_counts=True)
    assert set(counts) == {1, 2}
    boundary = face_areas(mesh.points, faces[counts == 1]).sum()
    whole = np.pi * (2.0 + 2.0 * 0.4) if round_ else 2.0 * (0.8 + 0.4 * 1.8)
    assert boundary == pytest.approx(whole, rel=3e-2 if round_ else 1e-12)
    for name, tag in mesh.facet_names.items():
        area = face_areas(mesh.points, mesh.facets[mesh.facet_tags == tag]).sum()
        exact = outline.area if name == "body_1" else plan.area - outline.area
        assert area == pytest.approx(exact, rel=5e-2 if round_ else 1e-9), name
    # Two cuts at 0.3 of the width leave cells of 0.09 of it at the edge.
    radii = np.hypot(*mesh.points[:, :2].T)
    near = np.abs(radii - 0.4) if round_ else np.abs(mesh.points[:, 0] - 0.3) + 10.0 * np.abs(mesh.points[:, 1] - 0.4)
    assert 0.0 < near[near > 1e-9].min() < 0.04
    if not round_:
        assert smallest_jacobians(mesh).min() == pytest.approx(1.0)


def face_areas(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    corners = points[triangles]
    sides = corners[:, 1:] - corners[:, :1]
    found: np.ndarray = 0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    return found


def test_a_baffle_in_layers_is_cut_open_along_all_of_it() -> None:
    """The nodes on it are double, but for those on its tip."""
    baffle = VerticalBaffle(start=(0.5, 0.0), end=(0.5, 0.8), top=-0.2)
    tank = VolumeTank(plan=Box(length=1.0, width=0.8), depth=0.4, density=1.0, gravity=1.0, baffles=(baffle,))
    mesh = volume_mesh(tank, replace(SIZES, geometry=1)).noded
    on = mesh.points[(np.abs(mesh.points[:, 0] - 0.5) < 1e-9) & (mesh.points[:, 2] < -0.2 + 1e-9)]
    places, counts = np.unique(np.round(on, 9), axis=0, return_counts=True)
    assert np.array_equal(counts == 1, np.abs(places[:, 2] + 0.2) < 1e-8)
    assert np.any((counts == 2) & (places[:, 2] > -0.25))
    assert mesh_volume(mesh) == pytest.approx(0.32, rel=1e-12)


WATER = "free_surface"

PIECES = {
    "beam": ((0.0, 0.3, WATER), (0.3, 0.7, "body_1"), (0.7, 1.0, WATER)),
    "at the wall": ((0.0, 0.4, "body_1"), (0.4, 1.0, WATER)),
    "short beam": ((0.0, 0.495, WATER), (0.495, 0.505, "body_1"), (0.505, 1.0, WATER)),
    "full cover": ((0.0, 1.0, "body_1"),),
    "no beam": ((0.0, 1.0, WATER),),
}


def series_of(name: str, depth: float = 0.5) -> NestedMeshes:
    geometry = tank_geometry(length=1.0, depth=depth, pieces=PIECES[name])
    return rectangle_meshes(geometry, size=0.125, bulk_size=0.125)


def betas(series: NestedMeshes, exponent: float) -> tuple[float, ...]:
    return (exponent,) * len(series.graded_points)


def areas(mesh: TaggedMesh) -> np.ndarray:
    a, b, c = (mesh.points[mesh.cells[:, corner]] for corner in range(3))
    doubled: np.ndarray = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    return 0.5 * doubled


@pytest.mark.parametrize("name", PIECES)
def test_halving_cuts_every_triangle_into_four_of_equal_area(name: str) -> None:
    coarse = series_of(name).mesh(0)
    fine = halved(coarse)
    assert len(fine.cells) == 4 * len(coarse.cells)
    # Middles of edges are exact to a rounding; triangles keep their order and their turn.
    assert areas(fine) == pytest.approx(np.repeat(areas(coarse) / 4.0, 4), rel=1e-12)
    # Euler: each edge has got one node, and none twice.
    assert len(fine.points) == len(coarse.points) + len(coarse.points) + len(coarse.cells) - 1
    assert len(np.unique(fine.points, axis=0)) == len(fine.points)


@pytest.mark.parametrize("name", PIECES)
@pytest.mark.parametrize("exponent", [1.0, 5.0])
def test_every_group_keeps_its_length(name: str, exponent: float) -> None:
    series = series_of(name)
    mesh = series.mesh(3, betas(series, exponent))
    expected = {"bottom": 1.0, "left_wall": 0.5, "right_wall": 0.5}
    for start, end, piece in PIECES[name]:
        expected[piece] = expected.get(piece, 0.0) + end - start
    assert {group: mesh.facet_measure(group) for group in mesh.facet_names} == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("name", ["beam", "at the wall", "short beam", "full cover"])
@pytest.mark.parametrize("exponent", [1.0, 2.5, 9.0])
def test_rings_have_algebraic_radii(name: str, exponent: float) -> None:
    series = series_of(name)
    mesh = series.mesh(3, betas(series, exponent))
    top = np.unique(mesh.points[mesh.points[:, 1] == 0.0, 0])
    for graded in series.graded_points:
        radius = graded.outer
        expected = radius * (np.arange(1, 9) / 8.0) ** exponent
        for side in (1.0, -1.0):
            distance = side * (top - graded.point[0])
            rings = np.sort(distance[(distance > 0.0) & (distance < radius * (1.0 + 1e-9))])
            if len(rings):  # else the wall
                # A distance from an abscissa of order one keeps its last 1e-16.
                assert rings == pytest.approx(expected, rel=1e-9, abs=2e-16)
    innermost = min(graded.outer for graded in series.graded_points) / 8.0**exponent
    assert series.innermost_ring(3, betas(series, exponent)) == pytest.approx(innermost, rel=1e-12)


@pytest.mark.parametrize("name", ["beam", "at the wall", "short beam", "full cover"])
@pytest.mark.parametrize("exponent", [2.0, 5.0, 9.0])
def test_drawing_turns_no_triangle_and_moves_nothing_else(name: str, exponent: float) -> None:
    series = series_of(name)
    uniform, drawn = series.mesh(3), series.mesh(3, betas(series, exponent))
    assert np.array_equal(uniform.cells, drawn.cells)
    assert np.array_equal(uniform.facets, drawn.facets)
    assert np.all(areas(drawn) * areas(uniform) > 0.0)
    assert np.abs(areas(drawn)).sum() == pytest.approx(0.5, rel=1e-12)
    moved = np.any(uniform.points != drawn.points, axis=1)
    near = [np.hypot(*(uniform.points[moved] - graded.point).T) < graded.outer for graded in series.graded_points]
    assert np.any(near, axis=0).all()

    def sectors(graded: GradedPoint) -> int:
        return 2 if graded.point[0] in (0.0, 1.0) else 3

    # The tip and the fan's outer edge stay: a fan of three sectors has 1 + Σ 3i + 1 nodes, those of i = 8 stay.
    assert moved.sum() == sum(sum(sectors(graded) * i + 1 for i in range(1, 8)) for graded in series.graded_points)


def slit_in_two_liquids() -> Outline:
    """A slit through the middle of an interface at y = 0, which is cut open as well, in a unit square."""
    corners = ((0.0, -0.5), (0.5, -0.5), (1.0, -0.5), (1.0, 0.0), (1.0, 0.5), (0.5, 0.5), (0.0, 0.5), (0.0, 0.0))
    names = ("bottom", "bottom", "right_wall", "right_wall", "lid", "lid", "left_wall", "left_wall")
    rim = [
        Curve(name=name, start=start, end=end)
        for name, start, end in zip(names, corners, (*corners[1:], corners[0]), strict=True)
    ]
    middle, low, high = (0.5, 0.0), (0.5, -0.25), (0.5, 0.3)
    inner = [
        Curve(name="interface", start=(0.0, 0.0), end=middle, size=0.125, cut=True),
        Curve(name="interface", start=middle, end=(1.0, 0.0), size=0.125, cut=True),
        Curve(name="", start=(0.5, -0.5), end=low),
        Curve(name="body_1", start=low, end=middle, size=0.125, cut=True),
        Curve(name="body_1", start=middle, end=high, size=0.125, cut=True),
        Curve(name="", start=high, end=(0.5, 0.5)),
    ]
    return Outline(
        curves=(*rim, *inner),
        regions=(
            Region(name="lower", loop=((0, True), (10, True), (11, True), (8, False), (7, True))),
            Region(name="lower", loop=((1, True), (2, True), (9, False), (11, False), (10, False))),
            Region(name="upper", loop=((8, True), (12, True), (13, True), (5, True), (6, True))),
            Region(name="upper", loop=((9, True), (3, True), (4, True), (13, False), (12, False))),
        ),
        graded_points=tuple(GradedPoint(point=point, inner=np.inf, outer=0.09) for point in (low, middle, high)),
    )


@pytest.mark.parametrize("exponents", [None, (5.0, 2.0, 3.0)])
def test_what_is_cut_open_stays_open_with_all_its_tags(exponents: tuple[float, ...] | None) -> None:
    mesh = outline_meshes(slit_in_two_liquids(), bulk_size=0.125).mesh(3, exponents)
    # Both sides of the slit and of the interface are there, every other piece once.
    expected = {"bottom": 1.0, "right_wall": 1.0, "lid": 1.0, "left_wall": 1.0, "interface": 2.0, "body_1": 1.1}
    assert {name: mesh.facet_measure(name) for name in mesh.facet_names} == pytest.approx(expected, rel=1e-12)
    for name, sign in (("lower", -1.0), ("upper", 1.0)):
        cells = mesh.cells[mesh.cell_tags == mesh.cell_names[name]]
        assert np.all(sign * mesh.points[cells].mean(axis=1)[:, 1] > 0.0)
        # No node is on both sides of the interface, nor of the slit but for its end.
        other = mesh.cells[mesh.cell_tags != mesh.cell_names[name]]
        assert not np.intersect1d(cells, other).size
        left = mesh.points[cells].mean(axis=1)[:, 0] < 0.5
        shared = mesh.points[np.intersect1d(cells[left], cells[~left])]
        end = 0.25 if name == "lower" else 0.3
        assert np.all(shared[:, 0] == 0.5)
        assert np.abs(shared[:, 1]).min() == end
    assert np.abs(areas(mesh)).sum() == pytest.approx(1.0, rel=1e-12)
    assert np.all(areas(mesh) < 0.0) or np.all(areas(mesh) > 0.0)


def test_every_corner_has_its_own_exponent_on_all_its_sides() -> None:
    series = outline_meshes(slit_in_two_liquids(), bulk_size=0.125)
    exponents = (5.0, 2.0, 3.0)
    mesh = series.mesh(2, exponents)
    for graded, exponent in zip(series.graded_points, exponents, strict=True):
        for name in ("body_1", "interface"):
            nodes = mesh.facet_nodes(name) - graded.point
            distance = np.hypot(*nodes[np.any(nodes == 0.0, axis=1)].T)
            rings = np.unique(np.round(distance[(distance > 0.0) & (distance < graded.outer * (1.0 + 1e-9))], 12))
            if name == "body_1" or graded.point[1] == 0.0:
                assert rings == pytest.approx(graded.outer * (np.arange(1, 5) / 4.0) ** exponent, rel=1e-8)


def area(mesh: TaggedMesh, name: str) -> float:
    return float(np.abs(areas(mesh)[mesh.cell_tags == mesh.cell_names[name]]).sum())


def facets(mesh: TaggedMesh, name: str) -> np.ndarray:
    """End points, shape (facets, 2, 2)."""
    return mesh.points[mesh.facets[mesh.facet_tags == mesh.facet_names[name]]]


def length(mesh: TaggedMesh, name: str) -> float:
    ends = facets(mesh, name)
    return float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum())


def check(mesh: TaggedMesh) -> None:
    """Cells are not inverted, meet at whole edges, and every edge with one cell alone has one name."""
    signs = np.sign(areas(mesh))
    assert np.all(signs == signs[0])
    edges = Counter(
        (min(cell[i], cell[i - 1]), max(cell[i], cell[i - 1])) for cell in mesh.cells.tolist() for i in range(3)
    )
    assert set(edges.values()) <= {1, 2}
    rim = {edge for edge, count in edges.items() if count == 1}
    named = Counter((min(pair), max(pair)) for pair in mesh.facets.tolist())
    assert set(named.values()) == {1}
    assert set(named) == rim
    assert np.unique(mesh.cells).size == len(mesh.points)


def square() -> TaggedMesh:
    """Two triangles in 0 < x < 1, −1 < y < 0."""
    names = {LEFT_WALL: 1, RIGHT_WALL: 2, BOTTOM: 3, FREE_SURFACE: 4}
    return TaggedMesh(
        points=np.array([[0.0, -1.0], [1.0, -1.0], [1.0, 0.0], [0.0, 0.0]]),
        cells=np.array([[0, 2, 1], [0, 3, 2]]),
        cell_tags=np.array([7, 7], dtype=np.int32),
        facets=np.array([[0, 3], [1, 2], [0, 1], [2, 3]]),
        facet_tags=np.array([1, 2, 3, 4], dtype=np.int32),
        cell_names={LIQUID: 7},
        facet_names=names,
    )


def layers(sideways: Any, below: Any = 0.0, above: Any = 0.0) -> CellLayers:
    sideways = np.array(sideways, dtype=float)
    below, above = (np.broadcast_to(np.array(part, dtype=float), sideways.shape) for part in (below, above))
    return CellLayers(sideways=sideways, below=below, above=above)


def test_square_sideways() -> None:
    mesh = extended(square(), (LEFT_WALL, RIGHT_WALL), layers([1.0, 3.0]))
    check(mesh)
    assert area(mesh, LIQUID) == pytest.approx(7.0, rel=1e-14)
    assert length(mesh, BOTTOM) == length(mesh, FREE_SURFACE) == pytest.approx(7.0, rel=1e-14)
    np.testing.assert_allclose(facets(mesh, LEFT_WALL)[..., 0], -3.0)
    np.testing.assert_allclose(facets(mesh, RIGHT_WALL)[..., 0], 4.0)
    # Two cells of the basin come first, as they were; then two in each frame on each side.
    np.testing.assert_array_equal(mesh.points[:4], square().points)
    np.testing.assert_array_equal(mesh.cells[:2], square().cells)
    assert len(mesh.cells) == 2 + 2 * 2 * 2


def test_square_in_all_directions() -> None:
    mesh = extended(square(), (LEFT_WALL, RIGHT_WALL, BOTTOM), layers([1.0, 3.0], below=[0.5, 5.0]))
    check(mesh)
    assert area(mesh, LIQUID) == pytest.approx(7.0 * 6.0, rel=1e-14)
    assert length(mesh, BOTTOM) == pytest.approx(7.0, rel=1e-14)
    assert length(mesh, LEFT_WALL) == length(mesh, RIGHT_WALL) == pytest.approx(6.0, rel=1e-14)
    np.testing.assert_allclose(facets(mesh, BOTTOM)[..., 1], -6.0)


def test_far_ends_are_one() -> None:
    mesh = with_far_ends(square(), (LEFT_WALL, RIGHT_WALL))
    assert length(mesh, FAR_END) == 2.0
    assert set(mesh.facet_names) == {BOTTOM, FREE_SURFACE, FAR_END}
    check(mesh)
