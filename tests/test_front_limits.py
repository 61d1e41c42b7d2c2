"""A value that a message names as the limit is accepted, whatever digits the limit has."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hydroelastic as he

Document = dict[str, Any]


def _read(folder: Path, document: Document) -> str:
    """Read a scene; return what is said of it if it is refused, else nothing."""
    file = folder / "scene.toml"
    file.write_text("".join(f"{key} = {_toml(value)}\n" for key, value in document.items()), encoding="utf-8")
    try:
        he.read(file)
    except he.SceneError as error:
        return str(error)
    return ""


def _toml(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {_toml(inner)}" for key, inner in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    return json.dumps(value) if isinstance(value, str | bool) else repr(float(value))


def tank(size: float, *bodies: Document, **more: Any) -> Document:
    return {
        "kind": "tank",
        "tank": {"length": 10.0 * size} | more,
        "liquid": [{"density": 1000.0, "depth": 5.0 * size}],
        "body": list(bodies),
    }


def beam(size: float, **more: Any) -> Document:
    whole = {"start": size, "length": 2.0 * size, "flexural_rigidity": 5e3 * size**4, "mass_per_length": 100.0 * size}
    return whole | more


def box(size: float, **more: Any) -> Document:
    whole = {"kind": "float", "shape": "rectangle", "position": 5.0, "half_width": 1.0, "half_height": 0.5}
    return whole | {key: size * whole[key] for key in ("position", "half_width", "half_height")} | more


def ring(size: float, inner: float) -> Document:
    return {
        "kind": "tank",
        "tank": {"radius": size, "inner_radius": inner},
        "liquid": [{"density": 1000.0, "depth": size}],
    }


def deep(size: float, depth: float) -> Document:
    return tank(size) | {"liquid": [{"density": 1000.0, "depth": depth}], "body": []}


def oil(density: float, upper: float) -> Document:
    return tank(1.0) | {"liquid": [{"density": density, "depth": 1.0}, {"density": upper, "depth": 1.0}], "body": []}


def disc(size: float, radius: float) -> Document:
    plate = {"kind": "plate", "outline": "disc", "radius": radius, "rigid": True, "mass_per_area": 1.0}
    return ring(size, size) | {"tank": {"width": 2.0 * size, "length": 3.0 * size}, "body": [plate]}


def beside(size: float, position: float) -> Document:
    return tank(size, box(size), box(size, position=position, half_width=0.5 * size))


def swell(size: float, omega: float) -> Document:
    circle = {"kind": "float", "shape": "ellipse", "position": 5.0 * size, "half_width": size, "half_height": size}
    asked = {"analysis": [{"kind": "radiation", "omega": [omega]}]}
    return tank(size, circle, ends="open") | {"liquid": [{"density": 1000.0, "depth": 9.0 * size}]} | asked


# What makes a scene of a size and a value; a value that is refused, in sizes; which of the numbers that the message
# allows is meant; and how it is a value.
CASES: dict[str, tuple[Callable[[float, float], Document], float, int, Callable[[float, float], float]]] = {
    "outermost wall of a ring": (ring, 0.99999, 1, lambda _size, named: named),
    "innermost wall of a ring": (ring, 1e-9, 0, lambda _size, named: named),
    "least depth": (deep, 1e-9, 0, lambda _size, named: named),
    "greatest depth": (deep, 1e9, 1, lambda _size, named: named),
    "last start of a beam": (lambda size, x: tank(size, beam(size, start=x)), 9.0, 1, lambda _size, named: named),
    "shortest beam": (lambda size, x: tank(size, beam(size, length=x)), 1e-9, 0, lambda _size, named: named),
    "softest beam": (
        lambda size, x: tank(size, beam(size, flexural_rigidity=x)),
        1e-19,
        0,
        lambda _size, named: named,
    ),
    "lightest beam": (lambda size, x: tank(size, beam(size, mass_per_length=x)), 1e-12, 0, lambda _s, named: named),
    "first place of a float": (
        lambda size, x: tank(size, box(size, position=x)),
        0.5,
        0,
        lambda _size, named: named,
    ),
    "last place of a float": (
        lambda size, x: tank(size, box(size, position=x)),
        9.9,
        1,
        lambda _size, named: named,
    ),
    "smallest float": (
        lambda size, x: tank(size, box(size, half_width=x, half_height=x)),
        1e-9,
        0,
        lambda _size, named: 0.5 * named,
    ),
    "nearest floats": (beside, 6.50001, -1, lambda size, gap: 6.0 * size + gap + 0.5 * size),
    "highest centre of mass": (
        lambda size, x: tank(size, box(size, centre_of_mass=x, motions=["heave", "roll"])),
        9.0,
        0,
        lambda _size, named: named,
    ),
    "narrowest plate": (disc, 1e-9, 0, lambda _size, named: 0.5 * named),
    "slowest waves": (swell, 1e-9, 0, lambda _size, named: named),
    "fastest waves": (swell, 1e9, 1, lambda _size, named: named),
    "lightest upper liquid": (oil, 1e-9, 1, lambda _size, named: named),
}
# Sizes with few digits, whose limits differ by rounding of products, and with all.
SIZES = [1.1, 0.7, 3.3, *np.random.default_rng(13).uniform(0.1, 10.0, 4).tolist()]


@pytest.mark.parametrize("case", CASES)
def test_the_limit_that_is_named_is_accepted(case: str, tmp_path: Path) -> None:
    scene_of, wrong, place, value_of = CASES[case]
    for size in SIZES:
        refused = _read(tmp_path, scene_of(size, wrong * size))
        assert refused, (case, size)
        said = refused.split("Allowed:")[-1] if place >= 0 else refused.split("at least")[-1]
        named = float(re.findall(r"\d[\d.]*(?:e[+-]?\d+)?", said.replace(" m.", " m"))[max(place, 0)])
        again = _read(tmp_path, scene_of(size, value_of(size, named)))
        assert not again, f"{refused}\n{again}"
        # The check is still there: a hundredth beyond the limit is refused.
        beyond = named / 1.01 if place < 0 or named > wrong * size else named * 1.01
        assert _read(tmp_path, scene_of(size, value_of(size, beyond))), (case, size, named)
