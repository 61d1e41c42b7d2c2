"""Upright tanks with level beds of the reference cases: see `tests/reference/three_dimensions.json`, key `schema`."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

from hydroelastic.fem.level_bed.solution import LevelSolution
from hydroelastic.fem.level_bed.solve import solve_level_tank
from hydroelastic.physics.level_tank import Box, Cylinder, LevelTank
from hydroelastic.physics.plate import Disc, Plate, Strip

FILE = Path(__file__).parents[1] / "reference" / "three_dimensions.json"
CASES: dict[str, dict[str, Any]] = {case["id"]: case for case in json.loads(FILE.read_text(encoding="utf-8"))["cases"]}
SEPARATED = [name for name, case in CASES.items() if case["family"] in ("cylinder_plate", "box_strip")]
"""Cases of concentric plates in cylinders, and of strips of plate or slats in boxes."""


def reference_tank(name: str) -> LevelTank:
    """The tank of a case with strips, discs, rings, or without a plate."""
    given = CASES[name]["inputs"]
    plates = ()
    if "D" in given:
        if "R" in given:
            outline: Disc | Strip = Disc(radius=given.get("a", given["R"]), inner_radius=given.get("b", 0.0))
        else:
            outline = Strip(start=given.get("x1", 0.0), length=given.get("l", given["L"]), width=given["B"])
        plates = (
            Plate(
                outline=outline,
                flexural_rigidity=float(given["D"]),
                mass_per_area=given["m"],
                poisson_ratio=given.get("nu", 0.3),
                hydrostatic=bool(given["s"]),
                slats=given.get("kind") == "slats",
                edge="sliding" if name.startswith("cover") else "free",
            ),
        )
    plan = Cylinder(radius=given["R"]) if "R" in given else Box(length=given["L"], width=given["B"])
    return LevelTank(plan=plan, depth=given["H"], density=given.get("rho", 1000.0), gravity=given["g"], plates=plates)


@cache
def solved(name: str, tolerance: float) -> LevelSolution:
    """The twelve lowest modes of a case, solved once."""
    return solve_level_tank(reference_tank(name), tolerance=tolerance, modes=12)
