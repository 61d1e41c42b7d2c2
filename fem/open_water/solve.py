"""Solve open water: one analysis after the other, each to the tolerance of the problem."""

from __future__ import annotations

import gc
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from math import inf
from typing import Literal, TypeAlias

import numpy as np

from hydroelastic.fem.kept_tolerance import excess, kept_tolerance
from hydroelastic.fem.open_water.decay import DecaySolution, solve_decay
from hydroelastic.fem.open_water.irregular_results import SpectrumTable
from hydroelastic.fem.open_water.motion import MotionSolution, solve_motion
from hydroelastic.fem.open_water.orders import solve_by_order
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.radiation import RadiationSolution, solve_radiation
from hydroelastic.fem.open_water.radiation_memory import (
    ImpulseResponseSolution,
    Memory,
    WaterMemory,
    solve_impulse_response,
    solve_memory,
)
from hydroelastic.fem.open_water.requests import (
    OVER_TIME,
    DecayRequest,
    ImpulseResponseRequest,
    MotionRequest,
    RadiationRequest,
    Request,
    ResponseRequest,
    SpectrumRequest,
)
from hydroelastic.fem.open_water.resonance import ResonanceSolution, solve_resonance
from hydroelastic.fem.open_water.response import ResponseSolution, solve_response
from hydroelastic.fem.open_water.results import (
    DecayTable,
    RadiationTable,
    ResonanceTable,
    ResponseTable,
)
from hydroelastic.fem.open_water.spectrum import SpectrumSolution, solve_spectrum
from hydroelastic.fem.progress import Report
from hydroelastic.fem.time_domain.results import ImpulseResponseTable, MotionTable

# Factor of the tolerance for energy and Haskind residuals, which are of first order in the error of the field.
_POWER = 10.0
# A motion whose error is above the tolerance is solved again, with forces and memory for a smaller one. Not for less
# than a hundredth of it, which takes several times as long.
_MARGIN, _LEAST = 0.5, 0.01

_Solution: TypeAlias = (
    RadiationSolution
    | ResponseSolution
    | ResonanceSolution
    | DecaySolution
    | SpectrumSolution
    | ImpulseResponseSolution
    | MotionSolution
)
_Table: TypeAlias = (
    RadiationTable | ResponseTable | ResonanceTable | DecayTable | SpectrumTable | ImpulseResponseTable | MotionTable
)


@dataclass(frozen=True, kw_only=True)
class OpenWaterSolution:
    """The tables of all analyses, in the order in which they were requested."""

    radiation: tuple[RadiationTable, ...] = ()  # one for each radiation analysis
    response: tuple[ResponseTable, ...] = ()  # one for each response analysis
    resonance: tuple[ResonanceTable, ...] = ()  # one for each resonance analysis
    decay: tuple[DecayTable, ...] = ()  # one for each decay analysis
    spectrum: tuple[SpectrumTable, ...] = ()  # one for each spectrum analysis
    impulse_response: tuple[ImpulseResponseTable, ...] = ()  # one for each impulse response analysis
    motion: tuple[MotionTable, ...] = ()  # one for each motion analysis
    size: dict[str, int]  # "cells", "dofs" (unknowns of ψ) and "degree" of the largest problem that was solved
    reasons: tuple[str, ...] = ()  # why the solution does not keep the tolerance or is incomplete; empty if it does

    @property
    def status(self) -> Literal["ok", "unconverged"]:
        """ "ok" if all results keep the tolerance, else "unconverged"."""
        return "unconverged" if self.reasons else "ok"


def solve_open_water(
    problem: OpenWaterProblem, requests: Sequence[Request], report: Report = lambda _message: None
) -> OpenWaterSolution:
    """Solve all analyses of open water (collective)."""
    tables: list[_Table] = []
    size = {"cells": 0, "dofs": 0, "degree": 0}
    reasons: list[str] = []
    found = [one.band for one in requests if isinstance(one, RadiationRequest | ResponseRequest | SpectrumRequest)]
    problem = replace(problem, bands=tuple(band for band in found if band is not None))
    latest = max((max(one.times) for one in requests if isinstance(one, OVER_TIME)), default=0.0)
    earliest = min((min(one.times) for one in requests if isinstance(one, ImpulseResponseRequest)), default=inf)
    moving, memory = problem, _memory(problem, latest, earliest)
    for number, request in enumerate(requests, 1):
        report(f"analysis {number}: {request.kind}")
        solution = _solved(moving if isinstance(request, MotionRequest) else problem, request, memory)
        if isinstance(request, MotionRequest) and solution.error > problem.tolerance:
            # Near a resonance errors of forces and of the memory are magnified in the motion.
            factor = max(_MARGIN * problem.tolerance / solution.error, _LEAST)
            moving = replace(problem, tolerance=factor * problem.tolerance, solvers={})
            solution = min(solution, _solved(moving, request, _memory(moving, latest, inf)), key=lambda one: one.error)
        # The tables alone: a model holds its mesh and matrices.
        tables.append(solution.table)
        if solution.model is not None and solution.model.pencil.size > size["dofs"]:
            liquid = solution.model.pencil.liquid
            size = {"cells": liquid.tank.cell_count, "dofs": solution.model.pencil.size, "degree": liquid.degree}
        reasons += _reasons(problem.tolerance, number, request.kind, solution)
        del solution
        gc.collect()
    # All processes free the last solver together.
    problem.solvers.clear()
    moving.solvers.clear()
    gc.collect()
    return OpenWaterSolution(
        radiation=tuple(one for one in tables if isinstance(one, RadiationTable)),
        response=tuple(one for one in tables if isinstance(one, ResponseTable)),
        resonance=tuple(one for one in tables if isinstance(one, ResonanceTable)),
        decay=tuple(one for one in tables if isinstance(one, DecayTable)),
        spectrum=tuple(one for one in tables if isinstance(one, SpectrumTable)),
        impulse_response=tuple(one for one in tables if isinstance(one, ImpulseResponseTable)),
        motion=tuple(one for one in tables if isinstance(one, MotionTable)),
        size=size,
        reasons=tuple(reasons),
    )


def _memory(problem: OpenWaterProblem, latest: float, earliest: float) -> Memory:
    """Return the memory of the water of each order, found when it is first asked for; see `solve_memory`."""

    @cache
    def memory(order: int, elastic_modes: int) -> WaterMemory:
        return solve_memory(problem.of_order(order), latest, elastic_modes, earliest)

    return memory


def _solved(problem: OpenWaterProblem, request: Request, memory: Memory) -> _Solution:
    """Solve one analysis; the memory of the water serves several."""
    if isinstance(request, SpectrumRequest):
        return solve_spectrum(problem, request)
    if problem.tank.geometry.is_revolved:
        return solve_by_order(problem, request, memory)
    match request:
        case RadiationRequest():
            return solve_radiation(problem, request)
        case ResponseRequest():
            return solve_response(problem, request)
        case DecayRequest():
            return solve_decay(problem, request)
        case ImpulseResponseRequest():
            return solve_impulse_response(request, memory(0, request.elastic_modes))
        case MotionRequest():
            return solve_motion(problem, request, memory(0, request.elastic_modes))
        case _:
            return solve_resonance(problem, request)


def _reasons(tolerance: float, number: int, kind: str, solution: _Solution) -> list[str]:
    """Return messages on why a solution does not keep the tolerance or is incomplete."""
    reasons = [*excess(f"analysis {number} ({kind}) has an estimated relative error", solution.error, tolerance)]
    if isinstance(solution, RadiationSolution | ResponseSolution):
        residual = float(np.nanmax(np.abs(solution.table.energy_residual), initial=0.0))
        if residual > _POWER * tolerance:
            reasons.append(
                f"analysis {number} ({kind}): the power of outgoing waves is off by {residual:.1e}, "
                f"more than the tolerance {tolerance:g} allows: the estimated errors cannot be trusted"
            )
    if isinstance(solution, RadiationSolution):
        residual = float(np.nanmax(solution.table.haskind_residual, initial=0.0))
        if residual > _POWER * tolerance:
            reasons.append(
                f"analysis {number} ({kind}): excitation forces and radiated waves disagree by "
                f"{residual:.1e}, more than the tolerance {tolerance:g} allows"
            )
    if isinstance(solution, ImpulseResponseSolution):
        reasons += _impulse_response_reasons(tolerance, f"analysis {number} ({kind})", solution)
    if isinstance(solution, SpectrumSolution):
        reasons += _spectrum_reasons(tolerance, f"analysis {number} ({kind})", solution.table)
    if isinstance(solution, ResonanceSolution):
        reasons += [f"analysis {number} ({kind}): {reason}" for reason in resonance_reasons(solution)]
    return reasons


def _impulse_response_reasons(tolerance: float, analysis: str, solution: ImpulseResponseSolution) -> Iterator[str]:
    """Yield a message on the times at which K does not keep the tolerance."""
    table = solution.table
    poor = table.impulse_response_error > tolerance
    if poor.any():
        largest, times = table.impulse_response_error.max(), table.times[poor]
        yield (
            f"{analysis}: K from t = {times.min():.4g} to {times.max():.4g} s has an estimated error of {largest:.1e} "
            f"of K(0) = (2/π) ∫ B dω, above the tolerance {tolerance:g}: the damping B above "
            f"{solution.highest:.4g} rad/s is not known well enough; {kept_tolerance(float(largest))}"
        )


def _spectrum_reasons(tolerance: float, analysis: str, table: SpectrumTable) -> Iterator[str]:
    """Yield messages on what the frequencies of a spectrum analysis leave out."""
    for cause, what in (
        ("truncation_error", f"the waves above {table.omega[-1]:.4g} rad/s are left out: raise highest_omega"),
        ("sampling_error", f"{len(table.omega)} frequencies do not resolve the transfer functions"),
    ):
        error = table.largest_error(cause)
        if error > tolerance:
            yield f"{analysis}: {what}; significant amplitudes lack up to {error:.1e} of the largest"


def resonance_reasons(solution: ResonanceSolution) -> Iterator[str]:
    """Yield messages on why resonances of a region may be missing."""
    counted = solution.table.counted
    if counted is None:
        yield (
            "the independent count of the resonances is not certain, as one may lie on the boundary of its region: "
            "change count, below or largest_damping a little"
        )
    elif counted != solution.known:
        yield (
            f"an independent count finds {counted} resonances in the region, and {solution.known} are known, so that "
            "the list may miss some: ask for a smaller tolerance, a smaller largest_damping, or those below a frequency"
        )
    if solution.unstable:
        yield "a float is unstable: its motion grows, and is none of the resonances"
