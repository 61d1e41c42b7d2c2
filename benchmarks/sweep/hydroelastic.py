"""A sweep by this solver, on one process or two: certified results at every point, without pictures and estimates."""

from __future__ import annotations

import time

from hydroelastic.benchmarks.cases import Answer, Case
from hydroelastic.benchmarks.sweep.cases import SWEEPS
from hydroelastic.benchmarks.tank import hydroelastic as hydroelastic_tank
from hydroelastic.benchmarks.tank.hydroelastic import versions as versions
from hydroelastic.output.provenance import read_summary
from hydroelastic.output.tank.quantities import DOFS, MODE_OMEGA, MODES, SIZE, TANK
from hydroelastic.scenes.sweep.axes import grid_from_values
from hydroelastic.scenes.sweep.families import last_liquids
from hydroelastic.scenes.sweep.run import SweepOptions, solve_sweep

CLOCK = time.perf_counter
"""Several processes share the work."""


def solve(case: Case) -> Answer:
    """Solve all points."""
    sweep, jobs = SWEEPS[case.tank], 2 if case.variant == "two processes" else 1
    scene = hydroelastic_tank.prepare(
        Case(code="hydroelastic", tank="base_s0", variant="certified", tolerance=case.tolerance)
    )
    # What an earlier round left of the same liquid would be no work of this one.
    last_liquids.clear()
    start = time.process_time()
    solved = solve_sweep(
        scene, grid_from_values({sweep.key: sweep.values}), options=SweepOptions(jobs=jobs, follow=False)
    )
    # That of other processes is not known before they end.
    stages = {"processor": time.process_time() - start} if jobs == 1 else {}
    told = [read_summary(point.summary or {}, TANK) for point in solved.points]
    return Answer(
        values=tuple(mode[MODE_OMEGA] for summary in told for mode in summary[MODES]),
        unknowns=max(summary[SIZE][DOFS] for summary in told),
        stages=stages,
        note="; ".join(solved.complaints),
    )
