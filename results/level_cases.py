"""Measure hard tanks in three dimensions: true error, estimate and cost of each case at each tolerance.

    ./hydro python results/level_cases.py [NAMES]

The reference of a case is a far finer solution. It writes
results/level_cases/level_cases.csv and level_cases.md, which docs/hard_cases.md refers to. Processor seconds are of one
run on the machine at hand, without imports and first elastic tones.
"""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass, replace
from math import inf
from typing import Any

import numpy as np
from case_files import write_cases

from hydroelastic.fem.plan.solve import solve_smallest_model
from hydroelastic.physics.level_tank import Box, Cylinder, LevelTank
from hydroelastic.physics.plate import Disc, Plate, Polygon, Rectangle

WATER = {"density": 1000.0, "gravity": 9.81}


@dataclass(frozen=True, kw_only=True)
class LevelCase:
    """A tank with what it is asked for.

    Attributes:
        tank: in SI units.
        tolerances: asked relative errors.
        finest: tolerance of the reference.
        modes: number of modes.
    """

    tank: LevelTank
    tolerances: tuple[float, ...] = (1e-4, 1e-6)
    finest: float = 1e-8
    modes: int = 8


def _box(plate: Plate, depth: float = 3.0) -> LevelTank:
    return LevelTank(plan=Box(length=10.0, width=8.0), depth=depth, plates=(plate,), **WATER)


_COVER = Plate(outline=Rectangle(position=(5.0, 4.0), size=(4.0, 3.0)), flexural_rigidity=5e3, mass_per_area=50.0)
_RING = Disc(radius=4.0, inner_radius=3.8)
_L_SHAPE = Polygon(points=((2.0, 1.5), (8.0, 1.5), (8.0, 3.5), (5.0, 3.5), (5.0, 6.0), (2.0, 6.0)))

CASES = {
    "two outlines in one tank": LevelCase(
        tank=LevelTank(
            plan=Box(length=10.0, width=6.0),
            depth=2.0,
            plates=(
                replace(_COVER, outline=Rectangle(position=(2.5, 3.0), size=(3.0, 2.0))),
                Plate(outline=Disc(position=(7.0, 3.2), radius=1.2), flexural_rigidity=1e4, mass_per_area=80.0),
            ),
            **WATER,
        ),
        tolerances=(1e-3, 1e-5),
        finest=3e-7,
    ),
    "a plate with a re-entrant corner": LevelCase(
        tank=_box(replace(_COVER, outline=_L_SHAPE)),
        tolerances=(1e-3, 1e-5),
        finest=3e-7,
    ),
    "1e-3 tank lengths from a wall": LevelCase(
        tank=_box(replace(_COVER, outline=Rectangle(position=(2.01, 4.0), size=(4.0, 3.0))))
    ),
    "depth 0.01 tank lengths": LevelCase(tank=_box(_COVER, 0.1)),
    "depth 10 tank lengths": LevelCase(tank=_box(_COVER, 100.0)),
    "very soft plate": LevelCase(tank=_box(replace(_COVER, flexural_rigidity=0.5))),
    "rigid plate": LevelCase(tank=_box(replace(_COVER, flexural_rigidity=inf, mass_per_area=300.0))),
    "100 modes": LevelCase(tank=_box(_COVER), tolerances=(1e-3, 1e-5), finest=1e-7, modes=100),
    "narrow ring": LevelCase(
        tank=LevelTank(
            plan=Cylinder(radius=5.0),
            depth=3.0,
            plates=(Plate(outline=_RING, flexural_rigidity=2e4, mass_per_area=50.0),),
            **WATER,
        ),
        tolerances=(1e-6, 1e-9),
        finest=1e-11,
    ),
}
COLUMNS = ("case", "tolerance", "status", "model", "modes", "true_error", "estimate", "seconds", "unknowns")


def frequencies(case: LevelCase, tolerance: float) -> tuple[np.ndarray, Any]:
    """The lowest frequencies, each as often as it occurs, and the solution."""
    solution = solve_smallest_model(case.tank, tolerance=tolerance, modes=case.modes, tones=False)
    omega = [solution.omega(one.mode.eigenvalue) for one in solution.modes for _ in range(one.problem.multiplicity)]
    return np.array(omega[: case.modes]), solution


def measured(name: str, case: LevelCase, reference: np.ndarray, tolerance: float) -> dict[str, Any]:
    """A row: the largest true error and estimate over the modes, and what they cost."""
    start = time.process_time()
    omega, solution = frequencies(case, tolerance)
    return {
        "case": name,
        "tolerance": tolerance,
        "status": "unconverged" if solution.reasons else "ok",
        "model": solution.model.split(":")[0],
        "modes": case.modes,
        "true_error": float(np.abs(omega / reference - 1.0).max()),
        "estimate": max(one.relative_error for one in solution.modes),
        "seconds": time.process_time() - start,
        "unknowns": solution.size["dofs"],
    }


def markdown(rows: list[dict[str, Any]]) -> str:
    """The table for a page: largest true error / largest estimate, processor seconds."""
    lines = [
        "# Hard tanks in three dimensions, measured",
        "",
        "Made by `./hydro python results/level_cases.py`, where the cases are. The reference of each is a far finer",
        "solution.",
        "",
        "| case | modes | tolerance | largest true error | largest estimate | processor seconds | unknowns |",
        "|---" * 7 + "|",
    ]
    for row in rows:
        status = "" if row["status"] == "ok" else ", *unconverged*"
        lines.append(
            f"| {row['case']} | {row['modes']} | {row['tolerance']:.0e} | {row['true_error']:.1e} | "
            f"{row['estimate']:.1e}{status} | {row['seconds']:.2f} | {row['unknowns']} |"
        )
    return "\n".join([*lines, ""])


def main(names: list[str]) -> None:
    """Solve every case at every tolerance and write the tables."""
    rows = []
    for name in names or CASES:
        case = CASES[name]
        reference, _ = frequencies(case, case.finest)
        for tolerance in case.tolerances:
            rows.append(measured(name, case, reference, tolerance))
            print(*rows[-1].values(), sep=", ", flush=True)
    if not names:
        write_cases("level_cases", COLUMNS, rows, markdown(rows))


if __name__ == "__main__":
    main(sys.argv[1:])
