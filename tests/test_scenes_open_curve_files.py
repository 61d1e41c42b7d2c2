"""The dense curves of responses are written, with the error of the reduced basis that they come from."""

import csv
from pathlib import Path
from typing import Any

import numpy as np
from mpi4py import MPI

from hydroelastic.output.open_water.files import write_open_csv
from hydroelastic.scenes.models import SeaScene
from hydroelastic.scenes.open_water.results import OpenSolution
from hydroelastic.scenes.open_water.solve import solve_open

TOLERANCE = 1e-2
BODY: dict[str, Any] = {
    "kind": "float",
    "shape": "rectangle",
    "half_width": 10.0,
    "half_height": 4.0,
    "draught": 4.0,
    "vertical_centre_of_gravity": 1.0,
    "radius_of_gyration": 7.0,
    "motions": ["heave", "roll"],
}


def solved(omegas: list[float]) -> OpenSolution:
    scene = SeaScene(
        liquid=[{"density": 1025.0, "depth": 30.0}],
        body=[BODY],
        analysis=[{"kind": "response", "omega": omegas}],
        accuracy={"tolerance": TOLERANCE},
    )
    return solve_open(scene, MPI.COMM_WORLD, lambda _message: None)


def columns(path: Path, *names: str) -> list[np.ndarray]:
    with path.open(encoding="utf-8", newline="") as lines:
        rows = list(csv.DictReader(lines))
    return [np.array([float(row[name]) for row in rows]) for name in names]


def test_the_curve_has_the_peak_that_few_frequencies_miss(tmp_path: Path) -> None:
    write_open_csv(solved(np.linspace(0.5, 1.2, 8).tolist()), tmp_path)
    asked, real, imaginary = columns(tmp_path / "response.csv", "omega", "re_roll", "im_roll")
    few = real + 1j * imaginary
    names = ("omega", "re_roll", "im_roll", "basis_error")
    omega, real, imaginary, error = columns(tmp_path / "response_curve.csv", *names)
    dense = real + 1j * imaginary
    places = np.searchsorted(omega, asked)
    np.testing.assert_array_equal(omega[places], asked)
    np.testing.assert_array_equal(dense[places], few)
    peak = int(np.abs(dense).argmax())
    assert abs(dense[peak]) > 1.5 * np.abs(few).max()
    assert error.max() < TOLERANCE
    # Solved for itself, on a mesh of its own: each has the tolerance.
    there = solved([float(omega[peak])]).response[0].amplitudes[0, 0, 1]
    assert abs(dense[peak] - there) < 2.0 * TOLERANCE * abs(there)
