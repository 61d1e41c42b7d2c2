"""Error against cost for one scene: uniform and graded meshes, degrees and tolerances, and the rates they show.

    from hydroelastic.scenes.read import read_scene
    from hydroelastic.scenes.study.run import StudyPlan, study_scene

    study = study_scene(read_scene("aquarium"), StudyPlan(families=("uniform",), degrees=(1, 2)))
    for row in study.rows:
        print(row.degree, row.element_size, row.unknowns, row.error, row.total_seconds)

See docs/studies.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from mpi4py import MPI

from hydroelastic.fem.liquid import compile_form
from hydroelastic.fem.modes import EigenSolverError
from hydroelastic.fem.spectral_error import LOWEST_DEGREE
from hydroelastic.fem.stopwatch import Report, Stopwatch
from hydroelastic.fem.tank.field_model import build_mesh
from hydroelastic.fem.tank.field_solution import solve_field
from hydroelastic.fem.tank.resolution import HIGHEST_DEGREE, initial_resolution
from hydroelastic.physics.symmetry import is_mirror_image
from hydroelastic.scenes.errors import Problem, SceneError, UnsolvedError
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.read import closed_tank
from hydroelastic.scenes.study.plan import Family, StudyPlan
from hydroelastic.scenes.study.rates import Gain, Rate, fitted_gain, fitted_rates
from hydroelastic.scenes.study.reference import Reference, finest_resolution, reference_of
from hydroelastic.scenes.study.rows import StudiedTank, StudyRow
from hydroelastic.scenes.study.series import SERIES
from hydroelastic.scenes.study.thinness import ThinnessRow, check_thinness, thinness_rows


@dataclass(frozen=True, kw_only=True)
class Study:
    """What a study found.

    Attributes:
        scene: the scene.
        plan: what was asked.
        reference: what the errors are measured against; ``None`` if the plan asks for none.
        halves: whether every row solved the tank as two halves.
        rows: all solutions, in the plan's order.
        rates: one for each degree on uniform and algebraic meshes that has enough meshes above rounding.
        gain: what a degree brings on geometric rings; ``None`` if too few degrees show it.
        thinness: both boundaries of a float, from its own width on; empty unless asked for.
    """

    scene: TankScene
    plan: StudyPlan
    reference: Reference | None = None
    halves: bool
    rows: tuple[StudyRow, ...] = ()
    rates: tuple[Rate, ...] = ()
    gain: Gain | None = None
    thinness: tuple[ThinnessRow, ...] = ()

    @property
    def reasons(self) -> tuple[str, ...]:
        """Which tolerances were missed, and why; empty if none was."""
        return tuple(f"tolerance {row.tolerance:g}: {reason}" for row in self.rows for reason in row.reasons)

    def rows_of(self, family: Family, degree: int | None = None) -> tuple[StudyRow, ...]:
        """The rows of one family, in their order; of one degree, if it is given."""
        return tuple(row for row in self.rows if row.family == family and degree in (None, row.degree))


def study_scene(scene: TankScene, plan: StudyPlan | None = None, *, report: Report = lambda _message: None) -> Study:
    """Solve a scene in many ways and measure error and cost of each (collective).

    Args:
        scene: the scene; its own tolerance plays no part.
        plan: what to solve; a minute of it by default.
        report: told what is being done.

    Returns:
        The rows and the rates they show.

    Raises:
        SceneError: if the scene's ends are open, if it brings a mesh of its own, or if it has no float for the thinness
            that is asked for.
        UnsolvedError: if the eigen-solver fails.
    """
    closed_tank(scene, "a study measures the errors of frequencies of closed tanks")
    if scene.mesh is not None:
        raise SceneError(
            Problem(key="[mesh]", wrong="a study makes its own meshes", remedy="Leave [mesh] out of the scene")
        )
    try:
        return _study(scene, plan or StudyPlan(), report)
    except EigenSolverError as error:
        raise UnsolvedError(f"the eigen-solver failed: {error}") from error


def studied_tank(scene: TankScene) -> StudiedTank:
    """Solve for the reference of a closed tank, which all rows of its study share (collective)."""
    tank = physical_tank(scene).scaled()
    half = is_mirror_image(tank)
    return StudiedTank(
        scene=scene,
        tank=tank,
        half=half,
        finest=finest_resolution(scene),
        reference=reference_of(scene, tank, half=half),
    )


def _study(scene: TankScene, plan: StudyPlan, report: Report) -> Study:
    thinness = tuple(_thinness(scene, plan, report))
    if not any(family in SERIES for family in plan.families):
        return Study(scene=scene, plan=plan, halves=is_mirror_image(physical_tank(scene).scaled()), thinness=thinness)
    report("reference solution")
    studied = studied_tank(scene)
    report("forms")
    _compile_forms(studied, plan)
    rows = []
    for family, series in SERIES.items():
        for row in series(studied, plan) if family in plan.families else ():
            report(f"{family}, degree {row.degree}: {row.unknowns} unknowns, error {row.error:.1e}")
            rows.append(row)
    return Study(
        scene=scene,
        plan=plan,
        reference=studied.reference,
        halves=studied.half,
        rows=tuple(rows),
        rates=fitted_rates(scene, rows, studied.reference.parities),
        gain=fitted_gain(scene, rows, studied.reference.parities),
        thinness=thinness,
    )


def _thinness(scene: TankScene, plan: StudyPlan, report: Report) -> Iterator[ThinnessRow]:
    if "thinness" not in plan.families:
        return
    check_thinness(scene)
    for row in thinness_rows(scene, plan.width_halvings):
        report(f"thinness, half width {row.half_width:.3g} m")
        yield row


def _compile_forms(studied: StudiedTank, plan: StudyPlan) -> None:
    """Solve once with each degree that may be needed: a study measures solving, not the compiler."""
    needed: dict[Family, tuple[int, ...]] = {
        "uniform": plan.degrees,
        "algebraic": plan.degrees,
        "geometric": plan.geometric_degrees,
        "tolerance": tuple(range(LOWEST_DEGREE, HIGHEST_DEGREE + 1)),
    }
    degrees = {degree for family in plan.families if family in needed for degree in needed[family]}
    coarse = initial_resolution(studied.tank, studied.scene.accuracy.tolerance, modes=1)
    for degree in sorted(degrees):
        resolution = replace(coarse, degree=degree)
        # Cells at curved contours are of the same degree, and have a form of their own.
        mesh = build_mesh(MPI.COMM_WORLD, studied.tank, resolution, half=studied.half)
        solve_field(mesh, studied.tank, resolution, 1, Stopwatch(), half=studied.half)
        if len(studied.tank.layers) > 1:
            compile_form(mesh, degree, continuous_pressure=True)
