"""Upright tanks with level beds of the reference cases, as documents of scenes; see `three_dimensions.json`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

import hydroelastic as he

FILE = Path(__file__).parents[1] / "reference" / "three_dimensions.json"
CASES: dict[str, dict[str, Any]] = {case["id"]: case for case in json.loads(FILE.read_text(encoding="utf-8"))["cases"]}


def tank(plan: dict[str, Any], depth: float, *bodies: dict[str, Any], **keys: Any) -> dict[str, Any]:
    """A document of a tank of water with bodies; ``keys`` are other tables of it."""
    liquid = [{"density": 1000.0, "depth": depth}]
    return {"kind": "tank", "tank": plan, "liquid": liquid, "body": list(bodies)} | keys


def plate(outline: str, rigidity: float, mass: float, **keys: Any) -> dict[str, Any]:
    """A plate of flexural rigidity D, N·m, infinite if it is rigid, and mass per area m, kg/m²."""
    stiffness = {"rigid": True} if rigidity == np.inf else {"flexural_rigidity": rigidity}
    return {"kind": "plate", "outline": outline, "mass_per_area": mass} | stiffness | keys


def reference_tank(name: str) -> dict[str, Any]:
    """The tank of a case without a float, in the smallest of its models."""
    given = CASES[name]["inputs"]
    if name == "slosh_triangle":
        side = given["side"]
        return tank({"plan": [[0.0, 0.0], [side, 0.0], [side / 2.0, side * np.sqrt(0.75)]]}, given["H"])
    plan = {"radius": given["R"]} if "R" in given else {"length": given["L"], "width": given["B"]}
    if "D" not in given:
        return tank(plan, given["H"])
    common: dict[str, Any] = {"hydrostatic": bool(given["s"])}
    if given.get("kind") == "slats":
        beam = {"kind": "beam", "start": given["x1"], "length": given["l"]} | common
        beam |= {"flexural_rigidity": given["D"], "mass_per_length": given["m"]}
        return tank(plan, given["H"], beam)
    if name.startswith("cover"):
        common["edge"] = "sliding"
    if "R" in given:
        inner = given.get("b", 0.0)
        outline = "ring" if inner else "disc"
        shape: dict[str, Any] = {"radius": given.get("a", given["R"])} | ({"inner_radius": inner} if inner else {})
    elif "x1" in given:
        outline, shape = "strip", {"start": given["x1"], "length": given["l"]}
    else:
        outline, shape = "rectangle", {"size": [given.get("l", given["L"]), given.get("b", given["B"])]}
    return tank(plan, given["H"], plate(outline, float(given["D"]), given["m"], **shape, **common))


def solved(document: dict[str, Any], tolerance: float, modes: int) -> he.Result:
    result = he.solve(document | {"accuracy": {"tolerance": tolerance, "modes": modes}})
    assert result.summary["status"] == "ok", result.summary["reasons"]
    return result


def frequencies(result: he.Result, column: str = "omega") -> np.ndarray:
    """ω, rad/s, or another column of the modes, each as often as it occurs."""
    times = result.modes.multiplicity if "multiplicity" in result.modes.dtype.names else 1
    return np.repeat(result.modes[column], times)


def reference(name: str) -> np.ndarray:
    """ω of a case, rad/s, each as often as it occurs."""
    return np.repeat(CASES[name]["omega"], CASES[name].get("multiplicity", [1] * len(CASES[name]["omega"])))
