"""Errors of motions in waves, of the waves that leave, and of what acts along beams and plates, at one frequency.

Errors of bending moments and shear forces of round plates in waves, by dual problems.

A load is a sum J = Σ bₖaₖ over the dry modes of the plate. Further ones than those of the model have the amplitudes
aₖ = fₖ/(Kₖ − λmₖ): with yₖ = bₖ/(Kₖ − λmₖ), J is a functional of the motions and of the scattered waves whose dual
solution has the amplitudes yₖ, and those of the modes of the model that follow, see `functional_errors`. Hardly any
waves radiate from further modes: their part of its potential is that of the highest frequency, and, as it ends close to
the plate, |A_λ(ψ_y − ψ_yh, ψ − ψ_h)| is bounded cell by cell. What the waves radiated by these modes change J by is
λΣ aₖ times the pressure of the dual solution on mode k. What the upper half of the polynomials of the modes adds to J,
the difference of two truncations, is the error of their number. No factor is fitted.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import block_diag

from hydroelastic.fem.bodies.round_plate import plate_of
from hydroelastic.fem.open_water.beam_loads import BeamLoads
from hydroelastic.fem.open_water.bent_plates import bent_without_drag, omitted_deflections
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.functional_errors import dual_motions, functional_errors
from hydroelastic.fem.open_water.incident_waves import RIGHTWARD
from hydroelastic.fem.open_water.omitted_modes import omitted_deflection, truncation, weakened_attachments
from hydroelastic.fem.open_water.round_plates import bent_by
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


def plate_load_errors(model: OpenModel, index: int, solutions: list[OpenResponse]) -> np.ndarray:
    """Return errors of moment and shear force over the rigidity anywhere on a round plate (collective)."""
    modes, plate = model.plate_modes[index], plate_of(model.basin.tank.bodies[index])
    if not (plate.bends and plate.flexural_rigidity):
        return np.zeros((len(solutions), 2, len(solutions[0].incident)))
    radii: np.ndarray = np.linspace(plate.inner_radius, plate.radius, _SECTIONS)
    order = np.array([model.basin.tank.geometry.order])
    weights, last = (
        bent_by(plate, radii, values[..., None, :], order)[..., 0, :].swapaxes(1, 2).reshape(2 * _SECTIONS, -1)
        for values in modes.shapes.bent(radii)
    )
    highest = max(one.squared.real for one in solutions)
    solver = model.pencil.solver()
    solver.shift(highest)
    loads = (weights / modes.restoring(highest))[:, modes.count :] @ modes.loads[modes.count :]
    further = np.array([solver.solve(load) for load in loads])
    missed = np.sqrt(model.cells_missed(further))
    errors = np.array(
        [
            _meshed(model, index, one, weights, further, missed) + np.abs(last @ bent_without_drag(modes, one).T)
            for one in solutions
        ]
    )
    largest: np.ndarray = errors.reshape(len(solutions), 2, _SECTIONS, -1).max(axis=2)
    return largest


def _meshed(
    model: OpenModel,
    index: int,
    response: OpenResponse,
    weights: np.ndarray,
    further: np.ndarray,
    missed: np.ndarray,
) -> np.ndarray:
    """Errors by the mesh and by waves that further modes radiate, shape (loads, incident)."""
    modes, squared, products = model.plate_modes[index], response.squared.real, model.pencil.products
    further_modes = slice(modes.count, None)
    of_motions = -(weights / modes.restoring(squared))[:, further_modes] @ modes.held(squared)[:, further_modes].T
    of_motions[:, modes.own] += weights[:, : modes.count]
    dual = dual_motions(response, of_motions)
    loaded = response.radiated_by(dual) + further
    radiated = products(loaded, modes.loads[further_modes]) @ bent_without_drag(modes, response)[:, further_modes].T
    by_cells = products(missed, np.sqrt(response.missed))
    found: np.ndarray = sum(functional_errors(response, dual)) + squared * (np.abs(radiated) + by_cells)
    return found
