"""A moving thread whose ends are led, pulled and let go; frames that move; how it comes to rest."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from mpi4py import MPI
from scipy.integrate import solve_bvp, solve_ivp
from thread_cases import inputs, results
from thread_motions import CHAIN_OMEGA, chain, follow, free, held, liquid, swing

from hydroelastic.fem.thread.equilibrium import Start, solve_on_mesh
from hydroelastic.fem.thread.motion import InitialMotion, move_from_rest
from hydroelastic.fem.thread.motion_plan import MotionPlan, PrescribedEnd, ThreadMotionError
from hydroelastic.physics.stream import UniformStream
from hydroelastic.physics.thread import Thread
from hydroelastic.physics.thread_motion import VortexShedding

G = 9.81
FREE_COURSE = PrescribedEnd()


def straight(direction: Any) -> InitialMotion:
    """A straight thread at rest from the origin."""
    return InitialMotion(position=lambda s: np.outer(s, direction))


@pytest.mark.slow_but("moving_load")
@pytest.mark.parametrize("reactive", ["none", "moving_load", "lighthill"])
def test_towed_thread_is_one_in_a_current(reactive: Any) -> None:
    """Towed at −U through still liquid, a thread moves as one that is held in a current U."""
    speed = np.array([0.8, 0.0])
    options: dict[str, Any] = {
        "dimension": 2,
        "length": 1.0,
        "weight": 3.0,
        "mass": 1.0,
        "flexural_rigidity": 0.02,
        "reactive": reactive,
        **liquid(),
    }
    ends = (held([0.0, 0.0]), free([1.0, -2.0], mass=0.2, drag=0.3))
    direction = np.array([0.8, -0.6])
    times, step = [0.0, 0.2], 0.01
    current = Thread(stream=UniformStream((0.8, 0.0, 0.0)), ends=ends, **options)
    at_rest = follow(current, 6, straight(direction), times, step)
    towed = follow(
        Thread(ends=ends, **options),
        6,
        InitialMotion(position=lambda s: np.outer(s, direction), velocity=lambda s: np.tile(-speed, (len(s), 1))),
        times,
        step,
        ends=(PrescribedEnd(position=lambda time: -speed * time), FREE_COURSE),
    )
    way = at_rest.positions[-1] - at_rest.positions[0]
    assert np.abs(towed.positions[-1] + 0.2 * speed - at_rest.positions[-1]).max() < 1e-11
    assert np.abs(towed.history.tensions - at_rest.history.tensions).max() < 1e-7
    assert np.abs(way).max() > 0.02
    assert np.abs(at_rest.history.imbalance).max() < 1e-12
    assert np.abs(towed.history.imbalance).max() < 1e-12


def test_small_swings_have_the_frequency_of_the_mode() -> None:
    """With that of the midpoint rule, 2/Δt atan(ωΔt/2), and an error of the square of the amplitude."""
    step, speed = 0.02, 1e-3
    omega = 2.0 / step * np.arctan(0.5 * step * CHAIN_OMEGA)
    times = np.linspace(0.0, 2.0, 5)
    tip = follow(chain(), 10, swing(speed), times, step).positions[:, -1, 0]
    # The velocity at the start belongs to this amplitude of the discrete oscillation.
    expected = speed / CHAIN_OMEGA * np.sin(omega * times)
    assert np.abs(tip - expected).max() < 1e-5 * speed / CHAIN_OMEGA
    # So that the step's own frequency is seen.
    assert np.abs(tip - speed / CHAIN_OMEGA * np.sin(CHAIN_OMEGA * times)).max() > 1e-3 * speed / CHAIN_OMEGA


def test_accelerated_end() -> None:
    """A thread whose upper end is accelerated hangs straight in the direction of gravity in its frame."""
    push = 4.0
    pull = np.hypot(push, G)
    model = Thread(dimension=2, length=1.0, ends=(held([0.0, 0.0]), free([0.0, 0.0])), weight=G, mass=1.0)
    lead = PrescribedEnd(position=lambda time: np.array([0.5 * push * time**2, 0.0]))
    direction = np.array([-push, -G]) / pull
    start = InitialMotion(
        position=lambda s: np.outer(s, direction) + np.array([0.5 * push * 0.3**2, 0.0]),
        velocity=lambda s: np.tile([push * 0.3, 0.0], (len(s), 1)),
    )
    motion = follow(model, 5, start, [0.3, 0.8, 1.3], 0.05, ends=(lead, FREE_COURSE))
    assert motion.velocity_change < 1e-8
    for time, positions, tensions in zip(motion.times, motion.positions, motion.tensions, strict=True):
        expected = np.outer(motion.nodes, direction) + np.array([0.5 * push * time**2, 0.0])
        assert np.abs(positions - expected).max() < 1e-10
        # The tension at the start takes a second derivative by differences, good to 1e-8.
        assert np.abs(tensions - pull * (1.0 - motion.nodes)).max() < 1e-6
    assert np.abs(motion.history.reactions[:, 0] - [push, G]).max() < 1e-8


def test_thread_that_is_let_go_falls_freely() -> None:
    """The tension of a hanging thread vanishes at once, and all of it falls by gt²/2."""
    model = Thread(dimension=2, length=1.0, ends=(held([0.0, 0.0]), free([0.0, 0.0])), weight=G, mass=1.0)
    course = PrescribedEnd(release=(0.25, 0.25))
    motion = follow(model, 4, straight(np.array([0.0, -1.0])), [0.0, 0.2, 0.25, 0.5], 0.04, ends=(course, FREE_COURSE))
    assert np.abs(motion.tensions[:2] - G * (1.0 - motion.nodes)).max() < 1e-10
    assert np.abs(motion.tensions[2:]).max() < 1e-10
    assert np.abs(motion.positions[-1, :, 1] + motion.nodes + 0.5 * G * 0.25**2).max() < 1e-12
    held_ends = motion.history.ends < 0.25 - 1e-12
    assert np.abs(motion.history.reactions[held_ends, 0, 1] - G).max() < 1e-10
    assert np.abs(motion.history.reactions[~held_ends]).max() == 0.0


def catenary(s: Any) -> Any:
    """Hanging between (0, 0) and a point to the right, lowest at s = 1/2, H = 0.3 weights of the thread."""
    height, lag = 0.3, np.asarray(s) - 0.5
    x = height * (np.arcsinh(lag / height) + np.arcsinh(0.5 / height))
    return np.stack([x, np.hypot(lag, height) - np.hypot(0.5, height)], axis=1)


def test_tension_just_after_an_end_is_let_go() -> None:
    """T_ss = κ²T at rest, T_s = w τ_z at the end that is held, T = 0 at the free one."""
    model = Thread(
        dimension=2, length=1.0, ends=(held([0.0, 0.0]), held(catenary(np.array([1.0]))[0])), weight=G, mass=1.0
    )
    height = 0.3
    solution = solve_bvp(
        lambda s, y: np.array([y[1], (height / (height**2 + (s - 0.5) ** 2)) ** 2 * y[0]]),
        lambda a, b: np.array([a[1] + G * 0.5 / np.hypot(0.5, height), b[0]]),
        np.linspace(0.0, 1.0, 50),
        np.zeros((2, 50)),
        tol=1e-8,
    )
    course = PrescribedEnd(release=(0.1, 0.1))
    motion = follow(
        model, 20, InitialMotion(position=catenary), [0.0, 0.09, 0.1, 0.101, 0.2], 0.01, ends=(FREE_COURSE, course)
    )
    nodes = motion.nodes
    at_rest = G * np.hypot(nodes - 0.5, height)
    # Nodal tensions are means of linear functions on both sides, of second order: h²κ²T/12.
    assert np.abs(motion.tensions[:2] - at_rest).max() < 2e-2
    assert np.abs(motion.tensions[2] - solution.sol(nodes)[0]).max() < 2e-2
    assert np.abs(solution.sol(nodes)[0] - at_rest).max() > 1.0
    # Impulse: what the weight and the held end give.
    assert np.abs(motion.history.imbalance).max() < 1e-12


def test_pulled_thread() -> None:
    """A force that changes moves a free straight thread as a rigid body, T = F s/L."""
    model = Thread(dimension=2, length=2.0, ends=(free([0.0, 0.0]), free([3.0, 0.0])), mass=1.5)
    course = PrescribedEnd(force=lambda time: np.array([3.0 + np.cos(4.0 * time), 0.0]))
    motion = follow(model, 3, straight(np.array([1.0, 0.0])), [0.0, 1.0], 0.01, ends=(FREE_COURSE, course))
    ends = motion.history.ends
    middles = 0.5 * (ends[1:] + ends[:-1])
    force = 3.0 + np.cos(4.0 * middles)
    # The force at the end of a step is the mean of those in the middles beside it.
    mean = 0.5 * (force[1:] + force[:-1])
    assert np.abs(motion.history.tensions[1:-1] - np.outer(mean, motion.nodes / 2.0)).max() < 1e-10
    assert np.abs(motion.tensions - np.outer(3.0 + np.cos([0.0, 4.0]), motion.nodes / 2.0)).max() < 1e-3
    assert np.abs(motion.velocities[-1] - [0.01 * force.sum() / 3.0, 0.0]).max() < 1e-12
    assert motion.history.work[:, 2].sum() == pytest.approx(np.cos(4.0 * middles) @ motion_way(motion), rel=1e-10)
    assert np.abs(motion.history.imbalance).max() < 1e-12


def motion_way(motion: Any) -> Any:
    """How far a rigid body came in each step, by the velocity that its energy tells."""
    speeds = np.sqrt(2.0 * motion.history.energies[:, 0] / 3.0)
    return 0.01 * 0.5 * (speeds[1:] + speeds[:-1])


def test_stream_that_grows() -> None:
    """A free straight thread across a stream u = U(1 − e^(−3t)) with viscous drag: v' = (nv/m)(u − v)."""
    model = Thread(
        dimension=2,
        length=1.0,
        ends=(free([0.0, 0.0]), free([0.0, 0.0])),
        mass=2.0,
        viscous_drag=3.0,
        stream=UniformStream((0.7, 0.0, 0.0)),
    )
    exact = solve_ivp(
        lambda t, v: 1.5 * (0.7 * (1.0 - np.exp(-3.0 * t)) - v), (0.0, 1.0), [0.0], rtol=1e-10, atol=1e-12
    )
    ends = []
    for step in (0.05, 0.025):
        motion = follow(
            model,
            2,
            straight(np.array([0.0, 1.0])),
            [0.0, 1.0],
            step,
            stream_factor=lambda time: 1.0 - np.exp(-3.0 * time),
        )
        assert np.ptp(motion.velocities[-1], axis=0).max() < 1e-12
        ends.append(motion.velocities[-1, 0, 0])
    # Extrapolated, of fourth order; the last one alone is not as good.
    assert (4.0 * ends[1] - ends[0]) / 3.0 == pytest.approx(exact.y[0, -1], abs=1e-7)
    assert abs(ends[1] - exact.y[0, -1]) > 1e-6


def test_vortices_push_across() -> None:
    """A straight free thread across a stream moves by the equations of a rigid body."""
    lift, number, drag = 1.2, 0.8, 0.5
    model = Thread(
        dimension=3,
        length=1.0,
        ends=(free(np.zeros(3)), free(np.zeros(3))),
        mass=2.0,
        normal_drag=drag,
        stream=UniformStream((1.0, 0.0, 0.0)),
    )

    def rates(t: float, y: Any) -> Any:
        relative = np.array([1.0 - y[0], -y[1]])
        speed = np.hypot(*relative)
        side = np.array([-relative[1], relative[0]])
        force = drag * speed * relative + lift * speed * np.sin(2 * np.pi * number * y[2] + 0.3) * side
        return [*(force / 2.0), speed]

    exact = solve_ivp(rates, (0.0, 1.0), [0.0, 0.0, 0.0], rtol=1e-10, atol=1e-12).y[:2, -1]
    ends = [
        follow(
            model,
            2,
            straight(np.array([0.0, 0.0, 1.0])),
            [0.0, 1.0],
            step,
            shedding=VortexShedding(lift=lift, wave_number=number, phase=0.3),
        ).velocities[-1, 1, :2]
        for step in (0.02, 0.01)
    ]
    # Of second order: the extrapolated value is better than the last by much.
    error, better = np.abs(ends[1] - exact).max(), np.abs((4.0 * ends[1] - ends[0]) / 3.0 - exact).max()
    assert better < 1e-2 * error < 1e-5
    assert abs(exact[1]) > 0.05


def current_case() -> Thread:
    """Return the thread of case M11, the static one of S06 with inertia."""
    given = inputs("M11")
    force = [given["F_B"][0], given["F_B"][2]]
    return Thread(
        dimension=2,
        length=given["L"],
        ends=(held([0.0, 0.0]), free(force, mass=given["M_tip"])),
        weight=given["w"],
        normal_drag=given["kn"],
        tangential_drag=given["kt"],
        stream=UniformStream(given["current"]["U"]),
        mass=given["m"],
        added_mass=given["ma"],
    )


@pytest.mark.slow
def test_recovery_of_the_steady_state() -> None:
    """From a thread straight along its end force to the static one, at the rate of the slowest mode (case D06)."""
    model = current_case()
    pull = model.ends[1].load.force
    up = pull / np.linalg.norm(pull)
    nodes = np.linspace(0.0, 100.0, 11)
    start = Start(position=lambda s: np.outer(s, up), force=lambda s: np.full(len(s), 1500.0))
    rest = solve_on_mesh(MPI.COMM_WORLD, model, nodes, start, degree=2)
    quiet = move_from_rest(rest, MotionPlan(times=np.array([0.0, 5.0]), step=1.0))
    assert np.abs(quiet.positions[1] - quiet.positions[0]).max() < 1e-8
    times = [0.0, 100.0, 300.0, 600.0]
    motion = follow(model, 10, straight(up), times, 1.0)
    away = np.linalg.norm(motion.positions - quiet.positions[0], axis=2).max(axis=1) / 100.0
    rate = results("M11")["lam"][0][0]
    # From 300 s on the second mode is e^(−3.5) of the first.
    assert np.log(away[3] / away[2]) / 300.0 == pytest.approx(rate, rel=5e-3)
    # The known ones have two digits.
    assert away[1:] == pytest.approx([4.7e-2, 7.1e-4, 1.3e-6], rel=0.015)
    stopped = follow(model, 10, straight(up), [0.0, 1e4], 10.0, tolerance=1e-5, rest_speed=1e-5, dissipation=0.6)
    assert stopped.rest_time is not None
    assert stopped.rest_time < 600.0
    # What is left moves at the rate times the distance.
    assert np.linalg.norm(stopped.positions[-1] - quiet.positions[0], axis=1).max() < 2.0 * 1e-5 / abs(rate)


def test_compression_is_announced() -> None:
    """A thread whose upper end is pushed down faster than it falls is in compression."""
    model = Thread(dimension=2, length=1.0, ends=(held([0.0, 0.0]), free([0.0, 0.0])), weight=G, mass=1.0)
    lead = PrescribedEnd(position=lambda time: np.array([0.0, -G * time**2]))
    motion = follow(model, 4, straight(np.array([0.0, -1.0])), [0.0, 0.1], 0.02, ends=(lead, FREE_COURSE))
    (slack,) = motion.slack
    assert (slack.start, slack.end, slack.where) == pytest.approx((0.0, 0.1, 0.0))
    assert slack.tension == pytest.approx(-G, rel=1e-6)


def test_undetermined_tension_is_refused() -> None:
    """A straight thread between two held ends, which cannot stretch, may have any tension."""
    model = Thread(dimension=2, length=1.0, ends=(held([0.0, 0.0]), held([1.0, 0.0])), weight=G, mass=1.0)
    with pytest.raises(ThreadMotionError, match=r"beyond t = 0 s.*undetermined"):
        follow(model, 4, straight(np.array([1.0, 0.0])), [0.0, 0.1], 0.02)


def test_both_reactive_loads_are_one_for_small_motions() -> None:
    """Waves in a taut thread along the stream: the load that moves and Lighthill's momentum differ by squares only."""
    ends = (held([0.0, 0.0]), free([1.0, 0.0], mass=0.1))
    ways = []
    for reactive in ("moving_load", "lighthill"):
        model = Thread(
            dimension=2,
            length=1.0,
            ends=ends,
            mass=1.0,
            added_mass=0.8,
            flexural_rigidity=0.01,
            reactive=reactive,  # type: ignore[arg-type]
            stream=UniformStream((0.6, 0.0, 0.0)),
        )
        start = InitialMotion(
            position=lambda s: np.outer(s, [1.0, 0.0]),
            velocity=lambda s: np.outer(1e-3 * np.sin(np.pi * s) ** 2, [0.0, 1.0]),
        )
        motion = follow(model, 10, start, [0.0, 0.5, 1.0], 0.02)
        ways.append(motion.positions[1:, :, 1])
    # Measured 2e-4 of the way on this mesh; without 2 W v_s it would be of the order of one.
    assert np.abs(ways[0] - ways[1]).max() < 5e-3 * np.abs(ways[0]).max()


@pytest.mark.parametrize("case", ["hung up", "swung"])
def test_tension_at_the_start_is_where_later_ones_come_from(case: str) -> None:
    """That of the accelerations at the start, against those of the first steps."""
    if case == "hung up":
        ends = (held([0.0, 0.0]), free([0.0, 0.0]))
        model = Thread(dimension=2, length=1.0, ends=ends, weight=G, mass=1.0, **liquid())
        motion = follow(model, 10, InitialMotion(position=catenary), [0.0, 0.01], 1e-3)
    else:
        motion = follow(chain(), 10, swing(), [0.0, 0.01], 1e-3)
    first, *rest = motion.history.tensions[:4]
    back = 3.0 * rest[0] - 3.0 * rest[1] + rest[2]
    # Of the third order of the step over the times in which waves pass an element.
    assert np.abs(first - back).max() < 1e-4 * np.abs(first).max()
