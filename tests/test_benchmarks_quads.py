"""The quadrilaterals of the benchmark fill the tank, fit together, and shrink towards the beam's ends."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from hydroelastic.benchmarks.tank.graded_quads import QuadGrading, QuadMesh, graded_quads

GRADING = QuadGrading(water_size=0.8, beam_size=1.5, height=2.0, rings=4, ratio=0.15)
TANKS = {
    "whole": (10.0, 5.0, (3.0, 7.0)),
    "half": (5.0, 5.0, (3.0, 7.0)),
    "at the wall": (10.0, 5.0, (0.0, 4.0)),
    "narrow": (4.4, 5.0, (0.2, 4.2)),
    "shallow": (10.0, 0.1, (3.0, 7.0)),
}


def mesh_of(name: str) -> QuadMesh:
    return graded_quads(*TANKS[name], GRADING)


def edges(mesh: QuadMesh) -> list[tuple[int, int]]:
    """Of each element in turn, from the vertex at which the basis functions of the edge begin."""
    pairs = ((0, 1), (1, 2), (3, 2), (0, 3))
    return [(int(quad[a]), int(quad[b])) for quad in mesh.quads for a, b in pairs]


@pytest.mark.parametrize("name", TANKS)
def test_elements_fill_the_tank_and_are_convex(name: str) -> None:
    mesh = mesh_of(name)
    corners = mesh.nodes[mesh.quads]
    sides = np.roll(corners, -1, axis=1) - corners
    following = np.roll(sides, -1, axis=1)
    turns = sides[..., 0] * following[..., 1] - sides[..., 1] * following[..., 0]
    assert np.all(turns > 0.0)
    x, y = corners[..., 0], corners[..., 1]
    areas = 0.5 * np.sum(x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1), axis=1)
    length, depth, _ = TANKS[name]
    assert areas.sum() == pytest.approx(length * depth, rel=1e-12)


@pytest.mark.parametrize("name", TANKS)
def test_neighbours_share_whole_edges_in_the_same_direction(name: str) -> None:
    mesh = mesh_of(name)
    directed = Counter(edges(mesh))
    # The same edge, seen from both sides, must not appear in both directions.
    assert not any((b, a) in directed for a, b in directed)
    assert max(directed.values()) == 2
    length, depth, _ = TANKS[name]
    outer = [edge for edge, count in directed.items() if count == 1]
    rim = sum(np.linalg.norm(mesh.nodes[a] - mesh.nodes[b]) for a, b in outer)
    assert rim == pytest.approx(2.0 * (length + depth), rel=1e-12)


@pytest.mark.parametrize("name", TANKS)
def test_elements_at_an_end_of_the_beam_are_as_small_as_asked(name: str) -> None:
    mesh = mesh_of(name)
    length, depth, beam = TANKS[name]
    tips = [tip for tip in beam if tip <= length]
    gaps = [abs(tip - other) for tip in tips for other in (0.0, length, *tips) if tip != other]
    width = min(0.5 * min(gaps), 0.5 * depth, GRADING.water_size)
    for tip in tips:
        (node,) = np.flatnonzero((mesh.nodes[:, 0] == tip) & (mesh.nodes[:, 1] == 0.0))
        around = {end for edge in edges(mesh) if node in edge for end in edge} - {node}
        distances = [np.linalg.norm(mesh.nodes[other] - mesh.nodes[node]) for other in around]
        np.testing.assert_allclose(distances, width * GRADING.ratio**GRADING.rings, rtol=1e-9)
