"""Symbols of the quantities of liquids and levels in tables: of two liquids 1 is above and 2 below."""

from __future__ import annotations

from collections.abc import Iterator
from math import isinf

from hydroelastic.physics.dofs import Level
from hydroelastic.scenes.models.tank_parts import TankParts

Group = tuple[str, float, str]
"""A dimensionless group: its symbol, its value and what it means."""


def potential_of(scene: TankParts, layer: int) -> str:
    """Return the name of the potential in a layer: as the liquids, 1 is above and 2 below."""
    return "ψ" if len(scene.layers) == 1 else ("ψₗ", "ψᵤ")[layer]


def jump_of(scene: TankParts, level: Level) -> str:
    """Return the symbol of the density difference across a level."""
    if len(scene.layers) == 1:
        return "ρ"
    return "(ρₗ − ρᵤ)" if level == "interface" else "ρᵤ"


def depth_group(scene: TankParts, name: str, length: float, meaning: str) -> Iterator[Group]:
    """Yield the depth of the lowest liquid over a length of a body, where it is finite."""
    depth = scene.layers[0].depth
    if not isinf(depth):
        yield ("H/" if len(scene.layers) == 1 else "hₗ/") + name, depth / length, meaning
