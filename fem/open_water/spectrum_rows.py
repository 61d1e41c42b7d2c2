"""The responses to irregular waves that are reported: motions of bodies and points, and the loads along beams."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import interp1d
from scipy.linalg import block_diag

from hydroelastic.fem.open_water.beam_loads import BeamLoads
from hydroelastic.fem.open_water.curves import Curves
from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.incident_waves import RIGHTWARD
from hydroelastic.fem.open_water.irregular_results import PlateStatistics
from hydroelastic.fem.open_water.outside import displacement_at
from hydroelastic.fem.open_water.requests import SpectrumRequest
from hydroelastic.fem.open_water.response import load_errors, plate_deflection
from hydroelastic.physics.dofs import Dof
from hydroelastic.physics.irregular_waves import statistics

CAUSES = ("sampling_error", "truncation_error", "transfer_error")
"""Of the error of statistics."""

_LOADS = ("deflection", "bending_moment", "shear_force")


@dataclass(frozen=True, kw_only=True)
class Row:
    """A response: its part of each body unknown, in SI units per unit elevation; times −ω² for an acceleration."""

    name: str
    unit: str
    direction: np.ndarray
    is_acceleration: bool = False


def order_of_motions(models: list[OpenModel]) -> tuple[list[int], tuple[Dof, ...]]:
    """Return the places of the motions of all orders, body by body, and these motions."""
    dofs = [dof for model in models for dof in model.scale.dofs]
    order = sorted(range(len(dofs)), key=lambda place: dofs[place].body or 1)
    return order, tuple(dofs[place] for place in order)


def response_rows(models: list[OpenModel], request: SpectrumRequest) -> list[Row]:
    """Motions of rigid bodies, motions and accelerations of points, and last what air gaps move towards the water."""
    elastic, length = models[0].basin.tank.elastic, models[0].basin.units.length
    motions = block_diag(*(model.scale.turn * model.scale.lengths[:, None] / length for model in models))
    order, dofs = order_of_motions(models)
    rows = [
        Row(name=dof, unit="rad" if dof.is_rotation else "m", direction=motions[place].astype(complex))
        for place, dof in zip(order, dofs, strict=True)
        if (dof.body or 1) - 1 not in elastic
    ]
    for number, (index, point) in enumerate(request.points, 1):
        moved = np.hstack([_moved(model, index, point) for model in models])
        rows.append(Row(name=f"point {number} up", unit="m", direction=moved[0]))
        if index not in elastic:
            rows.append(Row(name=f"point {number} sideways", unit="m", direction=moved[1]))
        rows.append(Row(name=f"point {number} acceleration up", unit="m/s²", direction=moved[0], is_acceleration=True))
    for number, gap in enumerate(request.air_gaps, 1):
        up = 0.0 * motions[:1] if gap.body is None else np.hstack([_moved(one, gap.body, gap.at)[:1] for one in models])
        # The elevation of the water is no motion of a body, and joins this part later.
        rows.append(Row(name=f"relative elevation {number}", unit="m", direction=-up[0]))
    return rows


def _moved(model: OpenModel, index: int, point: tuple[float, float]) -> np.ndarray:
    """Heave, sway and rotation of a point of a body by a unit of each body unknown, shape (3, unknowns)."""
    starts = np.cumsum([0, *(body.size for body in model.pencil.bodies)])
    moved = np.zeros((3, starts[-1]), dtype=complex)
    moved[:, starts[index] : starts[index + 1]] = displacement_at(model.basin, model.pencil.bodies[index], index, point)
    return moved


def motion_errors(models: list[OpenModel], errors: np.ndarray, motions: np.ndarray) -> np.ndarray:
    """Errors of the motions per elevation, shape (n, unknowns): relative to the largest of the same unit."""
    turns = np.array([dof.is_rotation for model in models for dof in model.scale.dofs])
    sizes = np.abs(motions)
    largest = np.stack([sizes[:, turns == turn].max(axis=1) for turn in turns], axis=1)
    deviation: np.ndarray = errors[:, None] * largest
    return deviation


def plate_statistics(
    request: SpectrumRequest, curves: Curves, places: list[int], motions: np.ndarray, drag: np.ndarray
) -> Iterator[PlateStatistics]:
    """Deflection, bending moment and shear force along each beam, with errors of the mesh estimated at some places."""
    model = curves.solver.model
    known = load_errors(model, [curves.responses[place] for place in places])
    for index, beam in model.basin.tank.beams.items():
        x: np.ndarray = np.linspace(0.0, beam.length, request.positions)
        along = BeamLoads(model, index, x)
        found = [
            along.of(one, motion[None] / one.per_elevation(RIGHTWARD)[0], drag[None])
            for one, motion in zip(curves.responses, motions, strict=True)
        ]
        logarithms = np.log(np.maximum(known[index], np.finfo(float).tiny))
        # As those of the motions, about a resonance they change by orders of magnitude.
        meshed = np.exp(interp1d(curves.omegas[places], logarithms, axis=0)(curves.omegas))
        plate = plate_deflection(model, index, x, curves.responses, found, curves.reduced, meshed)
        told, parts = {}, np.zeros((len(CAUSES), len(_LOADS)))
        for place, name in enumerate(_LOADS):
            transfer = getattr(plate, name)[:, 0]
            deviation = np.broadcast_to(getattr(plate, f"{name}_error"), transfer.shape)
            told[name] = statistics(request.spectrum, curves.omegas, transfer, deviation, request.duration)
            sizes = told[name].significant_amplitude
            for row, cause in enumerate(CAUSES):
                # √(m₀ + δm₀) − √m₀: where hardly anything acts, as at the ends, the error is larger than the value.
                grown = np.sqrt(1.0 + 2.0 * getattr(told[name], cause)) - 1.0
                parts[row, place] = (grown * sizes).max() / max(sizes.max(), np.finfo(float).tiny)
        largest = parts.max(axis=1).tolist()
        yield PlateStatistics(
            body=index,
            positions=plate.positions,
            significant_deflection=told["deflection"].significant_amplitude,
            significant_bending_moment=told["bending_moment"].significant_amplitude,
            largest_bending_moment=told["bending_moment"].largest_amplitude,
            significant_shear_force=told["shear_force"].significant_amplitude,
            largest_stress=np.multiply(6.0 / request.thickness**2, told["bending_moment"].largest_amplitude)
            if request.thickness
            else None,
            relative_errors=dict(zip(_LOADS, parts.sum(axis=0).tolist(), strict=True)),
            **dict(zip(CAUSES, largest, strict=True)),
        )
