"""Meshes of plans and layers in volumes: areas are exact, layers lie at the edges, regions are where they belong."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from mpi4py import MPI

from hydroelastic.fem.cells import cell_jacobians, cell_positions
from hydroelastic.meshes.distribute import TankMesh, distribute_mesh
from hydroelastic.meshes.plan import plan_mesh
from hydroelastic.meshes.plan_loops import CircleLoop, Loop, Mirrors, PlanRegion, PolygonLoop
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
        size=lambda _: 0.25,
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
    # Layers of ratio 0.2 left of the plate, the outermost one a sixth of its shorter side.
    assert beside[:4] == pytest.approx([0.0, 0.002, 0.01, 0.05], abs=1e-9)


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
    boundary = areas(mesh.points, faces[counts == 1]).sum()
    whole = np.pi * (2.0 + 2.0 * 0.4) if round_ else 2.0 * (0.8 + 0.4 * 1.8)
    assert boundary == pytest.approx(whole, rel=3e-2 if round_ else 1e-12)
    for name, tag in mesh.facet_names.items():
        area = areas(mesh.points, mesh.facets[mesh.facet_tags == tag]).sum()
        exact = outline.area if name == "body_1" else plan.area - outline.area
        assert area == pytest.approx(exact, rel=5e-2 if round_ else 1e-9), name
    # Two cuts at 0.3 of the width leave cells of 0.09 of it at the edge.
    radii = np.hypot(*mesh.points[:, :2].T)
    near = np.abs(radii - 0.4) if round_ else np.abs(mesh.points[:, 0] - 0.3) + 10.0 * np.abs(mesh.points[:, 1] - 0.4)
    assert 0.0 < near[near > 1e-9].min() < 0.04
    if not round_:
        assert smallest_jacobians(mesh).min() == pytest.approx(1.0)


def areas(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
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
