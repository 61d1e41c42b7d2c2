"""Floats of closed tanks on springs, without waves: ω² = (c + k)/(m + a) of each motion, and of coupled ones."""

from typing import Any

import numpy as np
import pytest
from scipy.linalg import eigh
from tanks import Tanks

from hydroelastic.fem.tank.solve import TankSolution
from hydroelastic.output.tank.records import float_values
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models import TankScene
from hydroelastic.scenes.models.physical import physical_tank

POINT = (1.2, 0.6)
STIFFNESS = [4e4, 1.5e4, 2e3]


def scene(attachments: list[dict[str, Any]]) -> TankScene:
    """A rectangle in the middle of a tank whose top has no waves: the liquid's inertia does not depend on frequency."""
    return TankScene(
        tank={"length": 8.0, "top": "pressure_release"},
        liquid=[{"density": 1000.0, "depth": 3.0}],
        body=[
            {
                "kind": "float",
                "shape": "rectangle",
                "half_width": 1.0,
                "half_height": 0.5,
                "draught": 0.5,
                "position": 4.0,
                "vertical_centre_of_gravity": -0.1,
                "radius_of_gyration": 0.6,
                "motions": ["heave", "sway", "roll"],
            }
        ],
        attachment=attachments,
        accuracy={"tolerance": 1e-3, "modes": 3},
    )


def squares(solution: TankSolution) -> np.ndarray:
    """Dimensionless ω² of the modes that were asked for."""
    return np.array([mode.eigenvalue for mode in solution.asked])


def test_masses_of_float_modes_are_those_that_their_frequencies_balance(tanks: Tanks) -> None:
    """(m + a) ω² = c33 of heave and (I + a) ω² = c55 of roll, in SI units of a tank that is not of unit length."""
    found = float_values(tanks.solve(scene([])), 0, None)
    heave, roll = (next(mode for mode in found["modes"] if mode["motion"] == name) for name in ("heave", "roll"))
    whole = found["mass"] + heave["added_mass"], found["moment_of_inertia"] + roll["added_mass"]
    assert whole[0] * heave["omega"] ** 2 == pytest.approx(found["heave_stiffness"], rel=1e-9)
    assert whole[1] * roll["omega"] ** 2 == pytest.approx(found["roll_stiffness"], rel=1e-9)


def test_a_spring_across_that_sway_follows_leaves_the_roll_alone() -> None:
    """Sway without force turns about the point: c55 + ky² − (ky)²/k."""
    held, free = (
        physical_tank(scene(springs)).floats[0].roll_stiffness
        for springs in ([{"at": [4.0, 0.6], "stiffness": [0.0, 1.5e4, 0.0]}], [])
    )
    assert held == pytest.approx(free, rel=1e-12)


def test_springs_add_to_the_stiffness_of_gravity(tanks: Tanks) -> None:
    """The eigenvalues are those of stiffness and inertia with the added mass of the tank without springs."""
    free = tanks.solve(scene([]))
    x, y = POINT
    held = tanks.solve(scene([{"at": [4.0 + x, y], "stiffness": STIFFNESS}]))
    assert free.added_mass is not None
    units, own = free.units, free.tank.floats[0]
    added = free.added_mass.matrix + np.diag(own.inertia)
    # ω² = c/(m + a) of heave and roll, without sway.
    heave = own.hydrostatics.heave_stiffness / added[0, 0]
    assert np.abs(squares(free) - heave).min() < 2e-3 * heave
    # Of the point, in terms of heave, sway and roll about the centre of mass.
    path = np.array([[1.0, 0.0, x], [0.0, 1.0, -(y + 0.1)], [0.0, 0.0, 1.0]])
    arms = np.array([units.length, units.length, 1.0])
    force = units.density * units.gravity * units.length**3
    springs = (path.T @ np.diag(STIFFNESS) @ path) * np.outer(arms, arms) / force
    expected = eigh(own.hydrostatics.stiffness + springs, added, eigvals_only=True)
    # To the tolerance of frequencies, twice in squares, and as much of the added mass.
    assert squares(held)[:3] == pytest.approx(expected, rel=4e-3)
    # Springs matter: sway had none, and the others are raised.
    assert squares(held)[0] > 0.05 * heave
    assert abs(squares(held)[2] / heave - 1.0) > 0.2


@pytest.mark.parametrize(
    ("attachment", "message"),
    [
        ({"damping": [1.0, 0.0, 0.0]}, "real symmetric problem, which has no damping"),
        ({"quadratic_damping": [1.0, 0.0, 0.0]}, "real symmetric problem, which has no damping"),
        ({"to": 2, "stiffness": [1.0, 0.0, 0.0]}, "there is no body of that number"),
        ({"stiffness": [[1.0, 2.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]}, "it is not symmetric"),
    ],
)
def test_what_is_no_spring_is_refused_in_a_closed_tank(attachment: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        scene([attachment])
