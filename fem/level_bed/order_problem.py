"""The coupled problem of one order: ψ, plates and free surface on a line, exact in depth.

With K₂v = k²M₂v on the line, A⁺ = Σ v vᵀ/(k tanh kH): Ritz's method in products of the line's functions and all
functions of depth, so that frequencies come from above.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray
from petsc4py import PETSc
from scipy.linalg import cho_factor, cho_solve
from scipy.sparse import csr_matrix

from hydroelastic.fem.level_bed.line import Line
from hydroelastic.fem.pencil import CoupledPencil, SurfaceBlocks, coupled_pencil, loads_on_first
from hydroelastic.fem.surfaces import Body, LiquidSurface
from hydroelastic.meshes.geometry import FREE_SURFACE
from hydroelastic.modal.plate.line_modes import LineModes
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.dofs import Dof, body_name
from hydroelastic.physics.level_tank import LevelTank
from hydroelastic.physics.plate import Plate
from hydroelastic.physics.symmetry import Parity

# Gauss points beyond what a polynomial needs.
_SPARE_POINTS = 2


@dataclass(frozen=True, kw_only=True)
class LineLiquid:
    """The unknowns of ψ on the surface, of one order; see `LiquidUnknowns`.

    Attributes:
        line: the space.
        depth: H.
        zeros: unknowns at which ψ = 0.
    """

    line: Line
    depth: float
    zeros: np.ndarray
    densities: tuple[float, ...] = (1.0,)

    @property
    def size(self) -> int:
        """Number of unknowns N."""
        return self.line.size

    @property
    def owned_layer_of(self) -> np.ndarray:
        """0 for the unknowns at nodes, which carry the constant, and −1 for those inside elements."""
        return np.where(np.arange(self.size) < self.line.node_count, 0, -1)

    def zero_dofs(self) -> np.ndarray:
        """Unknowns at which ψ = 0 is prescribed."""
        return self.zeros

    @cached_property
    def slopes(self) -> FloatArray:
        """ψ_z/ψ = k tanh kH of each function of `Line.eigenpairs`, shape (N,)."""
        wavenumbers = np.sqrt(np.maximum(self.line.eigenpairs[0], 0.0))
        slopes: FloatArray = wavenumbers * np.tanh(wavenumbers * self.depth)
        if self.holds_constant:
            slopes[0] = 0.0
        return slopes

    @property
    def holds_constant(self) -> bool:
        """Whether the constant is among the functions: of order 0."""
        return self.line.order == 0

    @property
    def is_closed(self) -> bool:
        """Whether ∫ζ = 0: of order 0, unless ψ = 0 somewhere."""
        return self.holds_constant and not len(self.zeros)


@dataclass(kw_only=True)
class SpectralOperator:
    """A⁺ = Σ v vᵀ/(k tanh kH) without the constant.

    Attributes:
        functions: v as columns, shape (N, functions).
        inverses: 1/(k tanh kH), shape (functions,).
        solves: how many loads were answered.
    """

    functions: FloatArray
    inverses: FloatArray
    solves: int = 0

    def solve(self, load: PETSc.Vec, potential: PETSc.Vec) -> None:
        """See `LiquidOperator.solve`."""
        potential.array[:] = self.functions @ (self.inverses * (self.functions.T @ load.array_r))
        self.solves += 1


@dataclass(kw_only=True)
class HeldOperator:
    """A⁺ where ψ = 0 on the water: the inverse of A on the other unknowns.

    Attributes:
        matrix: A on all unknowns, shape (N, N).
        free: the other unknowns.
        solves: how many loads were answered.
    """

    matrix: FloatArray
    free: np.ndarray
    solves: int = 0
    _factor: tuple[FloatArray, bool] = field(init=False)

    def __post_init__(self) -> None:
        """Factorize."""
        self._factor = cho_factor(self.matrix[np.ix_(self.free, self.free)])

    def solve(self, load: PETSc.Vec, potential: PETSc.Vec) -> None:
        """See `LiquidOperator.solve`."""
        potential.set(0.0)
        potential.array[self.free] = cho_solve(self._factor, load.array_r[self.free])
        self.solves += 1


def order_pencil(
    tank: LevelTank, line: Line, modes: dict[int, LineModes], *, pressure_release: bool
) -> CoupledPencil[LineLiquid]:
    """Assemble the problem of one order, alike on each process.

    Args:
        tank: the dimensionless tank.
        line: the space of ψ, of that order.
        modes: shapes of the plates that move in it, by their index.
        pressure_release: whether ψ = 0 on the water, whatever the tank's top.
    """
    covered = [line.within(*place) for place in line.separation.places]
    water = np.setdiff1d(np.arange(len(line.nodes) - 1), covered_elements(line))
    released = pressure_release or tank.top == "pressure_release"
    zeros = line.unknowns_of(water) if released else np.empty(0, dtype=np.int64)
    liquid = LineLiquid(line=line, depth=tank.depth, zeros=zeros)
    bodies = tuple(_body(tank.plates[index], index, line, shapes) for index, shapes in modes.items())
    _, functions = line.eigenpairs
    moments = line.mass(np.arange(len(line.nodes) - 1)) @ functions
    matrix = (moments * liquid.slopes) @ moments.T
    laplace = _matrix(0.5 * (matrix + matrix.T))
    operator: HeldOperator | SpectralOperator
    if len(zeros):
        operator = HeldOperator(matrix=matrix, free=np.setdiff1d(np.arange(line.size), zeros))
    else:
        first = int(liquid.holds_constant)
        operator = SpectralOperator(functions=functions[:, first:], inverses=1.0 / liquid.slopes[first:])
    waves = tank.top == "free" and not released and len(water) > 0
    loads = [load for index, shapes in modes.items() for load in _loads(line, covered[index], shapes)]
    return coupled_pencil(
        liquid,
        bodies=bodies,
        surfaces=(LiquidSurface(surface=FREE_SURFACE, gravity=1.0),) if waves else (),
        body_coupling=loads_on_first(loads, len(loads), laplace) if loads else None,
        surface_blocks=[_water(line, water)] if waves else [],
        laplace=laplace,
        solver=operator,
        closed=(0,) if liquid.is_closed else (),
    )


def covered_elements(line: Line) -> np.ndarray:
    """Return the numbers of the elements under plates."""
    return np.concatenate([np.empty(0, np.int64), *(line.within(*place) for place in line.separation.places)])


def _body(plate: Plate, index: int, line: Line, shapes: LineModes) -> Body:
    factor = line.separation.factor(line.order)
    # A rigid plate has rigid motions only, without bending.
    bending = factor * (plate.flexural_rigidity if plate.is_elastic else 0.0) * shapes.bending
    even: Parity = "symmetric"
    return Body(
        surface=body_name(index + 1),
        shapes=partial(_shape_at, shapes),
        wavenumber=float(shapes.eigenvalues[-1] ** 0.25),
        dofs=_dofs(shapes),
        parities=(even,) * shapes.count,
        stiffness=bending + factor * float(plate.hydrostatic) * shapes.squares,
        bending_stiffness=bending,
        mass=np.diag(factor * plate.mass_per_area * shapes.squares),
        motions=np.eye(shapes.count),
    )


def _dofs(shapes: LineModes) -> tuple[Dof, ...]:
    """Heave and pitch in the plane of x or of cos nθ, then elastic ones; a hinged edge leaves pitch alone."""
    plate = shapes.plate
    held = any(derivative == 0 for _, derivative in plate.conditions)
    motions = ("heave", "pitch") if plate.transverse_is_zero and not held else ("pitch",)
    elastic = (Dof.elastic(number + 1) for number in range(shapes.count - shapes.rigid))
    return (*map(Dof, motions[: shapes.rigid]), *elastic)


def _shape_at(
    shapes: LineModes, points: NDArray[np.float64], _normals: NDArray[np.float64], number: int
) -> NDArray[np.float64]:
    return np.asarray(shapes.values(points[0])[:, number], dtype=np.float64)


def _loads(line: Line, elements: np.ndarray, shapes: LineModes) -> FloatArray:
    """∫φᵢq over a plate: exact but for rounding, as it must be for frequencies to come from above."""
    degree = len(shapes.coefficients) + (int(shapes.plate.transverse) if shapes.plate.is_disc else 0)
    degree = 2 * degree if shapes.plate.is_disc else degree
    places, weights, _ = line.quadrature(elements, (degree + line.degree) // 2 + _SPARE_POINTS)
    values = shapes.values(places.ravel()).T.reshape(shapes.count, *places.shape)
    return line.load(elements, places, values * weights)


def _water(line: Line, elements: np.ndarray) -> SurfaceBlocks:
    unknowns = line.unknowns_of(elements)
    mass = line.mass(elements)[:, unknowns]
    return SurfaceBlocks(coupling=_matrix(mass), stiffness=_matrix(mass[unknowns]))


def _matrix(values: FloatArray) -> PETSc.Mat:
    """A sparse matrix of this process alone."""
    sparse = csr_matrix(values)
    rows = sparse.indptr.astype(PETSc.IntType), sparse.indices.astype(PETSc.IntType), sparse.data
    matrix = PETSc.Mat().createAIJ(sparse.shape, csr=rows, comm=PETSc.COMM_SELF)
    matrix.assemble()
    return matrix
