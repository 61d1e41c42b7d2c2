"""Modes of K v = λ M v with one volume constraint, and which of them is the elastic tone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydroelastic.physics.arrays import FloatArray


@dataclass(frozen=True, kw_only=True)
class TonePencil:
    """Energies of surface and beam coordinates v: potential ½ vᵀKv, kinetic ½ λ vᵀMv, volume cᵀv = 0."""

    stiffness: FloatArray  # the diagonal of K, shape (n,); a zero belongs to a rigid motion
    mass: FloatArray  # M, liquid and structure, shape (n, n)
    # c, the displaced volume of each coordinate, shape (n,), or ``None`` where it is not conserved
    volume: FloatArray | None
    elastic: int  # position of dry mode 1 in v


@dataclass(frozen=True, kw_only=True)
class Tones:
    """Modes of a `TonePencil` without its zero modes."""

    squared_frequencies: FloatArray  # λ = ω², ascending, shape (modes,)
    participation: FloatArray  # p_n = (e₁ᵀ K φ_n)² of the K-normalised dry mode 1, shape (modes,); they sum to one
    elastic_index: int  # which mode has the largest participation, counted from 1

    @property
    def elastic_squared_frequency(self) -> float:
        """λ of the elastic tone."""
        return float(self.squared_frequencies[self.elastic_index - 1])


def solve_tones(pencil: TonePencil) -> Tones:
    """Solve the pencil exactly in its own space.

    Rigid motions that carry neither stiffness nor volume are condensed through M, which is what free recoil is; the
    volume constraint is removed with one Householder reflection; then M x = (1/λ) K x is solved, so that M may be
    nearly singular.

    Args:
        pencil: energies and constraint.

    Returns:
        The modes. Directions without inertia (λ infinite) are left out.

    Source: theory of the aquarium, docs, § 4 (participation) and § 5, implementation notes (b), (c).
    """
    scale = 1 / np.sqrt(np.where(pencil.stiffness > 0, pencil.stiffness, np.diag(pencil.mass)))
    mass = pencil.mass * np.outer(scale, scale)
    stiffness = (pencil.stiffness > 0).astype(np.float64)
    volume = np.zeros_like(scale) if pencil.volume is None else pencil.volume * scale
    rigid = (stiffness == 0) & (np.abs(volume) <= 1e-12 * np.linalg.norm(volume))
    mass = _condense(mass, rigid)
    kept = ~rigid
    basis = _volume_free(volume[kept])
    elastic = basis[np.count_nonzero(kept[: pencil.elastic])]
    reduced_stiffness = (basis * stiffness[kept, None]).T @ basis
    inverse, vectors = pencil_modes(basis.T @ mass @ basis, reduced_stiffness)
    participation = (elastic @ vectors) ** 2
    meaningful = inverse > 1e-14 * inverse[-1]
    order = np.argsort(-inverse[meaningful])
    participation = participation[meaningful][order]
    return Tones(
        squared_frequencies=1 / inverse[meaningful][order],
        participation=participation,
        elastic_index=int(np.argmax(participation)) + 1,
    )


def _condense(mass: FloatArray, rigid: np.ndarray) -> FloatArray:
    """Return M_ee − M_er M_rr⁻¹ M_re: the rest moves with the rigid motions that leave total momentum zero."""
    if not rigid.any():
        return mass
    coupling = mass[np.ix_(rigid, ~rigid)]
    condensed: FloatArray = mass[np.ix_(~rigid, ~rigid)] - coupling.T @ np.linalg.solve(
        mass[np.ix_(rigid, rigid)], coupling
    )
    return condensed


def _volume_free(volume: FloatArray) -> FloatArray:
    """Return an orthonormal basis of the vectors without volume, shape (n, n − 1), or the identity."""
    norm = np.linalg.norm(volume)
    if norm == 0:
        return np.eye(len(volume))
    normal = volume / norm
    pivot = int(np.argmax(np.abs(normal)))
    reflector = normal.copy()
    reflector[pivot] += np.copysign(1.0, normal[pivot])
    householder = np.eye(len(volume)) - 2 * np.outer(reflector, reflector) / (reflector @ reflector)
    return np.delete(householder, pivot, axis=1)


def pencil_modes(matrix: FloatArray, positive: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return λ and v of A v = λ B v: with B = L Lᵀ those of L⁻¹ A L⁻ᵀ.

    Args:
        matrix: A, symmetric, shape (n, n).
        positive: B, symmetric positive definite, shape (n, n).

    Returns:
        λ, ascending, shape (n,), and the v as columns, vᵀBv = 1, shape (n, n).
    """
    factor = np.linalg.cholesky(positive)
    eigenvalues, vectors = np.linalg.eigh(np.linalg.solve(factor, np.linalg.solve(factor, matrix).T))
    return eigenvalues, np.linalg.solve(factor.T, vectors)
