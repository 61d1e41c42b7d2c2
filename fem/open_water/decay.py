"""Free motion of bodies in open water after a float is released at rest on still water.

With p for d/dt and λ = −p², from a displacement a₀

    [p²(M + H) + pB + K] S(p) = [p (M + H) + B] a₀,
    a(t) = 2 Re Σ rⱼ e^{pⱼt} + (1/π) Im ∫₀^∞ E(re^{iφ}) e^{iφ} e^{re^{iφ}t} dr :

the resonances between the imaginary axis and the ray arg p = φ, and an integral along that ray, see `ray`. Each part
has a mesh of its own: the phase error of a resonance grows over many periods, but its waves have one length; the
integral involves waves of all lengths, and each contributes little.

Source: form (C) of the thin float, `modal.thin_float_decay`, with H of the exact body.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import isinf, pi, tan

import numpy as np

from hydroelastic.fem.open_water.attempts import best_over_band
from hydroelastic.fem.open_water.basin import open_basin
from hydroelastic.fem.open_water.field_model import Band, OpenModel
from hydroelastic.fem.open_water.high_frequency import highest_meshed_frequency
from hydroelastic.fem.open_water.infinite_frequency import (
    BodiesAtInfiniteFrequency,
    bodies_at_infinite_frequency,
    infinite_frequency_added_mass,
)
from hydroelastic.fem.open_water.low_frequency import has_low_frequency_series, lowest_meshed_frequency
from hydroelastic.fem.open_water.model_building import open_model
from hydroelastic.fem.open_water.motion_scale import motion_scale
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.ray import RayIntegral, RayMotion, ray_between
from hydroelastic.fem.open_water.region import Region
from hydroelastic.fem.open_water.requests import DecayRequest
from hydroelastic.fem.open_water.resonance import ANGLE, resonance_errors, rough_resonances
from hydroelastic.fem.open_water.resonance_search import Eigenpair, ResonanceSearch
from hydroelastic.fem.open_water.results import DecayTable
from hydroelastic.fem.tank.attempts import Attempt
from hydroelastic.fem.tank.field_model import whole_bodies
from hydroelastic.fem.tank.resolution import Resolution
from hydroelastic.physics.tank import Tank

# Largest angle from the real axis at which resonances are sought, rad.
_SEARCHED = 0.54
# Lowest frequency of the mesh of the resonances over the lowest |ω|.
_BELOW = 0.7
# Part of the tolerance that the resonances take.
_SHARE = 0.5
# Part of the largest momentum below which one is rounding.
_PUSHED = 1e-6
# Natural frequencies above this multiple of that of the float alone are those of beams.
_FAST = 3.0


class UnstableFloatError(ValueError):
    """A float is unstable and would capsize."""


class DriftingFloatError(ValueError):
    """A release would start a motion without restoring force.

    Attributes:
        motions: names of such motions, sorted.
    """

    def __init__(self, motions: list[str]) -> None:
        super().__init__(f"nothing restores {' and '.join(motions)}")
        self.motions = motions


@dataclass(frozen=True, kw_only=True)
class DecaySolution:
    """Result of a decay analysis."""

    table: DecayTable  # the results in SI units
    model: OpenModel  # the last field model
    error: float  # largest error relative to the initial displacement
    solved: int  # number of frequencies of the ray with a factorization at the last resolution


@dataclass(frozen=True, kw_only=True)
class _ResonantMotion:
    """The sum over the resonances to the right of the ray, dimensionless. Shapes: n times, m body unknowns."""

    motion: np.ndarray  # Σ 2 Re(rⱼ e^{pⱼt}), shape (n, m)
    errors: np.ndarray  # estimated error of the motion, shape (n,)
    fastest: float  # the largest |ω|


@dataclass(frozen=True, kw_only=True)
class _Waves:
    model: OpenModel
    found: RayMotion


def solve_decay(problem: OpenWaterProblem, request: DecayRequest) -> DecaySolution:
    """Motion after a release, with an error below the tolerance times the initial displacement (collective)."""
    limit = bodies_at_infinite_frequency(problem)
    _check_release(limit, request)
    # Dry modes of beams of much higher frequency deform quasi-statically in the motion of the float.
    fastest = max(limit.frequencies(floats=True))
    expected = [omega for omega in limit.frequencies() if omega <= _FAST * fastest]
    region = Region(lowest=0.2 * expected[0], highest=1.3 * expected[-1], damping=tan(_SEARCHED))
    _, resonances = rough_resonances(problem, expected, region)
    ray = ray_between(resonances)
    # At t = 0 the sum of both parts should be the initial displacement.
    times = np.array([*request.times, 0.0])
    band = ray_band(problem.tank, problem.tolerance, request, expected)
    within = [omega for omega in resonances if -np.angle(omega) < ray.angle]
    resonant = _resonant_motion(problem, request, within, band.highest)

    def solve(resolution: Resolution) -> Attempt[_Waves]:
        # The number of dry modes follows from the resonances; both parts use the same ones.
        resolution = replace(resolution, shapes=resonant.resolution.shapes)
        added = _infinite_frequency_added_mass(problem, resolution)
        model = open_model(problem, band, resolution, angle=ray.scaling)
        unit = model.basin.units.frequency
        initial = _initial(model, request)
        integral = RayIntegral(
            model=model,
            limit=model.scale.unknown_masses(added),
            initial=initial,
            ray=ray,
            band=(band.lowest / unit, band.highest / unit),
            slow=0.5 * expected[0] / unit,
        )
        found = integral.followed(times * unit, has_low_series=has_low_frequency_series(problem.tank))
        size = np.abs(initial).max()
        missed = np.abs(resonant.result.motion[-1] + found.motion[-1] - initial).max()
        causes = replace(found.errors, liquid=found.errors.liquid + resonant.result.errors + missed).scaled(1.0 / size)
        return Attempt(result=_Waves(model=model, found=found), causes=causes, resolution=resolution)

    waves = best_over_band(problem, band, solve).result
    return _solution(request, resonant.result, waves)


def ray_band(water: Tank, tolerance: float, request: DecayRequest, expected: list[float]) -> Band:
    """Return the range of frequencies that the mesh of the ray resolves."""
    latest = max(*request.times, 1.0 / expected[-1])
    return Band(
        lowest=min(lowest_meshed_frequency(water, latest), expected[0]),
        highest=highest_meshed_frequency(expected[-1], tolerance),
    )


def _solution(request: DecayRequest, resonant: _ResonantMotion, waves: _Waves) -> DecaySolution:
    """Return the sum of the motions in the resonances and along the ray."""
    model, found = waves.model, waves.found
    initial = _initial(model, request)
    motion = resonant.motion + found.motion
    # The difference from the initial displacement at t = 0 is of high frequency, and decays unless beams vibrate.
    missed = np.abs(motion[-1] - initial).max()
    fades = not model.basin.tank.elastic
    times = np.array(request.times) * model.basin.units.frequency
    errors = (resonant.errors + found.errors.total)[:-1] + missed / (1.0 + fades * (resonant.fastest * times) ** 2)
    return DecaySolution(
        table=_table(request, model, motion[:-1], errors, found.slow),
        model=model,
        error=float(errors.max() / np.abs(initial).max()),
        solved=found.solved,
    )


def _check_release(limit: BodiesAtInfiniteFrequency, request: DecayRequest) -> None:
    """Raise an error for a release after which a body does not return to its position of rest."""
    restoring = np.diag(limit.stiffness)
    if np.any(restoring[limit.of_floats] < 0.0):
        raise UnstableFloatError("a float is unstable and would capsize")
    loose = restoring == 0.0
    given = {"heave": request.heave, "roll": request.roll, "pitch": request.roll}
    initial = np.array([given.get(dof, 0.0) if body == request.body else 0.0 for body, dof in limit.motions])
    pushed = (limit.mass + limit.added_mass) @ initial
    if np.any(np.abs(pushed[loose]) > _PUSHED * np.abs(pushed).max()):
        raise DriftingFloatError(sorted({limit.motions[place][1] for place in np.flatnonzero(loose)}))


def _resonant_motion(
    problem: OpenWaterProblem, request: DecayRequest, resonances: list[complex], highest: float
) -> Attempt[_ResonantMotion]:
    """The motion in the resonances to the right of the ray, on a mesh for their waves (collective)."""
    lowest = min((_BELOW * abs(omega) for omega in resonances), default=highest)
    band = Band(lowest=lowest, highest=highest)
    times = np.array([*request.times, 0.0])

    def solve(resolution: Resolution) -> Attempt[_ResonantMotion]:
        model = open_model(problem, band, resolution, angle=ANGLE)
        search = ResonanceSearch(model.pencil, model.stiffness, model.mass, model.outside.damping)
        poles = [search.refined(model.squared_frequency(omega)) for omega in resonances]
        causes = resonance_errors(model, poles)
        initial = _initial(model, request)
        residues = _residues(model, poles, initial)
        scaled = times * model.basin.units.frequency
        omegas = [complex(np.sqrt(pole.eigenvalue)) for pole in poles]
        motion = np.zeros((len(times), len(initial)))
        phases = np.zeros((len(poles), len(times)))
        for row, (omega, residue) in enumerate(zip(omegas, residues, strict=True)):
            motion += 2.0 * np.real(np.exp(-1j * omega * scaled)[:, None] * residue)
            # Factor of the relative error of ω in that of the motion: phase and decay.
            swing = 2.0 * np.abs(residue).max() * np.exp(omega.imag * scaled)
            phases[row] = swing * (1.0 + abs(omega) * scaled)
        found = _ResonantMotion(motion=motion, errors=causes.total @ phases, fastest=max(map(abs, omegas), default=1.0))
        weights = phases.max(axis=1) / (_SHARE * np.abs(initial).max())
        return Attempt(result=found, causes=causes.scaled(weights), resolution=resolution)

    return best_over_band(problem, band, solve)


def _residues(model: OpenModel, poles: list[Eigenpair], initial: np.ndarray) -> list[np.ndarray]:
    """Residues of S at the resonances: −a (aᵀKa₀)/(2λ xᵀT'x)."""
    return [
        -pole.bodies * (pole.bodies @ model.stiffness @ initial) / (2.0 * pole.eigenvalue * pole.norm) for pole in poles
    ]


def _infinite_frequency_added_mass(problem: OpenWaterProblem, resolution: Resolution) -> np.ndarray:
    """a(∞) in SI units, shape (motions, motions) (collective)."""
    long = open_basin(problem.tank, 0.0)
    matrix, _ = infinite_frequency_added_mass(problem, resolution.shapes)
    scale = motion_scale(long, whole_bodies(long.tank, resolution.shapes))
    return scale.masses(matrix)


def _initial(model: OpenModel, request: DecayRequest) -> np.ndarray:
    scale = model.scale
    given = {"heave": request.heave, "roll": request.roll, "pitch": request.roll}
    released = (None, request.body + 1)
    motions = np.array([given.get(dof.motion, 0.0) if dof.body in released else 0.0 for dof in scale.dofs])
    unknowns: np.ndarray = np.linalg.solve(scale.turn, motions / scale.lengths)
    return unknowns


def _table(
    request: DecayRequest, model: OpenModel, motion: np.ndarray, errors: np.ndarray, slow: np.ndarray | None
) -> DecayTable:
    scale = model.scale
    # Amplitudes are per metre; the unknowns are per unit of length.
    factor = model.basin.units.length
    times = np.array(request.times)
    return DecayTable(
        times=times,
        dofs=scale.dofs,
        displacement=scale.amplitudes(motion) * factor,
        initial=scale.amplitudes(_initial(model, request)) * factor,
        absolute_error=errors * factor,
        tail=_tail(request, model, slow),
        tail_power=4 if _spreads_in_deep_water(model) else 2,
        certified_until=float(times.max()),
    )


def _tail(request: DecayRequest, model: OpenModel, slow: np.ndarray | None) -> float | None:
    """T of the asymptotic tail a ~ T/t² of the released motion, m s² or rad s², or T/t⁴ about an axis in deep water.

    ``None`` for sections over a bed, if two motions were released, and about an axis for pitch and between two liquids.
    """
    tank = model.basin.tank
    initial = _initial(model, request)
    if request.heave != 0.0 and request.roll != 0.0:
        return None
    if tank.geometry.is_revolved:
        if tank.geometry.order > 0 or len(tank.layers) > 1:
            return None
        # Long waves lift bodies by their buoyancy f: b/ω is ω²ffᵀ/(2ρg³) in deep water, and ffᵀ/(4ρg²H) over a bed.
        lift = np.concatenate([body.stiffness for body in model.pencil.bodies])
        slow = np.outer(lift, lift) / (2.0 if _spreads_in_deep_water(model) else 4.0 * model.basin.depths[0])
    if slow is None:
        return None
    restored = np.flatnonzero(np.diag(model.stiffness) > 0.0)
    own = np.ix_(restored, restored)
    tail = np.zeros(len(initial))
    # p ln p is that of 1/t², and p³ ln p that of 6/t⁴.
    factor = 12.0 / pi if _spreads_in_deep_water(model) else -2.0 / pi
    tail[restored] = factor * np.linalg.solve(model.stiffness[own], slow[own] @ initial[restored])
    seconds = model.basin.units.frequency ** (-4 if _spreads_in_deep_water(model) else -2)
    motions = model.scale.amplitudes(tail) * model.basin.units.length * seconds
    return float(motions[np.argmax(np.abs(model.scale.amplitudes(initial)))])


def _spreads_in_deep_water(model: OpenModel) -> bool:
    return model.basin.tank.geometry.is_revolved and isinf(model.basin.depths[0])
