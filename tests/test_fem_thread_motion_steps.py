"""Steps of a thread's motion: how long they are, what errors they leave, generalised alpha, what is refused."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
from mpi4py import MPI
from thread_motions import chain, follow, free, liquid, swing

from hydroelastic.fem.thread.motion import move_thread
from hydroelastic.fem.thread.motion_errors import halved, motion_with_errors
from hydroelastic.fem.thread.motion_plan import MotionPlan, PrescribedEnd
from hydroelastic.fem.thread.motion_results import ThreadMotion
from hydroelastic.fem.thread.step_control import StepControl
from hydroelastic.physics.thread import Thread
from hydroelastic.physics.thread_motion import VortexShedding

# Before the tip of case D05 is whipped.
TIMES = (0.0, 0.25, 0.5, 1.0)


@cache
def fine_swing() -> ThreadMotion:
    """Case D05, with an error of 1e-6."""
    return follow(chain(**liquid()), 10, swing(), TIMES, 0.00125, degree=3)


def away(motion: ThreadMotion) -> float:
    """How far a motion is from the fine one."""
    return float(np.linalg.norm(motion.positions - fine_swing().positions, axis=2).max())


def test_steps_follow_their_errors() -> None:
    """A tolerance a tenth as large leaves a smaller error, with more steps, which end at the output times."""
    motions = [follow(chain(**liquid()), 10, swing(), TIMES, 0.1, degree=3, tolerance=size) for size in (1e-4, 1e-5)]
    # Each step adds an error: that of the end is many times the tolerance, and falls like its power 2/3.
    errors = np.array([away(motion) for motion in motions])
    assert np.all(errors < [2.5e-3, 5e-4])
    assert errors[1] < 0.5 * errors[0]
    counts = [len(motion.history.solutions) for motion in motions]
    assert counts[0] < counts[1] < 300
    for motion in motions:
        assert np.abs(motion.times - TIMES).max() < 1e-12
        assert np.all(np.min(np.abs(motion.history.ends[:, None] - TIMES), axis=0) < 1e-12)
    assert np.abs(motions[0].history.imbalance).max() < 1e-12


def test_halved_steps_and_elements_tell_the_error() -> None:
    """Their differences cover the true errors, and are not ten times as large."""

    def run(plan: MotionPlan, parts: int) -> ThreadMotion:
        nodes = np.linspace(0.0, 1.0, 6 * parts + 1)
        return move_thread(MPI.COMM_WORLD, chain(**liquid()), nodes, swing(), plan, degree=2)

    plan = MotionPlan(times=np.array(TIMES), step=0.01)
    measured = motion_with_errors(run, plan, mesh=True)
    assert len(measured.motion.history.solutions) == 200
    assert measured.mesh is not None
    tips = [motion.positions[:, -1] for motion in (measured.motion, fine_swing())]
    error = np.linalg.norm(tips[0] - tips[1], axis=1).max()
    stated = measured.steps.positions + measured.mesh.positions
    assert error < stated < 20.0 * error
    assert measured.steps.tensions > 0.0
    assert measured.steps.velocities > 0.0


def test_halved() -> None:
    """Numbers and their middles."""
    assert halved(np.array([0.0, 1.0, 4.0])).tolist() == [0.0, 0.5, 1.0, 2.5, 4.0]


def test_step_control() -> None:
    """Equal steps land on the stop; those that failed are halved, and grow again."""
    control = StepControl(0.3, None)
    assert control.next_length(1.0) == pytest.approx(0.25)
    assert control.reject(0.25, np.inf) == 0.125
    assert control.next_length(1.0) == 0.125
    control.accept(0.125, 0.0)
    assert control.next_length(1.0) == 0.25
    assert not control.is_too_short(1e-3)
    assert control.is_too_short(1e-5)
    assert StepControl(0.3, 1e-6).is_acceptable(1e-6)
    assert not StepControl(0.3, 1e-6).is_acceptable(2e-6)


@pytest.mark.slow_but("inf")
@pytest.mark.parametrize("rigidity", [np.inf, 400.0])
def test_generalised_alpha(rigidity: float) -> None:
    """In liquid too it tends to what the midpoint rule tends to."""
    model = chain(axial_rigidity=rigidity, **liquid())
    coarse, fine = (follow(model, 6, swing(), [0.0, 0.2], step, dissipation=0.6) for step in (0.005, 0.0025))
    other = follow(model, 6, swing(), [0.0, 0.2], 0.0025)
    # Of second order both: what is left of either is a third of the change.
    change = np.abs(fine.positions - coarse.positions).max()
    assert np.abs(other.positions - fine.positions).max() < change < 1e-3


def test_generalised_alpha_loses_energy() -> None:
    """More so at a smaller radius."""
    lost = []
    for radius in (0.6, 0.0):
        motion = follow(chain(), 6, swing(), [0.0, 1.5], 0.01, dissipation=radius)
        energies = motion.history.energies.sum(axis=1)
        lost.append(energies[0] - energies[-1])
    assert 0.0 < 3.0 * lost[0] < lost[1] < 0.2


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"times": np.array([1.0])}, "times"),
        ({"times": np.array([0.0, 1.0, 1.0])}, "times"),
        ({"step": 0.0}, "step is 0.0"),
        ({"tolerance": 2.0}, "tolerance is 2.0"),
        ({"dissipation": 1.0}, "dissipation is 1.0.*below 1"),
        ({"rest_speed": 0.0}, "rest_speed is 0.0"),
    ],
)
def test_plans_that_are_refused(changes: dict[str, Any], message: str) -> None:
    """With the argument, its value, and what is allowed."""
    with pytest.raises(ValueError, match=message):
        MotionPlan(**{"times": np.array([0.0, 1.0]), "step": 0.1, **changes})


@pytest.mark.parametrize(
    ("model", "changes", "message"),
    [
        (chain(mass=0.0), {}, "mass is 0.0"),
        (chain(reactive="lighthill", added_mass=1.0), {"dissipation": 0.5}, "lighthill"),
        (chain(), {"shedding": VortexShedding(lift=1.0, wave_number=1.0)}, "shedding"),
        (chain(), {"ends": (PrescribedEnd(release=(1.0,)), PrescribedEnd())}, "release of end A has 1 times"),
        (
            chain(reactive="lighthill", added_mass=1.0),
            {"ends": (PrescribedEnd(release=(1.0, 1.0)), PrescribedEnd())},
            "release: not with reactive",
        ),
    ],
)
def test_plans_that_do_not_fit(model: Thread, changes: dict[str, Any], message: str) -> None:
    """Before anything is solved."""
    with pytest.raises(ValueError, match=message):
        MotionPlan(times=np.array([0.0, 1.0]), step=0.1, **changes).check(model)


def test_shedding_must_be_finite() -> None:
    """Each of its numbers."""
    with pytest.raises(ValueError, match="lift is inf"):
        VortexShedding(lift=np.inf, wave_number=1.0)


@pytest.mark.only_on_ranks
@pytest.mark.mpi
def test_shared_motion() -> None:
    """All processes get the numbers of one."""
    results = [
        follow(chain(**liquid()), 6, swing(), [0.0, 0.2], 0.01, comm=comm) for comm in (MPI.COMM_WORLD, MPI.COMM_SELF)
    ]
    assert np.abs(results[0].positions - results[1].positions).max() < 1e-12
    assert np.abs(results[0].history.energies - results[1].history.energies).max() < 1e-11
    assert np.abs(results[0].history.work - results[1].history.work).max() < 1e-11
    assert np.abs(results[0].history.reactions - results[1].history.reactions).max() < 1e-9


@pytest.mark.mpi
def test_shared_free_thread_with_loads() -> None:
    """Forces at nodes between elements, both ends free."""
    down = np.array([0.0, -1.0])
    model = chain(**liquid())
    model = Thread(
        dimension=2,
        length=1.0,
        ends=(free([0.0, 9.0]), free([0.3, 0.0])),
        mass=1.0,
        weight=9.0,
        normal_drag=2.0,
        loads={0.5: free([0.2, -1.0], mass=0.4, drag=0.3).load},
    )
    start = swing(0.0)
    results = [follow(model, 6, start, [0.0, 0.1], 0.01, comm=comm) for comm in (MPI.COMM_WORLD, MPI.COMM_SELF)]
    assert np.abs(results[0].positions - results[1].positions).max() < 1e-12
    assert np.abs(results[0].history.imbalance).max() < 1e-12
    assert np.abs(results[0].positions[-1] - np.outer(results[0].nodes, down)).max() > 1e-4
