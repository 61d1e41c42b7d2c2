"""Errors of motions in waves, of the waves that leave, and of what acts along beams and plates, at one frequency."""

from __future__ import annotations

import numpy as np
from scipy.linalg import block_diag

from hydroelastic.fem.bodies.round_plate import plate_of
from hydroelastic.fem.open_water.beam_loads import BeamLoads
from hydroelastic.fem.open_water.bent_plates import omitted_deflections
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.functional_errors import dual_motions, functional_errors
from hydroelastic.fem.open_water.incident_waves import RIGHTWARD
from hydroelastic.fem.open_water.omitted_modes import omitted_deflection, truncation, weakened_attachments
from hydroelastic.fem.open_water.plate_load_errors import plate_load_errors
from hydroelastic.fem.tank.error_estimates import FrequencyErrors, boundary_error
from hydroelastic.fem.tank.resolution import rounding_error
from hydroelastic.modal.beam.beam_shapes import beam_shapes

# Points along a beam at which errors of loads are estimated, the ends included.
_SECTIONS = 7


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
    sizes = _sizes(solution, moved)
    dual = dual_motions(solution, moved)
    own = functional_errors(solution, dual)
    omitted = np.full(count, truncation(solution))
    omitted += (weakened_attachments(solution, dual) / sizes).max(axis=0, initial=0.0)
    leaving = incidence.amplitudes(incidence.pressures - solution.equations.radiated)
    waves = weakened_attachments(solution, dual_motions(solution, leaving))
    omitted += np.sqrt((incidence.powers[:, None] * waves**2).max(axis=0) / powers)
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
        rounding=np.full(count, _rounding(model)),
    )


def _sizes(solution: OpenResponse, moved: np.ndarray) -> np.ndarray:
    """The largest motion in each incident wave, or its elevation where that is larger, shape (incident,)."""
    elevations = 1.0 / np.abs(solution.per_elevation(RIGHTWARD))
    sizes: np.ndarray = np.maximum(np.abs(moved @ solution.motions.T).max(axis=0, initial=0.0), elevations)
    return sizes


def motion_errors(solution: OpenResponse, error: float) -> np.ndarray:
    """Return the errors of all motions per unit elevation by that relative to the largest, see `response_errors`, in SI
    units, shape (incident, motions)."""
    model = solution.model
    largest = _sizes(solution, _reported_motions(model)) * np.abs(solution.per_elevation(RIGHTWARD))
    return model.scale.amplitudes(error * np.outer(largest, np.ones(len(model.mass))), errors=True)


def unmeshed_error(model: OpenModel) -> float:
    """Return the part of the relative error by curved boundaries and by rounding."""
    return boundary_error(model.pencil.liquid.tank, model.basin.tank) + _rounding(model)


def _rounding(model: OpenModel) -> float:
    return 2.0 * rounding_error(model.resolution.degree, min(model.basin.tank.depth, 1.0))


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
