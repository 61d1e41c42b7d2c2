"""Complex resonances ω − iγ: free oscillations of bodies in open water that decay by radiating waves."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import sqrt

import numpy as np

from hydroelastic.fem.open_water.argument_principle import Solver, zeros_in
from hydroelastic.fem.open_water.attempts import best_over_band
from hydroelastic.fem.open_water.basin import open_basin
from hydroelastic.fem.open_water.damped import DampedSolver, damped_resonances, mirror_angle
from hydroelastic.fem.open_water.field_model import FRAMES, Band, OpenModel, first_resolution, open_model
from hydroelastic.fem.open_water.infinite_frequency import bodies_at_infinite_frequency
from hydroelastic.fem.open_water.motion_scale import motion_scale
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.region import MOST_DAMPING_ANYWHERE, Region
from hydroelastic.fem.open_water.requests import ResonanceRequest
from hydroelastic.fem.open_water.resonance_search import Eigenpair, ResonanceSearch
from hydroelastic.fem.open_water.results import ResonanceTable
from hydroelastic.fem.open_water.solver import OpenSolver
from hydroelastic.fem.tank.attempts import Attempt
from hydroelastic.fem.tank.error_estimates import FrequencyErrors, boundary_error
from hydroelastic.fem.tank.field_model import whole_bodies
from hydroelastic.fem.tank.resolution import Resolution, rounding_error
from hydroelastic.fem.truncation import truncation_errors

ANGLE = 1.3
"""α of the complex scaling: resonances with −Im ω/Re ω below tan(α/2) = 0.76 are uncovered in deep water; beyond
`MOST_DAMPING_ANYWHERE` they are those of `damped`."""

# A resonance does not move with α; what the search takes for one moves less than this.
_STILL = 1e-2
# The region searched goes beyond the expected frequencies by these factors.
_BELOW, _ABOVE = 0.3, 1.25
# Eigenvalues sought near each target: a few resonances and the waves that leave around them.
_PER_TARGET = 8
# Error of λ over what it moves by a radian of α; measured on a circle and a thin float it is smaller.
_DRIFT = 0.1
# Where a resonance lies on the rim of the region it is counted in a part of it.
_NARROWER = (0.93, 0.85)
# Shapes of beams that vibrate faster than this times the region take part as if they were rigid, and are left out
# where resonances are only to be found.
_STIFF = 4.0
# The search far below the axis begins at this part of where that near it ends.
_OVERLAP = 0.9
# Distances of the points at which it begins, in ln ω; it goes on until as many are found as there are.
_SPACINGS = (0.1, 0.05, 0.025)
# A mesh for some resonances alone holds frequencies so far beside them.
_AROUND = 1.1
# The same resonance from two targets.
_SAME = 1e-6
# Bodies with a smaller part in a motion rest while the water moves by itself.
_AT_REST = 1e-8


@dataclass(frozen=True, kw_only=True)
class ResonanceSolution:
    """Result of a resonance analysis.

    Attributes:
        table: the results in SI units.
        model: the last field model; ``None`` where nothing restores the bodies.
        error: the largest relative error.
        known: number of resonances that were found in the region of the independent count.
        unstable: whether a float is unstable, so that its motion grows and is none of the resonances.
    """

    table: ResonanceTable
    model: OpenModel | None
    error: float
    known: int
    unstable: bool


@dataclass(frozen=True, kw_only=True)
class _Found:
    """Resonances at one resolution."""

    model: OpenModel
    pairs: list[Eigenpair]


def solve_resonance(problem: OpenWaterProblem, request: ResonanceRequest) -> ResonanceSolution:
    """Find resonances to the tolerance of the problem, and count them independently (collective).

    Args:
        problem: the open water.
        request: how many, and where.

    Raises:
        EigenSolverError: if SLEPc fails.
    """
    watch = problem.watch
    expected = bodies_at_infinite_frequency(problem).frequencies()
    if not expected:
        return _nothing(problem)
    region = _region(expected, request)
    coarse, known = rough_resonances(problem, expected, region)
    damped = None
    if region.damping > MOST_DAMPING_ANYWHERE:
        damped, known = _damped_resonances(problem, coarse.resolution, region, known)
    values = known[: request.count]
    band, angle = Band(lowest=region.lowest, highest=region.highest), ANGLE
    if damped:
        band, angle = _around(values, region)

    def solve(resolution: Resolution) -> Attempt[_Found]:
        model = open_model(problem, band, resolution, angle=angle)
        with watch.stage("resonances"):
            search = DampedSolver(model, watch) if damped else _outgoing_search(model)
            pairs = [search.refined(model.squared_frequency(omega)) for omega in values]
        with watch.stage("errors"):
            causes = resonance_errors(model, pairs)
        return Attempt(result=_Found(model=model, pairs=pairs), causes=causes, resolution=resolution)

    attempt = best_over_band(problem, band, solve)
    found = attempt.result
    with watch.stage("count"):
        solver = damped or OpenSolver(coarse, watch)
        closed, counted = _counted(solver, _closed_region(region, found, request))
    return ResonanceSolution(
        table=_table(found, attempt.causes, counted, closed),
        model=found.model,
        error=attempt.error,
        known=sum(map(closed.holds, known)),
        unstable=bool(np.any(np.diag(found.model.stiffness) < 0.0)),
    )


def _nothing(problem: OpenWaterProblem) -> ResonanceSolution:
    """The solution where nothing restores the bodies: no resonances."""
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


def _counted(solver: Solver, region: Region) -> tuple[Region, int | None]:
    """Count in a region, or in a narrower one where a resonance lies on its rim (collective)."""
    for damping in (1.0, *_NARROWER):
        narrower = replace(region, damping=damping * region.damping)
        counted = zeros_in(solver, narrower.rim)
        if counted is not None:
            return narrower, counted
    return region, None


def _region(expected: list[float], request: ResonanceRequest) -> Region:
    highest = request.below if request.below is not None else _ABOVE * expected[min(request.count, len(expected)) - 1]
    lowest, damping = _BELOW * min(expected[0], highest), request.largest_damping
    if damping > MOST_DAMPING_ANYWHERE:
        # What dies out fast has a small Re ω for its |ω|.
        lowest /= sqrt(1.0 + damping**2)
    return Region(lowest=lowest, highest=highest, damping=damping)


def _around(values: list[complex], region: Region) -> tuple[Band, float]:
    """The frequencies of a mesh for the given resonances of a region alone, and α of its scaling."""
    sizes = [abs(omega) for omega in values] or [region.lowest, region.highest]
    damping = max((-omega.imag / omega.real for omega in values), default=region.damping)
    return Band(lowest=min(sizes) / _AROUND, highest=max(sizes) * _AROUND), mirror_angle(damping)


def _outgoing_search(model: OpenModel) -> ResonanceSearch:
    return ResonanceSearch(model.pencil, model.stiffness, model.mass)


def rough_resonances(
    problem: OpenWaterProblem, expected: list[float], region: Region
) -> tuple[OpenModel, list[complex]]:
    """Find the resonances of a region in which bodies move, with little accuracy.

    Args:
        problem: the open water.
        expected: frequencies near which to look, rad/s.
        region: where.

    Returns:
        The model, and ω by ascending |ω|, rad/s (collective).

    Raises:
        EigenSolverError: if SLEPc fails.
    """
    rough, band = problem.rough(), Band(lowest=region.lowest, highest=region.highest)
    resolution = first_resolution(rough.tank, rough.tolerance, band)
    # Motions that nothing restores are not among the expected ones.
    enough = sum(omega < _STIFF * region.highest for omega in expected) + 4
    resolution = replace(resolution, shapes=tuple(min(count, enough) for count in resolution.shapes))
    model = open_model(rough, band, resolution, angle=ANGLE)
    targets = [omega for omega in expected if omega < region.highest] or [region.highest]
    with problem.watch.stage("resonances"):
        return model, _search(model, targets, region)


def _search(model: OpenModel, targets: list[float], region: Region) -> list[complex]:
    """ω of the resonances in a region in which bodies move, rad/s, by ascending |ω| (collective)."""
    unit = model.basin.units.frequency
    search = _outgoing_search(model)
    found: list[complex] = []
    for target in targets:
        # Beside the axis, on which the waves' own spectrum begins.
        for pair in search.near(model.squared_frequency(target * (1.0 - 0.05j)), _PER_TARGET):
            omega = complex(np.sqrt(pair.eigenvalue)) * unit
            known = any(abs(omega - other) <= _SAME * abs(omega) for other in found)
            if not known and pair.drift < _STILL and pair.participation > _AT_REST and region.holds(omega):
                found.append(omega)
    return sorted(found, key=abs)


def _damped_resonances(
    problem: OpenWaterProblem, resolution: Resolution, region: Region, known: list[complex]
) -> tuple[DampedSolver, list[complex]]:
    """Resonances of a region that reaches far below the axis, with little accuracy (collective).

    Args:
        problem: open water of endless liquids.
        resolution: whose shapes of beams are taken.
        region: where.
        known: those near the axis, rad/s.

    Returns:
        The solver, and ω in rad/s by ascending |ω|.
    """
    rough = problem.rough()
    band = Band(lowest=region.lowest, highest=region.highest * sqrt(1.0 + region.damping**2))
    resolution = replace(first_resolution(rough.tank, rough.tolerance, band), shapes=resolution.shapes)
    model = open_model(rough, band, resolution, angle=mirror_angle(region.damping))
    solver = DampedSolver(model, problem.watch)
    with problem.watch.stage("resonances"):
        counted = zeros_in(solver, region.rim)
        for spacing in _SPACINGS:
            known = damped_resonances(solver, region, _OVERLAP * MOST_DAMPING_ANYWHERE, known, spacing)
            if counted is None or len(known) >= counted:
                break
        return solver, known


def _closed_region(region: Region, found: _Found, request: ResonanceRequest) -> Region:
    """The region of those that are reported: it ends halfway to where the next may be."""
    if request.below is not None or len(found.pairs) < request.count:
        return region
    last = max(np.sqrt(pair.eigenvalue).real for pair in found.pairs) * found.model.basin.units.frequency
    return Region(lowest=region.lowest, highest=min(region.highest, 1.02 * last), damping=region.damping)


def resonance_errors(model: OpenModel, pairs: list[Eigenpair]) -> FrequencyErrors:
    """Errors of ω, half of those of λ: the energy missed over xᵀT'x, and how λ moves with α (collective)."""
    count = len(pairs)
    if not pairs:
        return FrequencyErrors(liquid=np.zeros(0), tips=np.zeros(0), truncation=np.zeros(0), rounding=np.zeros(0))
    # The faster a resonance dies out, the less do errors in the frames cancel.
    omegas = np.sqrt(np.array([pair.eigenvalue for pair in pairs]))
    frames = np.where(-omegas.imag > MOST_DAMPING_ANYWHERE * omegas.real, 1.0, FRAMES)
    away, tips = model.energies_missed(np.array([pair.potential for pair in pairs]), frames)
    norms = np.array([abs(pair.norm) for pair in pairs])
    drifts = np.array([pair.drift for pair in pairs])
    tank = model.basin.tank
    # Shapes left out hold the same part of the energy as in a mode of that frequency without damping.
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
