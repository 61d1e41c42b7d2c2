"""Solve a scene with open ends: one analysis after the other, each to the tolerance that the scene asks for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.kept_tolerance import kept_tolerance
from hydroelastic.fem.memory import hand_back_memory
from hydroelastic.fem.stopwatch import Report, Stopwatch
from hydroelastic.scenes.models.open_analyses import Analysis, Decay, Radiation, Response
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.open_water.decay import DecaySolution, solve_decay
from hydroelastic.scenes.open_water.model import OpenModel
from hydroelastic.scenes.open_water.radiation import RadiationSolution, solve_radiation
from hydroelastic.scenes.open_water.resonance import ResonanceSolution, solve_resonance
from hydroelastic.scenes.open_water.response import ResponseSolution, solve_response
from hydroelastic.scenes.open_water.results import (
    DecayTable,
    OpenSolution,
    RadiationTable,
    ResonanceTable,
    ResponseTable,
)

# The power of waves is of first order in the error of the field; measured, it is off by less than the tolerance.
_POWER = 10.0

_Solution: TypeAlias = RadiationSolution | ResponseSolution | ResonanceSolution | DecaySolution
_Table: TypeAlias = RadiationTable | ResponseTable | ResonanceTable | DecayTable


@dataclass(frozen=True, kw_only=True)
class _Size:
    """The largest problem that was solved."""

    cells: int = 0
    dofs: int = 0
    degree: int = 0

    def with_model(self, model: OpenModel | None) -> _Size:
        """The larger one of this and a model's."""
        if model is None or model.pencil.size <= self.dofs:
            return self
        liquid = model.pencil.liquid
        return _Size(cells=liquid.tank.cell_count, dofs=model.pencil.size, degree=liquid.degree)


def solve_open(scene: TankScene, comm: MPI.Comm, report: Report) -> OpenSolution:
    """Solve all analyses of a scene with open ends.

    Args:
        scene: the scene.
        comm: MPI communicator.
        report: told what is being done.

    Returns:
        The tables, with `OpenSolution.reasons` where they do not keep the asked tolerance (collective).

    Raises:
        MeshError: if no mesh can be made.
        EigenSolverError: if resonances cannot be found.
    """
    watch = Stopwatch()
    tables: list[_Table] = []
    size = _Size()
    reasons: list[str] = []
    for number, analysis in enumerate(scene.analyses, 1):
        report(f"analysis {number}: {analysis.kind}")
        solution = _solved(comm, scene, analysis, watch)
        # The tables alone: a model holds its mesh and matrices.
        tables.append(solution.table)
        size = size.with_model(solution.model)
        reasons += _reasons(scene, number, analysis, solution)
        del solution
        hand_back_memory()
    return OpenSolution(
        scene=scene,
        radiation=tuple(one for one in tables if isinstance(one, RadiationTable)),
        response=tuple(one for one in tables if isinstance(one, ResponseTable)),
        resonance=tuple(one for one in tables if isinstance(one, ResonanceTable)),
        decay=tuple(one for one in tables if isinstance(one, DecayTable)),
        size={"cells": size.cells, "dofs": size.dofs, "degree": size.degree},
        seconds=dict(watch.seconds),
        reasons=tuple(reasons),
    )


def _solved(comm: MPI.Comm, scene: TankScene, analysis: Analysis, watch: Stopwatch) -> _Solution:
    if isinstance(analysis, Radiation):
        return solve_radiation(comm, scene, analysis, watch)
    if isinstance(analysis, Response):
        return solve_response(comm, scene, analysis, watch)
    if isinstance(analysis, Decay):
        return solve_decay(comm, scene, analysis, watch)
    return solve_resonance(comm, scene, analysis, watch)


def _reasons(scene: TankScene, number: int, analysis: Analysis, solution: _Solution) -> list[str]:
    """Why a solution does not keep what was asked, in words."""
    reasons = []
    tolerance = scene.accuracy.tolerance
    if solution.error > tolerance:
        reasons.append(
            f"analysis {number} ({analysis.kind}) has an estimated relative error of {solution.error:.1e}, above the "
            f"tolerance {tolerance:g}; {kept_tolerance(solution.error)}"
        )
    if isinstance(solution, RadiationSolution | ResponseSolution):
        residual = float(np.nanmax(np.abs(solution.table.energy_residual), initial=0.0))
        if residual > _POWER * tolerance:
            reasons.append(
                f"analysis {number} ({analysis.kind}): the power of the waves that leave is off by {residual:.1e}, "
                f"more than the tolerance {tolerance:g} allows: the estimated errors cannot be trusted"
            )
    if isinstance(solution, RadiationSolution):
        residual = float(np.nanmax(solution.table.haskind_residual, initial=0.0))
        if residual > _POWER * tolerance:
            reasons.append(
                f"analysis {number} ({analysis.kind}): excitation forces and the waves that are radiated disagree by "
                f"{residual:.1e}, more than the tolerance {tolerance:g} allows"
            )
    if isinstance(solution, ResonanceSolution):
        reasons += [f"analysis {number} ({analysis.kind}): {reason}" for reason in solution.reasons]
    return reasons
