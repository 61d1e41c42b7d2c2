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
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from dolfinx import fem
from dolfinx.fem import petsc as fem_petsc
from dolfinx.mesh import Mesh, compute_midpoints
from mpi4py import MPI
from numpy.typing import NDArray
from petsc4py import PETSc

from hydroelastic.fem.core.forms import MARKED, SMOOTHER, compiled_forms
from hydroelastic.fem.direct import direct_solver
from hydroelastic.meshes.compat import coordinate_degree, form_in_cells, form_on_facets
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.physics.geometry import PLANE, Geometry

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class Trace:
    """The unknowns of ψ on a surface of one layer, on every process.

    Attributes:
        facets: global numbers of the unknowns on each facet, along it, shape (facets, unknowns).
        points: their coordinates, shape (facets, unknowns, dim).
    """

    facets: Indices
    points: Array

    @property
    def unknowns(self) -> Indices:
        """Global numbers of the unknowns in the order of the facets, each once."""
        _, first = np.unique(self.facets, return_index=True)
        return self.facets.ravel()[np.sort(first)]

    def matched(self, other: Trace) -> Indices:
        """The unknowns of another layer at the same points, in the order of `unknowns`."""
        _, first = np.unique(self.facets, return_index=True)
        return other.facets.ravel()[np.sort(first)]


class Liquid:
    """ψ of one degree on a mesh, with the matrices of its forms."""

    def __init__(
        self, mesh: TankMesh, degree: int, densities: Sequence[float], layers: Sequence[str], geometry: Geometry = PLANE
    ) -> None:
        """Assemble A (collective).

        Args:
            mesh: of all layers, with nodes split between them.
            degree: of ψ.
            densities: ρ of each layer, from the bottom up.
            layers: physical name of the cells of each.
            geometry: what the mesh stands for.
        """
        self.mesh, self.degree, self.densities, self.geometry = mesh, degree, tuple(densities), geometry
        domain = mesh.mesh
        self.comm: MPI.Comm = domain.comm
        cell = domain.ufl_cell().cellname
        self.forms = compiled_forms(
            geometry.kind,
            cell() if callable(cell) else cell,
            domain.geometry.dim,
            coordinate_degree(domain),
            degree,
        )
        self.space = fem.functionspace(domain, ("Lagrange", degree))
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
        """Whether the mesh has facets of a name."""
        return name in self.mesh.facet_names

    def boundary(self, name: str) -> Indices:
        """Own unknowns on the facets of a name (collective)."""
        facets = self.mesh.facets(name) if self.has(name) else np.empty(0, dtype=np.int32)
        dofs = fem.locate_dofs_topological(self.space, self.mesh.mesh.topology.dim - 1, facets)
        return np.asarray(dofs[dofs < self.owned], dtype=np.int64)

    def surface(self, name: str) -> sp.csr_matrix:
        """∫ηq over the facets of a name, rows of this process (collective)."""
        form = form_on_facets(self.forms.surface, [self.space] * 2, self.mesh.mesh, MARKED, self.mesh.facets(name))
        return _rows(_assembled(form))

    def trace(self, name: str, layer: int) -> Trace:
        """The unknowns on the facets of a name in a layer (collective)."""
        dim = self.mesh.mesh.topology.dim
        closure = self.space.element.basix_element.entity_closure_dofs[dim - 1]
        cells, sides = _cells_at(self.mesh.mesh, self.mesh.facets(name))
        rows, points = [], []
        for cell, side in zip(cells, sides, strict=True):
            if cell < len(self.layer_of_cell) and self.layer_of_cell[cell] == layer:
                dofs = self.space.dofmap.cell_dofs(cell)[closure[side]]
                dofs = dofs[np.lexsort(np.round(self.points[dofs], 12).T[::-1])]
                rows.append(self.space.dofmap.index_map.local_to_global(dofs.astype(np.int32)))
                points.append(self.points[dofs])
        width = len(closure[0])
        own = np.array(rows, dtype=np.int64).reshape(-1, width), np.array(points).reshape(-1, width, dim)
        facets, places = (np.concatenate(parts) for parts in zip(*self.comm.allgather(own), strict=True))
        order = np.lexsort(np.round(places.mean(axis=1), 12).T[::-1])
        return Trace(facets=facets[order], points=places[order])

    def shape_space(self, names: Sequence[str]) -> ShapeSpace:
        """The displacements of bodies with wetted facets of some names (collective)."""
        return ShapeSpace(self, names)

    def factorized(self, zero: Indices, closed: Sequence[int]) -> Factorized:
        """A⁺ with ψ = 0 at own unknowns, and some layers closed (collective)."""
        return Factorized(self, zero, closed)

    def function(self, values: Array, name: str = "psi") -> fem.Function:
        """A function of ψ from the values of the unknowns of this process."""
        function = fem.Function(self.space, name=name)
        function.x.array[: self.owned] = values
        function.x.scatter_forward()
        return function


class ShapeSpace:
    """Displacements v on wetted facets, and their loads ∫v·n q.

    Attributes:
        points: of each name, where v is asked for, and on which side of the facet the liquid is there along x, −1 or 1;
            on every process.
    """

    def __init__(self, liquid: Liquid, names: Sequence[str]) -> None:
        """Assemble the loads of a unit of v at each point (collective)."""
        domain, topology = liquid.mesh.mesh, liquid.mesh.mesh.topology
        self._dim = domain.geometry.dim
        present = [name for name in names if liquid.has(name)]
        self.points: dict[str, tuple[Array, Array]] = {}
        self._columns: dict[str, Indices] = {}
        if not present:
            return
        space = fem.functionspace(domain, ("Lagrange", liquid.degree + SMOOTHER, (self._dim,)))
        facets = np.unique(np.concatenate([liquid.mesh.facets(name) for name in present]))
        form = form_on_facets(liquid.forms.normal_load, [liquid.space, space], domain, MARKED, facets)
        self._matrix = _rows(_assembled(form))
        coordinates = space.tabulate_dof_coordinates()[:, : self._dim]
        closure = space.element.basix_element.entity_closure_dofs[topology.dim - 1]
        for name in present:
            cells, local = _cells_at(domain, liquid.mesh.facets(name))
            dofs = [space.dofmap.cell_dofs(cell)[closure[side]] for cell, side in zip(cells, local, strict=True)]
            middles = compute_midpoints(domain, topology.dim, cells)[:, 0]
            sides = [
                np.sign(x - coordinates[own, 0].mean()) * np.ones(len(own))
                for x, own in zip(middles, dofs, strict=True)
            ]
            own, first = np.unique(np.concatenate([np.empty(0, dtype=np.int32), *dofs]), return_index=True)
            found = (
                space.dofmap.index_map.local_to_global(own.astype(np.int32)),
                coordinates[own].reshape(-1, self._dim),
                np.concatenate([np.empty(0), *sides])[first],
            )
            # Also the ghosts: of a facet on the boundary of a process another may own the unknowns.
            numbers, points, of_sides = (
                np.concatenate(parts) for parts in zip(*liquid.comm.allgather(found), strict=True)
            )
            numbers, first = np.unique(numbers, return_index=True)
            self.points[name] = points[first], of_sides[first]
            self._columns[name] = (self._dim * numbers[:, None] + np.arange(self._dim)).ravel()

    def load(self, name: str, displacements: Array) -> Array:
        """Loads, rows of this process, of displacements at the points of a name, shape (shapes, dim, points)."""
        values = displacements.transpose(2, 1, 0).reshape(len(self._columns[name]), -1)
        return np.asarray(self._matrix[:, self._columns[name]] @ values)


class Factorized:
    """A⁺ of a `Liquid` for one set of conditions ψ = 0."""

    def __init__(self, liquid: Liquid, zero: Indices, closed: Sequence[int]) -> None:
        self.liquid, self.closed = liquid, tuple(closed)
        fixed = [zero]
        for layer in closed:
            own = np.flatnonzero(liquid.layer_of == layer)[:1]
            first = liquid.comm.allreduce(int(own[0]) + liquid.first if len(own) else liquid.size, op=MPI.MIN)
            fixed.append(own[own + liquid.first == first])
        self._fixed = np.concatenate(fixed).astype(np.int64)
        matrix = liquid.laplace.copy()
        matrix.zeroRowsColumns((self._fixed + liquid.first).astype(PETSc.IntType), 1.0)
        self._solver = direct_solver(matrix)

    def solve(self, loads: Array) -> Array:
        """ψ of loads, both on the unknowns of this process, shape (unknowns, loads) (collective)."""
        if not loads.shape[1]:
            return loads.copy()
        right = loads.copy(order="F")
        right[self._fixed] = 0.0
        size = ((self.liquid.owned, self.liquid.size), (None, loads.shape[1]))
        comm = self.liquid.comm
        answer = PETSc.Mat().createDense(size, comm=comm)
        answer.setUp()
        self._solver.matSolve(PETSc.Mat().createDense(size, array=right, comm=comm), answer)
        return np.array(answer.getDenseArray())


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


def _assembled(form: fem.Form) -> PETSc.Mat:
    matrix = fem_petsc.assemble_matrix(form)
    matrix.assemble()
    return matrix


def _rows(matrix: PETSc.Mat) -> sp.csr_matrix:
    """Own rows of a matrix, with all columns."""
    rows, columns = matrix.getLocalSize()[0], matrix.getSize()[1]
    return sp.csr_matrix(matrix.getValuesCSR()[::-1], shape=(rows, columns))
