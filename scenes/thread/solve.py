"""All that a scene asks of a thread."""

from __future__ import annotations

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.stopwatch import Report, Stopwatch
from hydroelastic.fem.thread.profile import ThreadProfile
from hydroelastic.scenes.models import thread_analyses as analyses
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.thread.equilibrium import FoundEquilibrium, find_equilibrium
from hydroelastic.scenes.thread.frame import Frame, frame_of
from hydroelastic.scenes.thread.modes import modes_of, stability_of
from hydroelastic.scenes.thread.motion import motion_of
from hydroelastic.scenes.thread.results import FollowedMotion, RestingThread, ThreadSolutionOfScene


def solve_thread_scene(scene: ThreadScene, comm: MPI.Comm, report: Report) -> ThreadSolutionOfScene:
    """Solve a scene for its equilibrium, and then for each of its analyses.

    Args:
        scene: the scene.
        comm: the processes.
        report: told what is being done.

    Returns:
        The solution (collective).

    Raises:
        UnsolvedError: if a part of it cannot be solved.
    """
    watch, frame = Stopwatch(), frame_of(scene)
    report("equilibrium")
    with watch.stage("equilibrium"):
        found = find_equilibrium(comm, scene, frame)
    modes, sweeps, motions = [], [], []
    for analysis in scene.analysis:
        report(analysis.kind)
        with watch.stage(analysis.kind):
            if isinstance(analysis, analyses.ThreadModes):
                modes.append(modes_of(comm, scene, frame, found.solution, analysis))
            elif isinstance(analysis, analyses.ThreadStability):
                sweeps.append(stability_of(comm, scene, frame, found.solution, analysis))
            else:
                motions.append(motion_of(comm, scene, frame, found.solution, analysis))
    return ThreadSolutionOfScene(
        scene=scene,
        frame=frame,
        rest=_resting(scene, frame, found),
        modes=tuple(modes),
        stability=tuple(sweeps),
        motions=tuple(motions),
        size=_size(found, motions),
        seconds=watch.seconds,
    )


def _resting(scene: ThreadScene, frame: Frame, found: FoundEquilibrium) -> RestingThread:
    profile, errors = found.solution.profile, found.solution.errors
    s, ends = np.array(scene.positions), profile.nodes[[0, -1]]
    smallest, place = profile.smallest_tension()
    return RestingThread(
        positions=frame.places(profile.position(s)),
        tensions=profile.tension_at(s),
        forces=frame.outside(profile.contact_force(s)),
        curvatures=_curvatures(profile, s),
        end_positions=frame.places(profile.position(ends)),
        end_tensions=np.array([profile.tension[0, 0], profile.tension[-1, 1]]),
        reactions=frame.outside(profile.reactions()),
        end_moments=profile.end_moments(),
        largest_tension=float(np.max(profile.tension)),
        smallest_tension=smallest,
        smallest_at=place,
        position_error=errors.position,
        tension_error=errors.tension,
        reaction_error=errors.reaction,
        moment_error=errors.moment,
        relative_error=errors.relative,
        start=found.start,
        newton_steps=found.solution.newton_steps,
        failed_starts=found.failed,
    )


def _curvatures(profile: ThreadProfile, s: np.ndarray) -> np.ndarray:
    """|r_ss|, of a thread that does not bend by the second derivative of its positions."""
    if profile.curvature_table is not None:
        return np.asarray(np.linalg.norm(profile.curvature_table.at(s), axis=1))
    slope, second = profile.position_table.at(s, 1), profile.position_table.at(s, 2)
    along = np.sum(slope * second, axis=1) / np.sum(slope**2, axis=1)
    return np.asarray(np.linalg.norm(second - along[:, None] * slope, axis=1) / np.sum(slope**2, axis=1))


def _size(found: FoundEquilibrium, motions: list[FollowedMotion]) -> dict[str, int]:
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
