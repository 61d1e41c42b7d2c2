"""The coupled problem of a box with rectangular plates: tensor products of two intervals, exact in depth.

With standing waves u_i(x) and v_j(y) of the two intervals

    A⁺ = Σ_ij (u_i v_j)(u_i v_j)ᵀ f(k_i² + k_j²),    f = 1/(k tanh kH)

is four products of small matrices. Ritz's method in V_x ⊗ V_y ⊗ H¹(−H, 0): frequencies come from above.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from petsc4py import PETSc
from scipy import sparse

from hydroelastic.fem.level_bed.interval import IntervalSpace
from hydroelastic.fem.liquid_answer import LiquidAnswer
from hydroelastic.fem.pencil import CoupledPencil, SurfaceBlocks, coupled_pencil
from hydroelastic.fem.plan.rectangle_body import RectangleBody
from hydroelastic.fem.surfaces import LiquidSurface
from hydroelastic.meshes.geometry import FREE_SURFACE
from hydroelastic.modal.liquid.vertical_poles import surface_response


@dataclass(frozen=True, kw_only=True)
class BoxLiquid:
    """The unknowns of ψ on the still surface of a box, or of the part of it that holds a symmetry class.

    Attributes:
        spaces: along x and along y.
        depth: H.
        images: number of parts of the tank that are alike; energies are those of all of them.
        densities: see `LiquidUnknowns`.
    """

    spaces: tuple[IntervalSpace, IntervalSpace]
    depth: float
    images: int
    densities: tuple[float, ...] = (1.0,)

    @property
    def shape(self) -> tuple[int, int]:
        """Number of functions along x and along y."""
        return self.spaces[0].size, self.spaces[1].size

    @property
    def size(self) -> int:
        """Number of unknowns N."""
        return self.shape[0] * self.shape[1]

    @property
    def owned_layer_of(self) -> np.ndarray:
        """0 for products of hats, which carry the constant, −1 for all others."""
        hats = [np.arange(space.size) < space.hats for space in self.spaces]
        return np.where(np.outer(*hats), 0, -1).ravel()

    def zero_dofs(self) -> np.ndarray:
        """There are none."""
        return np.empty(0, dtype=np.int32)

    @property
    def is_closed(self) -> bool:
        """Whether ∫ζ = 0: in the class that is even in both directions."""
        return not any(space.zero_at_end for space in self.spaces)

    @cached_property
    def responses(self) -> NDArray[np.float64]:
        """f of each pair of standing waves, 0 of the constant, shape as `shape`."""
        squares = np.add.outer(self.spaces[0].waves[0], self.spaces[1].waves[0])
        values = np.zeros(self.shape)
        moving = squares > 0.0
        values[moving] = surface_response(np.sqrt(squares[moving]), self.depth) / self.images
        return values

    def answer(self, loads: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return A⁺ of loads, shape (…, functions along x, functions along y)."""
        along, across = (space.waves[1] for space in self.spaces)
        potentials: NDArray[np.float64] = along @ (self.responses * (along.T @ loads @ across)) @ across.T
        return potentials


@dataclass(kw_only=True)
class BoxOperator:
    """A⁺ of a box.

    Attributes:
        liquid: the unknowns.
        solves: how many loads were answered.
    """

    liquid: BoxLiquid
    solves: int = 0

    def solve(self, load: PETSc.Vec, potential: PETSc.Vec) -> None:
        """See `LiquidOperator.solve`."""
        potential.array[:] = self.liquid.answer(load.array_r.reshape(self.liquid.shape)).ravel()
        self.solves += 1


class BoxStiffness:
    """A as a shell matrix: A = Σ (M u_i v_j) (M u_i v_j)ᵀ / f, 0 of the constant; with f over the number of images."""

    def __init__(self, liquid: BoxLiquid) -> None:
        self._liquid = liquid
        self._moments = tuple(space.mass @ space.waves[1] for space in liquid.spaces)
        with np.errstate(divide="ignore"):
            inverse = 1.0 / liquid.responses
        self._inverses = np.where(liquid.responses > 0.0, inverse, 0.0)

    def mult(self, _matrix: PETSc.Mat, potential: PETSc.Vec, load: PETSc.Vec) -> None:
        """``load`` ← A ``potential``."""
        load.array[:] = self.product(potential.array_r)

    def product(self, potential: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return A ψ, shape (N,)."""
        along, across = self._moments
        values = potential.reshape(self._liquid.shape)
        load: NDArray[np.float64] = (along @ (self._inverses * (along.T @ values @ across)) @ across.T).ravel()
        return load


def box_pencil(
    liquid: BoxLiquid, plates: tuple[RectangleBody, ...], *, waves: bool, dense: bool = False
) -> CoupledPencil[BoxLiquid] | None:
    """Assemble the coupled problem of a symmetry class, alike on each process."""
    moving = tuple(plate for plate in plates if plate.body.size)
    water = _water(liquid, plates) if waves else None
    if not moving and water is None:
        return None
    laplace = PETSc.Mat().createPython((liquid.size, liquid.size), BoxStiffness(liquid), comm=PETSc.COMM_SELF)
    laplace.setUp()
    loads = [sparse.csr_matrix(plate_loads(liquid, plate, plate.coefficients).T) for plate in moving]
    pencil = coupled_pencil(
        liquid,
        bodies=tuple(plate.body for plate in moving),
        surfaces=(LiquidSurface(surface=FREE_SURFACE, gravity=1.0),) if water else (),
        body_coupling=as_matrix(sparse.hstack(loads, format="csr")) if loads else None,
        surface_blocks=[SurfaceBlocks(coupling=as_matrix(water[0]), stiffness=as_matrix(water[1]))] if water else [],
        laplace=laplace,
        solver=BoxOperator(liquid=liquid),
        closed=(0,) if liquid.is_closed else (),
    )
    if not dense:
        return pencil
    coupling = sparse.hstack([*loads, *([water[0]] if water else [])], format="csr")
    potentials = liquid.answer(coupling.T.toarray().reshape(-1, *liquid.shape)).reshape(-1, liquid.size).T
    # To count, its surfaces need not be scaled.
    none, added_mass = np.empty((0, 0)), coupling.T @ potentials
    return replace(pencil, answer=LiquidAnswer(potentials=potentials, added_mass=added_mass, root=none, scaled=none))


def plate_loads(liquid: BoxLiquid, plate: RectangleBody, coefficients: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return ∫φ q over a plate and its images for functions φ, shape (functions, N)."""
    along, across = (
        space.moments(start, min(end, space.nodes[-1]), middle, side, count)
        for space, (start, end), middle, side, count in zip(
            liquid.spaces,
            plate.extents,
            plate.outline.position,
            plate.outline.size,
            coefficients.shape[1:],
            strict=True,
        )
    )
    loads: NDArray[np.float64] = liquid.images * (along @ coefficients @ across.T)
    return loads.reshape(len(coefficients), liquid.size)


def water_masses(
    liquid: BoxLiquid, plates: tuple[RectangleBody, ...]
) -> list[tuple[NDArray[np.float64], NDArray[np.float64]]]:
    """Return S = Σ M_x ⊗ M_y over the water and its images: pairs of matrices, none where plates cover all of it.

    It is summed over cells: the difference of the whole surface and the plates would leave rounding under the plates.
    """
    middles = [0.5 * (space.nodes[:-1] + space.nodes[1:]) for space in liquid.spaces]
    water = np.full((len(middles[0]), len(middles[1])), True)
    for plate in plates:
        under = [(middles[axis] > start) & (middles[axis] < end) for axis, (start, end) in enumerate(plate.extents)]
        water &= ~np.outer(*under)
    # Rows of cells along x that have the same water across share one product.
    patterns, kinds = np.unique(water, axis=0, return_inverse=True)
    return [
        (liquid.images * liquid.spaces[0].mass_on(kinds.ravel() == kind), liquid.spaces[1].mass_on(pattern))
        for kind, pattern in enumerate(patterns)
        if pattern.any()
    ]


def water_columns(masses: list[tuple[NDArray[np.float64], NDArray[np.float64]]]) -> NDArray[np.int64]:
    """Return the unknowns that are not zero on the water."""
    return np.flatnonzero(sum(np.outer(*(np.diagonal(mass) for mass in pair)) for pair in masses))


def _water(liquid: BoxLiquid, plates: tuple[RectangleBody, ...]) -> tuple[sparse.csr_matrix, sparse.csr_matrix] | None:
    """S on the unknowns that are not zero on the water: columns of it, and their rows alone."""
    masses = water_masses(liquid, plates)
    if not masses:
        return None
    whole = sparse.csr_matrix((liquid.size, liquid.size))
    for along, across in masses:
        whole = whole + sparse.kron(sparse.csr_matrix(along), sparse.csr_matrix(across), format="csr")
    columns = water_columns(masses)
    coupling = whole[:, columns].tocsr()
    return coupling, coupling[columns].tocsr()


def as_matrix(matrix: sparse.csr_matrix) -> PETSc.Mat:
    """Return a sparse matrix of this process alone."""
    rows = matrix.indptr.astype(PETSc.IntType), matrix.indices.astype(PETSc.IntType), matrix.data
    copied = PETSc.Mat().createAIJ(matrix.shape, csr=rows, comm=PETSc.COMM_SELF)
    copied.assemble()
    return copied
