"""The pressure of all waves on the wetted surface of a float."""

from __future__ import annotations

import numpy as np
from numpy.polynomial.legendre import leggauss, legvander

from hydroelastic.fem.facets import facet_groups
from hydroelastic.fem.liquid import as_functions
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.functional_errors import dual_motions, functional_errors
from hydroelastic.fem.open_water.incident_waves import RIGHTWARD
from hydroelastic.fem.open_water.results import HullPressure
from hydroelastic.fem.shape_loads import potential_basis
from hydroelastic.fem.tank.error_estimates import boundary_error
from hydroelastic.fem.tank.resolution import rounding_error

# Points of each facet at which pressures are told.
_ALONG = np.array([[0.0], [0.5]])


def hull_pressure(responses: list[OpenResponse], reduced: np.ndarray, index: int) -> HullPressure:
    """Return the pressure ρω²Ψ along the hull of a float from the left to the right (collective).

    Its error is the part of ψ in the highest polynomial on the worst facet, which that of the field is below where the
    degree is high enough; beside it that of the resultants of the pressure, over the surface on which they act, and
    the relative ones by the reduced basis, the shape of the hull and rounding. The waves far away have larger errors:
    in long waves a body follows the water, and hardly changes the pressure in it.

    Args:
        responses: to waves, of one model.
        reduced: their relative errors by the reduced basis, shape (n,).
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
    smooth = np.array([_of_resultants(one, index) for one in responses])
    relative = reduced + boundary_error(model.pencil.liquid.tank, model.basin.tank)
    relative += 2.0 * rounding_error(model.resolution.degree, min(model.basin.tank.depth, 1.0))
    return HullPressure(
        body=index,
        points=units.length * points[order] + np.array([model.basin.origin, 0.0]),
        pressure=np.asarray(weight * values),
        pressure_error=weight * (rough + smooth + relative[:, None] * np.abs(values).max(axis=2)),
    )


def _of_resultants(response: OpenResponse, index: int) -> np.ndarray:
    """Largest error of a resultant of the pressure on a float, per elevation and over ∫ρ|φᵢ|, shape (incident,).

    The resultants are the forces K − iωB − λM_b that the motions need, but for those of the incident wave.
    """
    model, first = response.model, sum(body.size for body in response.model.pencil.bodies[:index])
    surface = model.wetted[index]
    areas = surface.integrals(np.abs(surface.shapes), np.ones((1, len(surface.points))))[:, :1].real
    needed = (model.restoring(response.squared) - response.squared * model.mass)[first : first + len(areas)]
    away, tips = functional_errors(response, dual_motions(response, needed))
    found: np.ndarray = np.abs(response.per_elevation(RIGHTWARD)) * ((away + tips) / areas).max(axis=0, initial=0.0)
    return found


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
