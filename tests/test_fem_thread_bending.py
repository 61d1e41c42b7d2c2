"""A thread that bends, clamped in a stream: the layer at the clamp, the same by its angle, orders of the moment."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from mpi4py import MPI
from numpy.typing import NDArray
from scipy.integrate import solve_bvp
from thread_field_cases import free_with, held_at, start_by

from hydroelastic.fem.thread.equilibrium import Start, solve_on_mesh
from hydroelastic.fem.thread.profile import thread_profile
from hydroelastic.fem.thread.refinement import ThreadSolution, solve_thread
from hydroelastic.modal.thread.march import MarchedThread, march_back
from hydroelastic.physics.stream import UniformStream
from hydroelastic.physics.thread import Thread
from hydroelastic.physics.thread_load import ThreadLoad

COMM = MPI.COMM_WORLD
LENGTH, WEIGHT, NORMAL, TANGENTIAL = 100.0, 3.0, 12.3, 0.6
FORCE = np.array([200.0, 0.0, 1500.0])
STREAM = UniformStream((1.0, 0.0, 0.0))
# √(EI/F)/L.
THICKNESS = 0.02


def rigidity(thickness: float) -> float:
    return (thickness * LENGTH) ** 2 * 1500.0


def clamped(thickness: float) -> Thread:
    """A thread that is clamped upright and pulled at its upper end, in a stream."""
    return Thread(
        dimension=2,
        length=LENGTH,
        ends=(held_at([0.0, 0.0], np.array([0.0, 1.0])), free_with(FORCE[[0, 2]])),
        weight=WEIGHT,
        normal_drag=NORMAL,
        tangential_drag=TANGENTIAL,
        flexural_rigidity=rigidity(thickness),
        stream=STREAM,
    )


@cache
def outer(tolerance: float) -> MarchedThread:
    load = ThreadLoad(weight=WEIGHT, normal_drag=NORMAL, tangential_drag=TANGENTIAL, stream=STREAM)
    return march_back(load, LENGTH, FORCE, tolerance=tolerance)


@pytest.fixture(scope="module")
def start() -> Start:
    return start_by(outer(1e-5).at, 2)


@pytest.fixture(scope="module")
def solution(start: Start) -> ThreadSolution:
    return solve_thread(COMM, clamped(THICKNESS), start, tolerance=1e-7)


@pytest.fixture(scope="module")
def by_angle() -> NDArray[np.float64]:
    """x, z, angle, curvature and N at 0, one layer, L/2 and L: EI φ_ss = N_x sin φ − N_z cos φ, N_s = −q."""
    stiffness = rigidity(THICKNESS)

    def slopes(_: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
        cosine, sine = np.cos(y[2]), np.sin(y[2])
        normal, along = -NORMAL * sine * np.abs(sine), TANGENTIAL * cosine * np.abs(cosine)
        turn = (y[4] * sine - y[5] * cosine) / stiffness
        forces = normal * sine - along * cosine, WEIGHT - normal * cosine - along * sine
        return np.array([cosine, sine, y[3], turn, *forces])

    def ends(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.array([a[0], a[1], a[2] - np.pi / 2, b[3], b[4] - FORCE[0], b[5] - FORCE[2]])

    s = np.unique(np.round(np.concatenate([np.linspace(0.0, 1.0, 301), np.linspace(0.0, 0.4, 301)]), 9))
    shape = outer(1e-11).at(LENGTH * s)
    angle = np.arctan2(shape.forces[:, 2], shape.forces[:, 0])
    layer = (np.pi / 2 - angle[0]) * np.exp(-s / THICKNESS)
    guess = [shape.positions[:, 0], shape.positions[:, 2], angle + layer, -layer / (THICKNESS * LENGTH)]
    found = solve_bvp(
        slopes, ends, LENGTH * s, np.array([*guess, shape.forces[:, 0], shape.forces[:, 2]]), tol=1e-8, max_nodes=20000
    )
    assert found.success
    return np.asarray(found.sol(LENGTH * np.array([0.0, THICKNESS, 0.5, 1.0])))


def test_against_the_equation_of_the_angle(solution: ThreadSolution, by_angle: NDArray[np.float64]) -> None:
    profile, errors = solution.profile, solution.errors
    s = LENGTH * np.array([0.0, THICKNESS, 0.5, 1.0])
    x, z, angle, curvature, *forces = by_angle
    # The other solution has 1e-9; measured 8e-13 of positions.
    np.testing.assert_allclose(profile.position(s), np.column_stack([x, z]), atol=errors.position + 1e-8 * LENGTH)
    np.testing.assert_allclose(profile.contact_force(s), np.column_stack(forces), atol=errors.tension + 1e-5)
    tension = forces[0] * np.cos(angle) + forces[1] * np.sin(angle)
    np.testing.assert_allclose(profile.tension_at(s), tension, atol=errors.tension + 1e-5)
    moment = rigidity(THICKNESS) * abs(curvature[0])
    assert profile.end_moments()[0] == pytest.approx(moment, rel=1e-8)
    assert profile.end_moments()[1] < 1e-12 * moment
    assert errors.moment < 1e-7 * moment


def test_layer_at_the_clamp(start: Start) -> None:
    # M = 2 √(EI T) sin(Δφ/2), its relative error of order √(EI/T)/L: measured 1.0.
    force = outer(1e-11).at([0.0]).forces[0]
    turn = np.pi / 2 - np.arctan2(force[2], force[0])
    thicknesses, differences = (0.005, 0.001, 1e-4), []
    for thickness in thicknesses:
        moment = solve_thread(COMM, clamped(thickness), start, tolerance=1e-6).profile.end_moments()[0]
        layer = 2.0 * np.sqrt(rigidity(thickness) * np.linalg.norm(force)) * np.sin(turn / 2)
        differences.append(abs(layer / moment - 1.0))
    assert np.polyfit(np.log(thicknesses), np.log(differences), 1)[0] == pytest.approx(1.0, abs=0.1)
    assert differences[-1] < 2e-5


@pytest.mark.slow
def test_moment_converges_where_the_layer_is_resolved(start: Start, by_angle: NDArray[np.float64]) -> None:
    moment = rigidity(THICKNESS) * abs(by_angle[3, 0])
    # h from 1.2 to 0.3 thicknesses: measured slopes 3.2 and 5.7, on their way to 4 and 6.
    for degree, expected in ((2, 3.2), (3, 5.7)):
        errors = []
        for count in (40, 80, 160):
            nodes = np.linspace(0.0, LENGTH, count + 1)
            found = thread_profile(solve_on_mesh(COMM, clamped(THICKNESS), nodes, start, degree=degree))
            errors.append(abs(found.end_moments()[0] / moment - 1.0))
        slope = -np.polyfit(np.log((40, 80, 160)), np.log(errors), 1)[0]
        assert slope == pytest.approx(expected, abs=0.3)
        assert errors[-1] < {2: 1e-4, 3: 1e-7}[degree]
