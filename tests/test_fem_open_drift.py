"""Mean forces of second order: far field against near field, and the formula of Maruo."""

from typing import Any

import numpy as np
import pytest
from float_scenes import BARGE
from open_cases import problem_of

from hydroelastic.fem.open_water.field_model import Band
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.hull import hull_pressure
from hydroelastic.fem.open_water.model_building import first_resolution, open_model
from hydroelastic.fem.open_water.response_table import drift_forces
from hydroelastic.fem.open_water.solver import OpenSolver
from hydroelastic.scenes.models import SeaScene

CIRCLE: dict[str, Any] = {"kind": "float", "shape": "ellipse", "half_width": 1.0, "half_height": 1.0}


def solver_of(body: dict[str, Any], omega: float, tolerance: float, depth: float, *held: dict[str, Any]) -> OpenSolver:
    scene = SeaScene(
        liquid=[{"density": 1000.0, "depth": depth}],
        body=[body],
        attachment=list(held),
        accuracy={"tolerance": tolerance},
    )
    problem, band = problem_of(scene), Band(lowest=omega, highest=omega)
    model = open_model(problem, band, first_resolution(problem.tank, tolerance, band))
    return OpenSolver(model, problem.watch)


@pytest.mark.parametrize(
    ("body", "depth", "tolerance", "difference"),
    [
        (CIRCLE | {"motions": ["heave", "sway"]}, float("inf"), 1e-10, 1e-6),
        (CIRCLE | {"motions": ["heave", "sway"]}, 3.0, 1e-10, 1e-6),
        # No corner, where |∇Ψ|² is not bounded, lies in the band.
        (BARGE, 2.0, 1e-8, 1e-6),
    ],
)
def test_far_field_and_near_field_agree(
    body: dict[str, Any], depth: float, tolerance: float, difference: float
) -> None:
    solver = solver_of(body, 3.0, tolerance, depth)
    for place in (0, 1):
        found = solver.response(3.0, [place])
        far = found.drift_force()[0]
        assert found.near_field_drift() == pytest.approx(far, rel=difference)
        assert (far > 0.0) == (place == 0)


def test_far_field_and_near_field_agree_with_springs_and_dampers() -> None:
    mooring = {"at": [1.0, 0.0], "stiffness": [500.0, 2000.0, 0.0], "damping": [100.0, 300.0, 50.0]}
    solver = solver_of(BARGE, 2.5, 1e-8, float("inf"), mooring)
    found = solver.response(2.5, [0])
    assert found.absorption[0] > 0.01
    assert found.near_field_drift() == pytest.approx(found.drift_force()[0], rel=1e-6)


def test_maruo() -> None:
    solver = solver_of(CIRCLE | {"motions": ["heave", "sway"]}, 3.0, 1e-8, float("inf"))
    found = solver.response(3.0, [0])
    reflection = abs(found.outgoing()[1, 0])
    assert drift_forces([found])[0, 0] == pytest.approx(0.5 * 1000.0 * 9.81 * reflection**2, rel=1e-6)


def test_pressures_along_the_hull_give_the_forces() -> None:
    solver = solver_of(BARGE, 2.5, 1e-5, float("inf"))
    found = solver.response(2.5, [0])
    hull = hull_pressure([found], np.array([1e-5]), 0)
    points, pressures = hull.points, hull.pressure
    # From the left contact point down, along the bottom, and up on the right; heave by the pressure on the bottom.
    assert points[0] == pytest.approx([-1.0, 0.0], abs=1e-9)
    assert points[-1, 0] == pytest.approx(1.0, abs=1e-9)
    bottom = np.abs(points[:, 1] + 0.5) < 1e-9
    lift = np.trapezoid(pressures[0, 0, bottom], points[bottom, 0])
    # The trapezoidal rule leaves some 1e-3.
    assert lift == pytest.approx(needed_lift(found, 2.5), rel=5e-3)


def needed_lift(found: OpenResponse, omega: float) -> complex:
    """(c − ω²m) s, the force of the dynamic pressure in heave, per unit elevation."""
    model = found.model
    scale = model.scale
    inertia, stiffness = scale.masses(model.mass)[0, 0], scale.stiffnesses(model.stiffness)[0, 0]
    elevation = found.incidence.elevations[0] * np.exp(1j * found.incidence.phases_at_origin(model.basin)[0])
    return complex((stiffness - omega**2 * inertia) * scale.amplitudes(found.motions / elevation)[0, 0])


def test_pressures_of_both_liquids_along_a_hull_give_the_forces() -> None:
    body = {"kind": "float", "shape": "rectangle", "half_width": 1.0, "half_height": 0.5, "motions": ["heave"]}
    scene = SeaScene(
        liquid=[{"density": 1000.0, "depth": 3.0}, {"density": 700.0, "depth": 2.0}],
        body=[body | {"at": "interface"}],
        analysis=[{"kind": "radiation", "omega": [1.0]}],
        accuracy={"tolerance": 1e-4},
    )
    problem, band = problem_of(scene), Band(lowest=1.0, highest=1.0)
    model = open_model(problem, band, first_resolution(problem.tank, problem.tolerance, band))
    found = OpenSolver(model, problem.watch).response(1.0, [0])
    hull = hull_pressure([found], np.array([1e-4]), 0)
    sides = [np.abs(hull.points[:, 1] - y) < 1e-9 for y in (-0.5, 0.5)]
    below, above = (np.trapezoid(hull.pressure[0, 0, side], hull.points[side, 0]) for side in sides)
    # From the right to the left on top. The trapezoidal rule leaves some 1e-3.
    assert below + above == pytest.approx(needed_lift(found, 1.0), rel=5e-3)
    assert abs(above) > 0.1 * abs(below)
