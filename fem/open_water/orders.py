"""Solids of revolution, order by order: one problem of the half-plane for each azimuthal order, joined afterwards.

Heave is of order 0, surge and pitch are of order 1; higher orders scatter waves without a force on the bodies.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from math import inf
from typing import TypeVar

import numpy as np

from hydroelastic.fem.bodies.round_plate import lowest_elastic
from hydroelastic.fem.open_water.basin import open_basin
from hydroelastic.fem.open_water.decay import DecaySolution, solve_decay
from hydroelastic.fem.open_water.drift_of_orders import drift_of_orders, drift_widths
from hydroelastic.fem.open_water.incident_waves import direction_of
from hydroelastic.fem.open_water.motion import MotionSolution, solve_motion
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.radiation import RadiationSolution, solve_radiation
from hydroelastic.fem.open_water.radiation_memory import ImpulseResponseSolution, Memory, solve_impulse_response
from hydroelastic.fem.open_water.region import Region
from hydroelastic.fem.open_water.requests import (
    DecayRequest,
    ImpulseResponseRequest,
    MotionRequest,
    RadiationRequest,
    Request,
    ResonanceRequest,
    ResponseRequest,
)
from hydroelastic.fem.open_water.resonance import ABOVE, ResonanceSolution, expected_frequencies, solve_resonance
from hydroelastic.fem.open_water.response import ResponseSolution, drawn, drawn_tolerance, solve_response
from hydroelastic.fem.open_water.results import HullPressure, Largest, RadiationTable, ResonanceTable, ResponseTable
from hydroelastic.fem.open_water.round_plates import OF_LOADS, along_diameter, joined, left_out, with_largest
from hydroelastic.fem.time_domain.results import ImpulseResponseTable, MotionTable
from hydroelastic.physics.dofs import Dof, dof_names
from hydroelastic.physics.round_plates import LOWEST_BENT, RoundPlate

Solution = TypeVar(
    "Solution",
    RadiationSolution,
    ResponseSolution,
    ResonanceSolution,
    DecaySolution,
    ImpulseResponseSolution,
    MotionSolution,
)


def solve_by_order(
    problem: OpenWaterProblem, request: Request, memory: Memory
) -> (
    RadiationSolution | ResponseSolution | ResonanceSolution | DecaySolution | ImpulseResponseSolution | MotionSolution
):
    """Solve an analysis for the orders that it needs, and join them (collective)."""
    match request:
        case RadiationRequest():
            return _solve_radiation(problem, request)
        case ResponseRequest():
            return _solve_response(problem, request)
        case DecayRequest():
            return _solve_decay(problem, request)
        case ResonanceRequest():
            return _solve_resonance(problem, request)
        case ImpulseResponseRequest():
            return _solve_impulse_response(problem, request, memory)
        case MotionRequest():
            return _solve_motion(problem, request, memory)
        case _:
            raise TypeError(f"{request.kind} is not solved for solids of revolution")


def _solve_radiation(problem: OpenWaterProblem, request: RadiationRequest) -> RadiationSolution:
    """Solve for the motions of each order (collective); see `solve_radiation`."""
    found = [solve_radiation(problem.of_order(order), request) for order in _orders(problem, request.elastic_modes)]
    return replace(_largest(found), table=_radiation(problem, [one.table for one in found]), error=_error(found))


def _orders(problem: OpenWaterProblem, elastic_modes: int) -> list[int]:
    """Orders of the rigid motions and of the lowest elastic shapes."""
    orders = {*problem.tank.orders}
    for body in problem.tank.bodies:
        if isinstance(body, RoundPlate):
            orders |= {*range(len(lowest_elastic(body, elastic_modes)))}
    return sorted(orders)


def _radiation(problem: OpenWaterProblem, tables: list[RadiationTable]) -> RadiationTable:
    dofs = _dofs(problem, *tables)
    first = tables[0]

    def matrices(name: str) -> np.ndarray:
        return _matrices(dofs, [(table.dofs, getattr(table, name)) for table in tables])

    def forces(name: str) -> np.ndarray:
        return _by_dof(dofs, [(table.dofs, getattr(table, name)) for table in tables])

    def largest(name: str) -> np.ndarray:
        return np.max([getattr(table, name) for table in tables], axis=0)

    return replace(
        first,
        dofs=dofs,
        added_mass=matrices("added_mass"),
        radiation_damping=matrices("radiation_damping"),
        radiation_damping_error=matrices("radiation_damping_error"),
        excitation_force=forces("excitation_force"),
        excitation_force_error=forces("excitation_force_error"),
        froude_krylov_force=forces("froude_krylov_force"),
        diffraction_force=forces("diffraction_force"),
        relative_error=largest("relative_error"),
        energy_residual=largest("energy_residual"),
        haskind_residual=largest("haskind_residual"),
        inertia=matrices("inertia"),
        stiffness=matrices("stiffness"),
        infinite_frequency_added_mass=(
            None if first.infinite_frequency_added_mass is None else matrices("infinite_frequency_added_mass")
        ),
        factorizations=sum(table.factorizations for table in tables),
    )


def _solve_response(problem: OpenWaterProblem, request: ResponseRequest) -> ResponseSolution:
    """Solve for the motions of each order, and for the waves that are scattered in higher orders (collective).

    Orders are added until the scattered waves of one, and the deflections of plates, are below the tolerance at all
    frequencies.
    """
    found: list[ResponseSolution] = []
    # Long waves scatter as much in the first order as in order 0, in which a body that follows them scatters none.
    last = max(1, *problem.tank.orders)
    while not found or len(found) <= last or _matters(problem, found[-1].table):
        own = problem.of_order(len(found))
        # No other analysis asks for the orders in which nothing moves: their solvers need not be kept.
        found.append(solve_response(own if len(found) <= last else replace(own, solvers={}), request))
    table = replace(_response(problem, found), curve=_curve(problem, request, found))
    return replace(_largest(found), table=table, error=_error(found))


def _curve(problem: OpenWaterProblem, request: ResponseRequest, found: list[ResponseSolution]) -> ResponseTable | None:
    """Join the curves of the orders at the frequencies of all of them (collective)."""
    curves = [one.curves for one in found if one.curves is not None]
    if not curves:
        return None
    omegas = np.unique(np.concatenate([one.omegas for one in curves]))
    tables = [drawn(request, one.at(omegas, drawn_tolerance(problem))) for one in curves]
    return _motions_and_waves(problem, tables)


def _matters(problem: OpenWaterProblem, table: ResponseTable) -> bool:
    """Whether an order scatters waves, bends a plate or presses on a hull by more than the tolerance."""
    assert table.partial_waves is not None
    weight = problem.tank.layers[0].density * problem.tank.gravity
    found = (
        table.partial_waves,
        *(plate.derivatives[0] / OF_LOADS for plate in table.round_plates),
        *(hull.pressure / weight for hull in table.hulls),
    )
    return max(float(np.abs(values).max()) for values in found) > problem.tolerance


def _motions_and_waves(problem: OpenWaterProblem, tables: list[ResponseTable]) -> ResponseTable:
    dofs = _dofs(problem, *tables)
    waves = [table.partial_waves for table in tables if table.partial_waves is not None]
    absorption = [table.absorption * (1.0 if order == 0 else 2.0) for order, table in enumerate(tables)]
    return replace(
        tables[0],
        dofs=dofs,
        amplitudes=_by_dof(dofs, [(table.dofs, table.amplitudes) for table in tables]),
        amplitude_error=_by_dof(dofs, [(table.dofs, table.amplitude_error) for table in tables]),
        partial_waves=np.concatenate(waves, axis=-1),
        absorption=np.sum(absorption, axis=0),
        energy_residual=np.max([np.abs(table.energy_residual) for table in tables], axis=0),
        relative_error=np.max([table.relative_error for table in tables], axis=0),
    )


def _response(problem: OpenWaterProblem, found: list[ResponseSolution]) -> ResponseTable:
    tables = [one.table for one in found]
    whole = _motions_and_waves(problem, tables)
    assert whole.partial_waves is not None
    plates = tuple(joined(list(parts)) for parts in zip(*(table.round_plates for table in tables), strict=True))
    # Errors of the orders add up in the deflection.
    added = np.sum([table.relative_error for table in tables], axis=0)
    if len(whole.waves) > 1:
        drift, drift_error = np.full((2, len(whole.omega)), np.nan)
    else:
        widths, waves = drift_widths(problem.tank, whole.omega)[1], whole.partial_waves[:, 0, 0]
        drift, drift_error = drift_of_orders(
            widths,
            waves,
            np.stack([one.wave_errors for one in found], axis=1),
            np.array([table.energy_residual[:, 0] for table in tables]).T,
        )
        drift = direction_of(whole.waves_from) * drift.sum(axis=1)
        # The pair of the last order and the next, which scatters far less, is −|aₙ|².
        drift_error += widths * np.abs(waves[:, -1]) ** 2
    parts = [(table.dofs, table.largest) for table in tables if table.largest is not None]

    def largest(name: str) -> np.ndarray:
        return _by_dof(whole.dofs, [(dofs, getattr(part, name)) for dofs, part in parts])

    return replace(
        whole,
        largest=Largest(value=largest("value"), omega=largest("omega"), error=largest("error")),
        drift_force=drift[:, None],
        drift_error=drift_error[:, None],
        missed_peaks=tuple(peak for table in tables for peak in table.missed_peaks),
        plates=tuple(with_largest(problem.tank, along_diameter(problem.tank, plate, added), plate) for plate in plates),
        round_plates=plates,
        hulls=tuple(_around(list(parts)) for parts in zip(*(table.hulls for table in tables), strict=True)),
    )


def _around(parts: list[HullPressure]) -> HullPressure:
    """Return the pressures of the orders 0, 1 … on a solid, along its section from θ = π to θ = 0."""
    orders = np.stack([part.pressure for part in parts], axis=2)
    signs = (-1.0) ** np.arange(len(parts))[:, None]
    points = parts[0].points
    sides = (signs * orders)[..., ::-1].sum(axis=2), orders.sum(axis=2)
    return HullPressure(
        body=parts[0].body,
        points=np.concatenate([points[::-1] * [-1.0, 1.0], points]),
        pressure=np.concatenate(sides, axis=-1),
        pressure_error=np.sum([part.pressure_error for part in parts], axis=0) + left_out(orders),
        partial_pressures=orders,
    )


def _solve_resonance(problem: OpenWaterProblem, request: ResonanceRequest) -> ResonanceSolution:
    """Find the resonances of each order, and keep those of smallest |ω| (collective); see `solve_resonance`."""
    orders: Iterable[int] = problem.tank.orders
    beyond: float | None = None
    if any(body.flexural_sections for body in problem.tank.bodies):
        orders, highest, beyond = _bending_orders(problem, request)
        request = replace(request, below=highest)
    found = [solve_resonance(problem.of_order(order), request) for order in orders]
    tables = [one.table for one in found]
    dofs = _dofs(problem, *tables)
    omega = np.concatenate([table.omega for table in tables])
    chosen = np.argsort(np.abs(omega), kind="stable")[: request.count]
    motions = [_by_dof(dofs, [(table.dofs, table.body_amplitudes)]) for table in tables]
    counts = [table.counted for table in tables]
    labels = [label for table in tables for label in table.labels]
    table = ResonanceTable(
        omega=omega[chosen],
        dofs=dofs,
        labels=tuple(labels[place] for place in chosen),
        body_amplitudes=np.concatenate(motions)[chosen],
        residuals=np.concatenate([one.residuals for one in tables])[chosen],
        relative_error=np.concatenate([one.relative_error for one in tables])[chosen],
        counted=None if None in counts else sum(count for count in counts if count is not None),
        region=_joined_region([one.region for one in tables if one.region is not None]),
        not_sought=beyond,
    )
    return ResonanceSolution(
        table=table,
        model=_largest(found).model,
        error=_error(found),
        known=sum(one.known for one in found),
        unstable=any(one.unstable for one in found),
    )


def _bending_orders(problem: OpenWaterProblem, request: ResonanceRequest) -> tuple[list[int], float, float | None]:
    """Return the orders of the lowest expected resonances, the frequency up to which these lie, and that of the lowest
    that is not sought, see `expected_frequencies`, rad/s (collective).

    Plates bend in all orders; from the second one on the lowest frequency rises with the order.
    """
    lowest: list[float] = []
    known: list[float] = []
    beyond: float | None = None
    while True:
        expected, out = expected_frequencies(problem.of_order(len(lowest)), request)
        lowest.append(expected[0] if expected else inf)
        known = sorted([*known, *expected])[: request.count]
        if out is not None:
            beyond = min(out, beyond or inf)
        highest = ABOVE * known[-1] if request.below is None else request.below
        complete = request.below or len(known) == request.count or lowest[-1] == inf
        if len(lowest) > LOWEST_BENT and lowest[-1] > highest and complete:
            enough = len(known) == request.count and (beyond or inf) > known[-1]
            return [order for order, omega in enumerate(lowest) if omega < highest], highest, None if enough else beyond


def _joined_region(regions: list[Region]) -> Region | None:
    if not regions:
        return None
    lowest, highest = min(one.lowest for one in regions), max(one.highest for one in regions)
    return Region(lowest=lowest, highest=highest, damping=max(one.damping for one in regions))


def _solve_decay(problem: OpenWaterProblem, request: DecayRequest) -> DecaySolution:
    """Solve for the motions of the orders that are released (collective); see `solve_decay`."""
    given = {0: request.heave, 1: request.roll}
    orders = [order for order in problem.tank.orders if given.get(order)]
    found = [solve_decay(problem.of_order(order), request) for order in orders]
    dofs = _dofs(problem)
    tables = [one.table for one in found]
    table = replace(
        tables[0],
        dofs=dofs,
        displacement=_by_dof(dofs, [(one.dofs, one.displacement) for one in tables]),
        initial=_by_dof(dofs, [(one.dofs, one.initial) for one in tables]),
        absolute_error=np.max([one.absolute_error for one in tables], axis=0),
        tail=tables[0].tail if len(tables) == 1 else None,
        certified_until=min(one.certified_until for one in tables),
    )
    return replace(_largest(found), table=table, error=_error(found), solved=sum(one.solved for one in found))


def _solve_impulse_response(
    problem: OpenWaterProblem, request: ImpulseResponseRequest, memory: Memory
) -> ImpulseResponseSolution:
    """Join the impulse responses of each order (collective); see `solve_impulse_response`."""
    orders = _orders(problem, request.elastic_modes)
    found = [solve_impulse_response(request, memory(order, request.elastic_modes)) for order in orders]
    tables = [one.table for one in found]
    dofs = _dofs(problem, *tables)

    def matrices(name: str) -> np.ndarray:
        return _matrices(dofs, [(table.dofs, getattr(table, name)) for table in tables])

    table = replace(
        tables[0],
        dofs=dofs,
        impulse_response=matrices("impulse_response"),
        infinite_frequency_added_mass=matrices("infinite_frequency_added_mass"),
        added_mass=matrices("added_mass"),
        radiation_damping=matrices("radiation_damping"),
        causality_error=np.max([table.causality_error for table in tables], axis=0),
        ogilvie_error=np.max([table.ogilvie_error for table in tables], axis=0),
        impulse_response_error=np.max([table.impulse_response_error for table in tables], axis=0),
        relative_error=max(table.relative_error for table in tables),
    )
    highest = min(one.highest for one in found)
    return replace(_largest(found), table=table, error=_error(found), highest=highest)


def _solve_motion(problem: OpenWaterProblem, request: MotionRequest, memory: Memory) -> MotionSolution:
    """Join the motions of each order in waves, which forces from outside do not couple (collective); see
    `solve_motion`."""
    found = [
        solve_motion(problem.of_order(order), request, memory(order, request.elastic_modes))
        for order in _orders(problem, request.elastic_modes)
    ]
    tables = [one.table for one in found]
    dofs = _dofs(problem, *tables)

    def motions(name: str) -> np.ndarray:
        return _by_dof(dofs, [(table.dofs, getattr(table, name)) for table in tables])

    table = replace(
        tables[0],
        dofs=dofs,
        displacement=motions("displacement"),
        velocity=motions("velocity"),
        steady=motions("steady"),
        initial=motions("initial"),
        relative_error=max(table.relative_error for table in tables),
    )
    return replace(_largest(found), table=table, error=_error(found))


def _dofs(
    problem: OpenWaterProblem,
    *tables: RadiationTable | ResponseTable | ResonanceTable | ImpulseResponseTable | MotionTable,
) -> tuple[Dof, ...]:
    rigid = dof_names(body.rigid_motions for body in open_basin(problem.tank, 0.0).tank.bodies)
    elastic = (dof for table in tables for dof in table.dofs if dof.is_elastic)
    return tuple(sorted((*rigid, *elastic), key=lambda dof: dof.body or 0))


def _places(dofs: tuple[Dof, ...], own: tuple[Dof, ...]) -> np.ndarray:
    return np.array([dofs.index(dof) for dof in own], dtype=int)


def _by_dof(dofs: tuple[Dof, ...], parts: list[tuple[tuple[Dof, ...], np.ndarray]]) -> np.ndarray:
    """Values of the motions of some orders, shape (…, own motions), among all: shape (…, motions)."""
    values = parts[0][1]
    whole = np.zeros((*values.shape[:-1], len(dofs)), dtype=values.dtype)
    for own, value in parts:
        whole[..., _places(dofs, own)] = value
    return whole


def _matrices(dofs: tuple[Dof, ...], parts: list[tuple[tuple[Dof, ...], np.ndarray]]) -> np.ndarray:
    """Matrices of the motions of some orders, shape (…, own motions, own motions), among all: shape (…, motions,
    motions)."""
    values = parts[0][1]
    whole = np.zeros((*values.shape[:-2], len(dofs), len(dofs)))
    for own, value in parts:
        places = _places(dofs, own)
        whole[..., places[:, None], places] = value
    return whole


def _largest(found: list[Solution]) -> Solution:
    return max(found, key=lambda one: one.model.pencil.size if one.model is not None else 0)


def _error(found: list[Solution]) -> float:
    return max(one.error for one in found)
