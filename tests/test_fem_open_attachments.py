"""Springs, dampers and drag from outside: against closed forms, integration in time, and the balance of energy."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from float_scenes import BARGE
from hypothesis import given, settings
from hypothesis import strategies as st
from open_cases import answer, radiation, sea
from scipy.integrate import solve_ivp
from scipy.optimize import newton

import hydroelastic as he
from hydroelastic.modal.floats.thin_float import thin_float_mass, thin_float_stiffness
from hydroelastic.modal.floats.thin_float_radiation import complex_added_mass
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.profiles import float_profile

THIN = {"kind": "float", "shape": "parabola", "half_width": 0.1, "half_height": 1.0, "boundary": "thin"}
PROFILE = float_profile("parabola", 0.1, 1.0)
LAYERS = TwoLayers(
    density_below=1000.0, density_above=0.0, depth_below=np.inf, depth_above=np.inf, gravity=9.81, top="free"
)


def response(
    body: dict[str, Any], *attachments: dict[str, Any], tolerance: float = 1e-4, **asked: Any
) -> SimpleNamespace:
    scene = sea(body, attachment=list(attachments), tolerance=tolerance)
    found = answer(scene, {"kind": "response", **asked})
    assert found.status == "ok", found.summary["reasons"]
    (table,) = found.response
    return table


def held(stiffness: float, damping: float) -> tuple[float, Any]:
    """Mass of the thin float, and p ↦ c + k + pB + p²(m + H)."""
    mass = thin_float_mass(PROFILE, 1000.0, 0.0)
    restoring = thin_float_stiffness(PROFILE, 1000.0, 0.0, 9.81) + stiffness
    return restoring, lambda p: restoring + p * damping + p**2 * (mass + complex_added_mass(PROFILE, LAYERS, p))


@pytest.mark.parametrize(("stiffness", "damping"), [(-500.0, 60.0), pytest.param(3000.0, 0.0, marks=pytest.mark.slow)])
def test_resonance_with_a_spring_and_a_damper(stiffness: float, damping: float) -> None:
    held_thin = {"stiffness": [stiffness, 0.0, 0.0], "damping": [damping, 0.0, 0.0]}
    answered = answer(sea(THIN, attachment=[held_thin], tolerance=1e-4), {"kind": "resonance", "count": 1})
    (found,) = answered.resonance
    _, dynamic = held(stiffness, damping)
    exact = 1j * newton(lambda p: complex(dynamic(p)), -1j * found.omega[0], tol=1e-13)
    assert abs(found.omega[0] / exact - 1.0) <= 2.0 * found.relative_error[0] <= 2e-4
    assert answered.status == "ok"


@pytest.mark.slow
def test_motion_after_a_release_with_a_spring_and_a_damper() -> None:
    stiffness, damping = 1500.0, 100.0
    held_thin = {"stiffness": [stiffness, 0.0, 0.0], "damping": [damping, 0.0, 0.0]}
    times = [0.3, 1.0, 2.0, 4.0]
    scene = sea(THIN, attachment=[held_thin], tolerance=1e-3)
    (found,) = answer(scene, {"kind": "decay", "displacement": 1.0, "times": times}).decay
    restoring, dynamic = held(stiffness, damping)
    # f = (2/π) ∫ Re F cos ωt dω with F = (1 − c/D)/p, whose tail goes like ω⁻⁴ and is left out beyond ω = 200 √c.
    omegas = np.linspace(1e-6, 2000.0, 400_001)
    # In pieces: the theory holds its quadrature at all frequencies at once.
    stiffnesses = np.concatenate([dynamic(piece) for piece in np.array_split(-1j * omegas, 1000)])
    transform = ((1.0 - restoring / stiffnesses) / (-1j * omegas)).real
    exact = [2.0 / np.pi * np.trapezoid(transform * np.cos(omegas * time), omegas) for time in times]
    assert np.abs(found.displacement[:, 0] - exact).max() <= 1e-3


@pytest.mark.parametrize("elevation", [0.02, pytest.param(0.1, marks=pytest.mark.slow), 0.3])
def test_roll_with_drag_is_that_of_an_integration_in_time(elevation: float) -> None:
    linear, drag, omega = 60.0, 4000.0, 2.2
    body = BARGE | {"motions": ["roll"]}
    damper = {"damping": [0.0, 0.0, linear], "quadratic_damping": [0.0, 0.0, drag]}
    table = response(body, damper, omega=[omega], wave_amplitude=elevation)
    water = radiation(sea(body, tolerance=1e-4), omega)
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


@pytest.mark.slow
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
    bodies = [BARGE | {"position": x, "motions": ["sway"]} for x in (-2.0, 2.0)]
    spring = {"body": 1, "to": 2, "stiffness": [0.0, 1e9, 0.0]}
    scene = sea(*bodies, attachment=[spring], tolerance=1e-3)
    (table,) = answer(scene, {"kind": "response", "omega": [2.0]}).response
    first, second = table.amplitudes[0, 0]
    assert abs(first) > 0.1
    assert first == pytest.approx(second, rel=1e-4)


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
    with pytest.raises(he.SceneError, match=message):
        he.read(sea(BARGE, attachment=[attachment], tolerance=1e-4))


FLOAT = {"kind": "float", "shape": "rectangle", "half_width": 1.5, "half_height": 1.0, "position": -4.0}
FLOAT |= {"vertical_centre_of_gravity": 0.1, "radius_of_gyration": 0.9, "motions": ["heave", "sway", "roll"]}
# Stiffness of any sign.
FLOAT |= {"unstable": "solve"}
BEAM = {"start": 0.0, "length": 12.0, "flexural_rigidity": 2e6, "mass_per_length": 300.0}
# A mooring, a fender with a damper and drag between float and beam, a soft rotational spring and a damper on the beam.
ALL = [
    {"body": 1, "at": [-5.0, 0.4], "stiffness": [800.0, 3e3, 0.0], "quadratic_damping": [500.0, 900.0, 2e3]},
    {"body": 1, "to": 2, "at": [0.0, 0.0], "stiffness": [4e3, 0.0, 0.0], "damping": [2e3, 0.0, 0.0]},
    {"body": 2, "at": [7.0, 0.0], "stiffness": [0.0, 0.0, 2e4], "quadratic_damping": [700.0, 0.0, 0.0]},
    {"body": 2, "at": [12.0, 0.0], "damping": [600.0, 0.0, 900.0]},
]


def held_sea(attachments: list[dict[str, Any]], tolerance: float, depth: float = 8.0) -> dict[str, Any]:
    return sea(FLOAT, BEAM, attachment=attachments, tolerance=tolerance, depth=depth, density=1025.0)


@pytest.mark.parametrize(
    ("side", "depth", "tolerance", "omegas"),
    [
        ("left", 8.0, 1e-2, [1.7]),
        pytest.param("right", 8.0, 1e-3, [1.1, 2.2], marks=pytest.mark.slow),
        pytest.param("left", float("inf"), 1e-5, [0.5, 1.0, 1.7, 2.5], marks=pytest.mark.slow),
        pytest.param("right", 2.0, 1e-5, [0.5, 1.0, 1.7, 2.5], marks=pytest.mark.slow),
    ],
)
def test_incoming_power_is_scattered_or_absorbed(
    side: str, depth: float, tolerance: float, omegas: list[float]
) -> None:
    waves = {"kind": "response", "omega": omegas, "waves_from": side, "wave_amplitude": 0.3}
    (table,) = answer(held_sea(ALL, tolerance, depth), waves).response
    outgoing = np.abs(table.reflection[:, 0, 0]) ** 2 + np.abs(table.transmission[:, 0, 0]) ** 2
    # Measured: 2e-5 at the tolerance 1e-2; a tenth more damping than is counted as absorbed leaves 9e-3.
    assert np.abs(outgoing + table.absorption[:, 0] - 1.0).max() < 0.3 * tolerance
    assert np.abs(table.energy_residual).max() < 0.3 * tolerance
    # Dampers and drag are not idle.
    assert np.all(table.absorption > 1e-3)


@pytest.mark.parametrize(
    ("depth", "tolerance", "omegas"),
    [(8.0, 1e-2, [1.7]), pytest.param(float("inf"), 1e-5, [0.5, 1.0, 1.7, 2.5], marks=pytest.mark.slow)],
)
def test_damping_is_radiated_power_and_that_of_the_excitation_forces(
    depth: float, tolerance: float, omegas: list[float]
) -> None:
    asked = {"kind": "radiation", "omega": omegas, "elastic_modes": 3}
    (table,) = answer(held_sea(ALL, tolerance, depth), asked).radiation
    # Measured: 9e-6 at the tolerance 1e-2.
    assert np.abs(table.energy_residual).max() < 0.3 * tolerance
    assert np.abs(table.haskind_residual).max() < 0.3 * tolerance
    for row, omega in enumerate(omegas):
        damping, forces = table.radiation_damping[row], table.excitation_force[row, 0]
        k = float(table.wavenumbers[row, 0])
        group = 0.5 * omega / k * (1.0 + (2.0 * k * depth / np.sinh(2.0 * k * depth) if depth < np.inf else 0.0))
        # b = Σ Xᵢ X̄ⱼ/(4 ρg c_g) over both directions: each side takes ½ρg c_g |A|², and |X| = 2 ρg c_g |A| per speed.
        radiated = forces.T @ forces.conj() / (4.0 * 1025.0 * 9.81 * group)
        assert np.abs(damping - radiated).max() < 2.0 * tolerance * np.abs(damping).max()


MATRICES = st.lists(st.floats(-1.0, 1.0), min_size=9, max_size=9).map(lambda values: np.reshape(values, (3, 3)))


@st.composite
def attachments(draw: st.DrawFn) -> list[dict[str, Any]]:
    """Up to three attachments with any symmetric stiffness and any damping that is accepted."""
    found = []
    for _ in range(draw(st.integers(1, 3))):
        one, other = draw(MATRICES), draw(MATRICES)
        body = draw(st.integers(1, 2))
        ends = {"to": 3 - body} if draw(st.booleans()) else {}
        # A beam does not sway.
        moving = np.array([1.0, float(body == 1 and not ends), 1.0])
        at = [draw(st.floats(0.0, 12.0)) if body == 2 or ends else draw(st.floats(-6.0, -2.0)), 0.0]
        found.append(
            {
                "body": body,
                "at": at,
                "stiffness": (1e3 * np.outer(moving, moving) * (one + one.T)).tolist(),
                "damping": (1e3 * np.outer(moving, moving) * (other @ other.T)).tolist(),
                "quadratic_damping": (1e2 * moving * np.abs(one[0])).tolist(),
            }
            | ends
        )
    return found


@pytest.mark.slow
@settings(derandomize=True, deadline=None, max_examples=12)
@given(attachments())
def test_random_attachments_absorb_and_never_radiate_more_than_comes(held: list[dict[str, Any]]) -> None:
    waves = {"kind": "response", "omega": [1.3], "wave_amplitude": 0.2}
    (table,) = answer(held_sea(held, 1e-2), waves).response
    assert np.abs(table.energy_residual).max() < 2e-2
    assert np.all(table.absorption > -1e-12)
