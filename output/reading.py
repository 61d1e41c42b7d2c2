"""Values of a summary as sections, studies and benchmarks read them: by the declared quantities, never by keys."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from hydroelastic.output.quantities import Group, Quantity


@dataclass(frozen=True)
class Reading:
    """The values of one record of a group, as ``summary.json`` has them: ``mode[OMEGA]``, ``tone[NOTE]``.

    A name that is not declared is found by mypy and at the import; a quantity of another group raises an error.

    Attributes:
        group: which declares them.
        values: by key.
    """

    group: Group
    values: Mapping[str, Any]

    def __getitem__(self, part: Quantity | Group) -> Any:
        """Return a value; of a group its reading, a list of them, or a dictionary of them by labels; or ``None``."""
        self._check(part)
        found = self.values[part.key]
        if isinstance(part, Quantity) or found is None:
            return found
        if isinstance(found, list):
            return [Reading(part, one) for one in found]
        return {label: Reading(part, one) for label, one in found.items()} if part.dimension else Reading(part, found)

    def __contains__(self, part: Quantity | Group) -> bool:
        """Return whether the values have a declared part, which solutions of some kinds lack."""
        self._check(part)
        return part.key in self.values

    def __or__(self, others: Mapping[Quantity, Any]) -> Reading:
        """Return the reading with other values of some quantities, as they are to be printed."""
        return replace(self, values={**self.values, **{quantity.key: value for quantity, value in others.items()}})

    def without(self, *quantities: Quantity) -> Reading:
        """Return the reading without some quantities, which are not to be printed."""
        left_out = [quantity.key for quantity in quantities]
        return replace(self, values={key: value for key, value in self.values.items() if key not in left_out})

    def cell(self, quantity: Quantity) -> str:
        """Return a value as it is printed: in its declared format, or with the digits that are certain by its error."""
        self._check(quantity)
        return quantity.cell(self.values, self.group)

    def _check(self, part: Quantity | Group) -> None:
        if part not in self.group.parts:
            raise KeyError(f"{self.group.meaning}: {part.key!r} is not declared there")
