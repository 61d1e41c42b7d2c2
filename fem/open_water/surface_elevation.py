"""The elevation of the water at given places in waves, with those that fixed and moving bodies scatter and radiate.

At a distance r from the axis and an angle θ, with the potential Ψ of all waves and of each azimuthal order,

    η = λΨ        of a section,        η = e^{ikx} + Σₙ εₙ iⁿ λψₙ(r)/η̂ cos nθ        about an axis,

see `plan_waves`. ψ is taken from the polynomial on the facet of the free surface at the place; its error is the part in
the highest of the Legendre polynomials there, and the relative error of the amplitudes.
"""

from __future__ import annotations

import numpy as np
from numpy.polynomial.legendre import leggauss, legvander

from hydroelastic.fem.facets import facet_groups
from hydroelastic.fem.open_water.curves import Curves
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.frequency import OpenResponse
from hydroelastic.fem.open_water.incident_waves import direction_of, elevation
from hydroelastic.fem.open_water.requests import AirGapPoint, SpectrumRequest
from hydroelastic.fem.shape_loads import potential_basis
from hydroelastic.meshes.geometry import FREE_SURFACE
from hydroelastic.physics.tank import Tank


def reach_of(water: Tank, points: tuple[AirGapPoint, ...]) -> tuple[float, float] | None:
    """Return the smallest and the largest x, or radius, of places, m; ``None`` without any."""
    places = _places(water, points)
    return (float(places.min()), float(places.max())) if points else None


def _places(water: Tank, points: tuple[AirGapPoint, ...]) -> np.ndarray:
    x, across = np.array([[one.at[0], one.across] for one in points]).reshape(-1, 2).T
    return np.hypot(x, across) if water.geometry.is_revolved else x


def incident_elevations(curves: Curves, request: SpectrumRequest) -> tuple[np.ndarray, np.ndarray]:
    """Return the elevation of the incident wave at the points of air gaps, per unit of its own, and zeros, both of
    shape (n, points)."""
    basin, towards = curves.solver.model.basin, direction_of(request.waves_from)
    away = (np.array([one.at[0] for one in request.air_gaps]) - basin.phase_at) / basin.units.length
    waves = [one.incidence.planes[one.incident[0]].wave for one in curves.responses]
    # Of two liquids that at the top, per unit on the level on which the wave travels.
    heights = [wave.top_elevation / elevation(wave) if wave.layers.density_above else 1.0 for wave in waves]
    wavenumbers = np.array([wave.wavenumber for wave in waves])
    found = np.array(heights)[:, None] * np.exp(1j * towards * wavenumbers[:, None] * away)
    return found, np.zeros(found.shape)


def scattered_elevations(
    curves: Curves, motions: np.ndarray, request: SpectrumRequest, order: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return the elevation of the scattered and radiated waves of one order at the points of air gaps, per unit
    incident elevation, and its error, each of shape (n, points) (collective)."""
    towards = direction_of(request.waves_from)
    rows = surface_rows(curves.solver.model, request.air_gaps)
    found = np.array(
        [sampled_elevations(one, motion, rows, towards) for one, motion in zip(curves.responses, motions, strict=True)]
    )
    angles = np.array([np.arctan2(one.across, one.at[0]) for one in request.air_gaps])
    value, rough = np.split(found * np.tile(np.cos(order * angles), 2), 2, axis=1)
    return value, np.abs(rough) + curves.errors[:, None]


def sampled_elevations(response: OpenResponse, motions: np.ndarray, rows: np.ndarray, towards: int) -> np.ndarray:
    """Return λψ per unit incident elevation at places of the free surface, shape (places,) (collective)."""
    factor = response.per_elevation(towards)[0]
    psi = response.scattered_by(motions[None] / factor)
    found: np.ndarray = response.squared.real * factor * response.model.pencil.products(rows, psi)[:, 0]
    return found


def surface_rows(model: OpenModel, points: tuple[AirGapPoint, ...]) -> np.ndarray:
    """Return what ψ at places of the free surface takes of the own free unknowns, and below that its part in the
    highest polynomial on the facet, shape (2 × places, free unknowns) (collective)."""
    places = (_places(model.basin.tank, points) - model.basin.origin) / model.basin.units.length
    liquid, comm = model.pencil.liquid, model.pencil.comm
    rows = np.zeros((2, len(places), len(liquid.layer_of)))
    nodes, weights = leggauss(liquid.degree + 1)
    highest = (liquid.degree + 0.5) * weights * legvander(nodes, liquid.degree)[:, -1]
    groups = list(facet_groups(liquid, FREE_SURFACE))
    for place, x in enumerate(places):
        nearest: tuple[float, int, int] = (np.inf, -1, -1)
        for number, group in enumerate(groups):
            ends = np.sort(group.physical_points(group.reference_corners)[..., 0], axis=1)
            away = np.maximum(ends[:, 0] - x, x - ends[:, 1])
            nearest = min(nearest, (float(away.min()), number, int(away.argmin())))
        distances = comm.allgather(max(nearest[0], 0.0))
        if comm.rank != int(np.argmin(distances)):
            continue
        group = groups[nearest[1]]
        own = group.subset(np.arange(len(group.cells)) == nearest[2])
        start, end = own.physical_points(own.reference_corners)[0, :, 0]
        at = own.reference_points(np.array([[min(max((x - start) / (end - start), 0.0), 1.0)]]))
        dofs = liquid.space.dofmap.list[own.cells[0]]
        rows[0, place, dofs] = potential_basis(liquid, at)[0]
        rows[1, place, dofs] = highest @ potential_basis(liquid, own.reference_points(0.5 * (nodes[:, None] + 1.0)))
    found: np.ndarray = liquid.numbering.summed(rows.reshape(2 * len(places), rows.shape[-1]))[:, model.pencil.free]
    return found
