"""Rounding errors of a thread at rest, by the residual and by the response to a stretch of the whole thread.

Lengths of elements are differences of positions, so that |r_s| is known to some eps times the number of elements. A
taut thread answers to a stretch ε with the tension ε/(1/EA + |Pq|²L²/12T³), EA ε if it is nearly straight: 1e-9 of the
tension and more where that is far below EA. The response y of all unknowns solves F'(w) y = ∫μ.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.thread.equilibrium import Equilibrium
from hydroelastic.fem.thread.table import line_table
from hydroelastic.meshes.compat import collapsed


@dataclass(frozen=True, kw_only=True)
class ThreadRounding:
    """Estimated bounds of rounding errors, SI."""

    position: float  # of the whole thread, m
    tension: float  # of the whole thread, N
    reaction: float  # N
    moment: float  # N m


def thread_rounding(equilibrium: Equilibrium) -> ThreadRounding:
    """Rounding of a solution by Newton's method (collective)."""
    space, units, response = equilibrium.space, equilibrium.units, equilibrium.stretch_response
    stretch = _stretch_unknown(equilibrium)
    position = line_table(response, space.nodes, 0)
    tension = stretch * float(np.max(np.abs(line_table(response, space.nodes, 1).values)))
    largest = float(np.max(np.abs(line_table(equilibrium.solution, space.nodes, 1).values)))
    turn = stretch * float(np.max(np.linalg.norm(position.at_ends(derivative=1), axis=2)))
    moment = 0.0
    if equilibrium.model.bends:
        bend = float(np.max(np.linalg.norm(line_table(response, space.nodes, 2).values, axis=2)))
        moment = stretch * bend * equilibrium.model.flexural_rigidity / units.length
    return ThreadRounding(
        position=stretch * float(np.max(np.linalg.norm(position.values, axis=2))) * units.length,
        tension=tension * units.force,
        reaction=(tension + largest * turn) * units.force,
        moment=moment,
    )


def _stretch_unknown(equilibrium: Equilibrium) -> float:
    """Uncertainty of the stretch of the whole thread: the residuals of ∫μ(|r_s| − 1 − S/EA), whose test functions add
    up to one, with equal signs; and no less than eps for each element and each length from the origin.
    """
    space = equilibrium.space
    rows = collapsed(space.mixed, 1)[1]
    left = equilibrium.residual[rows[rows < len(equilibrium.residual)]]
    total = float(space.mesh.comm.allreduce(float(np.sum(np.abs(left))), op=MPI.SUM))
    farthest = float(np.max(np.abs(line_table(equilibrium.solution, space.nodes, 0).values)))
    least = float(np.finfo(float).eps) * (len(space.nodes) - 1) * max(farthest, 1.0)
    return max(total, least)
