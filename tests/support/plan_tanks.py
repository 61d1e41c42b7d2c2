"""Tanks with level beds of `reference/three_dimensions.json`, and others made by hand."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from hydroelastic.physics.level_tank import Box, Cylinder, LevelTank, PolygonPlan
from hydroelastic.physics.plate import Disc, Edge, Outline, Plate, Rectangle, Strip

WATER = {"density": 1000.0, "gravity": 9.81}
CASES: dict[str, Any] = {
    case["id"]: case
    for case in json.loads((Path(__file__).parents[1] / "reference" / "three_dimensions.json").read_text())["cases"]
}


def frequencies(name: str) -> np.ndarray:
    """The lowest ω of a case, each as often as it occurs, rad/s."""
    case = CASES[name]
    return np.sort(np.repeat(case["omega"], case["multiplicity"]))


def reference_tank(name: str, edge: Edge = "free") -> LevelTank:
    """The tank of a case."""
    case = CASES[name]
    given = case["inputs"]
    if name == "slosh_triangle":
        side = given["side"]
        corners = ((0.0, 0.0), (side, 0.0), (0.5 * side, side * np.sqrt(0.75)))
        return LevelTank(plan=PolygonPlan(points=corners), depth=given["H"], **WATER)
    plan = Cylinder(radius=given["R"]) if "R" in given else Box(length=given["L"], width=given["B"])
    if "D" not in given:
        return LevelTank(plan=plan, depth=given["H"], **WATER)
    outline: Outline
    if "R" in given:
        outline = Disc(radius=given.get("a", given["R"]), inner_radius=given.get("b", 0.0))
    elif "x1" in given:
        outline = Strip(start=given["x1"], length=given["l"], width=given["B"])
    else:
        size = given.get("l", given["L"]), given.get("b", given["B"])
        outline = Rectangle(position=(0.5 * given["L"], 0.5 * given["B"]), size=size)
    plate = Plate(
        outline=outline,
        flexural_rigidity=float(given["D"]),
        mass_per_area=given["m"],
        poisson_ratio=given.get("nu", 0.3),
        hydrostatic=bool(given["s"]),
        edge=edge,
    )
    return LevelTank(plan=plan, depth=given["H"], plates=(plate,), **WATER)
