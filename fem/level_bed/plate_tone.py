"""The first elastic tone of a plate: the mode with the largest part of its lowest elastic dry mode, of one order.

The tone may lie far above the modes that are asked for; it is sought among the modes of its own order alone, at a
resolution of its own.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from math import ceil, inf

import numpy as np

from hydroelastic.fem.adaptive import AdaptiveSolution, ErrorEstimate, adaptive_solve
from hydroelastic.fem.closed.discretization import MOST_MODES_TO_TONE
from hydroelastic.fem.closed.tones import ElasticTone, elastic_tone
from hydroelastic.fem.level_bed.orders import has_waves, order_problem, plate_line
from hydroelastic.fem.level_bed.resolution import (
    LAYER_RATIO,
    LineResolution,
    breakpoints,
    line_resolution,
    moving_piece,
    plate_at,
    workable,
)
from hydroelastic.fem.level_bed.separation import Separation
from hydroelastic.fem.level_bed.solution import PlateTone
from hydroelastic.fem.modes import solve_modes
from hydroelastic.modal.plate.line_modes import FEW_MODES, lowest_dry
from hydroelastic.physics.dofs import FIRST_ELASTIC
from hydroelastic.physics.level_tank import LevelTank
from hydroelastic.physics.local_waves import modes_below

SAFETY = 1.5
"""Measured: one degree and one layer more show 0.7 to 1 of an error."""
ROUNDING = 1e-13
"""Relative rounding of a frequency, measured."""
_ROUNDS = 3
# Tolerance at which the number of modes up to the tone is found.
_SEARCHED = 1e-3
# Modes of an order with ψ = 0 on the water among which the tone is sought first.
_MODES_OF_A_PLATE = 6


@dataclass(frozen=True, kw_only=True)
class _Found:
    tone: ElasticTone
    eigenvalue: float
    relative_error: float
    stiffness: float
    mass: float
    squares: float


def plate_tone(tank: LevelTank, separation: Separation, plate: int, tolerance: float) -> PlateTone:
    """Return the first elastic tone of a plate, and that with ψ = 0 on the water."""
    order, dry = lowest_dry(partial(plate_line, tank, separation, plate))
    body = tank.plates[plate]
    start, end = separation.places[plate]
    stiffness, mass = body.flexural_rigidity * dry + float(body.hydrostatic), body.mass_per_area
    wave = moving_piece(tank, end - start, plate).squared_frequency(dry**0.25)
    found = PlateTone(
        plate=plate,
        order=order,
        dry=stiffness / mass if mass else inf,
        squares=1.0,
        stiffness=0.0,
        mass=0.0,
    )
    solve = partial(_solved, tank, separation, plate, order, tolerance)
    if not has_waves(tank, separation):
        return _sought(tank, separation, found, FEW_MODES, wave, solve, None)
    release = solve(wave, _MODES_OF_A_PLATE, pressure_release=True)
    found = replace(
        found,
        pressure_release=release.solution.eigenvalue,
        pressure_release_error=release.solution.relative_error,
        squares=release.solution.squares,
        stiffness=release.solution.stiffness,
        mass=release.solution.mass,
    )
    value = release.solution.eigenvalue
    pieces = [
        moving_piece(tank, right - left, plate_at(separation, 0.5 * (left + right)))
        for left, right in zip(breakpoints(separation)[:-1], breakpoints(separation)[1:], strict=True)
    ]
    count = ceil(1.25 * modes_below(tuple(pieces), value)) + 4
    return _sought(tank, separation, found, count, value, solve, value)


def _sought(
    tank: LevelTank,
    separation: Separation,
    found: PlateTone,
    count: int,
    eigenvalue: float,
    solve: Callable[..., AdaptiveSolution[_Found]],
    release: float | None,
) -> PlateTone:
    assert found.order is not None
    exponent = 0.5 if tank.top == "pressure_release" else 1.0
    search = line_resolution(tank, separation, _SEARCHED, eigenvalue, exponent=exponent)
    while count <= MOST_MODES_TO_TONE:
        if _once(tank, separation, found.plate, found.order, search, count, release=release)[0].tone.certain:
            tone = solve(eigenvalue, count, exponent=exponent, release=release)
            if tone.solution.tone.certain:
                return _with_tone(found, tone)
        count = ceil(1.6 * count)
    reason = f"it lies above more than {MOST_MODES_TO_TONE} modes of order {found.order}, or is spread over them"
    return replace(found, reason=reason if release is None else f"{reason}; see the pressure-release tone")


def _with_tone(found: PlateTone, tone: AdaptiveSolution[_Found]) -> PlateTone:
    one = tone.solution
    return replace(
        found,
        tone=one.tone,
        eigenvalue=one.eigenvalue,
        relative_error=one.relative_error,
        squares=one.squares,
        stiffness=one.stiffness,
        mass=one.mass,
    )


def _solved(
    tank: LevelTank,
    separation: Separation,
    plate: int,
    order: int,
    tolerance: float,
    eigenvalue: float,
    count: int,
    *,
    exponent: float = 1.0,
    pressure_release: bool = False,
    release: float | None = None,
) -> AdaptiveSolution[_Found]:
    tolerance = workable(tolerance)
    once = partial(_once, tank, separation, plate, order, count=count, release=release)

    def value(resolution: LineResolution) -> tuple[_Found, np.ndarray]:
        """The tone and all λ; with ψ = 0 on the water the limit of ever thinner layers.

        There ψ ~ r^{1/2}, and the error falls like the thickness of the innermost layer.
        """
        found, values = once(resolution, pressure_release=pressure_release)
        if not pressure_release:
            return found, values
        _, thinner = once(replace(resolution, layers=resolution.layers + 1), pressure_release=True)
        values = thinner - (values - thinner) * LAYER_RATIO / (1.0 - LAYER_RATIO)
        return replace(found, eigenvalue=float(values[found.tone.index])), values

    def solve(resolution: LineResolution) -> _Found:
        (coarse, _), (_, fine) = value(resolution), value(resolution.finer())
        # Of two modes with nearly the same part of the tone the finer one may take the other.
        error = SAFETY * 0.5 * abs(coarse.eigenvalue / float(fine[coarse.tone.index]) - 1.0) + ROUNDING
        return replace(coarse, relative_error=error)

    return adaptive_solve(
        line_resolution(tank, separation, tolerance, eigenvalue, exponent=exponent, waves=not pressure_release),
        solve,
        lambda found: ErrorEstimate(discretization=found.relative_error),
        lambda resolution, _: resolution.refined(),
        tolerance,
        rounds=_ROUNDS,
        least_gain=1.0,
    )


def _once(
    tank: LevelTank,
    separation: Separation,
    plate: int,
    order: int,
    resolution: LineResolution,
    count: int,
    *,
    release: float | None,
    pressure_release: bool = False,
) -> tuple[_Found, np.ndarray]:
    """The tone among the modes of an order, without its error, and their λ."""
    problem = order_problem(tank, separation, resolution, order, pressure_release=pressure_release)
    assert problem is not None
    pencil, shapes = problem
    body = list(shapes).index(plate)
    first = pencil.bodies[body].dofs.index(FIRST_ELASTIC)
    while True:
        modes = solve_modes(pencil, count, shapes=0)
        tone = elastic_tone(modes.eigenvalues, modes.elastic_amplitudes, pencil.bodies, body, released=release)
        # With ψ = 0 on the water all modes are those of plates, and the softer plates' are below.
        if tone.certain or not pressure_release or len(modes.eigenvalues) < count:
            break
        count *= 2
    found = _Found(
        tone=tone,
        eigenvalue=float(modes.eigenvalues[tone.index]),
        relative_error=0.0,
        stiffness=float(pencil.bodies[body].stiffness[first]),
        mass=float(pencil.bodies[body].mass[first, first]),
        squares=separation.factor(order) * float(shapes[plate].squares[first]),
    )
    return found, modes.eigenvalues
