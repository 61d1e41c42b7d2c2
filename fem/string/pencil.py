"""Matrices of the hanging string on polynomials of one degree, its upper end fixed.

    M = ∫m u v + M_tip u v|₀,    C = ∫2λ u v,    K = ∫T u_x v_x

K is positive definite also where T vanishes at the free end, for u = 0 at the upper one, whose unknown is left out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import ufl
from dolfinx import fem
from mpi4py import MPI
from numpy.typing import NDArray
from petsc4py import PETSc

from hydroelastic.fem.kernels import assembled, compiled_form
from hydroelastic.meshes.line import graded_nodes, line_mesh, travel_nodes
from hydroelastic.physics.string import HangingString


@dataclass(frozen=True, kw_only=True)
class StringPencil:
    """Dimensionless matrices of a string on its free unknowns."""

    string: HangingString  # the string, in SI units; the matrices are those of the dimensionless one
    space: fem.FunctionSpace  # polynomials on the line, the unknown of the upper end included
    degree: int  # polynomial degree
    free: NDArray[np.int32]  # local indices of the owned unknowns without the upper end, shape (free unknowns,)
    mass: PETSc.Mat  # M
    resistance: PETSc.Mat  # C
    stiffness: PETSc.Mat  # K
    # own entries of M·1, the inertia of the string that follows its upper end, shape (free unknowns,)
    mass_load: NDArray[np.float64]
    resistance_load: NDArray[np.float64]  # own entries of C·1, shape (free unknowns,)

    @property
    def comm(self) -> MPI.Comm:
        """Communicator of the mesh."""
        return self.space.mesh.comm

    @property
    def size(self) -> int:
        """Number of free unknowns."""
        return int(self.mass.getSize()[0])

    @property
    def cell_count(self) -> int:
        """Number of elements over all processes."""
        return int(self.space.mesh.topology.index_map(1).size_global)

    def zeros(self) -> PETSc.Vec:
        """A vector of free unknowns (collective)."""
        return self.mass.createVecRight()


def string_nodes(string: HangingString, elements: int) -> NDArray[np.float64]:
    """Return nodes with equal travel times, graded towards an end next to a zero of the tension outside the string."""
    tension = string.dimensionless().tension
    return graded_nodes(travel_nodes(elements, *tension), *tension)


def build_string_pencil(comm: MPI.Comm, string: HangingString, degree: int, nodes: NDArray[np.float64]) -> StringPencil:
    """Assemble the matrices (collective)."""
    space = fem.functionspace(line_mesh(comm, nodes), ("Lagrange", degree))
    owned = space.dofmap.index_map.size_local
    places = space.tabulate_dof_coordinates()[:owned, 0]
    lowest, highest = np.flatnonzero(places == nodes[0]), np.flatnonzero(places == nodes[-1])
    kernel, scaled = _Kernel(space, degree), string.dimensionless()
    mass = kernel.matrix(mass=(scaled.inertia, 0.0))
    first = mass.getOwnershipRange()[0]
    for tip in lowest:
        mass.setValue(tip + first, tip + first, scaled.tip_mass, addv=PETSc.InsertMode.ADD_VALUES)
    mass.assemble()
    bottom, top = scaled.resistance
    resistance = kernel.matrix(mass=(2.0 * bottom, 2.0 * (top - bottom)))
    free = np.setdiff1d(np.arange(owned, dtype=np.int32), highest).astype(np.int32)
    rows = PETSc.IS().createGeneral((free + first).astype(PETSc.IntType), comm=mass.comm)

    def restricted(matrix: PETSc.Mat) -> PETSc.Mat:
        block = matrix.createSubMatrix(rows, rows)
        block.setOption(PETSc.Mat.Option.SYMMETRIC, True)
        return block

    return StringPencil(
        string=string,
        space=space,
        degree=degree,
        free=free,
        mass=restricted(mass),
        resistance=restricted(resistance),
        stiffness=restricted(kernel.matrix(stiffness=scaled.tension)),
        mass_load=_row_sums(mass)[free],
        resistance_load=_row_sums(resistance)[free],
    )


class _Kernel:
    """∫(a + bx) u v + ∫(c + dx) u_x v_x, compiled once for a degree and whatever coefficients."""

    def __init__(self, space: fem.FunctionSpace, degree: int) -> None:
        mesh = space.mesh
        self._mass, self._stiffness = (fem.Constant(mesh, np.zeros(2)) for _ in range(2))
        u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
        x = ufl.SpatialCoordinate(mesh)[0]
        dx = ufl.Measure("dx", domain=mesh, metadata={"quadrature_degree": 2 * degree + 1})
        energy = (self._stiffness[0] + self._stiffness[1] * x) * u.dx(0) * v.dx(0)
        self._form = compiled_form(((self._mass[0] + self._mass[1] * x) * u * v + energy) * dx)

    def matrix(self, mass: tuple[float, float] = (0.0, 0.0), stiffness: tuple[float, float] = (0.0, 0.0)) -> PETSc.Mat:
        self._mass.value[:], self._stiffness.value[:] = mass, stiffness
        return assembled(self._form)


def _row_sums(matrix: PETSc.Mat) -> NDArray[np.float64]:
    ones, sums = matrix.createVecs()
    ones.set(1.0)
    matrix.mult(ones, sums)
    return np.array(sums.array_r)
