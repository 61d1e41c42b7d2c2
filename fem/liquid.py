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
from functools import cached_property, lru_cache

import basix.ufl
import numpy as np
from dolfinx import fem
from mpi4py import MPI
from petsc4py import PETSc

from hydroelastic.fem.cell_matrices import CellMatrices
from hydroelastic.fem.cells import cell_corners, owned_cells
from hydroelastic.fem.direct import direct_solver
from hydroelastic.fem.liquid_operator import first_dof
from hydroelastic.fem.numbering import Numbering, numbered
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
        cells: matrices of its cells.
        degree: polynomial degree.
        zero_potential: names of the surfaces on which ψ = 0: pressure release, or the mirror plane of antisymmetric
            modes.
        layers: the liquids, from the bottom up.
        layer_of: layer of each degree of freedom of this process, owned ones first.
        continuous_pressure: the liquids, where the pressure ρψ is continuous across their interface, as it is at
            infinite frequency. ψ then stands for it, and there is one layer of unit density for all that takes ψ; in it
            A = ∫(1/ρ)∇ψ·∇q.
        geometry: what the plane of the mesh stands for.
    """

    tank: TankMesh
    space: fem.FunctionSpace
    cells: CellMatrices
    degree: int
    zero_potential: tuple[str, ...]
    layers: tuple[Layer, ...]
    layer_of: np.ndarray
    continuous_pressure: tuple[Layer, ...] = ()
    geometry: Geometry = PLANE

    @property
    def size(self) -> int:
        """Number of degrees of freedom, those with a prescribed value and those inside of cells included."""
        return int(self.space.dofmap.index_map.size_global)

    @property
    def numbering(self) -> Numbering:
        """Numbers of the unknowns."""
        return self.cells.numbering

    @property
    def densities(self) -> tuple[float, ...]:
        """Density ρ of each layer, from the bottom up."""
        return tuple(layer.density for layer in self.layers)

    @cached_property
    def owned_layer_of(self) -> np.ndarray:
        """Layer of each unknown that this process owns."""
        return self.layer_of[self.numbering.owned_dofs]

    def zero_dofs(self) -> np.ndarray:
        """Owned unknowns on the surfaces with ψ = 0, as local indices (collective)."""
        return self.surface_dofs(self.zero_potential) if self.zero_potential else np.empty(0, dtype=np.int32)

    def energy_densities(self) -> np.ndarray:
        """Kinetic energy over ½ω²|∇ψ|² in each owned cell: `cell_densities` times the weight of the geometry at the
        cell's middle."""
        middles = cell_corners(self.tank.mesh, owned_cells(self.tank.mesh))[..., 0].mean(axis=1)
        densities: np.ndarray = self.cell_densities() * self.geometry.weight(middles)
        return densities

    def cell_densities(self) -> np.ndarray:
        """ρ in each owned cell, or 1/ρ where ψ stands for the pressure."""
        densities = np.full(len(owned_cells(self.tank.mesh)), self.layers[0].density)
        for layer in self.continuous_pressure or self.layers[1:]:
            cells = self.tank.cells(layer.name)
            densities[cells[cells < len(densities)]] = (
                1.0 / layer.density if self.continuous_pressure else layer.density
            )
        return densities

    def facet_dofs(self, place: int) -> np.ndarray:
        """Numbers, in a cell, of the unknowns on the closure of its facet ``place``."""
        dim = self.tank.mesh.topology.dim - 1
        return np.array(self.space.element.basix_element.entity_closure_dofs[dim][place])

    def surface_dofs(self, names: tuple[str, ...], layer: int | None = None) -> np.ndarray:
        """Owned unknowns on the closure of named surfaces, of one layer or of all: sorted local numbers."""
        facets = np.concatenate([self.tank.facets(name) for name in names]) if names else np.empty(0, np.int32)
        dim = self.tank.mesh.topology.dim - 1
        # remote=True: a process may own an unknown of a surface none of whose facets it holds.
        unknowns = self.numbering.owned_among(fem.locate_dofs_topological(self.space, dim, facets, remote=True))
        return unknowns if layer is None else unknowns[self.owned_layer_of[unknowns] == layer]

    def unknown_positions(self) -> np.ndarray:
        """Coordinates of the owned unknowns, shape (owned unknowns, gdim)."""
        mesh = self.tank.mesh
        return self.space.tabulate_dof_coordinates()[self.numbering.owned_dofs, : mesh.geometry.dim]


def liquid_space(
    tank: TankMesh,
    degree: int,
    zero_potential: tuple[str, ...] = (),
    layers: tuple[Layer, ...] = ONE_LIQUID,
    *,
    continuous_pressure: bool = False,
    condensed: bool = False,
    geometry: Geometry = PLANE,
) -> LiquidSpace:
    """Space of ψ of the given degree; its degree does not depend on the mesh's (collective)."""
    space = fem.functionspace(tank.mesh, _lagrange(tank.mesh.topology.cell_name(), degree))
    index_map = space.dofmap.index_map
    layer_of = np.zeros(index_map.size_local + index_map.num_ghosts, dtype=np.int8)
    for number, layer in enumerate(() if continuous_pressure else layers[1:], 1):
        layer_of[space.dofmap.list[tank.cells(layer.name)].ravel()] = number
    return LiquidSpace(
        tank=tank,
        space=space,
        cells=CellMatrices(numbering=numbered(space, condensed=condensed), geometry=geometry),
        degree=degree,
        zero_potential=zero_potential,
        layers=ONE_LIQUID if continuous_pressure else layers,
        layer_of=layer_of,
        continuous_pressure=layers if continuous_pressure else (),
        geometry=geometry,
    )


@lru_cache(maxsize=16)
def _lagrange(cell_name: str, degree: int) -> basix.ufl._ElementBase:
    return basix.ufl.element("Lagrange", cell_name, degree)


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


def cell_values(liquid: LiquidSpace, potentials: list[PETSc.Vec]) -> np.ndarray:
    """Potentials at the degrees of freedom of each cell of this process, those inside of it too (collective)."""
    numbering = liquid.numbering
    local = numbering.spread(np.array([potential.array_r for potential in potentials]))
    dofs = liquid.space.dofmap.list[: len(owned_cells(liquid.tank.mesh))]
    values: np.ndarray = local[:, dofs]
    if len(numbering.inside):
        outside = np.ascontiguousarray(values[:, :, numbering.outside].transpose(1, 2, 0))
        values[:, :, numbering.inside] = (liquid.cells.extension @ outside).transpose(2, 0, 1)
    return values


def as_functions(liquid: LiquidSpace, potentials: list[PETSc.Vec]) -> list[fem.Function]:
    """Potentials as dolfinx functions with their ghost values, inside of cells too (collective)."""
    functions = []
    dofs = liquid.space.dofmap.list[: len(owned_cells(liquid.tank.mesh))]
    for values in cell_values(liquid, potentials) if potentials else ():
        function = fem.Function(liquid.space)
        function.x.array[dofs] = values
        function.x.scatter_forward()
        functions.append(function)
    return functions


def constrained_dofs(liquid: LiquidSpace) -> np.ndarray:
    """Owned unknowns whose value is zero: those of the surfaces with ψ = 0, and one of each closed layer
    (collective)."""
    comm = liquid.tank.mesh.comm
    held = [first_dof(liquid, layer, liquid.numbering.range, comm) for layer in closed_layers(liquid)]
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
    """Factorized Laplace operator A⁺ on the unknowns of the liquids; those that are held have rows of the identity.

    Args:
        matrix: A on all unknowns.
        constrained: owned local unknowns that are zero, shape (constrained unknowns,).
        closed: the layers of constant volume.
    """

    def __init__(self, matrix: PETSc.Mat, constrained: np.ndarray, closed: tuple[ClosedLayer, ...]) -> None:
        """Factorize (collective)."""
        self._block = matrix.copy()
        self._block.zeroRowsColumns((constrained + matrix.getOwnershipRange()[0]).astype(PETSc.IntType), diag=1.0)
        self._solver: PETSc.KSP | None = direct_solver(self._block)
        self._rhs = self._block.createVecRight()
        self._held = constrained
        self._closed = closed
        self._comm = matrix.comm.tompi4py()
        self.solves = 0

    def release(self) -> None:
        """Give the factors back; another solution would factorize again (collective)."""
        if self._solver is not None:
            self._solver.destroy()
            self._solver = None

    def _factorized(self) -> PETSc.KSP:
        if self._solver is None:
            self._solver = direct_solver(self._block)
        return self._solver

    def solve(self, load: PETSc.Vec, potential: PETSc.Vec) -> None:
        """``potential`` ← A⁺ ``load`` (both on all unknowns; ``load`` is not changed)."""
        values = self._rhs.array
        values[:] = load.array_r
        if self._closed:
            fluxes = self._sums([values[layer.dofs].sum() for layer in self._closed])
            for layer, flux in zip(self._closed, fluxes, strict=True):
                values[layer.dofs] -= flux / layer.measure * layer.load
        values[self._held] = 0.0
        self._factorized().solve(self._rhs, potential)
        if self._closed:
            solution = potential.array
            means = self._sums([layer.load @ solution[layer.dofs] for layer in self._closed])
            for layer, mean in zip(self._closed, means, strict=True):
                solution[layer.dofs] -= mean / layer.measure
        self.solves += 1

    def solve_all(self, coupling: PETSc.Mat) -> np.ndarray:
        """Return A⁺C for all loads C at once, on one process, both of shape (N, loads), the result in Fortran's
        order."""
        right = coupling.convert("dense", PETSc.Mat())
        values = right.getDenseArray()
        # Few unknowns are on the moving surfaces.
        moving = [np.arange(len(values))[layer.dofs][layer.load != 0.0] for layer in self._closed]
        loads = [layer.load[layer.load != 0.0] / layer.measure for layer in self._closed]
        flux, one = coupling.createVecs()
        for layer, places, load in zip(self._closed, moving, loads, strict=True):
            one.set(0.0)
            one.array[layer.dofs] = 1.0
            coupling.multTranspose(one, flux)
            values[places] -= np.outer(load, flux.array_r)
        values[self._held] = 0.0
        answers = np.empty(values.shape, order="F")
        result = PETSc.Mat().createDense(answers.shape, array=answers, comm=PETSc.COMM_SELF)
        self._factorized().getPC().getFactorMatrix().matSolve(right, result)
        for layer, places, load in zip(self._closed, moving, loads, strict=True):
            answers[layer.dofs] -= load @ answers[places]
        self.solves += answers.shape[1]
        return answers

    def _sums(self, values: list[float]) -> np.ndarray:
        total = np.array(values)
        self._comm.Allreduce(MPI.IN_PLACE, total)
        return total
