"""Small motions about an equilibrium: the matrices of (λ² M + λ C + K) y = 0 on the free unknowns of a thread.

K is the derivative of the static equations, M the inertia with the added mass across the thread, C = −∂q/∂v with the
part of the liquid's reaction that is linear in the velocity. With the test functions of the curvature multiplied by
−EI, K is symmetric wherever no stream acts.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Any

import numpy as np
import ufl
from dolfinx import fem
from mpi4py import MPI
from numpy.typing import NDArray
from petsc4py import PETSc

from hydroelastic.fem.kernels import assembled, compiled_form
from hydroelastic.fem.thread.equilibrium import Equilibrium, split_state
from hydroelastic.fem.thread.forms import ThreadForms, ThreadState, tangent
from hydroelastic.fem.thread.table import line_table
from hydroelastic.meshes.compat import collapsed

# Of the length: a thread this close to its chord is straight.
_STRAIGHT = 1e-9


@dataclass(frozen=True, kw_only=True)
class ThreadOperators:
    """The matrices, in a unit of time in which the lowest frequencies are of the order of one."""

    equilibrium: Equilibrium  # about which the thread moves
    stiffness: PETSc.Mat  # K
    damping: PETSc.Mat | None  # C; ``None`` where no force is linear in the velocity or damping is neglected
    mass: PETSc.Mat  # M; nothing acts on the axial force and on the curvature
    free: NDArray[np.int32]  # owned unknowns of the mixed space that are not held
    time_unit: float  # s
    symmetric: bool  # whether K is

    @property
    def comm(self) -> MPI.Comm:
        """Communicator of the mesh."""
        return self.equilibrium.space.mesh.comm

    @property
    def size(self) -> int:
        """Number of free unknowns."""
        return int(self.mass.getSize()[0])

    def zeros(self) -> PETSc.Vec:
        """A vector of free unknowns (collective)."""
        return self.mass.createVecRight()

    def function(self, vector: PETSc.Vec) -> Any:
        """The field of the mixed space that has these free unknowns (collective)."""
        function = fem.Function(self.equilibrium.space.mixed)
        function.x.array[self.free] = vector.array_r
        function.x.scatter_forward()
        return function


def thread_operators(equilibrium: Equilibrium, *, velocity_damping: bool = True) -> ThreadOperators:
    """Assemble the matrices (collective)."""
    forms, space = equilibrium.forms, equilibrium.space
    time = _time_unit(equilibrium)
    if forms.stream is not None:
        forms.stream.update(equilibrium.state.position)
    free = free_unknowns(equilibrium)
    first = space.mixed.dofmap.index_map.local_range[0] * space.mixed.dofmap.index_map_bs
    rows = PETSc.IS().createGeneral((free + first).astype(PETSc.IntType), comm=space.mesh.comm)

    def restricted(form: Any, factor: float) -> PETSc.Mat:
        matrix = assembled(compiled_form(form)).createSubMatrix(rows, rows)
        matrix.scale(factor)
        return matrix

    trial, test = ThreadState(*ufl.TrialFunctions(space.mixed)), ThreadState(*ufl.TestFunctions(space.mixed))
    state = equilibrium.state
    residual = forms.static_residual(state, test)
    stiffness = restricted(ufl.derivative(residual, equilibrium.solution), 1.0)
    if forms.model.bends:
        stiffness.diagonalScale(L=_curvature_scale(equilibrium, free, stiffness))
    mass = restricted(forms.inertia(state.position, trial.position, test.position), time**-2)
    damping = damping_form(forms, equilibrium.solution, trial, test) if velocity_damping else None
    return ThreadOperators(
        equilibrium=equilibrium,
        stiffness=stiffness,
        damping=None if damping is None else restricted(damping, 1.0 / time),
        mass=mass,
        free=free,
        time_unit=time * equilibrium.units.time,
        symmetric=_is_symmetric(stiffness),
    )


def damping_form(forms: ThreadForms, solution: Any, trial: ThreadState, test: ThreadState) -> Any:
    """−∂(q·η)/∂v and the part of the liquid's reaction linear in the velocity; ``None`` if no force depends on it.

    Lighthill's momentum ma V_n with V_n = P (v − u) changes by ∂(−ma P u)/∂r · v besides.
    """
    model, space = forms.model, forms.space
    # A stream acts by drag or by reaction; in a liquid at rest quadratic forces have no part linear in the velocity.
    if forms.stream is None and model.viscous_drag == 0.0:
        return None
    position = split_state(solution).position
    # At rest, and a coefficient by which the forces may be differentiated.
    velocity = fem.Function(fem.functionspace(space.mesh, ("Lagrange", space.degree, (model.dimension,))))
    work = forms.load_work(position, velocity, test.position)
    if forms.stream is not None and model.reactive != "none":
        work = work + forms.reactive_work(position, velocity, test.position)
    form = -ufl.derivative(work, velocity, trial.position)
    if forms.stream is None or model.reactive != "lighthill":
        return form
    tau = tangent(position)
    stream = forms.stream.along(position)
    mass = fem.Constant(space.mesh, model.added_mass)
    across = stream - ufl.inner(stream, tau) * tau
    momentum = mass * ufl.inner(across, test.position) * space.dx
    still = [0.0] * (len(solution) - model.dimension)
    direction = ufl.as_vector([*(trial.position[i] for i in range(model.dimension)), *still])
    return form - ufl.derivative(momentum, solution, direction)


def free_unknowns(equilibrium: Equilibrium) -> NDArray[np.int32]:
    """Owned unknowns that neither an end nor an undetermined tension fixes (collective)."""
    fixed = [condition.dof_indices()[0] for condition in equilibrium.fixed]
    owned = np.arange(_owned(equilibrium), dtype=np.int32)
    return np.setdiff1d(owned, np.concatenate([_undetermined_tension(equilibrium), *fixed])).astype(np.int32)


def straight_direction(equilibrium: Equilibrium) -> NDArray[np.float64] | None:
    """Unit vector of a thread that lies on the chord between its ends; ``None`` for any other (collective)."""
    table = line_table(equilibrium.solution, equilibrium.space.nodes, 0)
    ends = table.at(table.nodes[[0, -1]])
    span = float(np.linalg.norm(ends[1] - ends[0]))
    if span == 0.0:
        return None
    chord: NDArray[np.float64] = (ends[1] - ends[0]) / span
    lag = table.values.reshape(-1, len(chord)) - ends[0]
    lag -= np.outer(lag @ chord, chord)
    return chord if np.abs(lag).max() < _STRAIGHT * table.nodes[-1] else None


def _undetermined_tension(equilibrium: Equilibrium) -> NDArray[np.int32]:
    """One unknown of the axial force if a constant may be added to it; empty otherwise (collective).

    The condition that belongs to it, that one element keeps its length, follows from those of all the others.
    """
    model, space = equilibrium.model, equilibrium.space
    none = np.empty(0, dtype=np.int32)
    along = straight_direction(equilibrium)
    if model.axial_rigidity < inf or along is None:
        return none
    crossed = np.abs(along) > _STRAIGHT
    if not all(np.all(np.array(end.held)[crossed]) for end in model.ends):
        return none
    comm = space.mesh.comm
    _, own = collapsed(space.mixed, 1)
    own = own[own < _owned(equilibrium)][:1]
    lowest = comm.allreduce(comm.rank if len(own) else comm.size, op=MPI.MIN)
    return own if comm.rank == lowest else none


def _owned(equilibrium: Equilibrium) -> int:
    dofmap = equilibrium.space.mixed.dofmap
    return int(dofmap.index_map.size_local * dofmap.index_map_bs)


def _curvature_scale(equilibrium: Equilibrium, free: NDArray[np.int32], matrix: PETSc.Mat) -> PETSc.Vec:
    """1, and −EI for the test functions of the curvature."""
    space = equilibrium.space
    scale = fem.Function(space.mixed)
    scale.x.array[:] = 1.0
    _, dofs = collapsed(space.mixed, 2)
    scale.x.array[dofs] = -equilibrium.forms.model.flexural_rigidity
    vector = matrix.createVecLeft()
    vector.array[:] = scale.x.array[free]
    return vector


def _time_unit(equilibrium: Equilibrium) -> float:
    """√(mass/stiffness) in the units of the forms, whose length is one."""
    model, space = equilibrium.forms.model, equilibrium.space
    mass = (model.mass + model.added_mass) * model.length + sum(load.mass + load.added_mass for load in model.bodies)
    if mass == 0.0:
        raise ValueError("mass and added_mass are zero: a thread that vibrates has a mass, or carries one")
    _, dofs = collapsed(space.mixed, 1)
    forces = np.abs(equilibrium.solution.x.array[dofs])
    tension = space.mesh.comm.allreduce(float(forces.max(initial=0.0)), op=MPI.MAX)
    stiffness = tension / model.length + model.flexural_rigidity / model.length**3
    if stiffness == 0.0:
        raise ValueError("the thread has neither tension nor flexural_rigidity: it has no restoring force")
    return float(np.sqrt(mass / stiffness))


def _is_symmetric(matrix: PETSc.Mat) -> bool:
    transpose = PETSc.Mat()
    matrix.transpose(transpose)
    transpose.axpy(-1.0, matrix)
    return bool(transpose.norm() < 1e-11 * matrix.norm())
