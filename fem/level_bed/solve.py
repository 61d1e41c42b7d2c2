"""Solve an upright tank with a level bed to a tolerance, order by order."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import count as counting

import numpy as np

from hydroelastic.fem.adaptive import ErrorEstimate, adaptive_solve
from hydroelastic.fem.inertia import count_below
from hydroelastic.fem.level_bed.choice import NotTreatedError
from hydroelastic.fem.level_bed.orders import OrderSolution, solve_order, solve_orders
from hydroelastic.fem.level_bed.plate_tone import ROUNDING, SAFETY, plate_tone
from hydroelastic.fem.level_bed.resolution import LineResolution, expected_eigenvalue, line_resolution, workable
from hydroelastic.fem.level_bed.separation import Separation, separated
from hydroelastic.fem.level_bed.solution import LevelMode, LevelSolution, shift_above, shortcomings
from hydroelastic.fem.progress import Report
from hydroelastic.physics.level_tank import LevelTank

_MOST_ATTEMPTS = 5
# The highest mode may lie this much above the expected one before the resolution is made anew.
_HIGHER = 1.3


@dataclass(frozen=True, kw_only=True)
class _Attempt:
    """The modes at one resolution.

    Attributes:
        resolution: of the lines.
        orders: all orders that may have one of the lowest modes.
        places: order, by its place among them, and number in it, of each mode, ascending.
        eigenvalues: λ of the modes.
        errors: estimated relative errors of their frequencies.
        counted: whether their number is confirmed.
    """

    resolution: LineResolution
    orders: tuple[OrderSolution, ...]
    places: tuple[tuple[int, int], ...]
    eigenvalues: np.ndarray
    errors: np.ndarray
    counted: bool


def solve_level_tank(
    physical: LevelTank, *, tolerance: float, modes: int, tones: bool = True, report: Report = lambda _message: None
) -> LevelSolution:
    """Solve an upright tank with a level bed, alike on each process."""
    tank = physical.scaled()
    separation = separated(tank)
    if separation is None:
        raise NotTreatedError("its plates are neither all strips in a box nor all concentric in a cylinder")
    attempts = counting(1)
    aim = workable(tolerance)

    def solve(resolution: LineResolution) -> _Attempt:
        report(f"attempt {next(attempts)}: degree {resolution.degree}, {resolution.layers} layers")
        return _attempt(tank, separation, resolution, modes)

    def refine(resolution: LineResolution, attempt: _Attempt) -> LineResolution | None:
        if attempt.errors.max(initial=0.0) <= aim:
            return None
        finer = resolution.refined()
        # Modes of soft plates may lie elsewhere than waves of open water.
        highest = float(attempt.eigenvalues[-1])
        if finer is not None and highest > _HIGHER * expected:
            fitting = line_resolution(tank, separation, aim, highest)
            sizes = tuple(map(min, finer.sizes, fitting.sizes))
            finer = replace(finer, sizes=sizes, shapes=tuple(map(max, finer.shapes, fitting.shapes)))
        return finer

    expected = expected_eigenvalue(tank, modes, multiplicity=separation.multiplicity(1))
    exponent = 0.5 if tank.top == "pressure_release" and tank.plates else 1.0
    found = adaptive_solve(
        line_resolution(tank, separation, aim, expected, exponent=exponent),
        solve,
        lambda attempt: ErrorEstimate(
            discretization=float(attempt.errors.max(initial=0.0)), missing=int(not attempt.counted)
        ),
        refine,
        aim,
        rounds=_MOST_ATTEMPTS,
    ).solution
    found_tones = []
    for index, plate in enumerate(tank.plates):
        if plate.is_elastic and tones:
            report(f"first elastic tone of plate {index + 1}")
            found_tones.append(plate_tone(tank, separation, index, tolerance))
    solution = LevelSolution(
        physical=physical,
        tank=tank,
        model=_model(separation),
        tolerance=tolerance,
        count=modes,
        modes=tuple(
            LevelMode(
                problem=found.orders[order],
                bodies=found.orders[order].pencil.bodies,
                mode=found.orders[order].modes.completed(place),
                relative_error=float(error),
            )
            for (order, place), error in zip(found.places, found.errors, strict=True)
        ),
        tones=tuple(found_tones),
        zero_modes=sum(one.multiplicity * one.modes.zero_modes for one in found.orders),
        counted=found.counted,
        size={
            "problems": len(found.orders),
            "poles": 0,
            "degree": found.resolution.degree,
            "layers": found.resolution.layers,
            "dofs": sum(one.pencil.liquid.size + one.pencil.size for one in found.orders),
            "surface_unknowns": sum(one.pencil.size for one in found.orders),
            "plate_shapes": sum(one.pencil.body_size for one in found.orders),
        },
        reasons=(),
    )
    return replace(solution, reasons=tuple(shortcomings(solution)))


def _model(separation: Separation) -> str:
    if separation.round:
        return "upright round tank with a level bed: one radial problem for each order n of cos nθ, exact in depth"
    return "upright box with a level bed: one problem along x for each order n of cos nπy/B, exact in depth"


def _attempt(tank: LevelTank, separation: Separation, resolution: LineResolution, count: int) -> _Attempt:
    # One mode more than asked for, to count in the gap above.
    orders = solve_orders(tank, separation, resolution, count + 1)
    ordered = sorted(
        (float(value), order, place)
        for order, one in enumerate(orders)
        for place, value in enumerate(one.modes.eigenvalues)
    )
    values = np.array([value for value, _, _ in ordered[: count + 1]])
    asked = ordered[:count]
    last = {orders[order].order: place + 1 for _, order, place in asked}
    finer = {order: _values(tank, separation, resolution.finer(), order, most) for order, most in last.items()}
    exact = np.array([finer[orders[order].order][place] for _, order, place in asked])
    shift = shift_above(values)
    counted = all(count_below(one.pencil, shift) == int(np.sum(one.modes.eigenvalues < shift)) for one in orders)
    values = values[: len(asked)]
    return _Attempt(
        resolution=resolution,
        orders=orders,
        places=tuple((order, place) for _, order, place in asked),
        eigenvalues=values,
        errors=SAFETY * 0.5 * np.abs(values / exact - 1.0) + ROUNDING,
        counted=counted,
    )


def _values(tank: LevelTank, separation: Separation, resolution: LineResolution, order: int, count: int) -> np.ndarray:
    solved = solve_order(tank, separation, resolution, order, count)
    assert solved is not None
    return solved.modes.eigenvalues
