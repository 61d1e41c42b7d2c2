"""The lowest modes of all orders of an upright tank at one resolution.

Orders are solved until no lower frequency can come. With ‖·‖ over the surfaces, k_n the lowest wavenumber of an order
and κ_n that of a plate's dry modes,

    K ≥ Σ_plates (D κ_n⁴ + sρg)‖w‖² + ρg‖η‖²,    M ≤ Σ_plates (m + ρ/(k_n tanh k_nH))‖w‖² + ρ/(k_n tanh k_nH) ‖η‖²

so that λ is at least the smallest quotient of both, (D κ_n⁴ + sρg)/(m + ρ/(k_n tanh k_nH)) and g k_n tanh k_nH, for
n ≥ 2, where no plate moves as a rigid body. Both rise with n. Slats keep their rigid motions in each order: κ_n = 0
with s = 1; with s = 0 these have no stiffness, other modes are orthogonal to them, and κ_n is that of the first elastic
one.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from math import inf, tanh

import numpy as np

from hydroelastic.fem.level_bed.line import Line
from hydroelastic.fem.level_bed.order_problem import LineLiquid, covered_elements, order_pencil
from hydroelastic.fem.level_bed.resolution import LineResolution, line_nodes
from hydroelastic.fem.level_bed.separation import Separation
from hydroelastic.fem.level_bed.solution import SampledSurface
from hydroelastic.fem.mode_set import Mode, ModeSet
from hydroelastic.fem.modes import solve_modes
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.modal.plate.line_modes import FEW_MODES, LineModes, PlateLine, dry_modes
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.level_tank import LevelTank
from hydroelastic.physics.plate import Edge
from hydroelastic.physics.tank import ROUND_OFF

# Orders from which no plate has a rigid motion.
_ELASTIC = 2


@dataclass(frozen=True, kw_only=True)
class OrderSolution:
    """The modes of one order.

    Attributes:
        order: n.
        pencil: its problem.
        modes: its lowest modes, at unit generalized mass.
        shapes: dry modes of the plates that move in it, by their index.
    """

    order: int
    pencil: CoupledPencil[LineLiquid]
    modes: ModeSet
    shapes: dict[int, LineModes]
    symmetry: str = ""

    @property
    def separation(self) -> Separation:
        """The tank's."""
        return self.pencil.liquid.line.separation

    @property
    def multiplicity(self) -> int:
        """Number of independent modes at each frequency."""
        return self.separation.multiplicity(self.order)

    def sampled(self, mode: Mode, x: FloatArray, y: FloatArray, *, second: bool) -> SampledSurface:
        """See `PlanProblem.sampled`."""
        liquid, separation = self.pencil.liquid, self.separation
        line = liquid.line
        turn = separation.transverse(self.order)
        along = np.hypot(x, y) if separation.round else x
        angle = np.arctan2(y, x) * self.order if separation.round else turn * y
        across = np.sin(angle) if second else np.cos(angle)
        along = np.clip(along, separation.start, separation.end)
        surface = np.zeros(line.size)
        if self.pencil.surfaces:
            water = line.unknowns_of(np.setdiff1d(line.cells, covered_elements(line)))
            surface[water] = mode.values[self.pencil.body_size :]
        elevation = line.table(along).T @ surface
        position = 0
        covered = np.zeros(len(along), dtype=bool)
        for index, (start, end) in enumerate(separation.places):
            inside = (along >= start) & (along <= end) & ~covered
            covered |= inside
            elevation[inside] = 0.0
            if index in self.shapes:
                amplitudes = mode.body_amplitudes[position : position + self.shapes[index].count]
                position += len(amplitudes)
                elevation[inside] = self.shapes[index].values(along[inside]) @ amplitudes
        squares, functions = line.waves
        parts = functions.T @ (line.mass @ mode.potential.array_r)
        return SampledSurface(
            elevation=elevation * across,
            wavenumbers=np.sqrt(np.maximum(squares, 0.0)),
            potentials=line.table(along).T @ (functions * parts) * across[:, None],
        )


def plate_line(tank: LevelTank, separation: Separation, index: int, order: int) -> PlateLine:
    """Return a plate of a tank on the line of an order."""
    plate, (start, end) = tank.plates[index], separation.places[index]

    def held(place: float) -> Edge:
        on_wall = min(abs(place - separation.start), abs(place - separation.end)) <= ROUND_OFF
        return plate.edge if on_wall else "free"

    return PlateLine(
        start=start,
        end=end,
        round=separation.round,
        transverse=0.0 if plate.slats else separation.transverse(order),
        poisson_ratio=plate.poisson_ratio,
        edges=(held(start), held(end)),
    )


def plate_shapes(tank: LevelTank, separation: Separation, order: int, counts: tuple[int, ...]) -> dict[int, LineModes]:
    """Return the dry modes of each plate that moves in an order, by its index; a rigid one has its rigid motions."""
    found = {}
    for index, plate in enumerate(tank.plates):
        line = plate_line(tank, separation, index, order)
        count = counts[index] if plate.is_elastic else line.rigid_count
        if count:
            found[index] = dry_modes(line, count)
    return found


def lower_bound(tank: LevelTank, separation: Separation, order: int) -> float:
    """Return a λ below which an order has no mode; −∞ of those in which a plate may move as a rigid body."""
    if order < _ELASTIC:
        return -inf
    least = separation.least_wavenumber(order)
    water = 1.0 / (least * tanh(least * tank.depth))
    bounds = [1.0 / water] if has_waves(tank, separation) else []
    for index, plate in enumerate(tank.plates):
        if plate.is_elastic:
            modes = dry_modes(plate_line(tank, separation, index, order), FEW_MODES)
            # Motions of slats without any stiffness are no modes: those are orthogonal to them.
            dry = modes.eigenvalues[0 if plate.hydrostatic else modes.rigid]
            stiffness = plate.flexural_rigidity * float(dry) + float(plate.hydrostatic)
            bounds.append(stiffness / (plate.mass_per_area + water))
    return min(bounds, default=inf)


def order_problem(
    tank: LevelTank, separation: Separation, resolution: LineResolution, order: int, *, pressure_release: bool = False
) -> tuple[CoupledPencil[LineLiquid], dict[int, LineModes]] | None:
    """Return the problem of an order and the shapes of its plates; ``None`` where nothing moves in it."""
    shapes = plate_shapes(tank, separation, order, resolution.shapes)
    if not shapes and (pressure_release or not has_waves(tank, separation)):
        return None
    nodes = line_nodes(separation, resolution, tank.depth)
    line = Line(nodes=nodes, degree=resolution.degree, separation=separation, order=order)
    return order_pencil(tank, line, shapes, pressure_release=pressure_release), shapes


def has_waves(tank: LevelTank, separation: Separation) -> bool:
    """Whether the plates leave part of a free surface open."""
    covered = sum(end - start for start, end in separation.places)
    return tank.top == "free" and covered < separation.end - separation.start - ROUND_OFF


def solve_order(
    tank: LevelTank, separation: Separation, resolution: LineResolution, order: int, count: int
) -> OrderSolution | None:
    """Return the lowest modes of an order; ``None`` where nothing moves in it."""
    problem = order_problem(tank, separation, resolution, order)
    if problem is None:
        return None
    pencil, shapes = problem
    return OrderSolution(order=order, pencil=pencil, modes=solve_modes(pencil, count, shapes=0), shapes=shapes)


def solve_orders(
    tank: LevelTank, separation: Separation, resolution: LineResolution, count: int
) -> tuple[OrderSolution, ...]:
    """Solve order after order, until as many modes are found as are wanted, and no order can have a lower one."""
    found: list[OrderSolution] = []
    values = np.empty(0)
    for order in itertools.count():
        highest = values[count - 1] if len(values) >= count else inf
        if lower_bound(tank, separation, order) >= highest:
            return tuple(found)
        solved = solve_order(tank, separation, resolution, order, count)
        if solved is not None:
            found.append(solved)
            values = np.sort(np.concatenate([values, solved.modes.eigenvalues]))
    raise AssertionError("the count has no end")
