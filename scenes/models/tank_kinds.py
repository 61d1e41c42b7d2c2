"""Which tanks are of three dimensions, and which of revolution: told by the keys of a document before it is read."""

from __future__ import annotations

from typing import Any

from hydroelastic.scenes.models.revolved_floats import SOLID_SHAPES

PLAN_KEYS = ("width", "radius", "inner_radius", "plan", "shape")
"""Keys of [tank] by which a tank is one in three dimensions."""


def is_level_tank(document: dict[str, Any]) -> bool:
    """Return whether a document of the kind "tank" is of three dimensions: by a key of its plan, or a plate."""
    tank, bodies = document.get("tank"), document.get("body")
    of_plan = isinstance(tank, dict) and any(key in tank for key in PLAN_KEYS)
    plates = isinstance(bodies, list) and any(isinstance(one, dict) and one.get("kind") == "plate" for one in bodies)
    return of_plan or plates


def is_round_tank(document: dict[str, Any]) -> bool:
    """Return whether a document of the kind "tank" is of revolution.

    It has a radius, and floats on the axis or an outline of its bed, no columns and no baffles. Other bodies, floats
    with a position of their own, and beds that are not of revolution are those of a tank in three dimensions.
    """
    tank, bodies = document.get("tank"), document.get("body", [])
    if not isinstance(tank, dict) or "radius" not in tank or not isinstance(bodies, list):
        return False
    if {"inner_radius", "bed", "model"} & tank.keys() or {"column", "baffle"} & document.keys():
        return False
    on_axis = [
        isinstance(one, dict)
        and one.get("kind") == "float"
        and one.get("shape") in SOLID_SHAPES
        and "position" not in one
        for one in bodies
    ]
    return all(on_axis) and (bool(on_axis) or "outline" in tank)
