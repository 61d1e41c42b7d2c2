"""Solids of revolution in the open sea: the reference cases, and their solutions."""

from __future__ import annotations

from typing import Any

from mpi4py import MPI
from open_cases import stored

from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.solve import OpenWaterSolution, solve_open_water
from hydroelastic.fem.stopwatch import Stopwatch
from hydroelastic.scenes.models.sea import SeaScene
from hydroelastic.scenes.open_water.physics import open_water_problem

CASES = {case["name"]: case for case in stored("axisymmetric_sea.json")["cases"]}
DENSITY, GRAVITY = 1000.0, 9.81
MOTIONS = ("heave", "surge", "pitch")


def problem_of(
    bodies: list[dict[str, Any]],
    depth: float,
    tolerance: float,
    *,
    motions: tuple[str, ...] = MOTIONS,
    **further: Any,
) -> OpenWaterProblem:
    """Return the problem of solids; pitch is about the still level; further keys of the scene may be given."""
    body = [{"kind": "float", "motions": list(motions), "vertical_centre_of_gravity": 0.0} | one for one in bodies]
    keys = {
        "liquid": [{"density": DENSITY, "depth": depth}],
        "body": [one | {"unstable": "solve"} for one in body],
        "accuracy": {"tolerance": tolerance},
    }
    return open_water_problem(SeaScene(**keys | further), MPI.COMM_WORLD, Stopwatch())


def solved(
    bodies: list[dict[str, Any]], depth: float, tolerance: float, *requests: Any, **further: Any
) -> OpenWaterSolution:
    """Solve analyses of the problem; see `problem_of`."""
    return solve_open_water(problem_of(bodies, depth, tolerance, **further), requests)


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
