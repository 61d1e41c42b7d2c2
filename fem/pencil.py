"""The coupled problem as a plain value: K, M, C, A and the meaning of each block of unknowns.

    K ζ = ω² (M ζ + (ρC)ᵀ ψ),    A ψ = C ζ        ζ = (a, η …): body shapes, then the surfaces of the liquids

Every analysis takes this value. Unknowns are distributed: the bodies' few on rank 0, those of a liquid's surface beside
the potential's unknowns on the same surface.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Generic, TypeVar

import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.liquid_answer import LiquidAnswer, dense
from hydroelastic.fem.liquid_operator import LiquidOperator, LiquidUnknowns, first_dof
from hydroelastic.fem.surfaces import Body, LiquidSurface

Unknowns = TypeVar("Unknowns", bound=LiquidUnknowns)

# Relative volume below which a rigid motion counts as displacing none.
_NO_VOLUME = 1e-10
# Constraints that differ by less than this part differ by rounding of the loads, which is 4e-9 at the ends of a thin
# ellipse; a gap of the top of 1e-4 of the tank's length is one more by 1e-3.
_SAME_VOLUME = 1e-6


@dataclass(frozen=True, kw_only=True)
class VolumeConstraint:
    """∫ζ = 0 over the surfaces of a closed layer: the constant of its ψ is its Lagrange multiplier.

    Attributes:
        layer: index of the layer.
        density: ρ of it.
        volume: volume that a unit of each surface unknown takes from the layer, length n.
        largest: volume that a unit of any of them moves in and out of a layer at most.
    """

    layer: int
    density: float
    volume: PETSc.Vec
    largest: float


@dataclass(frozen=True, kw_only=True)
class CoupledPencil(Generic[Unknowns]):
    """Matrices of the coupled problem.

    Attributes:
        liquid: the unknowns of ψ: a space of polynomials in the volume, or on the surface alone.
        bodies: the bodies, in the order of their unknowns.
        surfaces: the surfaces of the liquids that move under gravity, in the order of their unknowns.
        restoring: K on the unknowns of each of these surfaces. With bodies of other stiffness and mass, only K and M
            differ.
        coupling: C, N × n: load on ψ by a unit of each surface unknown.
        momentum: ρC, each row times the density of its layer.
        laplace: A, N × N.
        solver: A⁺.
        constraints: of the closed layers. Where one follows from the others, as in two liquids that fill a rigid tank,
            it is left out: the constant of its ψ is then arbitrary.
        free_constants: owned unknowns of ψ, one for each layer whose constraint was left out.
        answer: ψ and momentum of a unit of each surface unknown, where they were computed once for many solutions.
    """

    liquid: Unknowns
    bodies: tuple[Body, ...]
    surfaces: tuple[LiquidSurface, ...]
    restoring: tuple[PETSc.Mat, ...]
    coupling: PETSc.Mat
    momentum: PETSc.Mat
    laplace: PETSc.Mat
    solver: LiquidOperator
    constraints: tuple[VolumeConstraint, ...]
    free_constants: np.ndarray
    answer: LiquidAnswer | None = None

    @property
    def body_size(self) -> int:
        """Number of body unknowns; they come first, on rank 0."""
        return sum(body.size for body in self.bodies)

    @property
    def size(self) -> int:
        """Number of surface unknowns n."""
        return int(self.coupling.getSize()[1])

    @property
    def surface_sizes(self) -> tuple[int, ...]:
        """Number of own unknowns of each surface on this process; they follow those of the bodies."""
        return tuple(block.getLocalSize()[0] for block in self.restoring)

    @cached_property
    def stiffness(self) -> PETSc.Mat:
        """K, n × n, symmetric; zero on rigid motions without restoring force, negative on unstable ones (collective
        when first asked for)."""
        of_bodies = [_diagonal(self.body_stiffness, self.laplace.comm)] if self.bodies else []
        return _joined(_block_diagonal([*of_bodies, *self.restoring]))

    @cached_property
    def mass(self) -> PETSc.Mat:
        """M, n × n; zero on the surfaces of the liquids (collective when first asked for)."""
        of_bodies = [_on_first(self.body_mass, self.laplace.comm)] if self.bodies else []
        of_surfaces = [_zeros(block.getSizes(), block.comm) for block in self.restoring]
        return _joined(_block_diagonal([*of_bodies, *of_surfaces]))

    @cached_property
    def dense_restoring(self) -> np.ndarray:
        """K of the unknowns of the surfaces, on one process, shape (surface unknowns, surface unknowns)."""
        return dense(_joined(_block_diagonal([*self.restoring]))) if self.restoring else np.empty((0, 0))

    @cached_property
    def body_stiffness(self) -> np.ndarray:
        """Stiffness of the body unknowns, shape (body unknowns,)."""
        return np.concatenate([body.stiffness for body in self.bodies] or [np.empty(0)])

    @cached_property
    def body_mass(self) -> np.ndarray:
        """Mass of the body unknowns without liquid, a block for each body, shape (body unknowns, body unknowns)."""
        mass, first = np.zeros((len(self.body_stiffness),) * 2), 0
        for body in self.bodies:
            mass[first : first + body.size, first : first + body.size] = body.mass
            first += body.size
        return mass

    def with_bodies(self, bodies: tuple[Body, ...]) -> CoupledPencil[Unknowns]:
        """Return the problem of other bodies with the same loads on the liquid."""
        other = replace(self, bodies=bodies)
        vars(other)["body_volumes"] = self.body_volumes
        return other

    @cached_property
    def volumes(self) -> np.ndarray:
        """Volumes of the constraints, on one process, shape (constraints, unknowns)."""
        return np.array([one.volume.array_r for one in self.constraints]).reshape(-1, self.size)

    @cached_property
    def unstable(self) -> np.ndarray:
        """Indices of the body unknowns of negative stiffness: unstable motions of floats."""
        return np.flatnonzero(self.body_stiffness < 0.0)

    @cached_property
    def free_rigid(self) -> np.ndarray:
        """Indices of the body unknowns without stiffness: rigid motions without restoring force."""
        return np.flatnonzero(self.body_stiffness == 0.0)

    @cached_property
    def body_volumes(self) -> np.ndarray:
        """Volume that each body unknown takes from each constrained layer, shape (body unknowns, constraints)
        (collective).

        Pitch displaces none; values within round-off are set to zero.
        """
        volumes = [self.body_values(constraint.volume) for constraint in self.constraints]
        table = np.array(volumes).reshape(len(volumes), self.body_size).T
        largest = max((constraint.largest for constraint in self.constraints), default=0.0)
        return np.where(np.abs(table) > _NO_VOLUME * largest, table, 0.0)

    @cached_property
    def rigid_constraints(self) -> tuple[np.ndarray, int]:
        """Orthogonal combinations of the constraints as columns, and the number of the first ones that rigid motions
        enter (collective)."""
        volumes = self.body_volumes[self.free_rigid]
        if not volumes.size:
            return np.eye(len(self.constraints)), 0
        return _combinations(tuple(map(tuple, volumes.tolist())))

    @property
    def zero_mode_count(self) -> int:
        """Motions of zero stiffness that the liquids' volumes allow (collective)."""
        return len(self.free_rigid) - self.rigid_constraints[1]

    def body_values(self, vector: PETSc.Vec) -> np.ndarray:
        """The body unknowns of a surface vector, on every process."""
        if vector.comm.size == 1:
            return np.array(vector.array_r[: self.body_size])
        comm = vector.comm.tompi4py()
        local = vector.array_r[: self.body_size].copy() if comm.rank == 0 else None
        return np.asarray(comm.bcast(local, root=0))


@lru_cache(maxsize=16)
def _combinations(rigid_volumes: tuple[tuple[float, ...], ...]) -> tuple[np.ndarray, int]:
    _, sizes, turn = np.linalg.svd(np.array(rigid_volumes))
    return turn.T, int(np.sum(sizes > _NO_VOLUME * sizes[0]))


@dataclass(frozen=True, kw_only=True)
class SurfaceBlocks:
    """The part of the pencil that one surface of the liquids brings.

    Attributes:
        coupling: load on ψ by a unit of each of its unknowns, N × unknowns.
        stiffness: restoring by gravity, unknowns × unknowns.
    """

    coupling: PETSc.Mat
    stiffness: PETSc.Mat


def coupled_pencil(
    liquid: Unknowns,
    *,
    bodies: tuple[Body, ...],
    surfaces: tuple[LiquidSurface, ...],
    body_coupling: PETSc.Mat | None,
    surface_blocks: list[SurfaceBlocks],
    laplace: PETSc.Mat,
    solver: LiquidOperator,
    closed: tuple[int, ...],
) -> CoupledPencil[Unknowns]:
    """Join the blocks of bodies and surfaces (collective)."""
    couplings = [surface.coupling for surface in surface_blocks]
    coupling = _joined([couplings if body_coupling is None else [body_coupling, *couplings]])
    constraints, free_constants = _volume_constraints(liquid, coupling, closed)
    return CoupledPencil(
        liquid=liquid,
        bodies=bodies,
        surfaces=surfaces,
        restoring=tuple(surface.stiffness for surface in surface_blocks),
        coupling=coupling,
        momentum=_weighed(liquid, coupling),
        laplace=laplace,
        solver=solver,
        constraints=constraints,
        free_constants=free_constants,
    )


def loads_on_first(columns: Iterable[np.ndarray], count: int, laplace: PETSc.Mat) -> PETSc.Mat:
    """Matrix of loads on ψ by body unknowns, which lie on rank 0 (collective)."""
    first_rank = laplace.comm.rank == 0
    rows = laplace.getLocalSize()[0]
    matrix = PETSc.Mat().createAIJ(((rows, PETSc.DETERMINE), (count if first_rank else 0, count)), comm=laplace.comm)
    matrix.setUp()
    # One after the other: in a volume all loads together would take more memory than A.
    for number, column in enumerate(columns):
        (loaded,) = np.nonzero(column)
        rows_of = (loaded + laplace.getOwnershipRange()[0]).astype(PETSc.IntType)
        matrix.setValues(rows_of, np.array([number], dtype=PETSc.IntType), column[loaded])
    matrix.assemble()
    return matrix


def _weighed(liquid: LiquidUnknowns, coupling: PETSc.Mat) -> PETSc.Mat:
    """ρC; C itself where ρ = 1 everywhere."""
    densities = np.array(liquid.densities)
    if np.all(densities == 1.0):
        return coupling
    weights = coupling.createVecLeft()
    weights.array[:] = densities[liquid.owned_layer_of]
    weighed = coupling.copy()
    weighed.diagonalScale(L=weights)
    return weighed


def _volume_constraints(
    liquid: LiquidUnknowns, coupling: PETSc.Mat, closed: tuple[int, ...]
) -> tuple[tuple[VolumeConstraint, ...], np.ndarray]:
    """The independent constraints of the closed layers, and an unknown of ψ for each dependent one.

    A constraint may be trivial: with continuous pressure a beam displaces as much below as above.
    """
    constraints: list[VolumeConstraint] = []
    free = [np.empty(0, dtype=np.int32)]
    ones = coupling.createVecLeft()
    largest = coupling.norm(PETSc.NormType.NORM_1)
    for layer in closed:
        ones.array[:] = liquid.owned_layer_of == layer
        volume = coupling.createVecRight()
        coupling.multTranspose(ones, volume)
        if _is_new(volume, constraints, largest):
            density = liquid.densities[layer]
            constraints.append(VolumeConstraint(layer=layer, density=density, volume=volume, largest=largest))
        else:
            free.append(first_dof(liquid, layer, coupling.getOwnershipRange(), coupling.comm.tompi4py()))
    return tuple(constraints), np.concatenate(free)


def _is_new(volume: PETSc.Vec, constraints: list[VolumeConstraint], largest: float) -> bool:
    """Whether a constraint is independent of others; ``largest`` is the largest volume that a unit moves in and out."""
    if volume.norm(PETSc.NormType.NORM_INFINITY) <= _SAME_VOLUME * largest:
        return False
    if not constraints:
        return True
    size, rest = volume.norm(), volume.copy()
    # Least squares on the others, which are few and independent.
    gram = np.array([[one.volume.dot(other.volume) for other in constraints] for one in constraints])
    parts = np.linalg.solve(gram, [one.volume.dot(volume) for one in constraints])
    for part, one in zip(parts, constraints, strict=True):
        rest.axpy(-part, one.volume)
    return bool(rest.norm() > _SAME_VOLUME * size)


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


def _on_first(values: np.ndarray, comm: PETSc.Comm) -> PETSc.Mat:
    """Square matrix that lies on rank 0."""
    local = len(values) if comm.rank == 0 else 0
    longest = int(np.count_nonzero(values, axis=1).max(initial=0)) + 1
    matrix = PETSc.Mat().createAIJ(((local, len(values)), (local, len(values))), nnz=longest, comm=comm)
    for row in range(local):
        (columns,) = np.nonzero(values[row])
        matrix.setValues([row], columns.astype(PETSc.IntType), values[row, columns])
    matrix.assemble()
    return matrix


def _zeros(sizes: tuple[tuple[int, int], tuple[int, int]], comm: PETSc.Comm) -> PETSc.Mat:
    zero = PETSc.Mat().createAIJ(sizes, nnz=1, comm=comm)
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
