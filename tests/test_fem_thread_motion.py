"""The motion of a thread against references; its energy, its order, its independence of frames.

Without another word a tolerance of round-off is a hundred times what was measured.
"""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.special import ellipk
from thread_cases import inputs, results, tolerance, worst_difference
from thread_motions import chain, extrapolated, follow, free, held, liquid, swing

from hydroelastic.fem.thread.motion import InitialMotion
from hydroelastic.fem.thread.motion_results import ThreadMotion
from hydroelastic.physics.thread import Thread


@cache
def swing_in_liquid(step: float, elements: int = 10, degree: int = 3) -> ThreadMotion:
    """Case D05."""
    times = [0.0, *inputs("D05")["t"]]
    return follow(chain(**liquid()), elements, swing(), times, step, degree=degree)


@pytest.mark.slow
def test_pendulum_limit() -> None:
    """The period of a thread of little mass with a body is that of a pendulum."""
    period, angle = results("D01")["period"], np.deg2rad(60.0)
    assert period == pytest.approx(4.0 / np.sqrt(9.81) * ellipk(np.sin(angle / 2.0) ** 2), rel=1e-12)
    model = Thread(dimension=2, length=1.0, ends=(held([0, 0]), free([0.0, -9.81], mass=1.0)), mass=1e-8)
    start = InitialMotion(position=lambda s: np.outer(s, [np.sin(angle), -np.cos(angle)]))
    late = []
    for count in (100, 200, 400):
        tip = follow(model, 4, start, [0.0, 0.75 * period], period / count).positions[-1, -1]
        # It passes the lowest point a third time when 3/4 of its period are over.
        late.append(np.array(-np.arctan2(tip[0], -tip[1]) / np.sqrt(2 * 9.81 * (1 - np.cos(angle))) / 0.75))
    assert (late[0] - late[1]) / (late[1] - late[2]) == pytest.approx(4.0, abs=0.05)
    # What is left is of fourth order: a 15th of the change of the extrapolated values.
    last, before = extrapolated(late[1], late[2]), extrapolated(late[0], late[1])
    assert abs(last) < 0.2 * abs(last - before) < 1e-6


@pytest.mark.slow
def test_free_fall_follows_the_two_laws() -> None:
    """A straight free thread falls by tanh laws of its own across and along, without tension (case D03)."""
    given = inputs("D03")
    angle = np.deg2rad(given["theta_deg"])
    along, across = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    model = Thread(
        dimension=2,
        length=given["L"],
        ends=(free([0.0, 0.0]), free([0.0, 0.0])),
        weight=given["w"],
        normal_drag=given["kn"],
        tangential_drag=given["kt"],
        mass=given["m"],
        added_mass=given["ma"],
    )
    rows = []
    for step in (0.01, 0.005, 0.0025):
        motion = follow(model, 4, InitialMotion(position=lambda s: np.outer(s, along)), [0.0, *given["t"]], step)
        fall, speed = motion.positions[0] - motion.positions[1:], -motion.velocities[1:]
        rows.append(np.array([speed @ across, fall @ across, speed @ along, fall @ along])[:, :, 2])
        # Rounding grows as it falls: broadside is no stable way to fall.
        assert np.abs(motion.tensions).max() < 1e-8
        assert motion.slack == ()
    # Of fourth order, of which the change of extrapolated values is 16 times what is left.
    values = extrapolated(rows[1], rows[2])
    left = np.abs(values - extrapolated(rows[0], rows[1])).max()
    for key, value in zip(("V_n", "drop_n", "V_t", "drop_t"), values, strict=True):
        assert np.abs(value - results("D03")[key]).max() < 0.5 * left < 1e-7


def test_swing_in_liquid() -> None:
    """Case D05, at all times."""
    tips = [swing_in_liquid(step).positions[1:, -1] for step in (0.005, 0.0025)]
    assert worst_difference("D05", tip=extrapolated(*tips).ravel()) < tolerance("D05")


@pytest.mark.slow_but("0.6")
@pytest.mark.parametrize("dissipation", [None, 0.6])
def test_second_order_in_time(dissipation: float | None) -> None:
    """Positions of the tip and tensions, by both rules, over three steps."""
    motions = [
        follow(chain(), 6, swing(1.0), [0.0, 0.2, 0.4, 0.6], step, dissipation=dissipation)
        for step in (0.02, 0.01, 0.005)
    ]
    for values in ([motion.positions[1:, -1] for motion in motions], [motion.tensions[1:] for motion in motions]):
        changes = [np.abs(a - b).max() for a, b in pairwise(values)]
        # Measured 1.98 to 2.11.
        assert np.log2(changes[0] / changes[1]) == pytest.approx(2.0, abs=0.15)


@pytest.mark.slow
def test_independence_of_the_mesh() -> None:
    """Twice as many elements of lower degree move the tip by less than the step does."""
    fine, other = swing_in_liquid(0.0025), swing_in_liquid(0.0025, elements=20, degree=2)
    coarse = swing_in_liquid(0.005)
    change = np.abs(fine.positions[1:4, -1] - other.positions[1:4, -1]).max()
    assert change < 0.2 * np.abs(fine.positions[1:4, -1] - coarse.positions[1:4, -1]).max()


def test_balance_of_energy() -> None:
    """In each step the energy grows by the work of the liquid, and the drag of still liquid never drives."""
    history = swing_in_liquid(0.01).history
    assert np.abs(history.imbalance).max() < 1e-12 * history.energies[:, 0].max()
    assert np.all(history.work[:, 0] < 0.0)
    assert np.all(history.work[:, 3] == 0.0)
    assert history.energies[-1].sum() - history.energies[0].sum() < -1.5


VACUUM: dict[str, tuple[int, dict[str, float]]] = {
    "stiff, short": (250, {"axial_rigidity": 1e6}),
    # After 20 s it becomes slack, and is given up.
    "inextensible": (1_000, {}),
    "stiff": (1_000, {"axial_rigidity": 1e6}),
    "soft and bending": (10_000, {"axial_rigidity": 200.0, "flexural_rigidity": 0.05}),
}


@pytest.mark.slow_but("stiff, short")
@pytest.mark.parametrize("case", VACUUM)
def test_energy_is_kept(case: str) -> None:
    """Without liquid, to round-off, however the thread whips."""
    steps, rigidity = VACUUM[case]
    motion = follow(chain(**rigidity), 10, swing(), [0.0, 0.01 * steps], 0.01)
    energies = motion.history.energies
    assert np.abs(energies.sum(axis=1) - energies[0].sum()).max() < 1e-10 * energies[:, 0].max()
    assert energies[:, 0].max() > 2.0 * energies[:, 0].min()


def test_length_is_kept() -> None:
    """Nodes of a thread that cannot stretch are never farther apart than along it."""
    positions = swing_in_liquid(0.005).positions
    chords = np.linalg.norm(np.diff(positions, axis=1), axis=2)
    assert np.all(chords < 0.1 * (1.0 + 1e-9))
    assert np.all(chords > 0.1 * (1.0 - 0.05))


def oblique(azimuth: float) -> InitialMotion:
    """The swing, with a helix of velocity so that it is no plane motion."""
    base = swing(2.5, azimuth, dimension=3)

    def velocity(s: Any) -> Any:
        assert base.velocity is not None
        side = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
        return base.velocity(s) + np.outer(np.sin(3.0 * s), side)

    return InitialMotion(position=base.position, velocity=velocity)


def test_rotation_about_the_vertical() -> None:
    """Turned by 40 degrees the thread moves the same way."""
    angle = np.deg2rad(40.0)
    turn = np.array([[np.cos(angle), -np.sin(angle), 0.0], [np.sin(angle), np.cos(angle), 0.0], [0.0, 0.0, 1.0]])
    motions = [follow(chain(3, **liquid()), 6, oblique(azimuth), [0.0, 0.5], 0.01) for azimuth in (0.0, angle)]
    assert np.abs(motions[0].positions @ turn.T - motions[1].positions).max() < 1e-12
    assert np.abs(motions[0].positions[-1, :, 1]).max() > 0.1


def test_plane_motion_in_space() -> None:
    """Three dimensions give the numbers of two."""
    flat = follow(chain(**liquid()), 6, swing(), [0.0, 0.5], 0.01)
    space = follow(chain(3, **liquid()), 6, swing(dimension=3), [0.0, 0.5], 0.01)
    assert np.abs(space.positions[..., [0, 2]] - flat.positions).max() < 1e-12
    assert np.abs(space.tensions - flat.tensions).max() < 1e-9
