"""Which degrees of freedom of a space are unknowns of the solvers, and their numbers.

They are all of them, or those on the boundaries of cells: those inside of a cell follow by `fem.cell_matrices`. A cell
belongs to one process, and so does its interior; leaving it out needs no communication.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from dolfinx import fem, la
from petsc4py import PETSc


@dataclass(frozen=True, kw_only=True)
class Numbering:
    """The unknowns on one space.

    Attributes:
        space: the space.
        inside: places, in a cell, of the degrees of freedom that are no unknowns.
        outside: places, in a cell, of the unknowns.
        owned_dofs: local degree of freedom of each unknown that this process owns, ascending.
        numbers: global number of the unknown at each local degree of freedom, −1 inside of cells.
        first: global number of the first unknown that this process owns.
    """

    space: fem.FunctionSpace
    inside: np.ndarray
    outside: np.ndarray
    owned_dofs: np.ndarray
    numbers: np.ndarray
    first: int

    @property
    def range(self) -> tuple[int, int]:
        """Global number of the first unknown of this process, and of the one after its last."""
        return self.first, self.first + len(self.owned_dofs)

    def owned_among(self, dofs: np.ndarray) -> np.ndarray:
        """Local numbers of the owned unknowns among local degrees of freedom, ascending."""
        numbers = np.sort(self.numbers[dofs[dofs < self.space.dofmap.index_map.size_local]])
        return (numbers[numbers >= 0] - self.first).astype(np.int32)

    def spread(self, values: np.ndarray) -> np.ndarray:
        """Give every process the unknowns on its cells (collective)."""
        local = np.zeros((len(values), len(self.numbers)))
        local[:, self.owned_dofs] = values
        if self.space.mesh.comm.size > 1:
            vector = la.vector(self.space.dofmap.index_map)
            for row in local:
                vector.array[:] = row
                vector.scatter_forward()
                row[:] = vector.array
        return local

    def summed(self, values: np.ndarray) -> np.ndarray:
        """Sum contributions of all processes to local degrees of freedom (collective)."""
        if self.space.mesh.comm.size > 1:
            vector = la.vector(self.space.dofmap.index_map)
            for row in values:
                vector.array[:] = row
                vector.scatter_reverse(la.InsertMode.add)
                row[:] = vector.array
        return values[:, self.owned_dofs]

    def assembled(self, blocks: Sequence[tuple[np.ndarray, np.ndarray]]) -> PETSc.Mat:
        """Assemble a matrix on all unknowns from dense blocks (collective)."""
        comm, own = self.space.mesh.comm, len(self.owned_dofs)
        entries = np.zeros((1, len(self.numbers)))
        for dofs, _ in blocks:
            entries[0] += dofs.shape[1] * np.bincount(dofs.ravel(), minlength=len(self.numbers))
        most = self.summed(entries)[0].astype(PETSc.IntType)
        size = (own, PETSc.DETERMINE)
        matrix = PETSc.Mat().createAIJ((size, size), comm=comm)
        # Cells that share an unknown share others too: the bound may exceed the length of a row.
        others = matrix.getSize()[0] - own
        matrix.setPreallocationNNZ((np.minimum(most, own), np.minimum(most, others)))
        for dofs, values in blocks:
            rows = np.ascontiguousarray(self.numbers[dofs], dtype=PETSc.IntType)
            matrix.setValuesRCV(rows, rows, np.ascontiguousarray(values), addv=PETSc.InsertMode.ADD_VALUES)
        matrix.assemble()
        return matrix


def numbered(space: fem.FunctionSpace, *, condensed: bool) -> Numbering:
    """Number the unknowns of a space (collective)."""
    element, index_map = space.element.basix_element, space.dofmap.index_map
    everything = np.arange(element.dim)
    inside = np.array(element.entity_dofs[-1][0] if condensed else [], dtype=np.int64)
    outside = np.delete(everything, inside)
    local = index_map.size_local + index_map.num_ghosts
    is_unknown = np.ones(local, dtype=bool)
    is_unknown[space.dofmap.list[:, inside]] = False
    owned = np.flatnonzero(is_unknown[: index_map.size_local])
    comm = space.mesh.comm
    first = int(comm.scan(len(owned))) - len(owned)
    numbers = la.vector(index_map)
    numbers.array[:] = -1.0
    numbers.array[owned] = first + np.arange(len(owned))
    numbers.scatter_forward()
    return Numbering(
        space=space,
        inside=inside,
        outside=outside,
        owned_dofs=owned,
        numbers=numbers.array.astype(np.int64),
        first=first,
    )
