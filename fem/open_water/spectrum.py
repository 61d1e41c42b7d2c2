"""Bodies in irregular waves: transfer functions at frequencies that miss nothing, and the statistics of responses.

A reduced basis serves the whole band of the spectrum, and gives motions at as many frequencies as their curves need.
Drag is replaced by linear damping of least mean square difference, from the standard deviation of the velocities along
it, with the equations of motion at these frequencies; see `physics/attachments.py`, `physics/irregular_waves.py`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from hydroelastic.fem.open_water.attempts import best_over_band
from hydroelastic.fem.open_water.beam_loads import BeamLoads
from hydroelastic.fem.open_water.curves import Curves, certified_curves, elevation_of
from hydroelastic.fem.open_water.field_model import Band, OpenModel
from hydroelastic.fem.open_water.outside import displacement_at
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.radiation import estimated_places, relative_difference
from hydroelastic.fem.open_water.requests import SpectrumRequest
from hydroelastic.fem.open_water.response import outcome, plate_deflection, response_errors
from hydroelastic.fem.open_water.results import IrregularResponse, PlateStatistics, SpectrumTable
from hydroelastic.fem.open_water.solver import shared_solver
from hydroelastic.fem.open_water.sweep import SHARE, Problem
from hydroelastic.fem.tank.attempts import Attempt
from hydroelastic.fem.tank.error_estimates import joined_errors
from hydroelastic.fem.tank.resolution import Resolution
from hydroelastic.physics.attachments import IRREGULAR
from hydroelastic.physics.irregular_waves import moments, statistics

# Frequencies at first.
_FIRST = 33
# Part of the tolerance that waves beyond the frequencies may leave, and the largest factor by which these are widened.
_BEYOND, _WIDEST = 0.5, 2.0
# Frequencies over the last one, above which the drift force tells how it may change beyond.
_LAST = 0.7
_CAUSES = ("sampling_error", "truncation_error", "transfer_error")
_LOADS = ("deflection", "bending_moment", "shear_force")
# How often all intervals between frequencies are halved for the sake of the moments.
_HALVINGS = 3


@dataclass(frozen=True, kw_only=True)
class SpectrumSolution:
    """Result of a spectrum analysis.

    Attributes:
        table: the results in SI units.
        model: the last field model.
        error: the largest relative error, of transfer functions or of statistics.
    """

    table: SpectrumTable
    model: OpenModel
    error: float


def solve_spectrum(problem: OpenWaterProblem, request: SpectrumRequest) -> SpectrumSolution:
    """Solve for the statistics of responses to irregular waves (collective).

    Args:
        problem: the open water.
        request: spectrum, duration, points.
    """
    lowest, highest = request.band
    low, high = problem.shared_band(lowest, highest)
    band = Band(lowest=low, highest=high)

    def solve(resolution: Resolution) -> Attempt[tuple[SpectrumTable, OpenModel]]:
        solver = shared_solver(problem, band, resolution)
        solver.elevation, solver.damping = 0.0, np.zeros_like(solver.model.mass)
        incident = [0 if request.waves_from == "left" else len(solver.model.basin.scaled_layers.branches)]
        frequencies = Problem(
            full=lambda omega: solver.response(omega.real, incident),
            reduced=lambda omega: solver.response_between(omega.real, incident),
            difference=lambda one, other: relative_difference(outcome(one), outcome(other)),
        )
        omegas = np.geomspace(lowest, highest, _FIRST)
        for _ in range(_HALVINGS + 1):
            curves = certified_curves(solver, incident, omegas, frequencies, problem.tolerance)
            with problem.watch.stage("errors"):
                places = _estimated(curves)
                causes = [response_errors(curves.responses[place]) for place in places]
            total = np.array([cause.total.max() for cause in causes])
            # About a resonance they change by orders of magnitude.
            errors = curves.errors + np.exp(np.interp(curves.omegas, curves.omegas[places], np.log(total)))
            table = _table(request, replace(curves, errors=errors))
            if table.largest_error("sampling_error") <= SHARE * problem.tolerance:
                break
            omegas = curves.omegas
        joined = joined_errors(causes, float(curves.errors.max()))
        units = solver.model.basin.units
        # The drift force of waves that are reflected in full.
        reflected = units.density * units.gravity * request.spectrum.significant_height**2 / 16.0
        drift = table.mean_drift_error / reflected
        # Waves that carry no energy need no accuracy.
        own = max(table.largest_error("transfer_error"), drift)
        return Attempt(
            result=(table, solver.model),
            causes=joined.scaled(own / joined.largest_total),
            resolution=resolution,
        )

    attempt = best_over_band(problem, band, solve)
    table, model = attempt.result
    beyond = table.largest_error("truncation_error")
    if request.highest is None and beyond > _BEYOND * problem.tolerance:
        # The energy beyond falls like ω⁻⁴.
        wider = min((beyond / (0.5 * _BEYOND * problem.tolerance)) ** 0.25, _WIDEST)
        return solve_spectrum(problem, replace(request, highest=wider * highest))
    return SpectrumSolution(table=table, model=model, error=max(attempt.error, table.largest_error("relative_error")))


def _estimated(curves: Curves) -> list[int]:
    """Return indices of frequencies whose errors are estimated: a few of all, and the tops and sides of peaks."""
    sizes = np.abs(curves.motions)
    found = set(estimated_places(curves.omegas))
    for size in sizes.T:
        top = int(size.argmax())
        low = np.flatnonzero(size < 0.5 * size[top])
        sides = [top, *low[low < top][-1:], *low[low > top][:1]]
        found.update(int(place) for place in sides)
    return sorted(found)


def _table(request: SpectrumRequest, curves: Curves) -> SpectrumTable:
    model, omegas = curves.solver.model, curves.omegas
    damping, drag, motions = _with_drag(request, curves)
    rows = _rows(model, request)
    directions = np.array([row.direction for row in rows]).reshape(len(rows), motions.shape[1])
    factors = np.where([row.is_acceleration for row in rows], -(omegas**2)[:, None], 1.0)
    transfer = motions @ directions.T * factors
    deviations = _deviation(model, curves, motions) @ np.abs(directions).T * np.abs(factors)
    told = statistics(request.spectrum, omegas, transfer, deviations, request.duration)
    density = request.spectrum.density(omegas)
    back = np.linalg.inv(model.scale.turn * model.scale.lengths[:, None])
    unit = model.basin.units.density * model.basin.units.gravity * model.basin.units.length**3
    drift, drift_error = _mean_drift(request, curves, motions)
    return SpectrumTable(
        waves=request.words,
        waves_from=request.waves_from,
        significant_height=request.spectrum.significant_height,
        duration=request.duration,
        omega=omegas,
        density=density,
        quantities=tuple(row.name for row in rows),
        transfer=transfer,
        response_density=np.abs(transfer) ** 2 * density[:, None],
        relative_error=curves.errors,
        responses=tuple(
            IrregularResponse(
                quantity=row.name,
                unit=row.unit,
                significant_amplitude=float(told.significant_amplitude[place]),
                largest_amplitude=float(told.largest_amplitude[place]),
                zero_crossing_period=float(told.zero_crossing_period[place]),
                relative_error=float(told.relative_error[place]),
                sampling_error=float(told.sampling_error[place]),
                truncation_error=float(told.truncation_error[place]),
                transfer_error=float(told.transfer_error[place]),
            )
            for place, row in enumerate(rows)
        ),
        dofs=model.scale.dofs,
        mean_drift_force=drift,
        mean_drift_error=drift_error,
        equivalent_damping=back.T @ damping @ back * (unit / model.basin.units.frequency),
        plates=tuple(_plates(request, curves, motions, drag)),
    )


def _with_drag(request: SpectrumRequest, curves: Curves) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the damping in place of drag, its part of each drag, dimensionless, and the motions with it per elevation,
    shape (n, unknowns)."""
    model, outside = curves.solver.model, curves.solver.model.outside
    equations = [response.equations for response in curves.responses]
    dynamic = np.array([one.dynamic for one in equations])
    (place,) = curves.responses[0].incident
    elevations = np.array([elevation_of(response) for response in curves.responses])
    forces = np.array([one.forces[place] for one in equations]) / elevations[:, None]
    scaled = curves.omegas / model.basin.units.frequency

    def moved(damping: np.ndarray) -> np.ndarray:
        whole = dynamic - 1j * scaled[:, None, None] * damping
        motions: np.ndarray = np.linalg.solve(whole, forces[..., None])[..., 0]
        return motions

    def speeds(damping: np.ndarray) -> np.ndarray:
        velocities = scaled[:, None] * (moved(damping) @ outside.paths.T)
        deviations: np.ndarray = np.sqrt(moments(request.spectrum, curves.omegas, velocities, (0,))[0])
        return deviations / model.basin.units.length

    damping = outside.equivalent_damping(speeds, IRREGULAR) if len(outside.drag) else np.zeros_like(model.mass)
    return damping, IRREGULAR * outside.drag * speeds(damping), moved(damping)


def _mean_drift(request: SpectrumRequest, curves: Curves, motions: np.ndarray) -> tuple[float, float]:
    """Mean of the drift force along x, 2 ∫ (F/A²) S dω, and its estimated error, N/m.

    Args:
        request: the request.
        curves: the transfer functions.
        motions: per elevation, with the damping in place of drag, shape (n, unknowns).
    """
    units = curves.solver.model.basin.units
    forces, errors = np.empty((2, len(motions)))
    for place, (one, motion) in enumerate(zip(curves.responses, motions, strict=True)):
        elevation = elevation_of(one)
        moved = (elevation * motion)[None]
        forces[place] = one.drift_force(moved)[0] / abs(elevation) ** 2
        errors[place] = one.drift_error(float(curves.errors[place]), moved)[0] / abs(elevation) ** 2
    # F/A² is the square of a transfer function: it is along the waves, for no more waves pass than come.
    roots = np.sqrt(np.abs(forces))[:, None]
    told = statistics(
        request.spectrum, curves.omegas, roots, np.sqrt(roots**2 + errors[:, None]) - roots, request.duration
    )
    # Short waves are reflected: the force beyond is as at the end, and changes no more than up to there.
    unit, tail = 2.0 * units.density * units.gravity, request.spectrum.tail(curves.omegas[-1], 0)
    last = np.abs(forces[curves.omegas >= _LAST * curves.omegas[-1]])
    within = unit * float(told.moments[0, 0])
    mean = within + unit * tail * last[-1]
    # Of an amplitude, half of that of its square.
    error = 2.0 * float((told.sampling_error + told.transfer_error)[0]) * within + unit * tail * float(np.ptp(last))
    return mean if request.waves_from == "left" else -mean, error


@dataclass(frozen=True, kw_only=True)
class _Row:
    """A response: its part of each body unknown, in SI units per unit elevation; times −ω² for an acceleration."""

    name: str
    unit: str
    direction: np.ndarray
    is_acceleration: bool = False


def _rows(model: OpenModel, request: SpectrumRequest) -> list[_Row]:
    """Motions of rigid bodies, and motions and accelerations of points."""
    scale, elastic = model.scale, model.basin.tank.elastic
    motions = scale.turn * scale.lengths[:, None] / model.basin.units.length
    rows = [
        _Row(name=dof, unit="rad" if dof.is_rotation else "m", direction=motion.astype(complex))
        for dof, motion in zip(scale.dofs, motions, strict=True)
        if (dof.body or 1) - 1 not in elastic
    ]
    starts = np.cumsum([0, *(body.size for body in model.pencil.bodies)])
    for number, (index, point) in enumerate(request.points, 1):
        moved = np.zeros((3, starts[-1]), dtype=complex)
        moved[:, starts[index] : starts[index + 1]] = displacement_at(
            model.basin, model.pencil.bodies[index], index, point
        )
        rows.append(_Row(name=f"point {number} up", unit="m", direction=moved[0]))
        if index not in elastic:
            rows.append(_Row(name=f"point {number} sideways", unit="m", direction=moved[1]))
        rows.append(_Row(name=f"point {number} acceleration up", unit="m/s²", direction=moved[0], is_acceleration=True))
    return rows


def _deviation(model: OpenModel, curves: Curves, motions: np.ndarray) -> np.ndarray:
    """Errors of the motions per elevation, shape (n, unknowns): relative to the largest of the same unit."""
    turns = np.array([dof.is_rotation for dof in model.scale.dofs])
    sizes = np.abs(motions)
    largest = np.stack([sizes[:, turns == turn].max(axis=1) for turn in turns], axis=1)
    deviation: np.ndarray = curves.errors[:, None] * largest
    return deviation


def _plates(
    request: SpectrumRequest, curves: Curves, motions: np.ndarray, drag: np.ndarray
) -> Iterator[PlateStatistics]:
    """Deflection, bending moment and shear force along each beam."""
    model = curves.solver.model
    for index, beam in model.basin.tank.beams.items():
        x: np.ndarray = np.linspace(0.0, beam.length, request.positions)
        along = BeamLoads(model, index, x)
        found = [
            along.of(one, (elevation_of(one) * motion)[None], drag[None])
            for one, motion in zip(curves.responses, motions, strict=True)
        ]
        plate = plate_deflection(model, index, x, curves.responses, found, curves.errors)
        told, parts = {}, np.zeros((len(_CAUSES), len(_LOADS)))
        for place, name in enumerate(_LOADS):
            transfer = getattr(plate, name)[:, 0]
            deviation = np.broadcast_to(getattr(plate, f"{name}_error"), transfer.shape)
            told[name] = statistics(request.spectrum, curves.omegas, transfer, deviation, request.duration)
            sizes = told[name].significant_amplitude
            for row, cause in enumerate(_CAUSES):
                # √(m₀ + δm₀) − √m₀: where hardly anything acts, as at the ends, the error is larger than the value.
                grown = np.sqrt(1.0 + 2.0 * getattr(told[name], cause)) - 1.0
                parts[row, place] = (grown * sizes).max() / max(sizes.max(), np.finfo(float).tiny)
        largest = parts.max(axis=1).tolist()
        yield PlateStatistics(
            body=index,
            positions=plate.positions,
            significant_deflection=told["deflection"].significant_amplitude,
            significant_bending_moment=told["bending_moment"].significant_amplitude,
            largest_bending_moment=told["bending_moment"].largest_amplitude,
            significant_shear_force=told["shear_force"].significant_amplitude,
            largest_stress=np.multiply(6.0 / request.thickness**2, told["bending_moment"].largest_amplitude)
            if request.thickness
            else None,
            relative_errors=dict(zip(_LOADS, parts.sum(axis=0).tolist(), strict=True)),
            **dict(zip(_CAUSES, largest, strict=True)),
        )
