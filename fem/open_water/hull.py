"""The pressure of all waves on the wetted surface of a float; about an axis of the waves of one order."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from mpi4py import MPI
from numpy.polynomial.legendre import leggauss, legvander

from hydroelastic.fem.facets import FacetGroup, facet_groups
from hydroelastic.fem.liquid import as_functions
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.functional_errors import dual_motions, functional_errors
from hydroelastic.fem.open_water.incident_waves import RIGHTWARD
from hydroelastic.fem.open_water.results import Floats, HullPressure
from hydroelastic.fem.shape_loads import potential_basis
from hydroelastic.fem.tank.error_estimates import boundary_error
from hydroelastic.fem.tank.resolution import rounding_error

# Points of each facet at which pressures are told.
_ALONG = np.array([[0.0], [0.5]])
# Points of a facet from which the nearest one to a given point is sought, and steps of Newton's method.
_NEAR, _STEPS = np.linspace(0.0, 1.0, 9)[:, None], 8


@dataclass(frozen=True, kw_only=True)
class _Places:
    """Points of a hull on this process: their numbers among all, where they are, and their cells with points of the
    reference cell."""

    numbers: np.ndarray
    points: np.ndarray
    cells: np.ndarray
    reference: np.ndarray


def hull_pressure(
    responses: list[OpenResponse],
    reduced: np.ndarray,
    index: int,
    towards: int = RIGHTWARD,
    points: Floats | None = None,
) -> HullPressure:
    """Return the pressure ρω²Ψ along the hull of a float from the left to the right (collective).

    Its error is the part of ψ in the highest polynomial on the worst facet, which that of the field is below where the
    degree is high enough; beside it that of the resultants of the pressure, over the surface on which they act, and
    the relative ones by the reduced basis, the shape of the hull and rounding. The waves far away have larger errors:
    in long waves a body follows the water, and hardly changes the pressure in it.
    """
    model = responses[0].model
    units, comm = model.basin.units, model.pencil.comm
    weight, origin = units.density * units.gravity, np.array([model.basin.origin, 0.0])
    if points is None:
        scaled, places = _of_mesh(model, index)
        points = units.length * scaled + origin
    else:
        places = _nearest(model, index, (points - origin) / units.length)
    values = np.zeros((len(responses), len(responses[0].incident), len(points)), dtype=complex)
    rough = np.zeros(values.shape[:2])
    for row, response in enumerate(responses):
        for number in range(len(response.incident)):
            values[row, number, places.numbers], rough[row, number] = _pressures(
                response, index, number, towards, places
            )
    comm.Allreduce(MPI.IN_PLACE, values)
    comm.Allreduce(MPI.IN_PLACE, rough, op=MPI.MAX)
    smooth = np.array([_of_resultants(one, index, towards) for one in responses])
    relative = reduced + boundary_error(model.pencil.liquid.tank, model.basin.tank)
    relative += 2.0 * rounding_error(model.resolution.degree, min(model.basin.tank.depth, 1.0))
    return HullPressure(
        body=index,
        points=points,
        pressure=np.asarray(weight * values),
        pressure_error=weight * (rough + smooth + relative[:, None] * np.abs(values).max(axis=2)),
    )


def _of_resultants(response: OpenResponse, index: int, towards: int) -> np.ndarray:
    """Largest error of a resultant of the pressure on a float, per elevation and over ∫ρ|φᵢ|, shape (incident,).

    The resultants are the forces K − iωB − λM_b that the motions need, but for those of the incident wave.
    """
    model, first = response.model, sum(body.size for body in response.model.pencil.bodies[:index])
    surface = model.wetted[index]
    areas = surface.integrals(np.abs(surface.shapes), np.ones((1, len(surface.points))))[:, :1].real
    needed = (model.restoring(response.squared) - response.squared * model.mass)[first : first + len(areas)]
    away, tips = functional_errors(response, dual_motions(response, needed))
    found: np.ndarray = np.abs(response.per_elevation(towards)) * ((away + tips) / areas).max(axis=0, initial=0.0)
    return found


def _groups(model: OpenModel, index: int) -> Iterator[FacetGroup]:
    return facet_groups(model.pencil.liquid, model.pencil.bodies[index].surface)


def _of_mesh(model: OpenModel, index: int) -> tuple[np.ndarray, _Places]:
    """Points of all facets around the hull from its left contact point, below (collective)."""
    cells: list[np.ndarray] = [np.zeros(0, dtype=int)]
    reference, own = [np.zeros((0, 2))], [np.zeros((0, 2))]
    for group in _groups(model, index):
        at = group.reference_points(_ALONG)
        own.append(group.physical_points(at).reshape(-1, 2))
        cells.append(np.repeat(group.cells, len(at)))
        reference.append(np.tile(at, (len(group.cells), 1)))
    comm = model.pencil.comm
    gathered = comm.allgather(np.concatenate(own))
    points = np.concatenate(gathered)
    hull = model.basin.tank.hulls[index]
    order = np.argsort(np.arctan2(points[:, 1] - hull.height - 1e-12, points[:, 0] - hull.middle))
    first = sum(map(len, gathered[: comm.rank]))
    numbers = np.argsort(order)[first : first + len(gathered[comm.rank])]
    return points[order], _Places(
        numbers=numbers,
        points=gathered[comm.rank],
        cells=np.concatenate(cells),
        reference=np.concatenate(reference),
    )


def _nearest(model: OpenModel, index: int, points: np.ndarray) -> _Places:
    """The nearest points of the facets to given points, each on one process (collective)."""
    comm = model.pencil.comm
    away, cells, reference = np.full(len(points), np.inf), np.zeros(len(points), dtype=int), np.zeros((len(points), 2))
    for group in _groups(model, index):
        start, along = group.reference_corners[0], group.reference_corners[1] - group.reference_corners[0]
        near = group.physical_points(group.reference_points(_NEAR))
        for number, point in enumerate(points):
            facet, place = np.unravel_index(np.linalg.norm(near - point, axis=2).argmin(), near.shape[:2])
            own, t = group.subset(np.array([facet])), float(_NEAR[place, 0])
            for _ in range(_STEPS):
                at = (start + t * along)[None]
                tangent, apart = own.jacobians(at)[0, 0] @ along, own.physical_points(at)[0, 0] - point
                t = min(max(t - float(tangent @ apart / (tangent @ tangent)), 0.0), 1.0)
            at = (start + t * along)[None]
            distance = float(np.linalg.norm(own.physical_points(at)[0, 0] - point))
            if distance < away[number]:
                away[number], cells[number], reference[number] = distance, own.cells[0], at[0]
    ranks = np.argmin(comm.allgather(away), axis=0)
    numbers = np.flatnonzero(ranks == comm.rank)
    return _Places(numbers=numbers, points=points[numbers], cells=cells[numbers], reference=reference[numbers])


def _pressures(
    response: OpenResponse, index: int, incident: int, towards: int, places: _Places
) -> tuple[np.ndarray, float]:
    """The pressure per elevation at points of this process, and its part in the highest polynomial."""
    model = response.model
    pencil, liquid = model.pencil, model.pencil.liquid
    scattered = response.scattered[incident]
    real, imaginary = (
        function.x.array
        for function in as_functions(liquid, [pencil.vector(part) for part in (scattered.real, scattered.imag)])
    )
    plane = response.incidence.planes[response.incident[incident]]
    per_elevation = response.squared * response.per_elevation(towards)[incident]
    psi = per_elevation * (real + 1j * imaginary)
    # The densities of the model have the factor of the azimuthal order.
    densities = np.array([layer.density for layer in liquid.layers]) / model.basin.tank.geometry.measure
    nodes, weights = leggauss(liquid.degree + 1)
    highest = (liquid.degree + 0.5) * weights * legvander(nodes, liquid.degree)[:, -1]
    rough = 0.0
    for group in _groups(model, index):
        dofs = liquid.space.dofmap.list[group.cells]
        density = densities[liquid.layer_of[dofs[:, :1]]]
        along = density * (psi[dofs] @ potential_basis(liquid, group.reference_points(0.5 * (nodes[:, None] + 1.0))).T)
        rough = max(rough, float(np.abs(along @ highest).max(initial=0.0)))
    dofs = liquid.space.dofmap.list[places.cells]
    layers = liquid.layer_of[dofs[:, 0]]
    basis = potential_basis(liquid, places.reference).reshape(dofs.shape)
    incoming = per_elevation * plane.field(places.points, layers)[0]
    return densities[layers] * ((basis * psi[dofs]).sum(axis=1) + incoming), rough
