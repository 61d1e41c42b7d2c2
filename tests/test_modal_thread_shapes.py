"""Threads at rest by marching, catenaries and the taut chord."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from thread_cases import inputs, load_of, results, stream_of, tolerance, worst_difference
from thread_shooting import shoot

from hydroelastic.modal.thread.catenary import catenary_between, elastic_catenary
from hydroelastic.modal.thread.critical import critical_direction
from hydroelastic.modal.thread.march import MarchedThread, march_back, march_tail
from hydroelastic.modal.thread.shape import NoTensionError
from hydroelastic.modal.thread.taut import taut_tension, taut_thread
from hydroelastic.physics.stream import ShearedStream, TabulatedStream, UniformStream
from hydroelastic.physics.thread_load import ThreadLoad

# A march accumulates some ten times its tolerance.
MARCH = 1e-12
A = np.zeros(3)


def difference(name: str, thread: MarchedThread) -> float:
    ends, middle = thread.at([0.0, thread.s[-1]]), thread.at([thread.s[-1] / 2])
    return worst_difference(
        name,
        rB=thread.positions[-1],
        N_A=ends.forces[0],
        N_B=ends.forces[1],
        T_A=ends.tensions[0],
        r_mid=middle.positions[0],
        T_mid=middle.tensions[0],
    )


@pytest.mark.parametrize("name", ["S05", "S07", "S14", "A02"])
def test_end_force(name: str) -> None:
    given = inputs(name)
    thread = march_back(load_of(name), given["L"], given["F_B"], tolerance=MARCH)
    # Dense output of order 7 between steps of order 8: at the middle ten times the tolerance.
    assert difference(name, thread) < max(10 * MARCH, tolerance(name))
    assert thread.s[0] == 0
    assert thread.positions[0] == pytest.approx(A, abs=10 * MARCH * given["L"])


def test_end_force_that_depends_on_the_position() -> None:
    given, stream = inputs("S10"), stream_of("S10")
    assert stream is not None

    def force(position: NDArray[np.floating]) -> NDArray[np.floating]:
        velocity = stream.velocity_at(position[None])[0]
        return given["body_B"]["kb"] * np.linalg.norm(velocity) * velocity + [0, 0, given["body_B"]["net_buoyancy"]]

    thread = march_back(load_of("S10"), given["L"], force, tolerance=MARCH)
    assert difference("S10", thread) < 10 * MARCH


def test_free_tail() -> None:
    thread = march_tail(load_of("S08"), inputs("S08")["L"], tolerance=MARCH)
    assert difference("S08", thread) < 10 * MARCH
    tangent = critical_direction(load_of("S08"), A)[0]
    assert math.atan2(-tangent[2], tangent[0]) == pytest.approx(0.4028989545145, rel=1e-12)


@pytest.mark.slow
def test_free_tail_in_shear_is_the_limit_of_small_end_forces() -> None:
    load = ThreadLoad(
        weight=4.0, normal_drag=13.0, tangential_drag=0.3, stream=ShearedStream((2.0, 0.5, 0.0), (0.01, 0.0, 0.0))
    )
    tail = march_tail(load, 100.0, start=(1.0, 2.0, 3.0), tolerance=1e-7)
    assert tail.positions[0] == pytest.approx([1.0, 2.0, 3.0], abs=1e-3)
    assert tail.tensions[-1] == 0
    distances = []
    for force in (2.0, 1.0):
        direction, _ = critical_direction(load, tail.positions[-1])
        marched = march_back(load, 100.0, force * direction, start=(1.0, 2.0, 3.0), tolerance=1e-7)
        distances.append(np.linalg.norm(marched.positions[-1] - tail.positions[-1]))
    # In proportion to the force: both tend to the free tail.
    assert distances[0] / distances[1] == pytest.approx(2.0, abs=0.1)
    assert distances[1] < 1e-2


def test_point_forces() -> None:
    # A cut at a point force changes nothing else: the part before it feels the force of the part beyond and the weight.
    load = ThreadLoad(weight=2.0, normal_drag=10.0, tangential_drag=0.2, stream=UniformStream((1.0, 0.0, 0.0)))
    push = np.array([3.0, -20.0, 60.0])
    whole = march_back(load, 100.0, (0.0, 0.0, 900.0), point_forces=[(40.0, push)], tolerance=MARCH)
    beyond = march_back(load, 60.0, (0.0, 0.0, 900.0), tolerance=MARCH)
    before = march_back(load, 40.0, beyond.forces[0] + push, tolerance=MARCH)
    assert whole.forces[0] == pytest.approx(before.forces[0], rel=1e-10)
    assert whole.at([40.0]).forces[0] == pytest.approx(beyond.forces[0], rel=1e-10)
    assert whole.positions[-1] == pytest.approx(before.positions[-1] + beyond.positions[-1], rel=1e-10)
    assert (np.diff(whole.s) > 0).all()
    depending = march_back(
        load, 100.0, (0.0, 0.0, 900.0), point_forces=[(40.0, lambda r: push * r[2] / 39.0)], tolerance=MARCH
    )
    height = depending.at([40.0]).positions[0, 2]
    jump = depending.at([40.0 - 1e-9]).forces[0] - depending.at([40.0]).forces[0]
    assert jump == pytest.approx(push * height / 39.0, rel=1e-8)


def test_march_of_a_thread_that_stretches() -> None:
    places = np.linspace(0, 12.0, 5)
    catenary = elastic_catenary(A, (3.0, 4.0, 6.0), 12.0, 2.0, 40.0, places)
    marched = march_back(ThreadLoad(weight=2.0), 12.0, catenary.forces[-1], axial_rigidity=40.0, tolerance=MARCH)
    assert marched.at(places).positions == pytest.approx(catenary.positions, abs=1e-10)
    assert marched.at(places).forces == pytest.approx(catenary.forces, abs=1e-10)


def test_table_of_a_linear_stream_is_that_stream() -> None:
    levels = tuple(np.linspace(-10, 130, 8))
    rows = tuple((0.3 + 0.008 * level, 0.0, 0.0) for level in levels)
    load = load_of("S10")
    table = ThreadLoad(
        weight=load.weight,
        normal_drag=load.normal_drag,
        tangential_drag=load.tangential_drag,
        stream=TabulatedStream(levels, rows),
    )
    exact, tabulated = (march_back(q, 120.0, (300.0, 0.0, 1800.0)) for q in (load, table))
    assert tabulated.positions[-1] == pytest.approx(exact.positions[-1], rel=1e-9)


def test_a_thread_that_would_fold_is_refused() -> None:
    with pytest.raises(NoTensionError, match="tension vanishes"):
        march_back(ThreadLoad(weight=2.0), 10.0, (0.0, 0.0, 5.0))
    with pytest.raises(NoTensionError, match="no force"):
        march_back(ThreadLoad(weight=2.0), 10.0, (0.0, 0.0, 0.0))
    with pytest.raises(NoTensionError, match="nothing pulls"):
        march_tail(ThreadLoad(weight=0.0, normal_drag=1.0, stream=UniformStream((1.0, 0.0, 0.0))), 10.0)
    with pytest.raises(ValueError, match="length is -1"):
        march_back(ThreadLoad(weight=2.0), -1.0, (0.0, 0.0, 5.0))
    with pytest.raises(ValueError, match="point_forces"):
        march_back(ThreadLoad(weight=2.0), 1.0, (0.0, 0.0, 5.0), point_forces=[(2.0, (1.0, 0.0, 0.0))])


def test_a_march_that_begins_at_its_height() -> None:
    """A light thread pulled sideways ends at the height of A at once: two heights for a secant are not there."""
    found = march_back(ThreadLoad(weight=0.0), 1.0, lambda place: np.array([1.0, 0.3 * float(place[0]), 0.0]))
    assert found.positions[0] == pytest.approx(np.zeros(3), abs=1e-8)
    direction = found.forces[-1] / np.linalg.norm(found.forces[-1])
    assert found.positions[-1] == pytest.approx(direction, abs=1e-8)


@pytest.mark.parametrize("name", ["S01", "S03"])
def test_catenaries(name: str) -> None:
    given = inputs(name)
    thread = catenary_between(given["A"], given["B"], given["L"], (0, 0, -given["w"]), [0, given["L"] / 2, given["L"]])
    values = {"rB": thread.positions[2], "N_A": thread.forces[0], "N_B": thread.forces[2], "T_mid": thread.tensions[1]}
    assert worst_difference(name, r_mid=thread.positions[1], T_A=thread.tensions[0], **values) < tolerance(name)


@pytest.mark.parametrize("slack", [1e-9, 1e-6, 1e-2, 1.0, 1e3])
@pytest.mark.parametrize("chord", [(1.0, 0.0, 0.0), (1e-9, 0.0, 1.0), (1e-3, 1e-3, -1.0), (0.3, 0.2, -0.4)])
def test_catenaries_end_at_b_and_have_their_length(slack: float, chord: tuple[float, float, float]) -> None:
    length = float(np.linalg.norm(chord)) * (1 + slack)
    load = np.array([0.3, -0.2, -1.0])
    thread = catenary_between(A, chord, length, load, length * np.linspace(0, 1, 9))
    assert thread.positions[-1] == pytest.approx(np.array(chord), abs=1e-13 * length)
    assert thread.forces[0] - thread.forces[-1] == pytest.approx(load * length, rel=1e-6, abs=1e-6 * length)
    # r' = τ, by differences, about places where they are smooth.
    step = 1e-4 * length
    if slack < 1:
        near = catenary_between(A, chord, length, load, [0.3 * length - step, 0.3 * length, 0.3 * length + step])
        slope = (near.positions[2] - near.positions[0]) / (2 * step)
        assert slope == pytest.approx(near.tangents[1], abs=1e-6)


@pytest.mark.slow_but("10.0-*")
@pytest.mark.parametrize("stretch", [-0.1, -1e-6, 0.0, 1e-6, 0.1, 3.0])
@pytest.mark.parametrize("axial_rigidity", [0.1, 10.0, 1e6])
def test_elastic_catenaries(stretch: float, axial_rigidity: float) -> None:
    end = np.array([0.3, 0.2, -0.4])
    length = float(np.linalg.norm(end)) * (1 + stretch)
    thread = elastic_catenary(A, end, length, -1.0, axial_rigidity, [0.0, length])
    assert thread.positions[-1] == pytest.approx(end, abs=1e-12)
    # Against shooting, which knows of no formula.
    shot = shoot(ThreadLoad(weight=-1.0), length, A, end, axial_rigidity, 1.01 * thread.forces[0])
    assert shot.miss < 1e-11
    assert shot.forces([length])[0] == pytest.approx(thread.forces[1], rel=1e-6)
    assert shot.positions([length / 3])[0] == pytest.approx(
        elastic_catenary(A, end, length, -1.0, axial_rigidity, [length / 3]).positions[0], abs=1e-9
    )


def test_elastic_catenary_of_a_cable_with_known_pull() -> None:
    for name in ("M05a", "M05c"):
        given = inputs(name)
        thread = elastic_catenary(given["A"], given["B"], given["L"], given["w"], given["EA"], [0.0, given["L"]])
        assert thread.forces[:, 0] == pytest.approx([given["H"]] * 2, rel=1e-9)


def test_vertical_threads() -> None:
    thread = elastic_catenary(A, (0.0, 0.0, 1.2), 1.0, 2.0, 50.0, [0.0, 1.0])
    # The mean tension is that of the mean stretch, 0.2.
    assert thread.forces[:, 2] == pytest.approx([10.0 - 1.0, 10.0 + 1.0])
    assert thread.positions[1, 2] == pytest.approx(1.2)
    down = elastic_catenary(A, (0.0, 0.0, -1.2), 1.0, 2.0, 50.0, [0.0, 1.0])
    assert down.tensions == pytest.approx([11.0, 9.0])
    with pytest.raises(NoTensionError, match="two straight parts"):
        elastic_catenary(A, (0.0, 0.0, 1.0), 1.2, 2.0, 50.0, [0.0])
    with pytest.raises(NoTensionError, match="two straight parts"):
        catenary_between(A, (0.0, 0.0, 1.0), 1.2, (0, 0, -1.0), [0.0])
    with pytest.raises(ValueError, match="longer than the chord"):
        catenary_between(A, (1.0, 0.0, 0.0), 1.0, (0, 0, -1.0), [0.0])
    with pytest.raises(NoTensionError, match="without weight"):
        elastic_catenary(A, (1.0, 0.0, 0.0), 1.2, 0.0, 1.0, [0.0])


def test_taut_tension_is_of_first_order_in_the_slack() -> None:
    errors = []
    slacks = np.array([4e-3, 2e-3, 1e-3])
    for slack in slacks:
        length = 1 + slack
        exact = catenary_between(A, (1.0, 0.0, 0.0), length, (0, 0, -1.0), [0.0]).forces[0, 0]
        errors.append(taut_tension(length, 1.0, 1.0) / exact - 1)
    assert np.polyfit(np.log(slacks), np.log(np.abs(errors)), 1)[0] == pytest.approx(1.0, abs=0.02)


@pytest.mark.parametrize("stretch", [-1e-2, -1e-4, 0.0, 1e-4])
def test_taut_thread_is_nearly_the_elastic_catenary(stretch: float) -> None:
    length, places = 1 + stretch, (1 + stretch) * np.linspace(0, 1, 5)
    taut = taut_thread(A, (1.0, 0.0, 0.0), length, (0, 0, -0.01), 100.0, places)
    exact = elastic_catenary(A, (1.0, 0.0, 0.0), length, 0.01, 100.0, places)
    # Of the order of the largest strain, and of the squared slope.
    assert taut.tensions == pytest.approx(exact.tensions, rel=2e-2)
    assert taut.positions == pytest.approx(exact.positions, abs=2e-2 * 0.01)


def test_taut_thread_without_a_tension_of_its_own() -> None:
    assert taut_tension(0.9, 1.0, 0.0, 50.0) == pytest.approx(5.0)
    with pytest.raises(NoTensionError, match="does not stretch"):
        taut_tension(1.0, 1.0, 1.0)
    with pytest.raises(NoTensionError, match="no tension"):
        taut_tension(1.1, 1.0, 0.0, 50.0)
    with pytest.raises(ValueError, match="chord is 0"):
        taut_tension(1.0, 0.0, 1.0)


@pytest.mark.slow_but("S12")
@pytest.mark.parametrize("name", ["S12", "S17"])
def test_shooting_between_fixed_ends(name: str) -> None:
    given = inputs(name)
    guess = 1.02 * np.array(results(name)["N_A"])
    shot = shoot(load_of(name), given["L"], given["A"], given["B"], given.get("EA", math.inf), guess)
    middle, ends = given["L"] / 2, shot.forces([0.0, given["L"]])
    assert shot.miss < 1e-12
    assert worst_difference(name, N_A=ends[0], N_B=ends[1], r_mid=shot.positions([middle])[0]) < 10 * tolerance(name)
