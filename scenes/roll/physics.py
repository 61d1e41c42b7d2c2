"""The ship and the waves of a scene in SI units."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from hydroelastic.fem.kept_tolerance import kept_tolerance
from hydroelastic.modal.roll.solution import RollSolution
from hydroelastic.physics.ship import Ship
from hydroelastic.physics.wave import WaveTrain
from hydroelastic.scenes.models.roll import RollScene

if TYPE_CHECKING:
    from hydroelastic.fem.section_roll import SectionRoll


def rolling_ship(scene: RollScene, section: SectionRoll | None) -> Ship:
    """Return k, n and d of the ship."""
    frequency = scene.natural_frequency if section is None else section.natural_frequency
    assert frequency is not None
    by_waves = 0.0 if section is None or section.damping is None else section.damping
    return Ship(
        natural_frequency=frequency,
        damping=(scene.damping(frequency) or 0.0) + by_waves,
        quadratic_damping=scene.roll.quadratic_damping,
    )


def wave_train(scene: RollScene) -> WaveTrain:
    """Return the waves of the scene; there may be none."""
    waves = np.array(scene.waves).reshape(-1, 2)
    return WaveTrain(periods=waves[:, 0], slopes=waves[:, 1])


@dataclass(frozen=True, kw_only=True)
class RollResult:
    """A solved scene."""

    scene: RollScene
    solution: RollSolution  # the motion; the error of its ship is that of the section
    section: SectionRoll | None  # roll of the section by its field solution; ``None`` without one

    @property
    def levels(self) -> tuple[float, ...]:
        """Levels whose exceedances are counted, rad."""
        return self.scene.output.levels

    @property
    def reasons(self) -> tuple[str, ...]:
        """Reasons why the tolerance is not reached; empty if it is."""
        solution, tolerance = self.solution, self.scene.accuracy.tolerance
        relative = solution.relative_error
        if relative <= tolerance:
            return ()
        by_section = solution.ship_error > solution.angle_error
        cause = "; most of it comes from the section: ask for a smaller tolerance there" if by_section else ""
        return (
            f"the angle has an estimated error of {relative:.1e} of the largest one, above the tolerance "
            f"{tolerance:g}; {kept_tolerance(relative)}{cause}",
        )
