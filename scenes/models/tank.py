"""The scene of a closed tank, or of open water: its model with all checks."""

from __future__ import annotations

from pydantic import model_validator

from hydroelastic.scenes.models.problems import require_fit
from hydroelastic.scenes.models.tank_checks import STAGES
from hydroelastic.scenes.models.tank_parts import TankParts


class TankScene(TankParts):
    """A closed tank with one liquid or two and any number of bodies, or none (sloshing); or open water with bodies.

    Raises:
        ValidationError: (a ValueError) if a value is not allowed or the parts do not fit together.
    """

    @model_validator(mode="after")
    def _parts_fit(self) -> TankScene:
        require_fit(self, STAGES)
        return self
