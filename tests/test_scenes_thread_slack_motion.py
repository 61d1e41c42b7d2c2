"""Threads that are slack, or have no tension at all: a free fall is good, what would fold without end is refused early.

A heavy bob two radians from the vertical, 0.43 above the horizontal, would have to be pushed by its thread; a thread
that falls freely has no tension at all (case D02 of the references).
"""

from dataclasses import replace
from math import cos
from typing import Any

import numpy as np
import pytest
from mpi4py import MPI
from thread_motions import follow, free, held

from hydroelastic.fem.thread import motion_refinement as motion_module
from hydroelastic.fem.thread.force_scale import force_scale
from hydroelastic.fem.thread.motion import InitialMotion
from hydroelastic.fem.thread.motion_errors import MotionWithErrors, Run, motion_with_errors
from hydroelastic.fem.thread.motion_plan import MotionPlan, PrescribedEnd, ThreadMotionError
from hydroelastic.fem.thread.time_integrator import TimeIntegrator
from hydroelastic.physics.thread import Thread
from hydroelastic.scenes.errors import UnsolvedError
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.thread.results import ThreadSolutionOfScene
from hydroelastic.scenes.thread.solve import solve_thread_scene

BOB = 981000.0
ABOVE = [0.9092974268256817, 0.0, 0.4161468365471424]
# More than what any of these motions takes, which are refused after some hundred attempts or none.
MOST_ATTEMPTS = 2000


def scene(thread: dict[str, Any], motion: dict[str, Any], **parts: Any) -> ThreadScene:
    document = {
        "thread": {"length": 1.0, **thread},
        "analysis": [{"kind": "motion", "start": "straight", **motion}],
        "output": {"frames": 0},
        **parts,
    }
    return ThreadScene.model_validate(document)


def solve(asked: ThreadScene) -> ThreadSolutionOfScene:
    return solve_thread_scene(asked, MPI.COMM_WORLD, lambda _message: None)


@pytest.fixture
def attempts(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """Lengths of all steps that are tried; too many of them are an error."""
    taken: list[float] = []
    solve_step = TimeIntegrator.solve_step

    def counted(integrator: TimeIntegrator, length: float) -> int | None:
        taken.append(length)
        assert len(taken) < MOST_ATTEMPTS, "the motion grinds"
        return solve_step(integrator, length)

    monkeypatch.setattr(TimeIntegrator, "solve_step", counted)
    return taken


def falling(**motion: Any) -> ThreadScene:
    """A straight thread in water that is released at once: its tension is zero."""
    thread = {"weight": 5.0, "mass": 1.0, "diameter": 0.02, "normal_drag": 1.23, "tangential_drag": 0.0205}
    return scene(
        {**thread, "added_mass": 1.0},
        {"direction": [0.866025403784, 0.0, -0.5], "release": [{"end": "a", "time": 0.0}], **motion},
        stream={"density": 1000.0},
        ends={"b": {"kind": "free"}},
    )


@pytest.mark.slow
def test_a_motion_that_refinement_makes_worse_is_given_at_its_best(monkeypatch: pytest.MonkeyPatch) -> None:
    """Short waves of a thread without tension grow by themselves, and a finer mesh holds shorter ones."""
    errors = iter([2e-3, 3e-3])

    def measured(run: Run, plan: MotionPlan, *, mesh: bool) -> MotionWithErrors:
        found = motion_with_errors(run, plan, mesh=mesh)
        return replace(found, steps=replace(found.steps, positions=next(errors)))

    monkeypatch.setattr(motion_module, "motion_with_errors", measured)
    solution = solve(falling(times=[0.0, 0.2], tolerance=1e-3))
    assert solution.motions[0].step_error == 2e-3
    assert any("of positions" in reason for reason in solution.reasons)


@pytest.mark.slow_but("0.1")
@pytest.mark.parametrize("tolerance", [1e-1, 1e-4])
def test_a_free_fall_is_converged(tolerance: float) -> None:
    solution = solve(falling(times=[0.0, 0.2], tolerance=tolerance))
    (motion,) = solution.motions
    assert solution.reasons == ()
    # Exactly zero; 1e-8 of the weight is what counts as compression.
    assert np.abs(motion.tensions).max() < 1e-8 * 5.0
    # A hundredth of the weight of 5 N, or of the drag by 12.3 N·s²/m³ at 0.7 m/s; a tenth of that must be known.
    assert 0.05 < motion.extremes.size < 0.0603
    unknown = replace(motion, extremes=replace(motion.extremes, error=0.11 * motion.extremes.size))
    (reason,) = replace(solution, motions=(unknown,)).reasons
    assert "estimated error of tensions" in reason


def test_the_force_scale_is_the_largest_force() -> None:
    def model(**given: Any) -> Thread:
        options: dict[str, Any] = {"ends": (held([0.0, 0.0]), free([0.0, 0.0]))} | given
        return Thread(dimension=2, length=2.0, **options)

    drag = {"normal_drag": 3.0, "viscous_drag": 0.5}
    loaded = (held([0.0, 0.0]), free([3.0, 4.0], drag=2.0))
    cases = [
        (model(weight=-7.0), 0.0, 14.0),
        (model(ends=loaded), 0.0, 5.0),
        (model(ends=loaded, weight=1.0), 3.0, 5.0 + 2.0 * 9.0),
        (model(**drag), 3.0, (3.0 * 9.0 + 0.5 * 3.0) * 2.0),
        (model(flexural_rigidity=8.0), 0.0, 2.0),
        (model(added_mass=6.0, reactive="lighthill"), 2.0, 24.0),
        (model(added_mass=6.0), 2.0, 0.0),
        (model(axial_rigidity=1e9), 0.0, 1e3),
        (model(axial_rigidity=1e9, weight=1.0), 0.0, 2.0),
    ]
    for given, speed, expected in cases:
        assert force_scale(given, speed) == pytest.approx(expected, rel=1e-15)


@pytest.mark.slow_but("1000*")
@pytest.mark.parametrize("rigidity", [None, 1e12])
def test_a_slack_start_is_refused_at_once(rigidity: float | None, attempts: list[float]) -> None:
    asked = scene(
        {"weight": 9.81, "mass": 1.0, "axial_rigidity": rigidity},
        {"times": [0.0, 1.3, 2.7], "direction": ABOVE, "tolerance": 1e-5},
        ends={"b": {"kind": "free", "weight": BOB, "mass": 1e5}},
    )
    with pytest.raises(UnsolvedError, match=r"starts slack.*flexural_rigidity") as refused:
        solve(asked)
    # The weight of bob and thread along the thread, at end A.
    assert f"{(BOB + 9.81) * cos(2.0):.4g} N at s = 0 m" in str(refused.value)
    assert attempts == []


@pytest.mark.parametrize("height", [-1e-2, 0.0])
def test_a_start_that_is_not_slack_is_followed(height: float) -> None:
    asked = scene(
        {"weight": 9.81, "mass": 1.0, "axial_rigidity": 1e6},
        {"times": [0.0, 0.1], "direction": [1.0, 0.0, height], "tolerance": 1e-2, "step": 0.02},
        ends={"b": {"kind": "free", "weight": 98.1, "mass": 10.0}},
    )
    (motion,) = solve(asked).motions
    # Down by g t²/2 of a bob that begins to fall, on its circle: cos of its angle is that of a pendulum to its fourth.
    assert motion.positions[-1, -1, 2] == pytest.approx(height - 0.5 * 9.81 * 0.1**2, rel=2e-2)


def test_a_stiff_thread_that_becomes_slack_is_given_up(attempts: list[float]) -> None:
    """The upper end is pushed down faster than the heavy bob falls."""
    bob = free([0.0, -BOB], mass=1e5)
    model = Thread(dimension=2, length=1.0, ends=(held([0.0, 0.0]), bob), weight=9.81, mass=1.0, axial_rigidity=1e12)
    lead = PrescribedEnd(position=lambda time: np.array([0.02 * time**2, -20.0 * time**2]))
    hanging = InitialMotion(position=lambda s: np.outer(s, [0.0, -1.0]))
    with pytest.raises(ThreadMotionError, match=r"slack.*flexural_rigidity"):
        follow(model, 4, hanging, [0.0, 0.5], 0.05, tolerance=1e-5, ends=(lead, PrescribedEnd()))
    assert len(attempts) > 100
