"""The liquids: Laplace's equation for the displacement potential, factorized once and solved for many loads.

    ∫∇ψ·∇q = ∫ζ q        walls are natural boundaries

in a section, and in the half-plane of a solid of revolution or an extruded section the form of `physics.geometry`.
Each layer of liquid has its own ψ: on the interface of two layers their meshes touch, and share no node. A layer on
whose boundary ψ = 0 nowhere fixes ψ up to a constant and keeps its volume. One unknown of it is then set to zero, which
is exact for loads of zero total flux; loads and solutions are projected so that the solution operator

    A⁺ = Πᵀ A⁻¹ Π       is symmetric, with ∫ψ = 0 over the surfaces of each closed layer

whichever unknown that is.
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

from hydroelastic.fem.cells import CURVED_QUADRATURE, cell_corners, is_straight, owned_cells
from hydroelastic.fem.direct import direct_solver
from hydroelastic.fem.kernels import compiled_form
from hydroelastic.fem.liquid_operator import first_dof
from hydroelastic.meshes.compat import coordinate_degree
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.meshes.geometry import LIQUID
from hydroelastic.physics.geometry import PLANE, Geometry


@dataclass(frozen=True, kw_only=True)
class Layer:
    """A layer of liquid.

    Attributes:
        name: physical name of its cells.
        density: ρ.
    """

    name: str
    density: float


ONE_LIQUID = (Layer(name=LIQUID, density=1.0),)
"""The only layer of a tank with one liquid, whose density is the unit."""


@dataclass(frozen=True, kw_only=True)
class LiquidSpace:
    """Polynomials of one degree on a tank mesh, continuous in each layer.

    Attributes:
        tank: the mesh.
        space: the function space of ψ.
        degree: polynomial degree.
        zero_potential: names of the surfaces on which ψ = 0: pressure release, or the mirror plane of antisymmetric
            modes.
        layers: the liquids, from the bottom up.
        layer_of: layer of each unknown of this process, owned ones first.
        continuous_pressure: the liquids, where the pressure ρψ is continuous across their interface, as it is at
            infinite frequency. ψ then stands for it, and there is one layer of unit density for all that takes ψ; in it
            A = ∫(1/ρ)∇ψ·∇q.
        geometry: what the plane of the mesh stands for.
    """

    tank: TankMesh
    space: fem.FunctionSpace
    degree: int
    zero_potential: tuple[str, ...]
    layers: tuple[Layer, ...]
    layer_of: np.ndarray
    continuous_pressure: tuple[Layer, ...] = ()
    geometry: Geometry = PLANE

    @property
    def size(self) -> int:
        """Number of unknowns, those with a prescribed value included."""
        return int(self.space.dofmap.index_map.size_global)

    @property
    def densities(self) -> tuple[float, ...]:
        """Density ρ of each layer, from the bottom up."""
        return tuple(layer.density for layer in self.layers)

    @property
    def owned_layer_of(self) -> np.ndarray:
        """Layer of each unknown that this process owns."""
        return self.layer_of[: self.space.dofmap.index_map.size_local]

    def zero_dofs(self) -> np.ndarray:
        """Owned unknowns on the surfaces with ψ = 0, as local indices (collective)."""
        return self.surface_dofs(self.zero_potential) if self.zero_potential else np.empty(0, dtype=np.int32)

    def energy_densities(self) -> np.ndarray:
        """Kinetic energy over ½ω²|∇ψ|² in each owned cell: ρ, or 1/ρ where ψ stands for the pressure, times the weight
        of the geometry at the cell's middle."""
        densities = np.full(len(owned_cells(self.tank.mesh)), self.layers[0].density)
        for layer in self.continuous_pressure or self.layers[1:]:
            cells = self.tank.cells(layer.name)
            densities[cells[cells < len(densities)]] = (
                1.0 / layer.density if self.continuous_pressure else layer.density
            )
        if self.geometry.is_revolved:
            densities *= cell_corners(self.tank.mesh, owned_cells(self.tank.mesh))[..., 0].mean(axis=1)
        return densities

    def facet_dofs(self, place: int) -> np.ndarray:
        """Numbers, in a cell, of the unknowns on the closure of its facet ``place``."""
        dim = self.tank.mesh.topology.dim - 1
        return np.array(self.space.element.basix_element.entity_closure_dofs[dim][place])

    def surface_dofs(self, names: tuple[str, ...], layer: int | None = None) -> np.ndarray:
        """Owned unknowns on the closure of named surfaces, of one layer or of all: sorted local indices."""
        facets = np.concatenate([self.tank.facets(name) for name in names]) if names else np.empty(0, np.int32)
        dim = self.tank.mesh.topology.dim - 1
        # remote=True: a process may own an unknown of a surface none of whose facets it holds.
        dofs = fem.locate_dofs_topological(self.space, dim, facets, remote=True)
        dofs = np.sort(dofs[dofs < self.space.dofmap.index_map.size_local])
        return dofs if layer is None else dofs[self.layer_of[dofs] == layer]


def liquid_space(
    tank: TankMesh,
    degree: int,
    zero_potential: tuple[str, ...] = (),
    layers: tuple[Layer, ...] = ONE_LIQUID,
    *,
    continuous_pressure: bool = False,
    geometry: Geometry = PLANE,
) -> LiquidSpace:
    """Space of ψ of the given degree; its degree does not depend on the mesh's (collective).

    Args:
        tank: the mesh.
        degree: polynomial degree.
        zero_potential: names of the surfaces on which ψ = 0.
        layers: the liquids, from the bottom up.
        continuous_pressure: whether the pressure is continuous across their interface; the mesh is then not cut there.
        geometry: what the plane of the mesh stands for.
    """
    space = fem.functionspace(tank.mesh, ("Lagrange", degree))
    index_map = space.dofmap.index_map
    layer_of = np.zeros(index_map.size_local + index_map.num_ghosts, dtype=np.int8)
    for number, layer in enumerate(() if continuous_pressure else layers[1:], 1):
        layer_of[space.dofmap.list[tank.cells(layer.name)].ravel()] = number
    return LiquidSpace(
        tank=tank,
        space=space,
        degree=degree,
        zero_potential=zero_potential,
        layers=ONE_LIQUID if continuous_pressure else layers,
        layer_of=layer_of,
        continuous_pressure=layers if continuous_pressure else (),
        geometry=geometry,
    )


def closed_layers(liquid: LiquidSpace) -> tuple[int, ...]:
    """The layers on whose boundary ψ = 0 nowhere, so that ∫ζ = 0 over their surfaces (collective)."""
    layers = range(len(liquid.layers))
    if liquid.geometry.transverse:
        # A constant across the section is none along it.
        return ()
    if not liquid.zero_potential:
        return tuple(layers)
    layers_of_zeros = liquid.owned_layer_of[liquid.zero_dofs()]
    counts = np.array([np.count_nonzero(layers_of_zeros == layer) for layer in layers])
    liquid.tank.mesh.comm.Allreduce(MPI.IN_PLACE, counts)
    return tuple(layer for layer in layers if counts[layer] == 0)


@dataclass(frozen=True, kw_only=True)
class LiquidMatrices:
    """Matrices on all unknowns of one space, the same on whichever surface ψ = 0.

    Attributes:
        laplace: A = ∫∇ψ·∇q.
        surface_mass: S = ∫ψ q over the moving surfaces of the liquids, or ``None`` without one.
    """

    laplace: PETSc.Mat
    surface_mass: PETSc.Mat | None


def liquid_matrices(liquid: LiquidSpace, surfaces: tuple[str, ...]) -> LiquidMatrices:
    """Assemble what the problems on one space share (collective).

    Args:
        liquid: the space.
        surfaces: names of the moving surfaces of the liquids.
    """
    surface_mass = surface_mass_matrix(liquid, surfaces) if surfaces else None
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


# Kernels that this process has compiled or loaded: a look-up by dolfinx takes a millisecond or two.
_compiled: set[tuple[str, int, int, bool, str]] = set()


def compile_form(tank: TankMesh, degree: int, *, continuous_pressure: bool = False, geometry: Geometry = PLANE) -> None:
    """Compile the form of a degree on rank 0, unless the cache of dolfinx has it (collective).

    Assembly would compile it as well; called before, it separates the time of compilation.
    """
    kernel = tank.mesh.topology.cell_name(), coordinate_degree(tank.mesh), degree, continuous_pressure, geometry.kind
    # Collective decision: one process may have solved on its own before.
    if tank.mesh.comm.allreduce(kernel not in _compiled, op=MPI.LOR):
        weight = fem.Function(fem.functionspace(tank.mesh, ("DG", 0))) if continuous_pressure else None
        space = fem.functionspace(tank.mesh, ("Lagrange", degree))
        _form(space, geometry, cells=NO_ENTITIES, facets=NO_ENTITIES, weight=weight)
        _compiled.add(kernel)


def laplace_matrix(liquid: LiquidSpace) -> PETSc.Mat:
    """Assemble A = ∫∇ψ·∇q, or ∫(1/ρ)∇ψ·∇q of a continuous pressure, every unknown included."""
    weight = _inverse_density(liquid) if liquid.continuous_pressure else None
    cells = owned_cells(liquid.tank.mesh)
    return assembled(_form(liquid.space, liquid.geometry, cells=cells, facets=NO_ENTITIES, weight=weight))


def _inverse_density(liquid: LiquidSpace) -> fem.Function:
    weight = fem.Function(fem.functionspace(liquid.tank.mesh, ("DG", 0)))
    for layer in liquid.continuous_pressure:
        weight.x.array[weight.function_space.dofmap.list[liquid.tank.cells(layer.name)].ravel()] = 1.0 / layer.density
    return weight


def surface_mass_matrix(liquid: LiquidSpace, names: tuple[str, ...]) -> PETSc.Mat:
    """Assemble S = ∫ψ q over named surfaces, every unknown included."""
    facets = np.unique(np.concatenate([liquid.tank.facets(name) for name in names]))
    return assembled(_form(liquid.space, liquid.geometry, cells=NO_ENTITIES, facets=facets))


TRANSVERSE_QUADRATURE = 4
"""The term m² ψq has two degrees more than ∇ψ·∇q, and 1/r is no polynomial; beside the axis ψq/r is one."""

NO_ENTITIES = np.empty(0, dtype=np.int32)
"""No cells, or no facets."""


def _form(
    space: fem.FunctionSpace,
    geometry: Geometry,
    *,
    cells: np.ndarray,
    facets: np.ndarray,
    weight: fem.Function | None = None,
) -> fem.Form:
    """∫w ∇ψ·∇q over some cells + ∫ψ q over some facets of the boundary; w = 1 unless it is given.

    Of other geometries than the plane, ∇ψ·∇q has the term m² ψq added, and both integrals the weight r of revolution.

    A and S are this one form, each without the other's part. To compile it takes hardly longer than to compile one of
    them, for most of the time goes into starting the C compiler, reading Python's headers and linking. Which cells and
    facets are meant does not enter the code, so that scenes share it.
    """
    mesh = space.mesh
    potential, test = ufl.TrialFunction(space), ufl.TestFunction(space)
    degree = space.element.basix_element.degree
    more = 0 if is_straight(mesh) else CURVED_QUADRATURE
    more += 0 if geometry.kind == "plane" else TRANSVERSE_QUADRATURE
    dx = chosen_measure("dx", mesh, mesh.topology.dim, cells, 2 * degree - 2 + more)
    ds = chosen_measure("ds", mesh, mesh.topology.dim - 1, facets, 2 * degree + more)
    energy, trace = ufl.inner(ufl.grad(potential), ufl.grad(test)), ufl.inner(potential, test)
    if geometry.kind != "plane":
        radius = ufl.SpatialCoordinate(mesh)[0] if geometry.is_revolved else 1.0
        transverse = fem.Constant(mesh, geometry.transverse)
        energy, trace = radius * energy + transverse / radius * trace, radius * trace
    return compiled_form((energy if weight is None else weight * energy) * dx + trace * ds)


def chosen_measure(kind: str, mesh: Mesh, dim: int, entities: np.ndarray, quadrature_degree: int) -> ufl.Measure:
    """Measure of chosen cells ("dx") or boundary facets ("ds")."""
    chosen = 1
    return ufl.Measure(
        kind,
        domain=mesh,
        subdomain_id=chosen,
        subdomain_data=meshtags(mesh, dim, entities, np.full(len(entities), chosen, dtype=np.int32)),
        metadata={"quadrature_degree": quadrature_degree},
    )


def assembled(form: fem.Form) -> PETSc.Mat:
    """Assemble the matrix of a form (collective)."""
    matrix = fem_petsc.assemble_matrix(form)
    matrix.assemble()
    return matrix


def constrained_dofs(liquid: LiquidSpace) -> np.ndarray:
    """Owned unknowns whose value is zero: those of the surfaces with ψ = 0, and one of each closed layer
    (collective)."""
    index_map = liquid.space.dofmap.index_map
    comm = liquid.tank.mesh.comm
    held = [first_dof(liquid, layer, index_map.local_range, comm) for layer in closed_layers(liquid)]
    return np.unique(np.concatenate([liquid.zero_dofs(), *held])).astype(np.int32)


@dataclass(frozen=True, kw_only=True)
class ClosedLayer:
    """Data of the volume constraint of a closed layer.

    Attributes:
        dofs: local indices of its owned unknowns, shape (unknowns,); a slice where all unknowns are its.
        load: ∫q over its moving surfaces at those unknowns, shape (unknowns,).
        measure: measure of those surfaces, in the unit of the mesh.
    """

    dofs: np.ndarray | slice
    load: np.ndarray
    measure: float


def closed_layer(liquid: LiquidSpace, layer: int, load: np.ndarray) -> ClosedLayer:
    """Select the part of ∫q over all moving surfaces (owned entries) that belongs to one layer (collective)."""
    dofs = slice(None) if len(liquid.layers) == 1 else np.flatnonzero(liquid.owned_layer_of == layer)
    own = load[dofs]
    measure = liquid.tank.mesh.comm.allreduce(float(own.sum()), op=MPI.SUM)
    return ClosedLayer(dofs=dofs, load=own, measure=measure)


class LiquidSolver:
    """Factorized Laplace operator A⁺ on the free unknowns of the liquids.

    Args:
        matrix: A on all unknowns.
        constrained: owned local unknowns that are zero, shape (constrained unknowns,).
        closed: the layers of constant volume.
    """

    def __init__(self, matrix: PETSc.Mat, constrained: np.ndarray, closed: tuple[ClosedLayer, ...]) -> None:
        """Factorize (collective)."""
        first, last = matrix.getOwnershipRange()
        free = np.setdiff1d(np.arange(last - first, dtype=np.int32), constrained)
        self._local_free = free
        rows = PETSc.IS().createGeneral((free + first).astype(PETSc.IntType), comm=matrix.comm)
        block = matrix.createSubMatrix(rows, rows)
        self._solver = direct_solver(block)
        self._solver.setUp()
        self._rhs, self._solution = block.createVecs()
        self._closed = closed
        self._comm = matrix.comm.tompi4py()
        self.solves = 0

    def solve(self, load: PETSc.Vec, potential: PETSc.Vec) -> None:
        """``potential`` ← A⁺ ``load`` (both on all unknowns; ``load`` is not changed)."""
        values = load.array_r
        if self._closed:
            values = values.copy()
            fluxes = self._sums([values[layer.dofs].sum() for layer in self._closed])
            for layer, flux in zip(self._closed, fluxes, strict=True):
                values[layer.dofs] -= flux / layer.measure * layer.load
        self._rhs.array[:] = values[self._local_free]
        self._solver.solve(self._rhs, self._solution)
        potential.set(0.0)
        solution = potential.array
        solution[self._local_free] = self._solution.array_r
        if self._closed:
            means = self._sums([layer.load @ solution[layer.dofs] for layer in self._closed])
            for layer, mean in zip(self._closed, means, strict=True):
                solution[layer.dofs] -= mean / layer.measure
        self.solves += 1

    def _sums(self, values: list[float]) -> np.ndarray:
        """Sums over all processes."""
        total = np.array(values)
        self._comm.Allreduce(MPI.IN_PLACE, total)
        return total
