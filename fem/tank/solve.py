"""Solve a tank to a tolerance, with estimated errors of all results.

Each attempt solves once and estimates its errors: from the decay of ψ with the polynomial degree, from the omitted dry
modes, and from rounding. Where the tolerance is exceeded, the largest contributions to the error are refined.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import count
from math import ceil

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.adaptive import ErrorEstimate, adaptive_solve
from hydroelastic.fem.bodies.registry import toned_bodies
from hydroelastic.fem.closed.discretization import MOST_MODES_TO_TONE
from hydroelastic.fem.closed.tones import ElasticTone, FloatMode, elastic_tone, float_modes
from hydroelastic.fem.closed_solution import ClosedSolution
from hydroelastic.fem.kept_tolerance import excess
from hydroelastic.fem.mode_set import Mode, ModeSet
from hydroelastic.fem.progress import Report
from hydroelastic.fem.tank.error_estimates import FrequencyErrors, frequency_errors, refined
from hydroelastic.fem.tank.field_model import distributed_user_mesh
from hydroelastic.fem.tank.field_solution import FieldSolution, count_is_confirmed, solve_field
from hydroelastic.fem.tank.infinite_frequency import (
    InfiniteFrequencyAddedMass,
    InfiniteFrequencyLimit,
    infinite_frequency_limit,
)
from hydroelastic.fem.tank.liquids import ANEW, Liquids, SharedLiquids, finest
from hydroelastic.fem.tank.resolution import (
    Resolution,
    initial_resolution,
    sharpest_exponent,
    workable_tolerance,
)
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.meshes.tagged_mesh import TaggedMesh
from hydroelastic.physics.rigid_motions import mode_count
from hydroelastic.physics.symmetry import is_mirror_image
from hydroelastic.physics.tank import Tank

_MOST_ATTEMPTS = 5


@dataclass(frozen=True, kw_only=True)
class ToneSolution:
    """The first elastic tone of one beam.

    Attributes:
        body: index of the beam among the bodies.
        tone: the mode and its participation; ``None`` where it is not attributed to one of the modes.
        reason: why there is no tone, or "".
        pressure_release: dimensionless λ of the tone with ψ = 0 on the free surface; ``None`` without one.
        pressure_release_error: relative error of that frequency.
        pressure_release_values: dimensionless λ of the lowest modes with ψ = 0 on the free surface.
    """

    body: int
    tone: ElasticTone | None
    reason: str
    pressure_release: float | None
    pressure_release_error: float | None
    pressure_release_values: tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class TankSolution(ClosedSolution[Tank]):
    """The solution of a tank in two dimensions; what it adds to those of all closed tanks.

    Attributes:
        resolution: the resolution of the last attempt.
        field: its mesh, matrices and modes; one mode more than planned.
        asked: the requested modes, with their shapes.
        relative_errors: estimated relative error of the frequency of each mode, shape (modes,); NaN where not
            estimated.
        growing_errors: estimated relative error of the growth rate of each growing mode, shape (growing modes,).
        causes: errors by cause of the modes with an estimate, then of the growing ones.
        tones: one for each beam.
        float_modes: one for each motion of a float with restoring force.
        added_mass: added mass of the floats at infinite frequency; ``None`` without floats, or under a lid.
    """

    resolution: Resolution
    field: FieldSolution
    asked: tuple[Mode, ...]
    relative_errors: np.ndarray
    growing_errors: np.ndarray
    causes: FrequencyErrors
    tones: tuple[ToneSolution, ...]
    float_modes: tuple[FloatMode, ...]
    added_mass: InfiniteFrequencyAddedMass | None

    @property
    def modes(self) -> ModeSet:
        """All modes, in the bodies of the whole tank."""
        return self.field.modes

    @property
    def largest_error(self) -> float:
        """The largest relative error of requested modes, tones, modes of floats and growth rates."""
        return float(np.nanmax([0.0, *self.relative_errors, *self.growing_errors]))


def solve_tank(
    physical: Tank,
    *,
    tolerance: float,
    modes: int,
    comm: MPI.Comm | None = None,
    mesh: TaggedMesh | None = None,
    halves: bool = True,
    liquids: Liquids = ANEW,
    report: Report = lambda _message: None,
) -> TankSolution:
    """Solve a tank between walls (collective)."""
    comm = comm or MPI.COMM_WORLD
    given = comm.bcast(mesh is not None, root=0)
    tank = physical.scaled()
    first = liquids.first(tank, tolerance, modes)
    half = halves and not given and is_mirror_image(tank)
    user_mesh: TankMesh | None = None
    if given:
        user_mesh = distributed_user_mesh(comm, tank, mesh.scaled(1.0 / physical.length) if mesh is not None else None)
        first = replace(first, tip_size=None)
    workable = workable_tolerance(tolerance, tank.depth)
    attempts = count(1)

    @cache
    def limit() -> InfiniteFrequencyLimit:
        coarsest = liquids.first_of_limit(tank, workable) if user_mesh is None else first
        return infinite_frequency_limit(
            comm, tank, coarsest, workable, half=half, user_mesh=user_mesh, liquids=liquids, report=report
        )

    def solve(resolution: Resolution) -> TankSolution:
        report(f"attempt {next(attempts)}: degree {resolution.degree}, {resolution.modes} modes")
        mesh = user_mesh or liquids.mesh(comm, tank, resolution, half=half)
        beside = limit()
        field = solve_field(mesh, tank, resolution, resolution.modes + 1, half=half, models=liquids.pencils)
        counted = count_is_confirmed(field)
        return _judged(physical, tank, (tolerance, modes), resolution, field, counted, beside)

    found = adaptive_solve(
        first,
        solve,
        lambda solution: ErrorEstimate(discretization=solution.largest_error, missing=len(solution.reasons)),
        lambda _, solution: _next_resolution(solution, remesh=user_mesh is None),
        tolerance,
        rounds=_MOST_ATTEMPTS,
    )
    return found.solution


def _next_resolution(solution: TankSolution, *, remesh: bool) -> Resolution | None:
    """Return more modes if a tone was not among them, else a finer resolution; ``None`` where neither would help."""
    resolution = solution.resolution
    if any(tone.tone is not None and not tone.tone.certain for tone in solution.tones):
        wider = initial_resolution(
            solution.tank, solution.tolerance, modes=min(ceil(1.6 * resolution.modes), MOST_MODES_TO_TONE)
        )
        return replace(
            wider,
            degree=max(wider.degree, resolution.degree),
            tip_size=wider.tip_size if remesh else None,
            reaches_tones=resolution.reaches_tones,
            widened=True,
        )
    tolerance = workable_tolerance(solution.tolerance, solution.tank.depth)
    if solution.counted and solution.largest_error <= tolerance:
        return None
    exponent = sharpest_exponent(solution.tank, infinite_frequency=False)
    return refined(resolution, solution.causes, tolerance, exponent=exponent, remesh=remesh)


def _judged(
    physical: Tank,
    tank: Tank,
    asked_for: tuple[float, int],
    resolution: Resolution,
    field: FieldSolution,
    counted: bool,
    limit: InfiniteFrequencyLimit,
) -> TankSolution:
    tolerance, count = asked_for
    tones = tuple(_tone(field, beam, body, resolution, limit) for beam, body in enumerate(toned_bodies(tank)))
    complete = len(field.modes.eigenvalues) <= resolution.modes
    added, bodies, values = limit.added_mass, field.bodies, field.modes.eigenvalues
    if added is not None:
        added = np.concatenate([added.principal(tank, index, bodies[index].motions) for index in tank.rigid])
    moved = float_modes(bodies, tank.rigid, values, field.modes.elastic_amplitudes, added, complete=complete)
    asked = min(count, len(field.modes.eigenvalues))
    beams = (tone.tone.index for tone in tones if tone.tone is not None)
    floats = (mode.index for mode in moved if mode.index is not None)
    indices = sorted({*range(asked), *beams, *floats})
    modes = [field.modes.completed(index) for index in indices]
    origins = [*(field.origins[index] for index in indices), *field.growing_origins]
    causes = frequency_errors(field, [*modes, *field.modes.growing], origins, resolution, tank)
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
        causes=causes,
        counted=counted,
        tones=tones,
        float_modes=moved,
        added_mass=limit.added_mass,
        reasons=(),
    )
    return replace(solution, reasons=tuple(_reasons(solution)))


def _tone(
    field: FieldSolution, beam: int, body: int, resolution: Resolution, limit: InfiniteFrequencyLimit
) -> ToneSolution:
    """The first elastic tone of a beam, with its pressure-release tone."""
    release = limit.tones[beam] if limit.tones else None
    eigenvalue = release.eigenvalue if release is not None else None
    tone: ElasticTone | None = elastic_tone(
        field.modes.eigenvalues, field.modes.elastic_amplitudes, field.bodies, body, released=eigenvalue
    )
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
        pressure_release=eigenvalue,
        pressure_release_error=release.error if release is not None else None,
        pressure_release_values=limit.eigenvalues,
    )


def _reasons(solution: TankSolution) -> Iterator[str]:
    """Yield messages on why a solution does not keep the tolerance or is incomplete."""
    tolerance, errors, estimated = solution.tolerance, solution.relative_errors, "has an estimated error"
    # Mode numbers start at one; the zero is for a tank without modes.
    modes = [0.0, *errors[: len(solution.asked)]]
    number = int(np.argmax(modes))
    rounding = solution.causes.largest("rounding")
    yield from excess(f"mode {number} has an estimated relative error", modes[number], tolerance, rounding=rounding)
    yield from excess(
        "a growth rate has an estimated relative error", max(solution.growing_errors, default=0.0), tolerance
    )
    if len(solution.asked) < min(solution.count, _modes_there(solution)):
        yield f"{len(solution.asked)} of {solution.count} modes exceed the rounding of the lowest"
    if not solution.counted:
        yield "an independent count of the modes by inertia disagrees: a mode may be missing"
    for tone in solution.tones:
        beam = f"of {'plate' if solution.tank.geometry.is_revolved else 'beam'} {tone.body + 1}"
        if tone.tone is not None and not tone.tone.certain:
            yield f"the first elastic tone {beam} may lie above the modes computed"
        elif tone.tone is not None:
            yield from excess(f"the first elastic tone {beam} {estimated}", errors[tone.tone.index], tolerance)
        yield from excess(f"the pressure-release tone {beam} {estimated}", tone.pressure_release_error, tolerance)
    for mode in solution.float_modes:
        if mode.index is not None:
            yield from excess(
                f"the {mode.motion} mode of float {mode.body + 1} {estimated}", errors[mode.index], tolerance
            )
    if solution.added_mass is not None:
        yield from excess(f"the added mass at infinite frequency {estimated}", solution.added_mass.error, tolerance)


def _modes_there(solution: TankSolution) -> float:
    """Number of modes of a tank: finite without waves and elastic bodies."""
    count = mode_count(solution.tank)
    return np.inf if count is None else count - len(solution.modes.growing)


def shared_liquids(tanks: Sequence[Tank], *, tolerance: float, modes: int) -> SharedLiquids:
    """Return liquids for all tanks of one `liquid_key`, at a resolution that suffices for some of them (collective)."""
    scaled = [tank.scaled() for tank in tanks]
    limits = [ANEW.first_of_limit(tank, workable_tolerance(tolerance, tank.depth)) for tank in scaled]
    fields = [ANEW.first(tank, tolerance, modes) for tank in scaled]
    liquids = SharedLiquids(of_field=finest(fields), of_limit=finest(limits))
    # What is refined for one of them is refined for all.
    solved = [solve_tank(tank, tolerance=tolerance, modes=modes, liquids=liquids) for tank in tanks]
    liquids.of_field = finest([one.resolution for one in solved])
    return liquids
