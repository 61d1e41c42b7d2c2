"""Phases of motions in waves beside the crest at the body: the same wherever it floats, and known in long waves."""

from math import pi
from typing import Any

import numpy as np
import pytest
from mpi4py import MPI
from open_tables import open_scene

from hydroelastic.output.open_water.quantities import RESPONSE
from hydroelastic.scenes.open_water.solve import solve_open

TOLERANCE = 1e-3
BARGE: dict[str, Any] = {
    "kind": "float",
    "shape": "rectangle",
    "half_width": 0.5,
    "half_height": 0.5,
    "motions": ["heave", "sway", "roll"],
    "centre_of_mass": -0.1,
}


def phases(position: float, omega: float, *, waves_from: str) -> tuple[np.ndarray, np.ndarray]:
    """Phases of heave, sway and roll, degrees, beside the crest at the body and at x = 0."""
    response = {"kind": "response", "omega": [omega], "waves_from": waves_from}
    scene = open_scene(BARGE | {"position": position}, analyses=[response], accuracy={"tolerance": TOLERANCE})
    (table,) = RESPONSE.of(solve_open(scene, MPI.COMM_WORLD, lambda _message: None))
    return np.array(RESPONSE.evaluated(table)["phase_at_body"])[0, 0], np.degrees(np.angle(table.amplitudes[0, 0]))


@pytest.mark.slow_but("left")
@pytest.mark.parametrize("waves_from", ["left", "right"])
def test_a_body_that_is_moved_keeps_its_phases(waves_from: str) -> None:
    # Deep water, k = ω²/g.
    wavelength = 2.0 * pi * 9.81 / 3.0**2
    (first, fixed), (second, moved) = (
        phases(position, 3.0, waves_from=waves_from) for position in (3.0, 3.0 + 0.3 * wavelength)
    )
    # Each time the error is TOLERANCE of the larger of heave and sway, which differ by 2.4; of roll of itself.
    assert first == pytest.approx(second, abs=5.0 * np.degrees(TOLERANCE))
    turned = (moved - fixed + 180.0) % 360.0 - 180.0
    assert turned == pytest.approx(108.0 if waves_from == "left" else -108.0, abs=5.0 * np.degrees(TOLERANCE))


@pytest.mark.parametrize(("waves_from", "sway"), [("left", 90.0), ("right", -90.0)])
def test_in_long_waves_a_body_moves_with_the_water(waves_from: str, sway: float) -> None:
    """The water at a crest is at its highest, and where it was carried from a quarter of a period later."""
    (heave, found, _), _ = phases(4.0, 0.5, waves_from=waves_from)
    assert heave == pytest.approx(0.0, abs=np.degrees(TOLERANCE))
    assert found == pytest.approx(sway, abs=np.degrees(TOLERANCE))
