"""Solve a scene to the tolerance it asks for, and say how far each number can be trusted.

Each attempt solves twice on one mesh: with the planned resolution and with a coarser one (one degree less, fewer dry
modes). Ritz values come from above, so the coarser solution lies higher and the difference bounds the error of the
finer one as soon as refinement helps at all. An attempt that misses the tolerance is refined.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from itertools import pairwise
from math import ceil

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.modes import Mode, ModeSet, count_below, solve_modes
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.meshes.tagged_mesh import MeshError, TaggedMesh
from hydroelastic.scenes.estimates import expected_tones
from hydroelastic.scenes.field_model import bring_mesh, build_field_model, build_mesh
from hydroelastic.scenes.models import TankScene
from hydroelastic.scenes.plan import MOST_MODES_TO_TONE, Resolution, ScaledTank, initial_resolution, scaled_tank
from hydroelastic.scenes.scaling import Scales, scales
from hydroelastic.scenes.tones import ElasticTone, elastic_tone

# Rounding of a frequency, measured on tanks with known modes: it grows with the condition of the Laplace matrix, about
# like the fifth power of the degree, and Lanczos leaves a few units of the last place of the spread of 1/λ.
_ROUNDING_OF_DEGREE_FOUR = 3e-13
_ROUNDING_OF_SPREAD = 1e-15
_MOST_ATTEMPTS = 4

Report = Callable[[str], None]


@dataclass
class Stopwatch:
    """Seconds by stage, added up."""

    seconds: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Time a block of code."""
        start = time.perf_counter()
        try:
            yield
        finally:
            self.seconds[name] = self.seconds.get(name, 0.0) + time.perf_counter() - start


@dataclass(frozen=True, kw_only=True)
class ToneSolution:
    """The first elastic tone of one beam.

    Attributes:
        tone: the mode and its participation; ``None`` where it is not one of the modes that can be told apart.
        reason: why there is no tone, or "".
        pressure_release: λ of the tone with ψ = 0 on the water; ``None`` where there is no water.
        pressure_release_error: relative error of that frequency.
        pressure_release_values: λ of the lowest modes with ψ = 0 on the water.
    """

    tone: ElasticTone | None
    reason: str
    pressure_release: float | None
    pressure_release_error: float | None
    pressure_release_values: tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class TankSolution:
    """The dimensionless solution of a scene.

    Attributes:
        scene: the scene.
        units: its units.
        tank: the scaled scene.
        resolution: the resolution of the last attempt.
        mesh: its mesh.
        pencil: its matrices.
        modes: its modes, at least those asked for.
        relative_errors: estimated relative error of each frequency.
        counted: whether the inertia of an independent factorization confirms that no mode is missing.
        tones: one for each beam.
        attempts: how many resolutions were tried.
        reasons: why the solution does not keep what was asked; empty if it does.
        seconds: time by stage.
    """

    scene: TankScene
    units: Scales
    tank: ScaledTank
    resolution: Resolution
    mesh: TankMesh
    pencil: CoupledPencil
    modes: ModeSet
    relative_errors: np.ndarray
    counted: bool
    tones: tuple[ToneSolution, ...]
    attempts: int
    reasons: tuple[str, ...]
    seconds: dict[str, float]

    @property
    def asked(self) -> tuple[Mode, ...]:
        """The modes asked for."""
        return self.modes.modes

    def omega(self, eigenvalue: float) -> float:
        """ω in rad/s of a dimensionless λ."""
        return float(np.sqrt(eigenvalue)) * self.units.frequency


def solve_scene(
    scene: TankScene,
    *,
    comm: MPI.Comm | None = None,
    mesh: TaggedMesh | None = None,
    report: Report = lambda _message: None,
) -> TankSolution:
    """Solve a tank scene.

    Args:
        scene: what is asked.
        comm: MPI communicator; all processes by default.
        mesh: a mesh of the liquid in metres that the user brings (on rank 0), instead of ours. Its elements are then
            kept, and only degree and dry modes are refined.
        report: told what is being done.

    Returns:
        The solution, with `TankSolution.reasons` where it does not keep the asked tolerance (collective).

    Raises:
        MeshError: if the mesh does not fit the scene.
        EigenSolverError: if the eigen-solver fails.
    """
    comm = comm or MPI.COMM_WORLD
    watch = Stopwatch()
    with watch.stage("plan"):
        tank, units = scaled_tank(scene), scales(scene)
        resolution: Resolution | None = initial_resolution(
            scene, modes=scene.accuracy.modes, tones=expected_tones(tank)
        )
    brought = None
    given = comm.bcast(mesh is not None, root=0)
    if scene.mesh is not None and not given:
        raise MeshError(f"the scene brings the mesh {scene.mesh.file}: load it and hand it over")
    if given:
        with watch.stage("mesh"):
            scaled = mesh.scaled(1.0 / units.length) if mesh is not None else None
            brought = bring_mesh(comm, tank, scaled)
    best: TankSolution | None = None
    for attempt in range(1, _MOST_ATTEMPTS + 1):
        assert resolution is not None
        report(f"attempt {attempt}: degree {resolution.degree}, {resolution.modes} modes")
        solution = _attempt(comm, scene, tank, units, resolution, brought, watch, attempt)
        if best is None or _shortfall(solution) <= _shortfall(best):
            best = solution
        if not solution.reasons:
            break
        resolution = _next_resolution(solution)
        if resolution is None or (brought is not None and _differ_by_mesh_alone(resolution, solution.resolution)):
            break
    assert best is not None
    return replace(best, seconds=dict(watch.seconds))


def _shortfall(solution: TankSolution) -> tuple[int, float]:
    """How far a solution falls short: number of complaints, then the largest error."""
    return len(solution.reasons), float(solution.relative_errors[: solution.scene.accuracy.modes].max())


def _differ_by_mesh_alone(one: Resolution, other: Resolution) -> bool:
    return (one.degree, one.shapes, one.modes) == (other.degree, other.shapes, other.modes)


def _next_resolution(solution: TankSolution) -> Resolution | None:
    """More modes if a tone was not among them, else a finer model."""
    uncertain = any(tone.tone is not None and not tone.tone.certain for tone in solution.tones)
    resolution = solution.resolution
    if uncertain:
        wanted = min(ceil(1.6 * resolution.modes), MOST_MODES_TO_TONE)
        wider = initial_resolution(solution.scene, modes=wanted)
        return replace(
            wider,
            degree=max(wider.degree, resolution.degree),
            reaches_tones=resolution.reaches_tones,
            widened=True,
        )
    return resolution.finer()


def _attempt(
    comm: MPI.Comm,
    scene: TankScene,
    tank: ScaledTank,
    units: Scales,
    resolution: Resolution,
    brought: TankMesh | None,
    watch: Stopwatch,
    attempt: int,
) -> TankSolution:
    with watch.stage("mesh"):
        mesh = brought or build_mesh(comm, tank, resolution)
    _, coarse = _solve_level(mesh, tank, resolution.coarser(), watch, shapes=0)
    pencil, modes = _solve_level(mesh, tank, resolution, watch, shapes=scene.accuracy.modes)
    caution = _caution(resolution, brought)
    errors = caution * _relative_errors(modes.eigenvalues, coarse.eigenvalues, resolution.degree)
    with watch.stage("count"):
        counted = _confirm_count(pencil, modes)
    tones = _tones(mesh, tank, resolution, pencil, modes, caution, watch)
    solution = TankSolution(
        scene=scene,
        units=units,
        tank=tank,
        resolution=resolution,
        mesh=mesh,
        pencil=pencil,
        modes=modes,
        relative_errors=errors,
        counted=counted,
        tones=tones,
        attempts=attempt,
        reasons=(),
        seconds={},
    )
    return replace(solution, reasons=_reasons(solution))


def _solve_level(
    mesh: TankMesh, tank: ScaledTank, resolution: Resolution, watch: Stopwatch, *, shapes: int
) -> tuple[CoupledPencil, ModeSet]:
    with watch.stage("assemble"):
        pencil = build_field_model(mesh, tank, degree=resolution.degree, shapes=resolution.shapes)
    with watch.stage("solve"):
        # One mode more than reported, so that the count below can be made in the gap above the last one.
        modes = solve_modes(pencil, resolution.modes + 1, shapes=shapes)
    return pencil, modes


def _caution(resolution: Resolution, brought: TankMesh | None) -> float:
    """Factor on the difference of two degrees that makes it an error.

    On our meshes the error falls by a factor with each degree, and the difference is the larger part of it. On a mesh
    that is not graded to the tips it falls like p^{-4α}, α ≥ 1/2, and the difference is only about 2/p of it.
    """
    return 1.0 if brought is None else max(1.0, 0.5 * resolution.degree)


def _rounding(degree: int) -> float:
    return _ROUNDING_OF_DEGREE_FOUR * (degree / 4.0) ** 5


def _relative_errors(fine: np.ndarray, coarse: np.ndarray, degree: int) -> np.ndarray:
    """Estimated relative error of each ω: half that of λ, and what rounding leaves."""
    shared = min(len(fine), len(coarse))
    fine, coarse = fine[:shared], coarse[:shared]
    rounding = _rounding(degree) + _ROUNDING_OF_SPREAD * fine / fine[0]
    return 0.5 * np.abs(coarse / fine - 1.0) + rounding


def _confirm_count(pencil: CoupledPencil, modes: ModeSet) -> bool:
    """Count the modes below the widest of the last gaps by inertia."""
    values = modes.eigenvalues
    if len(values) < 2:
        return count_below(pencil, 2.0 * values[-1]) >= 1
    gaps = [upper / lower for lower, upper in pairwise(values)]
    first = max(0, len(gaps) - 3)
    widest = first + int(np.argmax(gaps[first:]))
    shift = float(np.sqrt(values[widest] * values[widest + 1]))
    return count_below(pencil, shift) == widest + 1


def _tones(
    mesh: TankMesh,
    tank: ScaledTank,
    resolution: Resolution,
    pencil: CoupledPencil,
    modes: ModeSet,
    caution: float,
    watch: Stopwatch,
) -> tuple[ToneSolution, ...]:
    """The first elastic tone of each beam, with its pressure-release companion."""
    release: tuple[ModeSet, ...] = ()
    if tank.beams and pencil.free_surface is not None:
        with watch.stage("pressure release"):
            release = _pressure_release_modes(mesh, tank, resolution)
    tones = []
    for body in range(len(tank.beams)):
        companion, error = _companion(release, pencil, body)
        tone: ElasticTone | None = elastic_tone(modes, pencil.bodies, body, companion=companion)
        reason = ""
        assert tone is not None
        if not tone.certain and not resolution.reaches_tones[body]:
            tone, reason = None, f"more than {MOST_MODES_TO_TONE} modes lie below it, and it was not searched for"
        elif not tone.certain and resolution.widened:
            tone, reason = None, f"its energy is spread over modes beyond the first {resolution.modes}"
        if tone is None and companion is not None:
            reason += "; see the pressure-release tone"
        tones.append(
            ToneSolution(
                tone=tone,
                reason=reason,
                pressure_release=companion,
                pressure_release_error=None if error is None else caution * (error + _rounding(resolution.degree)),
                pressure_release_values=tuple(release[-1].eigenvalues) if release else (),
            )
        )
    return tuple(tones)


def _pressure_release_modes(mesh: TankMesh, tank: ScaledTank, resolution: Resolution) -> tuple[ModeSet, ModeSet]:
    """The lowest modes with ψ = 0 on the water, coarse and fine, as many as hold the first elastic tone of each beam.

    Below the tone of a stiff beam lie rigid modes, with hydrostatics, and many modes of softer beams.
    """
    coarse, fine = (
        build_field_model(mesh, tank, degree=level.degree, shapes=level.shapes, pressure_release=True)
        for level in (resolution.coarser(), resolution)
    )
    count = 6 * len(tank.beams)
    while True:
        modes = solve_modes(fine, count, shapes=0)
        found = all(elastic_tone(modes, fine.bodies, body).certain for body in range(len(tank.beams)))
        if found or count >= fine.size:
            return solve_modes(coarse, len(modes.eigenvalues), shapes=0), modes
        count *= 2


def _companion(release: tuple[ModeSet, ...], pencil: CoupledPencil, body: int) -> tuple[float | None, float | None]:
    """λ of a beam's pressure-release tone and the relative error of its ω, or ``None`` twice."""
    if not release:
        return None, None
    coarse, fine = release
    tone = elastic_tone(fine, pencil.bodies, body)
    if not tone.certain:
        return None, None
    value = float(fine.eigenvalues[tone.index])
    # The nearest coarse mode is the same one: fewer shapes of softer beams may shift its number.
    return value, 0.5 * float(np.abs(coarse.eigenvalues / value - 1.0).min())


def _reasons(solution: TankSolution) -> tuple[str, ...]:
    """Why a solution does not keep what was asked, in words."""
    tolerance = solution.scene.accuracy.tolerance
    asked = solution.scene.accuracy.modes
    reasons = []
    available = len(solution.relative_errors)
    errors = solution.relative_errors[: min(asked, available)]
    if errors.max() > tolerance:
        number = int(np.argmax(errors)) + 1
        reasons.append(
            f"mode {number} has an estimated relative error of {errors.max():.1e}, above the tolerance {tolerance:g}"
        )
    if not solution.counted:
        reasons.append("an independent count of the modes by inertia disagrees: a mode may be missing")
    for number, tone in enumerate(solution.tones, 1):
        if tone.tone is not None and not tone.tone.certain:
            reasons.append(f"the first elastic tone of body {number} may lie above the modes computed")
        elif tone.tone is not None and solution.relative_errors[min(tone.tone.index, available - 1)] > tolerance:
            reasons.append(f"the first elastic tone of body {number} has an estimated error above the tolerance")
        if tone.pressure_release_error is not None and tone.pressure_release_error > tolerance:
            reasons.append(
                f"the pressure-release tone of body {number} has an estimated error of "
                f"{tone.pressure_release_error:.1e}, above the tolerance {tolerance:g}"
            )
    return tuple(reasons)
