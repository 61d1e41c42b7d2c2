"""The scene of a hanging string: its model with all checks."""

from __future__ import annotations

from pydantic import model_validator

from hydroelastic.scenes.models.problems import require_fit
from hydroelastic.scenes.models.string_checks import STAGES
from hydroelastic.scenes.models.string_parts import StringParts


class StringScene(StringParts):
    """A heavy string that hangs in a resisting medium while its upper end is moved.

    Raises:
        ValidationError: (a ValueError) if a value is not allowed or the parts do not fit together.
    """

    @model_validator(mode="after")
    def _parts_fit(self) -> StringScene:
        require_fit(self, STAGES)
        return self
