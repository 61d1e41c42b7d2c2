"""Values of fields on a string at given positions, by the polynomials of the elements."""

from __future__ import annotations

import numpy as np
from dolfinx import fem
from mpi4py import MPI
from numpy.typing import NDArray
from petsc4py import PETSc

from hydroelastic.fem.cells import cell_corners, owned_cells
from hydroelastic.fem.string.pencil import StringPencil


class StringProbe:
    """Interpolation at some positions.

    Args:
        positions: x in units of the length, from 0 to 1, shape (positions,).
    """

    def __init__(self, pencil: StringPencil, positions: NDArray[np.float64]) -> None:
        """Find the elements (collective)."""
        mesh = pencil.space.mesh
        comm = mesh.comm
        cells = owned_cells(mesh)
        ends = cell_corners(mesh, cells)[..., 0]
        inside = (ends.min(axis=1)[:, None] <= positions) & (positions <= ends.max(axis=1)[:, None])
        # Of processes that meet at a node, the lower one answers.
        owner = np.where(inside.any(axis=0), comm.rank, comm.size)
        comm.Allreduce(MPI.IN_PLACE, owner, op=MPI.MIN)
        mine = np.flatnonzero(owner == comm.rank)
        self._comm = comm
        self._order = np.argsort(np.concatenate(comm.allgather(mine)))
        self._matrix = PETSc.Mat().createAIJ(
            ((len(mine), PETSc.DECIDE), (len(pencil.free), PETSc.DECIDE)), nnz=pencil.degree + 1, comm=comm
        )
        first = self._matrix.getOwnershipRange()[0]
        numbers = _free_numbers(pencil)
        element = pencil.space.element.basix_element
        for row, position in enumerate(mine):
            cell = int(np.argmax(inside[:, position]))
            start, end = ends[cell]
            reference = np.array([[(positions[position] - start) / (end - start)]])
            values = element.tabulate(0, reference)[0, 0, :, 0]
            # PETSc passes over negative columns: the upper end is at rest.
            self._matrix.setValues(row + first, numbers[pencil.space.dofmap.cell_dofs(cells[cell])], values)
        self._matrix.assemble()
        self._result = self._matrix.createVecLeft()

    def values(self, field: PETSc.Vec) -> NDArray[np.float64]:
        """Return the values of a field of free unknowns, shape (positions,) (collective)."""
        self._matrix.mult(field, self._result)
        whole = np.concatenate(self._comm.allgather(self._result.array_r.copy()))
        return np.asarray(whole[self._order])


def _free_numbers(pencil: StringPencil) -> NDArray[np.int32]:
    """Return the global number of each local free unknown, ghosts included; −1 at the upper end (collective)."""
    numbers = fem.Function(pencil.space)
    numbers.x.array[:] = -1.0
    first, last = pencil.mass.getOwnershipRange()
    # Doubles count exactly up to 2⁵³.
    numbers.x.array[pencil.free] = np.arange(first, last)
    numbers.x.scatter_forward()
    return np.asarray(numbers.x.array, dtype=PETSc.IntType)
