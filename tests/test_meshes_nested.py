"""Series of meshes: halving cuts every triangle into four alike, drawing makes algebraic rings of the same ones."""

from __future__ import annotations

import numpy as np
import pytest

from hydroelastic.meshes.geometry import tank_geometry
from hydroelastic.meshes.nested import NestedMeshes, halved
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
    return NestedMeshes(geometry=geometry, size=0.125, bulk_size=0.125)


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
    mesh = series_of(name).mesh(3, exponent)
    expected = {"bottom": 1.0, "left_wall": 0.5, "right_wall": 0.5}
    for start, end, piece in PIECES[name]:
        expected[piece] = expected.get(piece, 0.0) + end - start
    assert {group: mesh.facet_measure(group) for group in mesh.facet_names} == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("name", ["beam", "at the wall", "short beam", "full cover"])
@pytest.mark.parametrize("exponent", [1.0, 2.5, 9.0])
def test_rings_have_algebraic_radii(name: str, exponent: float) -> None:
    series = series_of(name)
    mesh = series.mesh(3, exponent)
    top = np.unique(mesh.points[mesh.points[:, 1] == 0.0, 0])
    for fan in series.fans:
        radius = fan.radii[0]
        expected = radius * (np.arange(1, 9) / 8.0) ** exponent
        for side in (1.0, -1.0):
            distance = side * (top - fan.centre)
            rings = np.sort(distance[(distance > 0.0) & (distance < radius * (1.0 + 1e-9))])
            if len(rings):  # else the wall
                # A distance from an abscissa of order one keeps its last 1e-16.
                assert rings == pytest.approx(expected, rel=1e-9, abs=2e-16)
    innermost = min(float(fan.radii[0]) for fan in series.fans) / 8.0**exponent
    assert series.innermost_ring(3, exponent) == pytest.approx(innermost, rel=1e-12)


@pytest.mark.parametrize("name", ["beam", "at the wall", "short beam", "full cover"])
@pytest.mark.parametrize("exponent", [2.0, 5.0, 9.0])
def test_drawing_turns_no_triangle_and_moves_nothing_else(name: str, exponent: float) -> None:
    series = series_of(name)
    uniform, drawn = series.mesh(3), series.mesh(3, exponent)
    assert np.array_equal(uniform.cells, drawn.cells)
    assert np.array_equal(uniform.facets, drawn.facets)
    assert np.all(areas(drawn) * areas(uniform) > 0.0)
    assert np.abs(areas(drawn)).sum() == pytest.approx(0.5, rel=1e-12)
    moved = np.any(uniform.points != drawn.points, axis=1)
    near = [np.hypot(*(uniform.points[moved] - [fan.centre, 0.0]).T) < fan.radii[0] for fan in series.fans]
    assert np.any(near, axis=0).all()
    # The tip and the fan's outer edge stay: a fan of three sectors has 1 + Σ 3i + 1 nodes, those of i = 8 stay.
    assert moved.sum() == sum(sum((len(fan.angles) - 1) * i + 1 for i in range(1, 8)) for fan in series.fans)


def test_a_tank_without_tips_has_nothing_to_draw() -> None:
    series = series_of("no beam")
    assert np.array_equal(series.mesh(2).points, series.mesh(2, 3.0).points)
    assert series.innermost_ring(8, 9.0) == np.inf
