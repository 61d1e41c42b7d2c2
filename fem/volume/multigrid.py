"""Laplace's equation in a volume by conjugate gradients with multigrid over the polynomial degree.

    P4 → P2 → P1, with algebraic multigrid of the P1 matrix

Shape-regular cells keep the iterations at about 10 for P2 and 15 for P4, from 1e4 to 1e7 unknowns and on any number of
processes. The matrices of all degrees are assembled; the one on P1 is a fiftieth of that on P4.
"""

from __future__ import annotations

from itertools import count, pairwise

from dolfinx.fem import petsc as fem_petsc
from mpi4py import MPI
from petsc4py import PETSc

from hydroelastic.fem.liquid import ClosedLayer, LiquidSpace, closed_layers, liquid_space
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.volume.matrices import volume_laplace

# Of Chebyshev's method before and after each coarser level; measured on P4: 14 iterations of 3 steps, 18 of 2.
_SMOOTHING_STEPS = 3
_MOST_ITERATIONS = 200
# Ratio of the smallest to the largest eigenvalue that the smoother damps, of the largest one estimated.
_DAMPED = "0,0.1,0,1.1"
# Measured for shape-regular tetrahedra (Laplace, P1): settings of BoomerAMG that need the fewest iterations; of 250,000
# unknowns of P2 with up to 8 coarse nodes for each fine one 8, with up to 4 of them 10.
_AMG = {
    "pc_hypre_type": "boomeramg",
    "pc_hypre_boomeramg_coarsen_type": "HMIS",
    "pc_hypre_boomeramg_interp_type": "ext+i",
    "pc_hypre_boomeramg_P_max": 8,
    # Of two cycles iterations do not grow with the unknowns, and cost no more: of 1e6 unknowns of P2 7 in place of 10.
    "pc_hypre_boomeramg_max_iter": 2,
    "pc_hypre_boomeramg_strong_threshold": 0.5,
    "pc_hypre_boomeramg_relax_type_all": "symmetric-SOR/Jacobi",
    # Gaussian elimination, the default, would meet a singular matrix.
    "pc_hypre_boomeramg_relax_type_coarse": "symmetric-SOR/Jacobi",
}
_prefixes = count()


class MultigridSolver:
    """A⁺ by conjugate gradients; see `LiquidOperator`.

    Attributes:
        solves: loads that were answered.
        iterations: of all of them together.
    """

    def __init__(
        self,
        liquid: LiquidSpace,
        matrix: PETSc.Mat,
        closed: tuple[ClosedLayer, ...],
        images: int,
        *,
        tolerance: float,
    ) -> None:
        """Set up all levels (collective)."""
        self.solves, self.iterations = 0, 0
        self._closed = closed
        self._comm = matrix.comm.tompi4py()
        spaces = [liquid]
        while spaces[0].degree > 1:
            spaces.insert(0, liquid_space(liquid.tank, spaces[0].degree // 2, liquid.zero_potential, liquid.layers))
        self._fixed = liquid.zero_dofs()
        matrices = [volume_laplace(space, images) for space in spaces[:-1]]
        matrices.append(matrix.copy() if liquid.zero_potential else matrix)
        for space, one in zip(spaces, matrices, strict=True):
            self._constrain(space, one)
        self._solver = solver = PETSc.KSP().create(matrix.comm)
        prefix = f"volume_{next(_prefixes)}_"
        solver.setOptionsPrefix(prefix)
        solver.setOperators(matrices[-1])
        solver.setType("cg")
        # (r, z) of the preconditioned residual z measures the energy of the error.
        solver.setNormType(PETSc.KSP.NormType.NATURAL)
        solver.setTolerances(rtol=tolerance, atol=0.0, max_it=_MOST_ITERATIONS)
        options = PETSc.Options()
        coarse = prefix + ("mg_coarse_" if len(spaces) > 1 else "")
        for name, value in _AMG.items():
            options[coarse + name] = value
        options[prefix + "mg_levels_ksp_chebyshev_esteig"] = _DAMPED
        preconditioner = solver.getPC()
        if len(spaces) == 1:
            preconditioner.setType("hypre")
        else:
            preconditioner.setType("mg")
            preconditioner.setMGLevels(len(spaces))
            for level, (lower, upper) in enumerate(pairwise(spaces), 1):
                preconditioner.setMGInterpolation(level, self._interpolation(lower, upper))
                smoother = preconditioner.getMGSmoother(level)
                smoother.setOperators(matrices[level])
                smoother.setType("chebyshev")
                smoother.setTolerances(max_it=_SMOOTHING_STEPS)
                smoother.getPC().setType("jacobi")
            lowest = preconditioner.getMGCoarseSolve()
            lowest.setOperators(matrices[0])
            lowest.setType("preonly")
            lowest.getPC().setType("hypre")
        solver.setFromOptions()
        solver.setUp()
        for name in (*_AMG, "mg_levels_ksp_chebyshev_esteig"):
            options.delValue((coarse if name in _AMG else prefix) + name)
        self._load = matrix.createVecLeft()

    def _constrain(self, space: LiquidSpace, matrix: PETSc.Mat) -> None:
        """Tell the constants of closed layers as null space, and take out the unknowns with ψ = 0."""
        if space.zero_potential:
            rows = (space.zero_dofs() + matrix.getOwnershipRange()[0]).astype(PETSc.IntType)
            matrix.zeroRowsColumns(rows, diag=1.0)
        constants = []
        for layer in closed_layers(space):
            constant = matrix.createVecLeft()
            constant.array[space.owned_layer_of == layer] = 1.0
            constant.normalize()
            constants.append(constant)
        if constants:
            matrix.setNullSpace(PETSc.NullSpace().create(constant=False, vectors=constants, comm=matrix.comm))

    def _interpolation(self, lower: LiquidSpace, upper: LiquidSpace) -> PETSc.Mat:
        matrix = fem_petsc.interpolation_matrix(lower.space, upper.space)
        matrix.assemble()
        if upper.zero_potential:
            kept = []
            for space, vector in zip((upper, lower), reversed(matrix.createVecs()), strict=True):
                vector.set(1.0)
                vector.array[space.zero_dofs()] = 0.0
                kept.append(vector)
            matrix.diagonalScale(*kept)
        return matrix

    def solve(self, load: PETSc.Vec, potential: PETSc.Vec) -> None:
        """See `LiquidOperator.solve`."""
        values = load.array_r.copy()
        for layer in self._closed:
            values[layer.dofs] -= self._sum(values[layer.dofs].sum()) / layer.measure * layer.load
        values[self._fixed] = 0.0
        self._load.array[:] = values
        self._solver.solve(self._load, potential)
        if self._solver.getConvergedReason() <= 0:
            raise EigenSolverError(
                f"Laplace's equation was not solved in {self._solver.getIterationNumber()} iterations of multigrid"
            )
        for layer in self._closed:
            solution = potential.array
            solution[layer.dofs] -= self._sum(float(layer.load @ solution[layer.dofs])) / layer.measure
        self.solves += 1
        self.iterations += self._solver.getIterationNumber()

    def _sum(self, value: float) -> float:
        return float(self._comm.allreduce(value, op=MPI.SUM))
