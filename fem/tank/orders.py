"""Tanks of revolution or of an extruded section between walls, order by order.

Of each order the modes of the half-plane (r, z), or of the section, are solved for. Those of order n ≥ 1 about an axis
come in pairs, cos nθ and sin nθ. The lowest frequency of an order grows with n ≥ 1, of elastic plates with n ≥ 2, since
n² is added to a positive form: orders are added until it exceeds all frequencies that are asked for.
"""

from __future__ import annotations

from dataclasses import dataclass

from mpi4py import MPI

from hydroelastic.fem.closed.tones import mode_kinds
from hydroelastic.fem.progress import Report
from hydroelastic.fem.tank.solve import TankSolution, solve_tank
from hydroelastic.physics.round_plates import LOWEST_BENT
from hydroelastic.physics.tank import Tank


@dataclass(frozen=True, kw_only=True)
class OrderedMode:
    """A mode.

    Attributes:
        order: azimuthal order n, or number of half waves across an extruded section.
        multiplicity: number of modes of this frequency that differ by a turn about the axis.
        index: of the mode among those of its order.
        omega: ω, rad/s.
        relative_error: estimated, of ω.
        kind: what has most of the potential energy: "sloshing", "heave", "pitch" …
    """

    order: int
    index: int
    omega: float
    relative_error: float
    kind: str
    multiplicity: int


@dataclass(frozen=True, kw_only=True)
class OrderedSolution:
    """The modes of a tank of revolution, or of an extruded section.

    Attributes:
        orders: the solutions of the orders 0, 1 …
        modes: the lowest modes, ascending; a pair of order n ≥ 1 is one with the multiplicity 2.
        reasons: why the solution does not keep the tolerance or is incomplete; empty if it does.
    """

    orders: tuple[TankSolution, ...]
    modes: tuple[OrderedMode, ...]
    reasons: tuple[str, ...]


def solve_by_order(
    physical: Tank,
    *,
    tolerance: float,
    modes: int,
    comm: MPI.Comm | None = None,
    report: Report = lambda _message: None,
) -> OrderedSolution:
    """Solve a tank of revolution, or of an extruded section with rigid floats across its width (collective).

    See `solve_tank`.
    """
    if physical.beams:
        raise ValueError("beams do not bend across the section: no order describes them")
    # From this order on the lowest frequency rises with the order.
    rising = LOWEST_BENT if physical.elastic else 1
    orders: list[TankSolution] = []
    found: list[OrderedMode] = []
    while True:
        order = len(orders)
        report(f"order {order}")
        solution = solve_tank(physical.of_order(order), tolerance=tolerance, modes=modes, comm=comm)
        orders.append(solution)
        own = _modes(solution, order)
        found = sorted([*found, *own], key=lambda mode: mode.omega)[:modes]
        if order >= rising and (not own or (len(found) == modes and own[0].omega > found[-1].omega)):
            break
    reasons = [f"order {order}: {reason}" for order, one in enumerate(orders) for reason in one.reasons]
    return OrderedSolution(orders=tuple(orders), modes=tuple(found), reasons=tuple(reasons))


def _modes(solution: TankSolution, order: int) -> list[OrderedMode]:
    field = solution.field
    return [
        OrderedMode(
            order=order,
            index=index,
            omega=solution.omega(mode.eigenvalue),
            relative_error=float(solution.relative_errors[index]),
            kind=mode_kinds(mode.energy[None], field.bodies, field.surfaces)[0],
            multiplicity=2 if order and solution.tank.geometry.is_revolved else 1,
        )
        for index, mode in enumerate(solution.asked)
    ]
