"""A loop over the script on NGSolve, a point after the other."""

from __future__ import annotations

import time

from hydroelastic.benchmarks.cases import Answer, Case
from hydroelastic.benchmarks.sweep.cases import tanks
from hydroelastic.benchmarks.tank.ngsolve import solve_tank
from hydroelastic.benchmarks.tank.ngsolve import versions as versions

CLOCK = time.perf_counter
"""As of the sweep that it is compared with."""


def solve(case: Case) -> Answer:
    """Solve all points."""
    start = time.process_time()
    answers = [solve_tank(tank, case.degree, halves=case.variant == "halves") for tank in tanks(case.tank)]
    return Answer(
        values=tuple(value for answer in answers for value in answer.values),
        unknowns=max(answer.unknowns for answer in answers),
        stages={"processor": time.process_time() - start},
    )
