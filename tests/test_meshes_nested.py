"""Series of meshes, halved and drawn to rings, and frames of cells around a basin: what they fill, and with what."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np
import pytest

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
from hydroelastic.meshes.tagged_mesh import TaggedMesh

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
