"""Frames around a basin: they conform, fill what they should, keep names, and end at bed, lid and far ends."""

from __future__ import annotations

import math
from collections import Counter
from typing import Any

import numpy as np
import pytest
from open_cases import problem_of, section, slender, stored, two_liquids
from open_tables import open_scene

from hydroelastic.fem.open_water.basin import OpenBasin, open_basin, sized_absorbing_layer
from hydroelastic.fem.open_water.field_model import Band
from hydroelastic.fem.open_water.model_building import first_resolution, open_mesh
from hydroelastic.meshes.geometry import (
    BOTTOM,
    FAR_END,
    FREE_SURFACE,
    INTERFACE,
    LEFT_WALL,
    LID,
    LIQUID,
    LOWER_LIQUID,
    RIGHT_WALL,
    UPPER_LIQUID,
)
from hydroelastic.meshes.open_sea import CellLayers, extended, with_far_ends
from hydroelastic.meshes.tagged_mesh import TaggedMesh
from hydroelastic.scenes.models.tank import TankScene

SECTIONS = stored("open_sections.json")["cases"]
TWO_LIQUIDS = stored("open_two_liquids.json")["cases"]


def areas(mesh: TaggedMesh) -> np.ndarray:
    a, b, c = (mesh.points[mesh.cells[:, corner]] for corner in range(3))
    return ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2.0


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


def sea(scene: TankScene, omega: float) -> tuple[TaggedMesh, OpenBasin, float]:
    """The mesh of a scene, its basin, and how far it reaches beyond."""
    band = Band(lowest=omega, highest=omega)
    water = problem_of(scene).tank
    shortest = band.wavenumbers(water)[1]
    basin = open_basin(water, shortest)
    k = shortest * basin.units.length
    around = sized_absorbing_layer(basin, (k, k), first=2.0, growth=2.0, angle=0.8, tolerance=1e-4)
    return open_mesh(basin, first_resolution(water, scene.accuracy.tolerance, band), around), basin, around.farthest


def test_float_over_a_bed() -> None:
    row = SECTIONS[2]
    mesh, basin, far = sea(section(row, 1e-2), row["omega"])
    check(mesh)
    assert basin.sides == (LEFT_WALL, RIGHT_WALL, BOTTOM)
    assert basin.far_sides == (LEFT_WALL, RIGHT_WALL)
    unit = basin.units.length
    assert far > 1.0
    # 3 m of water and a float of 1 m × 0.5 m in it.
    whole = (1.0 + 2.0 * far) * unit * 3.0 - 0.5
    assert area(mesh, LIQUID) * unit**2 == pytest.approx(whole, rel=1e-12)
    assert length(mesh, BOTTOM) == pytest.approx(1.0 + 2.0 * far, rel=1e-12)
    np.testing.assert_allclose(facets(mesh, BOTTOM)[..., 1], -3.0 / unit, rtol=1e-14)
    assert length(mesh, FAR_END) * unit == pytest.approx(2.0 * 3.0, rel=1e-12)


def test_bed_and_lid_at_different_distances() -> None:
    mesh, basin, far = sea(slender("wedge", "channel", 1e-2), 2.0)
    check(mesh)
    assert basin.sides == (LEFT_WALL, RIGHT_WALL, BOTTOM, LID)
    unit = basin.units.length
    assert length(mesh, FAR_END) * unit == pytest.approx(2.0 * 3.5, rel=1e-12)
    # A thin float cuts nothing out.
    for name, depth in ((LOWER_LIQUID, 2.0), (UPPER_LIQUID, 1.5)):
        assert area(mesh, name) * unit == pytest.approx((1.0 + 2.0 * far) * depth, rel=1e-12)
    np.testing.assert_allclose(facets(mesh, LID)[..., 1] * unit, 1.5, rtol=1e-14)
    np.testing.assert_allclose(facets(mesh, BOTTOM)[..., 1] * unit, -2.0, rtol=1e-14)
    check_interface(mesh, 1.0 + 2.0 * far)


def test_bed_below_an_infinitely_deep_liquid() -> None:
    body = {"kind": "float", "shape": "wedge", "half_width": 0.2, "half_height": 0.5, "position": 5.0}
    liquids = ({"density": 1000.0, "depth": 3.0}, {"density": 800.0, "depth": math.inf})
    mesh, basin, far = sea(open_scene(body, liquids=liquids, analyses=[], accuracy={"tolerance": 1e-2}), 2.0)
    check(mesh)
    unit = basin.units.length
    np.testing.assert_allclose(facets(mesh, BOTTOM)[..., 1] * unit, -3.0, rtol=1e-14)
    assert area(mesh, LOWER_LIQUID) * unit**2 == pytest.approx((1.0 + 2.0 * far) * unit * 3.0 - 0.1, rel=1e-12)
    # The lid is far away, and an end.
    assert mesh.points[:, 1].max() == pytest.approx(basin.tank.layers[1].depth + far, rel=1e-12)
    assert LID not in mesh.facet_names


def check_interface(mesh: TaggedMesh, expected: float, covered: float = 0.0) -> None:
    """The interface goes on through all frames, once in each liquid, on nodes at the same places."""
    ends = facets(mesh, INTERFACE)
    np.testing.assert_allclose(ends[..., 1], 0.0, atol=1e-14)
    assert length(mesh, INTERFACE) == pytest.approx(2.0 * (expected - covered), rel=1e-12)
    places = Counter((round(min(pair), 9), round(max(pair), 9)) for pair in ends[..., 0].tolist())
    assert set(places.values()) == {2}


@pytest.mark.parametrize("row", [TWO_LIQUIDS[0], TWO_LIQUIDS[1], TWO_LIQUIDS[9]], ids=lambda row: row["level"])
def test_plates_on_two_liquids(row: dict[str, Any]) -> None:
    mesh, basin, far = sea(two_liquids(row, 1e-2), row["omega"])
    check(mesh)
    unit = basin.units.length
    for name, depth in zip((LOWER_LIQUID, UPPER_LIQUID), row["depths"], strict=True):
        assert area(mesh, name) * unit == pytest.approx((1.0 + 2.0 * far) * depth, rel=1e-12)
    covered = row["plate"]["length"] / unit
    check_interface(mesh, 1.0 + 2.0 * far, covered if row["level"] == "interface" else 0.0)
    if row["top"] == "free":
        open_top = 1.0 + 2.0 * far - (covered if row["level"] == "surface" else 0.0)
        assert length(mesh, FREE_SURFACE) == pytest.approx(open_top, rel=1e-12)
