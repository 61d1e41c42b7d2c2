"""How far a frequency may lie from the exact one, by cause, and what to refine when that is too far."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from math import ceil, log

import numpy as np
from mpi4py import MPI
from petsc4py import PETSc

from hydroelastic.fem.cells import cells_at
from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.fem.modes import EigenSolverError, Mode
from hydroelastic.fem.spectral_error import cell_errors
from hydroelastic.fem.tank.field_solution import FieldSolution
from hydroelastic.fem.tank.mesh import tip_points
from hydroelastic.fem.tank.resolution import HIGHEST_DEGREE, Resolution, rounding_error
from hydroelastic.fem.truncation import truncation_errors
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.physics.tank import Tank

ROUNDING_OF_SPREAD = 1e-15
"""Lanczos leaves a few units of the last place of the largest 1/λ in each."""


@dataclass(frozen=True, kw_only=True)
class FrequencyErrors:
    """Estimated relative errors of some frequencies ω, by cause; each has shape (modes,).

    Attributes:
        liquid: elements away from the tips, and curved boundaries that they follow in polynomials only.
        tips: the innermost elements at the tips.
        truncation: dry modes left out.
        rounding: double precision.
    """

    liquid: np.ndarray
    tips: np.ndarray
    truncation: np.ndarray
    rounding: np.ndarray

    @property
    def total(self) -> np.ndarray:
        """All causes together."""
        return self.liquid + self.tips + self.truncation + self.rounding

    @property
    def largest_total(self) -> float:
        """The largest error."""
        return float(self.total.max(initial=0.0))

    def scaled(self, factors: float | np.ndarray) -> FrequencyErrors:
        """What they make of something that moves by so many times each, shape (modes,) or one for all."""
        return FrequencyErrors(**{cause.name: getattr(self, cause.name) * factors for cause in fields(self)})

    def largest(self, cause: str) -> float:
        """The largest over the modes of one cause."""
        return float(getattr(self, cause).max(initial=0.0))


def joined_errors(errors: list[FrequencyErrors], reduced: float = 0.0) -> FrequencyErrors:
    """The errors of several lists as those of one list; that of a reduced basis counts as one of the liquid's."""
    names = [cause.name for cause in fields(FrequencyErrors)]
    joined = FrequencyErrors(**{name: np.concatenate([getattr(each, name) for each in errors]) for name in names})
    return replace(joined, liquid=joined.liquid + reduced)


def frequency_errors(
    solution: FieldSolution,
    modes: list[Mode],
    parts: list[int],
    resolution: Resolution,
    tank: Tank,
    *,
    infinite_frequency: bool = False,
) -> FrequencyErrors:
    """Estimate the errors of some modes (collective).

    Args:
        solution: the modes at one resolution.
        modes: the modes to judge, with their ψ.
        parts: which of the solution's parts each belongs to.
        resolution: that resolution.
        tank: the scene.
        infinite_frequency: whether it is the infinite-frequency limit.
    """
    liquid, tips = np.empty(len(modes)), np.empty(len(modes))
    for number, part in enumerate(solution.parts):
        own = [place for place, owner in enumerate(parts) if owner == number]
        potentials = [modes[place].potential for place in own]
        liquid[own], tips[own] = energies_missed(
            part.pencil.liquid, potentials, tank, resolution, half=solution.half, infinite_frequency=infinite_frequency
        )
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


def energies_missed(
    liquid: LiquidSpace,
    potentials: list[PETSc.Vec],
    tank: Tank,
    resolution: Resolution,
    *,
    half: bool,
    infinite_frequency: bool,
) -> tuple[np.ndarray, np.ndarray]:
    """Estimate the kinetic energy that some ψ lack, away from the tips and at them, each of shape (potentials,)
    (collective)."""
    mesh = liquid.tank.mesh
    # Without rings no element is made for the tips.
    corners = np.empty((0, 2))
    if resolution.tip_size is not None:
        corners = tip_points(tank, half=half, infinite_frequency=infinite_frequency)
    cells = cell_errors(liquid, potentials)
    at_tips = mesh.comm.allreduce(cells[:, cells_at(mesh, corners)].sum(axis=1), op=MPI.SUM)
    whole = mesh.comm.allreduce(cells.sum(axis=1), op=MPI.SUM)
    if not np.all(np.isfinite(whole)):
        # Comparisons with a tolerance would let it pass.
        raise EigenSolverError("the error of a mode cannot be estimated: its energy is not a number")
    return whole - at_tips, at_tips


def added_mass_errors(
    liquid: LiquidSpace,
    potentials: list[PETSc.Vec],
    added_mass: np.ndarray,
    tank: Tank,
    resolution: Resolution,
    *,
    half: bool,
) -> FrequencyErrors:
    """Estimate relative errors of added masses in the infinite-frequency limit (collective).

    Args:
        liquid: the space of ψ.
        potentials: ψ of a unit of each motion.
        added_mass: of each, with which its error is compared, shape (motions,).
        tank: the scene.
        resolution: of the mesh.
        half: whether it is that of half the tank.
    """
    away, tips = energies_missed(liquid, potentials, tank, resolution, half=half, infinite_frequency=True)
    return FrequencyErrors(
        liquid=away / added_mass + boundary_error(liquid.tank, tank),
        tips=tips / added_mass,
        truncation=np.zeros(len(potentials)),
        rounding=np.full(len(potentials), 2.0 * rounding_error(resolution.degree, tank.depth)),
    )


def boundary_error(mesh: TankMesh, tank: Tank) -> float:
    """Relative error of frequencies from cells that miss a float's contour by δ, an upper estimate.

    Between nodes the boundary lies now on one side of the contour, now on the other, and most of it cancels. Measured
    on circles, ellipses 10:1 and 1:10 and parabolas, degrees 2 to 8: 0.05 to 0.8 times 10 (δ/s)^{3/2}, less above it,
    with the smallest extent s of the contour.
    """
    sizes = [hull.smallest_extent for hull in tank.hulls.values() if not hull.is_thin]
    return 10.0 * (mesh.deviation / min(sizes)) ** 1.5 if sizes else 0.0


def refined(
    resolution: Resolution, errors: FrequencyErrors, tolerance: float, *, exponent: float, remesh: bool
) -> Resolution | None:
    """What to solve next, so that each cause keeps its part of the tolerance.

    Args:
        resolution: the last one.
        errors: what it gave.
        tolerance: of the frequencies.
        exponent: α of ψ ~ r^α at the sharpest tips.
        remesh: whether meshes may be made anew; that of the user may not.

    Returns:
        The next resolution; ``None`` where rounding alone exceeds the tolerance, or all is at its limit.
    """
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
