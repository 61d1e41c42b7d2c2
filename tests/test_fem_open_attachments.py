"""Springs, dampers and drag from outside: against closed forms, integration in time, and the balance of energy."""

from typing import Any

import numpy as np
import pytest
from float_scenes import BARGE
from mpi4py import MPI
from open_cases import problem_of
from scipy.integrate import solve_ivp
from scipy.optimize import newton

from hydroelastic.fem.open_water.basin import open_basin
from hydroelastic.fem.open_water.decay import solve_decay
from hydroelastic.fem.open_water.motion_scale import motion_scale
from hydroelastic.fem.open_water.outside import outside_of
from hydroelastic.fem.open_water.radiation import solve_radiation
from hydroelastic.fem.open_water.requests import DecayRequest, RadiationRequest, ResonanceRequest
from hydroelastic.fem.open_water.resonance import solve_resonance
from hydroelastic.fem.open_water.results import ResponseTable
from hydroelastic.fem.open_water.solve import resonance_reasons
from hydroelastic.fem.tank.field_model import whole_bodies
from hydroelastic.modal.floats.thin_float import thin_float_mass, thin_float_stiffness
from hydroelastic.modal.floats.thin_float_radiation import complex_added_mass
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.profiles import float_profile
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models import SeaScene
from hydroelastic.scenes.open_water.solve import solve_open

DEEP = [{"density": 1000.0, "depth": float("inf")}]
THIN = {"kind": "float", "shape": "parabola", "half_width": 0.1, "half_height": 1.0, "boundary": "thin"}
PROFILE = float_profile("parabola", 0.1, 1.0)
LAYERS = TwoLayers(
    density_below=1000.0, density_above=0.0, depth_below=np.inf, depth_above=np.inf, gravity=9.81, top="free"
)


def sea(body: dict[str, Any], *attachments: dict[str, Any], tolerance: float = 1e-4, **keys: Any) -> SeaScene:
    accuracy = {"tolerance": tolerance}
    return SeaScene(liquid=DEEP, body=[body], attachment=list(attachments), accuracy=accuracy, **keys)


def response(
    body: dict[str, Any], *attachments: dict[str, Any], tolerance: float = 1e-4, **asked: Any
) -> ResponseTable:
    scene = sea(body, *attachments, tolerance=tolerance, analysis=[{"kind": "response", **asked}])
    solution = solve_open(scene, MPI.COMM_WORLD, lambda _message: None)
    assert solution.status == "ok", solution.reasons
    (table,) = solution.response
    return table


def held(stiffness: float, damping: float) -> tuple[float, Any]:
    """Mass of the thin float, and p ↦ c + k + pB + p²(m + H)."""
    mass = thin_float_mass(PROFILE, 1000.0, 0.0)
    restoring = thin_float_stiffness(PROFILE, 1000.0, 0.0, 9.81) + stiffness
    return restoring, lambda p: restoring + p * damping + p**2 * (mass + complex_added_mass(PROFILE, LAYERS, p))


@pytest.mark.parametrize(("stiffness", "damping"), [(-500.0, 60.0), pytest.param(3000.0, 0.0, marks=pytest.mark.slow)])
def test_resonance_with_a_spring_and_a_damper(stiffness: float, damping: float) -> None:
    held_thin = {"stiffness": [stiffness, 0.0, 0.0], "damping": [damping, 0.0, 0.0]}
    found = solve_resonance(problem_of(sea(THIN, held_thin)), ResonanceRequest(count=1))
    _, dynamic = held(stiffness, damping)
    exact = 1j * newton(lambda p: complex(dynamic(p)), -1j * found.table.omega[0], tol=1e-13)
    assert abs(found.table.omega[0] / exact - 1.0) <= 2.0 * found.table.relative_error[0] <= 2e-4
    assert not list(resonance_reasons(found))


@pytest.mark.slow
def test_motion_after_a_release_with_a_spring_and_a_damper() -> None:
    stiffness, damping = 1500.0, 100.0
    held_thin = {"stiffness": [stiffness, 0.0, 0.0], "damping": [damping, 0.0, 0.0]}
    times = (0.3, 1.0, 2.0, 4.0)
    found = solve_decay(problem_of(sea(THIN, held_thin, tolerance=1e-3)), DecayRequest(heave=1.0, times=times)).table
    restoring, dynamic = held(stiffness, damping)
    # f = (2/π) ∫ Re F cos ωt dω with F = (1 − c/D)/p, whose tail goes like ω⁻⁴ and is left out beyond ω = 200 √c.
    omegas = np.linspace(1e-6, 2000.0, 400_001)
    transform = ((1.0 - restoring / dynamic(-1j * omegas)) / (-1j * omegas)).real
    exact = [2.0 / np.pi * np.trapezoid(transform * np.cos(omegas * time), omegas) for time in times]
    assert np.abs(found.displacement[:, 0] - exact).max() <= 1e-3


@pytest.mark.parametrize("elevation", [0.02, pytest.param(0.1, marks=pytest.mark.slow), 0.3])
def test_roll_with_drag_is_that_of_an_integration_in_time(elevation: float) -> None:
    linear, drag, omega = 60.0, 4000.0, 2.2
    body = BARGE | {"motions": ["roll"]}
    damper = {"damping": [0.0, 0.0, linear], "quadratic_damping": [0.0, 0.0, drag]}
    table = response(body, damper, omega=[omega], wave_amplitude=elevation)
    water = solve_radiation(problem_of(sea(body)), RadiationRequest(omega=(omega,))).table
    inertia = float((water.inertia + water.added_mass)[0, 0, 0])
    waves, restoring = float(water.radiation_damping[0, 0, 0]) + linear, float(water.stiffness[0, 0])
    force = elevation * complex(water.excitation_force[0, 0, 0, 0])

    def rates(time: float, state: np.ndarray) -> list[float]:
        pushed = (force * np.exp(-1j * omega * time)).real
        return [
            state[1],
            (pushed - waves * state[1] - drag * abs(state[1]) * state[1] - restoring * state[0]) / inertia,
        ]

    period = 2.0 * np.pi / omega
    end = 120.0 * period
    times = np.linspace(end - period, end, 257)
    path = solve_ivp(rates, (0.0, end), [0.0, 0.0], t_eval=times, rtol=1e-9, atol=1e-12).y[0]
    first = 2.0 / period * np.trapezoid(path * np.exp(1j * omega * times), times)
    undamped = abs(response(body, omega=[omega]).amplitudes[0, 0, 0])
    # The third harmonic of drag, which the linear damping leaves out, moves the first by its square: 1 % here.
    assert table.amplitudes[0, 0, 0] == pytest.approx(first / elevation, rel=1e-2)
    assert abs(table.amplitudes[0, 0, 0]) < 0.98 * undamped


def test_linear_damping_does_not_depend_on_the_height_of_the_wave() -> None:
    by_drag = [response(BARGE, {"damping": [9.0, 7.0, 60.0]}, omega=[2.2], wave_amplitude=own) for own in (0.1, 5.0)]
    assert by_drag[0].amplitudes == pytest.approx(by_drag[1].amplitudes, rel=1e-14)


def test_the_energy_balance_holds_with_all_of_it_and_damping_only_takes_power() -> None:
    moorings = [
        {"at": [-1.0, -0.5], "stiffness": [[400.0, 100.0, 0.0], [100.0, 900.0, 0.0], [0.0, 0.0, 0.0]]},
        {"at": [1.0, 0.3], "damping": [50.0, 80.0, 3.0], "quadratic_damping": [100.0, 200.0, 900.0]},
    ]
    for side in ("left", "right"):
        table = response(BARGE, *moorings, omega=np.linspace(1.0, 4.0, 9).tolist(), wave_amplitude=0.2, waves_from=side)
        assert np.abs(table.energy_residual).max() <= 1e-5
        assert np.all(table.absorption > 0.0)
        assert np.all(np.abs(table.reflection) ** 2 + np.abs(table.transmission) ** 2 < 1.0)


def test_a_stiff_spring_holds_a_beam_where_it_is() -> None:
    beam = {"length": 4.0, "flexural_rigidity": 1e4, "mass_per_length": 50.0}
    # So stiff a spring makes errors of the deflection ten times as large.
    asked: dict[str, Any] = {"omega": [2.5], "positions": 5, "tolerance": 1e-3}
    free, sprung = (
        response(beam, *springs, **asked).plates[0].deflection[0, 0]
        for springs in ([], [{"at": [1.0, 0.0], "stiffness": [1e9, 0.0, 0.0]}])
    )
    assert abs(free[1]) > 0.1
    assert abs(sprung[1]) < 1e-4
    assert abs(sprung[3]) > 0.1


def test_what_a_spring_bends_beyond_the_dry_modes_is_in_the_error() -> None:
    beam = {"length": 4.0, "flexural_rigidity": 1e4, "mass_per_length": 50.0}
    spring = {"at": [1.0, 0.0], "stiffness": [1e6, 0.0, 0.0]}
    rough, fine = (
        response(beam, spring, omega=[2.5], positions=9, tolerance=tolerance).plates[0] for tolerance in (1e-2, 1e-3)
    )
    missed = np.abs(rough.deflection - fine.deflection).max()
    # Measured 1.3; without the force of the spring 0.6.
    assert missed < rough.deflection_error[0, 0] < 10.0 * missed


def test_forces_and_moments_of_springs_dampers_and_drag_act_on_a_beam() -> None:
    beam = {"length": 4.0, "flexural_rigidity": 1e4, "mass_per_length": 50.0}
    held = {"stiffness": [3e3, 0.0, 9e3], "damping": [2e3, 0.0, 7e3], "quadratic_damping": [5e3, 0.0, 4e4]}
    asked: dict[str, Any] = {"omega": [2.5], "positions": 41, "wave_amplitude": 0.2, "tolerance": 5e-2}
    plate = response(beam, {"at": [0.5, 0.0]} | held, **asked).plates[0]
    # Heave and pitch are in equilibrium, so that nothing is left at the right end but rounding.
    for load in (plate.shear_force[0, 0], plate.bending_moment[0, 0]):
        assert abs(load[-1]) <= 1e-9 * np.abs(load).max()


def test_a_spring_between_two_bodies_moves_them_together() -> None:
    one, other = (BARGE | {"position": x, "motions": ["sway"]} for x in (-2.0, 2.0))
    scene = SeaScene(
        liquid=DEEP,
        body=[one, other],
        attachment=[{"body": 1, "to": 2, "stiffness": [0.0, 1e9, 0.0]}],
        analysis=[{"kind": "response", "omega": [2.0]}],
        accuracy={"tolerance": 1e-3},
    )
    (table,) = solve_open(scene, MPI.COMM_WORLD, lambda _message: None).response
    first, second = table.amplitudes[0, 0]
    assert abs(first) > 0.1
    assert first == pytest.approx(second, rel=1e-4)


@pytest.mark.parametrize("body", [BARGE, {"kind": "float", "shape": "cylinder", "radius": 3.0, "draught": 1.0}])
def test_motions_over_time_have_the_given_spring_damper_and_drag(body: dict[str, Any]) -> None:
    """The basin has units of its own, per metre of width or whole, that must not be seen in SI units."""
    given = {"stiffness": [7.0, 0.0, 0.0], "damping": [5.0, 0.0, 0.0], "quadratic_damping": [3.0, 0.0, 0.0]}
    asked = {"kind": "response", "omega": [1.0], "wave_amplitude": 0.1}
    water = problem_of(sea(body | {"motions": ["heave"]}, given, analysis=[asked])).tank
    basin = open_basin(water, 0.0)
    assert basin.units.length > 1.0
    bodies = whole_bodies(basin.tank, (0,))
    found = motion_scale(basin, bodies).outside(outside_of(basin, bodies, water.attachments))
    # Of heave at 1 m/s; rounding of powers of a length.
    moved = [found.stiffness[0, 0], found.damping[0, 0], found.drag[0] * abs(found.paths[0, 0]) ** 3]
    assert moved == pytest.approx([7.0, 5.0, 3.0], rel=1e-12)


@pytest.mark.parametrize(
    ("attachment", "message"),
    [
        ({"damping": [[1.0, 2.0, 0.0], [2.0, 1.0, 0.0], [0.0, 0.0, 0.0]]}, "it adds power"),
        ({"damping": [-1.0, 0.0, 0.0]}, "it adds power"),
        ({"stiffness": [[1.0, 2.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]]}, "it is not symmetric"),
        ({"body": 2, "stiffness": [1.0, 0.0, 0.0]}, "there is no body of that number"),
        ({}, "it has no force"),
        ({"stiffness": [-1e9, 0.0, 0.0]}, "its springs push the float away from its rest"),
        ({"to": 1, "stiffness": [1.0, 0.0, 0.0]}, "both ends hold the same body"),
        ({"quadratic_damping": [1.0, 0.0, 0.0]}, "is not a sum of exponentials"),
    ],
)
def test_what_cannot_hold_a_body_is_refused(attachment: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        sea(BARGE, attachment)
