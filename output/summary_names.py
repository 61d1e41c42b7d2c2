"""Names of the variables of summaries whose quantities are not declared yet."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from hydroelastic.output.long_names import long_name_of
from hydroelastic.output.summary_units import unit_of

# Tables that all summaries have.
_DIMENSIONS = {"timing": ("stage",), "versions": ("package",), "reasons": ("reason",)}


@dataclass(frozen=True, kw_only=True)
class SummaryNames:
    """Names of the tables in the summary of a kind of scene. A place is the keys that lead to it, joined by dots.

    Attributes:
        by_place: of the list at a place, one for each level of lists within lists; of a dictionary whose keys are
            labels, one. Those of other lists are named after their place.
        prefixes: prefix that replaces a place in the names of the variables below it.
        units: of numbers at a place, where the key does not determine it.
        reported_by_arrays: places that are left out because the labelled arrays contain the same.
    """

    by_place: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    prefixes: Mapping[str, str] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    reported_by_arrays: frozenset[str] = frozenset()

    def dimensions(self, place: str) -> tuple[str, ...]:
        """Return the dimensions of a list."""
        return self.by_place.get(place, _DIMENSIONS.get(place, ()))

    def name(self, place: str, default: str) -> str | None:
        """Return the name of a variable, or the prefix of those below."""
        return None if place in self.reported_by_arrays else self.prefixes.get(place, default)

    def attributes(self, place: str) -> dict[str, Any]:
        """Return long name and unit."""
        unit = self.units.get(place, unit_of(place))
        return {"long_name": long_name_of(place)} | ({} if unit is None else {"units": unit})
