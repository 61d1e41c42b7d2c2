"""The pressure of all waves on the wetted surface of a float."""

from __future__ import annotations

import numpy as np
from numpy.polynomial.legendre import leggauss, legvander

from hydroelastic.fem.facets import facet_groups
from hydroelastic.fem.liquid import as_functions
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.incident_waves import RIGHTWARD
from hydroelastic.fem.open_water.results import HullPressure
from hydroelastic.fem.shape_loads import potential_basis

# Points of each facet at which pressures are told.
_ALONG = np.array([[0.0], [0.5]])


def hull_pressure(responses: list[OpenResponse], errors: np.ndarray, index: int) -> HullPressure:
    """Return the pressure ρω²Ψ along the hull of a float from the left to the right (collective).

    Its error is that of the amplitudes, and beside it the part of ψ in the highest polynomial on the worst facet, which
    the error of the field is below where the degree is high enough.

    Args:
        responses: to waves, of one model.
        errors: their relative errors, shape (n,).
        index: of the float among the bodies.
    """
    model = responses[0].model
    units, comm = model.basin.units, model.pencil.comm
    weight = units.density * units.gravity
    found = [[_pressures(one, index, number) for number in range(len(one.incident))] for one in responses]
    points = np.concatenate(comm.allgather(found[0][0][0]))
    hull = model.basin.tank.hulls[index]
    # Around the hull from its left contact point, below.
    order = np.argsort(np.arctan2(points[:, 1] - hull.height - 1e-12, points[:, 0] - hull.middle))
    values = np.array([[np.concatenate(comm.allgather(one[1]))[order] for one in row] for row in found], dtype=complex)
    rough = np.array([[max(comm.allgather(one[2])) for one in row] for row in found])
    return HullPressure(
        body=index,
        points=units.length * points[order] + np.array([model.basin.origin, 0.0]),
        pressure=np.asarray(weight * values),
        pressure_error=weight * (rough + errors[:, None] * np.abs(values).max(axis=2)),
    )


def _pressures(response: OpenResponse, index: int, incident: int) -> tuple[np.ndarray, np.ndarray, float]:
    """Points on a hull of this process, the pressure there per elevation, and its part in the highest polynomial."""
    model = response.model
    pencil, liquid = model.pencil, model.pencil.liquid
    scattered = response.scattered[incident]
    real, imaginary = (
        function.x.array
        for function in as_functions(liquid, [pencil.vector(part) for part in (scattered.real, scattered.imag)])
    )
    plane = response.incidence.planes[response.incident[incident]]
    per_elevation = response.squared * response.per_elevation(RIGHTWARD)[incident]
    nodes, weights = leggauss(liquid.degree + 1)
    highest = (liquid.degree + 0.5) * weights * legvander(nodes, liquid.degree)[:, -1]
    places, values, rough = [np.zeros((0, 2))], [np.zeros(0, dtype=complex)], 0.0
    for group in facet_groups(liquid, pencil.bodies[index].surface):
        dofs = liquid.space.dofmap.list[group.cells]
        local = per_elevation * (real + 1j * imaginary)[dofs]
        layers = liquid.layer_of[dofs[:, :1]]
        density = np.array([layer.density for layer in liquid.layers])[layers]
        reference = group.reference_points(_ALONG)
        points = group.physical_points(reference)
        incoming = per_elevation * plane.field(points, np.broadcast_to(layers, points.shape[:2]))[0]
        places.append(points.reshape(-1, 2))
        values.append((density * (local @ potential_basis(liquid, reference).T + incoming)).ravel())
        along = density * (local @ potential_basis(liquid, group.reference_points(0.5 * (nodes[:, None] + 1.0))).T)
        rough = max(rough, float(np.abs(along @ highest).max(initial=0.0)))
    return np.concatenate(places), np.concatenate(values), rough
