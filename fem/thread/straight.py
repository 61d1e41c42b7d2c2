"""Straight equilibria with a given tension T(s) between two held ends, where statics alone does not determine it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import ufl
from dolfinx import fem
from dolfinx.fem import petsc as fem_petsc
from mpi4py import MPI
from numpy.typing import NDArray
from petsc4py import PETSc
from scipy.integrate import quad

from hydroelastic.fem.kernels import compiled_form
from hydroelastic.fem.thread.equilibrium import Equilibrium, Start, fixed_components, solve_on_mesh
from hydroelastic.fem.thread.forms import ThreadForms, ThreadState
from hydroelastic.fem.thread.frame import Frame
from hydroelastic.fem.thread.operators import free_unknowns
from hydroelastic.fem.thread.profile import thread_profile
from hydroelastic.fem.thread.refinement import ROUNDING, NoEquilibriumError, ThreadErrors, ThreadSolution
from hydroelastic.fem.thread.space import ThreadSpace
from hydroelastic.fem.thread.units import Units
from hydroelastic.modal.thread.library_warnings import suppressed_library_warnings
from hydroelastic.physics.thread import Thread

# Residual of the equations relative to the largest force; above the interpolation error of a smooth tension.
_BALANCE = 1e-8
# Elements of a straight thread whose tension is given: enough for its first modes.
_ELEMENTS, _DEGREE = 32, 5


def straight_equilibrium(
    comm: MPI.Comm,
    model: Thread,
    nodes: NDArray[np.float64],
    tension: float | Callable[[NDArray[np.float64]], NDArray[np.float64]],
    *,
    degree: int = 3,
) -> Equilibrium:
    """A thread along the chord between the positions of its ends, r = r_A + s (r_B − r_A)/L."""
    if np.isfinite(model.axial_rigidity):
        raise ValueError(
            f"axial_rigidity is {model.axial_rigidity:g}: the stretch of the thread tells the tension, which can be "
            "given only where the rigidity is infinite"
        )
    first, last = (end.position for end in model.ends)
    span = float(np.linalg.norm(last - first))
    if not np.isclose(span, model.length, rtol=1e-10, atol=0.0):
        raise ValueError(f"the ends are {span:.12g} apart: a straight thread needs its length {model.length:.12g}")

    def given(s: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(tension(s) if callable(tension) else np.full(s.shape, tension), dtype=np.float64)

    places = np.divide(nodes, model.length, dtype=np.float64)
    units = _units(model, float(np.abs(given(model.length * np.linspace(0.0, 1.0, 65))).max()))
    scaled = units.scaled(model)
    space = ThreadSpace(comm, places, degree, model.dimension, model.bends)
    solution = fem.Function(space.mixed)
    begin, end = (end.position for end in scaled.ends)
    solution.sub(0).interpolate(lambda x: begin[:, None] + np.outer(end - begin, x[0]))
    solution.sub(1).interpolate(lambda x: given(model.length * x[0]) / units.force)
    solution.x.scatter_forward()
    equilibrium = Equilibrium(
        model=model,
        units=units,
        space=space,
        forms=ThreadForms(scaled, space),
        solution=solution,
        fixed=fixed_components(scaled, space),
        newton_steps=0,
    )
    _check_balance(equilibrium)
    return equilibrium


def equilibrium_on(
    comm: MPI.Comm, thread: Thread, frame: Frame, nodes: NDArray[np.float64], start: Start | None, degree: int
) -> Equilibrium:
    """The equilibrium of a thread on one mesh, near a known one, or straight if its tension is given."""
    model = frame.thread_in_frame(thread)
    if thread.tension is None:
        assert start is not None
        return solve_on_mesh(comm, model, nodes, start, degree=degree)
    try:
        return straight_equilibrium(comm, model, nodes, tension_along(thread), degree=degree)
    except ValueError as error:
        raise NoEquilibriumError(str(error)) from error


def tension_along(thread: Thread) -> Callable[[NDArray[np.float64]], NDArray[np.float64]]:
    """T(s) in N of a straight thread in space: that given at end B, and weight and friction between there and s."""
    begin, length, tension = thread.ends[0].position, thread.length, thread.tension
    way, load = (thread.ends[1].position - begin) / length, thread.distributed_load

    def along(s: float) -> float:
        return float(load.load((begin + s * way)[None], way[None])[0] @ way)

    def at(s: NDArray[np.float64]) -> NDArray[np.float64]:
        with suppressed_library_warnings():
            return np.array([tension + quad(along, place, length)[0] for place in np.ravel(s)]).reshape(np.shape(s))

    return at


def solve_with_given_tension(comm: MPI.Comm, thread: Thread, frame: Frame) -> ThreadSolution:
    """The straight equilibrium of a thread whose tension is given."""
    nodes: NDArray[np.float64] = np.linspace(0.0, thread.length, _ELEMENTS + 1, dtype=np.float64)
    found = equilibrium_on(comm, thread, frame, nodes, None, _DEGREE)
    force, moment = ROUNDING * found.units.force, ROUNDING * thread.flexural_rigidity / thread.length
    return ThreadSolution(
        equilibrium=found,
        profile=thread_profile(found),
        errors=ThreadErrors(
            position=ROUNDING * thread.length, tension=force, reaction=force, moment=moment, relative=ROUNDING
        ),
        elements=(_ELEMENTS,),
        newton_steps=(0,),
        ramps=(),
    )


def _units(model: Thread, tension: float) -> Units:
    force = max(tension, model.flexural_rigidity / model.length**2)
    if force == 0.0:
        raise ValueError("tension is zero and so is flexural_rigidity: nothing keeps the thread straight")
    mass = (model.mass + model.added_mass) * model.length
    return Units(length=model.length, force=force, time=float(np.sqrt(mass * model.length / force)) or 1.0)


def _check_balance(equilibrium: Equilibrium) -> None:
    forms, space = equilibrium.forms, equilibrium.space
    state, test = equilibrium.state, ThreadState(*ufl.TestFunctions(space.mixed))
    if forms.stream is not None:
        forms.stream.update(state.position)
    residual = compiled_form(forms.static_residual(state, test))
    vector = fem_petsc.assemble_vector(residual)
    vector.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
    largest = float(np.abs(vector.array_r[free_unknowns(equilibrium)]).max(initial=0.0))
    largest = space.mesh.comm.allreduce(largest, op=MPI.MAX)
    if largest > _BALANCE:
        raise ValueError(
            f"tension: so the straight thread is not at rest, a force of {largest * equilibrium.units.force:.3g} N "
            "is not balanced; weight and drag across the thread bend it, along it they change T(s)"
        )
