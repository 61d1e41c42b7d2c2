"""The pressure of all waves on the wetted surface of a float; about an axis of the waves of one order."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from mpi4py import MPI
from numpy.polynomial.legendre import leggauss, legvander
from scipy.spatial import cKDTree

from hydroelastic.fem.cells import nearest_in_cells
from hydroelastic.fem.facets import FacetGroup, facet_groups
from hydroelastic.fem.liquid import as_functions
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.functional_errors import dual_motions, functional_errors
from hydroelastic.fem.open_water.incident_waves import RIGHTWARD
from hydroelastic.fem.open_water.results import HullPressure
from hydroelastic.fem.shape_loads import potential_basis
from hydroelastic.fem.tank.error_estimates import boundary_error
from hydroelastic.fem.tank.resolution import rounding_error
from hydroelastic.physics.contours import points_along

# Points of a facet by which the cells nearest to a given point are chosen, and how many of them.
_NEAR, _CANDIDATES = np.linspace(0.0, 1.0, 9)[:, None], 3


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
    hull = model.basin.tank.hulls[index]
    arcs = (*hull.below, *hull.above)
    scaled = np.vstack([points_along(arcs), [arcs[-1].end]])
    points, places = units.length * scaled + origin, _nearest(model, index, scaled)
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


def _nearest(model: OpenModel, index: int, points: np.ndarray) -> _Places:
    """The nearest points of the cells beside a hull to given points, each on one process (collective)."""
    comm, mesh = model.pencil.comm, model.pencil.liquid.tank.mesh
    away, cells, reference = np.full(len(points), np.inf), np.zeros(len(points), dtype=int), np.zeros((len(points), 2))
    for group in _groups(model, index):
        near = group.physical_points(group.reference_points(_NEAR)).reshape(-1, 2)
        for candidates in cKDTree(near).query(points, min(_CANDIDATES, len(near)))[1].T:
            own = group.cells[candidates // len(_NEAR)]
            at, distance = nearest_in_cells(mesh, own, points)
            nearer = distance < away
            away[nearer], cells[nearer], reference[nearer] = distance[nearer], own[nearer], at[nearer]
    numbers = np.flatnonzero(np.argmin(comm.allgather(away), axis=0) == comm.rank)
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
