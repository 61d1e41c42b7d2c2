"""Closed forms of upright tanks with level beds.

Waves on open water and under a plate with sliding edges that covers all of it separate:

    ω² = (D k⁴ + sρg)/(m + ρ/(k tanh kH)),    D = m = 0, s = 1 without a plate

with k² = (iπ/L)² + (jπ/B)² in a box, J_n'(kR) = 0 in a cylinder. A covered cylinder has no such form: w_r = 0 on a
curved edge leaves a shear force for n ≥ 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt, tanh

import numpy as np
from scipy.special import jnp_zeros

from hydroelastic.physics.level_tank import Box, Cylinder, LevelTank
from hydroelastic.physics.plate import Plate, Strip
from hydroelastic.physics.tank import ROUND_OFF


@dataclass(frozen=True, kw_only=True)
class ExactMode:
    """A mode of a closed form."""

    formula: str  # what it is
    order: int  # order of the second direction
    omega: float  # ω, rad/s


def exact_frequencies(tank: LevelTank, count: int) -> tuple[ExactMode, ...]:
    """Return the lowest frequencies of tanks with a closed form; none of others."""
    plate = _cover(tank)
    if tank.top != "free" or (tank.plates and plate is None):
        return ()
    stiffness = plate.flexural_rigidity if plate is not None else 0.0
    mass = plate.mass_per_area if plate is not None else 0.0
    restoring = tank.density * tank.gravity if plate is None or plate.hydrostatic else 0.0
    cover = "(D k⁴ + s ρ g)/(m + ρ/(k tanh kH))" if plate is not None else "g k tanh kH"

    def omega(k: float) -> float:
        return sqrt((stiffness * k**4 + restoring) / (mass + tank.density / (k * tanh(k * tank.depth))))

    if isinstance(tank.plan, Box):
        sides = (tank.plan.length, tank.plan.width)
        formula = f"ω² = {cover}, k² = (iπ/L)² + (jπ/B)²"
        waves = _box_waves(sides, count)
    elif isinstance(tank.plan, Cylinder) and not tank.plan.inner_radius and plate is None:
        formula = f"ω² = {cover}, J_n'(kR) = 0"
        # The lowest root of order n is above n, so that orders up to the number of modes hold the lowest ones.
        roots = [(float(root), n) for n in range(count + 1) for root in jnp_zeros(n, count)]
        waves = [(root / tank.plan.radius, n) for root, n in sorted(roots)]
    else:
        return ()
    return tuple(ExactMode(formula=formula, order=order, omega=omega(k)) for k, order in waves[:count])


def _box_waves(sides: tuple[float, float], count: int) -> list[tuple[float, int]]:
    """The lowest wavenumbers of a box, with their order across, ascending."""
    numbers = np.arange(count + 1)
    squares = (numbers[:, None] * pi / sides[0]) ** 2 + (numbers * pi / sides[1]) ** 2
    pairs = sorted((float(sqrt(squares[i, j])), int(j)) for i in numbers for j in numbers if i or j)
    return pairs[:count]


def _cover(tank: LevelTank) -> Plate | None:
    """The plate with sliding edges that covers a box, if there is one."""
    if len(tank.plates) != 1 or not isinstance(tank.plan, Box):
        return None
    (plate,) = tank.plates
    covers = isinstance(plate.outline, Strip) and plate.outline.length >= tank.plan.length * (1.0 - ROUND_OFF)
    return plate if covers and plate.edge == "sliding" and plate.is_elastic else None
