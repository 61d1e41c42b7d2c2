"""Which of the report's words a result takes, by what its summary holds."""

from __future__ import annotations

from typing import Literal, TypeAlias, cast

from hydroelastic.output.provenance import Summary

Family: TypeAlias = Literal["tank", "level tank", "open water", "string", "thread", "roll"]


def family_of(summary: Summary) -> Family:
    """Return the family: open water is that of two kinds of scenes, and the kind "tank" has two families.

    Args:
        summary: content of ``summary.json``.
    """
    if "radiation" in summary:
        return "open water"
    kind = summary["scene"]["kind"]
    return "level tank" if kind == "tank" and "floats" not in summary else cast(Family, kind)
