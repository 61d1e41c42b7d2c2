"""Tank meshes are the tank: exact outline and groups, conforming, graded at the tips, well shaped, reproducible."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np
import pytest
from mesh_quality import smallest_angle

from hydroelastic.meshes.geometry import TankGeometry, tank_geometry
from hydroelastic.meshes.grading import Grading
from hydroelastic.meshes.tagged_mesh import TaggedMesh
from hydroelastic.meshes.tank import build_tank_mesh

Pieces = tuple[tuple[float, float, str], ...]
WATER, LID = "free_surface", "lid"
BEAM: Pieces = ((0.0, 0.3, WATER), (0.3, 0.7, "body_1"), (0.7, 1.0, WATER))
RATIO = 0.3
TIP = 1e-8


@dataclass(frozen=True)
class Case:
    pieces: Pieces
    depth: float = 0.5
    tip_size: float | None = TIP
    # Rings of ratio r = 0.3 in sectors of angle a have a smallest angle of atan(r sin a / (1 - r cos a)): 17 degrees in
    # three sectors of 60, 15 in two of 45 at a wall. The bounds below are measured, less a degree or a quarter.
    smallest_angle: float = 14.0


CASES = {
    "beam": Case(BEAM),
    "uniform": Case(BEAM, tip_size=None),
    "at the wall": Case(((0.0, 0.4, "body_1"), (0.4, 1.0, WATER))),
    "at the other wall": Case(((0.0, 0.4, LID), (0.4, 1.0, "body_1"))),
    "three beams": Case(
        (
            (0.0, 0.1, WATER),
            (0.1, 0.3, "body_2"),
            (0.3, 0.4, WATER),
            (0.4, 0.6, "body_1"),
            (0.6, 0.85, WATER),
            (0.85, 1.0, "body_3"),
        ),
        smallest_angle=12.5,
    ),
    "tiny gaps": Case(((0.0, 1e-4, WATER), (1e-4, 0.5, "body_1"), (0.5, 0.5001, WATER), (0.5001, 1.0, "body_2"))),
    "no beam": Case(((0.0, 1.0, WATER),)),
    "full cover": Case(((0.0, 1.0, "body_1"),)),
    "short beam": Case(((0.0, 0.495, WATER), (0.495, 0.505, "body_1"), (0.505, 1.0, WATER)), smallest_angle=8.8),
    "very deep": Case(BEAM, depth=100.0, smallest_angle=1.5),
    "very shallow": Case(BEAM, depth=1e-3, smallest_angle=0.5),
}


def geometry_of(case: Case) -> TankGeometry:
    return tank_geometry(length=1.0, depth=case.depth, pieces=case.pieces)


def make(case: Case) -> TaggedMesh:
    sizes = tuple(min(0.1, 0.5 * (end - start)) for start, end, _ in case.pieces)
    grading = Grading(
        surface_sizes=sizes, bulk_size=0.5 * max(1.0, case.depth), tip_size=case.tip_size, ring_ratio=RATIO
    )
    return build_tank_mesh(geometry_of(case), grading)


@pytest.fixture(scope="module", params=CASES)
def meshed(request: pytest.FixtureRequest) -> tuple[Case, TaggedMesh]:
    case = CASES[request.param]
    return case, make(case)


def doubled_areas(mesh: TaggedMesh) -> np.ndarray:
    a, b, c = (mesh.points[mesh.cells[:, corner]] for corner in range(3))
    return (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]


def boundary_length(mesh: TaggedMesh, name: str) -> float:
    edges = mesh.points[mesh.facets[mesh.facet_tags == mesh.facet_names[name]]]
    return float(np.linalg.norm(edges[:, 1] - edges[:, 0], axis=1).sum())


def test_all_triangles_turn_one_way_and_their_area_is_the_tanks(meshed: tuple[Case, TaggedMesh]) -> None:
    case, mesh = meshed
    areas = 0.5 * doubled_areas(mesh)
    areas *= np.sign(areas[0])
    assert areas.min() > 0.0
    # A sum of some thousand numbers, each right to a few units of its last place.
    assert areas.sum() == pytest.approx(case.depth, rel=1e-13)


def test_every_group_has_its_exact_length(meshed: tuple[Case, TaggedMesh]) -> None:
    case, mesh = meshed
    expected: dict[str, float] = {"bottom": 1.0, "left_wall": case.depth, "right_wall": case.depth}
    for start, end, name in case.pieces:
        expected[name] = expected.get(name, 0.0) + end - start
    assert set(mesh.facet_names) == set(expected)
    # A gap of 1e-4 between abscissae of order one keeps 12 digits.
    for name, length in expected.items():
        assert boundary_length(mesh, name) == pytest.approx(length, rel=1e-12), name


def test_joints_and_corners_are_nodes_to_the_last_bit(meshed: tuple[Case, TaggedMesh]) -> None:
    case, mesh = meshed
    nodes = {tuple(point) for point in mesh.points}
    for start, end, _ in case.pieces:
        assert {(start, 0.0), (end, 0.0)} <= nodes
    assert {(0.0, -case.depth), (1.0, -case.depth)} <= nodes


def test_the_nodes_of_each_piece_of_the_top_lie_on_it(meshed: tuple[Case, TaggedMesh]) -> None:
    case, mesh = meshed
    for name in {name for _, _, name in case.pieces}:
        nodes = mesh.facet_nodes(name)
        inside = [(nodes[:, 0] >= start) & (nodes[:, 0] <= end) for start, end, other in case.pieces if other == name]
        assert np.any(inside, axis=0).all(), name
        assert np.all(nodes[:, 1] == 0.0), name


def test_inner_edges_join_two_triangles_and_the_others_are_the_tagged_ones(meshed: tuple[Case, TaggedMesh]) -> None:
    _, mesh = meshed
    edges = np.sort(np.vstack([mesh.cells[:, pair] for pair in ([0, 1], [1, 2], [2, 0])]), axis=1)
    count = Counter(map(tuple, edges.tolist()))
    assert set(count.values()) <= {1, 2}
    outer = sorted(edge for edge, cells in count.items() if cells == 1)
    assert sorted(map(tuple, np.sort(mesh.facets, axis=1).tolist())) == outer
    # Euler's formula of a disc: no hole, no second part, no node without a triangle.
    assert len(mesh.points) - len(count) + len(mesh.cells) == 1


def test_triangles_are_well_shaped(meshed: tuple[Case, TaggedMesh]) -> None:
    case, mesh = meshed
    assert smallest_angle(mesh) > case.smallest_angle


@pytest.mark.parametrize("name", ["beam", "at the wall", "three beams", "tiny gaps", "full cover"])
def test_rings_shrink_by_one_ratio_to_the_size_asked(name: str) -> None:
    case = CASES[name]
    mesh = make(case)
    surface = np.sort(np.unique(np.concatenate([mesh.facet_nodes(piece)[:, 0] for _, _, piece in case.pieces])))
    for tip in geometry_of(case).tips:
        for side in (1.0, -1.0):
            distance = np.sort((side * (surface - tip))[side * (surface - tip) > 0.0])
            rings = distance[distance < 1e-5]
            if not len(distance):
                continue  # the wall
            assert rings[0] <= TIP
            # Next to an abscissa of order one a distance of 1e-9 keeps six digits.
            assert rings[1:] / rings[:-1] == pytest.approx(np.full(len(rings) - 1, 1.0 / RATIO), rel=1e-5)


@pytest.mark.parametrize(("name", "at_wall", "inside"), [("beam", 0, 2), ("at the wall", 1, 1), ("full cover", 2, 0)])
def test_a_fan_of_three_triangles_meets_a_tip_and_of_two_at_a_wall(name: str, at_wall: int, inside: int) -> None:
    mesh = make(CASES[name])
    fans = []
    for tip in geometry_of(CASES[name]).tips:
        (node,) = np.flatnonzero((mesh.points == [tip, 0.0]).all(axis=1))
        fans.append(int((mesh.cells == node).any(axis=1).sum()))
    assert Counter(fans) == Counter([2] * at_wall + [3] * inside)


def test_without_rings_elements_have_the_size_asked() -> None:
    grading = Grading(surface_sizes=(0.05,) * 3, bulk_size=0.05, tip_size=None)
    mesh = build_tank_mesh(geometry_of(CASES["beam"]), grading)
    edges = np.vstack([mesh.cells[:, pair] for pair in ([0, 1], [1, 2], [2, 0])])
    lengths = np.linalg.norm(mesh.points[edges[:, 0]] - mesh.points[edges[:, 1]], axis=1)
    # What gmsh makes of one size everywhere; measured 0.64 to 1.33 of it.
    assert lengths.min() > 0.5 * 0.05
    assert lengths.max() < 1.6 * 0.05


def test_a_smaller_size_on_one_piece_is_kept_there() -> None:
    grading = Grading(surface_sizes=(0.1, 0.01, 0.1), bulk_size=0.25, tip_size=None)
    mesh = build_tank_mesh(geometry_of(CASES["beam"]), grading)
    for name, size in (("body_1", 0.01), (WATER, 0.1)):
        edges = mesh.points[mesh.facets[mesh.facet_tags == mesh.facet_names[name]]]
        lengths = np.abs(edges[:, 1, 0] - edges[:, 0, 0])
        assert 0.5 * size < lengths.max() <= 1.05 * size


def test_the_same_tank_gives_the_same_mesh() -> None:
    first = make(CASES["three beams"])
    make(CASES["tiny gaps"])
    second = make(CASES["three beams"])
    assert first.points.tobytes() == second.points.tobytes()
    assert np.array_equal(first.cells, second.cells)
    assert np.array_equal(first.facets, second.facets)
    assert np.array_equal(first.facet_tags, second.facet_tags)


@pytest.mark.parametrize(
    "pieces",
    [
        ((0.0, 0.3, WATER), (0.4, 1.0, "body_1")),
        ((0.0, 0.5, WATER), (0.4, 1.0, "body_1")),
        ((0.0, 0.5, WATER),),
        ((0.1, 1.0, WATER),),
        ((0.0, 0.5, WATER), (0.5, 0.5, "body_1"), (0.5, 1.0, WATER)),
    ],
)
def test_pieces_with_gaps_or_overlaps_are_refused(pieces: Pieces) -> None:
    with pytest.raises(ValueError, match="cover the tank's top"):
        tank_geometry(length=1.0, depth=0.5, pieces=pieces)
