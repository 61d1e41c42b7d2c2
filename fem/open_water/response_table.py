"""Responses of one azimuthal order, or of a section, as a table in SI units."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from hydroelastic.fem.open_water.beam_loads import AlongBeam, BeamLoads
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.incident_waves import RIGHTWARD, direction_of
from hydroelastic.fem.open_water.requests import ResponseRequest
from hydroelastic.fem.open_water.response_errors import motion_errors
from hydroelastic.fem.open_water.results import PlateDeflection, ResponseTable, RoundDeflection
from hydroelastic.fem.open_water.round_plates import deflections_of_order, radii_along
from hydroelastic.physics.attachments import REGULAR


@dataclass(frozen=True, kw_only=True)
class ResponseErrors:
    """Errors of responses at n frequencies."""

    total: np.ndarray  # of motions and waves, relative to the incident wave, shape (n,)
    reduced: np.ndarray  # those by the reduced basis alone, shape (n,)
    drift: np.ndarray  # of the drift force per |c|², in units of the basin, shape (n, incident)
    of_loads: dict[int, np.ndarray] = field(default_factory=dict)  # see `load_errors`


def response_table(
    request: ResponseRequest,
    model: OpenModel,
    omegas: np.ndarray,
    solutions: list[OpenResponse],
    errors: ResponseErrors,
    *,
    with_plates: bool = True,
) -> ResponseTable:
    """Return the table of responses at frequencies ω, rad/s, shape (n,), with what acts along plates or without it."""
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
        amplitude_error=np.array([motion_errors(*pair) for pair in zip(solutions, errors.total, strict=True)]),
        reflection=None if is_round else waves[:, :, back],
        transmission=None if is_round else waves[:, :, forward],
        partial_waves=np.array([one.partial_waves() for one in solutions])[..., None] if is_round else None,
        absorption=np.array([solution.absorption for solution in solutions]),
        drift_force=drift_forces(solutions),
        drift_error=_per_elevation(solutions, errors.drift),
        energy_residual=np.array([solution.energy_residual() for solution in solutions]),
        relative_error=errors.total,
        plates=tuple(_plates(request, model, solutions, errors)) if with_plates else (),
        round_plates=tuple(_round_plates(request, model, solutions, errors)) if with_plates else (),
        fields_at=request.fields_at,
        wave_amplitude=request.elevation,
    )


def drift_forces(solutions: list[OpenResponse]) -> np.ndarray:
    """Return the mean force along x per square of the elevation of each incident wave, N/m³, shape (n, incident)."""
    return _per_elevation(solutions, np.array([one.drift_force() for one in solutions]))


def _per_elevation(solutions: list[OpenResponse], forces: np.ndarray) -> np.ndarray:
    """Forces per |c|² in units of the basin, shape (n, incident), per square of the elevation in SI units."""
    units = solutions[0].model.basin.units
    elevations = np.array([one.incidence.elevations[one.incident] for one in solutions])
    scaled: np.ndarray = units.density * units.gravity * forces / elevations**2
    return scaled


def _moved(
    request: ResponseRequest, model: OpenModel, solutions: list[OpenResponse]
) -> list[tuple[np.ndarray, np.ndarray]]:
    """Motions, and linear damping in place of each drag, of each response."""
    outside, found = model.outside, []
    for solution in solutions:
        heights = solution.incidence.heights(model.basin, request.elevation)[solution.incident]
        speeds = np.sqrt(solution.squared.real) * np.abs(solution.motions @ outside.paths.T) * heights[:, None]
        found.append((solution.motions, REGULAR * outside.drag * speeds))
    return found


def _round_plates(
    request: ResponseRequest, model: OpenModel, solutions: list[OpenResponse], errors: ResponseErrors
) -> Iterator[RoundDeflection]:
    return deflections_of_order(
        model,
        solutions,
        _moved(request, model, solutions),
        direction_of(request.waves_from),
        errors.reduced,
        errors.of_loads,
        lambda index: model.basin.units.length * radii_along(model.basin.tank, index, request.positions),
    )


def _plates(
    request: ResponseRequest,
    model: OpenModel,
    solutions: list[OpenResponse],
    errors: ResponseErrors,
) -> Iterator[PlateDeflection]:
    for index, beam in model.basin.tank.beams.items():
        x: np.ndarray = np.linspace(0.0, beam.length, request.positions)
        along = BeamLoads(model, index, x)
        moved = zip(solutions, _moved(request, model, solutions), strict=True)
        found = [along.of(one, *own) for one, own in moved]
        meshed = errors.of_loads.get(index, np.zeros((len(solutions), 3, len(solutions[0].incident))))
        yield plate_deflection(model, index, x, solutions, found, errors.reduced, meshed)


def plate_deflection(
    model: OpenModel,
    index: int,
    x: np.ndarray,
    solutions: list[OpenResponse],
    found: list[AlongBeam],
    reduced: np.ndarray,
    of_loads: np.ndarray,
) -> PlateDeflection:
    """Return what acts along a beam in SI units, with its errors."""
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
