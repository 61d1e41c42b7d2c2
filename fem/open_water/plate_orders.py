"""How many azimuthal orders, and which mesh, the loads of round plates in irregular waves need.

Short waves bend a plate of radius a in all orders up to ka, and in higher ones hardly at all: orders are added until
those left out change the spectra of deflection, bending moment and shear force by a small part of the tolerance. Which
error the mesh leaves in loads is known from the first orders.
"""

from __future__ import annotations

import numpy as np

from hydroelastic.fem.bodies.round_plate import plate_of
from hydroelastic.fem.open_water.curves import Curves
from hydroelastic.fem.open_water.incident_waves import direction_of
from hydroelastic.fem.open_water.requests import SpectrumRequest
from hydroelastic.fem.open_water.results import Floats, RoundDeflection
from hydroelastic.fem.open_water.round_plates import bent_by, deflections_of_order, joined, left_out, radii_along
from hydroelastic.fem.open_water.spectrum_rows import meshed_load_errors
from hydroelastic.physics.irregular_waves import moments
from hydroelastic.physics.tank import Tank

# Points along a diameter.
_POSITIONS = 15


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
