"""Modes of a thread to a tolerance, and thresholds of its stability as the stream grows."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.adaptive import ErrorEstimate, adaptive_solve
from hydroelastic.fem.thread.equilibrium import Equilibrium
from hydroelastic.fem.thread.frame import Frame
from hydroelastic.fem.thread.modes import ThreadModes, thread_modes
from hydroelastic.fem.thread.motion_errors import halved
from hydroelastic.fem.thread.profile import start_from, thread_profile
from hydroelastic.fem.thread.refinement import ThreadSolution
from hydroelastic.fem.thread.stability import Stability, stability
from hydroelastic.fem.thread.straight import equilibrium_on
from hydroelastic.physics.thread import Thread

# Number of halvings for modes, whose errors may exceed those of the equilibrium.
_MOST_HALVINGS = 4


def modes_to_tolerance(
    comm: MPI.Comm,
    thread: Thread,
    frame: Frame,
    rest: ThreadSolution,
    count: int,
    tolerance: float,
    *,
    velocity_damping: bool = True,
) -> ThreadModes:
    """The slowest motions about an equilibrium, on meshes that are refined until their errors are within a
    tolerance."""
    start, degree = start_from(rest.profile), rest.equilibrium.space.degree

    def refine(meshes: tuple[Equilibrium, Equilibrium], _found: ThreadModes) -> tuple[Equilibrium, Equilibrium]:
        _, fine = meshes
        nodes = halved(np.asarray(fine.space.nodes * fine.units.length))
        return fine, equilibrium_on(comm, thread, frame, nodes, start, degree)

    return adaptive_solve(
        (equilibrium_on(comm, thread, frame, rest.profile.nodes[::2], start, degree), rest.equilibrium),
        lambda meshes: thread_modes(meshes[1], meshes[0], count, velocity_damping=velocity_damping),
        lambda found: ErrorEstimate(discretization=found.relative_error),
        refine,
        tolerance,
        rounds=_MOST_HALVINGS + 1,
    ).solution


def stability_in_growing_stream(
    comm: MPI.Comm, thread: Thread, frame: Frame, rest: ThreadSolution, factors: Sequence[float]
) -> Stability:
    """Thresholds of divergence and flutter by the factor of the stream."""
    # Each equilibrium starts from the one before: the stream changes little.
    last = start_from(rest.profile)

    def equilibrium_at(factor: float, step: int = 1) -> Equilibrium:
        nonlocal last
        nodes, degree = rest.profile.nodes[::step], rest.equilibrium.space.degree
        found = equilibrium_on(comm, thread.with_stream_factor(factor), frame, nodes, last, degree)
        last = start_from(thread_profile(found))
        return found

    return stability(equilibrium_at, lambda factor: equilibrium_at(factor, 2), np.array(factors))
