"""The coupled problem on a plan of triangles: ψ in continuous polynomials, the depth in a few poles.

    A⁺ = Σ_j c_j (K₂ + d_j M₂)⁻¹,    K₂ = ∫∇ψ·∇q,  M₂ = ∫ψq over the plan,    f(k²) ≈ Σ_j c_j/(k² + d_j)

Each process has the whole plan, and factorizes its share of the poles; one sum over the processes gives ψ.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import basix
import numpy as np
import ufl
from dolfinx import fem
from dolfinx.mesh import meshtags
from mpi4py import MPI
from numpy.typing import NDArray
from petsc4py import PETSc
from scipy import sparse

from hydroelastic.fem.cells import CURVED_QUADRATURE, cell_jacobians, cell_positions, is_straight
from hydroelastic.fem.direct import direct_solver
from hydroelastic.fem.kernels import assembled, compiled_form
from hydroelastic.fem.liquid import LiquidSpace, liquid_space
from hydroelastic.fem.liquid_matrices import laplace_matrix
from hydroelastic.fem.pencil import CoupledPencil, SurfaceBlocks, coupled_pencil
from hydroelastic.fem.surfaces import Body, LiquidSurface
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.meshes.geometry import FREE_SURFACE
from hydroelastic.meshes.plan_loops import Mirrors
from hydroelastic.modal.liquid.vertical_poles import VerticalPoles
from hydroelastic.modal.plate.rectangle import ClassParity
from hydroelastic.physics.arrays import FloatArray

Deflection = Callable[[NDArray[np.float64]], NDArray[np.float64]]
"""Shapes of a plate at points (2, n) → (shapes, n)."""


@dataclass(frozen=True, kw_only=True)
class PlanPlate:
    """A plate as a body, with all of its shapes at once.

    Attributes:
        body: the body.
        deflection: its shapes.
        wavenumber: of its shortest shape.
        missing_energy: from the amplitudes of the shapes in some modes (modes, shapes), their λ and ρ∫ψφ, an estimate
            of the energy that the shapes left out would have, shape (modes,).
    """

    body: Body
    deflection: Deflection
    wavenumber: float
    missing_energy: Callable[[NDArray[np.float64], NDArray[np.float64], Pressures], NDArray[np.float64]]


Pressures = Callable[[PlanPlate], NDArray[np.float64]]
"""ρ∫ψφ of some modes and the shapes φ of a plate, shape (modes, shapes)."""


@dataclass(frozen=True, kw_only=True)
class PlanSpace:
    """Matrices on the plan or a part of it between mirror planes, alike on each process.

    Energies are those of all parts.

    Attributes:
        liquid: the space of ψ.
        stiffness: K₂ on the kept unknowns.
        mass: M₂ on the kept unknowns.
        water: ∫ψq over the water on the kept unknowns; ``None`` where plates cover all of it.
        kept: unknowns of the space that are not zero on a mirror plane.
        images: number of parts that are alike.
        closed: whether the constant is among the functions, and ∫ζ = 0.
    """

    liquid: LiquidSpace
    stiffness: PETSc.Mat
    mass: PETSc.Mat
    water: sparse.csr_matrix | None
    kept: NDArray[np.int32]
    images: int = 1
    closed: bool = True

    @property
    def size(self) -> int:
        """Number of kept unknowns."""
        return len(self.kept)

    def of_class(self, parity: ClassParity, mirrors: Mirrors) -> PlanSpace:
        """Return the space of one symmetry: odd functions are zero on the mirror plane."""
        if 1 not in parity:
            return self
        places = self.liquid.space.tabulate_dof_coordinates()
        zero = np.full(len(places), False)
        for axis, (own, mirror) in enumerate(zip(parity, mirrors, strict=True)):
            if own == 1:
                zero |= np.abs(places[:, axis] - mirror) < _ON_MIRROR
        kept = np.flatnonzero(~zero).astype(np.int32)
        rows = PETSc.IS().createGeneral(kept.astype(PETSc.IntType), comm=PETSc.COMM_SELF)
        stiffness, mass = (matrix.createSubMatrix(rows, rows) for matrix in (self.stiffness, self.mass))
        water = None if self.water is None else self.water[kept][:, kept].tocsr()
        return replace(self, stiffness=stiffness, mass=mass, water=water, kept=kept, closed=False)

    def expanded(self, values: FloatArray) -> NDArray[np.float64]:
        """Return values of the kept unknowns (size, …) as those of all unknowns of the space."""
        whole = np.zeros((self.liquid.size, *values.shape[1:]))
        whole[self.kept] = values
        return whole

    def loads(self, plate: PlanPlate) -> NDArray[np.float64]:
        """Return ∫φq over a plate for each of its shapes φ, shape (shapes, unknowns)."""
        mesh = self.liquid.tank.mesh
        cells = self.liquid.tank.cells(plate.body.surface)
        degree = self.liquid.degree
        corners = cell_positions(mesh, cells, np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]))
        sizes = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
        loads = np.zeros((plate.body.size, self.liquid.size))
        # Cells in the layers need fewer points than the longest ones.
        orders = degree + _SPARE_DEGREES + 2 * np.ceil(0.5 * plate.wavenumber * sizes).astype(int)
        for order in np.unique(orders):
            chosen = cells[orders == order]
            reference, weights = basix.make_quadrature(basix.CellType.triangle, int(order))
            places = cell_positions(mesh, chosen, reference)
            measures = np.abs(np.linalg.det(cell_jacobians(mesh, chosen, reference)))
            basis = self.liquid.space.element.basix_element.tabulate(0, reference)[0, :, :, 0]
            values = plate.deflection(places.reshape(-1, 2).T).reshape(plate.body.size, len(chosen), len(weights))
            parts = (values * (measures * weights)) @ basis
            dofs = self.liquid.space.dofmap.list[chosen]
            spread = sparse.csr_matrix(
                (np.ones(dofs.size), (np.arange(dofs.size), dofs.ravel())), shape=(dofs.size, self.liquid.size)
            )
            loads += parts.reshape(plate.body.size, -1) @ spread
        return self.images * loads[:, self.kept]


# Degrees of the quadrature beyond that of ψ.
_SPARE_DEGREES = 8
# Unknowns this close to a mirror plane, in units of the tank, lie on it.
_ON_MIRROR = 1e-10


def plan_space(tank: TankMesh, degree: int, images: int = 1) -> PlanSpace:
    """Assemble what all problems on a plan share."""
    liquid = liquid_space(tank, degree)
    stiffness = laplace_matrix(liquid)
    stiffness.scale(float(images))
    cells = np.arange(tank.cell_count, dtype=np.int32)
    has_water = FREE_SURFACE in tank.cell_names
    return PlanSpace(
        liquid=liquid,
        stiffness=stiffness,
        mass=_mass(liquid, cells, images),
        water=as_sparse(_mass(liquid, tank.cells(FREE_SURFACE), images)) if has_water else None,
        kept=np.arange(liquid.size, dtype=np.int32),
        images=images,
    )


def _mass(liquid: LiquidSpace, cells: NDArray[np.int32], images: int) -> PETSc.Mat:
    space = liquid.space
    trial, test = ufl.TrialFunction(space), ufl.TestFunction(space)
    more = 0 if is_straight(space.mesh) else CURVED_QUADRATURE
    chosen = meshtags(space.mesh, space.mesh.topology.dim, cells, np.ones(len(cells), dtype=np.int32))
    dx = ufl.Measure("dx", subdomain_data=chosen, metadata={"quadrature_degree": 2 * liquid.degree + more})
    form: fem.Form = compiled_form(ufl.inner(trial, test) * dx(1))
    mass = assembled(form)
    mass.scale(float(images))
    return mass


def as_sparse(matrix: PETSc.Mat) -> sparse.csr_matrix:
    """Return a matrix of this process alone for SciPy."""
    starts, columns, values = matrix.getValuesCSR()
    return sparse.csr_matrix((values, columns, starts), shape=matrix.getSize())


def as_matrix(matrix: sparse.csr_matrix) -> PETSc.Mat:
    """Return a sparse matrix of this process alone."""
    rows = matrix.indptr.astype(PETSc.IntType), matrix.indices.astype(PETSc.IntType), matrix.data
    copied = PETSc.Mat().createAIJ(matrix.shape, csr=rows, comm=PETSc.COMM_SELF)
    copied.assemble()
    return copied


@dataclass(frozen=True, kw_only=True)
class PlanLiquid:
    """The unknowns of ψ on the still surface; see `LiquidUnknowns`.

    Attributes:
        space: the plan.
        poles: of the depth.
        densities: see there.
    """

    space: PlanSpace
    poles: VerticalPoles
    densities: tuple[float, ...] = (1.0,)

    @property
    def size(self) -> int:
        """Number of unknowns N."""
        return self.space.size

    @property
    def owned_layer_of(self) -> np.ndarray:
        """All of them carry the constant, if it is among the functions."""
        return np.full(self.size, 0 if self.space.closed else -1, dtype=np.int8)

    def zero_dofs(self) -> np.ndarray:
        """There are none."""
        return np.empty(0, dtype=np.int32)


@dataclass(frozen=True, kw_only=True)
class PoleStack(PlanLiquid):
    """The unknowns ψ_j of all poles, one after the other, ψ = Σ c_j ψ_j; see `LiquidUnknowns`."""

    @property
    def size(self) -> int:
        """Number of unknowns N."""
        return self.space.size * len(self.poles.shifts)

    @property
    def owned_layer_of(self) -> np.ndarray:
        """0 for the unknowns of d₀ = 0, which carry the constant, −1 for all others."""
        carries = (np.arange(self.size) < self.space.size) & self.space.closed
        return np.where(carries, 0, -1)


@dataclass(kw_only=True)
class PoleOperator:
    """A⁺ = Σ c_j (K₂ + d_j M₂)⁻¹, each process for its share of the poles.

    Attributes:
        liquid: the unknowns.
        comm: the processes.
        idle: whether it will answer no loads, and factorizes nothing.
        solves: how many loads were answered.
    """

    liquid: PlanLiquid
    comm: MPI.Comm
    idle: bool = False
    solves: int = 0
    _solvers: list[tuple[int, PETSc.KSP, PETSc.Vec, PETSc.Vec]] = field(init=False)
    _constant: NDArray[np.float64] = field(init=False)

    def __post_init__(self) -> None:
        """Factorize (collective)."""
        space, poles = self.liquid.space, self.liquid.poles
        one = space.mass.createVecRight()
        one.set(1.0)
        self._constant = (space.mass * one).array.copy()
        self._solvers = []
        for number in range(self.comm.rank, 0 if self.idle else len(poles.shifts), self.comm.size):
            matrix = space.stiffness.copy()
            matrix.axpy(poles.shifts[number], space.mass, structure=PETSc.Mat.Structure.SAME_NONZERO_PATTERN)
            if poles.shifts[number] == 0.0 and space.closed:
                # Without its first unknown, which is exact for loads without flux.
                rows = PETSc.IS().createStride(self.liquid.size - 1, first=1, step=1, comm=PETSc.COMM_SELF)
                matrix = matrix.createSubMatrix(rows, rows)
            solver = direct_solver(matrix)
            self._solvers.append((number, solver, *matrix.createVecs()))

    def solve(self, load: PETSc.Vec, potential: PETSc.Vec) -> None:
        """See `LiquidOperator.solve`."""
        total = np.zeros(self.liquid.size)
        for number, part in self.parts(load.array_r):
            total += self.liquid.poles.weights[number] * part
        if self.comm.size > 1:
            # The same sum on each process, to the last digit: all of them go through the same steps.
            parts = np.empty((self.comm.size, len(total)))
            self.comm.Allgather(total, parts)
            total = parts.sum(axis=0)
        potential.array[:] = total
        self.solves += 1

    def parts(self, load: NDArray[np.float64]) -> list[tuple[int, NDArray[np.float64]]]:
        """Return ψ_j of a load for this process's poles, with their numbers."""
        area = self._constant.sum()
        balanced = load - load.sum() / area * self._constant if self.liquid.space.closed else load
        answers = []
        for number, solver, right, left in self._solvers:
            first = len(balanced) - len(right.array)
            left.array[:] = balanced[first:]
            solver.solve(left, right)
            part = np.concatenate([np.zeros(first), right.array_r])
            if first:
                part -= (self._constant @ part) / area
            answers.append((number, part))
        return answers


def plan_pencil(
    space: PlanSpace, poles: VerticalPoles, plates: tuple[PlanPlate, ...], *, waves: bool, comm: MPI.Comm | None
) -> CoupledPencil[PlanLiquid] | None:
    """Assemble the coupled problem, alike on each process; ``None`` where nothing moves (collective).

    The matrix "A" of the pencil is K₂, its part of d₀ = 0: `stacked` gives the problem whose A is a matrix.
    """
    liquid = PlanLiquid(space=space, poles=poles)
    loads, water = _blocks(space, plates, waves=waves)
    if loads is None and water is None:
        return None
    return coupled_pencil(
        liquid,
        bodies=tuple(plate.body for plate in plates if plate.body.size),
        surfaces=(LiquidSurface(surface=FREE_SURFACE, gravity=1.0),) if water is not None else (),
        body_coupling=as_matrix(loads) if loads is not None else None,
        surface_blocks=[SurfaceBlocks(coupling=as_matrix(water), stiffness=as_matrix(_square(water)))]
        if water is not None
        else [],
        laplace=space.stiffness,
        solver=PoleOperator(liquid=liquid, comm=comm or MPI.COMM_SELF, idle=comm is None),
        closed=(0,) if space.closed else (),
    )


def stacked_pencil(
    space: PlanSpace, poles: VerticalPoles, plates: tuple[PlanPlate, ...], *, waves: bool
) -> CoupledPencil[PoleStack]:
    """As `plan_pencil`, in the potentials of all poles: A is block diagonal, and the inertia of its sum with K is had.

    It is made to be counted in, and has no solver of its own.
    """
    loads, water = _blocks(space, plates, waves=waves)
    stiffness, mass = as_sparse(space.stiffness), as_sparse(space.mass)
    laplace = sparse.block_diag(
        [weight * (stiffness + shift * mass) for weight, shift in zip(poles.weights, poles.shifts, strict=True)], "csr"
    )

    def upon_each_other(block: sparse.csr_matrix) -> PETSc.Mat:
        return as_matrix(sparse.vstack([weight * block for weight in poles.weights], "csr"))

    return coupled_pencil(
        PoleStack(space=space, poles=poles),
        bodies=tuple(plate.body for plate in plates if plate.body.size),
        surfaces=(LiquidSurface(surface=FREE_SURFACE, gravity=1.0),) if water is not None else (),
        body_coupling=upon_each_other(loads) if loads is not None else None,
        surface_blocks=[SurfaceBlocks(coupling=upon_each_other(water), stiffness=as_matrix(_square(water)))]
        if water is not None
        else [],
        laplace=as_matrix(laplace),
        solver=PoleOperator(liquid=PlanLiquid(space=space, poles=poles), comm=MPI.COMM_SELF, idle=True),
        closed=(0,) if space.closed else (),
    )


def _blocks(
    space: PlanSpace, plates: tuple[PlanPlate, ...], *, waves: bool
) -> tuple[sparse.csr_matrix | None, sparse.csr_matrix | None]:
    """Loads by the plates' shapes and by the water's height, (N, shapes) and (N, unknowns of the water)."""
    parts = [space.loads(plate) for plate in plates if plate.body.size]
    loads = sparse.csr_matrix(np.concatenate(parts).T) if parts else None
    if not waves or space.water is None:
        return loads, None
    return loads, space.water[:, water_unknowns(space)].tocsr()


def water_unknowns(space: PlanSpace) -> NDArray[np.int64]:
    """Return which of the kept unknowns of ψ are on the water, ascending."""
    water = np.unique(space.liquid.space.dofmap.list[space.liquid.tank.cells(FREE_SURFACE)])
    return np.flatnonzero(np.isin(space.kept, water))


def _square(water: sparse.csr_matrix) -> sparse.csr_matrix:
    return water[np.flatnonzero(np.diff(water.indptr))].tocsr()
