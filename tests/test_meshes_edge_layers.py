"""Layers of tetrahedra towards singular edges: they fill the same volume, fit together, and keep to its faces."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from hydroelastic.meshes.edge_layers import with_edge_layers
from hydroelastic.meshes.tetrahedra import mesh_volume, smallest_jacobians
from hydroelastic.meshes.volume import VolumeSizes, volume_mesh
from hydroelastic.physics.level_tank import Box, Cylinder
from hydroelastic.physics.obstacles import VerticalBaffle
from hydroelastic.physics.plate import Disc, Plate, Rectangle
from hydroelastic.physics.volume_tank import VolumeTank

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


def test_without_singular_edges_a_mesh_stays_as_it_is() -> None:
    tank = VolumeTank(plan=Box(length=1.0, width=0.8), depth=0.4, density=1.0, gravity=1.0)
    mesh = volume_mesh(tank, SIZES).noded
    assert with_edge_layers(mesh, np.empty((0, 2), np.int64), np.empty(0, np.int64), 2) is mesh
