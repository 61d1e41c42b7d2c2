"""Moorings that pull a float down or hold it up: `vertical_force` closes the balance of mass and displacement."""

import math
from typing import Any

import numpy as np
import pytest

import hydroelastic as he

DENSITY, GRAVITY = 1025.0, 9.80665
RADIUS, DRAUGHT, CENTRE = 9.0, 47.89, -32.8
MASS, INERTIA = 8.6e6, 5.7e8
TENDONS = np.diag([4e8, 2e5, 3e9])
VOLUME = math.pi * RADIUS**2 * DRAUGHT
FORCE = (MASS - DENSITY * VOLUME) * GRAVITY
"""Upwards, of the tendons on the leg: they pull down."""

LEG: dict[str, Any] = {
    "kind": "float",
    "shape": "cylinder",
    "radius": RADIUS,
    "draught": DRAUGHT,
    "mass": MASS,
    "vertical_centre_of_gravity": CENTRE,
    "inertia": INERTIA,
    "motions": ["heave", "surge", "pitch"],
}
BOX = {
    "kind": "float",
    "shape": "rectangle",
    "half_width": 2.0,
    "half_height": 1.0,
    "draught": 1.2,
    "vertical_centre_of_gravity": 0.1,
    "motions": ["heave", "sway", "roll"],
}


def sea(body: dict[str, Any], *analyses: dict[str, Any], **keys: Any) -> dict[str, Any]:
    water = {"sea": {"gravity": GRAVITY}, "liquid": [{"density": DENSITY, "depth": 200.0}]}
    asked = list(analyses) or [{"kind": "radiation", "omega": [1.0]}]
    return {"kind": "sea", **water, "body": [body], "analysis": asked, "accuracy": {"tolerance": 1e-2}, **keys}


def refused(body: dict[str, Any]) -> str:
    with pytest.raises(he.SceneError) as error:
        he.read(sea(body))
    return str(error.value)


def test_a_tension_leg_moves_by_its_own_mass_and_the_stiffness_of_what_it_displaces() -> None:
    omegas = [0.4, 0.6]
    moored = {"body": 1, "at": [0.0, -DRAUGHT], "stiffness": TENDONS.diagonal().tolist()}
    radiation, response = ({"kind": kind, "omega": omegas} for kind in ("radiation", "response"))
    scene = sea(LEG | {"vertical_force": FORCE}, radiation, response, attachment=[moored])
    result = he.solve(scene)
    (rest,), water = result.summary["bodies"], result.dataset
    assert (rest["mass"], rest["draught"]) == (pytest.approx(MASS), pytest.approx(DRAUGHT))
    # Of a constant vertical force at G the moment about G stays zero, as that of the weight: ρgV, not mg, restores.
    area, second = math.pi * RADIUS**2, math.pi * RADIUS**4 / 4.0
    pitch = DENSITY * GRAVITY * (second + VOLUME * (-0.5 * DRAUGHT - CENTRE))
    # Heave, surge and pitch of the keel by those of G; pitch lifts the side of x > 0.
    path = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, CENTRE + DRAUGHT], [0.0, 0.0, 1.0]])
    stiffness = np.diag([DENSITY * GRAVITY * area, 0.0, pitch]) + path.T @ TENDONS @ path
    hydrodynamic = water.added_mass + 1j / water.omega * water.radiation_damping
    force, motion = (
        water[name].isel(complex=0) + 1j * water[name].isel(complex=1) for name in ("excitation_force", "RAO")
    )
    order = ["Heave", "Surge", "Pitch"]
    for omega in omegas:
        liquid = hydrodynamic.sel(omega=omega, radiating_dof=order, influenced_dof=order).values
        dynamic = stiffness - omega**2 * (np.diag([MASS, MASS, INERTIA]) + liquid)
        pushed = force.sel(omega=omega, influenced_dof=order, wave_direction=0.0).values
        found = motion.sel(omega=omega, radiating_dof=order, wave_direction=0.0).values.ravel()
        # Both analyses have one mesh, but bases of their own: within the error of 1e-2 that is asked for, by far.
        assert found == pytest.approx(np.linalg.solve(dynamic, pushed), rel=1e-3)


def righting_moment(angle: float) -> float:
    """Moment of buoyancy about G of the box, turned about G by an angle, N: pressures by points along its sides."""
    half, low, high, centre = 2.0, -1.2, 0.8, 0.1
    corners = np.array([[-half, low], [half, low], [half, high], [-half, high]]) - [0.0, centre]
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    moment = 0.0
    for start, end in zip(corners @ turn.T, np.roll(corners, -1, axis=0) @ turn.T, strict=True):
        middles = (np.arange(20000) + 0.5) / 20000
        x, y = start[:, None] + np.outer(end - start, middles)
        pressure = DENSITY * GRAVITY * np.maximum(-(y + centre), 0.0)
        inwards = np.array([-(end - start)[1], (end - start)[0]])
        moment += float(np.mean(pressure * (x * inwards[1] - y * inwards[0])))
    return moment


@pytest.mark.parametrize("force", [-1.5e4, 0.0, 8e3])
def test_a_section_rolls_by_the_pressures_on_it_alone(force: float) -> None:
    (rest,) = he.solve(sea(BOX | {"vertical_force": force})).summary["bodies"]
    displaced = DENSITY * 4.0 * 1.2
    assert rest["mass"] == pytest.approx(displaced + force / GRAVITY)
    # Central difference, 1e-3² times the third derivative, and 20000 points a side: below 1e-5.
    stiffness = -(righting_moment(1e-3) - righting_moment(-1e-3)) / 2e-3
    assert rest["roll_stiffness"] == pytest.approx(stiffness, rel=1e-5)
    assert rest["metacentric_height"] == pytest.approx(rest["roll_stiffness"] / (displaced * GRAVITY))


def test_two_of_mass_draught_and_force_tell_the_third() -> None:
    by_mass = BOX | {"mass": DENSITY * 4.8 - 1000.0, "vertical_force": -1000.0 * GRAVITY}
    by_mass.pop("draught")
    (rest,) = he.solve(sea(by_mass)).summary["bodies"]
    assert rest["draught"] == pytest.approx(1.2)


def test_a_contradiction_names_the_newtons_that_close_it() -> None:
    message = refused(LEG)
    assert '"draught" = 47.89: it contradicts mass' in message
    assert f"vertical_force = {FORCE:.6g} N" in message
    sinking = refused(LEG | {"mass": 1e9, "draught": 20.0, "shape": "sphere", "radius": 12.0})
    assert "sinks" in sinking
    assert "vertical_force = " in sinking
    assert f"vertical_force = {-2000.0 * GRAVITY:.6g} N/m" in refused(BOX | {"mass": DENSITY * 4.8 - 2000.0})
    assert "vertical_force" in refused(BOX | {"vertical_force": -1e6})
