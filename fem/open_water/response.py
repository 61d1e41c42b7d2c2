"""Bodies in waves: motions, deflection of beams, reflection and transmission over the frequency, in SI units."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from scipy.interpolate import CubicSpline

from hydroelastic.fem.open_water.attempts import best_over_band
from hydroelastic.fem.open_water.curves import Curves, refined_curves
from hydroelastic.fem.open_water.drift_errors import drift_errors
from hydroelastic.fem.open_water.drift_of_orders import wave_errors
from hydroelastic.fem.open_water.field_model import Band, OpenModel
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.incident_waves import direction_of
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.radiation import between, estimated_places, relative_difference
from hydroelastic.fem.open_water.requests import ResponseRequest
from hydroelastic.fem.open_water.response_errors import load_errors, response_errors
from hydroelastic.fem.open_water.response_table import ResponseErrors, response_table
from hydroelastic.fem.open_water.results import HullPressure, Largest, ResponseTable, UnresolvedPeak
from hydroelastic.fem.open_water.solver import OpenSolver, shared_solver
from hydroelastic.fem.open_water.sweep import FEW, Problem, Swept, sweep
from hydroelastic.fem.open_water.unresolved_peaks import unresolved_peaks
from hydroelastic.fem.tank.attempts import Attempt
from hydroelastic.fem.tank.error_estimates import joined_errors
from hydroelastic.fem.tank.resolution import Resolution

# Largest part of a motion by which its drawn curve may miss it.
_DRAWN = 1e-3


@dataclass(frozen=True, kw_only=True)
class ResponseSolution:
    """Result of a response analysis."""

    table: ResponseTable  # the results in SI units
    model: OpenModel  # the last field model
    error: float  # the largest relative error
    wave_errors: np.ndarray  # about an axis errors of the amplitudes of waves, see `drift_of_orders`, shape (n, 3)
    curves: Curves | None = None  # responses between more than six frequencies, to be drawn


@dataclass(frozen=True, kw_only=True)
class _Sweep:
    solver: OpenSolver
    swept: Swept[OpenResponse]
    table: ResponseTable
    wave_errors: np.ndarray


def solve_response(
    problem: OpenWaterProblem, request: ResponseRequest, like: tuple[HullPressure, ...] = ()
) -> ResponseSolution:
    """Solve for the motion in waves to the tolerance of the problem (collective)."""
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
            estimated = [swept.solutions[place] for place in places]
            causes = [response_errors(solution) for solution in estimated]
            of_loads = {
                index: between(omegas, places, values) for index, values in load_errors(solver.model, estimated).items()
            }
            errors = ResponseErrors(
                total=between(omegas, places, np.array([cause.total.max() for cause in causes])) + swept.errors,
                reduced=swept.errors,
                drift=drift_errors(swept.solutions, omegas, places, swept.errors),
                of_loads=of_loads,
            )
            of_waves = wave_errors(swept.solutions, omegas, places, swept.errors)
        joined = joined_errors(causes, float(swept.errors.max()))
        table = response_table(request, solver.model, omegas, swept.solutions, errors)
        weight = solver.model.basin.units.density * solver.model.basin.units.gravity
        # Of a wave of unit elevation that is reflected in full, the drift force in deep water is ρg/2.
        drift = float(np.nan_to_num(table.drift_error).max(initial=0.0)) / (0.5 * weight)
        largest = max(table.largest_load_error(weight), drift) / joined.largest_total
        return Attempt(
            result=_Sweep(solver=solver, swept=swept, table=table, wave_errors=of_waves),
            causes=replace(joined.scaled(max(1.0, largest)), rounding=joined.rounding),
            resolution=resolution,
        )

    attempt = best_over_band(problem, band, solve)
    found = attempt.result
    model = found.solver.model
    table = found.table
    if request.hull_pressures:
        table = replace(table, **_on_hulls(request, found.swept.solutions, found.swept.errors, like))
    meshed = table.relative_error - found.swept.errors
    curves = None
    if len(omegas) > FEW:
        table = replace(table, missed_peaks=_unresolved(request, found.solver, table))
        incident = incident_places(model, request.waves_from)
        curves = refined_curves(found.solver, incident, omegas, found.swept, drawn_tolerance(problem))
        curves = _with_peaks(request, curves, drawn_tolerance(problem))
        if not problem.tank.geometry.is_revolved:
            table = replace(table, curve=drawn(request, curves))
    table = _with_largest(request, model, table, curves, meshed)
    return ResponseSolution(table=table, model=model, error=attempt.error, wave_errors=found.wave_errors, curves=curves)


def _with_peaks(request: ResponseRequest, curves: Curves, tolerance: float) -> Curves:
    """Add the frequencies at which motions and the reflection are largest (collective)."""
    model = curves.solver.model
    told = [place for place, dof in enumerate(model.scale.dofs) if not dof.is_elastic or dof.is_first_elastic]
    # The first time as the curve is drawn, the second time to the end of the digits.
    for _ in range(2):
        table = _of_basis(request, model, curves.omegas, curves.responses, curves.errors)
        sizes = [np.abs(table.amplitudes[:, :, told]) ** 2]
        if table.reflection is not None:
            sizes.append(np.abs(table.reflection) ** 2)
        columns = np.concatenate(sizes, axis=2).reshape(len(curves.omegas), -1).T
        curves = curves.at(np.array([_peak(curves.omegas, column) for column in columns]), tolerance)
    return curves


def _peak(omegas: np.ndarray, sizes: np.ndarray) -> float:
    """Where a curve through values at ascending frequencies is largest."""
    place = int(sizes.argmax())
    near = slice(max(place - 3, 0), place + 4)
    spline = CubicSpline(omegas[near], sizes[near])
    low, high = omegas[max(place - 1, 0)], omegas[min(place + 1, len(omegas) - 1)]
    # Frequencies that all but coincide would make the next curve through them rough.
    apart = 1e-6 * (high - low)
    roots = [root for root in spline.derivative().roots(extrapolate=False) if low < root < high]
    roots = [root for root in roots if np.abs(omegas - root).min() > apart]
    return float(max([omegas[place], *roots], key=spline))


def _with_largest(
    request: ResponseRequest, model: OpenModel, table: ResponseTable, curves: Curves | None, meshed: np.ndarray
) -> ResponseTable:
    """Add the largest motions and reflection."""
    found, errors = table, table.relative_error
    if curves is not None:
        found = _of_basis(request, model, curves.omegas, curves.responses, curves.reduced)
        order = np.argsort(table.omega)
        places = [int(place) for place in np.searchsorted(found.omega, table.omega[order])]
        errors = curves.reduced + between(found.omega, places, meshed[order])
    # Errors are relative to the elevation, or to the largest motion where this is larger: see `response_errors`.
    units = model.scale.lengths / model.basin.units.length
    sizes = np.maximum(1.0, (np.abs(found.amplitudes) / units).max(axis=2, initial=0.0))
    largest = _largest(found.omega, np.abs(found.amplitudes), errors[:, None, None] * sizes[:, :, None] * units)
    reflected = None
    if found.reflection is not None:
        own = np.abs(np.diagonal(found.reflection, axis1=1, axis2=2))
        reflected = _largest(found.omega, own, np.broadcast_to(errors[:, None], own.shape))
    return replace(table, largest=largest, largest_reflection=reflected)


def _largest(omega: np.ndarray, values: np.ndarray, errors: np.ndarray) -> Largest:
    places = values.argmax(axis=0)
    value, error = (np.take_along_axis(of, places[None], axis=0)[0] for of in (values, errors))
    return Largest(value=value, omega=omega[places], error=error)


def drawn_tolerance(problem: OpenWaterProblem) -> float:
    """Return the largest part of a motion by which its drawn curve may miss it."""
    return max(_DRAWN, problem.tolerance)


def drawn(request: ResponseRequest, curves: Curves) -> ResponseTable:
    """Return motions and waves along curves, with the errors by the reduced basis alone."""
    return _of_basis(request, curves.solver.model, curves.omegas, curves.responses, curves.errors)


def _of_basis(
    request: ResponseRequest, model: OpenModel, omegas: np.ndarray, responses: list[OpenResponse], reduced: np.ndarray
) -> ResponseTable:
    drift = np.full((len(omegas), len(responses[0].incident)), np.nan)
    errors = ResponseErrors(total=reduced, reduced=reduced, drift=drift)
    return response_table(request, model, omegas, responses, errors, with_plates=False)


def _on_hulls(
    request: ResponseRequest, solutions: list[OpenResponse], reduced: np.ndarray, like: tuple[HullPressure, ...]
) -> dict[str, Any]:
    """Pressures along hulls, and of sections in one liquid the drift force by the field beside the bodies,
    with the relative errors by the reduced basis (collective)."""
    from hydroelastic.fem.open_water.hull import hull_pressure

    tank, units = solutions[0].model.basin.tank, solutions[0].model.basin.units
    hulls = [index for index, hull in tank.hulls.items() if not hull.is_thin]
    towards, points = direction_of(request.waves_from), {one.body: one.points for one in like}
    found: dict[str, Any] = {
        "hulls": tuple(hull_pressure(solutions, reduced, index, towards, points.get(index)) for index in hulls)
    }
    if len(tank.layers) == 1 and not tank.geometry.is_revolved:
        forces = [
            np.array([one.near_field_drift(place) for place in range(len(one.incident))])
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
        return _of_basis(request, solver.model, omegas, solutions, np.full(len(omegas), np.nan))

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
