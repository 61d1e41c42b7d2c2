"""A problem with a known answer of the liquid as one dense operator.

The unknowns are scaled to unit stiffness, ζ = U y with UᵀKU = 1, but for rigid motions r without stiffness. With
T = Uᵀ(M + M_a)U and the volumes V of the constraints, the modes are those of

    y = λ (T y + Vᵀp),    V y = 0        p: constants of ψ, times ρ

in which the motions without stiffness, and the constants with them, are condensed as by `CondensedKinetics`. Where many
bodies share the answer, the surfaces may be projected on a basis E, which solves EᵀTE; residuals are those of T.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from hydroelastic.fem.liquid_answer import LiquidAnswer
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.shared_answer import Projection

FEW = 100
"""Measured on OpenBLAS: up to so many unknowns LAPACK finds all eigenvalues sooner than other methods some of them."""


@dataclass(frozen=True, kw_only=True)
class CompletedModes:
    """Modes with their condensed unknowns, at unit generalized mass; the last dimension is that of the modes.

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


class DenseModes:
    """The problem of a stable pencil with a scaled answer, on one process."""

    def __init__(self, pencil: CoupledPencil, answer: LiquidAnswer, projection: Projection | None = None) -> None:
        """Scale the unknowns, and project the surfaces if a projection is given."""
        self._pencil, self._answer, self._projection = pencil, answer, projection
        bodies = pencil.body_size
        self._free = pencil.free_rigid
        stiffness = pencil.body_stiffness
        self._scale = np.where(stiffness > 0.0, stiffness, 1.0) ** -0.5
        of_bodies = pencil.volumes[:, :bodies] * self._scale
        if projection is None:
            self._columns, self.kinetics = answer.scaled, self._with_bodies(answer.scaled)
            self._root = answer.root
            self._volumes = self.volumes = np.hstack([of_bodies, pencil.volumes[:, bodies:] @ answer.root])
        else:
            self._columns, self.kinetics = projection.columns, self._with_bodies(projection.kinetics)
            self._root = projection.root
            self._volumes = np.hstack([of_bodies, projection.volumes])
            self.volumes = np.hstack([of_bodies, projection.projected_volumes])

    def _with_bodies(self, added_mass: np.ndarray) -> np.ndarray:
        """M + M_a with the unknowns of the bodies scaled."""
        kinetics, bodies = added_mass.copy(), self._pencil.body_size
        kinetics[:bodies, :bodies] += self._pencil.body_mass
        kinetics[:bodies] *= self._scale[:, None]
        kinetics[:, :bodies] *= self._scale
        return kinetics

    def _momenta(self, motions: np.ndarray) -> np.ndarray:
        """T times motions."""
        bodies, scale = self._pencil.body_size, self._scale[:, None]
        own = scale * motions[:bodies]
        momenta: np.ndarray = self._columns @ np.concatenate([own, motions[bodies:]])
        momenta[:bodies] = scale * (momenta[:bodies] + self._pencil.body_mass @ own)
        return momenta

    def _whole(self, vectors: np.ndarray) -> np.ndarray:
        """E times vectors."""
        if self._projection is None:
            return vectors
        bodies = self._pencil.body_size
        return np.concatenate([vectors[:bodies], self._projection.basis @ vectors[bodies:]])

    @property
    def is_projected(self) -> bool:
        """Whether the surfaces are projected on a basis."""
        return self._projection is not None

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
        basis, triangle = np.linalg.qr(kept) if kept.size else (kept, np.empty((0, 0)))
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

    def amplitudes(self, modes: CompletedModes) -> np.ndarray:
        """Return the body part of ζ without the motions without stiffness, shape (modes, body unknowns)."""
        found: np.ndarray = (self._scale[:, None] * modes.forces[: self._pencil.body_size]).T
        return found

    def completed(self, eigenvalues: np.ndarray, vectors: np.ndarray) -> CompletedModes:
        """Complete eigenpairs by rigid motions and constants of ψ, and compute their residuals.

        Args:
            eigenvalues: λ, shape (modes,).
            vectors: eigenvectors of `operator` as columns, of any size, shape (n, modes).
        """
        rigid = len(self._free)
        follow, block, basis, triangle = self._condensed
        forces = vectors * np.sqrt(eigenvalues) / np.linalg.norm(vectors, axis=0)
        followed = -np.linalg.solve(block, follow @ forces) if len(follow) else np.empty((0, len(eigenvalues)))
        motions = forces.copy()
        motions[self._free] = followed[:rigid]
        moving = self.kinetics @ motions
        moving[self._free] = 0.0
        held = -np.linalg.solve(triangle, basis.T @ moving) if basis.size else np.empty((0, len(eigenvalues)))
        turn, _ = self._pencil.rigid_constraints
        pressures = turn @ np.concatenate([followed[rigid:], held])
        residuals = self._whole(forces) - eigenvalues * (self._momenta(motions) + self._volumes.T @ pressures)
        return CompletedModes(
            eigenvalues=eigenvalues,
            forces=forces,
            motions=motions,
            pressures=pressures,
            residuals=np.linalg.norm(residuals, axis=0) / np.sqrt(eigenvalues),
        )

    def displacements(self, modes: CompletedModes, some: slice) -> np.ndarray:
        """Return ζ of some modes, shape (n, modes)."""
        bodies, motions = self._pencil.body_size, modes.motions[:, some]
        return np.concatenate([self._scale[:, None] * motions[:bodies], self._root @ motions[bodies:]])

    def energies(self, modes: CompletedModes, some: slice) -> np.ndarray:
        """Return the shares of some modes in the potential energy: body unknowns one by one, then each surface, shape
        (shares, modes)."""
        pencil = self._pencil
        energies = self._whole(modes.forces[:, some]) ** 2 / modes.eigenvalues[some]
        stops = np.cumsum([pencil.body_size, *pencil.surface_sizes])
        return np.vstack(
            [energies[: pencil.body_size], *(energies[one:two].sum(axis=0) for one, two in pairwise(stops))]
        )

    def potentials(self, modes: CompletedModes, some: slice) -> np.ndarray:
        """Return ψ of some modes, its constants included, shape (N, modes)."""
        pencil = self._pencil
        potentials: np.ndarray = self._answer.potentials @ self.displacements(modes, some)
        layer_of = pencil.liquid.owned_layer_of
        for constraint, pressure in zip(pencil.constraints, modes.pressures[:, some], strict=True):
            potentials[layer_of == constraint.layer] += pressure / constraint.density
        return potentials


def projection_errors(inverses: np.ndarray, residuals: np.ndarray) -> np.ndarray:
    """Upper bound of the relative error of each λ from its relative residual δ: δ, and δ² over the relative distance to
    the next 1/λ (Kato and Temple), of which one more is given.

    The distances are those of computed values, which are as good as exact ones where the bound is small.
    """
    count = len(residuals)
    steps = -np.diff(np.concatenate([[np.inf], inverses[: count + 1], [0.0]]))[: count + 1]
    gaps = np.minimum(steps[:-1], steps[1:]) / inverses[:count]
    bound: np.ndarray = np.minimum(residuals, residuals**2 / np.maximum(gaps, np.finfo(float).tiny))
    return bound
