"""Bodies in irregular waves: transfer functions at frequencies that miss nothing, and the statistics of responses.

A reduced basis serves the whole band of the spectrum, and gives motions at as many frequencies as their curves need.
Drag is replaced by linear damping of least mean square difference, from the standard deviation of the velocities along
it, with the equations of motion at these frequencies; see `physics/attachments.py`, `physics/irregular_waves.py`.

How many azimuthal orders, and which mesh, the loads of round plates in irregular waves need.

Short waves bend a plate of radius a in all orders up to ka, and in higher ones hardly at all: orders are added until
those left out change the spectra of deflection, bending moment and shear force by a small part of the tolerance. Which
error the mesh leaves in loads is known from the first orders.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, reduce
from itertools import count

import numpy as np
from scipy.linalg import block_diag

from hydroelastic.fem.bodies.round_plate import plate_of
from hydroelastic.fem.open_water.attempts import best_over_band
from hydroelastic.fem.open_water.curves import Curves, certified_curves
from hydroelastic.fem.open_water.field_model import Band, OpenModel
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.incident_waves import RIGHTWARD, direction_of
from hydroelastic.fem.open_water.irregular_results import AirGap, IrregularResponse, SpectrumTable
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.radiation import relative_difference
from hydroelastic.fem.open_water.requests import SpectrumRequest
from hydroelastic.fem.open_water.response import incident_places, outcome
from hydroelastic.fem.open_water.response_errors import response_errors
from hydroelastic.fem.open_water.results import Floats, RoundDeflection
from hydroelastic.fem.open_water.round_plates import bent_by, deflections_of_order, joined, left_out, radii_along
from hydroelastic.fem.open_water.solver import shared_solver
from hydroelastic.fem.open_water.spectrum_drift import mean_drift, mean_power, reflected_drift
from hydroelastic.fem.open_water.spectrum_rows import (
    air_gaps_of_plates,
    along_plates,
    estimated_about_peaks,
    meshed_load_errors,
    motion_errors,
    order_of_motions,
    points_of_plates,
    response_rows,
    statistics_along,
)
from hydroelastic.fem.open_water.surface_elevation import (
    incident_elevations,
    reach_of,
    sampled_elevations,
    scattered_elevations,
    surface_rows,
)
from hydroelastic.fem.open_water.sweep import SHARE, Problem
from hydroelastic.fem.tank.attempts import Attempt
from hydroelastic.fem.tank.error_estimates import joined_errors
from hydroelastic.fem.tank.resolution import Resolution
from hydroelastic.physics.attachments import IRREGULAR
from hydroelastic.physics.irregular_waves import moments, statistics
from hydroelastic.physics.tank import Tank

# Frequencies at first.
_FIRST = 33
# Part of the tolerance that waves beyond the frequencies may leave, and the largest factor by which these are widened.
_BEYOND, _WIDEST = 0.5, 2.0
# Parts of it that orders left out, and the mesh in the first orders, may change the loads of round plates by, and that
# which a finer mesh shall leave.
_OF_ORDERS, _OF_MESH, _FINER = 0.5, 0.75, 0.25
# Smallest tolerance of the orders for that of the loads of round plates.
_LEAST = 1e-3
# Frequencies over the last one, of which the largest elevation is taken for that beyond.
_LAST = 0.7
# How often all intervals between frequencies are halved for the sake of the moments.
_HALVINGS = 3
# Least tolerance of waves of orders in which nothing moves, and part of the tolerance that the last of them may
# contribute to an elevation.
_FIXED, _LEFT_OUT = 1e-4, 0.1

# Points along a diameter.
_POSITIONS = 15


@dataclass(frozen=True, kw_only=True)
class SpectrumSolution:
    """Result of a spectrum analysis."""

    table: SpectrumTable  # the results in SI units
    model: OpenModel  # the last field model
    error: float  # the largest relative error, of transfer functions or of statistics


def solve_spectrum(
    problem: OpenWaterProblem, request: SpectrumRequest, tolerance: float | None = None
) -> SpectrumSolution:
    """Solve for the statistics of responses to irregular waves (collective).

    The orders of solids of revolution in which they move, and those that scatter waves for the drift force, have the
    same frequencies in the end. Loads of round plates are sums over as many orders as they need, on meshes whose errors
    in the first orders are a part of the tolerance; should the others add too much, all are solved anew.
    """
    tolerance = tolerance or problem.tolerance
    attempts = [_curves(problem.of_order(order), request) for order in problem.tank.orders]
    if any(modes.bends for modes in attempts[0].result.solver.model.plate_modes.values()):
        meshed = _meshed_loads(problem, request, attempts)
        if meshed > _OF_MESH * tolerance and (finer := _with_smaller_errors(problem, meshed, tolerance)):
            return solve_spectrum(finer, request, tolerance)
        attempts = _further_bent(problem, request, attempts, tolerance)
    omegas = reduce(np.union1d, (one.result.omegas for one in attempts))
    curves = [one.result.at(omegas, problem.tolerance) for one in attempts]
    table = _table(replace(problem, tolerance=tolerance), request, curves)
    drift = np.nan_to_num(table.mean_drift_truncation) / reflected_drift(problem.tank, request.spectrum)
    beyond = max(table.largest_error("truncation_error"), drift)
    if request.highest is None and beyond > _BEYOND * tolerance:
        # The energy beyond falls like ω⁻⁴.
        highest = min((beyond / (0.5 * _BEYOND * tolerance)) ** 0.25, _WIDEST) * request.band[1]
        return solve_spectrum(problem, replace(request, highest=highest), tolerance)
    loads = max((one.transfer_error for one in table.plates), default=0.0)
    if (
        problem.tank.geometry.is_revolved
        and loads > tolerance
        and (finer := _with_smaller_errors(problem, loads, tolerance))
    ):
        return solve_spectrum(finer, request, tolerance)
    return SpectrumSolution(
        table=table,
        model=max((one.solver.model for one in curves), key=lambda model: model.pencil.size),
        error=max(table.largest_error("relative_error"), *(one.error for one in attempts)),
    )


def _with_smaller_errors(problem: OpenWaterProblem, error: float, tolerance: float) -> OpenWaterProblem | None:
    """Return the problem with the tolerance of waves that loads of round plates need; ``None`` if it is the least."""
    # Errors of loads fall at least like the square root of those of waves.
    finer = max(problem.tolerance * (_FINER * tolerance / error) ** 2, _LEAST * tolerance)
    return replace(problem, tolerance=finer, solvers={}) if finer < problem.tolerance else None


def _meshed_loads(problem: OpenWaterProblem, request: SpectrumRequest, attempts: list[Attempt[Curves]]) -> float:
    """Relative error that the mesh leaves in the loads of round plates in the first orders (collective)."""
    common = reduce(np.intersect1d, (one.result.omegas for one in attempts))
    bent = [bent_in_order(problem.tank, request, one.result, common, with_errors=True) for one in attempts]
    return meshed_errors(problem.tank, request, common, bent)


def _further_bent(
    problem: OpenWaterProblem, request: SpectrumRequest, attempts: list[Attempt[Curves]], tolerance: float
) -> list[Attempt[Curves]]:
    """Transfer functions of the orders in which bodies move, and of as many as loads of round plates need
    (collective)."""
    attempts = list(attempts)
    omegas = reduce(np.intersect1d, (one.result.omegas for one in attempts))
    bent = [bent_in_order(problem.tank, request, one.result, omegas) for one in attempts]
    while orders_left_out(problem.tank, request, omegas, bent) > _OF_ORDERS * tolerance:
        # No other analysis asks for these orders: their solvers need not be kept.
        attempts.append(_curves(replace(problem.of_order(len(attempts)), solvers={}), request))
        bent.append(bent_in_order(problem.tank, request, attempts[-1].result, omegas))
    return attempts


def _curves(problem: OpenWaterProblem, request: SpectrumRequest) -> Attempt[Curves]:
    """Transfer functions of one order over the band of the spectrum (collective)."""
    lowest, highest = request.band
    low, high = problem.shared_band(lowest, highest)
    band = Band(lowest=low, highest=high, reach=reach_of(problem.tank, request.air_gaps))

    def solve(resolution: Resolution) -> Attempt[Curves]:
        solver = shared_solver(problem, band, resolution)
        solver.elevation, solver.damping = 0.0, np.zeros_like(solver.model.mass)
        incident = incident_places(solver.model, request.waves_from)[:1]
        rows = surface_rows(solver.model, request.air_gaps)
        if len(rows):
            solver.sample(rows[: len(request.air_gaps)])

        def difference(one: OpenResponse, other: OpenResponse) -> float:
            apart = relative_difference(outcome(one), outcome(other))
            if not len(rows):
                return apart
            motions = [each.motions[0] * each.per_elevation(RIGHTWARD)[0] for each in (one, other)]
            water = [sampled_elevations(*each, rows, RIGHTWARD) for each in zip((one, other), motions, strict=True)]
            return max(apart, float(np.abs(water[0] - water[1]).max()))

        frequencies = Problem(
            full=lambda omega: solver.response(omega.real, incident),
            reduced=lambda omega: solver.response_between(omega.real, incident),
            difference=difference,
        )
        omegas = np.geomspace(lowest, highest, _FIRST)
        for _ in range(_HALVINGS + 1):
            curves = certified_curves(solver, incident, omegas, frequencies, problem.tolerance)
            places = estimated_about_peaks(curves)
            causes = [response_errors(curves.responses[place]) for place in places]
            total = np.array([cause.total.max() for cause in causes])
            joined = joined_errors(causes, float(curves.errors.max()))
            # About a resonance they change by orders of magnitude.
            errors = curves.errors + np.exp(np.interp(curves.omegas, curves.omegas[places], np.log(total)))
            curves = replace(curves, errors=errors, reduced=curves.errors)
            if problem.tank.geometry.is_revolved:
                own = _weighed_error(request, curves)
                break
            table = _table(problem, request, [curves])
            drift = table.mean_drift_error - table.mean_drift_truncation
            own = max(table.largest_error("transfer_error"), drift / reflected_drift(problem.tank, request.spectrum))
            if table.largest_error("sampling_error") <= SHARE * problem.tolerance:
                break
            omegas = curves.omegas
        # Waves that carry no energy need no accuracy.
        return Attempt(result=curves, causes=joined.scaled(own / joined.largest_total), resolution=resolution)

    return best_over_band(problem, band, solve)


def _weighed_error(request: SpectrumRequest, curves: Curves) -> float:
    """Largest relative error of the significant size of waves and of motions of an order, of those of one unit."""
    ones, models = np.ones(len(curves.omegas)), [curves.solver.model]
    sizes = ones[:, None]
    if curves.motions.size:
        sizes = np.column_stack([ones, motion_errors(models, ones, curves.motions)])
    deviations = curves.errors[:, None] * sizes
    told = statistics(request.spectrum, curves.omegas, sizes.astype(complex), deviations, request.duration)
    return float(told.transfer_error.max())


def _table(problem: OpenWaterProblem, request: SpectrumRequest, curves: list[Curves]) -> SpectrumTable:
    models, omegas = [one.solver.model for one in curves], curves[0].omegas
    damping, drag, motions = _with_drag(request, curves)
    errors = np.max([one.errors for one in curves], axis=0)
    rows = response_rows(models, request)
    directions = np.array([row.direction for row in rows]).reshape(len(rows), motions.shape[1])
    factors = np.where([row.is_acceleration for row in rows], -(omegas**2)[:, None], 1.0)
    transfer = motions @ directions.T * factors
    deviations = motion_errors(models, errors, motions) @ np.abs(directions).T * np.abs(factors)
    plates = list(along_plates(problem.tank, request, curves, motions, drag))
    further, gaps = _further_orders(problem, request, omegas), slice(len(rows) - len(request.air_gaps), len(rows))
    if request.air_gaps:
        for water, uncertain in (
            _elevations(problem, request, curves, motions, further),
            air_gaps_of_plates(problem.tank, request, plates),
        ):
            transfer[:, gaps] += water
            deviations[:, gaps] += uncertain
    names = [(row.name, row.unit) for row in rows]
    for quantity, unit, values, off in points_of_plates(problem.tank, request, omegas, plates):
        names.append((quantity, unit))
        transfer, deviations = np.column_stack([transfer, values]), np.column_stack([deviations, off])
    beyond = np.abs(transfer[[0, -1]])
    # Waves that come and are reflected may cancel at the last frequency.
    beyond[1, gaps] = np.abs(transfer[omegas >= _LAST * omegas[-1], gaps]).max(axis=0)
    told = statistics(request.spectrum, omegas, transfer, deviations, request.duration, beyond)
    density = request.spectrum.density(omegas)
    order, dofs = order_of_motions(models)
    units = models[0].basin.units
    back = np.linalg.inv(block_diag(*(model.scale.turn * model.scale.lengths[:, None] for model in models)))
    damping_unit = units.density * units.gravity * units.volume * units.length / units.frequency
    drift = mean_drift(problem, request, curves, motions, damping, further)
    responses = tuple(
        IrregularResponse(
            quantity=name,
            unit=unit,
            significant_amplitude=float(told.significant_amplitude[place]),
            largest_amplitude=float(told.largest_amplitude[place]),
            zero_crossing_period=float(told.zero_crossing_period[place]),
            relative_error=float(told.relative_error[place]),
            sampling_error=float(told.sampling_error[place]),
            truncation_error=float(told.truncation_error[place]),
            transfer_error=float(told.transfer_error[place]),
        )
        for place, (name, unit) in enumerate(names)
    )
    level = problem.tank.levels_from_top[0].height
    return SpectrumTable(
        waves=request.words,
        waves_from=request.waves_from,
        significant_height=request.spectrum.significant_height,
        duration=request.duration,
        omega=omegas,
        density=density,
        quantities=tuple(name for name, _ in names),
        transfer=transfer,
        response_density=np.abs(transfer) ** 2 * density[:, None],
        relative_error=errors,
        responses=responses,
        dofs=dofs,
        mean_drift_force=drift.force,
        mean_drift_error=drift.error + drift.truncation,
        mean_drift_truncation=drift.truncation,
        mean_absorbed_power=mean_power(request, curves, motions),
        equivalent_damping=(back.T @ damping @ back * damping_unit)[np.ix_(order, order)],
        plates=tuple(
            statistics_along(
                request, omegas, plate, getattr(problem.tank.bodies[plate.body], "thickness", request.thickness)
            )
            for plate in plates
        ),
        air_gaps=tuple(
            AirGap(point=gap, still_air_gap=gap.at[1] - level, relative_elevation=one)
            for gap, one in zip(request.air_gaps, responses[gaps], strict=True)
        ),
    )


def _further_orders(problem: OpenWaterProblem, request: SpectrumRequest, omegas: np.ndarray) -> Callable[[int], Curves]:
    """Return what gives the waves of an order in which nothing moves, at the same frequencies (collective)."""
    # No other analysis asks for these orders.
    fixed = replace(problem, solvers={}, tolerance=max(problem.tolerance, _FIXED))

    @cache
    def curves(order: int) -> Curves:
        own = _curves(fixed.of_order(order), request).result.at(omegas, fixed.tolerance)
        chosen = np.searchsorted(own.omegas, omegas)
        responses = [own.responses[place] for place in chosen]
        return replace(own, omegas=omegas, responses=responses, errors=own.errors[chosen], reduced=own.reduced[chosen])

    return curves


def _elevations(
    problem: OpenWaterProblem,
    request: SpectrumRequest,
    curves: list[Curves],
    motions: np.ndarray,
    further: Callable[[int], Curves],
) -> tuple[np.ndarray, np.ndarray]:
    """Elevation of the water at the points of air gaps per unit incident elevation, and its error, each of shape
    (n, points) (collective).

    About an axis orders are added until one contributes less than a part of the tolerance to the spectra.
    """
    stops = np.cumsum([len(one.solver.model.mass) for one in curves])[:-1]
    moved = {own.order: (own, part) for own, part in zip(curves, np.split(motions, stops, axis=1), strict=True)}
    total, uncertain = incident_elevations(curves[0], request)
    density = request.spectrum.density(curves[0].omegas)[:, None]
    weight = _LEFT_OUT**2 * problem.tolerance**2 * density.max()
    for order in count():
        own, motion = moved.get(order) or (further(order), np.zeros((len(density), 0)))
        waves, errors = scattered_elevations(own, motion, request, order)
        total, uncertain = total + waves, uncertain + errors
        if not problem.tank.geometry.is_revolved:
            return total, uncertain
        # Beside a hull the orders fall like powers of the distance from the axis.
        if order >= max(moved) and (np.abs(waves) ** 2 * density).max() <= weight:
            return total, uncertain + np.abs(waves)
    raise AssertionError


def _with_drag(request: SpectrumRequest, curves: list[Curves]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the damping in place of drag, its part of each drag, dimensionless, and the motions of all orders with it
    per elevation, shape (n, unknowns)."""
    omegas, basin = curves[0].omegas, curves[0].solver.model.basin
    outsides = [one.solver.model.outside for one in curves]
    towards = direction_of(request.waves_from)
    dynamic = np.array(
        [
            block_diag(*(response.equations.dynamic for response in responses))
            for responses in zip(*(one.responses for one in curves), strict=True)
        ]
    )
    forces = np.hstack(
        [
            [one.equations.forces[one.incident[0]] * one.per_elevation(towards)[0] for one in own.responses]
            for own in curves
        ]
    )
    paths = np.hstack([one.paths for one in outsides])
    scaled = omegas / basin.units.frequency
    whole = replace(outsides[0], paths=paths, damping=block_diag(*(one.damping for one in outsides)))

    def moved(damping: np.ndarray) -> np.ndarray:
        motions: np.ndarray = np.linalg.solve(dynamic - 1j * scaled[:, None, None] * damping, forces[..., None])[..., 0]
        return motions

    def speeds(damping: np.ndarray) -> np.ndarray:
        velocities = scaled[:, None] * (moved(damping) @ paths.T)
        deviations: np.ndarray = np.sqrt(moments(request.spectrum, omegas, velocities, (0,))[0])
        return deviations / basin.units.length

    damping = whole.equivalent_damping(speeds, IRREGULAR) if len(whole.drag) else np.zeros_like(whole.damping)
    return damping, IRREGULAR * whole.drag * speeds(damping), moved(damping)


def bent_in_order(
    tank: Tank, request: SpectrumRequest, curves: Curves, omegas: Floats, *, with_errors: bool = False
) -> list[RoundDeflection]:
    """Return the deflection of each round plate in an order at some of its frequencies, without drag (collective)."""
    model, places = curves.solver.model, np.searchsorted(curves.omegas, omegas)
    responses = [curves.responses[place] for place in places]
    of_loads = meshed_load_errors(curves) if with_errors else {}
    moved = [(one.motions, np.zeros((len(one.motions), len(model.outside.drag)))) for one in responses]
    return list(
        deflections_of_order(
            model,
            responses,
            moved,
            direction_of(request.waves_from),
            np.zeros(len(omegas)),
            {index: values[places] for index, values in of_loads.items()},
            lambda index: radii_along(tank, index, _POSITIONS),
        )
    )


def meshed_errors(tank: Tank, request: SpectrumRequest, omegas: Floats, bent: list[list[RoundDeflection]]) -> float:
    """Return the errors that the mesh leaves in loads, relative to the largest of each; the arguments are those of
    `orders_left_out`, of some of the orders, with errors."""
    largest = [0.0]
    for parts in zip(*bent, strict=True):
        found = joined(list(parts))
        loads = bent_by(plate_of(tank.bodies[found.body]), found.radii, found.derivatives, np.arange(len(bent)))
        for values, errors in zip(loads, found.uncertain, strict=True):
            largest.append(_part(request, omegas, values, errors.sum(axis=-1)))
    return max(largest)


def _part(request: SpectrumRequest, omegas: Floats, orders: np.ndarray, missing: np.ndarray) -> float:
    """Significant amplitude of what is missing, shape (n, 1), over the largest of a sum of orders, shape (n, 1,
    orders, points)."""
    size, left = (
        np.sqrt(moments(request.spectrum, omegas, transfer.astype(complex), (0,))[0].max())
        for transfer in (orders.sum(axis=-2)[:, 0], missing)
    )
    return float(left / max(size, np.finfo(float).tiny))


def orders_left_out(tank: Tank, request: SpectrumRequest, omegas: Floats, bent: list[list[RoundDeflection]]) -> float:
    """Return what the orders left out change deflections and loads by, relative to the largest of each."""
    orders, largest = np.arange(len(bent)), [0.0]
    for parts in zip(*bent, strict=True):
        found = joined(list(parts))
        plate = plate_of(tank.bodies[found.body])
        loads = bent_by(plate, found.radii, found.derivatives, orders)[: 2 * bool(plate.flexural_rigidity)]
        largest += [_part(request, omegas, values, left_out(values)) for values in (found.derivatives[0], *loads)]
    return max(largest)
