"""Error estimates of frequencies by cause, and the refinement that they imply."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from math import ceil, log

import numpy as np
from mpi4py import MPI
from petsc4py import PETSc

from hydroelastic.fem.cells import cells_at, owned_cells
from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.fem.mode_set import Mode
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.spectral_error import cell_errors
from hydroelastic.fem.tank.field_solution import FieldSolution, Origin
from hydroelastic.fem.tank.mesh import tip_points
from hydroelastic.fem.tank.resolution import HIGHEST_DEGREE, Resolution, rounding_error
from hydroelastic.fem.tank.singularities import weak_corners
from hydroelastic.fem.truncation import truncation_errors
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.physics.tank import Tank

ROUNDING_OF_SPREAD = 1e-15
"""Rounding of each 1/λ by the Lanczos method, relative to the largest 1/λ."""


@dataclass(frozen=True, kw_only=True)
class FrequencyErrors:
    """Estimated relative errors of some frequencies ω, by cause; each has shape (modes,).

    Attributes:
        liquid: discretization away from the tips, and polynomial approximation of curved boundaries.
        tips: discretization by the innermost elements at the tips.
        truncation: omitted dry modes.
        rounding: rounding in double precision.
    """

    liquid: np.ndarray
    tips: np.ndarray
    truncation: np.ndarray
    rounding: np.ndarray

    @property
    def total(self) -> np.ndarray:
        """Sum of all causes, shape (modes,)."""
        return self.liquid + self.tips + self.truncation + self.rounding

    @property
    def largest_total(self) -> float:
        """The largest error."""
        return float(self.total.max(initial=0.0))

    def scaled(self, factors: float | np.ndarray) -> FrequencyErrors:
        """Return the errors times factors, of shape (modes,) or one for all."""
        return FrequencyErrors(**{cause.name: getattr(self, cause.name) * factors for cause in fields(self)})

    def largest(self, cause: str) -> float:
        """Return the largest error of one cause."""
        return float(getattr(self, cause).max(initial=0.0))


def joined_errors(errors: list[FrequencyErrors], reduced: float = 0.0) -> FrequencyErrors:
    """Concatenate errors; the error of a reduced basis is added to those of the liquid."""
    names = [cause.name for cause in fields(FrequencyErrors)]
    joined = FrequencyErrors(**{name: np.concatenate([getattr(each, name) for each in errors]) for name in names})
    return replace(joined, liquid=joined.liquid + reduced)


def frequency_errors(
    solution: FieldSolution,
    modes: list[Mode],
    origins: Sequence[Origin],
    resolution: Resolution,
    tank: Tank,
    *,
    infinite_frequency: bool = False,
) -> FrequencyErrors:
    """Estimate the errors of some modes (collective)."""

    half, rings = solution.half, resolution.tip_size is not None
    at_tips = cells_at_tips(solution.mesh, tank, half=half, infinite_frequency=infinite_frequency, rings=rings)
    exponents = np.full(len(owned_cells(solution.mesh.mesh)), np.inf)
    for corner, exponent in weak_corners(tank, half=solution.half).items() if tank.bed is not None else ():
        exponents[cells_at(solution.mesh.mesh, np.array([corner]))] = exponent
    away_and_at_tips = np.empty((len(modes), 2))
    for number, part in enumerate(solution.parts):
        own = [place for place, (owner, _) in enumerate(origins) if owner == number]
        potentials = [modes[place].potential for place in own]
        away_and_at_tips[own] = _away_and_at(at_tips, part.pencil.liquid, potentials, exponents)
    liquid, tips = away_and_at_tips.T
    values = np.array([mode.eigenvalue for mode in modes])
    unknowns = sum(body.size for body in solution.bodies)
    amplitudes = np.array([mode.body_amplitudes for mode in modes]).reshape(len(modes), unknowns)
    truncation = truncation_errors(solution.bodies, amplitudes, values)
    lowest = solution.modes.eigenvalues[0] if len(solution.modes.eigenvalues) else np.inf
    # An error of λ is twice that of ω.
    return FrequencyErrors(
        liquid=0.5 * liquid + boundary_error(solution.mesh, tank),
        tips=0.5 * tips,
        truncation=0.5 * truncation,
        rounding=rounding_error(resolution.degree, tank.depth) + ROUNDING_OF_SPREAD * np.abs(values) / lowest,
    )


def cells_at_tips(
    mesh: TankMesh, tank: Tank, *, half: bool, infinite_frequency: bool, rings: bool = True
) -> np.ndarray:
    """Return which owned cells are the innermost ones at a tip, shape (cells,)."""
    points = tip_points(tank, half=half, infinite_frequency=infinite_frequency) if rings else np.empty((0, 2))
    return cells_at(mesh.mesh, points)


def _away_and_at(
    at_tips: np.ndarray, liquid: LiquidSpace, potentials: list[PETSc.Vec], exponents: np.ndarray | None = None
) -> np.ndarray:
    """Sums of `cell_errors` away from tips and at tips, shape (potentials, 2) (collective)."""
    sums: np.ndarray = cell_errors(liquid, potentials, exponents) @ np.column_stack([~at_tips, at_tips])
    liquid.tank.mesh.comm.Allreduce(MPI.IN_PLACE, sums)
    return _finite(sums)


def _finite(energies: np.ndarray) -> np.ndarray:
    if not np.all(np.isfinite(energies)):
        # Comparisons of NaN with a tolerance are false.
        raise EigenSolverError("the error of a mode cannot be estimated: its energy is not a number")
    return energies


def added_mass_errors(
    liquid: LiquidSpace,
    potentials: list[PETSc.Vec],
    added_mass: np.ndarray,
    tank: Tank,
    resolution: Resolution,
    *,
    half: bool,
) -> FrequencyErrors:
    """Estimate relative errors of added masses in the infinite-frequency limit (collective)."""
    rings = resolution.tip_size is not None
    at_tips = cells_at_tips(liquid.tank, tank, half=half, infinite_frequency=True, rings=rings)
    away, tips = _away_and_at(at_tips, liquid, potentials).T
    return FrequencyErrors(
        liquid=away / added_mass + boundary_error(liquid.tank, tank),
        tips=tips / added_mass,
        truncation=np.zeros(len(potentials)),
        rounding=np.full(len(potentials), 2.0 * rounding_error(resolution.degree, tank.depth)),
    )


def boundary_error(mesh: TankMesh, tank: Tank) -> float:
    """Return an upper estimate of the relative error of frequencies from a deviation δ of the cells from a contour.

    Between nodes the deviation changes its sign, and most of its effect cancels. Measured
    on circles, ellipses 10:1 and 1:10 and parabolas, degrees 2 to 8: 0.05 to 0.8 times 10 (δ/s)^{3/2}, less above it,
    with the smallest extent s of the contour.
    """
    sizes = [hull.smallest_extent for hull in tank.hulls.values() if not hull.is_thin]
    sizes += [min(1.0, tank.depth)] if tank.bed == "sphere" else []
    return 10.0 * (mesh.deviation / min(sizes)) ** 1.5 if sizes else 0.0


def refined(
    resolution: Resolution, errors: FrequencyErrors, tolerance: float, *, exponent: float, remesh: bool
) -> Resolution | None:
    """Return a finer resolution, with which each cause is expected to keep its part of the tolerance."""
    if errors.largest("rounding") > tolerance:
        return None
    share = tolerance / (len(fields(errors)) - 1)
    finer = resolution
    truncation, tips, liquid = (errors.largest(cause) / share for cause in ("truncation", "tips", "liquid"))
    if truncation > 1.0:
        # The tail falls like N⁻⁷.
        finer = finer.with_shapes(min(max(1.1 * truncation ** (1.0 / 7.0), 1.1), 3.0))
    if tips > 1.0 and remesh:
        finer = finer.with_tips(max(0.3 * tips ** (-0.5 / exponent), 1e-6))
    if liquid > 1.0 or finer == resolution:
        # Each degree gains a factor of five or more.
        wanted = min(max(ceil(log(max(liquid, 1.0)) / log(5.0)), 1), 3)
        if resolution.degree < HIGHEST_DEGREE:
            finer = finer.with_degree(wanted)
        elif remesh:
            finer = finer.with_smaller_elements()
    return None if finer == resolution else finer
