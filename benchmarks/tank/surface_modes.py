"""The eigenproblem on the top of the tank, shared by the scripts of the peers and by the lower bound.

    K ζ = λ (M + M_a) ζ,    M_a = ρ Cᵀ A⁺ C        ζ = (a, η): dry modes of the beam, then the water's elevation

is solved for the largest μ = 1/λ by the Lanczos method in the metric of K, with full reorthogonalization and no
restart: the fewest answers of the liquid. What has no stiffness is condensed: theory of the aquarium, docs, § 5 (c).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh_tridiagonal

from hydroelastic.physics.arrays import FloatArray

_MOST_STEPS = 400
_CHECKED_EVERY = 3
_WATCHED = 2
_WATCHED_TOLERANCE = 1e-3


@dataclass(frozen=True, kw_only=True)
class SurfaceProblem:
    """K, M + M_a and the volume constraint as functions of a surface vector ζ of ``size`` unknowns.

    Attributes:
        size: number of unknowns.
        free_rigid: unknowns without stiffness: rigid motions that nothing restores.
        weigh: ζ → Kζ; zero on the free rigid motions.
        respond: (ζ, Kζ) → ((M + M_a)ζ on the free rigid motions, K⁻¹(M + M_a)ζ with zeros there).
        volume: V, the volume that a unit of each unknown displaces, if the liquid keeps its volume, else ``None``.
        volume_response: K⁻¹V, zero on the free rigid motions.
    """

    size: int
    free_rigid: np.ndarray
    weigh: Callable[[FloatArray], FloatArray]
    respond: Callable[[FloatArray, FloatArray], tuple[FloatArray, FloatArray]]
    volume: FloatArray | None
    volume_response: FloatArray


@dataclass(frozen=True, kw_only=True)
class SurfaceModes:
    """The lowest eigenvalues λ, ascending, and how many answers of the liquid they took."""

    eigenvalues: FloatArray
    solves: int


class _Condensed:
    """K⁻¹M_c, with free rigid motions and the constant of ψ condensed, or the volume kept by projection."""

    def __init__(self, problem: SurfaceProblem) -> None:
        self.problem = problem
        self.solves = 0
        rigid = problem.free_rigid
        momenta, responses = [], []
        for index in rigid:
            unit = np.zeros(problem.size)
            unit[index] = 1.0
            momentum, response = self._respond(unit, np.zeros(problem.size))
            momenta.append(momentum)
            responses.append(response)
        self.dense = np.array(momenta).reshape(len(rigid), len(rigid))
        volume = problem.volume
        displaced = np.zeros(0) if volume is None else volume[rigid]
        # Pitch displaces none but for round-off.
        self.constant_follows = bool(volume is not None and np.any(np.abs(displaced) > 1e-10 * np.abs(volume).max()))
        self.projects = volume is not None and not self.constant_follows
        if self.constant_follows:
            self.dense = np.block([[self.dense, displaced[:, None]], [displaced[None, :], np.zeros((1, 1))]])
            responses.append(problem.volume_response)
        self.responses = np.array(responses).reshape(len(responses), problem.size)
        self.followed = np.linalg.inv(self.dense) @ self.responses if len(responses) else None
        if self.projects and volume is not None:
            self.projected = volume / (volume @ problem.volume_response)

    def _respond(self, vector: FloatArray, weighed: FloatArray) -> tuple[FloatArray, FloatArray]:
        self.solves += 1
        return self.problem.respond(vector, weighed)

    def apply(self, vector: FloatArray, weighed: FloatArray) -> FloatArray:
        momentum, response = self._respond(vector, weighed)
        if self.followed is not None:
            if self.constant_follows and self.problem.volume is not None:
                momentum = np.append(momentum, self.problem.volume @ vector)
            response -= momentum @ self.followed
        return self.keep_volume(response)

    def keep_volume(self, vector: FloatArray) -> FloatArray:
        if self.projects:
            vector -= self.problem.volume_response * (self.projected @ vector)
        return vector


def lowest_eigenvalues(problem: SurfaceProblem, count: int, *, tolerance: float = 1e-12) -> SurfaceModes:
    """Lowest eigenvalues λ > 0 by the Lanczos method."""
    operator = _Condensed(problem)
    steps = min(_MOST_STEPS, problem.size - len(problem.free_rigid))
    basis, weighed_basis = np.empty((steps, problem.size)), np.empty((steps, problem.size))
    vector, weighed, norm = _normalized(problem, _start(problem, operator))
    diagonal: list[float] = []
    beside: list[float] = []
    for step in range(steps):
        basis[step], weighed_basis[step] = vector, weighed
        image = operator.apply(vector, weighed)
        for turn in range(2):  # twice is enough to stay orthogonal to rounding
            parts = weighed_basis[: step + 1] @ image
            if turn == 0:
                diagonal.append(float(parts[step]))
            image -= parts @ basis[: step + 1]
        vector, weighed, norm = _normalized(problem, image)
        complete = step == steps - 1
        if complete or (step > count + 6 and step % _CHECKED_EVERY == 0):
            values, vectors = eigh_tridiagonal(diagonal, beside)
            if complete or _converged(values[::-1], norm * vectors[-1, ::-1], count, tolerance):
                break
        beside.append(norm)
    if complete and steps == _MOST_STEPS:
        raise RuntimeError(f"{count} eigenvalues did not converge in {steps} Lanczos steps")
    return SurfaceModes(eigenvalues=1.0 / values[::-1][:count], solves=operator.solves)


def _start(problem: SurfaceProblem, operator: _Condensed) -> FloatArray:
    noise: FloatArray = np.random.default_rng(20).standard_normal(problem.size)
    noise[problem.free_rigid] = 0.0
    noise = operator.keep_volume(noise)
    return operator.apply(noise, problem.weigh(noise))


def _normalized(problem: SurfaceProblem, vector: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    weighed = problem.weigh(vector)
    norm = float(np.sqrt(vector @ weighed))
    return vector / norm, weighed / norm, norm


def _converged(values: FloatArray, tails: FloatArray, count: int, tolerance: float) -> bool:
    """Whether residual²/gap, the error of a Ritz value, is small for all that are wanted.

    Two more have to be near their limits: else a mode close to a wanted one may not have appeared yet.
    """
    watched = count + _WATCHED
    if len(values) <= watched:
        return False
    below = values[:watched] - values[1 : watched + 1]
    nearest = np.minimum(below, np.concatenate([[np.inf], below[:-1]]))
    errors = tails[:watched] ** 2 / (nearest * values[:watched])
    return bool(np.all(errors[:count] <= tolerance) and np.all(errors[count:] <= _WATCHED_TOLERANCE))
