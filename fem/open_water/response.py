"""Bodies in waves: motions, deflection of beams, reflection and transmission over the frequency, in SI units.

Peaks of a response between the frequencies at which it was computed, which its curve does not resolve.

Bodies and liquid on the reduced basis of a sweep are a small linear pencil in ω²; its eigenvalues near the real axis
are the frequencies at which the response may change faster than the curve shows. The response there, on the same basis,
is compared with the straight line between the two neighbours on the curve.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, Literal, TypeAlias

import numpy as np
from mpi4py import MPI
from numpy.polynomial.legendre import leggauss, legvander
from scipy.interpolate import CubicSpline
from scipy.spatial import cKDTree

from hydroelastic.fem.cells import nearest_in_cells
from hydroelastic.fem.closed.outline import arcs_beside
from hydroelastic.fem.facets import FacetGroup, facet_groups
from hydroelastic.fem.liquid import as_functions
from hydroelastic.fem.open_water.attempts import best_over_band
from hydroelastic.fem.open_water.curves import Curves, refined_curves
from hydroelastic.fem.open_water.drift_errors import drift_errors
from hydroelastic.fem.open_water.drift_of_orders import wave_errors
from hydroelastic.fem.open_water.field_model import Band, OpenModel
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.functional_errors import dual_motions, functional_errors
from hydroelastic.fem.open_water.incident_waves import RIGHTWARD, direction_of
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.radiation import between, estimated_places, relative_difference
from hydroelastic.fem.open_water.requests import ResponseRequest
from hydroelastic.fem.open_water.response_errors import load_errors, response_errors
from hydroelastic.fem.open_water.response_table import ResponseErrors, response_table
from hydroelastic.fem.open_water.results import Complexes, Floats, HullPressure, Largest, ResponseTable, UnresolvedPeak
from hydroelastic.fem.open_water.solver import OpenSolver, shared_solver
from hydroelastic.fem.open_water.sweep import FEW, Problem, Swept, sweep
from hydroelastic.fem.shape_loads import potential_basis
from hydroelastic.fem.tank.attempts import Attempt
from hydroelastic.fem.tank.error_estimates import boundary_error, joined_errors
from hydroelastic.fem.tank.resolution import Resolution, rounding_error
from hydroelastic.physics.contours import points_along

# Largest part of a motion by which its drawn curve may miss it.
_DRAWN = 1e-3

# Points of a facet by which the cells nearest to a given point are chosen, and how many of them.
_NEAR, _CANDIDATES = np.linspace(0.0, 1.0, 9)[:, None], 3

# Least difference of a peak from the line between its neighbours, relative to the largest value of the curve.
_DIFFERS = 0.1

# Name of a quantity, its magnitudes on the curve and at the peaks, and what is large for it.
_Curve: TypeAlias = tuple[str, Floats, Floats, float]


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


def solve_response(problem: OpenWaterProblem, request: ResponseRequest) -> ResponseSolution:
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
        table = replace(table, **_on_hulls(request, found.swept.solutions, found.swept.errors))
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


def _on_hulls(request: ResponseRequest, solutions: list[OpenResponse], reduced: np.ndarray) -> dict[str, Any]:
    """Pressures along hulls, and of sections in one liquid the drift force by the field beside the bodies,
    with the relative errors by the reduced basis (collective)."""

    tank, units = solutions[0].model.basin.tank, solutions[0].model.basin.units
    hulls = [index for index, hull in tank.hulls.items() if not hull.is_thin]
    towards = direction_of(request.waves_from)
    found: dict[str, Any] = {"hulls": tuple(hull_pressure(solutions, reduced, index, towards) for index in hulls)}
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


@dataclass(frozen=True, kw_only=True)
class _Places:
    """Points of a hull on this process: their numbers among all, where they are, and their cells with points of the
    reference cell."""

    numbers: np.ndarray
    points: np.ndarray
    cells: np.ndarray
    reference: np.ndarray


def hull_pressure(
    responses: list[OpenResponse],
    reduced: np.ndarray,
    index: int,
    towards: int = RIGHTWARD,
) -> HullPressure:
    """Return the pressure ρω²Ψ along the hull of a float from the left to the right (collective).

    Its error is the part of ψ in the highest polynomial on the worst facet, which that of the field is below where the
    degree is high enough; beside it that of the resultants of the pressure, over the surface on which they act, and
    the relative ones by the reduced basis, the shape of the hull and rounding. The waves far away have larger errors:
    in long waves a body follows the water, and hardly changes the pressure in it.
    """
    model = responses[0].model
    units, comm = model.basin.units, model.pencil.comm
    weight, origin = units.density * units.gravity, np.array([model.basin.origin, 0.0])
    hull = model.basin.tank.hulls[index]
    arcs = (*hull.below, *hull.above)
    if model.basin.tank.geometry.is_revolved:
        arcs = arcs_beside(arcs, 0.0, 1.0)
    scaled = np.vstack([points_along(arcs), [arcs[-1].end]])
    points, places = units.length * scaled + origin, _nearest(model, index, scaled)
    values = np.zeros((len(responses), len(responses[0].incident), len(points)), dtype=complex)
    rough = np.zeros(values.shape[:2])
    for row, response in enumerate(responses):
        for number in range(len(response.incident)):
            values[row, number, places.numbers], rough[row, number] = _pressures(
                response, index, number, towards, places
            )
    comm.Allreduce(MPI.IN_PLACE, values)
    comm.Allreduce(MPI.IN_PLACE, rough, op=MPI.MAX)
    smooth = np.array([_of_resultants(one, index, towards) for one in responses])
    relative = reduced + boundary_error(model.pencil.liquid.tank, model.basin.tank)
    relative += 2.0 * rounding_error(model.resolution.degree, min(model.basin.tank.depth, 1.0))
    return HullPressure(
        body=index,
        points=points,
        pressure=np.asarray(weight * values),
        pressure_error=weight * (rough + smooth + relative[:, None] * np.abs(values).max(axis=2)),
    )


def _of_resultants(response: OpenResponse, index: int, towards: int) -> np.ndarray:
    """Largest error of a resultant of the pressure on a float, per elevation and over ∫ρ|φᵢ|, shape (incident,).

    The resultants are the forces K − iωB − λM_b that the motions need, but for those of the incident wave.
    """
    model, first = response.model, sum(body.size for body in response.model.pencil.bodies[:index])
    surface = model.wetted[index]
    areas = surface.integrals(np.abs(surface.shapes), np.ones((1, len(surface.points))))[:, :1].real
    needed = (model.restoring(response.squared) - response.squared * model.mass)[first : first + len(areas)]
    away, tips = functional_errors(response, dual_motions(response, needed))
    found: np.ndarray = np.abs(response.per_elevation(towards)) * ((away + tips) / areas).max(axis=0, initial=0.0)
    return found


def _groups(model: OpenModel, index: int) -> Iterator[FacetGroup]:
    return facet_groups(model.pencil.liquid, model.pencil.bodies[index].surface)


def _nearest(model: OpenModel, index: int, points: np.ndarray) -> _Places:
    """The nearest points of the cells beside a hull to given points, each on one process (collective)."""
    comm, mesh = model.pencil.comm, model.pencil.liquid.tank.mesh
    away, cells, reference = np.full(len(points), np.inf), np.zeros(len(points), dtype=int), np.zeros((len(points), 2))
    for group in _groups(model, index):
        near = group.physical_points(group.reference_points(_NEAR)).reshape(-1, 2)
        for candidates in cKDTree(near).query(points, min(_CANDIDATES, len(near)))[1].T:
            own = group.cells[candidates // len(_NEAR)]
            at, distance = nearest_in_cells(mesh, own, points)
            nearer = distance < away
            away[nearer], cells[nearer], reference[nearer] = distance[nearer], own[nearer], at[nearer]
    numbers = np.flatnonzero(np.argmin(comm.allgather(away), axis=0) == comm.rank)
    return _Places(numbers=numbers, points=points[numbers], cells=cells[numbers], reference=reference[numbers])


def _pressures(
    response: OpenResponse, index: int, incident: int, towards: int, places: _Places
) -> tuple[np.ndarray, float]:
    """The pressure per elevation at points of this process, and its part in the highest polynomial."""
    model = response.model
    pencil, liquid = model.pencil, model.pencil.liquid
    scattered = response.scattered[incident]
    real, imaginary = (
        function.x.array
        for function in as_functions(liquid, [pencil.vector(part) for part in (scattered.real, scattered.imag)])
    )
    plane = response.incidence.planes[response.incident[incident]]
    per_elevation = response.squared * response.per_elevation(towards)[incident]
    psi = per_elevation * (real + 1j * imaginary)
    # The densities of the model have the factor of the azimuthal order.
    densities = np.array([layer.density for layer in liquid.layers]) / model.basin.tank.geometry.measure
    nodes, weights = leggauss(liquid.degree + 1)
    highest = (liquid.degree + 0.5) * weights * legvander(nodes, liquid.degree)[:, -1]
    rough = 0.0
    for group in _groups(model, index):
        dofs = liquid.space.dofmap.list[group.cells]
        density = densities[liquid.layer_of[dofs[:, :1]]]
        along = density * (psi[dofs] @ potential_basis(liquid, group.reference_points(0.5 * (nodes[:, None] + 1.0))).T)
        rough = max(rough, float(np.abs(along @ highest).max(initial=0.0)))
    dofs = liquid.space.dofmap.list[places.cells]
    layers = liquid.layer_of[dofs[:, 0]]
    basis = potential_basis(liquid, places.reference).reshape(dofs.shape)
    incoming = per_elevation * plane.field(places.points, layers)[0]
    return densities[layers] * ((basis * psi[dofs]).sum(axis=1) + incoming), rough


def unresolved_peaks(
    table: ResponseTable, resonances: Complexes, between: Callable[[Floats], ResponseTable]
) -> tuple[UnresolvedPeak, ...]:
    """Return the largest of the peaks between each two frequencies, by ascending frequency."""
    omegas = np.sort(table.omega)
    probed = np.array(list(_narrow(omegas, resonances)))
    if not probed.size:
        return ()
    peaks = between(probed)
    # Peaks of motions replace those of waves between the same frequencies.
    worst = _worst(probed, table.omega, _ratios(table, peaks)) | _worst(probed, table.omega, _motions(table, peaks))
    return tuple(worst[below] for below in sorted(worst))


def _worst(probed: Floats, omegas: Floats, curves: Iterator[_Curve]) -> dict[float, UnresolvedPeak]:
    """The largest peak between each two frequencies, by the lower one."""
    order = np.argsort(omegas)
    ordered = omegas[order]
    changes: dict[float, float] = {}
    worst: dict[float, UnresolvedPeak] = {}
    for quantity, shown, found, scale in curves:
        drawn = np.interp(probed, ordered, shown[order])
        for omega, value, line in zip(probed, found, drawn, strict=True):
            place = int(np.searchsorted(ordered, omega))
            below, above = float(ordered[place - 1]), float(ordered[place])
            change = abs(value - line) / max(scale, value)
            if change > changes.get(below, _DIFFERS):
                changes[below] = change
                worst[below] = UnresolvedPeak(
                    below=below,
                    above=above,
                    omega=float(omega),
                    quantity=quantity,
                    value=float(value),
                    drawn=float(line),
                )
    return worst


def _narrow(omegas: Floats, resonances: Complexes) -> Iterator[float]:
    """Frequencies of resonances that are narrower than the distance of their neighbours on the curve."""
    for below, above in pairwise(omegas):
        inside = (resonances.real > below) & (resonances.real < above) & (np.abs(resonances.imag) < above - below)
        yield from np.unique(resonances.real[inside])


def _motions(table: ResponseTable, peaks: ResponseTable) -> Iterator[_Curve]:
    turns = np.array([dof.is_rotation for dof in table.dofs], dtype=bool)
    sizes = np.abs(table.amplitudes)
    for incident, wave in enumerate(table.waves):
        for place, dof in enumerate(table.dofs):
            # Motions are compared with the largest one of the same unit.
            scale = float(sizes[:, incident, turns == turns[place]].max())
            found = np.abs(peaks.amplitudes[:, incident, place])
            yield dof + _of(table, wave), sizes[:, incident, place], found, scale


def _ratios(table: ResponseTable, peaks: ResponseTable) -> Iterator[_Curve]:
    if table.reflection is None or table.transmission is None:
        return
    assert peaks.reflection is not None
    assert peaks.transmission is not None
    for name, shown, found in (
        ("|R|", np.abs(table.reflection), np.abs(peaks.reflection)),
        ("|T|", np.abs(table.transmission), np.abs(peaks.transmission)),
    ):
        for incident, wave in enumerate(table.waves):
            for outgoing, left in enumerate(table.waves):
                label = f"{name} {left}{_of(table, wave)}" if len(table.waves) > 1 else name
                curve = shown[:, incident, outgoing]
                yield label, curve, found[:, incident, outgoing], float(curve.max())


def _of(table: ResponseTable, wave: str) -> str:
    return f" in {wave} waves" if len(table.waves) > 1 else ""
