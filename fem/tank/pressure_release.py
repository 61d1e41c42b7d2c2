"""The pressure-release companion: the first elastic tones with ψ = 0 on the water, the limit of high frequency.

In a tank with waves the elastic energy of a stiff beam is spread over several modes; its companion is always one mode,
smooth in every parameter. It needs no elements for waves, but sharper tips, and has a mesh of its own.
"""

from __future__ import annotations

from dataclasses import dataclass

from mpi4py import MPI

from hydroelastic.fem.liquid import compile_form
from hydroelastic.fem.stopwatch import Stopwatch
from hydroelastic.fem.tank.elastic_tone import ElasticTone, elastic_tone
from hydroelastic.fem.tank.error_estimates import ROUNDING_OF_SPREAD, FrequencyErrors, frequency_errors, refined
from hydroelastic.fem.tank.field_model import build_mesh
from hydroelastic.fem.tank.field_solution import FieldSolution, solve_field
from hydroelastic.fem.tank.resolution import Resolution, sharpest_exponent
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.physics.tank import Tank

_MOST_ATTEMPTS = 5


@dataclass(frozen=True, kw_only=True)
class Companion:
    """The first elastic tones with ψ = 0 on the water.

    Attributes:
        solution: the modes.
        tones: one for each beam, ``None`` where it is not among the modes of the model, or rounding hides it.
        errors: estimated relative error of each tone's ω.
    """

    solution: FieldSolution
    tones: tuple[ElasticTone | None, ...]
    errors: tuple[float | None, ...]

    @property
    def largest_error(self) -> float:
        """The largest of the errors."""
        return max((error for error in self.errors if error is not None), default=0.0)

    @property
    def shortfall(self) -> tuple[int, float]:
        """Number of beams without a tone, then the largest error."""
        return self.tones.count(None), self.largest_error

    def eigenvalue(self, beam: int) -> float | None:
        """λ of a beam's tone; beams are counted by themselves."""
        tone = self.tones[beam]
        return None if tone is None else float(self.solution.modes.eigenvalues[tone.index])


def solve_companion(
    comm: MPI.Comm,
    tank: Tank,
    resolution: Resolution,
    tolerance: float,
    brought: TankMesh | None,
    watch: Stopwatch,
    *,
    half: bool,
) -> Companion:
    """Solve for the tones to a tolerance, or as near to it as a few attempts come.

    Args:
        comm: MPI communicator.
        tank: the scene; it has water under gravity.
        resolution: the first attempt.
        tolerance: asked relative error of the tones.
        brought: a mesh that is to be used, instead of ours.
        watch: told the time.
        half: whether the tank is solved as two halves.

    Returns:
        The tones (collective).
    """
    best: Companion | None = None
    exponent = sharpest_exponent(tank, released=True)
    attempt: Resolution | None = resolution
    for _ in range(_MOST_ATTEMPTS):
        if attempt is None:
            break
        with watch.stage("pressure release"):
            mesh = brought or build_mesh(comm, tank, attempt, half=half, released=True)
        with watch.stage("forms"):
            compile_form(mesh, attempt.degree, glued=tank.moves_as_one)
        with watch.stage("pressure release"):
            companion, causes = _tones(mesh, tank, attempt, tolerance, half=half)
        if best is None or companion.shortfall < best.shortfall:
            best = companion
        if companion.largest_error <= tolerance:
            break
        attempt = refined(attempt, causes, tolerance, exponent=exponent, own_mesh=brought is None)
    assert best is not None
    return best


def _tones(
    mesh: TankMesh, tank: Tank, resolution: Resolution, tolerance: float, *, half: bool
) -> tuple[Companion, FrequencyErrors]:
    """Solve for more and more modes until they hold the tone of each beam."""
    beams = tuple(tank.beams)
    count = resolution.modes
    while True:
        solution = solve_field(mesh, tank, resolution, count, Stopwatch(), half=half, pressure_release=True)
        found = [elastic_tone(solution.modes, solution.bodies, body) for body in beams]
        if all(tone.certain for tone in found) or len(solution.modes.eigenvalues) < count:
            break
        count *= 2
    tones = tuple(tone if tone.certain and not _is_hidden(solution, tone, tolerance) else None for tone in found)
    indices = sorted({tone.index for tone in tones if tone is not None})
    modes = [solution.modes.completed(index) for index in indices]
    causes = frequency_errors(solution, modes, solution.parts_of(indices), resolution, tank, released=True)
    totals = dict(zip(indices, map(float, causes.total), strict=True))
    errors = tuple(None if tone is None else totals[tone.index] for tone in tones)
    return Companion(solution=solution, tones=tones, errors=errors), causes


def _is_hidden(solution: FieldSolution, tone: ElasticTone, tolerance: float) -> bool:
    """Whether a beam is rigid to double precision: its tone lies so far above other modes that rounding hides it."""
    values = solution.modes.eigenvalues
    return bool(ROUNDING_OF_SPREAD * values[tone.index] > tolerance * values[0])
