"""Power of waves, dampers and drag in all that open water can hold at once, and what attachments can never do."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpi4py import MPI
from open_cases import problem_of

from hydroelastic.fem.open_water.basin import open_basin
from hydroelastic.fem.open_water.outside import outside_of
from hydroelastic.fem.open_water.solve import OpenWaterSolution
from hydroelastic.fem.tank.field_model import whole_bodies
from hydroelastic.scenes.models import SeaScene
from hydroelastic.scenes.open_water.solve import solve_open

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


def sea(attachments: list[dict[str, Any]], *analyses: dict[str, Any], tolerance: float, **keys: Any) -> SeaScene:
    given = {"liquid": [{"density": 1025.0, "depth": 8.0}], "body": [FLOAT, BEAM], "attachment": attachments}
    return SeaScene(**given | {"analysis": list(analyses), "accuracy": {"tolerance": tolerance}} | keys)


def solved(scene: SeaScene) -> OpenWaterSolution:
    return solve_open(scene, MPI.COMM_WORLD, lambda _message: None)


WIDER = pytest.mark.slow


@pytest.mark.parametrize(
    ("side", "depth", "tolerance", "omegas"),
    [
        ("left", 8.0, 1e-2, [1.7]),
        pytest.param("right", 8.0, 1e-3, [1.1, 2.2], marks=WIDER),
        pytest.param("left", float("inf"), 1e-5, [0.5, 1.0, 1.7, 2.5], marks=WIDER),
        pytest.param("right", 2.0, 1e-5, [0.5, 1.0, 1.7, 2.5], marks=WIDER),
    ],
)
def test_incoming_power_is_scattered_or_absorbed(
    side: str, depth: float, tolerance: float, omegas: list[float]
) -> None:
    waves = {"kind": "response", "omega": omegas, "waves_from": side, "wave_amplitude": 0.3}
    liquid = [{"density": 1025.0, "depth": depth}]
    table = solved(sea(ALL, waves, tolerance=tolerance, liquid=liquid)).response[0]
    assert table.reflection is not None
    assert table.transmission is not None
    outgoing = np.abs(table.reflection[:, 0, 0]) ** 2 + np.abs(table.transmission[:, 0, 0]) ** 2
    # Measured: 2e-5 at the tolerance 1e-2; a tenth more damping than is counted as absorbed leaves 9e-3.
    assert np.abs(outgoing + table.absorption[:, 0] - 1.0).max() < 0.3 * tolerance
    assert np.abs(table.energy_residual).max() < 0.3 * tolerance
    # Dampers and drag are not idle.
    assert np.all(table.absorption > 1e-3)


@pytest.mark.parametrize(
    ("depth", "tolerance", "omegas"),
    [(8.0, 1e-2, [1.7]), pytest.param(float("inf"), 1e-5, [0.5, 1.0, 1.7, 2.5], marks=WIDER)],
)
def test_damping_is_radiated_power_and_that_of_the_excitation_forces(
    depth: float, tolerance: float, omegas: list[float]
) -> None:
    asked = {"kind": "radiation", "omega": omegas, "elastic_modes": 3}
    liquid = [{"density": 1025.0, "depth": depth}]
    table = solved(sea(ALL, asked, tolerance=tolerance, liquid=liquid)).radiation[0]
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


def outside(held: list[dict[str, Any]]) -> Any:
    """The forces of attachments on float and beam in ten dry modes."""
    problem = problem_of(sea(held, {"kind": "response", "omega": [1.0], "wave_amplitude": 0.2}, tolerance=1e-2))
    basin = open_basin(problem.tank, 1.0)
    return outside_of(basin, whole_bodies(basin.tank, (0, 10)), problem.tank.attachments)


def never_adds_power(held: list[dict[str, Any]]) -> None:
    forces = outside(held)
    scale = max(np.abs(forces.stiffness).max(), np.finfo(float).tiny)
    assert np.abs(forces.stiffness - forces.stiffness.T).max() <= 1e-13 * scale
    speeds = np.linspace(0.1, 1.0, len(forces.drag))
    for damping in (forces.damping, forces.linearized(speeds, 1.0)):
        values = np.linalg.eigvalsh(damping)
        assert np.abs(damping - damping.T).max() <= 1e-13 * max(np.abs(damping).max(), np.finfo(float).tiny)
        assert values[0] >= -1e-12 * max(values[-1], np.finfo(float).tiny)


@settings(derandomize=True, deadline=None, max_examples=10)
@given(attachments())
def test_no_attachment_adds_power_and_springs_are_symmetric(held: list[dict[str, Any]]) -> None:
    never_adds_power(held)


@pytest.mark.slow
@settings(derandomize=True, deadline=None, max_examples=2000)
@given(attachments())
def test_no_attachment_of_very_many_adds_power(held: list[dict[str, Any]]) -> None:
    never_adds_power(held)


@pytest.mark.slow
@settings(derandomize=True, deadline=None, max_examples=12)
@given(attachments())
def test_random_attachments_absorb_and_never_radiate_more_than_comes(held: list[dict[str, Any]]) -> None:
    waves = {"kind": "response", "omega": [1.3], "wave_amplitude": 0.2}
    table = solved(sea(held, waves, tolerance=1e-2)).response[0]
    assert np.abs(table.energy_residual).max() < 2e-2
    assert np.all(table.absorption > -1e-12)
