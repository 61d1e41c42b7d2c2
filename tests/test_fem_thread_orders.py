"""Orders of convergence of the thread at rest, at nodes, of a thread that bends, and of one in a reactive liquid."""

from __future__ import annotations

import numpy as np
import pytest
from mpi4py import MPI
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from thread_field_cases import free_with, held_at, model_of, start_of

from hydroelastic.fem.thread.equilibrium import Start, solve_on_mesh
from hydroelastic.fem.thread.profile import ThreadProfile, thread_profile
from hydroelastic.physics.stream import UniformStream
from hydroelastic.physics.thread import Reactive, Thread

COMM = MPI.COMM_WORLD


def solved(model: Thread, name: str, elements: int, degree: int) -> ThreadProfile:
    nodes = np.linspace(0.0, model.length, elements + 1)
    return thread_profile(solve_on_mesh(COMM, model, nodes, start_of(name, model.dimension), degree=degree))


def slope(elements: tuple[int, ...], errors: NDArray[np.float64]) -> float:
    return -float(np.polyfit(np.log(elements), np.log(errors), 1)[0])


@pytest.fixture(scope="module")
def fine() -> ThreadProfile:
    # Of order 10: its error is rounding, 1e-13 as measured on other meshes.
    return solved(model_of("S10"), "S10", 64, 5)


@pytest.mark.slow_but("2-*")
@pytest.mark.parametrize(
    ("degree", "elements", "largest"),
    # Measured 2.6e-6, 2.0e-9, 2.4e-10 of length and tension on the last mesh.
    [(1, (16, 32, 64), 2e-5), (2, (8, 16, 32), 4e-9), (3, (4, 8, 16), 2e-10)],
)
def test_positions_and_forces_at_nodes_are_of_order_2p(
    fine: ThreadProfile, degree: int, elements: tuple[int, ...], largest: float
) -> None:
    model = model_of("S10")
    positions, forces = [], []
    for count in elements:
        found = solved(model, "S10", count, degree)
        nodes = found.nodes
        every = 64 // count
        positions.append(np.max(np.abs(found.position(nodes) - fine.position(nodes))) / model.length)
        forces.append(
            np.max(np.abs(found.force - np.stack([fine.force[::every, 0], fine.force[every - 1 :: every, 1]], 1)))
        )
    tension = float(np.max(fine.tension))
    # Measured within 0.1 of 2p.
    assert slope(elements, np.array(positions)) == pytest.approx(2 * degree, abs=0.2)
    assert slope(elements, np.array(forces)) == pytest.approx(2 * degree, abs=0.2)
    assert max(positions[-1], forces[-1] / tension) < largest


def test_the_direction_of_a_force_at_a_free_end_keeps_the_order_of_a_moving_load() -> None:
    """With the slope at the end in place of it the order is that of the slope, 2."""
    model = Thread(
        dimension=2,
        length=1.0,
        ends=(held_at([0.0, 0.0]), free_with([2.0, -2.0])),
        weight=1.0,
        normal_drag=1.0,
        mass=1.0,
        added_mass=0.8,
        reactive="moving_load",
        stream=UniformStream((1.0, 0.0, 0.0)),
    )
    start = Start(position=lambda s: np.outer(s, [0.7, -0.7]), force=lambda s: np.full(s.shape, 3.0))
    elements = (4, 8, 16)
    *found, exact = (
        thread_profile(solve_on_mesh(COMM, model, np.linspace(0.0, 1.0, count + 1), start, degree=2)).position(
            np.array([1.0])
        )
        for count in (*elements, 64)
    )
    errors = np.array([np.abs(one - exact).max() for one in found])
    # Measured 3.87, and 7e-11 on the last mesh.
    assert slope(elements, errors) == pytest.approx(3.87, abs=0.1)
    assert errors[-1] < 1e-10


def test_end_forces_are_those_of_the_balance(fine: ThreadProfile) -> None:
    # Dead force and drag of the body, nothing else: the discrete equations hold at nodes.
    model = fine.model
    assert model.stream is not None
    place = np.insert(fine.position(np.array([model.length])), 1, 0.0, axis=1)
    velocity = model.stream.velocity_at(place)[0, [0, 2]]
    body = model.ends[1].load
    expected = body.force + body.drag * np.linalg.norm(velocity) * velocity
    np.testing.assert_allclose(fine.force[-1, 1], expected, rtol=1e-9)
    np.testing.assert_allclose(fine.reactions(), [-fine.force[0, 0], [0.0, 0.0]], atol=1e-9 * np.max(fine.tension))


def axial_flow(reactive: Reactive) -> tuple[NDArray[np.float64], float]:
    """End B and tension at A of S19b by the planar equations in the angle f of the thread, from B to A.

    T_s = w sin f − Rt cos f |cos f| and (T − ma W² + ma |V_n|²/2) f_s = w cos f + Rn sin f |sin f|, without the last
    term of the bracket for the moving load.
    """
    weight, normal, tangential, mass, speed = 20.0, 30.75, 0.8050331174824, 2.0126, 5.0

    def slopes(_: float, state: NDArray[np.float64]) -> list[float]:
        cosine, sine = np.cos(state[2]), np.sin(state[2])
        along, across = speed * cosine, speed * sine
        held = state[3] - mass * along**2 + (0.5 * mass * across**2 if reactive == "lighthill" else 0.0)
        turn = (weight * cosine + normal * across * abs(across)) / held
        return [cosine, sine, turn, weight * sine - tangential * along * abs(along)]

    end = [0.0, 0.0, -0.3, 600.0]
    state = solve_ivp(slopes, (50.0, 0.0), end, method="DOP853", rtol=1e-12, atol=1e-12).y[:, -1]
    return -state[:2], float(state[3])


@pytest.mark.slow_but("lighthill")
@pytest.mark.parametrize("reactive", ["lighthill", "moving_load"])
def test_nearly_axial_flow_with_the_liquids_reaction(reactive: Reactive) -> None:
    place, tension = axial_flow(reactive)
    elements = (20, 40, 80)
    errors = []
    for count in elements:
        found = solved(model_of("S19b", reactive=reactive), "S19b", count, 2)
        position = np.linalg.norm(found.position(np.array([50.0]))[0] - place) / 50.0
        errors.append([position, abs(found.tension[0, 0] / tension - 1.0)])
    # Measured 3.7 to 3.9; with the direction of the trace at the free end instead of the force's 1.6.
    for error in np.array(errors).T:
        assert slope(elements, error) == pytest.approx(4.0, abs=0.5)
    # Measured 6e-8.
    assert np.max(errors[-1]) < 2e-7


def test_elastica() -> None:
    elements = (8, 16, 32)
    errors = []
    for count in elements:
        found = solved(model_of("S16a"), "S16a", count, 2)
        errors.append([np.linalg.norm(found.position(np.array([1.0]))[0] - [0.9435667637166, 0.3017207737998])])
        errors[-1].append(abs(found.end_moments()[0] - 0.9435667637166))
    for error in np.array(errors).T:
        assert slope(elements, error) == pytest.approx(4.0, abs=0.2)
    # Measured 2e-8.
    assert np.max(errors[-1]) < 5e-8
