"""Extremes of tension in a motion of a thread: of all its steps, with an error that covers them."""

import numpy as np
import pytest
from mpi4py import MPI

from hydroelastic.fem.thread.motion_errors import MotionDifference, MotionWithErrors
from hydroelastic.output.thread.quantities import THREAD
from hydroelastic.output.thread.tables import thread_sections
from hydroelastic.output.variables import array_variables
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.thread.results import ThreadSolutionOfScene
from hydroelastic.scenes.thread.run import run_thread
from hydroelastic.scenes.thread.solve import solve_thread_scene

HEAVED = (
    'analysis=[{{kind = "motion", times = {times}, tolerance = 1e-3, '
    'move = [{{end = "a", amplitude = [0.0, 0.0, 0.5], omega = 2.0, rise = 1.0}}]}}]'
)


def heaved(times: str) -> ThreadSolutionOfScene:
    """A moored buoy whose anchor heaves."""
    scene = read_scene("moored_buoy", (HEAVED.format(times=times), "output.frames=0"))
    assert isinstance(scene, ThreadScene)
    return solve_thread_scene(scene, MPI.COMM_WORLD, lambda _message: None)


@pytest.fixture(scope="module")
def sparse() -> ThreadSolutionOfScene:
    return heaved("[0.0, 4.0, 8.0]")


@pytest.mark.slow
def test_extremes_do_not_depend_on_the_output_times(sparse: ThreadSolutionOfScene) -> None:
    dense = heaved("{start = 0.0, stop = 8.0, number = 161}")
    (few,), (many,) = sparse.motions, dense.motions
    # At the output times alone the largest tension is missed by far more than what is said of it.
    error = few.extremes.error + many.extremes.error
    assert few.tensions.max() < many.tensions.max() - 2.0 * error
    assert few.extremes.highest.max() == pytest.approx(many.extremes.highest.max(), abs=error)
    assert few.extremes.lowest.min() == pytest.approx(many.extremes.lowest.min(), abs=error)
    assert few.extremes.end_tensions.max(axis=0) == pytest.approx(many.extremes.end_tensions.max(axis=0), abs=error)
    assert few.extremes.error >= few.tension_error


def test_all_that_is_told_is_of_all_steps(sparse: ThreadSolutionOfScene) -> None:
    (motion,) = sparse.motions
    summary = run_thread.summarized(sparse.scene, sparse)
    (told,) = summary["motion"]
    assert told["largest_tension"] == motion.extremes.highest.max()
    assert told["extreme_tension_error"] == motion.extremes.error
    time, place = told["largest_tension_at"]
    assert time in motion.step_ends
    assert place in motion.nodes
    arrays = {array.name: array.values for array in array_variables(THREAD, sparse)}
    highest = arrays["extreme"].tolist().index("highest")
    assert arrays["tension_range"][:, highest].max() == told["largest_tension"]
    ends = arrays["end_tension"]
    assert np.column_stack([ends.min(axis=0), ends.max(axis=0)]).tolist() == told["end_tensions_range"]
    rows = {row[0] for section in thread_sections(run_thread.read(summary)) for row in section.rows}
    assert {"largest tension over all steps, N", "estimated error of the extremes of tension, N"} <= rows


def test_slack_is_judged_by_the_error_of_its_time() -> None:
    nothing = MotionDifference(positions=0.0, velocities=0.0, tensions=0.0)
    measured = MotionWithErrors(
        motion=None,  # type: ignore[arg-type]
        steps=nothing,
        mesh=nothing,
        ends=np.array([0.0, 1.0, 2.0, 3.0]),
        tension_changes=np.array([8.0, 1.0, 2.0, 4.0]),
    )
    # The steps' ends around a time count, others do not.
    assert measured.tension_change(1.0, 1.5) == 2.0
    assert measured.tension_change(0.5, 0.5) == 8.0
    assert measured.tension_change(2.5, 3.0) == 4.0
