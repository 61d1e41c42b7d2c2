"""The liquid: Laplace's equation for the displacement potential, factorized once and solved for many loads.

    ∫∇ψ·∇q = ∫ζ q        walls are natural boundaries

A liquid on whose boundary ψ = 0 nowhere fixes ψ up to a constant and keeps its volume. One unknown is then
grounded, which is exact for loads of zero total flux; loads and solutions are projected so that the solution operator

    A⁺ = Πᵀ A⁻¹ Π       is symmetric, with ∫ψ = 0 over the surface

whatever is grounded.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import ufl
from dolfinx import fem
from dolfinx.fem import petsc as fem_petsc
from dolfinx.mesh import Mesh, meshtags
from mpi4py import MPI
from petsc4py import PETSc

from hydroelastic.fem.direct import direct_solver
from hydroelastic.fem.kernels import jit_options
from hydroelastic.meshes.distribute import TankMesh


@dataclass(frozen=True, kw_only=True)
class LiquidSpace:
    """Continuous piecewise polynomials of one degree on a tank mesh.

    Attributes:
        tank: the mesh.
        space: the function space of ψ.
        degree: polynomial degree.
        grounded: names of the surfaces on which ψ = 0: pressure release, or the mirror plane of antisymmetric modes.
    """

    tank: TankMesh
    space: fem.FunctionSpace
    degree: int
    grounded: tuple[str, ...]

    @property
    def size(self) -> int:
        """Number of unknowns, those with a prescribed value included."""
        return int(self.space.dofmap.index_map.size_global)

    @property
    def keeps_volume(self) -> bool:
        """Whether ψ is fixed only up to a constant, so that ∫ζ = 0 over the liquid's surfaces."""
        return not self.grounded

    def surface_dofs(self, names: tuple[str, ...]) -> np.ndarray:
        """Owned unknowns on the closure of named surfaces: sorted local indices."""
        facets = np.concatenate([self.tank.facets(name) for name in names]) if names else np.empty(0, np.int32)
        dim = self.tank.mesh.topology.dim - 1
        # remote=True: a process may own an unknown of a surface none of whose facets it holds.
        dofs = fem.locate_dofs_topological(self.space, dim, facets, remote=True)
        return np.sort(dofs[dofs < self.space.dofmap.index_map.size_local])


def liquid_space(tank: TankMesh, degree: int, grounded: tuple[str, ...] = ()) -> LiquidSpace:
    """Space of ψ of the given degree; its degree does not depend on the mesh's."""
    space = fem.functionspace(tank.mesh, ("Lagrange", degree))
    return LiquidSpace(tank=tank, space=space, degree=degree, grounded=grounded)


@dataclass(frozen=True, kw_only=True)
class LiquidMatrices:
    """Matrices on all unknowns of one space, the same whichever surface is grounded.

    Attributes:
        laplace: A = ∫∇ψ·∇q.
        surface_mass: S = ∫ψ q over the free surface, or ``None`` without one.
    """

    laplace: PETSc.Mat
    surface_mass: PETSc.Mat | None


def liquid_matrices(liquid: LiquidSpace, free_surface: str | None) -> LiquidMatrices:
    """Assemble what the problems on one space share (collective)."""
    surface_mass = surface_mass_matrix(liquid, (free_surface,)) if free_surface is not None else None
    return LiquidMatrices(laplace=laplace_matrix(liquid), surface_mass=surface_mass)


def as_functions(liquid: LiquidSpace, potentials: list[PETSc.Vec]) -> list[fem.Function]:
    """Potentials as dolfinx functions with their ghost values."""
    functions = []
    for potential in potentials:
        function = fem.Function(liquid.space)
        function.x.array[: potential.getLocalSize()] = potential.array_r
        function.x.scatter_forward()
        functions.append(function)
    return functions


# Kernels that this process has seen compiled: to look one up takes dolfinx a millisecond or two.
_compiled: set[tuple[str, int]] = set()


def compile_form(tank: TankMesh, degree: int) -> None:
    """Compile the form of a degree on rank 0, unless the cache of dolfinx has it (collective).

    Assembly would do it by itself; called before, it shows what of a first run goes into compiling.
    """
    kernel = tank.mesh.topology.cell_name(), degree
    # Together: one process may have solved on its own before.
    if tank.mesh.comm.allreduce(kernel not in _compiled, op=MPI.LOR):
        _form(liquid_space(tank, degree), cells=_NONE, facets=_NONE)
        _compiled.add(kernel)


def laplace_matrix(liquid: LiquidSpace) -> PETSc.Mat:
    """Assemble A = ∫∇ψ·∇q, every unknown included."""
    topology = liquid.tank.mesh.topology
    cells = np.arange(topology.index_map(topology.dim).size_local, dtype=np.int32)
    return _assembled(_form(liquid, cells=cells, facets=_NONE))


def surface_mass_matrix(liquid: LiquidSpace, names: tuple[str, ...]) -> PETSc.Mat:
    """Assemble S = ∫ψ q over named surfaces, every unknown included."""
    facets = np.unique(np.concatenate([liquid.tank.facets(name) for name in names]))
    return _assembled(_form(liquid, cells=_NONE, facets=facets))


_NONE = np.empty(0, dtype=np.int32)


def _form(liquid: LiquidSpace, *, cells: np.ndarray, facets: np.ndarray) -> fem.Form:
    """∫∇ψ·∇q over some cells + ∫ψ q over some facets of the boundary.

    A and S are this one form, each without the other's part. To compile it takes hardly longer than to compile one of
    them, for most of the time goes into starting the C compiler, reading Python's headers and linking. Which cells and
    facets are meant does not enter the code, so that scenes share it.
    """
    mesh = liquid.tank.mesh
    potential, test = ufl.TrialFunction(liquid.space), ufl.TestFunction(liquid.space)
    dx = _measure("dx", mesh, mesh.topology.dim, cells, 2 * liquid.degree - 2)
    ds = _measure("ds", mesh, mesh.topology.dim - 1, facets, 2 * liquid.degree)
    form = ufl.inner(ufl.grad(potential), ufl.grad(test)) * dx + ufl.inner(potential, test) * ds
    return fem.form(form, jit_options=jit_options())


def _measure(kind: str, mesh: Mesh, dim: int, entities: np.ndarray, quadrature_degree: int) -> ufl.Measure:
    """Measure of chosen cells or facets."""
    chosen = 1
    return ufl.Measure(
        kind,
        domain=mesh,
        subdomain_id=chosen,
        subdomain_data=meshtags(mesh, dim, entities, np.full(len(entities), chosen, dtype=np.int32)),
        metadata={"quadrature_degree": quadrature_degree},
    )


def _assembled(form: fem.Form) -> PETSc.Mat:
    matrix = fem_petsc.assemble_matrix(form)
    matrix.assemble()
    return matrix


def grounded_dofs(liquid: LiquidSpace) -> np.ndarray:
    """Owned unknowns whose value is zero: those of the grounded surfaces, or one unknown of a closed liquid."""
    if liquid.grounded:
        return liquid.surface_dofs(liquid.grounded)
    return np.array([0] if liquid.tank.mesh.comm.rank == 0 else [], dtype=np.int32)


class LiquidSolver:
    """Factorized Laplace operator A⁺ on the free unknowns of a liquid.

    Args:
        matrix: A on all unknowns.
        grounded: owned local unknowns that are zero.
        surface_load: ∫q over the moving surfaces if the liquid keeps its volume, else ``None``.
    """

    def __init__(self, matrix: PETSc.Mat, grounded: np.ndarray, surface_load: PETSc.Vec | None) -> None:
        """Factorize (collective)."""
        first, last = matrix.getOwnershipRange()
        free = np.setdiff1d(np.arange(last - first, dtype=np.int32), grounded)
        self.free = PETSc.IS().createGeneral((free + first).astype(PETSc.IntType), comm=matrix.comm)
        self._local_free = free
        block = matrix.createSubMatrix(self.free, self.free)
        self._solver = direct_solver(block)
        self._solver.setUp()
        self._rhs, self._solution = block.createVecs()
        self._surface_load = surface_load
        self._surface_measure = surface_load.sum() if surface_load is not None else 0.0
        self.solves = 0

    def unconstrained(self, matrix: PETSc.Mat) -> PETSc.IS:
        """Unknowns that no grounded surface fixes: all of them in a liquid that keeps its volume."""
        if self._surface_load is None:
            return self.free
        first, last = matrix.getOwnershipRange()
        return PETSc.IS().createStride(last - first, first=first, step=1, comm=matrix.comm)

    def solve(self, load: PETSc.Vec, potential: PETSc.Vec) -> None:
        """``potential`` ← A⁺ ``load`` (both on all unknowns; ``load`` is not changed)."""
        if self._surface_load is not None:
            flux = load.sum() / self._surface_measure
            self._rhs.array[:] = (load.array_r - flux * self._surface_load.array_r)[self._local_free]
        else:
            self._rhs.array[:] = load.array_r[self._local_free]
        self._solver.solve(self._rhs, self._solution)
        potential.set(0.0)
        potential.array[self._local_free] = self._solution.array_r
        if self._surface_load is not None:
            potential.shift(-self._surface_load.dot(potential) / self._surface_measure)
        self.solves += 1
