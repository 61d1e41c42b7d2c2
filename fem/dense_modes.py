"""A problem with a known answer of the liquid as one dense operator.

The unknowns are scaled to unit stiffness, ζ = U y with UᵀKU = 1, but for rigid motions r without stiffness. With
T = Uᵀ(M + M_a)U and the volumes V of the constraints, the modes are those of

    y = λ (T y + Vᵀp),    V y = 0        p: constants of ψ, times ρ

in which the motions without stiffness, and the constants with them, are condensed as by `CondensedKinetics`. Where many
bodies share the answer, the surfaces may be projected on a basis E, which solves EᵀTE; residuals are those of T. Bodies
that differ in stiffness and mass may be solved together: all arrays then have further dimensions in front, as those of
NumPy's linear algebra, which are left out of the shapes below.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from hydroelastic.fem.liquid_answer import LiquidAnswer, Projection
from hydroelastic.fem.pencil import CoupledPencil

FEW = 100
"""Measured on OpenBLAS: up to so many unknowns LAPACK finds all eigenvalues sooner than other methods some of them."""


@dataclass(frozen=True, kw_only=True)
class CompletedModes:
    """Modes with their condensed unknowns, at unit generalized mass.

    Attributes:
        eigenvalues: λ, shape (modes,).
        forces: y without the condensed unknowns, shape (unknowns, modes).
        motions: y with the motions without stiffness, shape (unknowns, modes).
        pressures: constants of ψ, times ρ, shape (constraints, modes).
        residuals: relative residuals in the norm of K⁻¹, shape (modes,).
    """

    eigenvalues: np.ndarray
    forces: np.ndarray
    motions: np.ndarray
    pressures: np.ndarray
    residuals: np.ndarray


@dataclass(frozen=True, kw_only=True)
class DenseSolution:
    """The lowest modes of one problem.

    Attributes:
        inverses: 1/λ, descending, of more modes too if they are known.
        modes: the lowest modes.
        amplitudes: body part of their ζ without the motions without stiffness, shape (modes, body unknowns).
        displacements: returns ζ of some of them, shape (n, modes).
        energies: returns the shares of some in the potential energy: body unknowns one by one, then each surface, shape
            (shares, modes).
        iterations: restarts of the eigen-solver.
        projection: relative error of each λ by the projection of the surfaces; ``None`` without one.
        liquid_errors: returns error estimates of the modes of some numbers, away from tips and at tips, shape
            (modes, 2); ``None`` where that takes their ψ.
    """

    inverses: np.ndarray
    modes: CompletedModes
    amplitudes: np.ndarray
    displacements: Callable[[slice], np.ndarray]
    energies: Callable[[slice], np.ndarray]
    iterations: int = 1
    projection: np.ndarray | None = None
    liquid_errors: Callable[[list[int]], np.ndarray] | None = None


class DenseModes:
    """The problem of a stable pencil with a scaled answer, on one process."""

    def __init__(
        self,
        pencil: CoupledPencil,
        answer: LiquidAnswer,
        projection: Projection | None = None,
        bodies: tuple[np.ndarray, np.ndarray] | None = None,
    ) -> None:
        """Scale the unknowns.

        Args:
            pencil: the problem.
            answer: of its liquid.
            projection: of the surfaces, if they are projected.
            bodies: stiffness (bodies, unknowns) and mass (bodies, unknowns, unknowns) of many that are solved together,
                in place of those of the pencil; the same motions of all are without stiffness.
        """
        self._pencil, self._answer, self._projection = pencil, answer, projection
        size = pencil.body_size
        self._free = pencil.free_rigid
        stiffness, self._mass = bodies or (pencil.body_stiffness, pencil.body_mass)
        self._scale = np.where(stiffness > 0.0, stiffness, 1.0) ** -0.5
        of_bodies = pencil.volumes[:, :size] * self._scale[..., None, :]
        if projection is None:
            self._columns, self.kinetics = answer.scaled, self._with_bodies(answer.scaled)
            self._root = answer.root
            self._volumes = self.volumes = _beside(of_bodies, pencil.volumes[:, size:] @ answer.root)
        else:
            self._columns, self.kinetics = projection.columns, self._with_bodies(projection.kinetics)
            self._root = projection.root
            self._volumes = _beside(of_bodies, projection.volumes)
            self.volumes = _beside(of_bodies, projection.projected_volumes)

    def _with_bodies(self, added_mass: np.ndarray) -> np.ndarray:
        """M + M_a with the unknowns of the bodies scaled."""
        kinetics = np.broadcast_to(added_mass, (*self._scale.shape[:-1], *added_mass.shape)).copy()
        own = slice(self._pencil.body_size)
        kinetics[..., own, own] += self._mass
        kinetics[..., own, :] *= self._scale[..., None]
        kinetics[..., own] *= self._scale[..., None, :]
        return kinetics

    def _momenta(self, motions: np.ndarray) -> np.ndarray:
        """T times motions."""
        size, scale = self._pencil.body_size, self._scale[..., None]
        own = scale * motions[..., :size, :]
        momenta: np.ndarray = self._columns @ np.concatenate([own, motions[..., size:, :]], axis=-2)
        momenta[..., :size, :] = scale * (momenta[..., :size, :] + self._mass @ own)
        return momenta

    def _whole(self, vectors: np.ndarray) -> np.ndarray:
        """E times vectors."""
        if self._projection is None:
            return vectors
        size = self._pencil.body_size
        return np.concatenate([vectors[..., :size, :], self._projection.basis @ vectors[..., size:, :]], axis=-2)

    @cached_property
    def _condensed(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """W and D of the condensed unknowns, and the volumes that stay as orthonormal columns Q = VᵀT."""
        turn, with_rigid = self._pencil.rigid_constraints
        volumes, rigid = turn.T @ self.volumes, len(self._free)
        follow = np.concatenate([self.kinetics[..., self._free, :], volumes[..., :with_rigid, :]], axis=-2)
        block = np.zeros((*follow.shape[:-1], follow.shape[-2]))
        block[..., :rigid] = follow[..., self._free]
        block[..., :rigid, :] = block[..., :rigid].swapaxes(-1, -2)
        kept = volumes[..., with_rigid:, :].swapaxes(-1, -2).copy()
        kept[..., self._free, :] = 0.0
        basis, triangle = np.linalg.qr(kept) if kept.size else (kept, np.empty((0, 0)))
        return follow, 0.5 * (block + block.swapaxes(-1, -2)), basis, triangle

    def operator(self) -> np.ndarray:
        """Return T with the motions without stiffness condensed, whose largest eigenvalues are 1/λ; their vectors are y
        without the condensed unknowns."""
        follow, block, basis, _ = self._condensed
        operator = self.kinetics.copy()
        if follow.size:
            operator -= follow.swapaxes(-1, -2) @ np.linalg.solve(block, follow)
            operator[..., self._free, :] = 0.0
            operator[..., self._free] = 0.0
        if basis.size:
            # Projected on both sides.
            part = operator @ basis
            part -= 0.5 * basis @ (basis.swapaxes(-1, -2) @ part)
            operator -= part @ basis.swapaxes(-1, -2) + basis @ part.swapaxes(-1, -2)
        return operator

    def amplitudes(self, modes: CompletedModes) -> np.ndarray:
        """Return the body part of ζ without the motions without stiffness, shape (modes, body unknowns)."""
        found: np.ndarray = (self._scale[..., None] * modes.forces[..., : self._pencil.body_size, :]).swapaxes(-1, -2)
        return found

    def completed(self, eigenvalues: np.ndarray, vectors: np.ndarray) -> CompletedModes:
        """Complete eigenpairs by rigid motions and constants of ψ, and compute their residuals.

        Args:
            eigenvalues: λ, shape (modes,).
            vectors: eigenvectors of `operator` as columns, of any size, shape (n, modes).
        """
        rigid = len(self._free)
        follow, block, basis, triangle = self._condensed
        of_modes = eigenvalues[..., None, :]
        forces = vectors * np.sqrt(of_modes) / np.linalg.norm(vectors, axis=-2, keepdims=True)
        none = np.empty((*eigenvalues.shape[:-1], 0, eigenvalues.shape[-1]))
        followed = -np.linalg.solve(block, follow @ forces) if follow.size else none
        motions = forces.copy()
        motions[..., self._free, :] = followed[..., :rigid, :]
        moving = self.kinetics @ motions
        moving[..., self._free, :] = 0.0
        held = -np.linalg.solve(triangle, basis.swapaxes(-1, -2) @ moving) if basis.size else none
        turn, _ = self._pencil.rigid_constraints
        pressures = turn @ np.concatenate([followed[..., rigid:, :], held], axis=-2)
        residuals = self._whole(forces) - of_modes * (
            self._momenta(motions) + self._volumes.swapaxes(-1, -2) @ pressures
        )
        return CompletedModes(
            eigenvalues=eigenvalues,
            forces=forces,
            motions=motions,
            pressures=pressures,
            residuals=np.linalg.norm(residuals, axis=-2) / np.sqrt(eigenvalues),
        )

    def displacements(self, modes: CompletedModes, some: slice) -> np.ndarray:
        """Return ζ of some modes, shape (n, modes)."""
        size, motions = self._pencil.body_size, modes.motions[..., some]
        return np.concatenate(
            [self._scale[..., None] * motions[..., :size, :], self._root @ motions[..., size:, :]], axis=-2
        )

    def energies(self, modes: CompletedModes, some: slice) -> np.ndarray:
        """Return the shares of some modes in the potential energy: body unknowns one by one, then each surface, shape
        (shares, modes)."""
        pencil = self._pencil
        energies = self._whole(modes.forces[..., some]) ** 2 / modes.eigenvalues[..., None, some]
        stops = np.cumsum([pencil.body_size, *pencil.surface_sizes])
        of_surfaces = (energies[..., one:two, :].sum(axis=-2, keepdims=True) for one, two in pairwise(stops))
        return np.concatenate([energies[..., : pencil.body_size, :], *of_surfaces], axis=-2)


def _beside(of_bodies: np.ndarray, of_surfaces: np.ndarray) -> np.ndarray:
    """One matrix of rows for bodies, which may be many, and for the surfaces that they share."""
    shared = np.broadcast_to(of_surfaces, (*of_bodies.shape[:-1], of_surfaces.shape[-1]))
    return np.concatenate([of_bodies, shared], axis=-1)


def dense_potentials(
    pencil: CoupledPencil, answer: LiquidAnswer, displacements: np.ndarray, pressures: np.ndarray
) -> np.ndarray:
    """Return ψ of modes, shape (N, modes), from their ζ (n, modes) and constants (constraints, modes)."""
    potentials: np.ndarray = answer.potentials @ displacements
    layer_of = pencil.liquid.owned_layer_of
    for constraint, pressure in zip(pencil.constraints, pressures, strict=True):
        potentials += np.outer(layer_of == constraint.layer, pressure / constraint.density)
    return potentials


def projection_errors(inverses: np.ndarray, residuals: np.ndarray) -> np.ndarray:
    """Upper bound of the relative error of each λ from its relative residual δ: δ, and δ² over the relative distance to
    the next 1/λ (Kato and Temple), of which one more is given.

    The distances are those of computed values, which are as good as exact ones where the bound is small.
    """
    count = residuals.shape[-1]
    some = inverses[..., : count + 1]
    steps = -np.diff(some, prepend=np.inf, append=0.0)[..., : count + 1]
    gaps = np.minimum(steps[..., :-1], steps[..., 1:]) / inverses[..., :count]
    bound: np.ndarray = np.minimum(residuals, residuals**2 / np.maximum(gaps, np.finfo(float).tiny))
    return bound
