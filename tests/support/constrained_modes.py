"""K ζ = λ M ζ with one linear constraint and motions without stiffness, dense and exact to rounding.

In unit coordinates K is 1 on the diagonal, or 0 where nothing restores. What has no stiffness follows the rest so that
the kinetic energy is stationary; the largest μ = 1/λ of M x = μ x are then those of the lowest modes, each exact to a
few units of the last place of the largest.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cholesky, eigh, solve_triangular


@dataclass(frozen=True, kw_only=True)
class ConstrainedProblem:
    """K ζ = λ M ζ with cᵀζ = 0; K is 1 on the diagonal, and 0 where ``free``.

    Attributes:
        mass: M, shape (n, n).
        volume: c, shape (n,).
        free: which unknowns have no stiffness, shape (n,).
    """

    mass: np.ndarray
    volume: np.ndarray
    free: np.ndarray

    def restricted(self, basis: np.ndarray) -> ConstrainedProblem:
        """The problem in an orthonormal basis of part of the space that does not mix what is free with the rest."""
        return ConstrainedProblem(
            mass=basis.T @ self.mass @ basis,
            volume=basis.T @ self.volume,
            free=np.abs(basis[self.free]).sum(axis=0) > 0.0,
        )


def lowest_modes(problem: ConstrainedProblem, count: int) -> tuple[np.ndarray, np.ndarray]:
    """The lowest modes of a problem.

    Args:
        problem: the problem.
        count: how many.

    Returns:
        λ, ascending, and the modes in the coordinates that have stiffness, of unit potential energy, 0 elsewhere,
        shape (n, modes).
    """
    mass, volume, free = problem.mass, problem.volume, problem.free
    stiff = ~free
    reduced = mass[np.ix_(stiff, stiff)]
    basis = np.eye(len(reduced))
    if free.any():
        reduced = _condensed(reduced, mass[np.ix_(free, stiff)], mass[np.ix_(free, free)], volume[free], volume[stiff])
    if np.linalg.norm(volume[free]) == 0.0 and np.linalg.norm(volume[stiff]) > 0.0:
        basis = orthogonal_to(volume[stiff])
        reduced = basis.T @ reduced @ basis
    size = len(reduced)
    inverse, vectors = eigh(reduced, subset_by_index=(max(0, size - count), size - 1))
    modes = np.zeros((len(mass), len(inverse)))
    modes[stiff] = (basis @ vectors)[:, ::-1]
    return 1.0 / inverse[::-1], modes


def _condensed(
    reduced: np.ndarray, coupling: np.ndarray, own: np.ndarray, free_volume: np.ndarray, stiff_volume: np.ndarray
) -> np.ndarray:
    """M of what has stiffness, the rest following it."""
    if np.linalg.norm(free_volume) > 0.0:
        # One free motion makes up for the volume that the others displace; the rest displaces none.
        follow = -np.outer(free_volume, stiff_volume) / (free_volume @ free_volume)
        reduced = reduced + coupling.T @ follow + follow.T @ coupling + follow.T @ own @ follow
        unconstrained = orthogonal_to(free_volume)
        coupling = unconstrained.T @ (coupling + own @ follow)
        own = unconstrained.T @ own @ unconstrained
    if not own.size:
        return reduced
    scale = 1.0 / np.sqrt(np.diag(own))
    factor = cholesky(own * np.outer(scale, scale), lower=True)
    half = solve_triangular(factor, scale[:, None] * coupling, lower=True)
    return reduced - half.T @ half


def orthogonal_to(vector: np.ndarray) -> np.ndarray:
    """An orthonormal basis of what is orthogonal to a vector, by one reflection."""
    normal = vector / np.linalg.norm(vector)
    pivot = int(np.argmax(np.abs(normal)))
    normal[pivot] += np.copysign(1.0, normal[pivot])
    reflection = np.eye(len(vector)) - 2.0 * np.outer(normal, normal) / (normal @ normal)
    return np.delete(reflection, pivot, axis=1)
