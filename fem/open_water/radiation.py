"""Added mass, radiation damping and excitation forces over the frequency, in SI units.

The limit of long waves about solids of revolution: ∂ψ/∂z = 0 on the water, the pencil at λ = 0.

In infinitely deep liquids every motion has a limit, and so have surge and pitch over a bed. There heave drives the
volume ρA_w in and out over a ring of the depth H, and its added mass grows like −(ρA_w²/(2πH)) ln ka.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import isfinite, nan, sqrt

import numpy as np
from scipy.linalg import block_diag

from hydroelastic.fem.bodies.registry import body_model
from hydroelastic.fem.open_water.attempts import best_over_band
from hydroelastic.fem.open_water.basin import open_basin
from hydroelastic.fem.open_water.field_model import Band, OpenModel
from hydroelastic.fem.open_water.frequency import OpenFrequency
from hydroelastic.fem.open_water.infinite_frequency import infinite_frequency_added_mass
from hydroelastic.fem.open_water.low_frequency import is_infinitely_deep
from hydroelastic.fem.open_water.model_building import open_model
from hydroelastic.fem.open_water.motion_scale import motion_scale
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.requests import RadiationRequest
from hydroelastic.fem.open_water.response_errors import unmeshed_error
from hydroelastic.fem.open_water.results import DIRECTIONS, RadiationTable
from hydroelastic.fem.open_water.solver import shared_solver
from hydroelastic.fem.open_water.sweep import Problem, Swept, sweep
from hydroelastic.fem.tank.attempts import Attempt
from hydroelastic.fem.tank.error_estimates import FrequencyErrors, joined_errors
from hydroelastic.fem.tank.field_model import whole_bodies
from hydroelastic.fem.tank.resolution import Resolution
from hydroelastic.modal.tank_estimates import two_layers
from hydroelastic.physics.tank import Tank

# Frequencies of sections over √(g/length) whose added mass is extrapolated to ω = 0, from which it differs like their
# squares, in deep water times a logarithm. At lower ones a is the rest of a + ib/ω over a bed, where b has a limit.
_SLOW = (1e-3, 3e-3, 9e-3)
_SLOW_OVER_A_BED = (2e-2, 6e-2, 0.18)
# Part of the tolerance there, as the error is relative to a alone.
_OF_THE_REST = 0.01
# A relative growth above this between the first two is that of −ln ω.
_GROWS = 1e-3
# Number of frequencies of a sweep with an error estimate; between two of them the larger one is taken.
_ESTIMATED = 5

# Frequencies over √(g/length) whose absorbing layer ends far enough for ψ ~ 1/R.
_BAND_OF_LONG_WAVES = (1e-3, 3e-3)


@dataclass(frozen=True, kw_only=True)
class RadiationSolution:
    """Result of a radiation analysis."""

    table: RadiationTable  # the results in SI units
    model: OpenModel | None  # the last field model; ``None`` where only limits of frequency were requested
    error: float  # the largest relative error


def solve_radiation(problem: OpenWaterProblem, request: RadiationRequest) -> RadiationSolution:
    """Solve for added mass, damping and excitation to the tolerance of the problem (collective)."""
    omegas = np.array([omega for omega in request.omega if isfinite(omega) and omega > 0.0])
    shapes = reported_shapes(open_basin(problem.tank, 0.0).tank, request.elastic_modes)
    attempt = _swept(problem, omegas, shapes) if len(omegas) else None
    return _tabulated(problem, request, shapes, attempt)


def reported_shapes(tank: Tank, elastic: int) -> tuple[int, ...]:
    """Return the number of shapes of each body, with the rigid ones and some elastic ones of each beam; 0 of floats."""
    counts = (body_model(tank, index).elastic_shapes(elastic) for index in range(len(tank.bodies)))
    return tuple(
        len(body.rigid_motions) + count if body.is_elastic else 0
        for body, count in zip(tank.bodies, counts, strict=True)
    )


@dataclass(frozen=True, kw_only=True)
class _Sweep:
    model: OpenModel
    swept: Swept[OpenFrequency]
    errors: np.ndarray
    flux_errors: list[np.ndarray]
    factorizations: int


def _swept(problem: OpenWaterProblem, omegas: np.ndarray, shapes: tuple[int, ...]) -> Attempt[_Sweep]:
    low, high = problem.shared_band(float(omegas.min()), float(omegas.max()))
    band = Band(lowest=low, highest=high)

    def solve(resolution: Resolution) -> Attempt[_Sweep]:
        solver = shared_solver(problem, band, replace(resolution, shapes=shapes))
        before = solver.factorizations
        frequencies = Problem(
            full=lambda omega: solver.frequency(omega.real),
            reduced=lambda omega: solver.frequency_between(omega.real),
            difference=_difference,
        )
        swept = sweep(frequencies, omegas, problem.tolerance)
        places = estimated_places(omegas)
        causes = [_causes(swept.solutions[place]) for place in places]
        unmeshed = unmeshed_error(solver.model)
        # The error of the basis is relative to the largest entry.
        flux_errors = [
            solution.flux_errors(unmeshed) + error * np.abs(solution.diffraction).max(initial=0.0)
            for solution, error in zip(swept.solutions, swept.errors, strict=True)
        ]
        errors = between(omegas, places, np.array([cause.total.max() for cause in causes])) + swept.errors
        return Attempt(
            result=_Sweep(
                model=solver.model,
                swept=swept,
                errors=errors,
                flux_errors=flux_errors,
                factorizations=solver.factorizations - before,
            ),
            causes=joined_errors(causes, float(swept.errors.max())),
            resolution=resolution,
        )

    return best_over_band(problem, band, solve)


def _difference(one: OpenFrequency, other: OpenFrequency) -> float:
    """Return the largest difference of hydrodynamic matrices and forces, each relative to the largest entry."""
    return max(
        relative_difference(one.hydrodynamic, other.hydrodynamic),
        relative_difference(one.diffraction_force, other.diffraction_force),
    )


def relative_difference(one: np.ndarray, other: np.ndarray) -> float:
    """Return the largest difference of two arrays of the same shape over the largest entry of the second."""
    scale = np.abs(other).max(initial=0.0)
    return float(np.abs(one - other).max() / scale) if scale else 0.0


def _causes(solution: OpenFrequency) -> FrequencyErrors:
    return solution.model.errors(solution.radiated, np.abs(np.diag(solution.hydrodynamic)), solution.truncation)


def estimated_places(omegas: np.ndarray) -> list[int]:
    """Return indices of a few frequencies ω, shape (n,), spread over all of them."""
    order = np.argsort(omegas)
    chosen = np.unique(np.linspace(0, len(order) - 1, min(_ESTIMATED, len(order))).round().astype(int))
    return [int(order[place]) for place in chosen]


def between(omegas: np.ndarray, places: list[int], values: np.ndarray) -> np.ndarray:
    """Return values at all ω, shape (n,), from those at some indices, shape (places,): the larger one of both sides."""
    known = omegas[places]
    below = np.clip(np.searchsorted(known, omegas, side="right") - 1, 0, len(known) - 1)
    above = np.clip(np.searchsorted(known, omegas, side="left"), 0, len(known) - 1)
    larger: np.ndarray = np.maximum(values[below], values[above])
    return larger


def _tabulated(
    problem: OpenWaterProblem,
    request: RadiationRequest,
    shapes: tuple[int, ...],
    attempt: Attempt[_Sweep] | None,
) -> RadiationSolution:
    long = open_basin(problem.tank, 0.0)
    bodies = whole_bodies(long.tank, shapes)
    scale = motion_scale(long, bodies)
    waves = two_layers(problem.tank).branches
    rows: dict[float, _Row] = {}
    errors = [0.0]
    if attempt is not None:
        errors.append(attempt.error)
        found = attempt.result
        swept, in_full = found.swept.solutions, found.swept.in_full
        rows |= {row.omega: row for row in map(_row, _finite(request), swept, found.errors, found.flux_errors, in_full)}
    if np.inf in request.omega:
        matrix, error = infinite_frequency_added_mass(problem, shapes)
        errors.append(error)
        rows[np.inf] = _limit_row(np.inf, scale.masses(matrix), len(waves), error)
    stiffness = scale.stiffnesses(np.diag(np.concatenate([body.stiffness for body in bodies])))
    if 0.0 in request.omega:
        rows[0.0] = _slow_row(problem, shapes, len(waves))
        if len(waves) == 1:
            # The still level rises by the elevation: a heave of all bodies by −1.
            risen = np.array([dof.motion == "heave" for dof in scale.dofs], dtype=float)
            rows[0.0] = _in_longest_waves(problem.tank, rows[0.0], stiffness @ risen)
        errors.append(rows[0.0].relative_error)
    ordered = [rows[omega] for omega in request.omega]
    table = RadiationTable(
        omega=np.array(request.omega),
        dofs=scale.dofs,
        waves=waves,
        wavenumbers=np.array([row.wavenumbers for row in ordered]),
        added_mass=np.array([row.added_mass for row in ordered]),
        radiation_damping=np.array([row.radiation_damping for row in ordered]),
        radiation_damping_error=np.array([row.radiation_damping_error for row in ordered]),
        excitation_force=np.array([row.froude_krylov_force + row.diffraction_force for row in ordered]),
        excitation_force_error=np.array([row.excitation_force_error for row in ordered]),
        froude_krylov_force=np.array([row.froude_krylov_force for row in ordered]),
        diffraction_force=np.array([row.diffraction_force for row in ordered]),
        relative_error=np.array([row.relative_error for row in ordered]),
        energy_residual=np.array([row.energy_residual for row in ordered]),
        haskind_residual=np.array([row.haskind_residual for row in ordered]),
        inertia=scale.masses(block_diag(*(body.mass for body in bodies))),
        stiffness=stiffness,
        infinite_frequency_added_mass=rows[np.inf].added_mass if np.inf in rows else None,
        factorizations=attempt.result.factorizations if attempt else 0,
        fields_at=request.fields_at,
    )
    return RadiationSolution(table=table, model=attempt.result.model if attempt else None, error=max(errors))


def _finite(request: RadiationRequest) -> list[float]:
    return [omega for omega in request.omega if isfinite(omega) and omega > 0.0]


@dataclass(frozen=True, kw_only=True)
class _Row:
    """One frequency of a table, in its units; see `RadiationTable`."""

    omega: float
    wavenumbers: np.ndarray
    added_mass: np.ndarray
    radiation_damping: np.ndarray
    radiation_damping_error: np.ndarray
    froude_krylov_force: np.ndarray
    diffraction_force: np.ndarray
    excitation_force_error: np.ndarray
    relative_error: float
    energy_residual: float
    haskind_residual: float


def _row(omega: float, found: OpenFrequency, error: float, flux_errors: np.ndarray, in_full: bool) -> _Row:
    model, waves = found.model, found.incidence
    scale, count = model.scale, len(waves.planes) // waves.directions

    def of_planes(values: np.ndarray) -> np.ndarray:
        # From (direction, wave) to (wave, direction).
        return waves.plane_forces(model.basin, values).swapaxes(0, 1)

    return _Row(
        omega=omega,
        wavenumbers=np.array([plane.wave.wavenumber for plane in waves.planes[:count]]) / model.basin.units.length,
        added_mass=scale.masses(found.hydrodynamic.real),
        radiation_damping=omega * scale.masses(found.radiation_damping),
        radiation_damping_error=omega * scale.masses(found.radiation_damping_errors(flux_errors), errors=True),
        froude_krylov_force=scale.forces(of_planes(found.froude_krylov_force)),
        diffraction_force=scale.forces(of_planes(found.diffraction_force)),
        excitation_force_error=scale.forces(np.abs(of_planes(found.squared * flux_errors)), errors=True),
        relative_error=float(error),
        # On a reduced basis the field is less accurate than the forces: its residuals are no check of them.
        energy_residual=found.energy_residual() if in_full else nan,
        haskind_residual=found.haskind_residual() if in_full else nan,
    )


def _limit_row(omega: float, added_mass: np.ndarray, waves: int, error: float) -> _Row:
    nothing = np.zeros((waves, len(DIRECTIONS), len(added_mass)), dtype=complex)
    return _Row(
        omega=omega,
        wavenumbers=np.full(waves, omega),
        added_mass=added_mass,
        radiation_damping=np.zeros_like(added_mass),
        radiation_damping_error=np.zeros_like(added_mass),
        froude_krylov_force=nothing,
        diffraction_force=nothing,
        excitation_force_error=nothing.real,
        relative_error=error,
        energy_residual=0.0,
        haskind_residual=0.0,
    )


def _slow_row(problem: OpenWaterProblem, shapes: tuple[int, ...], waves: int) -> _Row:
    """Return the row of ω = 0; entries of the added mass that grow like −ln ω, as in deep water, are infinite.

    Damping and forces of sections are those of the lowest frequency solved.
    """
    if problem.tank.geometry.is_revolved:
        matrix, error = zero_frequency_added_mass(problem, shapes)
        return replace(_limit_row(0.0, matrix, waves, error), wavenumbers=np.zeros(waves))
    length, deep = open_basin(problem.tank, 0.0).units.length, is_infinitely_deep(problem.tank)
    if not deep:
        # Waves are to be longer than the depth, and in shallow water than the body.
        depths = [layer.depth for layer in problem.tank.layers if isfinite(layer.depth)]
        length = max(length, *depths, length**2 / min(depths))
        problem = replace(problem, tolerance=_OF_THE_REST * problem.tolerance, solvers={})
    omegas = sqrt(problem.tank.gravity / length) * np.array(_SLOW if deep else _SLOW_OVER_A_BED)
    attempt = _swept(problem, omegas, shapes)
    first, second, third = (
        _row(omega, found, attempt.error, flux_errors, True)
        for omega, found, flux_errors in zip(
            omegas, attempt.result.swept.solutions, attempt.result.flux_errors, strict=True
        )
    )
    masses = first.added_mass
    sizes = np.sqrt(np.abs(np.diag(masses)))
    sizes = np.outer(sizes, sizes)
    grows = np.abs(masses - second.added_mass) > _GROWS * sizes if deep else np.zeros(masses.shape, dtype=bool)
    limit, further = (
        one.added_mass - (other.added_mass - one.added_mass) / ((omegas[1] / omegas[0]) ** 2 - 1.0)
        for one, other in ((first, second), (second, third))
    )
    # The second one has nine times the error of the first, or 81 times without logarithms.
    remaining = np.abs(further - limit) / (8.0 if deep else 80.0)
    # Of a alone, where a is but a part of a + ib/ω.
    whole = np.abs(masses + 1j * first.radiation_damping / omegas[0])
    share = float(np.max(np.diag(whole) / np.diag(sizes), initial=1.0, where=~np.diag(grows)))
    return replace(
        first,
        omega=0.0,
        relative_error=share * attempt.error + float(np.max(remaining / sizes, initial=0.0, where=~grows)),
        wavenumbers=np.zeros(waves),
        added_mass=np.where(grows, np.copysign(np.inf, masses), limit),
        radiation_damping_error=np.abs(second.radiation_damping - first.radiation_damping),
        excitation_force_error=np.abs(
            second.froude_krylov_force + second.diffraction_force - first.froude_krylov_force - first.diffraction_force
        ),
    )


def _in_longest_waves(tank: Tank, row: _Row, forces: np.ndarray) -> _Row:
    """Return the row of ω = 0 in one liquid with its forces, shape (m,), of a level that rises evenly.

    Sections over a bed have b = Σ XⱼX̄ₖ/(4ρg c) of both directions then, with c = √(gH); all others have none.
    """
    (layer,) = tank.layers
    damping = np.zeros_like(row.added_mass)
    if isfinite(layer.depth) and not tank.geometry.is_revolved:
        damping = np.outer(forces, forces) / (2.0 * layer.density * tank.gravity * sqrt(tank.gravity * layer.depth))
    static = np.broadcast_to(forces.astype(complex), row.froude_krylov_force.shape)
    return replace(
        row,
        radiation_damping=damping,
        radiation_damping_error=np.zeros_like(damping),
        froude_krylov_force=static,
        diffraction_force=np.zeros_like(static),
        excitation_force_error=np.zeros(static.shape),
    )


def zero_frequency_added_mass(problem: OpenWaterProblem, shapes: tuple[int, ...]) -> tuple[np.ndarray, float]:
    """Return the added mass of the motions of one order at ω = 0, in SI units, and its relative error (collective).

    Over a bed heave, which displaces a volume, grows without limit; its entries are infinite. Bending modes displace
    none: they are orthogonal to heave.
    """
    basin = open_basin(problem.tank, 0.0)
    dofs = motion_scale(basin, whole_bodies(basin.tank, shapes)).dofs
    is_shallow = problem.tank.geometry.order == 0 and not is_infinitely_deep(problem.tank)
    grows = np.array([is_shallow and dof.motion == "heave" for dof in dofs])
    if grows.all():
        return np.full((len(dofs), len(dofs)), np.inf), 0.0
    band = Band(
        lowest=_BAND_OF_LONG_WAVES[0] * basin.units.frequency, highest=_BAND_OF_LONG_WAVES[1] * basin.units.frequency
    )

    def solve(resolution: Resolution) -> Attempt[np.ndarray]:
        model = open_model(problem, band, replace(resolution, shapes=shapes))
        loads = model.pencil.loads.astype(complex)
        solver = model.pencil.solver()
        solver.shift(0.0)
        radiated = np.array([solver.solve(load) for load in loads]).reshape(loads.shape)
        matrix = model.pencil.products(loads, radiated)
        causes = model.errors(radiated, np.abs(np.diag(matrix)))
        masses = np.where(np.outer(grows, grows), np.inf, model.scale.masses(matrix).real)
        return Attempt(result=masses, causes=causes, resolution=resolution)

    attempt = best_over_band(problem, band, solve)
    return attempt.result, attempt.error
