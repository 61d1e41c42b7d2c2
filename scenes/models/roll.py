"""The scene of a ship on a swell: its model with all checks."""

from __future__ import annotations

from pydantic import model_validator

from hydroelastic.scenes.models.problems import require_fit
from hydroelastic.scenes.models.roll_checks import STAGES
from hydroelastic.scenes.models.roll_parts import RollParts


class RollScene(RollParts):
    """A ship that rolls on a swell.

    Raises:
        ValidationError: (a ValueError) if a value is not allowed or the parts do not fit together.
    """

    @model_validator(mode="after")
    def _parts_fit(self) -> RollScene:
        require_fit(self, STAGES)
        return self
