"""Straight equilibria with a given tension, where statics alone does not tell it: T(s) between two held ends."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import ufl
from dolfinx import fem
from dolfinx.fem import petsc as fem_petsc
from mpi4py import MPI
from numpy.typing import NDArray
from petsc4py import PETSc

from hydroelastic.fem.kernels import compiled_form
from hydroelastic.fem.thread.equilibrium import Equilibrium, fixed_components
from hydroelastic.fem.thread.forms import ThreadForms, ThreadState
from hydroelastic.fem.thread.operators import free_unknowns
from hydroelastic.fem.thread.space import ThreadSpace
from hydroelastic.fem.thread.units import Units
from hydroelastic.physics.thread import Thread

# Residual of the equations beside the largest force: what interpolation of a smooth tension leaves is below it.
_BALANCE = 1e-8


def straight_equilibrium(
    comm: MPI.Comm,
    model: Thread,
    nodes: NDArray[np.float64],
    tension: float | Callable[[NDArray[np.float64]], NDArray[np.float64]],
    *,
    degree: int = 3,
) -> Equilibrium:
    """A thread along the chord between the positions of its ends, r = r_A + s (r_B − r_A)/L.

    Args:
        comm: communicator.
        model: a thread that does not stretch; the positions of both ends count, held or not, and are its length apart.
        nodes: s of the nodes in m from 0 to the length, increasing.
        tension: T, N: a constant, or T(s) with s in m where weight or friction changes it along the thread.
        degree: of the polynomials.

    Returns:
        The equilibrium, its equations checked (collective).

    Raises:
        ValueError: if the thread stretches, its ends are not its length apart, or it is not at rest so.
    """
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
