"""Bodies in waves: motions, deflection of beams, reflection and transmission over the frequency, in SI units."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import nan
from typing import Any, Literal

import numpy as np

from hydroelastic.fem.open_water.attempts import best_over_band
from hydroelastic.fem.open_water.curves import refined_curves
from hydroelastic.fem.open_water.field_model import Band, OpenModel
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.incident_waves import direction_of
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.radiation import between, estimated_places, relative_difference
from hydroelastic.fem.open_water.requests import ResponseRequest
from hydroelastic.fem.open_water.results import HullPressure, PlateDeflection, ResponseTable, UnresolvedPeak
from hydroelastic.fem.open_water.solver import OpenSolver, shared_solver
from hydroelastic.fem.open_water.sweep import FEW, Problem, Swept, sweep
from hydroelastic.fem.open_water.unresolved_peaks import unresolved_peaks
from hydroelastic.fem.tank.attempts import Attempt
from hydroelastic.fem.tank.error_estimates import FrequencyErrors, boundary_error, joined_errors
from hydroelastic.fem.tank.resolution import Resolution, rounding_error
from hydroelastic.modal.beam.beam_shapes import beam_shapes

# Largest part of a motion by which its drawn curve may miss it.
_DRAWN = 1e-3
# Deflection of all omitted dry modes, per mode in use, over the last two amplitudes: at the tips they add like Σ n⁻⁵.
_TAIL = 0.25


@dataclass(frozen=True, kw_only=True)
class ResponseSolution:
    """Result of a response analysis.

    Attributes:
        table: the results in SI units.
        model: the last field model.
        error: the largest relative error.
    """

    table: ResponseTable
    model: OpenModel
    error: float


@dataclass(frozen=True, kw_only=True)
class _Sweep:
    """The responses at all frequencies at one resolution."""

    solver: OpenSolver
    swept: Swept[OpenResponse]
    errors: np.ndarray


def solve_response(problem: OpenWaterProblem, request: ResponseRequest) -> ResponseSolution:
    """Solve for the motion in waves to the tolerance of the problem (collective).

    Args:
        problem: the open water.
        request: frequencies and direction of the incident waves.
    """
    omegas = np.array(request.omega)
    low, high = problem.shared_band(float(omegas.min()), float(omegas.max()))
    band = Band(lowest=low, highest=high)

    def solve(resolution: Resolution) -> Attempt[_Sweep]:
        solver = shared_solver(problem, band, resolution)
        solver.elevation, solver.damping = request.elevation, np.zeros_like(solver.model.mass)
        incident = incident_places(solver.model, request.waves_from)
        frequencies = Problem(
            full=lambda omega: solver.response(omega.real, incident),
            reduced=lambda omega: solver.response_between(omega.real, incident),
            difference=lambda one, other: relative_difference(outcome(one), outcome(other)),
        )
        swept = sweep(frequencies, omegas, problem.tolerance)
        with problem.watch.stage("errors"):
            places = estimated_places(omegas)
            causes = [response_errors(swept.solutions[place]) for place in places]
        errors = between(omegas, places, np.array([cause.total.max() for cause in causes])) + swept.errors
        return Attempt(
            result=_Sweep(solver=solver, swept=swept, errors=errors),
            causes=joined_errors(causes, float(swept.errors.max())),
            resolution=resolution,
        )

    attempt = best_over_band(problem, band, solve)
    found = attempt.result
    model = found.solver.model
    table = _table(request, model, omegas, found.swept.solutions, found.errors)
    if request.hull_pressures:
        table = replace(table, **_on_hulls(found.swept.solutions))
    if len(omegas) > FEW:
        incident = incident_places(model, request.waves_from)
        curves = refined_curves(found.solver, incident, omegas, found.swept, max(_DRAWN, problem.tolerance))
        table = replace(
            table,
            missed_peaks=_unresolved(request, found.solver, table),
            curve=_table(request, model, curves.omegas, curves.responses, curves.errors),
        )
    return ResponseSolution(table=table, model=model, error=attempt.error)


def _on_hulls(solutions: list[OpenResponse]) -> dict[str, Any]:
    """Pressures along hulls, and the drift force by them (collective)."""
    from hydroelastic.fem.open_water.hull import hull_pressures, near_field_drift

    tank = solutions[0].model.basin.tank
    hulls = [(index, *hull_pressures(solutions, index)) for index, hull in tank.hulls.items() if not hull.is_thin]
    found: dict[str, Any] = {
        "hulls": tuple(HullPressure(body=index, points=points, pressure=values) for index, points, values in hulls)
    }
    if len(hulls) == len(tank.bodies) == len(tank.layers) == 1:
        units = solutions[0].model.basin.units
        forces = [
            [near_field_drift(one, 0, place) for place in range(len(one.incident))]
            / one.incidence.elevations[one.incident] ** 2
            for one in solutions
        ]
        found["near_field_drift"] = units.density * units.gravity * np.array(forces)
    return found


def _unresolved(request: ResponseRequest, solver: OpenSolver, table: ResponseTable) -> tuple[UnresolvedPeak, ...]:
    """Peaks between the frequencies, by the reduced basis of the sweep (collective)."""
    incident = incident_places(solver.model, request.waves_from)

    def between(omegas: np.ndarray) -> ResponseTable:
        solutions = [solver.response_between(float(omega), incident)[0] for omega in omegas]
        return _table(request, solver.model, omegas, solutions, np.full(len(omegas), nan))

    return unresolved_peaks(table, solver.resonances_between(), between)


def incident_places(model: OpenModel, waves_from: Literal["left", "right"]) -> list[int]:
    """Return the indices of the incident waves from a side: those to the right are first."""
    count = len(model.basin.scaled_layers.branches)
    if waves_from == "left" or model.basin.tank.geometry.is_revolved:
        return list(range(count))
    return list(range(count, 2 * count))


def outcome(solution: OpenResponse) -> np.ndarray:
    """Return the quantities whose error is kept below the tolerance: elevations of the outgoing waves, and motions, per
    incident elevation."""
    elevations = solution.incidence.elevations
    incident = elevations[solution.incident]
    waves = solution.outgoing() * elevations[:, None] / incident
    return np.vstack([waves, (solution.motions / incident[:, None]).T])


def response_errors(solution: OpenResponse) -> FrequencyErrors:
    """Return errors relative to the incident wave: the energy error of the scattered field over the power of that wave,
    and omitted dry modes over the largest deflection (collective)."""
    model, powers = solution.model, solution.incidence.powers[solution.incident]
    away, tips = model.energies_missed(solution.scattered)
    count = len(solution.incident)
    return FrequencyErrors(
        liquid=0.5 * away / powers + boundary_error(model.pencil.liquid.tank, model.basin.tank) + model.cut,
        tips=0.5 * tips / powers,
        truncation=np.full(count, max((_truncation(motions, model) for motions in solution.motions), default=0.0)),
        rounding=np.full(count, 2.0 * rounding_error(model.resolution.degree, min(model.basin.tank.depth, 1.0))),
    )


def _truncation(motions: np.ndarray, model: OpenModel) -> float:
    """Deflection in the omitted dry modes, relative to the largest motion."""
    largest = np.abs(motions).max(initial=0.0)
    if not largest:
        return 0.0
    worst, first = 0.0, 0
    for index, body in enumerate(model.pencil.bodies):
        own = np.abs(motions[first : first + body.size])
        first += body.size
        if model.basin.tank.bodies[index].is_elastic:
            worst = max(worst, _TAIL * body.size * float(own[-2:].max()))
    return worst / float(largest)


def _table(
    request: ResponseRequest, model: OpenModel, omegas: np.ndarray, solutions: list[OpenResponse], errors: np.ndarray
) -> ResponseTable:
    first = solutions[0]
    count = len(first.incident)
    waves = np.array([solution.ratios() for solution in solutions])
    forward = first.incident
    back = [int(first.incidence.reversed[place]) for place in forward]
    towards = direction_of(request.waves_from)
    motions = np.array([one.motions * one.per_elevation(towards)[:, None] for one in solutions])
    is_round = model.basin.tank.geometry.is_revolved
    return ResponseTable(
        omega=omegas,
        waves=tuple(plane.wave.branch for plane in first.incidence.planes[:count]),
        wavenumbers=np.array([[plane.wave.wavenumber for plane in one.incidence.planes[:count]] for one in solutions])
        / model.basin.units.length,
        dofs=model.scale.dofs,
        waves_from=request.waves_from,
        amplitudes=model.scale.amplitudes(motions),
        reflection=None if is_round else waves[:, :, back],
        transmission=None if is_round else waves[:, :, forward],
        partial_waves=np.array([one.partial_waves() for one in solutions])[..., None] if is_round else None,
        absorption=np.array([solution.absorption for solution in solutions]),
        drift_force=drift_forces(solutions),
        energy_residual=np.array([solution.energy_residual() for solution in solutions]),
        relative_error=errors,
        plates=tuple(_plates(request, model, motions)),
        fields_at=request.fields_at,
    )


def drift_forces(solutions: list[OpenResponse]) -> np.ndarray:
    """Return the mean force along x per square of the elevation of each incident wave, N/m³, shape (n, incident)."""
    units = solutions[0].model.basin.units
    forces = [one.drift_force() / one.incidence.elevations[one.incident] ** 2 for one in solutions]
    return units.density * units.gravity * np.array(forces)


def _plates(request: ResponseRequest, model: OpenModel, motions: np.ndarray) -> list[PlateDeflection]:
    plates, first = [], 0
    for index, body in enumerate(model.pencil.bodies):
        own = motions[..., first : first + body.size]
        first += body.size
        if model.basin.tank.bodies[index].is_elastic:
            piece, length = model.basin.tank.piece_of(index), model.basin.units.length
            x: np.ndarray = np.linspace(0.0, piece.length, request.positions)
            deflections, moments, shears = along_beam(model, index, body.size, x)
            plates.append(
                PlateDeflection(
                    body=index,
                    positions=model.basin.origin + length * (piece.start + x),
                    deflection=own @ deflections,
                    bending_moment=own @ moments,
                    shear_force=own @ shears,
                )
            )
    return plates


def along_beam(model: OpenModel, index: int, count: int, x: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return deflection, bending moment and shear force of a beam by a unit of each of its unknowns per dimensionless
    elevation: per metre of elevation in m, N and N/m, each of shape (unknowns, points).

    Args:
        model: the problem.
        index: of the beam among the bodies.
        count: number of its unknowns.
        x: distances from its left end, dimensionless, shape (points,).
    """
    units, shapes = model.basin.units, beam_shapes(model.basin.tank.beams[index], count)
    weight = units.density * units.gravity * units.length
    return (
        shapes.tabulated(x, 0),
        np.multiply(weight * units.length, shapes.moments(x)),
        np.multiply(weight, shapes.shears(x)),
    )
