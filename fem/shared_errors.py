"""Frequency errors of many modes of one liquid, whose coefficients are computed once for each direction of motion.

`cell_errors` needs the coefficients of ∇ψ in each cell, which are linear in ζ. Modes of bodies that share a liquid lie,
to rounding, in a space of few dimensions: each ζ is a sum of M_a-orthonormal directions found so far, in which its
distance from them is the root of a kinetic energy, and a further direction where that distance is not small.
"""

from __future__ import annotations

import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.liquid import LiquidSpace, cell_values
from hydroelastic.fem.liquid_answer import LiquidAnswer
from hydroelastic.fem.spectral_error import missing_energy, straight_coefficients

# Largest kinetic energy beside the known directions, at unit generalized mass: an estimate ε changes by 2√(ε times it).
_UNKNOWN = 1e-14


class SharedErrors:
    """Error estimates on straight cells, on one process."""

    def __init__(self, liquid: LiquidSpace, answer: LiquidAnswer) -> None:
        """Begin without directions."""
        self._liquid, self._answer = liquid, answer
        self._coefficients = straight_coefficients(liquid)
        self._densities = liquid.energy_densities()
        self._directions = np.empty((len(answer.added_mass), 0))
        self._momenta = self._directions
        # Coefficients of one degree after the other, and of one cell after the other; the directions come first.
        self._table = np.empty((0, 0))
        self._sizes: list[int] = []

    def cells(self, displacements: np.ndarray) -> np.ndarray:
        """Return what `cell_errors` does, shape (modes, cells).

        Args:
            displacements: ζ of modes at unit generalized mass, shape (n, modes).
        """
        for displacement in displacements.T[self._beside(displacements) > _UNKNOWN]:
            self._add(displacement)
        parts = self._momenta.T @ displacements
        squares = np.square(parts.T @ self._table).reshape(displacements.shape[1], sum(self._sizes), -1)
        energies = [part.sum(axis=1) for part in np.split(squares, np.cumsum(self._sizes)[:-1], axis=1)]
        errors: np.ndarray = self._densities * missing_energy(*energies)
        return errors

    def _beside(self, displacements: np.ndarray) -> np.ndarray:
        """ζᵀM_aζ beside the directions, shape (modes,)."""
        rest = displacements - self._directions @ (self._momenta.T @ displacements)
        energy: np.ndarray = np.einsum("im,im->m", rest, self._answer.added_mass @ rest)
        return energy

    def _add(self, displacement: np.ndarray) -> None:
        """Make the motion beside the directions one of them."""
        rest = displacement
        # A second time for what rounding left.
        for _ in range(2):
            rest = rest - self._directions @ (self._momenta.T @ rest)
        momentum = self._answer.added_mass @ rest
        energy = rest @ momentum
        if energy <= _UNKNOWN:
            return
        direction = rest / np.sqrt(energy)
        self._directions = np.column_stack([self._directions, direction])
        self._momenta = np.column_stack([self._momenta, momentum / np.sqrt(energy)])
        potential = PETSc.Vec().createWithArray(self._answer.potentials @ direction, comm=PETSc.COMM_SELF)
        values = cell_values(self._liquid, [potential])
        # Of each degree: shape (coefficients, cells).
        new = [table[0].T for table in self._coefficients(values)]
        self._sizes = [len(table) for table in new]
        row = np.concatenate(new).reshape(1, -1)
        self._table = np.concatenate([self._table, row]) if len(self._table) else row
