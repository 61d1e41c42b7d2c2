"""Motions that do not oscillate are judged, and refined, as those that do."""

from dataclasses import replace

import numpy as np
import pytest
from mpi4py import MPI

from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.thread.results import ThreadSolutionOfScene
from hydroelastic.scenes.thread.run import run_thread
from hydroelastic.scenes.thread.solve import solve_thread_scene

TOLERANCE = 1e-6
# A buoyant line that hangs in a stream between fixed ends, of whose first 27 roots 22 are real.
HEAVILY_DAMPED = {
    "thread": {
        "length": 691.3915738971978,
        "diameter": 0.014606320526490253,
        "normal_drag": 0.41044095071395204,
        "weight": -10.344128599987942,
        "mass": 0.6053917739879237,
        "axial_rigidity": 185352870.2550414,
    },
    "stream": {"density": 1000.0, "velocity": [-0.6943079866011038, 0.0]},
    "ends": {"b": {"kind": "fixed", "position": [44.360017318137935, 103.36364762208115, 294.76382083608235]}},
    "analysis": [{"kind": "modes", "count": 5}],
}


def solved(tolerance: float) -> ThreadSolutionOfScene:
    scene = ThreadScene.model_validate({**HEAVILY_DAMPED, "accuracy": {"tolerance": tolerance}})
    return solve_thread_scene(scene, MPI.COMM_WORLD, lambda _message: None)


@pytest.fixture(scope="module")
def solution() -> ThreadSolutionOfScene:
    return solved(TOLERANCE)


@pytest.mark.slow
def test_all_roots_keep_the_tolerance(solution: ThreadSolutionOfScene) -> None:
    (modes,) = solution.modes
    # On the first mesh the largest error of an oscillating root is 8.1e-7, that of a real one 6.1e-6.
    assert modes.oscillating.relative_errors.max() <= TOLERANCE
    assert modes.aperiodic.relative_errors.max() <= TOLERANCE
    assert modes.relative_error == modes.aperiodic.relative_errors.max()
    assert solution.reasons == ()
    finer = solved(1e-8).modes[0]
    for coarse, fine in ((modes.oscillating, finer.oscillating), (modes.aperiodic, finer.aperiodic)):
        assert np.all(np.abs(coarse.values - fine.values) <= coarse.errors + fine.errors)


def test_a_real_root_of_a_large_error_is_unconverged(solution: ThreadSolutionOfScene) -> None:
    (modes,) = solution.modes
    errors = modes.aperiodic.errors.copy()
    errors[19] = 6.1 * TOLERANCE * abs(modes.aperiodic.values[19])
    rough = replace(solution, modes=(replace(modes, aperiodic=replace(modes.aperiodic, errors=errors)),))
    (reason,) = rough.reasons
    assert "root that does not oscillate is 6.1e-06" in reason
    assert run_thread.summarized(rough.scene, rough)["status"] == "unconverged"
