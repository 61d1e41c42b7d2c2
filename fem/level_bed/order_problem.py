"""The coupled problem of one order: ψ, plates and free surface on a line, exact in depth.

With K₂v = k²M₂v on the line, A⁺ = Σ v vᵀ/(k tanh kH): Ritz's method in products of the line's functions and all
functions of depth, so that frequencies come from above.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from petsc4py import PETSc
from scipy.linalg import solve
from scipy.sparse import csr_matrix

from hydroelastic.fem.level_bed.line import Line
from hydroelastic.fem.liquid_answer import liquid_answer
from hydroelastic.fem.pencil import CoupledPencil, SurfaceBlocks, coupled_pencil
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
        return np.where(np.arange(self.size) < self.line.hats, 0, -1)

    def zero_dofs(self) -> np.ndarray:
        """Unknowns at which ψ = 0 is prescribed."""
        return self.zeros

    @cached_property
    def slopes(self) -> FloatArray:
        """ψ_z/ψ = k tanh kH of each function of `Line.waves`, shape (N,)."""
        wavenumbers = np.sqrt(np.maximum(self.line.waves[0], 0.0))
        slopes: FloatArray = wavenumbers * np.tanh(wavenumbers * self.depth)
        return slopes

    @property
    def holds_constant(self) -> bool:
        """Whether the constant is among the functions: of order 0."""
        return self.line.holds_constant

    @property
    def is_closed(self) -> bool:
        """Whether ∫ζ = 0: of order 0, unless ψ = 0 somewhere."""
        return self.holds_constant and not len(self.zeros)


@dataclass(kw_only=True)
class LineOperator:
    """A⁺ and A of one order.

    Attributes:
        liquid: the unknowns.
        solves: how many loads were answered; all at once.
    """

    liquid: LineLiquid
    solves: int = 0

    def answer(self, loads: FloatArray) -> FloatArray:
        """Return A⁺ of loads as columns, shape (N, loads).

        It is Σ v vᵀ/(k tanh kH) without the constant, or where ψ = 0 on the water the inverse on the other unknowns.
        """
        line, slopes = self.liquid.line, self.liquid.slopes
        if not len(self.liquid.zeros):
            first = int(self.liquid.holds_constant)
            functions = line.waves[1][:, first:]
            potentials: FloatArray = functions @ ((functions.T @ loads) / slopes[first:, None])
            return potentials
        free = np.setdiff1d(np.arange(line.size), self.liquid.zeros)
        moments = (line.sparse_mass @ line.waves[1])[free]
        held = np.zeros_like(loads)
        held[free] = solve((moments * slopes) @ moments.T, loads[free], assume_a="pos")
        return held

    def solve(self, load: PETSc.Vec, potential: PETSc.Vec) -> None:
        """See `LiquidOperator.solve`."""
        potential.array[:] = self.answer(load.array_r[:, None])[:, 0]

    def mult(self, _matrix: PETSc.Mat, potential: PETSc.Vec, load: PETSc.Vec) -> None:
        """``load`` ← A ``potential``."""
        mass, (_, functions) = self.liquid.line.sparse_mass, self.liquid.line.waves
        load.array[:] = mass @ (functions @ (self.liquid.slopes * (functions.T @ (mass @ potential.array_r))))


def order_pencil(
    tank: LevelTank, line: Line, modes: dict[int, LineModes], *, pressure_release: bool
) -> CoupledPencil[LineLiquid]:
    """Assemble the problem of one order, alike on each process."""
    covered = [line.between(*place) for place in line.separation.places]
    water = np.setdiff1d(line.cells, covered_elements(line))
    released = pressure_release or tank.top == "pressure_release"
    zeros = line.unknowns_of(water) if released else np.empty(0, dtype=np.int64)
    liquid = LineLiquid(line=line, depth=tank.depth, zeros=zeros)
    bodies = tuple(_body(tank.plates[index], index, line, shapes) for index, shapes in modes.items())
    waves = tank.top == "free" and not released and len(water) > 0
    loads = [_loads(line, covered[index], shapes).T for index, shapes in modes.items()]
    surfaces = [_water(line, water)] if waves else []
    operator = LineOperator(liquid=liquid)
    laplace = PETSc.Mat().createPython((line.size, line.size), operator, comm=PETSc.COMM_SELF)
    laplace.setUp()
    coupling = np.concatenate([*loads, *(mass for mass, _ in surfaces)], axis=1)
    potentials = operator.answer(coupling)
    pencil = coupled_pencil(
        liquid,
        bodies=bodies,
        surfaces=(LiquidSurface(surface=FREE_SURFACE, gravity=1.0),) if waves else (),
        body_coupling=_matrix(np.concatenate(loads, axis=1)) if loads else None,
        surface_blocks=[SurfaceBlocks(coupling=_matrix(mass), stiffness=_matrix(square)) for mass, square in surfaces],
        laplace=laplace,
        solver=operator,
        closed=(0,) if liquid.is_closed else (),
    )
    answer = liquid_answer(potentials, coupling.T @ potentials, pencil.dense_restoring)
    return replace(pencil, answer=answer)


def covered_elements(line: Line) -> np.ndarray:
    """Return the numbers of the elements under plates."""
    return np.concatenate([np.empty(0, np.int64), *(line.between(*place) for place in line.separation.places)])


def _body(plate: Plate, index: int, line: Line, shapes: LineModes) -> Body:
    factor = line.separation.factor(line.order)
    # A rigid plate has rigid motions only, without bending.
    bending = factor * (plate.flexural_rigidity if plate.is_elastic else 0.0) * shapes.bending
    even: Parity = "symmetric"
    return Body(
        surface=body_name(index + 1),
        shapes=lambda points, _normals: np.asarray(shapes.values(points[0]).T, dtype=np.float64),
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


def _loads(line: Line, elements: np.ndarray, shapes: LineModes) -> FloatArray:
    """∫φᵢq over a plate: exact but for rounding, as it must be for frequencies to come from above."""
    degree = len(shapes.coefficients) + (int(shapes.plate.transverse) if shapes.plate.is_disc else 0)
    degree = 2 * degree if shapes.plate.is_disc else degree
    places, weights = line.quadrature(elements, (degree + line.degree) // 2 + _SPARE_POINTS)
    values = shapes.values(places.ravel()).T.reshape(shapes.count, *places.shape)
    return line.load(elements, values * weights)


def _water(line: Line, elements: np.ndarray) -> tuple[FloatArray, FloatArray]:
    """∫uv over the water for v on it, and for both on it."""
    unknowns = line.unknowns_of(elements)
    mass = line.mass_on(elements)[:, unknowns]
    return mass, mass[unknowns]


def _matrix(values: FloatArray) -> PETSc.Mat:
    sparse = csr_matrix(values)
    rows = sparse.indptr.astype(PETSc.IntType), sparse.indices.astype(PETSc.IntType), sparse.data
    matrix = PETSc.Mat().createAIJ(sparse.shape, csr=rows, comm=PETSc.COMM_SELF)
    matrix.assemble()
    return matrix
