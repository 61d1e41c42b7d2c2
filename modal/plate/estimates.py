"""Closed forms of upright tanks, and simple estimates of the first elastic tone of a plate.

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

from hydroelastic.modal.plate.line_modes import PlateLine, lowest_dry
from hydroelastic.physics.level_tank import Box, Cylinder, LevelTank
from hydroelastic.physics.plate import Disc, Plate, Strip
from hydroelastic.physics.tank import ROUND_OFF


@dataclass(frozen=True, kw_only=True)
class ExactMode:
    """A mode of a closed form.

    Attributes:
        formula: what it is.
        order: order of the second direction.
        omega: ω, rad/s.
    """

    formula: str
    order: int
    omega: float


@dataclass(frozen=True, kw_only=True)
class PlateEstimate:
    """An estimate of the first elastic tone of the first plate.

    Attributes:
        omega: ω, rad/s.
        added_mass_per_area: mean added mass per area, kg/m².
        note: what it neglects.
    """

    omega: float
    added_mass_per_area: float
    note: str


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


def plate_estimates(tank: LevelTank) -> dict[str, PlateEstimate]:
    """Return estimates of the first elastic tone of a single elastic strip, disc or ring with free edges, by name."""
    if len(tank.plates) != 1 or not tank.plates[0].is_elastic or tank.plates[0].edge != "free":
        return {}
    (plate,) = tank.plates
    outline = plate.outline
    if not isinstance(outline, Strip | Disc):
        return {}

    def line(order: int) -> PlateLine:
        round_ = isinstance(outline, Disc)
        return PlateLine(
            start=outline.inner_radius if isinstance(outline, Disc) else 0.0,
            end=outline.radius if isinstance(outline, Disc) else outline.length,
            round=round_,
            transverse=float(order) if isinstance(outline, Disc) else order * pi / outline.width * (not plate.slats),
            poisson_ratio=plate.poisson_ratio,
            edges=("free", "free"),
        )

    order, eigenvalue = lowest_dry(line)
    stiffness = plate.flexural_rigidity * eigenvalue + float(plate.hydrostatic) * tank.density * tank.gravity
    wavenumber = eigenvalue**0.25
    lengths = {
        "wave_in_depth": (
            1.0 / (wavenumber * tanh(wavenumber * tank.depth)),
            "added mass ρ/(κ tanh κH) of a wave with the wavenumber κ of the dry mode, without edges",
        ),
        "wave_deep": (1.0 / wavenumber, "the same in deep water, ρ/κ"),
    }
    return {
        name: PlateEstimate(
            omega=sqrt(stiffness / (plate.mass_per_area + tank.density * length)),
            added_mass_per_area=tank.density * length,
            note=f"the first dry mode alone, of order {order}; {note}",
        )
        for name, (length, note) in lengths.items()
    }
