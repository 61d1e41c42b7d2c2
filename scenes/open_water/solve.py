"""Solve a scene with open ends: one analysis after the other, each to the tolerance that the scene asks for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.kept_tolerance import kept_tolerance
from hydroelastic.fem.memory import release_memory
from hydroelastic.fem.open_water.decay import DecaySolution, DriftingFloatError, UnstableFloatError, solve_decay
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.radiation import RadiationSolution, solve_radiation
from hydroelastic.fem.open_water.resonance import ResonanceSolution, solve_resonance
from hydroelastic.fem.open_water.response import ResponseSolution, solve_response
from hydroelastic.fem.open_water.results import DecayTable, RadiationTable, ResonanceTable, ResponseTable
from hydroelastic.fem.stopwatch import Report, Stopwatch
from hydroelastic.scenes.errors import Problem, SceneError
from hydroelastic.scenes.models.open_analyses import Analysis, Decay, Radiation, Response
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.open_water.physics import (
    decay_request,
    open_water_problem,
    radiation_request,
    resonance_request,
    response_request,
)
from hydroelastic.scenes.open_water.results import OpenSolution

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
        report: called with a word on what is being done.

    Returns:
        The tables, with `OpenSolution.reasons` where they do not keep the asked tolerance (collective).

    Raises:
        MeshError: if no mesh can be made.
        EigenSolverError: if resonances cannot be found.
        SceneError: if a float that is released would capsize or drift away.
    """
    watch = Stopwatch()
    problem = open_water_problem(scene, comm, watch)
    tables: list[_Table] = []
    size = _Size()
    reasons: list[str] = []
    for number, analysis in enumerate(scene.analyses, 1):
        report(f"analysis {number}: {analysis.kind}")
        solution = _solved(problem, analysis)
        # The tables alone: a model holds its mesh and matrices.
        tables.append(solution.table)
        size = size.with_model(solution.model)
        reasons += _reasons(problem.tolerance, number, analysis, solution)
        del solution
        release_memory()
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


def _solved(problem: OpenWaterProblem, analysis: Analysis) -> _Solution:
    if isinstance(analysis, Radiation):
        return solve_radiation(problem, radiation_request(analysis))
    if isinstance(analysis, Response):
        return solve_response(problem, response_request(analysis))
    if isinstance(analysis, Decay):
        return _decay(problem, analysis)
    return solve_resonance(problem, resonance_request(analysis))


def _decay(problem: OpenWaterProblem, analysis: Decay) -> DecaySolution:
    try:
        return solve_decay(problem, decay_request(analysis))
    except UnstableFloatError:
        wrong, remedy = "a float is unstable and would capsize", "Lower its centre of mass"
    except DriftingFloatError as error:
        motions = " and ".join(error.motions)
        wrong = f"the float would drift away: nothing restores {motions}, which it sets going"
        remedy = f"Leave {motions} out of motions, or let go of another motion"
    raise SceneError(Problem(key='[[analysis]] key "displacement"', wrong=wrong, remedy=remedy))


def _reasons(tolerance: float, number: int, analysis: Analysis, solution: _Solution) -> list[str]:
    """Why a solution does not keep what was asked, in words."""
    reasons = []
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
        reasons += [f"analysis {number} ({analysis.kind}): {reason}" for reason in resonance_reasons(solution)]
    return reasons


def resonance_reasons(solution: ResonanceSolution) -> Iterator[str]:
    """Yield why the resonances of a region are not known to be all, in words."""
    counted = solution.table.counted
    if counted is None:
        yield "the independent count of the resonances is not certain: one may lie on the rim of its region"
    elif counted != solution.known:
        yield f"an independent count finds {counted} resonances in the region, and {solution.known} are known"
    if solution.unstable:
        yield "a float is unstable: its motion grows, and is none of the resonances"
