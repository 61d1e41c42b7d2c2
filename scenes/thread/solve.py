"""Solution of all analyses of the scene of a thread."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.progress import Report
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.thread.equilibrium_search import FoundEquilibrium, find_equilibrium
from hydroelastic.fem.thread.hyperbolicity import IllPosedError
from hydroelastic.fem.thread.mode_refinement import modes_to_tolerance, stability_in_growing_stream
from hydroelastic.fem.thread.motion_in_space import MotionInSpace
from hydroelastic.fem.thread.motion_plan import ThreadMotionError
from hydroelastic.fem.thread.motion_refinement import motion_to_tolerance
from hydroelastic.fem.thread.newton import ThreadSolverError
from hydroelastic.fem.thread.refinement import NoEquilibriumError
from hydroelastic.fem.thread.resting_thread import resting_thread
from hydroelastic.scenes.errors import UnsolvedError
from hydroelastic.scenes.models import thread_analyses as analyses
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.thread.physics import frame_of, motion_request_of, thread_of
from hydroelastic.scenes.thread.results import ThreadSolutionOfScene

_ILL_POSED = {"modes": "the modes are", "stability": "the stability is"}
_NOT_FOUND = {"modes": "the modes could not be found", "stability": "the stability could not be followed"}


def solve_thread_scene(scene: ThreadScene, comm: MPI.Comm, report: Report) -> ThreadSolutionOfScene:
    """Solve a scene for its equilibrium, and then for each of its analyses."""
    thread, frame, tolerance = thread_of(scene), frame_of(scene), scene.accuracy.tolerance
    report("equilibrium")
    found = equilibrium_of(comm, scene)
    rest = found.solution
    modes, sweeps, motions = [], [], []
    for asked in scene.analysis:
        report(asked.kind)
        with _failures_in_words(asked):
            if isinstance(asked, analyses.ThreadModes):
                damping = asked.velocity_damping
                modes.append(
                    modes_to_tolerance(comm, thread, frame, rest, asked.count, tolerance, velocity_damping=damping)
                )
            elif isinstance(asked, analyses.ThreadStability):
                sweeps.append(stability_in_growing_stream(comm, thread, frame, rest, asked.factors))
            else:
                request = motion_request_of(scene, asked)
                motions.append(motion_to_tolerance(comm, thread, frame, rest, request, rest_tolerance=tolerance))
    return ThreadSolutionOfScene(
        scene=scene,
        thread=thread,
        frame=frame,
        rest=resting_thread(found, frame, np.array(scene.positions)),
        modes=tuple(modes),
        stability=tuple(sweeps),
        motions=tuple(motions),
        size=_size(found, motions),
    )


@contextmanager
def _failures_in_words(asked: analyses.ThreadAnalysis | None = None) -> Iterator[None]:
    """Convert errors of the solvers to an `UnsolvedError` that names the part of the scene."""
    try:
        yield
    except NoEquilibriumError as error:
        still = isinstance(asked, analyses.ThreadMotion) and asked.start == "still_liquid"
        raise UnsolvedError(f'start = "still_liquid": without the stream {error}' if still else str(error)) from error
    except IllPosedError as error:
        assert asked is not None
        raise UnsolvedError(f"{_ILL_POSED[asked.kind]} ill-posed: {error}") from error
    except (EigenSolverError, ThreadMotionError, ThreadSolverError) as error:
        words = _NOT_FOUND.get(asked.kind) if asked else None
        raise UnsolvedError(f"{words}: {error}" if words else str(error)) from error


def equilibrium_of(comm: MPI.Comm, scene: ThreadScene) -> FoundEquilibrium:
    """Return the equilibrium of a scene in its frame (collective)."""
    with _failures_in_words():
        return find_equilibrium(comm, thread_of(scene), frame_of(scene), scene.accuracy.tolerance)


def _size(found: FoundEquilibrium, motions: list[MotionInSpace]) -> dict[str, int]:
    space = found.solution.equilibrium.space
    dofmap = space.mixed.dofmap
    size = {
        "cells": len(space.nodes) - 1,
        "degree": space.degree,
        "dofs": int(dofmap.index_map.size_global * dofmap.index_map_bs),
    }
    if motions:
        size["steps"] = sum(motion.steps for motion in motions)
    return size
