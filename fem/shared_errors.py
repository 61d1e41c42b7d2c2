"""Frequency errors of many modes of one liquid, whose coefficients are computed once for each direction of motion.

`cell_errors` needs the coefficients of ∇ψ in each cell, which are linear in ζ. Modes of bodies that share a liquid lie,
to rounding, in a space of few dimensions: each ζ is a sum of M_a-orthonormal directions, from which its distance is the
root of a kinetic energy. Where that is not small, there is a further direction; or, once none are added any more,
what is beside them has its coefficients computed anew, so that no problem depends on those solved before it.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.liquid import LiquidSpace, cell_values
from hydroelastic.fem.liquid_answer import LiquidAnswer
from hydroelastic.fem.spectral_error import missing_energy, straight_coefficients

# Largest kinetic energy beside the known directions, at unit generalized mass: an estimate ε changes by 2√(ε times it).
_UNKNOWN = 1e-14
# Of the coefficients: estimates need two digits of them.
_PRECISION = np.float32


class SharedErrors:
    """Error estimates on straight cells, on one process."""

    def __init__(
        self, liquid: LiquidSpace, answer: LiquidAnswer, at_tips: np.ndarray, grows: Callable[[], bool]
    ) -> None:
        """Begin without directions.

        Args:
            liquid: space of ψ.
            answer: of the liquid to its surfaces.
            at_tips: which cells are the innermost ones at a tip, shape (cells,).
            grows: whether motions beside the directions become some of them.
        """
        self._liquid, self._answer, self._grows = liquid, answer, grows
        self._coefficients, self._starts = straight_coefficients(liquid)
        # What sums the energies of cells away from tips and at tips.
        self._sums = np.column_stack([~at_tips, at_tips]) * liquid.energy_densities()[:, None]
        self._directions = np.empty((len(answer.added_mass), 0))
        self._momenta = self._directions
        _, cells, dim, polynomials = self._coefficients(np.empty((0, *liquid.space.dofmap.list.shape))).shape
        # Of each direction: of one polynomial after the other, then of one component of ∇ψ, then of one cell.
        self._table = np.empty((0, polynomials * dim, cells), dtype=_PRECISION)

    def away_and_at_tips(self, displacements: np.ndarray) -> np.ndarray:
        """Return the sums of `cell_errors` over the cells away from tips and over those at tips, shape (modes, 2).

        Args:
            displacements: ζ of modes at unit generalized mass, shape (n, modes).
        """
        parts = self._momenta.T @ displacements
        rest = displacements - self._directions @ parts
        beside = np.einsum("im,im->m", rest, self._answer.added_mass @ rest) > _UNKNOWN
        if self._grows() and beside.any():
            self._add(displacements[:, beside])
            parts = self._momenta.T @ displacements
            beside[:] = False
        found = np.tensordot(parts.T.astype(_PRECISION), self._table, 1)
        if beside.any():
            found[beside] += self._rows(rest[:, beside])
        dim = self._liquid.tank.mesh.topology.dim
        energies = [np.einsum("mpc,mpc->mc", part, part) for part in np.split(found, dim * self._starts, axis=1)]
        errors: np.ndarray = missing_energy(*energies) @ self._sums
        return errors

    def _add(self, displacements: np.ndarray) -> None:
        """Make the motions beside the directions some of them."""
        known = self._directions.shape[1]
        for displacement in displacements.T:
            rest = displacement
            # A second time for what rounding left.
            for _ in range(2):
                rest = rest - self._directions @ (self._momenta.T @ rest)
            momentum = self._answer.added_mass @ rest
            energy = rest @ momentum
            if energy > _UNKNOWN:
                self._directions = np.column_stack([self._directions, rest / np.sqrt(energy)])
                self._momenta = np.column_stack([self._momenta, momentum / np.sqrt(energy)])
        if self._directions.shape[1] > known:
            self._table = np.concatenate([self._table, self._rows(self._directions[:, known:])])

    def _rows(self, displacements: np.ndarray) -> np.ndarray:
        """Rows of the table of some motions."""
        potentials = self._answer.potentials @ displacements
        vectors = [PETSc.Vec().createWithArray(one, comm=PETSc.COMM_SELF) for one in potentials.T]
        found = self._coefficients(cell_values(self._liquid, vectors)).transpose(0, 3, 2, 1)
        return found.reshape(len(vectors), -1, len(self._sums)).astype(_PRECISION)
