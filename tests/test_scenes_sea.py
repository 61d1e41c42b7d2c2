"""Scenes of the sea: open water without a drawn length, and floats by draught, centre of gravity and inertia."""

import re
from typing import Any

import numpy as np
import pytest
from mpi4py import MPI

from hydroelastic.output.open_water.bodies import bodies_at_rest
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models import SeaScene, TankScene
from hydroelastic.scenes.open_water.solve import solve_open

WATER = [{"density": 1000.0, "depth": 3.0}]
BARGE: dict[str, Any] = {
    "kind": "float",
    "shape": "rectangle",
    "half_width": 1.0,
    "half_height": 0.5,
    "motions": ["heave", "sway", "roll"],
}
SPAR = {"kind": "float", "shape": "cylinder", "radius": 1.0, "draught": 2.0, "motions": ["pitch"]}
DISC = {"kind": "plate", "outline": "disc", "radius": 5.0, "flexural_rigidity": 1e6, "mass_per_area": 100.0}
SEAWAY = {"kind": "spectrum", "significant_height": 1.0, "peak_period": 5.0}


def sea(body: dict[str, Any], **keys: Any) -> SeaScene:
    response = {"kind": "response", "omega": [2.0], "positions": 3}
    return SeaScene(liquid=WATER, body=[body], analysis=[response], accuracy={"tolerance": 1e-3}, **keys)


def test_the_sea_is_open_water_whose_origin_is_at_the_body() -> None:
    tank = TankScene(
        tank={"length": 9.0, "ends": "open"},
        liquid=WATER,
        body=[BARGE | {"position": 4.0}],
        analysis=[{"kind": "response", "omega": [2.0]}],
        accuracy={"tolerance": 1e-3},
    )
    (theirs,) = solve_open(tank, MPI.COMM_WORLD, lambda _message: None).response
    (ours,) = solve_open(sea(BARGE), MPI.COMM_WORLD, lambda _message: None).response
    shift = np.exp(1j * ours.wavenumbers * 4.0)
    # The same mesh moved: rounding.
    assert ours.amplitudes[0, 0] * shift[0] == pytest.approx(theirs.amplitudes[0, 0], rel=1e-9)


def test_phases_are_told_about_any_point() -> None:
    (at_body,) = solve_open(sea(BARGE), MPI.COMM_WORLD, lambda _message: None).response
    (elsewhere,) = solve_open(sea(BARGE, sea={"phase_at": -7.0}), MPI.COMM_WORLD, lambda _message: None).response
    # A crest that was at x = −7 at t = 0 comes later at the body.
    shift = np.exp(1j * at_body.wavenumbers[0, 0] * 7.0)
    assert elsewhere.amplitudes[0, 0] == pytest.approx(at_body.amplitudes[0, 0] * shift, rel=1e-12)
    assert elsewhere.transmission == pytest.approx(at_body.transmission, rel=1e-12)


def test_draught_centre_of_gravity_and_inertia_stand_for_mass_height_and_radius() -> None:
    mass, radius = 1000.0 * 2.0 * 0.7, 0.6
    by_draught = sea(BARGE | {"draught": 0.7, "vertical_centre_of_gravity": -0.1, "inertia": mass * radius**2})
    by_mass = sea(BARGE | {"mass": mass, "centre_of_mass": 0.1, "radius_of_gyration": radius})
    both = sea(
        BARGE
        | {"mass": mass, "centre_of_mass": 0.1, "radius_of_gyration": radius}
        | {"draught": 0.7, "vertical_centre_of_gravity": -0.1, "inertia": mass * radius**2}
    )
    from hydroelastic.scenes.models.physical import physical_tank

    for scene in (by_draught, by_mass, both):
        (rest,) = bodies_at_rest(physical_tank(scene))
        assert (rest.mass, rest.draught) == (pytest.approx(mass), pytest.approx(0.7))
        assert rest.centre_of_gravity == (0.0, pytest.approx(-0.1))
        assert rest.radius_of_gyration == pytest.approx(radius)
        # GM = I/V + KB − KG of a box.
        assert rest.metacentric_height == pytest.approx(8.0 / 12.0 / 1.4 - 0.35 + 0.1)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"mass": 1400.0, "draught": 0.6}, "it contradicts mass, with which it is 0.7"),
        ({"draught": 1.1}, "the section is 1 m high"),
        ({"centre_of_mass": 0.0, "vertical_centre_of_gravity": 0.2}, "it contradicts centre_of_mass"),
        ({"radius_of_gyration": 0.5, "inertia": 300.0}, "it contradicts radius_of_gyration, with which it is 250"),
        ({"vertical_centre_of_gravity": 3.0}, "the float capsizes"),
    ],
)
def test_contradictions_are_refused(keys: dict[str, float], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        sea(BARGE | keys)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"liquid": [{"density": 1000.0}]}, "depth of the layer, m; inf in open water alone"),
        ({"body": [BARGE | {"vertical_centre_of_gravity": 3.0}]}, r"3 m above the still level.*a vertical_centre_of"),
        ({"body": [SPAR]}, r"above the still level.*a vertical_centre_of_gravity of at most -0.875 m"),
        ({"attachment": [{"stiffness": [[1.0, 2.0, 3.0], 4.0]}]}, "entry 2 = 4.0: it is not a list. Allowed: a list"),
        ({"body": [DISC], "attachment": [{"at": [0.0, 0.0], "stiffness": [1.0, 1.0, 0.0]}]}, "a plate does not surge"),
        ({"body": [DISC], "analysis": [{"kind": "decay", "displacement": 1.0, "times": [1.0]}]}, "is a plate, and"),
        ({"body": [DISC], "analysis": [SEAWAY | {"points": [{"at": [9.0, 0.0]}]}]}, "not lie on the plate"),
    ],
)
def test_messages_tell_what_the_sea_has(keys: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=message) as error:
        SeaScene(**{"liquid": WATER, "body": [BARGE]} | keys)
    assert not re.search(r"\btank\b|\bends\b|\bwalls\b", str(error.value))


def test_what_is_drawn_contains_the_bodies_unless_it_is_given() -> None:
    beam = {"length": 4.0, "flexural_rigidity": 1e4, "mass_per_length": 10.0}
    assert sea(beam).stretch == (-6.0, 10.0)
    assert sea(beam, sea={"drawn": [-30.0, 20.0]}).stretch == (-30.0, 20.0)
    with pytest.raises(SceneError, match="from left to right"):
        sea(beam, sea={"drawn": [20.0, -30.0]})
