"""Solve a tank to a tolerance, and say how far each number can be trusted.

Each attempt solves once and judges itself: by the decay of the liquid's motion with the degree, by what the dry modes
left out would add, and by rounding. An attempt that misses the tolerance is refined where the error comes from.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import ceil

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.bodies.registry import ends_of_motions, expected_tones
from hydroelastic.fem.kept_tolerance import kept_tolerance
from hydroelastic.fem.modes import Mode, ModeSet
from hydroelastic.fem.stopwatch import Report, Stopwatch
from hydroelastic.fem.tank.elastic_tone import ElasticTone, elastic_tone
from hydroelastic.fem.tank.error_estimates import FrequencyErrors, frequency_errors, refined
from hydroelastic.fem.tank.field_model import bring_mesh, build_mesh, moving_surfaces
from hydroelastic.fem.tank.field_solution import FieldSolution, count_is_confirmed, solve_field
from hydroelastic.fem.tank.float_modes import FloatMode, float_modes
from hydroelastic.fem.tank.infinite_frequency import HighFrequencyAddedMass, high_frequency_added_mass
from hydroelastic.fem.tank.pressure_release import Companion, solve_companion
from hydroelastic.fem.tank.resolution import (
    MOST_MODES_TO_TONE,
    Resolution,
    companion_resolution,
    initial_resolution,
    sharpest_exponent,
    workable_tolerance,
)
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.meshes.tagged_mesh import TaggedMesh
from hydroelastic.physics.rigid_motions import mode_count
from hydroelastic.physics.scales import Scales
from hydroelastic.physics.symmetry import is_mirror_image
from hydroelastic.physics.tank import Tank

_MOST_ATTEMPTS = 5


@dataclass(frozen=True, kw_only=True)
class ToneSolution:
    """The first elastic tone of one beam.

    Attributes:
        body: index of the beam among the bodies.
        tone: the mode and its participation; ``None`` where it is not one of the modes that can be told apart.
        reason: why there is no tone, or "".
        pressure_release: λ of the tone with ψ = 0 on the water; ``None`` where there is no water.
        pressure_release_error: relative error of that frequency.
        pressure_release_values: λ of the lowest modes with ψ = 0 on the water.
    """

    body: int
    tone: ElasticTone | None
    reason: str
    pressure_release: float | None
    pressure_release_error: float | None
    pressure_release_values: tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class TankSolution:
    """The dimensionless solution of a tank.

    Attributes:
        physical: the tank, in SI units.
        tank: the same in its own units.
        tolerance: asked relative error of the frequencies.
        count: how many modes were asked for.
        resolution: the resolution of the last attempt.
        field: its mesh, matrices and modes; one mode more than were planned.
        asked: the modes asked for, with their shapes.
        relative_errors: estimated relative error of the frequency of each mode of the field; NaN where none was asked.
        growing_errors: estimated relative error of the growth rate of each growing mode.
        rounding: the part of the largest that no refinement takes away.
        counted: whether the inertia of an independent factorization confirms that no mode is missing.
        tones: one for each beam.
        float_modes: one for each motion of a float that gravity restores.
        added_mass: of the floats, far above the waves; ``None`` without floats, or where a lid leaves no such limit.
        attempts: how many resolutions were tried.
        reasons: why the solution does not keep what was asked; empty if it does.
        seconds: time by stage.
    """

    physical: Tank
    tank: Tank
    tolerance: float
    count: int
    resolution: Resolution
    field: FieldSolution
    asked: tuple[Mode, ...]
    relative_errors: np.ndarray
    growing_errors: np.ndarray
    rounding: float
    counted: bool
    tones: tuple[ToneSolution, ...]
    float_modes: tuple[FloatMode, ...]
    added_mass: HighFrequencyAddedMass | None
    attempts: int
    reasons: tuple[str, ...]
    seconds: dict[str, float]

    @property
    def units(self) -> Scales:
        """The tank's own units."""
        return self.physical.units

    @property
    def modes(self) -> ModeSet:
        """All modes, in the bodies of the whole tank."""
        return self.field.modes

    @property
    def largest_error(self) -> float:
        """The largest error of the modes asked for, of the tones, and of growth rates."""
        return float(np.nanmax([0.0, *self.relative_errors, *self.growing_errors]))

    def omega(self, eigenvalue: float) -> float:
        """ω in rad/s of a dimensionless λ."""
        return float(np.sqrt(eigenvalue)) * self.units.frequency


def solve_tank(
    physical: Tank,
    *,
    tolerance: float,
    modes: int,
    comm: MPI.Comm | None = None,
    mesh: TaggedMesh | None = None,
    halves: bool = True,
    report: Report = lambda _message: None,
) -> TankSolution:
    """Solve a tank between walls.

    Args:
        physical: the tank, in SI units.
        tolerance: asked relative error of the frequencies.
        modes: how many modes are asked for, from the lowest.
        comm: MPI communicator; all processes by default.
        mesh: a mesh of the liquid in metres that the user brings (on rank 0), instead of ours. Its elements are then
            kept, and only degree and dry modes are refined.
        halves: whether a tank that is its own mirror image is solved as two halves; ``False`` is for comparison.
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
        tank = physical.scaled()
        tones = expected_tones(tank)
        motions = ends_of_motions(tank)
        resolution: Resolution | None = initial_resolution(tank, tolerance, modes=modes, tones=tones, motions=motions)
    brought = _brought_mesh(comm, tank, mesh, 1.0 / physical.length, watch)
    half = halves and brought is None and is_mirror_image(tank)
    workable = workable_tolerance(tolerance, tank.depth)
    companion: Companion | None = None
    added: HighFrequencyAddedMass | None = None
    best: TankSolution | None = None
    for attempt in range(1, _MOST_ATTEMPTS + 1):
        assert resolution is not None
        if brought is not None:
            resolution = replace(resolution, tip_size=None)
        report(f"attempt {attempt}: degree {resolution.degree}, {resolution.modes} modes")
        with watch.stage("mesh"):
            own_mesh = brought or build_mesh(comm, tank, resolution, half=half)
        if companion is None and tank.beams and moving_surfaces(own_mesh, tank):
            report("pressure-release tone")
            first = companion_resolution(tank, workable, tones) if brought is None else resolution
            companion = solve_companion(comm, tank, first, workable, brought, watch, half=half)
        if added is None and tank.floats and tank.has_high_frequency_limit:
            report("added mass far above the waves")
            added = high_frequency_added_mass(comm, tank, workable, watch, half=half)
        field = solve_field(own_mesh, tank, resolution, resolution.modes + 1, watch, half=half)
        solution, causes = _judged(
            physical, tank, (tolerance, modes), resolution, field, (companion, added), watch, attempt
        )
        if best is None or _shortfall(solution) <= _shortfall(best):
            best = solution
        if not solution.reasons:
            break
        resolution = _next_resolution(solution, causes, own_mesh=brought is None)
        if resolution is None:
            break
    assert best is not None
    return replace(best, seconds=dict(watch.seconds))


def _brought_mesh(
    comm: MPI.Comm, tank: Tank, mesh: TaggedMesh | None, factor: float, watch: Stopwatch
) -> TankMesh | None:
    if not comm.bcast(mesh is not None, root=0):
        return None
    with watch.stage("mesh"):
        return bring_mesh(comm, tank, mesh.scaled(factor) if mesh is not None else None)


def _shortfall(solution: TankSolution) -> tuple[int, float]:
    """How far a solution falls short: number of complaints, then the largest error."""
    return len(solution.reasons), solution.largest_error


def _next_resolution(solution: TankSolution, causes: FrequencyErrors, *, own_mesh: bool) -> Resolution | None:
    """More modes if a tone was not among them, else a finer model; ``None`` where neither would help."""
    resolution = solution.resolution
    if any(tone.tone is not None and not tone.tone.certain for tone in solution.tones):
        wider = initial_resolution(
            solution.tank, solution.tolerance, modes=min(ceil(1.6 * resolution.modes), MOST_MODES_TO_TONE)
        )
        return replace(
            wider,
            degree=max(wider.degree, resolution.degree),
            reaches_tones=resolution.reaches_tones,
            widened=True,
        )
    tolerance = workable_tolerance(solution.tolerance, solution.tank.depth)
    if solution.counted and solution.largest_error <= tolerance:
        return None
    exponent = sharpest_exponent(solution.tank, released=False)
    return refined(resolution, causes, tolerance, exponent=exponent, own_mesh=own_mesh)


def _judged(
    physical: Tank,
    tank: Tank,
    asked_for: tuple[float, int],
    resolution: Resolution,
    field: FieldSolution,
    limits: tuple[Companion | None, HighFrequencyAddedMass | None],
    watch: Stopwatch,
    attempt: int,
) -> tuple[TankSolution, FrequencyErrors]:
    """An attempt with all that it says about itself; beside it the limits of high frequency."""
    tolerance, count = asked_for
    companion, added = limits
    tones = tuple(_tone(field, beam, body, resolution, companion) for beam, body in enumerate(tank.beams))
    complete = len(field.modes.eigenvalues) <= resolution.modes
    moved = float_modes(tank, field.bodies, field.modes, added, complete=complete)
    with watch.stage("count"):
        counted = count_is_confirmed(field)
    with watch.stage("errors"):
        asked = min(count, len(field.modes.eigenvalues))
        beams = (tone.tone.index for tone in tones if tone.tone is not None)
        floats = (mode.index for mode in moved if mode.index is not None)
        indices = sorted({*range(asked), *beams, *floats})
        modes = [field.modes.completed(index) for index in indices]
        parts = [*field.parts_of(indices), *field.growing_parts]
        causes = frequency_errors(field, [*modes, *field.modes.growing], parts, resolution, tank)
    errors = np.full(len(field.modes.eigenvalues), np.nan)
    errors[indices] = causes.total[: len(indices)]
    solution = TankSolution(
        physical=physical,
        tank=tank,
        tolerance=tolerance,
        count=count,
        resolution=resolution,
        field=field,
        asked=tuple(modes[:asked]),
        relative_errors=errors,
        growing_errors=causes.total[len(indices) :],
        rounding=causes.largest("rounding"),
        counted=counted,
        tones=tones,
        float_modes=moved,
        added_mass=added,
        attempts=attempt,
        reasons=(),
        seconds={},
    )
    return replace(solution, reasons=_reasons(solution)), causes


def _tone(
    field: FieldSolution, beam: int, body: int, resolution: Resolution, companion: Companion | None
) -> ToneSolution:
    """The first elastic tone of a beam, with its pressure-release companion."""
    release = companion.eigenvalue(beam) if companion is not None else None
    tone: ElasticTone | None = elastic_tone(field.modes, field.bodies, body, companion=release)
    reason = ""
    assert tone is not None
    if not tone.certain and not resolution.reaches_tones[beam]:
        tone, reason = None, f"more than {MOST_MODES_TO_TONE} modes lie below it, and it was not searched for"
    elif not tone.certain and resolution.widened:
        tone, reason = None, f"its energy is spread over modes beyond the first {resolution.modes}"
    if tone is None and release is not None:
        reason += "; see the pressure-release tone"
    return ToneSolution(
        body=body,
        tone=tone,
        reason=reason,
        pressure_release=release,
        pressure_release_error=companion.errors[beam] if companion is not None else None,
        pressure_release_values=tuple(companion.solution.modes.eigenvalues) if companion is not None else (),
    )


def _reasons(solution: TankSolution) -> tuple[str, ...]:
    """Why a solution does not keep what was asked, in words."""
    tolerance = solution.tolerance
    reasons = []
    errors = solution.relative_errors[: len(solution.asked)]
    if errors.max(initial=0.0) > tolerance:
        number = int(np.argmax(errors)) + 1
        reasons.append(
            f"mode {number} has an estimated relative error of {errors.max():.1e}, above the tolerance {tolerance:g}; "
            + (f"rounding alone leaves {solution.rounding:.1e}; " if solution.rounding > 0.5 * tolerance else "")
            + kept_tolerance(float(errors.max()))
        )
    if solution.growing_errors.max(initial=0.0) > tolerance:
        error = float(solution.growing_errors.max())
        reasons.append(
            f"a growth rate has an estimated relative error of {error:.1e}, above the tolerance {tolerance:g}; "
            + kept_tolerance(error)
        )
    if len(solution.asked) < min(solution.count, _modes_there(solution)):
        reasons.append(f"{len(solution.asked)} of {solution.count} modes can be told from the rounding of the lowest")
    if not solution.counted:
        reasons.append("an independent count of the modes by inertia disagrees: a mode may be missing")
    for tone in solution.tones:
        number = tone.body + 1
        if tone.tone is not None and not tone.tone.certain:
            reasons.append(f"the first elastic tone of beam {number} may lie above the modes computed")
        elif tone.tone is not None and solution.relative_errors[tone.tone.index] > tolerance:
            error = float(solution.relative_errors[tone.tone.index])
            reasons.append(
                f"the first elastic tone of beam {number} has an estimated error of {error:.1e}, above the tolerance "
                f"{tolerance:g}; {kept_tolerance(error)}"
            )
        if tone.pressure_release_error is not None and tone.pressure_release_error > tolerance:
            reasons.append(
                f"the pressure-release tone of beam {number} has an estimated error of "
                f"{tone.pressure_release_error:.1e}, above the tolerance {tolerance:g}; "
                + kept_tolerance(tone.pressure_release_error)
            )
    for mode in solution.float_modes:
        if mode.index is not None and solution.relative_errors[mode.index] > tolerance:
            error = float(solution.relative_errors[mode.index])
            reasons.append(
                f"the {mode.motion} mode of float {mode.body + 1} has an estimated error of {error:.1e}, above the "
                f"tolerance {tolerance:g}; {kept_tolerance(error)}"
            )
    if solution.added_mass is not None and solution.added_mass.error > tolerance:
        error = solution.added_mass.error
        reasons.append(
            f"the added mass far above the waves has an estimated error of {error:.1e}, above the tolerance "
            f"{tolerance:g}; {kept_tolerance(error)}"
        )
    return tuple(reasons)


def _modes_there(solution: TankSolution) -> float:
    """How many modes a tank has: no more than rigid motions where no wave travels and nothing bends."""
    count = mode_count(solution.tank)
    return np.inf if count is None else count - len(solution.modes.growing)
