"""Fields of responses are those of the tables, whatever holds the bodies."""

from __future__ import annotations

import io
import math
from functools import cache
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
from PIL import Image

import hydroelastic as he

# Fields are solved for once more, in a wider basin, to 1e-3 of their energies; measured 4e-5 of the largest motion.
SAME = 1e-3
AMPLITUDE, OMEGA = 1.5, 0.78

BARGE = {
    "kind": "float",
    "shape": "rectangle",
    "half_width": 12.0,
    "draught": 4.0,
    "half_height": 3.5,
    "vertical_centre_of_gravity": 2.0,
    "radius_of_gyration": 8.5,
    "motions": ["heave", "sway", "roll"],
}
RAFT = BARGE | {"position": 40.0, "half_width": 5.0, "draught": 2.0, "vertical_centre_of_gravity": 0.0}
CYLINDER = {
    "kind": "float",
    "shape": "cylinder",
    "radius": 6.0,
    "draught": 5.0,
    "vertical_centre_of_gravity": -2.0,
    "radius_of_gyration": 4.0,
    "motions": ["heave", "surge", "pitch"],
}
HOLDS: dict[str, list[dict[str, Any]]] = {
    "nothing": [],
    "stiffness": [{"at": [-10.0, 1.0], "stiffness": [2e5, 1e5, 0.0]}],
    "damping": [{"damping": [8e4, 4e4, 2e7]}],
    "quadratic damping": [{"quadratic_damping": [0.0, 0.0, 2e7]}],
    "all at a point": [
        {"at": [6.0, -3.0], "stiffness": [1e5, 0.0, 0.0], "damping": [0.0, 4e4, 0.0]}
        | {"quadratic_damping": [3e5, 3e5, 2e7]}
    ],
}


def sea(*bodies: dict[str, Any], held: list[dict[str, Any]], tolerance: float = 1e-3) -> dict[str, Any]:
    response = {"kind": "response", "omega": [OMEGA], "wave_amplitude": AMPLITUDE}
    return {
        "kind": "sea",
        "liquid": [{"density": 1025.0, "depth": 30.0}],
        "body": list(bodies),
        "attachment": held,
        "analysis": [response],
        "accuracy": {"tolerance": tolerance},
    }


def amplitudes(result: he.Result) -> np.ndarray:
    """Of all motions, in the order of the table."""
    motions = result.dataset.RAO
    return np.asarray(motions.sel(complex="re") + 1j * motions.sel(complex="im")).ravel()


@cache
def free_motions() -> np.ndarray:
    return amplitudes(he.solve(sea(BARGE, held=[])))


def rigid_motions(file: Path, centres: list[tuple[float, float]]) -> list[np.ndarray]:
    """Heave, sway and roll of each polygon of a file, fitted to the displacements of its corners."""
    mesh = meshio.read(file)
    moved = mesh.point_data["displacement_real"] + 1j * mesh.point_data["displacement_imaginary"]
    found = []
    for corners, centre in zip((row for row in mesh.cells_dict["polygon"]), centres, strict=True):
        (x, y), count = (mesh.points[corners, :2] - centre).T, len(corners)
        zero, one = np.zeros(count), np.ones(count)
        columns = np.vstack([np.column_stack([zero, one, -y]), np.column_stack([one, zero, x])])
        values = np.concatenate([moved[corners, 0], moved[corners, 1]])
        motions, *_ = np.linalg.lstsq(columns, values, rcond=None)
        np.testing.assert_allclose(columns @ motions, values, atol=1e-9)
        found.append(motions)
    return found


@pytest.mark.slow_but("nothing", "all at a point")
@pytest.mark.parametrize("kind", list(HOLDS))
def test_bodies_in_the_file_move_as_the_table_says(kind: str, tmp_path: Path) -> None:
    result = he.solve(sea(BARGE, held=HOLDS[kind]))
    result.save(tmp_path / "barge", images=None)
    (motions,) = rigid_motions(tmp_path / "barge" / "fields" / "response_1_bodies.vtu", [(0.0, 2.0)])
    table = amplitudes(result)
    assert np.abs(motions - table).max() < SAME * np.abs(table).max()
    if kind != "nothing":
        assert np.abs(free_motions() - table).max() > 30.0 * SAME * np.abs(table).max()


def test_bodies_that_hold_each_other_move_in_the_file_as_the_table_says(tmp_path: Path) -> None:
    held = [{"body": 1, "to": 2, "at": [25.0, 0.0], "stiffness": [0.0, 1e5, 0.0], "quadratic_damping": [3e5, 3e5, 0.0]}]
    result = he.solve(sea(BARGE, RAFT, held=held))
    result.save(tmp_path / "both", images=None)
    found = rigid_motions(tmp_path / "both" / "fields" / "response_1_bodies.vtu", [(0.0, 2.0), (40.0, 0.0)])
    table = amplitudes(result)
    assert np.abs(np.concatenate(found) - table).max() < SAME * np.abs(table).max()


@pytest.mark.parametrize(
    ("body", "drag"), [(BARGE, [2e5, 3e5, 2e7]), (CYLINDER, [2e5, 3e5, 1e7])], ids=["section", "solid"]
)
def test_quadratic_damping_is_that_of_the_amplitude_in_the_table(body: dict[str, Any], drag: list[float]) -> None:
    """b = 8/(3π) β ω A |a|, with the motion a that the table has, as linear damping gives the same motions."""
    table = amplitudes(he.solve(sea(body, held=[{"quadratic_damping": drag}])))
    linear = 8.0 / (3.0 * math.pi) * OMEGA * AMPLITUDE * np.array(drag) * np.abs(table)
    same = amplitudes(he.solve(sea(body, held=[{"damping": linear.tolist()}])))
    # The iteration for the damping ends at 1e-12 of it.
    np.testing.assert_allclose(table, same, rtol=1e-9)


@pytest.mark.slow
def test_waves_around_a_solid_are_drawn_as_it_moves_with_quadratic_damping() -> None:
    drag = [2e5, 3e5, 0.0]
    result = he.solve(sea(CYLINDER, held=[{"quadratic_damping": drag}], tolerance=1e-2))
    linear = 8.0 / (3.0 * math.pi) * OMEGA * AMPLITUDE * np.array(drag) * np.abs(amplitudes(result))
    same = he.solve(sea(CYLINDER, held=[{"damping": linear.tolist()}], tolerance=1e-2))
    free = he.solve(sea(CYLINDER, held=[], tolerance=1e-2))
    drawn = [np.asarray(Image.open(io.BytesIO(one.pictures["view_response_1"])), float) for one in (result, same, free)]
    changed = np.abs(drawn[0] - drawn[2]).mean()
    # Measured 1e-5 of what damping changes: the table and the wider basin of the picture differ a little.
    assert np.abs(drawn[0] - drawn[1]).mean() < 1e-2 * changed
