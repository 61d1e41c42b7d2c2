"""Loads on the modes of round plates, their moments, strains and stresses: against equilibrium and polynomials."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from mpi4py import MPI

from hydroelastic.fem.bodies.round_plate import RoundShapes
from hydroelastic.fem.open_water.bent_plates import bent
from hydroelastic.fem.open_water.field_model import Band
from hydroelastic.fem.open_water.model_building import first_resolution, open_model
from hydroelastic.fem.open_water.plate_comparison import plate_comparisons
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.requests import RadiationRequest
from hydroelastic.fem.open_water.results import RoundDeflection
from hydroelastic.fem.open_water.round_plates import along_diameter, with_largest
from hydroelastic.fem.open_water.solve import solve_open_water
from hydroelastic.fem.open_water.solver import OpenSolver
from hydroelastic.fem.stopwatch import Stopwatch
from hydroelastic.physics.geometry import Geometry
from hydroelastic.physics.round_plates import RoundPlate
from hydroelastic.physics.tank import tank
from hydroelastic.scenes.models.sea import SeaScene
from hydroelastic.scenes.open_water.physics import open_water_problem


def water_of(tolerance: float, **keys: Any) -> OpenWaterProblem:
    """Deep water with one disc of radius 2."""
    disc = {"kind": "plate", "outline": "disc", "radius": 2.0, "mass_per_area": 100.0}
    scene = {"liquid": [{"density": 1000.0, "depth": math.inf}], "accuracy": {"tolerance": tolerance}}
    scene["body"] = [disc | keys.pop("body")]
    return open_water_problem(SeaScene.model_validate(scene | keys), MPI.COMM_WORLD, Stopwatch())


def test_modes_of_a_plate_follow_from_all_forces_on_them() -> None:
    """Those of the model too, by the same equations as further ones."""
    omega = 3.0
    held = {"at": [0.0, 0.0], "stiffness": [3e3, 0.0, 0.0], "damping": [2e3, 0.0, 0.0]}
    held["quadratic_damping"] = [4e3, 0.0, 0.0]
    body = {"flexural_rigidity": 1e4, "poisson_ratio": 0.3}
    asked = {"kind": "response", "omega": [omega], "wave_amplitude": 0.1}
    problem = water_of(1e-2, body=body, attachment=[held], analysis=[asked]).of_order(0)
    band = Band(lowest=omega, highest=omega)
    model = open_model(problem, band, first_resolution(problem.tank, problem.tolerance, band))
    response = OpenSolver(model, Stopwatch()).response(omega, [0])
    drag, paths = np.array([0.3]), model.outside.paths
    damping = np.sqrt(response.squared) * (paths.T * drag) @ paths
    motions = np.linalg.solve(response.equations.dynamic - 1j * damping, response.equations.forces[0])
    modes = model.plate_modes[0]
    modes.count, modes.own = 0, slice(0, 0)
    found = bent(modes, response, motions[None], drag[None])[0, : len(motions)]
    np.testing.assert_allclose(found, motions, rtol=0.0, atol=1e-9 * np.abs(motions).max())


def test_rigid_discs_have_the_added_mass_of_their_limits() -> None:
    """4/3 and 8/45 ρaⁿ beside ψ = 0, 8/3 and 4/15 beside a lid, of heave and pitch."""
    water = water_of(1e-3, body={"rigid": True})
    solution = solve_open_water(water, (RadiationRequest(omega=(0.0, math.inf)),))
    rows = list(plate_comparisons(water.tank, solution))
    assert len(rows) == 4
    # The tolerance.
    assert max(abs(row.difference) for row in rows) < 1e-3


@pytest.mark.parametrize(
    ("orders", "poisson", "moment", "shear", "curvature"),
    [
        # w = (1 + i) x²: W₀ = W₂ = (1 + i) r²/2; w_xx = 2 (1 + i).
        (
            {0: [0.0, 0.0, 0.5 + 0.5j], 2: [0.0, 0.0, 0.5 + 0.5j]},
            0.0,
            lambda x: 2.0 + 2.0j + 0.0 * x,
            0.0,
            math.sqrt(8.0),
        ),
        # w = x³: W₁ = ¾ r³, W₃ = ¼ r³.
        ({1: [0.0, 0.0, 0.0, 0.75], 3: [0.0, 0.0, 0.0, 0.25]}, 0.0, lambda x: 6.0 * x, 6.0, 12.0),
        # w = x² − y²: W₂ = r², of the same bending or twist in all directions; M = D (1 − ν) w_xx.
        ({2: [0.0, 0.0, 1.0]}, 0.3, lambda x: 1.4 + 0.0 * x, 0.0, 2.0),
    ],
)
def test_moments_strain_and_stress_are_those_of_polynomials(
    orders: dict[int, list[complex]], poisson: float, moment: Any, shear: float, curvature: float
) -> None:
    """On a disc of radius 2: M = D (w_xx + ν w_yy), Q = D w_xxx, strain h/2 w_xx and stress 6M/h²."""
    radii = np.linspace(0.0, 2.0, 9)
    derivatives = np.zeros((4, 1, 1, 4, 9), dtype=complex)
    # Δₙ of r² and r³ of orders 0 and 1; of the others it is zero.
    derivatives[3, 0, 0, 1] = shear
    for order, coefficients in orders.items():
        polynomial = np.polynomial.Polynomial(coefficients)
        for number in range(3):
            derivatives[number, 0, 0, order] = (polynomial.deriv(number) if number else polynomial)(radii)
    plate = RoundPlate(radius=2.0, flexural_rigidity=5.0, mass_per_area=1.0, poisson_ratio=poisson, thickness=0.1)
    sea = tank(
        length=9.0,
        gravity=9.81,
        is_open=True,
        liquids=((1000.0, math.inf),),
        top="free",
        bodies=(plate,),
        geometry=Geometry(kind="revolved"),
    )
    orders_of = RoundDeflection(body=0, radii=radii, derivatives=derivatives, uncertain=np.zeros((2, 1, 1, 4)))
    found = with_largest(sea, along_diameter(sea, orders_of, np.array([1e-6])), orders_of)
    # Rounding of sums of a few numbers of order 10.
    np.testing.assert_allclose(found.bending_moment[0, 0], 5.0 * moment(found.positions), atol=1e-12)
    np.testing.assert_allclose(found.shear_force[0, 0], np.full(17, 5.0 * shear), atol=1e-12)
    assert found.largest_strain is not None
    assert found.largest_stress is not None
    # The phase of the largest strain is found to 1e-5, at which it differs by its square.
    assert found.largest_strain[0, 0] == pytest.approx(0.05 * curvature, rel=1e-8)
    assert found.largest_stress[0, 0] == pytest.approx(6.0 * 5.0 * (1.0 - poisson) * curvature / 0.1**2, rel=1e-8)


@pytest.mark.parametrize("inner", [0.0, 0.4])
@pytest.mark.parametrize("order", [0, 1, 3])
def test_loads_of_dry_modes_follow_from_their_inertia(inner: float, order: int) -> None:
    """∂(ΔₙW)/∂r and W″ by the load κ⁴W against derivatives of the polynomials, which are exact of low modes."""
    plate = RoundPlate(
        radius=1.0, inner_radius=inner, flexural_rigidity=3.0, mass_per_area=1.0, tension=2.0, order=order
    )
    shapes, r = RoundShapes(plate, 28, spare=0), np.linspace(max(inner, 0.2), 1.0, 9)
    value, first, second, third = (shapes.values(r, number)[:4] for number in range(4))
    slope = third + second / r - (1.0 + order**2) * first / r**2 + 2.0 * order**2 * value / r**3
    values, last = shapes.bent(r)[:, :, :4]
    # Rounding of third derivatives of polynomials of degree 28 and 56.
    for found, known in ((values[2], second), (values[3], slope)):
        np.testing.assert_allclose(found, known, atol=1e-7 * np.abs(known).max())
    assert np.abs(last).max() < 1e-6 * np.abs(slope).max()
