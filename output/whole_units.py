"""Units of whole solids, of quantities that are declared per metre of width: they have one metre more."""

from __future__ import annotations

import re
from dataclasses import replace

from hydroelastic.output.quantities import Group, Quantity

_WHOLE = {
    "kg/m": "kg",
    "kg": "kg m",
    "kg m": "kg m^2",
    "kg/(m s)": "kg/s",
    "kg/s": "kg m/s",
    "kg m/s": "kg m^2/s",
    "N/m^3": "N/m^2",
    "N/m^2": "N/m",
    "N/m": "N",
    "N": "N m",
    "W/m": "W",
}


def whole_unit(unit: str) -> str:
    """Return the unit of a whole solid for one of a metre of width; units of other quantities stay as they are."""
    return _WHOLE.get(unit, unit)


def of_whole_solids(group: Group) -> Group:
    """Return a group of quantities in the units and words of whole solids."""
    return replace(
        group, parts=tuple(of_whole_solids(part) if isinstance(part, Group) else _whole(part) for part in group.parts)
    )


def _whole(part: Quantity) -> Quantity:
    unit = None if part.unit is None else whole_unit(part.unit)
    meaning = re.sub(r"\broll\b", "pitch", part.meaning)
    return replace(part, meaning=meaning, unit=unit, of_roll=tuple(map(whole_unit, part.of_roll)))
