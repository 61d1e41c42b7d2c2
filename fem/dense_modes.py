"""A problem with a known answer of the liquid as one dense operator.

The unknowns are scaled to unit stiffness, ζ = U y with UᵀKU = 1, but for rigid motions r without stiffness. With
T = Uᵀ(M + M_a)U and the volumes V of the constraints, the modes are those of

    y = λ (T y + Vᵀp),    V y = 0        p: constants of ψ, times ρ

in which the motions without stiffness, and the constants with them, are condensed as by `CondensedKinetics`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from hydroelastic.fem.liquid_answer import LiquidAnswer
from hydroelastic.fem.pencil import CoupledPencil

FEW = 100
"""Measured on OpenBLAS: up to so many unknowns LAPACK finds all eigenvalues sooner than other methods some of them."""


@dataclass(frozen=True, kw_only=True)
class CompletedModes:
    """Modes with their shapes, at unit generalized mass; the last dimension of each array is that of the modes.

    Attributes:
        displacements: ζ, shape (n, modes).
        potentials: ψ, its constants included, shape (N, modes).
        residuals: relative residuals in the norm of K⁻¹, shape (modes,).
        energies: shares in the potential energy: body unknowns one by one, then each surface, shape (shares, modes).
    """

    displacements: np.ndarray
    potentials: np.ndarray
    residuals: np.ndarray
    energies: np.ndarray


class DenseModes:
    """The problem of a stable pencil with a scaled answer, on one process."""

    def __init__(self, pencil: CoupledPencil, answer: LiquidAnswer) -> None:
        """Scale the unknowns."""
        self._pencil, self._answer, self._root = pencil, answer, answer.root
        bodies = pencil.body_size
        self._free = pencil.free_rigid
        stiffness = pencil.body_stiffness
        self._scale = np.where(stiffness > 0.0, stiffness, 1.0) ** -0.5
        self.kinetics = answer.scaled.copy()
        first = 0
        for body in pencil.bodies:
            self.kinetics[first : first + body.size, first : first + body.size] += body.mass
            first += body.size
        self.kinetics[:bodies] *= self._scale[:, None]
        self.kinetics[:, :bodies] *= self._scale
        volumes = np.array([one.volume.array_r for one in pencil.constraints]).reshape(-1, pencil.size)
        self.volumes = np.hstack([volumes[:, :bodies] * self._scale, volumes[:, bodies:] @ self._root])

    @cached_property
    def _condensed(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """W and D of the condensed unknowns, and the volumes that stay as orthonormal columns Q = VᵀT."""
        turn, with_rigid = self._pencil.rigid_constraints
        volumes, rigid = turn.T @ self.volumes, len(self._free)
        follow = np.vstack([self.kinetics[self._free], volumes[:with_rigid]])
        block = np.zeros((len(follow), len(follow)))
        block[:, :rigid] = follow[:, self._free]
        block[:rigid] = block[:, :rigid].T
        kept = volumes[with_rigid:].T.copy()
        kept[self._free] = 0.0
        basis, triangle = np.linalg.qr(kept)
        return follow, 0.5 * (block + block.T), basis, triangle

    def operator(self) -> np.ndarray:
        """Return T with the motions without stiffness condensed, whose largest eigenvalues are 1/λ; their vectors are y
        without the condensed unknowns."""
        follow, block, basis, _ = self._condensed
        operator = self.kinetics.copy()
        if len(follow):
            operator -= follow.T @ np.linalg.solve(block, follow)
            operator[self._free] = 0.0
            operator[:, self._free] = 0.0
        if basis.shape[1]:
            # Projected on both sides.
            part = operator @ basis
            part -= 0.5 * basis @ (basis.T @ part)
            operator -= part @ basis.T + basis @ part.T
        return operator

    def displacements(self, vectors: np.ndarray) -> np.ndarray:
        """Return ζ of vectors y."""
        bodies = self._pencil.body_size
        return np.concatenate([self._scale[:, None] * vectors[:bodies], self._root @ vectors[bodies:]])

    def completed(self, eigenvalues: np.ndarray, vectors: np.ndarray) -> CompletedModes:
        """Complete eigenpairs by rigid motions and ψ, and compute their residuals.

        Args:
            eigenvalues: λ, shape (modes,).
            vectors: eigenvectors of `operator` as columns, of any size, shape (n, modes).
        """
        pencil, rigid = self._pencil, len(self._free)
        follow, block, basis, triangle = self._condensed
        forces = vectors * np.sqrt(eigenvalues) / np.linalg.norm(vectors, axis=0)
        followed = -np.linalg.solve(block, follow @ forces) if len(follow) else np.empty((0, len(eigenvalues)))
        whole = forces.copy()
        whole[self._free] = followed[:rigid]
        momenta = self.kinetics @ whole
        moving = momenta.copy()
        moving[self._free] = 0.0
        held = -np.linalg.solve(triangle, basis.T @ moving)
        turn, _ = pencil.rigid_constraints
        pressures = turn @ np.concatenate([followed[rigid:], held])
        displacements = self.displacements(whole)
        potentials = self._answer.potentials @ displacements
        layer_of = pencil.liquid.owned_layer_of
        for constraint, pressure in zip(pencil.constraints, pressures, strict=True):
            potentials[layer_of == constraint.layer] += pressure / constraint.density
        energies = forces**2 / eigenvalues
        stops = np.cumsum([pencil.body_size, *pencil.surface_sizes])
        return CompletedModes(
            displacements=displacements,
            potentials=potentials,
            residuals=np.linalg.norm(forces - eigenvalues * (momenta + self.volumes.T @ pressures), axis=0)
            / np.sqrt(eigenvalues),
            energies=np.vstack(
                [energies[: pencil.body_size], *(energies[one:two].sum(axis=0) for one, two in pairwise(stops))]
            ),
        )
