"""Solids of revolution in the open sea: the reference cases, and their solutions."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from open_cases import answer, sea, stored

CASES = {case["name"]: case for case in stored("axisymmetric_sea.json")["cases"]}
DENSITY, GRAVITY = 1000.0, 9.81
MOTIONS = ("heave", "surge", "pitch")


def solids(
    bodies: list[dict[str, Any]], depth: float, tolerance: float, *, motions: tuple[str, ...] = MOTIONS, **further: Any
) -> dict[str, Any]:
    """Return the scene of solids; pitch is about the still level; further keys of the scene may be given."""
    common = {"kind": "float", "motions": list(motions), "vertical_centre_of_gravity": 0.0, "unstable": "solve"}
    return sea(*(common | one for one in bodies), depth=depth, tolerance=tolerance) | further


def solved(
    bodies: list[dict[str, Any]], depth: float, tolerance: float, *analyses: dict[str, Any], **further: Any
) -> SimpleNamespace:
    """Solve analyses of the scene; see `solids`."""
    return answer(solids(bodies, depth, tolerance, **further), *analyses)


def radiation(*omega: float) -> dict[str, Any]:
    """Return the analysis of added mass, damping and excitation."""
    return {"kind": "radiation", "omega": list(omega)}


def response(*omega: float, **asked: Any) -> dict[str, Any]:
    """Return the analysis of motions in waves."""
    return {"kind": "response", "omega": list(omega)} | asked


def resonance(**asked: Any) -> dict[str, Any]:
    """Return the analysis of resonances."""
    return {"kind": "resonance"} | asked


def bodies_of(case: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the bodies of a case as they are written in scenes."""
    given = case["inputs"]
    if "list" not in given:
        kind = {"shape": "cylinder", "draught": float(given["draught"])} if "draught" in given else {"shape": "sphere"}
        return [kind | {"radius": float(given["radius"])}]
    bodies, inner = [], 0.0
    for outer, draught, body in given["list"]:
        if body is not None:
            hole = {"inner_radius": inner} if inner else {}
            bodies.append({"shape": "cylinder", "radius": float(outer), "draught": float(draught), **hole})
        inner = float(outer)
    return bodies


def depth_of(case: dict[str, Any]) -> float:
    """Return the depth of a case, m."""
    return float(case["inputs"]["depth"])
