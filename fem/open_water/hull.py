"""The field on the wetted surface of a float in waves: pressures, and the mean force by their integral.

With Ψ of all waves, the displacement X of the hull and the liquid's outward normal n, the mean force of second order is

    F = ∫ρ (½ω² Re X̄·∇Ψ − ¼ω² |∇Ψ|²) n ds + Σ ¼ρg |η − X_y|² n/|n_x| − ½ Re θ̄ (f_y, −f_x)

with the sum over both contact points, where the hull is vertical, and f = −ω²Ma + (K − iωB)u the force of the liquid on
the hull. It is an independent check of the force by the far field. The normal part of ∇Ψ is the displacement of the
hull, only the part along it comes from the elements.

Source: J. A. Pinkster and G. van Oortmerssen, 2nd Int. Conf. Num. Ship Hydrodyn. (1977) 136.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.facets import FacetGroup, facet_groups
from hydroelastic.fem.liquid import as_functions
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.outside import displacement_at
from hydroelastic.fem.shape_loads import facet_quadrature

# Distance of a point from a contact point, in lengths of the basin, below which they are one.
_SAME = 1e-9
# Points of each facet at which pressures are told.
_ALONG = np.array([[0.0], [0.5]])


@dataclass(frozen=True, kw_only=True)
class HullField:
    """A field on points of a hull, in units of the basin. Shapes: p points of this process.

    Attributes:
        points: shape (p, 2).
        normals: outward unit normals of the liquid, shape (p, 2).
        weights: of quadrature, times the density, shape (p,).
        potential: Ψ, shape (p,).
        gradient: ∇Ψ, shape (p, 2).
    """

    points: np.ndarray
    normals: np.ndarray
    weights: np.ndarray
    potential: np.ndarray
    gradient: np.ndarray


def hull_pressures(responses: list[OpenResponse], index: int) -> tuple[np.ndarray, np.ndarray]:
    """Return points along the hull of a float, m, shape (p, 2), from the left to the right, and the complex amplitudes
    of the pressure ρω²Ψ there, Pa per metre of elevation, shape (n, incident, p) (collective).

    Args:
        responses: to waves, of one model.
        index: of the float among the bodies.
    """
    model = responses[0].model
    units, comm = model.basin.units, model.pencil.comm
    found = [[_field(one, index, number, None) for number in range(len(one.incident))] for one in responses]
    gathered = comm.allgather(found[0][0].points)
    points = np.concatenate(gathered)
    hull = model.basin.tank.hulls[index]
    # Around the hull from its left contact point, below.
    order = np.argsort(np.arctan2(points[:, 1] - hull.height - 1e-12, points[:, 0] - hull.middle))
    values = []
    for one, fields in zip(responses, found, strict=True):
        own = []
        for place, field in zip(one.incident, fields, strict=True):
            phase = np.exp(1j * one.incidence.phases_at_origin(model.basin)[place])
            pressure = one.squared * field.potential / (one.incidence.elevations[place] * phase)
            own.append(np.concatenate(comm.allgather(pressure))[order])
        values.append(own)
    moved = units.length * points[order] + np.array([model.basin.origin, 0.0])
    return moved, units.density * units.gravity * np.array(values)


def near_field_drift(response: OpenResponse, index: int, incident: int = 0) -> float:
    """Return the mean force along x on a float by pressures on its hull, per |c|² of an incident wave, dimensionless
    (collective).

    Args:
        response: with a single float, in one liquid.
        index: of the float.
        incident: number of the incident wave in the response.
    """
    model, squared = response.model, response.squared.real
    omega = float(np.sqrt(squared))
    motions = response.motions[incident]
    field = _field(response, index, incident, model.shortest)
    moved = _displacements(response, index, incident, field.points)
    dynamic = 0.5 * squared * (moved.conj() * field.gradient).sum(axis=1).real
    kinetic = 0.25 * squared * (np.abs(field.gradient) ** 2).sum(axis=1)
    force = float(np.sum(field.weights * (dynamic - kinetic) * field.normals[:, 0]))
    ends = _field(response, index, incident, None, ends=True)
    piece, level = model.basin.tank.piece_of(index), model.basin.tank.level_of(index)
    for x in (piece.start, piece.end):
        here = np.flatnonzero(np.linalg.norm(ends.points - [x, level.height], axis=1) < _SAME)
        if len(here):
            up = _displacements(response, index, incident, ends.points[here[:1]])[0, 1]
            relative = squared * ends.potential[here[0]] - up
            force += 0.25 * abs(relative) ** 2 * float(np.sign(ends.normals[here[0], 0]))
    total = float(model.pencil.comm.allreduce(force, op=MPI.SUM))
    inertial = (
        -squared * (model.mass @ motions) + (model.outside.stiffness - 1j * omega * model.outside.damping) @ motions
    )
    (body,) = model.pencil.bodies
    forces = np.linalg.solve(body.motions.T, inertial)
    places = {str(dof.motion): place for place, dof in enumerate(model.scale.dofs)}
    if {"roll", "heave"} <= set(places):
        turned = (body.motions @ motions)[places["roll"]]
        total -= 0.5 * float((np.conj(turned) * forces[places["heave"]]).real)
    return total


def _displacements(response: OpenResponse, index: int, incident: int, points: np.ndarray) -> np.ndarray:
    """Complex displacements (to the right, upwards) of points of a float, shape (p, 2)."""
    model = response.model
    length, origin = model.basin.units.length, model.basin.origin
    first = sum(body.size for body in model.pencil.bodies[:index])
    body = model.pencil.bodies[index]
    own = response.motions[incident, first : first + body.size]
    found = []
    for x, y in points:
        up, right, _ = displacement_at(model.basin, body, index, (origin + length * x, length * y)) @ own
        found.append((right, up))
    return np.array(found, dtype=complex).reshape(len(points), 2)


def _field(
    response: OpenResponse, index: int, incident: int, wavenumber: float | None, *, ends: bool = False
) -> HullField:
    """The field of all waves on a hull: at quadrature points for waves of a wavenumber, or at points for tables."""
    model = response.model
    pencil, liquid = model.pencil, model.pencil.liquid
    body = pencil.bodies[index]
    first = sum(other.size for other in pencil.bodies[:index])
    motions = response.motions[incident, first : first + body.size]
    scattered = response.scattered[incident]
    real, imaginary = (
        function.x.array
        for function in as_functions(liquid, [pencil.vector(part) for part in (scattered.real, scattered.imag)])
    )
    potential = real + 1j * imaginary
    plane = response.incidence.planes[response.incident[incident]]
    parts: list[HullField] = []
    for group in facet_groups(liquid, body.surface):
        reference, weights = _points_of(group, model, body.wavenumber, wavenumber, ends=ends)
        points = group.physical_points(reference)
        normals = np.broadcast_to(group.normals(reference)[0], points.shape)
        dofs = liquid.space.dofmap.list[group.cells]
        table = liquid.space.element.basix_element.tabulate(1, reference)[..., 0]
        inverse = np.broadcast_to(np.linalg.inv(group.jacobians(reference)), (*points.shape[:2], 2, 2))
        local = potential[dofs]
        layers = np.broadcast_to(liquid.layer_of[dofs[:, :1]], points.shape[:2])
        density = np.array([layer.density for layer in liquid.layers])[layers]
        value, slope = plane.field(points, layers)
        gradient = np.einsum("fqdg,dqn,fn->fqg", inverse, table[1:], local, optimize=True) + slope
        flat, across = points.reshape(-1, 2), normals.reshape(-1, 2)
        shapes = np.array([body.shapes(flat.T, across.T, number) for number in range(body.size)])
        gradient = gradient.reshape(-1, 2)
        known = motions @ shapes - (gradient * across).sum(axis=1)
        parts.append(
            HullField(
                points=flat,
                normals=across,
                weights=(weights * density).ravel(),
                potential=(local @ table[0].T + value).ravel(),
                gradient=gradient + known[:, None] * across,
            )
        )
    return HullField(
        points=np.concatenate([np.zeros((0, 2)), *(part.points for part in parts)]),
        normals=np.concatenate([np.zeros((0, 2)), *(part.normals for part in parts)]),
        weights=np.concatenate([np.zeros(0), *(part.weights for part in parts)]),
        potential=np.concatenate([np.zeros(0, dtype=complex), *(part.potential for part in parts)]),
        gradient=np.concatenate([np.zeros((0, 2), dtype=complex), *(part.gradient for part in parts)]),
    )


def _points_of(
    group: FacetGroup, model: OpenModel, own: float, wavenumber: float | None, *, ends: bool
) -> tuple[np.ndarray, np.ndarray]:
    """Points of the reference cell, and weights on each facet, shape (facets, points)."""
    if wavenumber is not None:
        quadrature = facet_quadrature(model.pencil.liquid, group, own + 2.0 * wavenumber, -1)
        return quadrature.reference, quadrature.weights
    reference = group.reference_corners if ends else group.reference_points(_ALONG)
    return reference, np.zeros((len(group.cells), len(reference)))
