"""Motions that are larger than linear theory allows are told, whatever analysis and body they are of."""

from __future__ import annotations

from math import atan, pi
from typing import Any

import pytest
from mpi4py import MPI

from hydroelastic.output.open_water.linear_limits import beyond_linear_theory
from hydroelastic.output.sections import Section
from hydroelastic.physics.linear_limits import linear_limits
from hydroelastic.scenes.models import SeaScene
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.open_water.solve import solve_open

BARGE: dict[str, Any] = {
    "kind": "float",
    "shape": "rectangle",
    "half_width": 10.0,
    "half_height": 3.0,
    "draught": 4.0,
    "vertical_centre_of_gravity": 1.0,
    "radius_of_gyration": 7.0,
    "motions": ["heave", "roll"],
}
BUOY: dict[str, Any] = {"kind": "float", "shape": "cylinder", "radius": 2.0, "draught": 4.0}
RING: dict[str, Any] = {
    "kind": "float",
    "shape": "revolved",
    "outline": [[4.0, -2.0], [6.0, -2.0], [6.0, 1.5], [4.0, 1.5]],
}


def scene_of(body: dict[str, Any], *analyses: dict[str, Any]) -> SeaScene:
    return SeaScene(
        liquid=[{"density": 1000.0, "depth": 30.0}], body=[body], analysis=analyses, accuracy={"tolerance": 5e-2}
    )


def told(*analyses: dict[str, Any]) -> tuple[Section, ...]:
    solution = solve_open(scene_of(BARGE, *analyses), MPI.COMM_WORLD, lambda _message: None)
    return tuple(beyond_linear_theory(solution))


@pytest.mark.parametrize(
    ("body", "heave", "reached", "roll"),
    [
        (BARGE, 2.0, "freeboard", atan(0.2)),
        (BARGE | {"draught": 2.0}, 2.0, "draught", atan(0.2)),
        (BUOY, 4.0, "draught", pi / 6.0),
        (BUOY | {"draught": 0.8}, 0.8, "draught", atan(0.4)),
        (RING, 1.5, "freeboard", atan(0.25)),
    ],
)
def test_limits_are_those_of_the_upright_section(body: dict[str, Any], heave: float, reached: str, roll: float) -> None:
    tank = physical_tank(scene_of(body))
    limits = linear_limits(tank.floats[0], is_revolved=tank.geometry.is_revolved)
    # Levels are found by iterations.
    assert limits.heave == pytest.approx(heave, rel=1e-9)
    assert limits.reached == reached
    assert limits.roll == pytest.approx(roll, rel=1e-9)


def test_motions_beyond_them_are_told_by_analysis() -> None:
    """Heave of long waves is about as large as these, and the section's freeboard is 2 m."""
    (section,) = told(
        {"kind": "response", "omega": [0.5], "wave_amplitude": 1.5},
        {"kind": "response", "omega": [0.5], "wave_amplitude": 2.5},
        {"kind": "response", "omega": [0.5]},
        {"kind": "spectrum", "significant_height": 0.5, "peak_period": 14.0},
        {"kind": "spectrum", "significant_height": 6.0, "peak_period": 14.0},
    )
    found = [row[:2] for row in section.rows]
    assert ("response 2, largest amplitude", "heave") in found
    assert ("spectrum 2, significant amplitude", "heave") in found
    assert not any(name.startswith(("response 1", "response 3", "spectrum 1")) for name, _ in found)


@pytest.mark.slow
def test_motions_over_time_beyond_them_are_told() -> None:
    """Waves as long, which grow to 2.5 m, and releases at an angle beyond that at which the deck edge dips, 0.197."""
    times = {"start": 0.0, "stop": 60.0, "number": 31}
    (section,) = told(
        {"kind": "motion", "waves": [{"omega": 0.5, "amplitude": 2.5}], "times": times, "ramp": 20.0},
        {"kind": "motion", "displacement": {"roll": 0.3}, "times": times},
        {"kind": "decay", "displacement": {"roll": 0.3}, "times": times},
    )
    found = [row[:2] for row in section.rows]
    assert {("motion 1, largest", "heave"), ("motion 2, largest", "roll"), ("decay 1, largest", "roll")} <= set(found)
