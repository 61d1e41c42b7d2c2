"""Errors of bending moments and shear forces of round plates in waves, by dual problems.

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

from hydroelastic.fem.bodies.round_plate import plate_of
from hydroelastic.fem.open_water.bent_plates import bent_without_drag
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.functional_errors import dual_motions, functional_errors
from hydroelastic.fem.open_water.round_plates import bent_by

# Radii at which they are estimated, both edges or the axis included.
_SECTIONS = 7


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
