"""The basin on this solver: modes to a tolerance, with estimate and count."""

from __future__ import annotations

from hydroelastic.benchmarks.basin.cases import basin_named
from hydroelastic.benchmarks.cases import Answer, Case
from hydroelastic.benchmarks.tank.hydroelastic import versions as versions
from hydroelastic.fem.level_bed.choice import LevelModel
from hydroelastic.fem.plan.solve import solve_smallest_model


def solve(case: Case) -> Answer:
    """Solve the basin to the tolerance of a case."""
    basin = basin_named(case.tank)
    solution = solve_smallest_model(
        basin.tank, tolerance=case.tolerance, modes=len(basin.omega), tones=False, model=_MODELS[case.variant]
    )
    error = max(one.relative_error for one in solution.modes)
    return Answer(
        values=tuple(solution.omega(one.mode.eigenvalue) for one in solution.modes),
        unknowns=solution.size["dofs"],
        note=f"estimate {error:.1e}",
    )


_MODELS: dict[str, LevelModel | None] = {"certified": None, "triangles": "plan"}
