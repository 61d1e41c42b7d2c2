"""Circular and ring-shaped elastic plates without draught about the axis of a sea of revolution."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import inf, isfinite

from hydroelastic.physics.beam_parts import Section, StretchedSection
from hydroelastic.physics.bodies import Body
from hydroelastic.physics.dofs import Dof, Level, Turn
from hydroelastic.physics.scales import Scales

LOWEST_BENT = 2
"""The lowest order in which a plate has no rigid motion."""


@dataclass(frozen=True, kw_only=True)
class RoundPlate(Body):
    """A uniform Kirchhoff plate or membrane with free edges: D Δ²w − T Δw + m ẅ + s ρ g w = pressure of the liquid.

    Raises:
        ValueError: if a number is not in its range, or neither bending nor tension resists a deflection.
    """

    is_elastic = True
    radius: float  # a, outer radius, m
    inner_radius: float = 0.0  # that of a ring, m; 0 of a disc
    flexural_rigidity: float  # D, N·m; 0 of a membrane, infinite of a rigid plate
    mass_per_area: float  # m, kg/m²
    poisson_ratio: float = 0.3
    tension: float = 0.0  # T, N/m, by horizontal forces at the edges: it resists pitch, too
    thickness: float | None = None  # h, m, for strain and stress at its faces; ``None`` if it is not known
    hydrostatic: bool = True  # whether the hydrostatic restoring Δρ g w acts on it
    level: Level = "surface"  # at which it floats
    order: int | None = None  # azimuthal order n of its shapes W(r) cos nθ; ``None`` for all

    def __post_init__(self) -> None:
        if not (0.0 <= self.inner_radius < self.radius < inf and isfinite(self.mass_per_area + self.tension)):
            raise ValueError("a round plate needs a radius, larger than an inner one, a mass and a tension")
        if min(self.mass_per_area, self.tension) < 0.0 or self.flexural_rigidity + self.tension <= 0.0:
            raise ValueError("a round plate needs a rigidity or a tension, and no negative mass")
        if not -1.0 < self.poisson_ratio <= 0.5:
            raise ValueError(f"Poisson's ratio is {self.poisson_ratio}; it lies above −1 and is 1/2 at most")

    @property
    def waterplane(self) -> tuple[float, float]:
        """Inner and outer radius, m."""
        return self.inner_radius, self.radius

    @property
    def bends(self) -> bool:
        """Whether it is not rigid."""
        return self.flexural_rigidity < inf

    @property
    def rigid_motions(self) -> tuple[Dof, ...]:
        """Heave, of order 0; pitch, r cos θ, of order 1, unless a tension resists it as any other deflection."""
        heave = (Dof("heave"),) if self.order in (None, 0) else ()
        pitches = self.order in (None, 1) and not (self.bends and self.tension)
        return (*heave, *((Turn("pitch"),) if pitches else ()))

    def zero_stiffness_motions(self) -> Iterator[tuple[Dof, bool]]:
        """Without hydrostatics it heaves and pitches without energy."""
        if not self.hydrostatic:
            yield from ((motion, motion == "heave") for motion in self.rigid_motions)

    @property
    def displaces_volume(self) -> bool:
        """Whether one of its motions displaces a net volume: those of order 0 do."""
        return self.order in (None, 0)

    @property
    def orders(self) -> tuple[int, ...]:
        """See `Body.orders`: those of its rigid motions; it bends in all."""
        return (0, 1)

    def of_order(self, order: int) -> RoundPlate:
        """See `Body.of_order`."""
        return replace(self, order=order)

    def moved(self, shift: float) -> RoundPlate:
        """Return the same plate: it stays on the axis."""
        return self

    def scaled(self, units: Scales, start: float, end: float) -> RoundPlate:
        """Return the plate in other units, between given radii in these units."""
        return replace(
            self,
            radius=end,
            inner_radius=start,
            flexural_rigidity=self.flexural_rigidity / units.flexural_rigidity,
            mass_per_area=self.mass_per_area / units.mass_per_length,
            tension=self.tension * units.length**2 / units.flexural_rigidity,
            thickness=None if self.thickness is None else self.thickness / units.length,
        )

    def is_mirror_image_of(self, other: object) -> bool:
        """Whether it is the mirror image of another body: round plates share their axis, and are alone there."""
        return self == other

    @property
    def flexural_sections(self) -> tuple[Section, ...]:
        """Its radius, along which waves travel as on a beam of the same rigidity; none of a rigid plate."""
        if not self.bends:
            return ()
        return (
            StretchedSection(
                length=self.radius - self.inner_radius,
                flexural_rigidity=self.flexural_rigidity,
                mass_per_length=self.mass_per_area,
                tension=self.tension,
            ),
        )

    @property
    def is_restored(self) -> bool:
        """Whether the hydrostatic restoring acts on it."""
        return self.hydrostatic
