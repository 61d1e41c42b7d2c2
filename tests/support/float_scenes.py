"""Scenes with floats as dictionaries, and what is said of one that is refused."""

from __future__ import annotations

from typing import Any

import pytest

import hydroelastic as he

WEDGE: dict[str, Any] = {"kind": "float", "shape": "wedge", "position": 5.0, "half_width": 0.5, "half_height": 0.4}
BARGE: dict[str, Any] = {
    "kind": "float",
    "shape": "rectangle",
    "half_width": 1.0,
    "half_height": 0.5,
    "vertical_centre_of_gravity": 0.1,
    "radius_of_gyration": 0.8,
    "motions": ["heave", "sway", "roll"],
}
WATER, OIL, AIR = ({"density": density, "depth": depth} for density, depth in ((1000.0, 2.0), (800.0, 1.0), (0.0, 1.0)))
SQUARE = ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))


def document(*bodies: dict[str, Any], liquids: tuple[dict[str, Any], ...] = (WATER, OIL), **more: Any) -> Any:
    """The keys of a scene."""
    tank = {"length": 10.0} | {key: more.pop(key) for key in ("top", "length") if key in more}
    return {"kind": "tank", "tank": tank, "liquid": list(liquids), "body": list(bodies)} | more


def scene(*bodies: dict[str, Any], **changes: Any) -> he.TankScene:
    """A scene that is accepted."""
    return he.read(document(*bodies, **changes))


def said(*bodies: dict[str, Any], **changes: Any) -> str:
    """What is said of a scene that is refused for one reason."""
    with pytest.raises(he.SceneError) as caught:
        he.read(document(*bodies, **changes))
    text = str(caught.value)
    assert "\n" not in text
    return text


def polygon(*vertices: tuple[float, float], **more: Any) -> dict[str, Any]:
    return {"kind": "float", "shape": "polygon", "position": 5.0, "vertices": [list(v) for v in vertices]} | more
