"""The coupled problem as a plain value: K, M, C, A and what each block of unknowns means.

    K ζ = ω² (M ζ + ρ Cᵀ ψ),    A ψ = C ζ        ζ = (a, η): body shapes, then the free surface

Every analysis takes this value. Unknowns are distributed: the bodies' few on rank 0, those of the free surface beside
the potential's unknowns on the same surface.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.liquid import LiquidMatrices, LiquidSolver, LiquidSpace, grounded_dofs
from hydroelastic.fem.shape_loads import shape_loads, surface_load
from hydroelastic.fem.surfaces import Body, FreeSurface


@dataclass(frozen=True, kw_only=True)
class CoupledPencil:
    """Matrices of the coupled problem.

    Attributes:
        liquid: the space of ψ.
        bodies: the bodies, in the order of their unknowns.
        free_surface: the free surface, or ``None``.
        density: ρ of the liquid.
        stiffness: K, n × n, symmetric and semi-definite; zero on rigid motions without restoring force.
        mass: M, n × n; zero on the free surface.
        coupling: C, N × n: load on ψ by a unit of each surface unknown.
        laplace: A, N × N.
        solver: A⁺.
        volume: Cᵀ1, the volume that a unit of each surface unknown displaces, length n.
    """

    liquid: LiquidSpace
    bodies: tuple[Body, ...]
    free_surface: FreeSurface | None
    density: float
    stiffness: PETSc.Mat
    mass: PETSc.Mat
    coupling: PETSc.Mat
    laplace: PETSc.Mat
    solver: LiquidSolver
    volume: PETSc.Vec

    @property
    def body_size(self) -> int:
        """Number of body unknowns; they come first, on rank 0."""
        return sum(body.size for body in self.bodies)

    @property
    def size(self) -> int:
        """Number of surface unknowns n."""
        return int(self.stiffness.getSize()[0])

    @property
    def free_rigid(self) -> np.ndarray:
        """Indices of the body unknowns without stiffness: rigid motions that nothing restores."""
        stiffness = np.concatenate([body.stiffness for body in self.bodies] or [np.empty(0)])
        return np.flatnonzero(stiffness == 0.0)

    @property
    def rigid_displaces(self) -> bool:
        """Whether one of them displaces volume (collective)."""
        volume = np.abs(self.body_values(self.volume))
        # Pitch displaces none but for round-off: compare with the largest.
        return bool(np.any(volume[self.free_rigid] > 1e-10 * volume.max(initial=0.0)))

    @property
    def zero_mode_count(self) -> int:
        """Motions of zero stiffness that the liquid's volume allows (collective)."""
        constrained = self.liquid.keeps_volume and self.rigid_displaces
        return len(self.free_rigid) - int(constrained)

    def body_values(self, vector: PETSc.Vec) -> np.ndarray:
        """The body unknowns of a surface vector, on every process."""
        comm = self.stiffness.comm.tompi4py()
        local = vector.array_r[: self.body_size].copy() if comm.rank == 0 else None
        return np.asarray(comm.bcast(local, root=0))


def build_pencil(
    liquid: LiquidSpace,
    matrices: LiquidMatrices,
    *,
    bodies: tuple[Body, ...],
    free_surface: FreeSurface | None,
    density: float,
) -> CoupledPencil:
    """Assemble the coupled problem.

    Args:
        liquid: space of the potential.
        matrices: A and S on that space.
        bodies: what floats.
        free_surface: the gravity surface, or ``None`` when a lid, bodies or ψ = 0 take all of the top.
        density: ρ of the liquid.

    Returns:
        The matrices, with the liquid factorized (collective).
    """
    laplace = matrices.laplace
    blocks = [_body_coupling(liquid, bodies, laplace)] if bodies else []
    body_stiffness = np.concatenate([body.stiffness for body in bodies] or [np.empty(0)])
    body_mass = np.concatenate([body.mass for body in bodies] or [np.empty(0)])
    stiffness_blocks = [_diagonal(body_stiffness, laplace.comm)] if bodies else []
    mass_blocks = [_diagonal(body_mass, laplace.comm)] if bodies else []
    if free_surface is not None:
        first = laplace.getOwnershipRange()[0]
        dofs = liquid.surface_dofs((free_surface.surface,)) + first
        on_surface = PETSc.IS().createGeneral(dofs.astype(PETSc.IntType), comm=laplace.comm)
        everything = PETSc.IS().createStride(laplace.getLocalSize()[0], first=first, step=1, comm=laplace.comm)
        surface_mass = matrices.surface_mass
        assert surface_mass is not None
        blocks.append(surface_mass.createSubMatrix(everything, on_surface))
        gravity_stiffness = surface_mass.createSubMatrix(on_surface, on_surface)
        gravity_stiffness.scale(density * free_surface.gravity)
        stiffness_blocks.append(gravity_stiffness)
        mass_blocks.append(_zero_like(gravity_stiffness))
    coupling = _joined([blocks])
    ones = coupling.createVecLeft()
    ones.set(1.0)
    volume = coupling.createVecRight()
    coupling.multTranspose(ones, volume)
    moving = _moving_surface_load(liquid, bodies, free_surface, laplace) if liquid.keeps_volume else None
    return CoupledPencil(
        liquid=liquid,
        bodies=bodies,
        free_surface=free_surface,
        density=density,
        stiffness=_joined(_block_diagonal(stiffness_blocks)),
        mass=_joined(_block_diagonal(mass_blocks)),
        coupling=coupling,
        laplace=laplace,
        solver=LiquidSolver(laplace, grounded_dofs(liquid), moving),
        volume=volume,
    )


def _body_coupling(liquid: LiquidSpace, bodies: tuple[Body, ...], laplace: PETSc.Mat) -> PETSc.Mat:
    """Columns ∫φᵢ q over each body's wetted surface."""
    comm = liquid.tank.mesh.comm
    columns = sum(body.size for body in bodies)
    rows = laplace.getLocalSize()[0]
    matrix = PETSc.Mat().createAIJ(
        ((rows, PETSc.DETERMINE), (columns if comm.rank == 0 else 0, columns)), comm=laplace.comm
    )
    # Collective; left to the first value it would wait for processes that a body does not touch.
    matrix.setUp()
    first = laplace.getOwnershipRange()[0]
    column = 0
    for body in bodies:
        for load in shape_loads(liquid, body):
            (nonzero,) = np.nonzero(load)
            matrix.setValues(
                (nonzero + first).astype(PETSc.IntType), [column], load[nonzero], addv=PETSc.InsertMode.INSERT_VALUES
            )
            column += 1
    matrix.assemble()
    return matrix


def _moving_surface_load(
    liquid: LiquidSpace, bodies: tuple[Body, ...], free_surface: FreeSurface | None, laplace: PETSc.Mat
) -> PETSc.Vec:
    """∫q over all moving surfaces."""
    names = [body.surface for body in bodies] + ([free_surface.surface] if free_surface else [])
    load = laplace.createVecRight()
    load.array[:] = surface_load(liquid, tuple(names))
    return load


def _diagonal(values: np.ndarray, comm: PETSc.Comm) -> PETSc.Mat:
    """Diagonal matrix that lies on rank 0."""
    local = len(values) if comm.rank == 0 else 0
    vector = PETSc.Vec().createMPI((local, len(values)), comm=comm)
    if local:
        vector.array[:] = values
    matrix = PETSc.Mat().createAIJ(((local, len(values)), (local, len(values))), nnz=1, comm=comm)
    matrix.setDiagonal(vector)
    matrix.assemble()
    return matrix


def _zero_like(matrix: PETSc.Mat) -> PETSc.Mat:
    zero = PETSc.Mat().createAIJ(matrix.getSizes(), nnz=1, comm=matrix.comm)
    zero.assemble()
    return zero


def _block_diagonal(blocks: list[PETSc.Mat]) -> list[list[PETSc.Mat | None]]:
    return [[block if row == column else None for column, block in enumerate(blocks)] for row in range(len(blocks))]


def _joined(blocks: list[list[PETSc.Mat | None]]) -> PETSc.Mat:
    """One sparse matrix from a table of blocks; on each process the blocks' rows and columns follow each other."""
    if len(blocks) == 1 and len(blocks[0]) == 1:
        return blocks[0][0]
    comm = next(block for row in blocks for block in row if block is not None).comm
    return PETSc.Mat().createNest(blocks, comm=comm).convert("aij")
