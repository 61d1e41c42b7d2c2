"""The ship and the waves of a scene in SI units."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

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
