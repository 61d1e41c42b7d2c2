"""Error against cost for one scene: uniform meshes, graded meshes of rising degree, and rising tolerances.

The error is the largest relative error of the frequencies asked for, against a much finer solution of the scene (or
its closed form). Rates are fitted, and set beside what theory expects of the singularity at the tips.
"""

from __future__ import annotations

import resource
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.modes import solve_modes
from hydroelastic.scenes.errors import Problem, SceneError
from hydroelastic.scenes.estimates import exact_frequencies
from hydroelastic.scenes.field_model import build_field_model, build_mesh
from hydroelastic.scenes.field_solution import Stopwatch
from hydroelastic.scenes.models import Accuracy, TankScene
from hydroelastic.scenes.plan import HIGHEST_DEGREE, Resolution, ScaledTank, initial_resolution, scaled_tank
from hydroelastic.scenes.scaling import scales
from hydroelastic.scenes.solve import Report, solve_scene

Family = Literal["uniform", "graded", "tolerance"]

UNIFORM_DEGREES = (1, 2, 3)
UNIFORM_REFINEMENTS = 5
GRADED_DEGREES = tuple(range(2, HIGHEST_DEGREE + 1))
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
# Errors below this are rounding; they take no part in a fit.
ROUNDING = 1e-11


@dataclass(frozen=True, kw_only=True)
class StudyRow:
    """One solution of a study.

    Attributes:
        family: which series it belongs to.
        degree: of ψ.
        size: largest element in tank lengths (uniform meshes), else ``None``.
        tolerance: asked relative error (series of tolerances), else ``None``.
        dofs: unknowns of ψ and of the surface.
        error: largest relative error of the frequencies asked for.
        lowest_error: relative error of the lowest one; rates are fitted to it, for coarse meshes resolve it.
        estimate: largest estimated relative error (series of tolerances), else ``None``.
        seconds: time by stage.
        memory: peak memory of the process so far, bytes.
    """

    family: Family
    degree: int
    size: float | None
    tolerance: float | None
    dofs: int
    error: float
    lowest_error: float
    estimate: float | None
    seconds: dict[str, float]
    memory: int

    @property
    def total_seconds(self) -> float:
        """Time of all stages."""
        return sum(self.seconds.values())


@dataclass(frozen=True, kw_only=True)
class Rate:
    """An observed order of convergence.

    Attributes:
        degree: of ψ.
        observed: fitted p in error ~ hᵖ.
        expected: what theory expects.
        points: how many meshes the fit used.
    """

    degree: int
    observed: float
    expected: float
    points: int


@dataclass(frozen=True, kw_only=True)
class Study:
    """Rows of all series, and the rates of the uniform ones.

    Attributes:
        scene: the scene.
        reference: what the errors are measured against.
        rows: all solutions.
        rates: one for each degree of the uniform series.
    """

    scene: TankScene
    reference: str
    rows: tuple[StudyRow, ...]
    rates: tuple[Rate, ...]


def study_scene(scene: TankScene, *, report: Report = lambda _message: None) -> Study:
    """Solve a scene in many ways and measure error and cost of each (collective).

    Args:
        scene: the scene; its own tolerance plays no part.
        report: told what is being done.

    Returns:
        The study.

    Raises:
        SceneError: if the scene brings a mesh of its own.
    """
    if scene.mesh is not None:
        raise SceneError(
            Problem(key="[mesh]", wrong="a study makes its own meshes", remedy="Leave [mesh] out of the scene")
        )
    tank = scaled_tank(scene)
    report("reference solution")
    name, exact = _reference(scene, tank)
    # Compile the forms of every degree first: a study measures solving, not the compiler.
    report("forms")
    for _ in _graded(scene, tank, exact):
        pass
    rows: list[StudyRow] = []
    for series in (_uniform(scene, tank, exact), _graded(scene, tank, exact), _tolerances(scene, exact)):
        for row in series:
            report(f"{row.family}, degree {row.degree}: {row.dofs} unknowns, error {row.error:.1e}")
            rows.append(row)
    return Study(scene=scene, reference=name, rows=tuple(rows), rates=_rates(scene, rows))


def expected_order(scene: TankScene, degree: int) -> float:
    """Order of the frequencies on uniform meshes: min(2p, 2α) with ψ ~ r^α at the worst point (r^α ln r counts as α).

    α = 1 at a tip beside water under gravity or a lid, 1/2 where ψ = 0 on the water, 2 where a free end meets a wall;
    a smooth ψ has no such limit. Source: theory of the aquarium, docs, convergence.
    """
    if not scene.body or scene.body[0].ends == "guided":
        return 2.0 * degree
    covered = sum(beam.length for beam in scene.body) >= scene.tank.length * (1.0 - 1e-9)
    alpha = 2.0 if covered else 0.5 if scene.tank.top == "pressure_release" else 1.0
    return min(2.0 * degree, 2.0 * alpha)


def _reference(scene: TankScene, tank: ScaledTank) -> tuple[str, np.ndarray]:
    formula, frequencies = exact_frequencies(scene)
    if frequencies:
        return formula, np.array(frequencies)
    fine = _finest(scene)
    resolution = replace(fine, degree=HIGHEST_DEGREE, surface_sizes=tuple(0.7 * size for size in fine.surface_sizes))
    omega, _, _ = _solve(scene, tank, resolution)
    return f"graded mesh of degree {HIGHEST_DEGREE}, {sum(resolution.shapes)} dry modes", omega


def _finest(scene: TankScene) -> Resolution:
    """Sizes, tips and dry modes for a tolerance that no row reaches."""
    strict = scene.model_copy(update={"accuracy": Accuracy(tolerance=1e-11, modes=scene.accuracy.modes)})
    return initial_resolution(strict, modes=scene.accuracy.modes)


def _solve(scene: TankScene, tank: ScaledTank, resolution: Resolution) -> tuple[np.ndarray, int, dict[str, float]]:
    """ω of the modes asked for in rad/s, number of unknowns, seconds by stage."""
    watch = Stopwatch()
    with watch.stage("mesh"):
        mesh = build_mesh(MPI.COMM_WORLD, tank, resolution)
    with watch.stage("assemble"):
        pencil = build_field_model(mesh, tank, degree=resolution.degree, shapes=resolution.shapes)
    with watch.stage("solve"):
        modes = solve_modes(pencil, scene.accuracy.modes, shapes=0)
    omega = np.sqrt(modes.eigenvalues) * scales(scene).frequency
    return omega, pencil.liquid.size + pencil.size, watch.seconds


def _row(family: Family, scene: TankScene, tank: ScaledTank, resolution: Resolution, exact: np.ndarray) -> StudyRow:
    omega, dofs, seconds = _solve(scene, tank, resolution)
    errors = _errors(omega, exact)
    return StudyRow(
        family=family,
        degree=resolution.degree,
        size=resolution.bulk_size if family == "uniform" else None,
        tolerance=None,
        dofs=dofs,
        error=float(errors.max()),
        lowest_error=float(errors[0]),
        estimate=None,
        seconds=seconds,
        memory=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024,
    )


def _errors(omega: np.ndarray, exact: np.ndarray) -> np.ndarray:
    """Relative errors of the frequencies that both have."""
    shared = min(len(omega), len(exact))
    errors: np.ndarray = np.abs(omega[:shared] / exact[:shared] - 1.0)
    return errors


def _uniform(scene: TankScene, tank: ScaledTank, exact: np.ndarray) -> Iterator[StudyRow]:
    """Meshes of one element size, halved again and again."""
    fine = _finest(scene)
    coarsest = min(0.125, 0.5 * min(end - start for start, end, _ in tank.pieces), 0.5 * tank.depth)
    for degree in UNIFORM_DEGREES:
        for refinement in range(UNIFORM_REFINEMENTS):
            size = coarsest / 2**refinement
            sizes = tuple(size for _ in tank.pieces)
            resolution = replace(fine, degree=degree, surface_sizes=sizes, bulk_size=size, tip_size=None)
            yield _row("uniform", scene, tank, resolution, exact)


def _graded(scene: TankScene, tank: ScaledTank, exact: np.ndarray) -> Iterator[StudyRow]:
    """One mesh with rings around the tips, degree by degree."""
    fine = _finest(scene)
    for degree in GRADED_DEGREES:
        yield _row("graded", scene, tank, replace(fine, degree=degree), exact)


def _tolerances(scene: TankScene, exact: np.ndarray) -> Iterator[StudyRow]:
    """What the solver makes of a tolerance: the solution with its estimate, the count of modes, and the tones."""
    for tolerance in TOLERANCES:
        asked = scene.model_copy(update={"accuracy": Accuracy(tolerance=tolerance, modes=scene.accuracy.modes)})
        solution = solve_scene(asked)
        omega = np.array([solution.omega(mode.eigenvalue) for mode in solution.asked])
        errors = _errors(omega, exact)
        yield StudyRow(
            family="tolerance",
            degree=solution.resolution.degree,
            size=None,
            tolerance=tolerance,
            dofs=solution.field.dofs,
            error=float(errors.max()),
            lowest_error=float(errors[0]),
            estimate=float(solution.relative_errors[: len(errors)].max()),
            seconds=solution.seconds,
            memory=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024,
        )


def _rates(scene: TankScene, rows: list[StudyRow]) -> tuple[Rate, ...]:
    """Fit error ~ hᵖ over the finer meshes of each degree that are above rounding."""
    rates = []
    for degree in UNIFORM_DEGREES:
        series = [row for row in rows if row.family == "uniform" and row.degree == degree]
        last = [row for row in series if row.lowest_error > ROUNDING][-4:]
        if len(last) < 3:
            continue
        slope = np.polyfit(np.log([row.size or 0.0 for row in last]), np.log([row.lowest_error for row in last]), 1)[0]
        rates.append(
            Rate(degree=degree, observed=float(slope), expected=expected_order(scene, degree), points=len(last))
        )
    return tuple(rates)
