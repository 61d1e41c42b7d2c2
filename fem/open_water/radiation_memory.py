"""The memory of the waves that bodies radiate: H along a ray of complex frequencies, as exponentials in time.

H on a reduced basis of solutions on the ray and on the real axis, with the series `low_frequency` below the mesh, gives
the exponentials of `fem/time_domain/radiation_memory.py`. Resonances of the water between bodies that lie between the
real axis and the ray are exponentials of their own. H on the real axis, K(0) = (2/π) ∫ b dω and b, which is not
negative, tell the error: where H is analytic in between but for them, and a∞ of the problem with ψ = 0 on the free
surface is its limit, all agree. The band of the mesh grows until what is beyond it is known, if it may be.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from math import acos, inf, pi, sqrt
from typing import TypeAlias

import numpy as np

from hydroelastic.fem.open_water.attempts import best_over_band
from hydroelastic.fem.open_water.basin import open_basin
from hydroelastic.fem.open_water.field_model import ANGLE, ANGLE_OVER_A_BED, NO_WATER, Band, OpenModel
from hydroelastic.fem.open_water.high_frequency import arc, highest_meshed_frequency
from hydroelastic.fem.open_water.infinite_frequency import infinite_frequency_added_mass
from hydroelastic.fem.open_water.low_frequency import (
    has_low_frequency_series,
    is_infinitely_deep,
    lowest_meshed_frequency,
)
from hydroelastic.fem.open_water.model_building import open_model
from hydroelastic.fem.open_water.motion_scale import motion_scale
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.radiation import relative_difference, reported_shapes
from hydroelastic.fem.open_water.ray import Ray, hydrodynamics_along_ray
from hydroelastic.fem.open_water.requests import ImpulseResponseRequest
from hydroelastic.fem.open_water.results import Complexes, Floats
from hydroelastic.fem.open_water.solver import OpenSolver
from hydroelastic.fem.open_water.sweep import Problem, sweep
from hydroelastic.fem.tank.attempts import Attempt
from hydroelastic.fem.tank.error_estimates import FrequencyErrors, joined_errors
from hydroelastic.fem.tank.field_model import whole_bodies
from hydroelastic.fem.tank.resolution import Resolution
from hydroelastic.fem.time_domain.radiation_memory import (
    DampingTail,
    RadiationMemory,
    damping_tail,
    memory_on_ray,
    motion_sizes,
    ray_radii,
)
from hydroelastic.fem.time_domain.results import ImpulseResponseTable
from hydroelastic.physics.bodies import Body
from hydroelastic.physics.dofs import Dof
from hydroelastic.physics.tank import Tank

# Points of the ray, of the arc beyond it and of the real axis at which the basis must be accurate.
_ON_RAY, _ON_ARC, _ON_AXIS = 40, 12, 20
# Part of the tolerance that is left to the basis: in long waves its error on the ray is not that on the real axis.
_OF_BASIS = 0.1
# Error of the trapezoidal rule along the ray.
_RULE = 1e-9
# Angle over α within which resonances of the water are sought: the continuous spectrum is at half of α.
_SEARCHED = 0.35
# Factor of a resonance ω beside it, within which the water mainly oscillates as in it.
_BESIDE = 1.0 - 0.02j
# Part of H that a resonance of the water adds to it at the same frequency, below which it is none.
_NO_PEAK = 1e-8
# Relative change of a resonance by a solution beside it, above which it may be one of the basis alone, and the number
# of times that such solutions are added.
_STILL, _ROUNDS = 1e-3, 5
# Largest angle between the ray and what is beside it, rad: the farther from the real axis, the more do waves grow
# before they are absorbed, and the more elements these need; half of it doubles the number of exponentials.
_WIDE = 0.15
# Angle between points of one ray, rad.
_ROUNDING = 1e-9
# The mesh's highest frequency over that of waves as short as the bodies, by which it grows while what is beyond it is
# not known, and the number of times.
_ABOVE, _MOST_RAISES = 1.5, 2
# Part of the tolerance of K(0) that is left to what is beyond it; as much is left to what is below.
_TAIL = 0.4
# Frequencies over the highest one at which exponentials beyond the ray are fitted, but for those that are as near to a
# resonance; frequencies of these exponentials, and error of H in the fit over the tolerance.
_FITTED, _CLEAR = np.geomspace(1e-3, 1.0, 150), 0.01
_FASTER, _MISFIT = np.exp(np.arange(np.log(0.5), np.log(60.0), 0.1)), 0.01
# Errors of b at different frequencies cancel in its integral. Measured on a rectangle and a cylinder: the sum of their
# magnitudes is 100 to 300 times the error.
_PHASES = 0.05
# Where the tangent at the end of an arc is taken, of its length.
_BESIDE_END = 1e-6
# Most that errors of H are lowered for K.
_MOST_AMPLIFIED = 4.0
# Frequencies over the highest one at which the sign of b is checked.
_DAMPED = np.geomspace(1e-2, 30.0, 2000)
# Lower end of the ray, as a multiple of 1/t.
_LOWER = 1e-3


@dataclass(frozen=True, kw_only=True)
class WaterMemory:
    """The memory of the water around bodies. Shapes: m motions, c frequencies."""

    memory: RadiationMemory  # the exponentials and a∞, SI units per metre of width
    dofs: tuple[Dof, ...]  # m degrees of freedom
    omega: Floats  # frequencies of the check, rad/s, shape (c,)
    hydrodynamic: Complexes  # a + i b/ω there, not by the memory, shape (c, m, m)
    model: OpenModel  # the field model
    error: float  # estimated relative error of H on the ray and of a∞
    tail: DampingTail  # b beyond the last frequency

    @property
    def by_memory(self) -> Complexes:
        """a + i b/ω by the memory at the frequencies of the check, shape (c, m, m)."""
        return self.memory.hydrodynamic(self.omega)

    @property
    def causality_error(self) -> Floats:
        """Largest difference of both, relative to `motion_sizes` of both motions, shape (c,)."""
        return self._largest(np.abs(self.by_memory - self.hydrodynamic))

    @property
    def ogilvie_error(self) -> Floats:
        """Largest difference of a(ω) + (1/ω) ∫ K sin ωt dt from a∞, relative to the same, shape (c,)."""
        return self._largest(np.abs((self.by_memory - self.hydrodynamic).real))

    def impulse_response_errors(self, times: Floats) -> Floats:
        """Estimated error of K at times, relative to K(0) of both motions, shape (n,)."""
        tail = self.tail
        within = self.error * _amplification(tail, np.diag(self.memory.infinite_frequency_added_mass))
        scale = np.sqrt(np.outer(tail.sizes, tail.sizes))
        at_start = np.abs(self.memory.impulse_response(np.zeros(1))[0] - tail.start) / scale
        # What is negative of b takes power from nowhere.
        omega = tail.highest * _DAMPED
        lowest = np.linalg.eigvalsh(self.memory.radiation_damping(omega) / scale)[:, 0]
        gained = 2.0 / pi * np.trapezoid(np.maximum(-lowest, 0.0), omega)
        errors: Floats = tail.errors(times) + within.max() + at_start.max() + gained
        return errors

    def _largest(self, differences: Floats) -> Floats:
        sizes = motion_sizes(self.hydrodynamic, self.memory.infinite_frequency_added_mass, self.tail)
        largest: Floats = (differences / (sizes[:, :, None] * sizes[:, None])).max(axis=(1, 2))
        return largest


Memory: TypeAlias = Callable[[int, int], WaterMemory]
"""The memory of the water by azimuthal order, 0 of sections, and number of elastic shapes of each beam (collective)."""


@dataclass(frozen=True, kw_only=True)
class _Found:
    """The memory at one resolution, and H on the real axis, in SI units."""

    memory: RadiationMemory
    model: OpenModel
    omega: np.ndarray
    hydrodynamic: np.ndarray
    tail: DampingTail
    error: float


def solve_memory(problem: OpenWaterProblem, latest: float, elastic_modes: int, earliest: float = inf) -> WaterMemory:
    """Return the memory of the water, to the tolerance of the problem (collective)."""
    long = open_basin(problem.tank, 0.0)
    shapes = reported_shapes(long.tank, elastic_modes)
    matrix, limit_error = infinite_frequency_added_mass(problem, shapes)
    latest = max(latest, 1.0 / long.units.frequency)
    bodies = whole_bodies(long.tank, shapes)
    scale = motion_scale(long, bodies)
    limit = scale.masses(matrix)
    least_powers = np.concatenate(
        [np.full(one.size, _least_power(body)) for one, body in zip(bodies, long.tank.bodies, strict=True)]
    )
    band = memory_band(problem.tank, problem.tolerance, latest, elastic_modes)
    bodies_highest = band.highest
    band = replace(band, highest=_ABOVE * band.highest)
    scaling = ANGLE if is_infinitely_deep(problem.tank) else ANGLE_OVER_A_BED

    def solve(band: Band, resolution: Resolution) -> Attempt[_Found]:
        model = open_model(problem, band, replace(resolution, shapes=shapes), angle=scaling)
        unit = model.basin.units.frequency
        low, high = band.lowest / unit, band.highest / unit
        solver = OpenSolver(model)
        causes: dict[complex, FrequencyErrors] = {}

        def full(omega: complex) -> np.ndarray:
            radiated = solver.radiation(omega**2)
            added = model.pencil.products(model.pencil.loads.astype(complex), radiated)
            causes[omega] = model.errors(radiated, np.abs(np.diag(added)))
            return added

        # Lower ones change K at later times only.
        axis = np.geomspace(max(low, 1.0 / (latest * unit)), bodies_highest / unit, _ON_AXIS)
        hydrodynamics = Problem(
            full=full, reduced=lambda omega: solver.hydrodynamic(omega**2), difference=relative_difference
        )

        def swept_along(ray: Ray, further: np.ndarray) -> float:
            """Make the basis accurate on the ray, the arc beyond it and at further ω; return its largest error."""
            along = np.geomspace(low, high, _ON_RAY) * ray.turned
            chosen = np.concatenate([along, arc(high * ray.turned, _ON_ARC)[:-1], further])
            return float(sweep(hydrodynamics, chosen, _OF_BASIS * problem.tolerance).errors.max())

        ray = _widest_ray(np.zeros(0), scaling)
        basis_error = swept_along(ray, axis)
        resonances = _settled_resonances(solver, (low, high), _SEARCHED * scaling)
        if len(resonances):
            ray = _widest_ray(resonances, scaling)
            basis_error = max(basis_error, swept_along(ray, np.zeros(0)))
        resonances, residues = _resonances(solver, (low, high), ray.angle, resonances)
        far = model.scale.unknown_masses(limit)
        least = min(_LOWER / (latest * unit), 1e-4 * low)
        # The ray ends at the highest frequency.
        radii = high / ray_radii(1.0, high / least, ray.gap, _RULE)[::-1]
        has_series = has_low_frequency_series(problem.tank)
        added, _ = hydrodynamics_along_ray(solver, ray, radii, (low, high), None, has_low_series=has_series)
        beyond = added - far
        if not has_series:
            beyond = _with_long_waves(beyond, -1j * radii * ray.turned, int(np.searchsorted(radii, low)))

        def masses(matrices: np.ndarray) -> np.ndarray:
            return np.array([model.scale.masses(one) for one in matrices]).reshape(-1, *limit.shape)

        def hydrodynamic(omegas: np.ndarray) -> np.ndarray:
            return masses(solver.hydrodynamics((omegas / unit) ** 2))

        memory = memory_on_ray(
            masses(beyond),
            limit,
            radii * unit,
            ray.angle,
            poles=np.conj(-1j * resonances * unit),
            residues=(unit**2 * masses(residues.conj())).astype(np.complex128),
        )
        inertia = np.abs(np.diag(model.scale.masses(model.mass))) + np.diag(limit)
        tail = damping_tail(
            hydrodynamic,
            band.highest,
            NO_WATER * band.highest**2 * inertia,
            least_powers,
            has_peaks=len(resonances) > 0,
        )
        fitted = _FITTED * band.highest
        fitted = fitted[fitted > axis[0] * unit]
        clear = np.abs(fitted[:, None] / (unit * resonances.real) - 1.0) > _CLEAR
        fitted = fitted[clear.all(axis=1)]
        memory = memory.completed(
            fitted,
            hydrodynamic(fitted),
            1j * np.exp(1j * ray.angle) * band.highest * _FASTER,
            tail,
            (_MISFIT * problem.tolerance, problem.tolerance),
        )
        found = _Found(
            memory=memory,
            model=model,
            omega=axis * unit,
            hydrodynamic=hydrodynamic(axis * unit),
            tail=tail,
            error=inf,
        )
        # Those of rays that were left do not matter.
        own = [cause for omega, cause in causes.items() if -np.angle(omega) < ray.angle + _ROUNDING]
        causes_of_h = joined_errors(own, basis_error + limit_error)
        found = replace(found, error=causes_of_h.largest_total)
        needed = 1.0
        if earliest < inf:
            needed = float(np.clip(2.0 * _amplification(tail, np.diag(limit)).max(), 1.0, _MOST_AMPLIFIED))
        return Attempt(result=found, causes=causes_of_h.scaled(needed), resolution=resolution)

    attempt = best_over_band(problem, band, partial(solve, band))
    for _ in range(_MOST_RAISES):
        tail = attempt.result.tail
        # Narrow water has ever more resonances above.
        if tail.errors(np.array([earliest])).max() <= _TAIL * problem.tolerance or tail.is_slow or tail.has_peaks:
            break
        band = replace(band, highest=_ABOVE * band.highest)
        higher = best_over_band(problem, band, partial(solve, band))
        if higher.result.tail.error.max() + higher.error > tail.error.max() + attempt.error:
            break
        attempt = higher
    found = attempt.result
    return WaterMemory(
        memory=found.memory,
        dofs=scale.dofs,
        omega=found.omega,
        hydrodynamic=found.hydrodynamic,
        model=found.model,
        error=found.error,
        tail=found.tail,
    )


def _settled_resonances(solver: OpenSolver, band: tuple[float, float], angle: float) -> np.ndarray:
    """Extend the basis beside its resonances of the water until these stay where they are, and return them, see
    `_resonances` (collective)."""
    resonances = np.zeros(0, dtype=complex)
    for _ in range(_ROUNDS):
        found = _resonances(solver, band, angle)[0]
        moved = found[~_is_among(found, resonances)]
        resonances = found
        if not len(moved):
            break
        for omega in moved:
            # The solution beside it is nearly the resonance, and not all rounding.
            solver.radiation((omega * _BESIDE) ** 2)
    return _resonances(solver, band, angle, resonances)[0]


def _resonances(
    solver: OpenSolver, band: tuple[float, float], angle: float, known: np.ndarray | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """ω of the water about fixed bodies within an angle from the real axis, dimensionless, shape (k,), and R of
    H = Σ R/(ω² − ω'²) there, shape (k, m, m), of those that a smaller basis knew, if they are given (collective)."""
    squares, residues = solver.water_resonances()
    omegas = np.sqrt(squares)
    # Hardly damped ones may be above the real axis by the error of the mesh.
    within = (-np.angle(omegas) < angle) & (np.angle(omegas) < _STILL)
    within &= (np.abs(omegas) > band[0]) & (np.abs(omegas) < band[1])
    omegas, residues = omegas[within].real - 1j * np.abs(omegas[within].imag), residues[within]
    sizes = np.abs(solver.hydrodynamics(np.abs(omegas) ** 2 * np.exp(-1j * angle))).max(axis=(1, 2), initial=0.0)
    tiny = np.finfo(float).tiny
    matters = np.abs(residues).max(axis=(1, 2), initial=0.0) > _NO_PEAK * sizes * np.abs((omegas**2).imag) + tiny
    if known is not None:
        matters &= _is_among(omegas, known)
    return omegas[matters], residues[matters]


def _is_among(omegas: np.ndarray, known: np.ndarray) -> np.ndarray:
    """Whether each of some resonances, shape (k,), is the same as a known one."""
    same: np.ndarray = (np.abs(omegas[:, None] - known) < _STILL * np.abs(omegas[:, None])).any(axis=1)
    return same


def _widest_ray(resonances: np.ndarray, scaling: float) -> Ray:
    """Return the ray with most room between the real axis, resonances of the water, and its continuous spectrum of deep
    water, arg ω = −α/2; of those with enough of it the nearest to the real axis."""
    stops = [0.0, *sorted(-np.angle(resonances)), 0.5 * scaling]
    gaps = [(float(low), min(0.5 * float(high - low), _WIDE)) for low, high in pairwise(stops)]
    low, gap = max(gaps, key=lambda found: found[1])
    return Ray(angle=low + gap, gap=gap)


def _with_long_waves(beyond: np.ndarray, p: np.ndarray, first: int) -> np.ndarray:
    """H − a∞ over a bed, shape (k, m, m), with K̂ = c₀ + c₁p, c₀ = lim b and c₁ real, below the first meshed one of p.

    Waves longer than those of the mesh are not absorbed, and b would vanish with them.
    """
    meshed = p[first] * beyond[first]
    slope = meshed.imag / p[first].imag
    start = meshed.real - slope * p[first].real
    long = start / p[:first, None, None] + slope
    return np.concatenate([long, beyond[first:]])


def memory_band(water: Tank, tolerance: float, latest: float, elastic_modes: int) -> Band:
    """Return the range of frequencies that the bodies need.

    The highest frequency is that of waves as short as the bodies, or as the shortest shape of a beam.
    """
    narrowest = min(_narrowest(body, elastic_modes, is_revolved=water.geometry.is_revolved) for body in water.bodies)
    fastest = sqrt(pi * water.gravity / narrowest)
    return Band(lowest=lowest_meshed_frequency(water, latest), highest=highest_meshed_frequency(fastest, tolerance))


def _narrowest(body: Body, elastic_modes: int, *, is_revolved: bool) -> float:
    """The length, m, that is half of the shortest wave of a body.

    Waves as short as the thickness of a pipe neither pass under it nor know how thick it is.
    """
    left, right = body.waterplane
    if body.is_elastic:
        return (right - left) / (elastic_modes + 1)
    if body.hull is not None and is_revolved and left > 0.0:
        low, high = body.hull.bounds[2:]
        return max(right - left, min(high - low, right))
    return right - left


def _amplification(tail: DampingTail, limit: np.ndarray) -> np.ndarray:
    """Relative error of K(0) by a relative error of H, shape (m,): of (2/π) ∫₀^Ω ω δH dω, where H is mostly a∞."""
    amplified: np.ndarray = _PHASES * tail.highest**2 / pi * limit / tail.sizes
    return amplified


def _least_power(body: Body) -> float:
    """The power of 1/ω with which the damping of a body decays at least, by the angle α in the water between it and the
    level: 2π/α − 1."""
    if body.hull is None:
        return 1.0
    angles = [0.5 * pi]
    if not body.hull.is_thin:
        chain = body.hull.below
        for points, outwards in (
            (chain[0].point(np.array([0.0, _BESIDE_END])), -1.0),
            (chain[-1].point(np.array([1.0, 1.0 - _BESIDE_END])), 1.0),
        ):
            x, y = points[1] - points[0]
            angles.append(acos(outwards * float(x / np.hypot(x, y))))
    return 2.0 * pi / max(angles) - 1.0


@dataclass(frozen=True, kw_only=True)
class ImpulseResponseSolution:
    """Result of an impulse response analysis."""

    table: ImpulseResponseTable  # the results in SI units
    model: OpenModel  # the last field model
    error: float  # the largest relative error of H, that of causality among them
    highest: float  # the frequency beyond which damping is not solved for, rad/s


def solve_impulse_response(request: ImpulseResponseRequest, water: WaterMemory) -> ImpulseResponseSolution:
    """Return the impulse responses of radiation, by the memory of the water."""
    times = np.array(request.times)
    errors = water.impulse_response_errors(times)
    table = ImpulseResponseTable(
        times=times,
        dofs=water.dofs,
        impulse_response=water.memory.impulse_response(times),
        infinite_frequency_added_mass=water.memory.infinite_frequency_added_mass,
        omega=water.omega,
        added_mass=water.memory.added_mass(water.omega),
        radiation_damping=water.memory.radiation_damping(water.omega),
        causality_error=water.causality_error,
        ogilvie_error=water.ogilvie_error,
        impulse_response_error=errors,
        relative_error=max(water.error, float(errors.max())),
    )
    return ImpulseResponseSolution(
        table=table,
        model=water.model,
        error=max(water.error, float(water.causality_error.max())),
        highest=water.tail.highest,
    )
