"""One solution of a study: its errors against the reference, and what it cost."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.memory import peak_memory
from hydroelastic.fem.spectral_error import LOWEST_DEGREE
from hydroelastic.fem.stopwatch import Stopwatch
from hydroelastic.fem.tank.error_estimates import frequency_errors
from hydroelastic.fem.tank.field_solution import solve_field
from hydroelastic.fem.tank.resolution import Resolution, rounding_error
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.physics.tank import Tank
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.models.tank_parts import Accuracy
from hydroelastic.scenes.study.plan import Family
from hydroelastic.scenes.study.reference import Reference
from hydroelastic.scenes.tank.solve import solve_scene

# Below this an error is rounding, whatever the degree: measured on meshes of up to 2e5 unknowns with exact frequencies.
ROUNDING = 1e-11


@dataclass(frozen=True, kw_only=True)
class StudyRow:
    """One solution of a study.

    Attributes:
        family: which series it belongs to.
        degree: of ψ.
        element_size: largest element asked for at the top, in tank lengths.
        grading: β of meshes drawn towards the tips, 1 for uniform ones; ``None`` in the other families.
        tolerance: asked relative error; ``None`` but in the family ``"tolerance"``.
        attempts: resolutions that were tried.
        unknowns: of ψ and of the surfaces, those of both halves of a tank that is solved as two.
        errors: ω/ω_exact − 1 of the frequencies asked for.
        floor: below this an error is rounding, or that of the reference.
        estimate: largest error that the solver itself estimates; ``None`` where it gives no estimate.
        reasons: why the solver says that it missed the tolerance; empty if it does not.
        seconds: time by stage.
        memory: highest resident memory while it was solved, above what was held before, in bytes over all processes;
            ``None`` where the system does not tell.
    """

    family: Family
    degree: int
    element_size: float
    grading: float | None
    tolerance: float | None
    attempts: int
    unknowns: int
    errors: tuple[float, ...]
    floor: float
    estimate: float | None
    reasons: tuple[str, ...]
    seconds: dict[str, float]
    memory: int | None

    @property
    def error(self) -> float:
        """Largest relative error of the frequencies asked for."""
        return max(map(abs, self.errors))

    @property
    def lowest_error(self) -> float:
        """Relative error of the lowest frequency."""
        return abs(self.errors[0])

    @property
    def total_seconds(self) -> float:
        """Time of all stages."""
        return sum(self.seconds.values())


@dataclass(frozen=True, kw_only=True)
class StudiedTank:
    """A scene and what all rows of its study share.

    Attributes:
        scene: the scene; its own tolerance plays no part.
        tank: the scaled scene.
        half: whether it is its own mirror image and is solved as two halves, in every family.
        finest: elements, rings and dry modes that leave less than any row does.
        reference: what counts as exact.
    """

    scene: TankScene
    tank: Tank
    half: bool
    finest: Resolution
    reference: Reference

    def errors(self, omega: np.ndarray) -> tuple[float, ...]:
        """ω/ω_exact − 1 of frequencies in rad/s, of those that both have."""
        shared = min(len(omega), len(self.reference.omega))
        return tuple(map(float, omega[:shared] / self.reference.omega[:shared] - 1.0))

    def floor(self, degree: int) -> float:
        """Errors below this say nothing of the mesh."""
        return max(ROUNDING, self.reference.uncertainty, rounding_error(degree, self.tank.depth))


def mesh_row(
    studied: StudiedTank,
    family: Family,
    resolution: Resolution,
    make_mesh: Callable[[], TankMesh],
    *,
    element_size: float,
    grading: float | None = None,
) -> StudyRow | None:
    """Solve once on a given mesh (collective).

    Args:
        studied: the scene.
        family: the series the row belongs to.
        resolution: degree and number of dry modes.
        make_mesh: makes the mesh; its time counts.
        element_size: of the mesh, for the record.
        grading: β of the mesh, for the record.

    Returns:
        The row; ``None`` if the mesh is too coarse to have the modes asked for.
    """
    watch = Stopwatch()
    estimate = None
    with peak_memory(MPI.COMM_WORLD) as memory:
        with watch.stage("mesh"):
            mesh = make_mesh()
        count = studied.scene.accuracy.modes
        field = solve_field(mesh, studied.tank, resolution, count, watch, half=studied.half)
        # The estimate takes the singularity to lie in the rings.
        if resolution.degree >= LOWEST_DEGREE and family == "geometric":
            with watch.stage("errors"):
                indices = list(range(len(field.modes.eigenvalues)))
                modes = [field.modes.completed(index) for index in indices]
                causes = frequency_errors(field, modes, field.parts_of(indices), resolution, studied.tank)
                estimate = float(causes.total.max())
    omega = np.sqrt(field.modes.eigenvalues) * physical_tank(studied.scene).units.frequency
    if len(omega) < min(count, len(studied.reference.omega)):
        return None
    return StudyRow(
        family=family,
        degree=resolution.degree,
        element_size=element_size,
        grading=grading,
        tolerance=None,
        attempts=1,
        unknowns=field.dofs,
        errors=studied.errors(omega),
        floor=studied.floor(resolution.degree),
        estimate=estimate,
        reasons=(),
        seconds=watch.seconds,
        memory=memory.peak,
    )


def tolerance_row(studied: StudiedTank, tolerance: float) -> StudyRow:
    """Solve to an asked tolerance, with all that a run does: estimates, count, tones, refinement (collective)."""
    scene = studied.scene
    asked = scene.model_copy(update={"accuracy": Accuracy(tolerance=tolerance, modes=scene.accuracy.modes)})
    with peak_memory(MPI.COMM_WORLD) as memory:
        solution = solve_scene(asked)
    omega = np.array([solution.omega(mode.eigenvalue) for mode in solution.asked])
    return StudyRow(
        family="tolerance",
        degree=solution.resolution.degree,
        element_size=max(solution.resolution.surface_sizes),
        grading=None,
        tolerance=tolerance,
        attempts=solution.attempts,
        unknowns=solution.field.dofs,
        errors=studied.errors(omega),
        floor=studied.floor(solution.resolution.degree),
        estimate=float(solution.relative_errors[: len(omega)].max()),
        reasons=solution.reasons,
        seconds=solution.seconds,
        memory=memory.peak,
    )
