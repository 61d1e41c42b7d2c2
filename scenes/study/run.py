"""Error against cost for one scene: uniform and graded meshes, degrees and tolerances, and observed rates.

See docs/studies.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from hydroelastic.fem.progress import Report
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.study.rates import Gain, Rate, fitted_gain, fitted_rates
from hydroelastic.fem.study.reference import Reference
from hydroelastic.fem.study.row import Family, StudyRow
from hydroelastic.fem.study.series import geometric_rows, nested_rows, tolerance_rows
from hydroelastic.fem.study.studied_tank import StudiedTank
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.physics.tank import Tank
from hydroelastic.scenes.errors import Problem, SceneError, UnsolvedError
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.read import closed_tank
from hydroelastic.scenes.study.plan import StudyPlan
from hydroelastic.scenes.tank.user_mesh import mesh_refused


@dataclass(frozen=True, kw_only=True)
class Study:
    """Results of a study.

    Attributes:
        scene: the scene.
        plan: what was asked.
        tank: of the scene, in its own units.
        reference: what the errors are measured against.
        halves: whether every row solved the tank as two halves.
        rows: all solutions, in the plan's order.
        rates: one for each degree on uniform and algebraic meshes that has enough meshes above rounding.
        gain: what a degree brings on geometric rings; ``None`` if too few degrees show it.
    """

    scene: TankScene
    plan: StudyPlan
    tank: Tank
    reference: Reference
    halves: bool
    rows: tuple[StudyRow, ...] = ()
    rates: tuple[Rate, ...] = ()
    gain: Gain | None = None

    @property
    def reasons(self) -> tuple[str, ...]:
        """Tolerances that were not kept, with reasons; empty if all were."""
        return tuple(f"tolerance {row.tolerance:g}: {reason}" for row in self.rows for reason in row.reasons)

    def rows_of(self, family: Family, degree: int | None = None) -> tuple[StudyRow, ...]:
        """The rows of one family, in their order; of one degree, if it is given."""
        return tuple(row for row in self.rows if row.family == family and degree in (None, row.degree))


def study_scene(scene: TankScene, plan: StudyPlan | None = None, *, report: Report = lambda _message: None) -> Study:
    """Solve a scene in many ways and measure error and cost of each (collective)."""
    closed_tank(scene, "a study measures the errors of frequencies of closed tanks")
    if scene.mesh is not None:
        raise SceneError(
            Problem(key="[mesh]", wrong="a study makes its own meshes", remedy="Leave [mesh] out of the scene")
        )
    try:
        return _study(scene, plan or StudyPlan(), report)
    except EigenSolverError as error:
        raise UnsolvedError(f"the eigen-solver failed: {error}") from error
    except MeshError as error:
        raise mesh_refused(scene, error) from error


def _study(scene: TankScene, plan: StudyPlan, report: Report) -> Study:
    studied = StudiedTank(physical=physical_tank(scene), modes=scene.accuracy.modes)
    report("reference solution")
    parities = studied.reference.parities
    rows = []
    for family in plan.families:
        for row in _rows(studied, plan, family):
            report(f"{family}, degree {row.degree}: {row.unknowns} unknowns, error {row.error:.1e}")
            rows.append(row)
    return Study(
        scene=scene,
        plan=plan,
        tank=studied.tank,
        halves=studied.half,
        reference=studied.reference,
        rows=tuple(rows),
        rates=fitted_rates(studied.tank, rows, parities),
        gain=fitted_gain(studied.tank, rows, parities),
    )


def _rows(studied: StudiedTank, plan: StudyPlan, family: Family) -> Iterator[StudyRow]:
    match family:
        case "uniform" | "algebraic":
            limits = {"halvings": plan.halvings, "most_unknowns": plan.most_unknowns}
            yield from nested_rows(studied, family, plan.degrees, **limits)
        case "geometric":
            yield from geometric_rows(studied, plan.geometric_degrees)
        case "tolerance":
            yield from tolerance_rows(studied, plan.tolerances)
