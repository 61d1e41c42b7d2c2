"""Complex resonances ω − iγ: free oscillations of bodies in open water that decay by radiating waves.

Number of resonances in a region by the argument principle, without searching for them.

The dynamic stiffness D(λ) = K − iωB − λ(M_b + H(λ)) of the bodies is singular at resonances, and has poles at the
resonances of the water around fixed bodies. Along the boundary of a region the argument of det D increases by 2π for
every zero within and decreases by 2π for every pole; the poles of H in `damped` are zeros of another determinant, which
is included as a factor. H comes from solutions on the boundary, on a reduced basis, and not from any eigenvector.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from math import atan2, sqrt
from typing import TypeAlias

import numpy as np

from hydroelastic.fem.open_water.attempts import best_over_band
from hydroelastic.fem.open_water.basin import extent_of_bodies, open_basin
from hydroelastic.fem.open_water.damped import DampedSolver, damped_resonances, mirror_angle
from hydroelastic.fem.open_water.field_model import ANGLE_OVER_A_BED, LAYER_WEIGHT, Band, OpenModel
from hydroelastic.fem.open_water.infinite_frequency import bodies_at_infinite_frequency, scaled_stiffness
from hydroelastic.fem.open_water.low_frequency import is_infinitely_deep
from hydroelastic.fem.open_water.model_building import first_resolution, open_model
from hydroelastic.fem.open_water.motion_scale import motion_scale
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.product_errors import square_errors
from hydroelastic.fem.open_water.region import MOST_DAMPING_ANYWHERE, Region
from hydroelastic.fem.open_water.requests import ResonanceRequest
from hydroelastic.fem.open_water.resonance_search import Eigenpair, ResonanceSearch
from hydroelastic.fem.open_water.results import ResonanceTable
from hydroelastic.fem.open_water.solver import OpenSolver
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.tank.attempts import Attempt
from hydroelastic.fem.tank.error_estimates import FrequencyErrors, boundary_error
from hydroelastic.fem.tank.field_model import whole_bodies
from hydroelastic.fem.tank.resolution import Resolution, rounding_error
from hydroelastic.fem.truncation import truncation_errors

ANGLE = 1.3
"""α of the complex scaling, rad: resonances with −Im ω/Re ω below tan(α/2) = 0.76 are eigenvalues in deep water; beyond
`MOST_DAMPING_ANYWHERE` they are found by `damped`."""

SHORTEST_WAVES = 100.0
"""Largest length of an elastic body, in radians of a wave, at whose frequency elastic tones are sought unasked."""

# By so much α exceeds −arg k over a bed.
_DECAYING = 0.5
# A resonance does not depend on α: largest |dλ/dα|/|λ| of an eigenvalue that counts as a resonance.
_STILL = 1e-2
# The same with a coarse mesh, of what may be a resonance; finer ones tell.
_NEARLY_STILL = 0.1
# Lower limit of the region over the lowest expected frequency.
_BELOW = 0.3
ABOVE = 1.25
"""Upper limit of the region over the highest expected frequency."""
# Eigenvalues sought near each target: a few resonances and those of the continuous spectrum.
_PER_TARGET = 8
# Error of λ over |dλ/dα|; measured on a circle and a thin float it is smaller.
_DRIFT = 0.1
# Factors of the damping of smaller regions, for the count where a resonance lies on the boundary.
_NARROWER = (0.93, 0.85)
# Relative distance of a resonance from the largest damping of a region within which it lies on the boundary.
_ON_BOUNDARY = 0.02
# Dry modes above this multiple of the highest frequency deform quasi-statically, and are left out of initial values.
_STIFF = 4.0
# Least damping of the starts of the search for damped resonances over the largest damping of the other search.
_OVERLAP = 0.9
# Distances of these starts in ln ω, reduced until as many resonances are found as are counted.
_SPACINGS = (0.1, 0.05, 0.025)
# Factor of the range of frequencies of a mesh for given resonances.
_AROUND = 1.1
# Relative difference of ω below which two targets have found the same resonance.
_SAME = 1e-6
# The same of solutions on a boundary, which are less accurate within.
_SAME_ROUGHLY = 1e-3
# Part of the stiffness of a motion below which a negative one of several together is rounding.
_UNSTABLE = 1e-12
# Bodies with a smaller participation are at rest in a resonance of the water.
_AT_REST = 1e-8

Solver: TypeAlias = OpenSolver | DampedSolver

# Points on the boundary at which the residual of the basis is computed, of `damped` and else, and initial points of the
# phase; multiples of four. Between bodies 60 m apart 16 points leave zeros in the region wrong.
_JUDGED_DAMPED, _JUDGED, _FIRST = 16, 64, 64

# Number of times that the distance between points may be halved, and the change of phase above which it is, radians.
_HALVINGS = 14
_TURN = 1.0

# Change of 2k times the extent of the bodies between neighbouring points above which more points are needed, radians.
_UNRESOLVED = 2.0

# Largest distance between points over that from a zero or a pole.
_CLOSE = 0.7

# The winding number needs few digits of H; its error goes like the square of the residual.
_RESIDUAL = 1e-2


@dataclass(frozen=True, kw_only=True)
class ResonanceSolution:
    """Result of a resonance analysis."""

    table: ResonanceTable  # the results in SI units
    model: OpenModel | None  # the last field model; ``None`` where no motion has a restoring force
    error: float  # the largest relative error
    known: int  # number of resonances that were found in the region of the independent count
    unstable: bool  # whether a float is unstable, with a growing motion that is not a resonance


@dataclass(frozen=True, kw_only=True)
class _Found:
    model: OpenModel
    pairs: list[Eigenpair]
    tried: int


def solve_resonance(problem: OpenWaterProblem, request: ResonanceRequest) -> ResonanceSolution:
    """Find resonances to the tolerance of the problem, and count them independently (collective)."""
    expected, beyond = expected_frequencies(problem, request)
    if not expected:
        return _nothing(problem)
    region = _region(expected, request)
    coarse, known = rough_resonances(problem, expected, region)
    damped = None
    solver: Solver
    if region.damping > MOST_DAMPING_ANYWHERE:
        damped, known = _damped_resonances(problem, coarse.resolution, region, known)
        solver = damped
    else:
        solver = OpenSolver(coarse)
        # Water that bodies hardly take part in has resonances far from all expected ones.
        inside = _inside(solver, region) or {}
        missing = [omega for omega in inside if not _is_known(omega, known, _SAME_ROUGHLY)]
        known = sorted([*known, *_search(coarse, missing, region, _NEARLY_STILL, known)], key=abs)
    values = known[: request.count]
    band, angle = Band(lowest=region.lowest, highest=region.highest), _angle(problem, values)
    if damped:
        band, angle = _around(values, region)

    def solve(resolution: Resolution) -> Attempt[_Found]:
        model = open_model(problem, band, resolution, angle=angle)
        search = DampedSolver(model) if damped else _outgoing_search(model)
        pairs = []
        for omega in values:
            # One of the coarse mesh alone is none; the count tells whether one is missing.
            with suppress(EigenSolverError):
                pairs.append(search.refined(model.squared_frequency(omega)))
        causes = resonance_errors(model, pairs)
        return Attempt(result=_Found(model=model, pairs=pairs, tried=len(values)), causes=causes, resolution=resolution)

    attempt = best_over_band(problem, band, solve)
    found = attempt.result
    closed, counted = _counted(solver, _closed_region(region, found, request), known)
    return ResonanceSolution(
        table=replace(_table(found, attempt.causes, counted, closed), not_sought=beyond),
        model=found.model,
        error=attempt.error,
        known=_known(found, closed, known),
        unstable=bool(np.linalg.eigvalsh(scaled_stiffness(found.model.stiffness)).min(initial=0.0) < -_UNSTABLE),
    )


def expected_frequencies(problem: OpenWaterProblem, request: ResonanceRequest) -> tuple[list[float], float | None]:
    """Return the frequencies near which resonances are sought, rad/s, ascending, and the lowest elastic tone that is
    not sought, if there is one (collective).

    Without an upper limit elastic tones of stiff bodies are not sought among waves far shorter than the bodies.
    """
    bodies = bodies_at_infinite_frequency(problem)
    expected = bodies.frequencies()
    elastic = [right - left for left, right in (body.waterplane for body in problem.tank.bodies if body.is_elastic)]
    if request.below is not None or not elastic:
        return expected, None
    rigid = bodies.frequencies(floats=True) if bodies.of_floats.any() else []
    sought = [
        omega
        for omega in expected
        if omega <= max(rigid, default=0.0) or _wavenumber(problem, omega) * min(elastic) <= SHORTEST_WAVES
    ]
    return sought, next((omega for omega in expected[: request.count] if omega not in sought), None)


def _wavenumber(problem: OpenWaterProblem, omega: float) -> float:
    """Largest wavenumber of waves of a frequency, 1/m."""
    return Band(lowest=omega, highest=omega).wavenumbers(problem.tank)[1]


def _known(found: _Found, region: Region, rough: list[complex]) -> int:
    """Number of resonances that are known in a region: all but those of the coarse mesh alone."""
    unit, tried = found.model.basin.units.frequency, rough[: found.tried]
    refined = [complex(np.sqrt(pair.eigenvalue)) * unit for pair in found.pairs]
    return sum(map(region.holds, [*rough[len(tried) :], *refined]))


def _nothing(problem: OpenWaterProblem) -> ResonanceSolution:
    """Return the solution without resonances, where no motion has a restoring force."""
    basin = open_basin(problem.tank, 0.0)
    dofs = motion_scale(basin, whole_bodies(basin.tank, (0,) * len(basin.tank.bodies))).dofs
    table = ResonanceTable(
        omega=np.zeros(0, dtype=complex),
        dofs=dofs,
        labels=(),
        body_amplitudes=np.zeros((0, len(dofs)), dtype=complex),
        residuals=np.zeros(0),
        relative_error=np.zeros(0),
        counted=0,
        region=None,
    )
    return ResonanceSolution(table=table, model=None, error=0.0, known=0, unstable=False)


def _counted(solver: Solver, region: Region, known: list[complex]) -> tuple[Region, int | None]:
    """Count in a region, or in a narrower one where a resonance lies on its boundary (collective)."""
    for damping in (1.0, *_NARROWER):
        narrower = replace(region, damping=damping * region.damping)
        if any(abs(-omega.imag / omega.real / narrower.damping - 1.0) < _ON_BOUNDARY for omega in known):
            continue
        if isinstance(solver, OpenSolver):
            inside = _inside(solver, narrower)
            certain = inside is not None and max(inside.values(), default=0.0) < _STILL
            counted = len(inside) if inside is not None and certain else None
        else:
            counted = zeros_in(solver, narrower.boundary)
        if counted is not None:
            return narrower, counted
    return region, None


def _inside(solver: OpenSolver, region: Region) -> dict[complex, float] | None:
    """ω in a region of the resonances by solutions on its boundary alone, rad/s, with |dλ/dα|/|λ| of each; ``None``
    where they do not agree with the argument of det D along it (collective).

    These solutions span the eigenvectors within (T. Sakurai and H. Tadano, Hokkaido Math. J. 36 (2007) 745). Poles of
    H, as of the water between two bodies, cancel zeros in the winding number; where waves grow more along the bodies
    than the mesh resolves, the continuous spectrum adds zeros and poles.
    """
    model, search = solver.model, _outgoing_search(solver.model)
    winding, size = zeros_in(solver, region.boundary), solver.basis_size
    omegas, vectors = solver.free_motions()
    inside = np.array([region.holds(omega) for omega in omegas])
    if winding != inside.sum() - sum(map(region.holds, solver.zeros_and_poles()[1])):
        return None
    found = {}
    for omega, vector in zip(omegas[inside], vectors[inside], strict=True):
        pair = search.pair(model.squared_frequency(omega), solver.lifted(vector[:size]), vector[size:])
        if pair.drift < _NEARLY_STILL and pair.participation > _AT_REST:
            found[complex(omega)] = pair.drift
    return found


def _is_known(omega: complex, known: list[complex], same: float) -> bool:
    return any(abs(omega - other) <= same * abs(omega) for other in known)


def _region(expected: list[float], request: ResonanceRequest) -> Region:
    highest = request.below if request.below is not None else ABOVE * expected[min(request.count, len(expected)) - 1]
    lowest, damping = _BELOW * min(expected[0], highest), request.largest_damping
    if damping > MOST_DAMPING_ANYWHERE:
        # Strongly damped resonances have a small Re ω for their |ω|.
        lowest /= sqrt(1.0 + damping**2)
    return Region(lowest=lowest, highest=highest, damping=damping)


def _around(values: list[complex], region: Region) -> tuple[Band, float]:
    """Return the range of frequencies of a mesh for given resonances, and α of its scaling, rad."""
    sizes = [abs(omega) for omega in values] or [region.lowest, region.highest]
    damping = max((-omega.imag / omega.real for omega in values), default=region.damping)
    return Band(lowest=min(sizes) / _AROUND, highest=max(sizes) * _AROUND), mirror_angle(damping)


def _angle(problem: OpenWaterProblem, values: list[complex]) -> float:
    """Return α, rad, of the mesh for given resonances.

    Over a bed e^{−κx} oscillates the faster the larger α is: at `ANGLE` this leaves 2e-8 of ω whatever the mesh of the
    basin. Waves of the wavenumber k decay if α is larger than −arg k, which is 2 arctan(−Im ω/Re ω) at most.
    """
    if is_infinitely_deep(problem.tank) or not values:
        return ANGLE
    turned = max(2.0 * atan2(-omega.imag, omega.real) for omega in values)
    return min(ANGLE, max(ANGLE_OVER_A_BED, turned + _DECAYING))


def _outgoing_search(model: OpenModel) -> ResonanceSearch:
    return ResonanceSearch(model.pencil, model.stiffness, model.mass, model.outside.damping)


def rough_resonances(
    problem: OpenWaterProblem, expected: list[float], region: Region
) -> tuple[OpenModel, list[complex]]:
    """Find approximate resonances of a region in which bodies move (collective)."""
    rough, band = problem.rough(), Band(lowest=region.lowest, highest=region.highest)
    resolution = first_resolution(rough.tank, rough.tolerance, band)
    # Motions without restoring force are not among the expected ones.
    enough = sum(omega < _STIFF * region.highest for omega in expected) + 4
    resolution = replace(resolution, shapes=tuple(min(count, enough) for count in resolution.shapes))
    model = open_model(rough, band, resolution, angle=ANGLE)
    # Beside the real axis, where the continuous spectrum begins.
    beside = [omega * (1.0 - 0.05j) for omega in expected if omega < region.highest]
    targets = beside or [region.highest * (1.0 - 0.05j)]
    return model, sorted(_search(model, targets, region, _STILL, []), key=abs)


def _search(
    model: OpenModel, targets: list[complex], region: Region, still: float, others: list[complex]
) -> list[complex]:
    """ω of the resonances in a region in which bodies move, rad/s, but for some others (collective)."""
    unit = model.basin.units.frequency
    search = _outgoing_search(model)
    found: list[complex] = []
    for target in targets:
        for pair in _nearest(search, model.squared_frequency(target)):
            omega = complex(np.sqrt(pair.eigenvalue)) * unit
            known = _is_known(omega, [*others, *found], _SAME)
            if not known and pair.drift < still and pair.participation > _AT_REST and region.holds(omega):
                found.append(omega)
    return found


def _nearest(search: ResonanceSearch, target: complex) -> Iterator[Eigenpair]:
    """Yield eigenpairs near a target; with damping from outside, those of it at the frequency of each (collective)."""
    for pair in search.near(target, _PER_TARGET):
        if not search.is_damped or pair.drift >= _STILL or pair.participation <= _AT_REST:
            yield pair
            continue
        with suppress(EigenSolverError):
            yield search.refined(pair.eigenvalue)


def _damped_resonances(
    problem: OpenWaterProblem, resolution: Resolution, region: Region, known: list[complex]
) -> tuple[DampedSolver, list[complex]]:
    """Find approximate resonances of a region that extends far below the real axis (collective)."""
    rough = problem.rough()
    band = Band(lowest=region.lowest, highest=region.highest * sqrt(1.0 + region.damping**2))
    resolution = replace(first_resolution(rough.tank, rough.tolerance, band), shapes=resolution.shapes)
    model = open_model(rough, band, resolution, angle=mirror_angle(region.damping))
    solver = DampedSolver(model)
    counted = zeros_in(solver, region.boundary)
    for spacing in _SPACINGS:
        known = damped_resonances(solver, region, _OVERLAP * MOST_DAMPING_ANYWHERE, known, spacing)
        if counted is None or len(known) >= counted:
            break
    return solver, known


def _closed_region(region: Region, found: _Found, request: ResonanceRequest) -> Region:
    if request.below is not None or len(found.pairs) < request.count:
        return region
    last = max(np.sqrt(pair.eigenvalue).real for pair in found.pairs) * found.model.basin.units.frequency
    return Region(lowest=region.lowest, highest=min(region.highest, 1.02 * last), damping=region.damping)


def resonance_errors(model: OpenModel, pairs: list[Eigenpair]) -> FrequencyErrors:
    """Estimate relative errors of ω, half of those of λ: A_λ(ψ − ψ_h, ψ − ψ_h) over xᵀT'x, and dλ/dα (collective)."""
    count = len(pairs)
    if not pairs:
        return FrequencyErrors(liquid=np.zeros(0), tips=np.zeros(0), truncation=np.zeros(0), rounding=np.zeros(0))
    # The stronger the damping, the less do errors in the absorbing layer cancel.
    omegas = np.sqrt(np.array([pair.eigenvalue for pair in pairs]))
    weights = np.where(-omegas.imag > MOST_DAMPING_ANYWHERE * omegas.real, 1.0, LAYER_WEIGHT)
    away, tips = square_errors(model, np.array([pair.potential for pair in pairs]), weights)
    norms = np.array([abs(pair.norm) for pair in pairs])
    drifts = np.array([pair.drift for pair in pairs])
    tank = model.basin.tank
    # Omitted dry modes have the same part of the energy as in an undamped mode of that frequency.
    amplitudes = np.array([np.abs(pair.bodies) / np.sqrt(abs(pair.norm)) for pair in pairs])
    values = np.array([abs(pair.eigenvalue) for pair in pairs])
    return FrequencyErrors(
        liquid=0.5 * (away / norms + _DRIFT * drifts) + boundary_error(model.pencil.liquid.tank, tank),
        tips=0.5 * tips / norms,
        truncation=0.5 * truncation_errors(model.pencil.bodies, amplitudes, values),
        rounding=np.full(count, rounding_error(model.resolution.degree, min(tank.depth, 1.0))),
    )


def _table(found: _Found, causes: FrequencyErrors, counted: int | None, region: Region) -> ResonanceTable:
    model, pairs = found.model, found.pairs
    scale = model.scale
    bodies = np.array([pair.bodies for pair in pairs]).reshape(len(pairs), len(scale.dofs))
    motions = scale.amplitudes(bodies)
    # Motions of different kinds are compared by their kinetic energy.
    weights = np.sqrt(np.abs(np.diag(scale.masses(model.mass))))
    strongest = np.argmax(np.abs(motions) * weights, axis=1) if len(pairs) else np.zeros(0, int)
    largest = motions[np.arange(len(pairs)), strongest][:, None]
    return ResonanceTable(
        omega=np.sqrt(np.array([pair.eigenvalue for pair in pairs], dtype=complex)) * model.basin.units.frequency,
        dofs=scale.dofs,
        labels=tuple(scale.dofs[place] for place in strongest),
        body_amplitudes=motions / largest,
        residuals=np.array([pair.residual for pair in pairs]),
        relative_error=causes.total,
        counted=counted,
        region=region,
    )


def zeros_in(solver: Solver, boundary: Callable[[np.ndarray], np.ndarray]) -> int | None:
    """Count the resonances in a region, less those of the water around fixed bodies (collective)."""
    _prepare(solver, boundary)
    # Near a zero or a pole of det D its phase turns fast.
    turning = np.zeros(0) if isinstance(solver, DampedSolver) else np.append(*solver.zeros_and_poles())
    places = 4.0 * np.arange(_FIRST) / _FIRST
    phases = _phases(solver, boundary(places))
    for _ in range(_HALVINGS):
        turns = np.angle(np.roll(phases, -1) / phases)
        far = np.flatnonzero((np.abs(turns) > _TURN) | _unresolved(solver, boundary(places), turning))
        if not len(far):
            return round(float(turns.sum() / (2.0 * np.pi)))
        added = 0.5 * (places + np.append(places[1:], 4.0))[far]
        phases = np.insert(phases, far + 1, _phases(solver, boundary(added)))
        places = np.insert(places, far + 1, added)
    return None


def _unresolved(solver: Solver, omegas: np.ndarray, turning: np.ndarray) -> np.ndarray:
    """Whether the phase may turn by more than is seen from each point to the next: beside zeros and poles, and as waves
    do that grow along bodies.

    H of `damped` has their squares. Thin floats may be many times as deep as the basin is long.
    """
    if isinstance(solver, OpenSolver):
        steps = np.abs(np.roll(omegas, -1) - omegas)
        distances = np.abs(omegas[:, None] - turning).min(axis=1, initial=np.inf)
        return np.asarray(steps > _CLOSE * np.minimum(distances, np.roll(distances, -1)))
    _, _, low, high = extent_of_bodies(solver.model.basin.tank)
    wavenumbers = np.array([solver.wavenumber(omega) for omega in omegas])
    changes = np.abs(np.roll(wavenumbers, -1) - wavenumbers)
    unresolved: np.ndarray = 2.0 * max(1.0, -low, high) * changes > _UNRESOLVED
    return unresolved


def _prepare(solver: Solver, boundary: Callable[[np.ndarray], np.ndarray]) -> None:
    """Extend the basis by solutions on the boundary until its residual is small enough there."""
    judged = _JUDGED_DAMPED if isinstance(solver, DampedSolver) else _JUDGED
    points = boundary(4.0 * np.arange(judged) / judged)
    squares = [solver.model.squared_frequency(omega) for omega in points]
    if not solver.basis_size:
        solver.radiation(squares[0])
    for _ in squares:
        residuals = [solver.hydrodynamic(square)[1] for square in squares]
        worst = int(np.argmax(residuals))
        if residuals[worst] < _RESIDUAL:
            return
        solver.radiation(squares[worst])


def _phases(solver: Solver, omegas: np.ndarray) -> np.ndarray:
    squares = np.array([solver.model.squared_frequency(omega) for omega in omegas])
    if isinstance(solver, OpenSolver):
        added, water = solver.hydrodynamics(squares), np.ones(len(squares))
    else:
        added, water = solver.continued(squares)
    restoring = np.array([solver.model.restoring(square) for square in squares])
    dynamics = restoring - squares[:, None, None] * (solver.model.mass + added)
    # Rows and columns of unlike motions are brought to one scale, which changes no phase.
    scales = 1.0 / np.sqrt(np.abs(np.einsum("nii->ni", dynamics)))
    determinants = np.linalg.det(dynamics * scales[:, None] * scales[:, :, None])
    phases: np.ndarray = determinants / np.abs(determinants) * water
    return phases
