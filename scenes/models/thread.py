"""The scene of a flexible thread in a stream: its model with all checks."""

from __future__ import annotations

from pydantic import model_validator

from hydroelastic.scenes.models.problems import require_fit
from hydroelastic.scenes.models.thread_checks import STAGES
from hydroelastic.scenes.models.thread_parts import ThreadParts


class ThreadScene(ThreadParts):
    """A flexible thread in a stream.

    Raises:
        ValidationError: (a ValueError) if a value is not allowed or the parts do not fit together.
    """

    @model_validator(mode="after")
    def _parts_fit(self) -> ThreadScene:
        require_fit(self, STAGES)
        return self
