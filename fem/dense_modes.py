"""A problem with a known answer of the liquid as one dense operator.

The unknowns are scaled to unit stiffness, ζ = U y with UᵀKU = 1, but for rigid motions r without stiffness. With
T = Uᵀ(M + M_a)U and the volumes V of the constraints, the modes are those of

    y = λ (T y + Vᵀp),    V y = 0        p: constants of ψ, times ρ

in which the motions without stiffness, and the constants with them, are condensed as by `CondensedKinetics`.
"""

from __future__ import annotations

from collections.abc import Callable
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
    """

    inverses: np.ndarray
    modes: CompletedModes
    amplitudes: np.ndarray
    displacements: Callable[[slice], np.ndarray]
    energies: Callable[[slice], np.ndarray]


class DenseModes:
    """The problem of a stable pencil with a scaled answer, on one process."""

    def __init__(self, pencil: CoupledPencil, answer: LiquidAnswer) -> None:
        self._pencil, self._answer = pencil, answer
        size = pencil.body_size
        self._free = pencil.free_rigid
        stiffness = pencil.body_stiffness
        self._scale = np.where(stiffness > 0.0, stiffness, 1.0) ** -0.5
        self.kinetics = answer.scaled.copy()  # M + M_a with the unknowns of the bodies scaled
        self.kinetics[:size, :size] += pencil.body_mass
        self.kinetics[:size] *= self._scale[:, None]
        self.kinetics[:, :size] *= self._scale
        self.volumes = np.hstack([pencil.volumes[:, :size] * self._scale, pencil.volumes[:, size:] @ answer.root])

    @cached_property
    def _condensed(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """W and D of the condensed unknowns, and the volumes that stay as orthonormal columns Q = VᵀT."""
        turn, with_rigid = self._pencil.rigid_constraints
        volumes, rigid = turn.T @ self.volumes, len(self._free)
        follow = np.concatenate([self.kinetics[self._free], volumes[:with_rigid]])
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
        if follow.size:
            operator -= follow.T @ np.linalg.solve(block, follow)
            operator[self._free] = 0.0
            operator[:, self._free] = 0.0
        if basis.size:
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
        """Complete eigenpairs by rigid motions and constants of ψ, and compute their residuals."""
        rigid = len(self._free)
        follow, block, basis, triangle = self._condensed
        forces = vectors * np.sqrt(eigenvalues) / np.linalg.norm(vectors, axis=0, keepdims=True)
        none = np.empty((0, len(eigenvalues)))
        followed = -np.linalg.solve(block, follow @ forces) if follow.size else none
        motions = forces.copy()
        motions[self._free] = followed[:rigid]
        moving = self.kinetics @ motions
        moving[self._free] = 0.0
        held = -np.linalg.solve(triangle, basis.T @ moving) if basis.size else none
        turn, _ = self._pencil.rigid_constraints
        pressures = turn @ np.concatenate([followed[rigid:], held])
        residuals = forces - eigenvalues * (self.kinetics @ motions + self.volumes.T @ pressures)
        return CompletedModes(
            eigenvalues=eigenvalues,
            forces=forces,
            motions=motions,
            pressures=pressures,
            residuals=np.linalg.norm(residuals, axis=0) / np.sqrt(eigenvalues),
        )

    def displacements(self, modes: CompletedModes, some: slice) -> np.ndarray:
        """Return ζ of some modes, shape (n, modes)."""
        size, motions = self._pencil.body_size, modes.motions[:, some]
        return np.concatenate([self._scale[:, None] * motions[:size], self._answer.root @ motions[size:]])

    def energies(self, modes: CompletedModes, some: slice) -> np.ndarray:
        """Return the shares of some modes in the potential energy: body unknowns one by one, then each surface, shape
        (shares, modes)."""
        pencil = self._pencil
        energies = modes.forces[:, some] ** 2 / modes.eigenvalues[some]
        stops = np.cumsum([pencil.body_size, *pencil.surface_sizes])
        of_surfaces = (energies[one:two].sum(axis=0, keepdims=True) for one, two in pairwise(stops))
        return np.concatenate([energies[: pencil.body_size], *of_surfaces])


def dense_potentials(
    pencil: CoupledPencil, answer: LiquidAnswer, displacements: np.ndarray, pressures: np.ndarray
) -> np.ndarray:
    """Return ψ of modes, shape (N, modes), from their ζ (n, modes) and constants (constraints, modes)."""
    potentials: np.ndarray = answer.potentials @ displacements
    layer_of = pencil.liquid.owned_layer_of
    for constraint, pressure in zip(pencil.constraints, pressures, strict=True):
        potentials += np.outer(layer_of == constraint.layer, pressure / constraint.density)
    return potentials
