"""How many azimuthal orders the loads of round plates in irregular waves need.

Short waves bend a plate of radius a in all orders up to ka, and in higher ones hardly at all: orders are added until
those left out change the spectra of deflection, bending moment and shear force by a small part of the tolerance.
"""

from __future__ import annotations

import numpy as np

from hydroelastic.fem.bodies.round_plate import plate_of
from hydroelastic.fem.open_water.curves import Curves
from hydroelastic.fem.open_water.incident_waves import direction_of
from hydroelastic.fem.open_water.requests import SpectrumRequest
from hydroelastic.fem.open_water.results import Floats, RoundDeflection
from hydroelastic.fem.open_water.round_plates import bent_by, deflections_of_order, joined, left_out, radii_along
from hydroelastic.physics.irregular_waves import moments
from hydroelastic.physics.tank import Tank

# Points along a diameter.
_POSITIONS = 15


def bent_in_order(tank: Tank, request: SpectrumRequest, curves: Curves, omegas: Floats) -> list[RoundDeflection]:
    """Return the deflection of each round plate in an order at some of its frequencies, without drag (collective).

    Args:
        tank: the sea in SI units.
        request: the request.
        curves: of the order.
        omegas: among their frequencies.
    """
    model = curves.solver.model
    responses = [curves.responses[place] for place in np.searchsorted(curves.omegas, omegas)]
    moved = [(one.motions, np.zeros((len(one.motions), len(model.outside.drag)))) for one in responses]
    return list(
        deflections_of_order(
            model,
            responses,
            moved,
            direction_of(request.waves_from),
            np.zeros(len(omegas)),
            {},
            lambda index: radii_along(tank, index, _POSITIONS),
        )
    )


def orders_left_out(tank: Tank, request: SpectrumRequest, omegas: Floats, bent: list[list[RoundDeflection]]) -> float:
    """Return what the orders left out change deflections and loads by, relative to the largest of each.

    Args:
        tank: the sea in SI units.
        request: the request.
        omegas: rad/s, shape (n,).
        bent: `bent_in_order` of the orders 0, 1 …

    Returns:
        The largest of all plates, as a part of significant amplitudes.
    """
    orders, largest = np.arange(len(bent)), [0.0]
    for parts in zip(*bent, strict=True):
        found = joined(list(parts))
        plate = plate_of(tank.bodies[found.body])
        loads = bent_by(plate, found.radii, found.derivatives, orders) if plate.flexural_rigidity else []
        for values in (found.derivatives[0], *loads):
            sizes, missing = (
                np.sqrt(moments(request.spectrum, omegas, transfer, (0,))[0].max())
                for transfer in (values.sum(axis=-2)[:, 0], left_out(values))
            )
            largest.append(float(missing / max(sizes, np.finfo(float).tiny)))
    return max(largest)
