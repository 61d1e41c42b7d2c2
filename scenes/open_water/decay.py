"""The motion of bodies in open water after a float is let go at rest on still water.

With p for d/dt and λ = −p², from a displacement a₀

    [p²(M + H) + K] S(p) = p (M + H) a₀,    a(t) = 2 Re Σ rⱼ e^{pⱼt} + (1/π) Im ∫₀^∞ E(re^{iφ}) e^{iφ} e^{re^{iφ}t} dr :

the resonances between the imaginary axis and the ray arg p = φ, and an integral along the ray on which nothing
oscillates. E is S less that of the bodies with their added mass far above the waves, which adds nothing for t > 0 and
makes the integral converge at t = 0. H on the ray comes from the field solution, continued by the complex scaling; a
reduced basis takes it from a few solutions to all points. In deep water H has a logarithm at p = 0, which leaves the
tail −(2/π) K⁻¹ h a₀/t², h = lim Im H = lim b/ω; at finite depth there is none.

Source: form (C) of the thin float, `modal.thin_float_decay`, with H of the exact body.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import isinf, pi, sqrt, tan

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.open_water.resonances import Eigenpair, ResonanceSearch
from hydroelastic.scenes.errors import Problem as WrongInput
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models.open_analyses import Decay
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.open_water.attempts import Attempt, attempted_over
from hydroelastic.scenes.open_water.basin import open_basin
from hydroelastic.scenes.open_water.model import Band, OpenModel, open_model
from hydroelastic.scenes.open_water.motion_scale import motion_scale
from hydroelastic.scenes.open_water.radiation import relative_difference
from hydroelastic.scenes.open_water.released import ReleasedModel, released_added_mass, released_model
from hydroelastic.scenes.open_water.resonance import ANGLE, Region, resonance_errors, rough_resonances
from hydroelastic.scenes.open_water.results import DecayTable
from hydroelastic.scenes.open_water.solver import OpenSolver
from hydroelastic.scenes.open_water.sweep import Problem, sweep
from hydroelastic.scenes.output.stopwatch import Stopwatch
from hydroelastic.scenes.tank.certainty import FrequencyErrors
from hydroelastic.scenes.tank.field_model import whole_bodies
from hydroelastic.scenes.tank.plan import Resolution

# Angles between a ray and the resonances beside it, radians: at least, if there is room, and at most.
_NARROW, _WIDE = 0.05, 0.12
# Resonances are looked for up to this angle from the real axis.
_SEARCHED = 0.54
# Frequencies of the mesh: so far below 1/t, where H hardly counts, and above the highest resonance.
_BELOW, _ABOVE = 0.02, 3.0
# The integral goes on beyond both: there H changes slowly, and little depends on it.
_LOWER, _HIGHER = 1e-2, 20.0
# Far below the resonances the motion is less sensitive to H, like the square of the frequency; but the tail shall keep
# its digits too.
_LEAST_WEIGHT = 1e-2
# The trapezoidal rule in ln r misses e^{−2πd/h} of what is analytic within the angle d: with this part of it 1e-18.
_STEP = 0.13
# A part of the momentum below which it is rounding.
_PUSHED = 1e-6
# Resonances faster than a float alone by more than this are those of beams.
_FAST = 3.0
# Points of the ray at which the reduced basis is judged.
_JUDGED = 60


@dataclass(frozen=True, kw_only=True)
class DecaySolution:
    """What a decay analysis found.

    Attributes:
        table: the numbers.
        model: the last problem.
        error: the largest error over the initial displacement.
    """

    table: DecayTable
    model: OpenModel
    error: float


@dataclass(frozen=True, kw_only=True)
class _Motion:
    """The motion at one resolution, dimensionless.

    Attributes:
        model: the problem.
        values: body unknowns, shape (times, body unknowns).
        errors: of all of them together, shape (times,).
        slow: lim Im H = lim b/ω, as the lowest frequency of the mesh has it.
    """

    model: OpenModel
    values: np.ndarray
    errors: np.ndarray
    slow: np.ndarray


def solve_decay(comm: MPI.Comm, scene: TankScene, asked: Decay, watch: Stopwatch) -> DecaySolution:
    """Follow a float that is let go, to the scene's tolerance of its initial displacement (collective).

    Args:
        comm: MPI communicator.
        scene: with open ends.
        asked: the analysis.
        watch: told the time.

    Raises:
        EigenSolverError: if SLEPc fails.
        SceneError: if a float would capsize or drift away.
    """
    released = released_model(comm, scene, watch)
    _check_release(released, asked)
    # Beams have shapes that vibrate much faster, and bend as if at rest in the motion of the float.
    fastest = max(released.frequencies(floats=True))
    expected = [omega for omega in released.frequencies() if omega <= _FAST * fastest]
    times = np.array(asked.times)
    latest = max(float(times.max()), 1.0 / expected[-1])
    region = Region(lowest=0.2 * expected[0], highest=1.3 * expected[-1], damping=tan(_SEARCHED))
    _, resonances = rough_resonances(comm, scene, expected, region, watch)
    ray = _ray(resonances)
    band = Band(lowest=min(_BELOW / latest, expected[0]), highest=_ABOVE * expected[-1])

    def solve(resolution: Resolution) -> Attempt[_Motion]:
        model = open_model(comm, scene, band, resolution, watch, angle=ANGLE)
        limit = _limit(comm, scene, resolution, model, watch)
        with watch.stage("resonances"):
            search = ResonanceSearch(model.pencil, model.stiffness, model.mass)
            poles = [search.refined(model.squared_frequency(omega)) for omega in resonances]
        reach = _LOWER * band.lowest, _HIGHER * band.highest
        return _followed(model, asked, limit, poles, ray, reach, watch)

    attempt = attempted_over(scene, band, solve)
    return DecaySolution(table=_table(asked, attempt.result), model=attempt.result.model, error=attempt.error)


def _check_release(released: ReleasedModel, asked: Decay) -> None:
    """Refuse what does not come back to where it rests.

    Raises:
        SceneError: if a float would capsize, or if what is let go sets a motion going that nothing restores.
    """
    restoring = np.diag(released.stiffness)
    if np.any(restoring[released.of_floats] < 0.0):
        wrong, remedy = "a float is unstable and would capsize", "Lower its centre of mass"
    else:
        loose = restoring == 0.0
        given = {"heave": asked.displacement.heave, "roll": asked.displacement.roll}
        own = [label if body == asked.body - 1 else "" for body, label in released.motions]
        initial = np.array([given.get(label, 0.0) for label in own])
        pushed = (released.mass + released.added_mass) @ initial
        if not np.any(np.abs(pushed[loose]) > _PUSHED * np.abs(pushed).max()):
            return
        names = sorted({released.motions[place][1] for place in np.flatnonzero(loose)})
        wrong = f"the float would drift away: nothing restores {' and '.join(names)}, which it sets going"
        remedy = f"Leave {' and '.join(names)} out of motions, or let go of another motion"
    raise SceneError(WrongInput(key='[[analysis]] key "displacement"', wrong=wrong, remedy=remedy))


@dataclass(frozen=True, kw_only=True)
class _Ray:
    """A ray ω = re^{−iδ}: δ, and the angle to the nearest resonance or to the waves' own spectrum."""

    angle: float
    gap: float


def _ray(resonances: list[complex]) -> _Ray:
    """The ray nearest to the imaginary axis that keeps off the resonances: further away there may be unknown ones."""
    angles = sorted(float(-np.angle(omega)) for omega in resonances)
    stops = [0.0, *(angle for angle in angles if angle < 0.5 * ANGLE), 0.5 * ANGLE]
    gaps = [(low, min(0.5 * (high - low), _WIDE)) for low, high in pairwise(stops)]
    low, gap = next((found for found in gaps if found[1] >= _NARROW), max(gaps, key=lambda found: found[1]))
    return _Ray(angle=low + gap, gap=gap)


def _limit(comm: MPI.Comm, scene: TankScene, resolution: Resolution, model: OpenModel, watch: Stopwatch) -> np.ndarray:
    """a(∞) in the units of the model."""
    long = open_basin(scene, 0.0)
    matrix, _ = released_added_mass(comm, scene, resolution.shapes, watch)
    scale = motion_scale(long, whole_bodies(long.tank, resolution.shapes))
    return model.scale.unknown_masses(scale.masses(matrix))


def _followed(
    model: OpenModel,
    asked: Decay,
    limit: np.ndarray,
    poles: list[Eigenpair],
    ray: _Ray,
    reach: tuple[float, float],
    watch: Stopwatch,
) -> Attempt[_Motion]:
    unit = model.basin.units.frequency
    solver = OpenSolver(model, watch)
    radii = np.exp(np.arange(np.log(reach[0]), np.log(reach[1]), _STEP * ray.gap)) / unit
    turned = np.exp(-1j * ray.angle)
    band = reach[0] / _LOWER / unit, reach[1] / _HIGHER / unit
    chosen = np.exp(np.linspace(np.log(band[0]), np.log(2.0 * band[1]), _JUDGED))
    tolerance = model.basin.scene.accuracy.tolerance
    swept = sweep(_problem(solver, band[1] / _ABOVE), chosen * turned, tolerance)
    initial = _initial(model, asked)
    with watch.stage("motion"):
        added = solver.hydrodynamics((radii * turned) ** 2)
        slowest = solver.hydrodynamics(chosen[:1] ** 2 * turned**2)[0]
        integrand = _integrand(model, limit, initial, radii * turned, added)
        times = np.array(asked.times) * unit
        passed = [pole for pole in poles if -np.angle(np.sqrt(pole.eigenvalue)) < ray.angle]
        residues = _residues(model, passed, initial)
        values = _summed(times, passed, residues, radii, ray, integrand)
        start = _summed(np.zeros(1), passed, residues, radii, ray, integrand)[0]
    with watch.stage("errors"):
        causes = resonance_errors(model, poles)
    fades = not model.basin.tank.beams
    errors = _errors(times, poles, _residues(model, poles, initial), causes, values, start - initial, fades=fades)
    size = np.abs(initial).max()
    total = FrequencyErrors(
        liquid=np.array([errors.max() / size + swept.errors.max()]),
        tips=causes.tips,
        truncation=np.zeros(1),
        rounding=causes.rounding,
    )
    # H = C − (2h/π) ln p there, and the logarithm has the imaginary part −(π/2 + δ) on the ray.
    motion = _Motion(
        model=model,
        values=values,
        errors=errors + size * swept.errors.max(),
        slow=slowest.imag / (1.0 + 2.0 * ray.angle / pi),
    )
    return Attempt(result=motion, causes=total, resolution=model.resolution)


def _problem(solver: OpenSolver, highest: float) -> Problem[tuple[np.ndarray, float]]:
    """H along the ray, weighed by how the motion depends on it; ``highest`` is the highest of the resonances."""

    def weight(omega: complex) -> float:
        return float(np.clip(abs(omega / highest) ** 2, _LEAST_WEIGHT, 1.0))

    def full(omega: complex) -> tuple[np.ndarray, float]:
        loads = solver.model.pencil.loads.astype(complex)
        return solver.model.pencil.products(loads, solver.radiation(omega**2)), weight(omega)

    def reduced(omega: complex) -> tuple[tuple[np.ndarray, float], float]:
        added, residual = solver.hydrodynamic(omega**2)
        return (added, weight(omega)), residual * sqrt(weight(omega))

    def difference(one: tuple[np.ndarray, float], other: tuple[np.ndarray, float]) -> float:
        return other[1] * relative_difference(one[0], other[0])

    return Problem(full=full, reduced=reduced, difference=difference)


def _initial(model: OpenModel, asked: Decay) -> np.ndarray:
    """a₀ in body unknowns."""
    scale = model.scale
    own = "" if len(model.pencil.bodies) == 1 else f"body_{asked.body}__"
    given = {f"{own}heave": asked.displacement.heave, f"{own}roll": asked.displacement.roll}
    motions = np.array([given.get(name, 0.0) for name in scale.dofs])
    unknowns: np.ndarray = np.linalg.solve(scale.turn, motions / scale.lengths)
    return unknowns


def _integrand(
    model: OpenModel,
    limit: np.ndarray,
    initial: np.ndarray,
    omegas: np.ndarray,
    added: np.ndarray,
) -> np.ndarray:
    """E at p = conj(−iω), shape (points, body unknowns)."""
    values = []
    for omega, hydrodynamic in zip(omegas, added, strict=True):
        p = -1j * omega
        whole, high = (
            np.linalg.solve(p**2 * mass + model.stiffness, p * mass @ initial)
            for mass in (model.mass + hydrodynamic, model.mass + limit)
        )
        values.append(np.conj(whole - high))
    return np.array(values)


def _residues(model: OpenModel, poles: list[Eigenpair], initial: np.ndarray) -> list[np.ndarray]:
    """Residues of S at the resonances: −a (aᵀKa₀)/(2λ xᵀT'x)."""
    return [
        -pole.bodies * (pole.bodies @ model.stiffness @ initial) / (2.0 * pole.eigenvalue * pole.norm) for pole in poles
    ]


def _summed(
    times: np.ndarray,
    poles: list[Eigenpair],
    residues: list[np.ndarray],
    radii: np.ndarray,
    ray: _Ray,
    integrand: np.ndarray,
) -> np.ndarray:
    """a(t), shape (times, body unknowns)."""
    motion = np.zeros((len(times), integrand.shape[1]))
    for pole, residue in zip(poles, residues, strict=True):
        p = -1j * np.sqrt(pole.eigenvalue)
        motion += 2.0 * np.real(np.exp(p * times)[:, None] * residue)
    direction = 1j * np.exp(1j * ray.angle)
    step = np.log(radii[1] / radii[0])
    weights = (integrand * (radii * step * direction)[:, None]) / pi
    for place in range(0, len(times), 256):
        waves = np.exp(np.outer(times[place : place + 256], radii) * direction)
        motion[place : place + 256] += np.imag(waves @ weights)
    return motion


def _errors(
    times: np.ndarray,
    poles: list[Eigenpair],
    residues: list[np.ndarray],
    causes: FrequencyErrors,
    values: np.ndarray,
    missed: np.ndarray,
    *,
    fades: bool,
) -> np.ndarray:
    """Error over time: of the phase and decay of each resonance, of all else in proportion, and what the sum at t = 0
    misses of the initial displacement, which is of high frequency, and fades but for the ringing of beams."""
    fastest = max((abs(np.sqrt(pole.eigenvalue)) for pole in poles), default=1.0)
    total = np.abs(missed).max() / (1.0 + fades * (fastest * times) ** 2)
    relative = causes.total.max(initial=0.0)
    for pole, residue, error in zip(poles, residues, causes.total, strict=True):
        omega = np.sqrt(pole.eigenvalue)
        swing = 2.0 * np.abs(residue).max() * np.exp(omega.imag * times)
        total = total + swing * error * (1.0 + abs(omega) * times)
    return total + relative * np.abs(values).max(axis=1)


def _table(asked: Decay, motion: _Motion) -> DecayTable:
    model = motion.model
    scale = model.scale
    # Amplitudes are per metre; the unknowns are per unit of length.
    factor = model.basin.units.length
    displacement = scale.amplitudes(motion.values) * factor
    initial = scale.amplitudes(_initial(model, asked)) * factor
    times = np.array(asked.times)
    return DecayTable(
        times=times,
        dofs=scale.dofs,
        displacement=displacement,
        initial=initial,
        absolute_error=motion.errors * factor,
        tail=_tail(asked, motion),
        certified_until=float(times.max()),
    )


def _tail(asked: Decay, motion: _Motion) -> float | None:
    """T of a ~ T/t² of the motion that was let go; none where the water has a bed, or where two were."""
    model = motion.model
    mixed = asked.displacement.heave != 0.0 and asked.displacement.roll != 0.0
    if mixed or not all(isinf(depth) for depth in model.basin.depths):
        return None
    initial = _initial(model, asked)
    restored = np.flatnonzero(np.diag(model.stiffness) > 0.0)
    own = np.ix_(restored, restored)
    tail = np.zeros(len(initial))
    tail[restored] = -2.0 / pi * np.linalg.solve(model.stiffness[own], motion.slow[own] @ initial[restored])
    seconds = model.basin.units.frequency**-2
    motions = model.scale.amplitudes(tail) * model.basin.units.length * seconds
    return float(motions[np.argmax(np.abs(model.scale.amplitudes(initial)))])
