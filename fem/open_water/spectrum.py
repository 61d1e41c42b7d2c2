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
from hydroelastic.fem.open_water.curves import Curves, elevation_of, refined_curves
from hydroelastic.fem.open_water.field_model import Band, OpenModel
from hydroelastic.fem.open_water.outside import displacement_at
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.radiation import between, estimated_places, relative_difference
from hydroelastic.fem.open_water.requests import SpectrumRequest
from hydroelastic.fem.open_water.response import along_beam, outcome, response_errors
from hydroelastic.fem.open_water.results import IrregularResponse, PlateStatistics, SpectrumTable
from hydroelastic.fem.open_water.solver import shared_solver
from hydroelastic.fem.open_water.sweep import Problem, sweep
from hydroelastic.fem.tank.attempts import Attempt
from hydroelastic.fem.tank.error_estimates import joined_errors
from hydroelastic.fem.tank.resolution import Resolution
from hydroelastic.physics.attachments import IRREGULAR
from hydroelastic.physics.irregular_waves import moments, statistics

# Frequencies at first.
_FIRST = 33


@dataclass(frozen=True, kw_only=True)
class SpectrumSolution:
    """Result of a spectrum analysis.

    Attributes:
        table: the results in SI units.
        model: the last field model.
        error: the largest relative error of transfer functions.
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

    def solve(resolution: Resolution) -> Attempt[Curves]:
        solver = shared_solver(problem, band, resolution)
        solver.elevation, solver.damping = 0.0, np.zeros_like(solver.model.mass)
        incident = [0 if request.waves_from == "left" else len(solver.model.basin.scaled_layers.branches)]
        frequencies = Problem(
            full=lambda omega: solver.response(omega.real, incident),
            reduced=lambda omega: solver.response_between(omega.real, incident),
            difference=lambda one, other: relative_difference(outcome(one), outcome(other)),
        )
        omegas = np.geomspace(lowest, highest, _FIRST)
        swept = sweep(frequencies, omegas, problem.tolerance)
        with problem.watch.stage("errors"):
            places = estimated_places(omegas)
            causes = [response_errors(swept.solutions[place]) for place in places]
        curves = refined_curves(solver, incident, omegas, swept, problem.tolerance)
        total = np.array([cause.total.max() for cause in causes])
        known = [int(np.searchsorted(curves.omegas, omegas[place])) for place in places]
        errors = curves.errors + between(curves.omegas, known, total)
        return Attempt(
            result=replace(curves, errors=errors),
            causes=joined_errors(causes, float(curves.errors.max())),
            resolution=resolution,
        )

    attempt = best_over_band(problem, band, solve)
    table = _table(request, attempt.result)
    return SpectrumSolution(table=table, model=attempt.result.solver.model, error=attempt.error)


def _table(request: SpectrumRequest, curves: Curves) -> SpectrumTable:
    model, omegas = curves.solver.model, curves.omegas
    damping, motions = _with_drag(request, curves)
    rows = _rows(model, request)
    directions = np.array([row.direction for row in rows]).reshape(len(rows), motions.shape[1])
    factors = np.where([row.is_acceleration for row in rows], -(omegas**2)[:, None], 1.0)
    transfer = motions @ directions.T * factors
    deviations = _deviation(model, curves, motions) @ np.abs(directions).T * np.abs(factors)
    told = statistics(request.spectrum, omegas, transfer, deviations, request.duration)
    density = request.spectrum.density(omegas)
    back = np.linalg.inv(model.scale.turn * model.scale.lengths[:, None])
    unit = model.basin.units.density * model.basin.units.gravity * model.basin.units.length**3
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
        mean_drift_force=_mean_drift(request, curves, motions),
        equivalent_damping=back.T @ damping @ back * (unit / model.basin.units.frequency),
        plates=tuple(_plates(model, request, curves, motions)),
    )


def _with_drag(request: SpectrumRequest, curves: Curves) -> tuple[np.ndarray, np.ndarray]:
    """Return the damping in place of drag, dimensionless, and the motions with it per elevation, shape (n,
    unknowns)."""
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
    return damping, moved(damping)


def _mean_drift(request: SpectrumRequest, curves: Curves, motions: np.ndarray) -> float:
    """Mean of the drift force along x, 2 ∫ (F/A²) S dω, N/m.

    Args:
        request: the request.
        curves: the transfer functions.
        motions: per elevation, with the damping in place of drag, shape (n, unknowns).
    """
    units = curves.solver.model.basin.units
    forces = [
        float(one.drift_force((elevation_of(one) * motion)[None])[0]) / abs(elevation_of(one)) ** 2
        for one, motion in zip(curves.responses, motions, strict=True)
    ]
    # F/A² is the square of a transfer function: it is along the waves, for no more waves pass than come.
    roots = np.sqrt(np.abs(forces))[:, None]
    mean = 2.0 * units.density * units.gravity * float(moments(request.spectrum, curves.omegas, roots, (0,))[0, 0])
    return mean if request.waves_from == "left" else -mean


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
    model: OpenModel, request: SpectrumRequest, curves: Curves, motions: np.ndarray
) -> Iterator[PlateStatistics]:
    """Deflection, bending moment and shear force along each beam."""
    first, units = 0, model.basin.units
    errors = _deviation(model, curves, motions)
    for index, body in enumerate(model.pencil.bodies):
        own = slice(first, first + body.size)
        first += body.size
        if not model.basin.tank.bodies[index].is_elastic:
            continue
        piece = model.basin.tank.piece_of(index)
        x: np.ndarray = np.linspace(0.0, piece.length, request.positions)
        tables = along_beam(model, index, body.size, x)
        # Of a tip or an end, moment and shear are zero but for the dry modes that are left out.
        deflection, moment, shear = (
            statistics(
                request.spectrum,
                curves.omegas,
                motions[:, own] @ table,
                errors[:, own].max(axis=1)[:, None] * np.abs(table).max(axis=0, initial=0.0),
                request.duration,
            )
            for table in tables
        )
        yield PlateStatistics(
            body=index,
            positions=model.basin.origin + units.length * (piece.start + x),
            significant_deflection=deflection.significant_amplitude,
            significant_bending_moment=moment.significant_amplitude,
            largest_bending_moment=moment.largest_amplitude,
            significant_shear_force=shear.significant_amplitude,
            largest_stress=np.multiply(6.0 / request.thickness**2, moment.largest_amplitude)
            if request.thickness
            else None,
        )
