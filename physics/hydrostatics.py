"""A rigid section, or solid of revolution, at rest at a still level: equilibrium by Archimedes' law, and stiffness.

Moorings may add a constant vertical force F at the centre of mass G: m g = g Σ ρⱼ Aⱼ + F. About G neither it nor the
weight has a moment, however the float turns: the pressures alone restore it, with g Σ ρⱼ Aⱼ in the place of m g.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hydroelastic.physics.contours import Contour, Point, root
from hydroelastic.physics.revolution import SolidOfRevolution
from hydroelastic.physics.scales import Scales

NEUTRAL = 1e-12
"""A stiffness smaller than this part of its terms is zero: only rounding keeps it from being so."""

AT_CORNER = 1e-9
"""A still level nearer to a corner than this part of the section's height passes through it: decimal masses are
not exact."""


@dataclass(frozen=True, kw_only=True)
class Hydrostatics:
    """A float at rest, per metre of width, or a whole solid of revolution: its units have one metre more.

    Points lie in the frame of the tank: x from the left wall, y from the still interface, or from the still surface
    of one liquid. Heave is counted upwards, roll anticlockwise about the centre of mass G.
    """

    mass: float  # m, kg/m
    displaced_mass: float  # Σ ρⱼ Aⱼ, kg/m: the same without a vertical force
    level: float  # ordinate of the still level at which it floats, m
    reference_level: float  # ordinate of the shape's reference level, m
    areas: tuple[float, float]  # of the section below and above the level, m²; volumes of a solid
    centroids: tuple[Point, Point]  # of these parts, the centres of buoyancy, m
    waterplane: tuple[float, float]  # x of the left and of the right contact point, m
    centre_of_mass: Point  # G, m
    radius_of_gyration: float  # about G, m
    heave_stiffness: float  # c33 = Δρ g B, N/m², with the width, or area, B of the waterplane
    coupling_stiffness: float  # c35 = c53 = Δρ g ∫(x − x_G) dx over the waterplane, N/m
    roll_stiffness: float  # c55 = Δρ g ∫(x − x_G)² dx + g Σ ρⱼ Aⱼ (y_Bⱼ − y_G), N
    free_roll_stiffness: float  # c55 − c35²/c33, the stiffness of roll with free heave, N

    def moved(self, shift: Point) -> Hydrostatics:
        """Return the same float elsewhere."""
        x, y = shift
        one, other = ((x + centre_x, y + centre_y) for centre_x, centre_y in self.centroids)
        return replace(
            self,
            level=y + self.level,
            reference_level=y + self.reference_level,
            centroids=(one, other),
            waterplane=(x + self.waterplane[0], x + self.waterplane[1]),
            centre_of_mass=(x + self.centre_of_mass[0], y + self.centre_of_mass[1]),
        )

    def scaled(self, units: Scales) -> Hydrostatics:
        """Return the same float in other units."""
        length, volume, pressure = units.length, units.volume, units.density * units.gravity
        one, other = ((x / length, y / length) for x, y in self.centroids)
        x, y = self.centre_of_mass
        return Hydrostatics(
            mass=self.mass / (units.density * volume),
            displaced_mass=self.displaced_mass / (units.density * volume),
            level=self.level / length,
            reference_level=self.reference_level / length,
            areas=(self.areas[0] / volume, self.areas[1] / volume),
            centroids=(one, other),
            waterplane=(self.waterplane[0] / length, self.waterplane[1] / length),
            centre_of_mass=(x / length, y / length),
            radius_of_gyration=self.radius_of_gyration / length,
            heave_stiffness=self.heave_stiffness / (pressure * volume / length),
            coupling_stiffness=self.coupling_stiffness / (pressure * volume),
            roll_stiffness=self.roll_stiffness / (pressure * volume * length),
            free_roll_stiffness=self.free_roll_stiffness / (pressure * volume * length),
        )

    @property
    def stiffness(self) -> NDArray[np.float64]:
        """Stiffness of heave, sway and roll, shape (3, 3): N/m², N/m and N."""
        c33, c35, c55 = self.heave_stiffness, self.coupling_stiffness, self.roll_stiffness
        return np.array([[c33, 0.0, c35], [0.0, 0.0, 0.0], [c35, 0.0, c55]])

    @property
    def inertia(self) -> NDArray[np.float64]:
        """Mass for heave and sway, kg/m, and moment of inertia about G for roll, kg·m, shape (3,)."""
        return self.mass * np.array([1.0, 1.0, self.radius_of_gyration**2])


def still_level(contour: Contour | SolidOfRevolution, mass: float | None, densities: tuple[float, float]) -> float:
    """Return the ordinate of the still level in a float's frame, by Archimedes: ρ₂ A₂ + ρ₁ A₁ is the displaced mass.

    Args:
        contour: in the float's frame, m.
        mass: displaced, kg/m, or kg of a solid; None floats with the reference level y = 0 at the still level.
        densities: ρ₂ below and ρ₁ above the level, kg/m³.
    """
    if mass is None:
        return 0.0
    below, above = densities
    area = contour.moments().area
    if not above * area < mass < below * area:
        unit = "kg" if isinstance(contour, SolidOfRevolution) else "kg/m"
        raise ValueError(f"a mass between {above * area:g} and {below * area:g} {unit} floats at this level")
    _, _, low, high = contour.bounds
    immersed = (mass - above * area) / (below - above)
    level = root(lambda y: contour.moments(y).area - immersed, low, high)
    corners = (y for _, y in contour.corners)
    return next((y for y in corners if abs(y - level) < AT_CORNER * (high - low)), level)


def hydrostatics(
    contour: Contour | SolidOfRevolution,
    *,
    immersion: float,
    densities: tuple[float, float],
    gravity: float,
    centre_of_mass: float | None = None,
    radius_of_gyration: float | None = None,
    vertical_force: float = 0.0,
) -> Hydrostatics:
    """Return the hydrostatics of a float at rest, in a frame with its position and the still level as origin.

    Args:
        contour: in that frame, m.
        immersion: ordinate of the still level above the shape's reference level, m.
        densities: below and above the level, kg/m³.
        gravity: m/s².
        centre_of_mass: height of G above the reference level, m; by default that of the section's area.
        radius_of_gyration: about G, m; by default that of the homogeneous section.
        vertical_force: F of moorings, upwards, N/m, or N of a solid.
    """
    chain = contour.below(0.0)
    left, right = chain[0].start[0], chain[-1].end[0]
    whole, parts = contour.moments(), (contour.moments(0.0, side="below"), contour.moments(0.0, side="above"))
    displaced = sum(density * part.area for density, part in zip(densities, parts, strict=True))
    x_mass = sum(density * part.first[0] for density, part in zip(densities, parts, strict=True)) / displaced
    y_mass = whole.centroid[1] if centre_of_mass is None else centre_of_mass - immersion
    restoring = gravity * (densities[0] - densities[1])
    width, second = contour.waterplane(left, right)
    is_solid = isinstance(contour, SolidOfRevolution)
    middle = 0.0 if is_solid else _sum_or_zero(0.5 * left, 0.5 * right, -x_mass)
    about_middle = restoring * second
    lever = [gravity * density * part.first[1] for density, part in zip(densities, parts, strict=True)]
    lever.append(-gravity * displaced * y_mass)
    about_mass = about_middle + restoring * width * middle**2
    return Hydrostatics(
        mass=displaced + vertical_force / gravity,
        displaced_mass=displaced,
        level=0.0,
        reference_level=-immersion,
        areas=(parts[0].area, parts[1].area),
        centroids=(parts[0].centroid, parts[1].centroid),
        waterplane=(left, right),
        centre_of_mass=(x_mass, y_mass),
        radius_of_gyration=whole.radius_of_gyration if radius_of_gyration is None else radius_of_gyration,
        heave_stiffness=restoring * width,
        coupling_stiffness=restoring * width * middle,
        roll_stiffness=_sum_or_zero(about_mass, *lever),
        free_roll_stiffness=_sum_or_zero(about_middle, *lever),
    )


def _sum_or_zero(*terms: float) -> float:
    total = sum(terms)
    return total if abs(total) > NEUTRAL * max(map(abs, terms)) else 0.0
