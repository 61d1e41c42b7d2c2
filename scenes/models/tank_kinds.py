"""Which tanks are of three dimensions, of revolution, or of one section over a width, by the keys of a document."""

from __future__ import annotations

from typing import Any, get_args

from hydroelastic.scenes.models.bodies import Shape
from hydroelastic.scenes.models.revolved_floats import SOLID_SHAPES

_ROUND = ("disc", "ring")
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

    It has a radius, bodies on the axis alone, no columns and no baffles; and a float, an outline of its bed, the shape
    of a sphere or two liquids. Other bodies, those with a position of their own, plates held at the wall of an upright
    tank, beds that are not of revolution, and plates over a level bed are those of a tank in three dimensions.
    """
    tank, bodies = document.get("tank"), document.get("body", [])
    if not isinstance(tank, dict) or "radius" not in tank or not isinstance(bodies, list):
        return False
    if {"inner_radius", "bed", "model"} & tank.keys() or {"column", "baffle"} & document.keys():
        return False
    is_shaped = "outline" in tank or tank.get("shape") == "sphere"
    if not all(isinstance(one, dict) and _is_on_axis(one, is_shaped=is_shaped) for one in bodies):
        return False
    has_float = any(one["kind"] == "float" for one in bodies)
    return has_float or is_shaped or _are_two(document.get("liquid"))


def _are_two(liquids: Any) -> bool:
    return isinstance(liquids, list) and len(liquids) > 1


def _is_on_axis(body: dict[str, Any], *, is_shaped: bool) -> bool:
    is_solid = body.get("kind") == "float" and body.get("shape") in SOLID_SHAPES
    is_round = body.get("kind") == "plate" and body.get("outline") in _ROUND and (is_shaped or "edge" not in body)
    return (is_solid or is_round) and "position" not in body


def is_canal(document: dict[str, Any]) -> bool:
    """Return whether a document of the kind "tank" is of one section over a finite width.

    It has a length and a width, no bodies but floats with the shape of a section, and one of these, an outline of its
    bed or two liquids.
    """
    tank, bodies = document.get("tank"), document.get("body", [])
    if not isinstance(tank, dict) or not {"length", "width"} <= tank.keys() or not isinstance(bodies, list):
        return False
    of_sections = [
        isinstance(one, dict) and one.get("kind") == "float" and one.get("shape") in get_args(Shape) for one in bodies
    ]
    return (
        all(of_sections)
        and (bool(of_sections) or "outline" in tank or _are_two(document.get("liquid")))
        and not ({"bed", "model"} & tank.keys() or {"column", "baffle"} & document.keys())
    )
