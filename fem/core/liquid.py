"""The liquids as an operator: the load of what moves on their boundary → ψ.

    A ψ = C ζ,    A = ∫∇ψ·∇q (block diagonal by layer),    (Cζ)(q) = ∫ζ q        `fem.core.forms`

A layer on whose boundary ψ is zero nowhere is *closed*: it keeps its volume, V ζ = 0 with V = 1ᵀC, and its ψ is known
up to a constant. A⁺ then answers with ψ = 0 at one unknown; on displacements that keep the volume CᵀA⁺C is the same
whichever unknown that is. One layer's unknowns are apart from the other's: where two liquids meet, each has its own
nodes, and the elevation of the interface is a load on both.

Arrays of unknowns hold those of this process by rows; columns are all of them, on every process.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import Any, NamedTuple

import basix
import numpy as np
import scipy.sparse as sp
from dolfinx import fem
from dolfinx.fem import petsc as fem_petsc
from dolfinx.la import InsertMode
from dolfinx.mesh import Mesh, compute_midpoints
from mpi4py import MPI
from numpy.typing import NDArray
from petsc4py import PETSc

from hydroelastic.fem.core.forms import MARKED, compiled_forms
from hydroelastic.fem.direct import direct_solver
from hydroelastic.meshes.compat import coordinate_degree, form_in_cells, form_on_facets
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.physics.geometry import PLANE, Geometry

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


class Trace(NamedTuple):
    """The unknowns of ψ on a surface of one layer, on every process."""

    facets: Indices  # global numbers of the unknowns on each facet, along it, shape (facets, unknowns)
    points: Array  # their coordinates, shape (facets, unknowns, dim)

    def unknowns(self, other: Trace | None = None) -> Indices:
        """Numbers of the unknowns in the order of the facets, each once, or of those of another layer there."""
        _, first = np.unique(self.facets, return_index=True)
        return (other or self).facets.ravel()[np.sort(first)]


Zero = tuple[str, ...]
"""Names of facets with ψ = 0."""


class Conditions(NamedTuple):
    """Own unknowns with ψ = 0, layers that these leave closed, and own unknowns that A⁺ sets to zero."""

    zeros: Indices
    closed: tuple[int, ...]
    fixed: Indices


class Liquid:
    """ψ of one degree on a mesh, with the matrices of its forms."""

    def __init__(
        self, mesh: TankMesh, degree: int, densities: Sequence[float], layers: Sequence[str], geometry: Geometry = PLANE
    ) -> None:
        self.mesh, self.degree, self.densities, self.geometry = mesh, degree, tuple(densities), geometry
        domain = mesh.mesh
        self.comm: MPI.Comm = domain.comm
        cell = domain.ufl_cell().cellname
        self.forms = compiled_forms(
            geometry.kind, cell() if callable(cell) else cell, domain.geometry.dim, coordinate_degree(domain), degree
        )
        self.space = fem.functionspace(domain, self.forms.element)
        self._conditions: dict[Zero, Conditions] = {}
        self._restrictions: dict[int, sp.csc_array] = {}
        self._matrix: PETSc.Mat | None = None
        self._solver: Any = None
        self._factorized: Zero | None = None
        constants = {} if self.forms.transverse is None else {self.forms.transverse: geometry.transverse}
        self.laplace = _assembled(form_in_cells(self.forms.laplace, [self.space] * 2, domain, constants))
        dofmap = self.space.dofmap
        self.owned = dofmap.index_map.size_local
        self.size = dofmap.index_map.size_global
        self.first = dofmap.index_map.local_range[0]
        self.layer_of_cell = np.full(len(mesh.cell_tags.values), -1, dtype=np.int64)
        for number, name in enumerate(layers):
            self.layer_of_cell[mesh.cells(name)] = number
        self.layer_of = np.zeros(self.owned, dtype=np.int64)
        for number in range(1, len(layers)):
            dofs = np.unique(dofmap.list[np.flatnonzero(self.layer_of_cell == number)])
            self.layer_of[dofs[dofs < self.owned]] = number

    @cached_property
    def points(self) -> Array:
        """Coordinates of the unknowns of this process, those of its neighbours after its own."""
        return np.asarray(self.space.tabulate_dof_coordinates()[:, : self.mesh.mesh.geometry.dim])

    def has(self, name: str) -> bool:
        return name in self.mesh.facet_names

    def boundary(self, name: str) -> Indices:
        """Own unknowns on the facets of a name (collective)."""
        facets = self.mesh.facets(name) if self.has(name) else np.empty(0, dtype=np.int32)
        dofs = fem.locate_dofs_topological(self.space, self.mesh.mesh.topology.dim - 1, facets)
        return np.asarray(dofs[dofs < self.owned], dtype=np.int64)

    def surface(self, name: str) -> PETSc.Mat:
        form = form_on_facets(self.forms.surface, [self.space] * 2, self.mesh.mesh, MARKED, self.mesh.facets(name))
        return _assembled(form)

    def trace(self, name: str, layer: int) -> Trace:
        """The unknowns on the facets of a name in a layer (collective)."""
        dim = self.mesh.mesh.topology.dim
        cells, sides = _cells_at(self.mesh.mesh, self.mesh.facets(name))
        here = (cells < len(self.layer_of_cell)) & (
            self.layer_of_cell[np.minimum(cells, len(self.layer_of_cell) - 1)] == layer
        )
        dofs = _on_sides(self.space, cells[here], sides[here])
        points = self.points[dofs]
        order = np.lexsort(np.round(points, 12).transpose(2, 0, 1)[::-1])
        dofs, points = np.take_along_axis(dofs, order, axis=1), np.take_along_axis(points, order[..., None], axis=1)
        numbers = self.space.dofmap.index_map.local_to_global(dofs.ravel().astype(np.int32)).reshape(dofs.shape)
        facets, points = (
            np.concatenate(parts)
            for parts in zip(*self.comm.allgather((numbers, points.reshape(*dofs.shape, dim))), strict=True)
        )
        order = np.lexsort(np.round(points.mean(axis=1), 12).T[::-1])
        return Trace(facets[order], points[order])

    def conditions(self, zero: Zero) -> Conditions:
        """The conditions ψ = 0 on the facets of some names (collective)."""
        if zero not in self._conditions:
            zeros = np.unique(np.concatenate([np.empty(0, dtype=np.int64), *map(self.boundary, zero)]))
            is_open = np.bincount(self.layer_of[zeros], minlength=len(self.densities)).astype(np.int64)
            self.comm.Allreduce(MPI.IN_PLACE, is_open)
            closed, fixed = tuple(map(int, np.flatnonzero(is_open == 0))), [zeros]
            for layer in closed:
                own = np.flatnonzero(self.layer_of == layer)[:1]
                first = self.comm.allreduce(int(own[0]) + self.first if len(own) else self.size, op=MPI.MIN)
                fixed.append(own[own + self.first == first])
            self._conditions[zero] = Conditions(zeros, closed, np.concatenate(fixed))
        return self._conditions[zero]

    def solve(self, loads: Array, zero: Zero) -> Array:
        """A⁺: ψ of loads, both on the unknowns of this process, shape (unknowns, loads); loads where ψ = 0 become zero
        (collective).

        The factors are those of the last conditions; others take their symbolic factorization.
        """
        if not loads.shape[1]:
            return loads
        fixed, size = self.conditions(zero).fixed, ((self.owned, self.size), (None, loads.shape[1]))
        if self._factorized != zero:
            if self._matrix is None:
                self._matrix = self.laplace.copy()
            else:
                self.laplace.copy(self._matrix, PETSc.Mat.Structure.SAME_NONZERO_PATTERN)
            self._matrix.zeroRowsColumns((fixed + self.first).astype(PETSc.IntType), 1.0)
            self._factorized, self._solver = None, direct_solver(self._matrix, self._solver)
            self._factorized = zero
        loads[fixed] = 0.0
        psi = np.empty(loads.shape, order="F")
        self._solver.matSolve(
            *(PETSc.Mat().createDense(size, array=own, comm=self.comm) for own in (np.asfortranarray(loads), psi))
        )
        return psi

    def restricted(self, finer: Liquid, rows: Indices, loads: Array) -> Array:
        """Loads on own unknowns of a liquid of a higher degree as loads on these (collective)."""
        if finer.degree not in self._restrictions:
            # Each of them is a sum of functions of this degree in any of its cells.
            elements = [liquid.space.ufl_element().basix_element for liquid in (self, finer)]
            table = basix.compute_interpolation_operator(*elements)
            places, first = np.unique(finer.space.dofmap.list, return_index=True)
            cells, local = np.divmod(first[np.searchsorted(places, rows)], table.shape[0])
            starts = np.arange(len(rows) + 1) * table.shape[1]
            columns = np.asarray(self.space.dofmap.list[cells]).ravel()
            shape = len(rows), len(self.points)
            self._restrictions[finer.degree] = sp.csr_array((table[local].ravel(), columns, starts), shape=shape).T
        found = np.asarray(self._restrictions[finer.degree] @ loads)
        if self.comm.size > 1:
            vector = fem.Function(self.space).x
            for column in found.T:
                vector.array[:] = column
                vector.scatter_reverse(InsertMode.add)
                column[:] = vector.array
        return found[: self.owned]

    def function(self, values: Array, name: str = "psi") -> fem.Function:
        function = fem.Function(self.space, name=name)
        function.x.array[: self.owned] = values
        function.x.scatter_forward()
        return function


class ShapeSpace:
    """Displacements v on wetted facets, and their loads ∫v·n q (collective).

    `points`: of each name, where v is asked for, and on which side of the facet the liquid is there along x, −1 or 1;
    on every process.
    """

    def __init__(self, liquid: Liquid, names: Sequence[str]) -> None:
        domain, topology = liquid.mesh.mesh, liquid.mesh.mesh.topology
        self._dim = domain.geometry.dim
        present = [name for name in names if liquid.has(name)]
        self.points: dict[str, tuple[Array, Array]] = {}
        self._columns: dict[str, Indices] = {}
        if not present:
            return
        space = fem.functionspace(domain, liquid.forms.shapes)
        facets = np.unique(np.concatenate([liquid.mesh.facets(name) for name in present]))
        form = form_on_facets(liquid.forms.normal_load, [liquid.space, space], domain, MARKED, facets)
        matrix = _rows(_assembled(form))
        coordinates = space.tabulate_dof_coordinates()[:, : self._dim]
        for name in present:
            cells, local = _cells_at(domain, liquid.mesh.facets(name))
            dofs = _on_sides(space, cells, local)
            middles = compute_midpoints(domain, topology.dim, cells)[:, :1]
            sides = np.sign(middles - coordinates[dofs, 0].mean(axis=1, keepdims=True)) * np.ones(dofs.shape)
            own, first = np.unique(dofs, return_index=True)
            numbers = space.dofmap.index_map.local_to_global(own.astype(np.int32))
            found = numbers, coordinates[own].reshape(-1, self._dim), sides.ravel()[first]
            # Also the ghosts: of a facet on the boundary of a process another may own the unknowns.
            numbers, points, of_sides = (
                np.concatenate(parts) for parts in zip(*liquid.comm.allgather(found), strict=True)
            )
            numbers, first = np.unique(numbers, return_index=True)
            self.points[name] = points[first], of_sides[first]
            self._columns[name] = (self._dim * numbers[:, None] + np.arange(self._dim)).ravel()
        used = np.unique(np.concatenate(list(self._columns.values())))
        self._matrix = matrix[:, used]
        self._columns = {name: np.searchsorted(used, columns) for name, columns in self._columns.items()}

    def load(self, name: str, displacements: Array) -> Array:
        """Loads, rows of this process, of displacements at the points of a name, shape (shapes, dim, points)."""
        values = np.zeros((self._matrix.shape[1], len(displacements)))
        values[self._columns[name]] = displacements.transpose(2, 1, 0).reshape(len(self._columns[name]), -1)
        return np.asarray(self._matrix @ values)


def _cells_at(mesh: Mesh, facets: NDArray[np.int32]) -> tuple[NDArray[np.int32], Indices]:
    """The first cell at each facet, and the facet's local number there."""
    topology = mesh.topology
    dim = topology.dim
    topology.create_connectivity(dim - 1, dim)
    topology.create_connectivity(dim, dim - 1)
    cells_of, facets_of = topology.connectivity(dim - 1, dim), topology.connectivity(dim, dim - 1)
    cells = cells_of.array[cells_of.offsets[facets]]
    table = facets_of.array.reshape(-1, dim + 1)
    return cells, np.argmax(table[cells] == facets[:, None], axis=1)


def _on_sides(space: fem.FunctionSpace, cells: NDArray[np.int32], sides: Indices) -> Indices:
    closure = np.array(space.element.basix_element.entity_closure_dofs[space.mesh.topology.dim - 1])
    return np.asarray(space.dofmap.list[cells[:, None], closure[sides]], dtype=np.int64)


def _assembled(form: fem.Form) -> PETSc.Mat:
    matrix = fem_petsc.assemble_matrix(form)
    matrix.assemble()
    return matrix


def _rows(matrix: PETSc.Mat) -> sp.csr_matrix:
    rows, columns = matrix.getLocalSize()[0], matrix.getSize()[1]
    return sp.csr_matrix(matrix.getValuesCSR()[::-1], shape=(rows, columns))
