"""The hanging string on this solver: as a field, by the series, and by its plain sum."""

from __future__ import annotations

import numpy as np
from mpi4py import MPI

from hydroelastic.benchmarks.cases import Answer, Case
from hydroelastic.benchmarks.string.cases import compared, string_scene
from hydroelastic.benchmarks.tank.hydroelastic import versions as versions
from hydroelastic.modal.string.partial_sum import partial_sum
from hydroelastic.modal.string.solution import StringSolution
from hydroelastic.scenes.models.string import StringScene
from hydroelastic.scenes.string.physics import end_motion
from hydroelastic.scenes.string.solve import solve_series, solve_string_field


def prepare(case: Case) -> tuple[Case, StringScene]:
    """The scene, and what is compared."""
    compared(case.tank)
    method = "field" if case.code == "string field" else "series"
    return case, string_scene(case.tank, case.tolerance or 1e-6, method)


def solve(prepared: tuple[Case, StringScene]) -> Answer:
    """Solve for the displacements of a scene, and its free motions."""
    case, scene = prepared
    if case.code == "string sum":
        values = partial_sum(
            scene.string.physical, end_motion(scene), np.array(scene.positions), np.array(scene.times), case.terms
        )
        return Answer(values=tuple(values[compared(case.tank)].tolist()), unknowns=case.terms)
    field = case.code == "string field"
    solution = solve_string_field(scene, MPI.COMM_WORLD) if field else solve_series(scene)
    return Answer(
        values=tuple(solution.displacement[compared(case.tank)].tolist()),
        unknowns=solution.size["dofs" if field else "terms"],
        note=_note(solution),
    )


def _note(solution: StringSolution) -> str:
    steps = f", {solution.size['steps']} steps" if "steps" in solution.size else ""
    return f"estimate {solution.relative_error:.1e}{steps}"
