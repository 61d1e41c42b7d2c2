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
from hydroelastic.fem.open_water.incident_waves import direction_of
from hydroelastic.fem.open_water.irregular_results import PlateStatistics
from hydroelastic.fem.open_water.outside import displacement_at
from hydroelastic.fem.open_water.radiation import estimated_places
from hydroelastic.fem.open_water.requests import SpectrumRequest
from hydroelastic.fem.open_water.response_errors import load_errors
from hydroelastic.fem.open_water.response_table import plate_deflection
from hydroelastic.fem.open_water.results import Floats, PlateDeflection
from hydroelastic.fem.open_water.round_plates import along_diameter, deflections_of_order, joined, radii_along
from hydroelastic.physics.dofs import Dof
from hydroelastic.physics.irregular_waves import statistics
from hydroelastic.physics.round_plates import RoundPlate
from hydroelastic.physics.tank import Tank

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
    """Motions of rigid bodies and round plates, motions and accelerations of points of other bodies, and last what air
    gaps move towards the water, but for those that move with round plates."""
    tank, length = models[0].basin.tank, models[0].basin.units.length
    motions = block_diag(*(model.scale.turn * model.scale.lengths[:, None] / length for model in models))
    order, dofs = order_of_motions(models)
    rows = [
        Row(name=dof, unit="rad" if dof.is_rotation else "m", direction=motions[place].astype(complex))
        for place, dof in zip(order, dofs, strict=True)
        if not dof.is_elastic and (dof.body or 1) - 1 not in tank.beams
    ]
    for number, (index, point) in enumerate(request.points, 1):
        if index in models[0].plate_modes:
            continue
        moved = np.hstack([_moved(model, index, point) for model in models])
        rows.append(Row(name=f"point {number} up", unit="m", direction=moved[0]))
        if index not in tank.elastic:
            rows.append(Row(name=f"point {number} sideways", unit="m", direction=moved[1]))
        rows.append(Row(name=f"point {number} acceleration up", unit="m/s²", direction=moved[0], is_acceleration=True))
    for number, gap in enumerate(request.air_gaps, 1):
        up = np.zeros(motions.shape[1], dtype=complex)
        if gap.body is not None and gap.body not in models[0].plate_modes:
            up = np.hstack([_moved(model, gap.body, gap.at)[0] for model in models])
        # The elevation of the water is no motion of a body, and joins this part later.
        rows.append(Row(name=f"relative elevation {number}", unit="m", direction=-up))
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


def estimated_about_peaks(curves: Curves) -> list[int]:
    """Return indices of frequencies whose errors are estimated: a few of all, and the tops and sides of peaks."""
    sizes = np.abs(curves.motions)
    found = set(estimated_places(curves.omegas))
    for size in sizes.T:
        top = int(size.argmax())
        low = np.flatnonzero(size < 0.5 * size[top])
        sides = [top, *low[low < top][-1:], *low[low > top][:1]]
        found.update(int(place) for place in sides)
    return sorted(found)


def along_plates(
    tank: Tank, request: SpectrumRequest, curves: list[Curves], motions: np.ndarray, drag: np.ndarray
) -> Iterator[PlateDeflection]:
    """Yield what acts along each beam, and along the diameter of each round plate, its points among the positions."""

    def radii(index: int) -> Floats:
        points = [
            abs(at[0])
            for body, at in (*request.points, *((gap.body, gap.at) for gap in request.air_gaps))
            if body == index
        ]
        return np.union1d(radii_along(tank, index, request.positions), points)

    towards, parts = direction_of(request.waves_from), []
    starts = np.cumsum([len(one.solver.model.mass) for one in curves])[:-1]
    for one, part in zip(curves, np.split(motions, starts, axis=1), strict=True):
        moved = [
            (motion[None] / response.per_elevation(towards)[0], drag[None])
            for response, motion in zip(one.responses, part, strict=True)
        ]
        model, meshed = one.solver.model, meshed_load_errors(one)
        for index, beam in model.basin.tank.beams.items():
            x: np.ndarray = np.linspace(0.0, beam.length, request.positions)
            along = BeamLoads(model, index, x)
            found = [along.of(response, *own) for response, own in zip(one.responses, moved, strict=True)]
            yield plate_deflection(model, index, x, one.responses, found, one.reduced, meshed[index])
        parts.append(deflections_of_order(model, one.responses, moved, towards, one.reduced, meshed, radii))
    errors = np.max([one.errors for one in curves], axis=0)
    for plates in zip(*parts, strict=True):
        yield along_diameter(tank, joined(list(plates)), errors)


def meshed_load_errors(curves: Curves) -> dict[int, np.ndarray]:
    """Return `load_errors` at all frequencies, shape (n, …) (collective)."""
    places = estimated_about_peaks(curves)
    known = load_errors(curves.solver.model, [curves.responses[place] for place in places])
    # As errors of the motions, about a resonance they change by orders of magnitude.
    return {
        index: np.exp(
            interp1d(curves.omegas[places], np.log(np.maximum(values, np.finfo(float).tiny)), axis=0)(curves.omegas)
        )
        for index, values in known.items()
    }


def points_of_plates(
    tank: Tank, request: SpectrumRequest, omegas: Floats, plates: list[PlateDeflection]
) -> Iterator[tuple[str, str, np.ndarray, np.ndarray]]:
    """Yield name, unit, transfer function and its error, shape (n,), of deflection, moment and strain at points of
    round plates; at their edges no moment."""
    along = {plate.body: plate for plate in plates}
    for number, (index, point) in enumerate(request.points, 1):
        body = tank.bodies[index]
        if not isinstance(body, RoundPlate):
            continue
        plate, place = along[index], _place(along[index], point)
        deflection, error = plate.deflection[:, 0, place], plate.deflection_error[:, 0]
        yield f"point {number} up", "m", deflection, error
        yield f"point {number} acceleration up", "m/s²", -(omegas**2) * deflection, omegas**2 * error
        if body.bends and body.flexural_rigidity:
            moment_error = plate.bending_moment_error[:, 0]
            # At a free edge there is none, of which all is error.
            if not np.isclose(abs(point[0]), [edge for edge in (body.inner_radius, body.radius) if edge]).any():
                yield f"point {number} bending moment", "N", plate.bending_moment[:, 0, place], moment_error
            if plate.strain is not None and body.thickness is not None:
                strained = 0.5 * body.thickness / body.flexural_rigidity
                yield f"point {number} strain", "1", plate.strain[:, 0, place], strained * moment_error


def air_gaps_of_plates(
    tank: Tank, request: SpectrumRequest, plates: list[PlateDeflection]
) -> tuple[np.ndarray, np.ndarray]:
    """Return what points of air gaps that move with round plates move towards the water per unit incident elevation,
    and its error, each of shape (n, points)."""
    along = {plate.body: plate for plate in plates if isinstance(tank.bodies[plate.body], RoundPlate)}
    still = np.zeros(len(plates[0].deflection)) if plates else 0.0
    moved = [
        (-plate.deflection[:, 0, _place(plate, gap.at)], plate.deflection_error[:, 0])
        if (plate := along.get(-1 if gap.body is None else gap.body))
        else (still, still)
        for gap in request.air_gaps
    ]
    towards, errors = (np.stack(parts, axis=-1) for parts in zip(*moved, strict=True))
    return towards, errors


def _place(plate: PlateDeflection, point: tuple[float, float]) -> int:
    return int(np.argmin(np.abs(plate.positions - point[0])))


def statistics_along(
    request: SpectrumRequest, omegas: Floats, plate: PlateDeflection, thickness: float | None
) -> PlateStatistics:
    """Return the statistics of deflection, bending moment and shear force along a beam or a diameter."""
    told, parts = {}, np.zeros((len(CAUSES), len(_LOADS)))
    for place, name in enumerate(_LOADS):
        transfer = getattr(plate, name)[:, 0]
        deviation = np.broadcast_to(getattr(plate, f"{name}_error"), transfer.shape)
        told[name] = statistics(request.spectrum, omegas, transfer, deviation, request.duration)
        sizes = told[name].significant_amplitude
        for row, cause in enumerate(CAUSES):
            # √(m₀ + δm₀) − √m₀: where hardly anything acts, as at the ends, the error is larger than the value.
            grown = np.sqrt(1.0 + 2.0 * getattr(told[name], cause)) - 1.0
            parts[row, place] = (grown * sizes).max() / max(sizes.max(), np.finfo(float).tiny)
    largest = parts.max(axis=1).tolist()
    return PlateStatistics(
        body=plate.body,
        positions=plate.positions,
        significant_deflection=told["deflection"].significant_amplitude,
        significant_bending_moment=told["bending_moment"].significant_amplitude,
        largest_bending_moment=told["bending_moment"].largest_amplitude,
        significant_shear_force=told["shear_force"].significant_amplitude,
        largest_stress=None
        if thickness is None
        else np.multiply(6.0 / thickness**2, told["bending_moment"].largest_amplitude),
        relative_errors=dict(zip(_LOADS, parts.sum(axis=0).tolist(), strict=True)),
        **dict(zip(CAUSES, largest, strict=True)),
    )
