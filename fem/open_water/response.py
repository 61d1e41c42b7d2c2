"""Bodies in waves: motions, deflection of beams, reflection and transmission over the frequency, in SI units."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import nan
from typing import Any, Literal

import numpy as np
from scipy.linalg import block_diag

from hydroelastic.fem.bodies.round_plate import plate_of
from hydroelastic.fem.open_water.attempts import best_over_band
from hydroelastic.fem.open_water.beam_loads import AlongBeam, BeamLoads
from hydroelastic.fem.open_water.bent_plates import omitted_deflections
from hydroelastic.fem.open_water.curves import refined_curves
from hydroelastic.fem.open_water.field_model import Band, OpenModel
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.functional_errors import dual_motions, functional_errors
from hydroelastic.fem.open_water.incident_waves import RIGHTWARD, direction_of
from hydroelastic.fem.open_water.omitted_modes import omitted_deflection, truncation
from hydroelastic.fem.open_water.plate_load_errors import plate_load_errors
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.radiation import between, estimated_places, relative_difference
from hydroelastic.fem.open_water.requests import ResponseRequest
from hydroelastic.fem.open_water.results import HullPressure, PlateDeflection, ResponseTable, UnresolvedPeak
from hydroelastic.fem.open_water.round_plates import deflections_of_order, radii_along
from hydroelastic.fem.open_water.solver import OpenSolver, shared_solver
from hydroelastic.fem.open_water.sweep import FEW, Problem, Swept, sweep
from hydroelastic.fem.open_water.unresolved_peaks import unresolved_peaks
from hydroelastic.fem.tank.attempts import Attempt
from hydroelastic.fem.tank.error_estimates import FrequencyErrors, boundary_error, joined_errors
from hydroelastic.fem.tank.resolution import Resolution, rounding_error
from hydroelastic.modal.beam.beam_shapes import beam_shapes
from hydroelastic.physics.attachments import REGULAR

# Largest part of a motion by which its drawn curve may miss it.
_DRAWN = 1e-3
# Points along a beam at which errors of loads are estimated, the ends included.
_SECTIONS = 7


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
    table: ResponseTable


def solve_response(
    problem: OpenWaterProblem, request: ResponseRequest, like: tuple[HullPressure, ...] = ()
) -> ResponseSolution:
    """Solve for the motion in waves to the tolerance of the problem (collective).

    Args:
        problem: the open water.
        request: frequencies and direction of the incident waves.
        like: pressures along all hulls at whose points those of this azimuthal order are wanted.
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
            estimated = [swept.solutions[place] for place in places]
            causes = [response_errors(solution) for solution in estimated]
            of_loads = {
                index: between(omegas, places, values) for index, values in load_errors(solver.model, estimated).items()
            }
        errors = between(omegas, places, np.array([cause.total.max() for cause in causes])) + swept.errors
        joined = joined_errors(causes, float(swept.errors.max()))
        table = _table(request, solver.model, omegas, swept.solutions, errors, swept.errors, of_loads)
        weight = solver.model.basin.units.density * solver.model.basin.units.gravity
        # Of a wave of unit elevation that is reflected in full, the drift force in deep water is ρg/2.
        drift = float(np.nan_to_num(table.drift_error).max(initial=0.0)) / (0.5 * weight)
        largest = max(table.largest_load_error(weight), drift) / joined.largest_total
        return Attempt(
            result=_Sweep(solver=solver, swept=swept, table=table),
            causes=replace(joined.scaled(max(1.0, largest)), rounding=joined.rounding),
            resolution=resolution,
        )

    attempt = best_over_band(problem, band, solve)
    found = attempt.result
    model = found.solver.model
    table = found.table
    if request.hull_pressures:
        table = replace(table, **_on_hulls(request, found.swept.solutions, found.swept.errors, like))
    if len(omegas) > FEW:
        table = replace(table, missed_peaks=_unresolved(request, found.solver, table))
    if len(omegas) > FEW and not problem.tank.geometry.is_revolved:
        # Of several azimuthal orders each would have frequencies of its own.
        incident = incident_places(model, request.waves_from)
        curves = refined_curves(found.solver, incident, omegas, found.swept, max(_DRAWN, problem.tolerance))
        table = replace(
            table, curve=_table(request, model, curves.omegas, curves.responses, curves.errors, curves.errors, {})
        )
    return ResponseSolution(table=table, model=model, error=attempt.error)


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
        unknown = np.full(len(omegas), nan)
        return _table(request, solver.model, omegas, solutions, unknown, unknown, {})

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
    """Return errors relative to the incident wave (collective).

    Those of the waves that leave are the energy error of the scattered field over the power of the incident wave, and
    the part of the scattered power that the ends of the absorbing layer reflect; those of motions, and of
    deflections of a beam at both ends and in the middle, are `functional_errors`, relative to the largest motion if
    that is larger than the elevation. The larger ones count. Beside them are omitted dry modes over the largest
    deflection. About an axis motions have the errors of waves.
    """
    model, incidence = solution.model, solution.incidence
    powers, count = incidence.powers[solution.incident], len(solution.incident)
    away, tips = (0.5 * energy / powers for energy in model.summed_over_cells(solution.missed))
    away += solution.reflected * solution.scattered_powers / powers
    moved = _reported_motions(model)
    sizes = np.maximum(
        np.abs(moved @ solution.motions.T).max(axis=0, initial=0.0), 1.0 / np.abs(solution.per_elevation(RIGHTWARD))
    )
    dual = dual_motions(solution, moved)
    own = functional_errors(solution, dual)
    omitted = np.full(count, truncation(solution))
    for modes in model.plate_modes.values():
        omitted = np.maximum(omitted, (omitted_deflections(modes, solution, dual) / sizes).max(axis=0))
    away, tips = (
        np.maximum(waves, (motions / sizes).max(axis=0, initial=0.0))
        for waves, motions in zip((away, tips), own, strict=True)
    )
    return FrequencyErrors(
        liquid=away + boundary_error(model.pencil.liquid.tank, model.basin.tank),
        tips=tips,
        truncation=omitted,
        rounding=np.full(count, 2.0 * rounding_error(model.resolution.degree, min(model.basin.tank.depth, 1.0))),
    )


def _reported_motions(model: OpenModel) -> np.ndarray:
    """The motions of floats, and deflections of beams and round plates at both ends, or at the axis, and in the middle,
    by a unit of each body unknown, shape (motions, unknowns)."""
    tank, found = model.basin.tank, []
    for index, body in enumerate(model.pencil.bodies):
        if index in tank.beams:
            beam = tank.beams[index]
            found.append(beam_shapes(beam, body.size).tabulated(beam.length * np.array([0.0, 0.5, 1.0]), 0).T)
        elif index in model.plate_modes:
            plate = plate_of(tank.bodies[index])
            radii = np.linspace(plate.inner_radius, plate.radius, 3, dtype=np.float64)
            found.append(model.plate_modes[index].shapes.values(radii)[: body.size].T)
        else:
            found.append(np.eye(body.size))
    return np.asarray(block_diag(*found))


def load_errors(model: OpenModel, solutions: list[OpenResponse]) -> dict[int, np.ndarray]:
    """Return errors of deflection, shear force and bending moment anywhere along each beam, per c of each incident wave
    and in units of the basin, shape (n, 3, incident), and `plate_load_errors`, by the number of the body
    (collective)."""
    found = {index: plate_load_errors(model, index, solutions) for index in model.plate_modes}
    for index, beam in model.basin.tank.beams.items():
        along = BeamLoads(model, index, np.linspace(0.0, beam.length, _SECTIONS))
        found[index] = np.array([along.errors(one, omitted_deflection(one, index)) for one in solutions])
    return found


def _table(
    request: ResponseRequest,
    model: OpenModel,
    omegas: np.ndarray,
    solutions: list[OpenResponse],
    errors: np.ndarray,
    reduced: np.ndarray,
    of_loads: dict[int, np.ndarray],
) -> ResponseTable:
    """Return the table, with all errors of motions, those by the reduced basis alone, and `load_errors` of the mesh."""
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
        drift_error=drift_errors(solutions, errors),
        energy_residual=np.array([solution.energy_residual() for solution in solutions]),
        relative_error=errors,
        plates=tuple(_plates(request, model, solutions, reduced, of_loads)),
        round_plates=tuple(
            deflections_of_order(
                model,
                solutions,
                _moved(request, model, solutions),
                towards,
                reduced,
                of_loads,
                lambda index: model.basin.units.length * radii_along(model.basin.tank, index, request.positions),
            )
        ),
        fields_at=request.fields_at,
    )


def drift_forces(solutions: list[OpenResponse]) -> np.ndarray:
    """Return the mean force along x per square of the elevation of each incident wave, N/m³, shape (n, incident)."""
    units = solutions[0].model.basin.units
    forces = [one.drift_force() / one.incidence.elevations[one.incident] ** 2 for one in solutions]
    return units.density * units.gravity * np.array(forces)


def drift_errors(solutions: list[OpenResponse], errors: np.ndarray) -> np.ndarray:
    """Return estimated errors of `drift_forces`, N/m³, shape (n, incident).

    Args:
        solutions: the responses.
        errors: their errors relative to the incident wave, shape (n,).
    """
    units = solutions[0].model.basin.units
    found = [
        one.drift_error(float(error)) / one.incidence.elevations[one.incident] ** 2
        for one, error in zip(solutions, errors, strict=True)
    ]
    return units.density * units.gravity * np.array(found)


def _moved(
    request: ResponseRequest, model: OpenModel, solutions: list[OpenResponse]
) -> list[tuple[np.ndarray, np.ndarray]]:
    """Motions, and linear damping in place of each drag, of each response."""
    outside, found = model.outside, []
    for solution in solutions:
        heights = request.elevation / model.basin.units.length / solution.incidence.elevations[solution.incident]
        speeds = np.sqrt(solution.squared.real) * np.abs(solution.motions @ outside.paths.T) * heights[:, None]
        found.append((solution.motions, REGULAR * outside.drag * speeds))
    return found


def _plates(
    request: ResponseRequest,
    model: OpenModel,
    solutions: list[OpenResponse],
    reduced: np.ndarray,
    of_loads: dict[int, np.ndarray],
) -> Iterator[PlateDeflection]:
    for index, beam in model.basin.tank.beams.items():
        x: np.ndarray = np.linspace(0.0, beam.length, request.positions)
        along = BeamLoads(model, index, x)
        moved = zip(solutions, _moved(request, model, solutions), strict=True)
        found = [along.of(one, *own) for one, own in moved]
        meshed = of_loads.get(index, np.zeros((len(solutions), 3, len(solutions[0].incident))))
        yield plate_deflection(model, index, x, solutions, found, reduced, meshed)


def plate_deflection(
    model: OpenModel,
    index: int,
    x: np.ndarray,
    solutions: list[OpenResponse],
    found: list[AlongBeam],
    reduced: np.ndarray,
    of_loads: np.ndarray,
) -> PlateDeflection:
    """Return what acts along a beam in SI units, with its errors.

    Args:
        model: the problem.
        index: of the beam among the bodies.
        x: distances from its left end, in units of the basin, shape (p,).
        solutions: the responses.
        found: what acts along it in these.
        reduced: their relative errors by the reduced basis, shape (n,).
        of_loads: see `load_errors`.
    """
    units, start = model.basin.units, model.basin.tank.piece_of(index).start
    factors = np.array([one.per_elevation(RIGHTWARD) for one in solutions])
    weight = units.density * units.gravity * units.length
    values, errors = {}, {}
    scales = {"deflection": 1.0, "shear_force": weight, "bending_moment": weight * units.length}
    for place, (name, unit) in enumerate(scales.items()):
        values[name] = unit * np.array([getattr(one, name) for one in found]) * factors[..., None]
        errors[f"{name}_error"] = unit * of_loads[:, place] * np.abs(factors) + reduced[:, None] * np.abs(
            values[name]
        ).max(axis=2)
    return PlateDeflection(
        body=index,
        positions=model.basin.origin + units.length * (start + x),
        **values,
        **errors,
    )
