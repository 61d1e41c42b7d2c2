"""The thread at rest in a steady stream on one mesh, from a start that is near it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from math import inf
from typing import Any

import numpy as np
import ufl
from dolfinx import fem
from mpi4py import MPI
from numpy.typing import NDArray

from hydroelastic.fem.thread.forms import ThreadForms, ThreadState
from hydroelastic.fem.thread.newton import NewtonSolver
from hydroelastic.fem.thread.space import ThreadSpace
from hydroelastic.fem.thread.units import Units
from hydroelastic.meshes.compat import collapsed
from hydroelastic.physics.thread import Thread

Along = Callable[[NDArray[np.float64]], NDArray[np.float64]]

# Stretch whose force is the scale where no other force acts on a thread.
_STRETCH = 1e-6


@dataclass(frozen=True, kw_only=True)
class Start:
    """Where Newton's method begins."""

    position: Along  # r in m at s of shape (n,), shape (n, dimension)
    force: Along  # axial force in N at s, shape (n,)
    curvature: Along | None = None  # r_ss in 1/m at s, shape (n, dimension); zero without it


@dataclass(frozen=True, kw_only=True)
class Equilibrium:
    """A thread at rest."""

    model: Thread  # the thread, SI
    units: Units  # of the solution
    space: ThreadSpace  # mesh of 0 ≤ s ≤ 1 and function spaces
    forms: ThreadForms  # of the thread in `units`; the stream is that at the solution
    solution: Any  # (r, S) or (r, S, κ) in `units`, a function in `space.mixed`
    fixed: list[Any]  # prescribed unknowns, as boundary conditions
    newton_steps: int  # their number
    # derivative of the solution by a uniform stretch of the thread, a function in `space.mixed`; none where the
    # solution was given
    stretch_response: Any = None
    # residual of the equations at the owned unknowns; none where the solution was given
    residual: NDArray[np.float64] = field(default_factory=lambda: np.zeros(0))

    @property
    def state(self) -> ThreadState:
        """The parts of the solution as expressions of UFL."""
        return split_state(self.solution)


def split_state(function: Any) -> ThreadState:
    """The parts of a function, or of test functions, of the mixed space."""
    return ThreadState(*ufl.split(function))


def solve_on_mesh(
    comm: MPI.Comm, model: Thread, nodes: NDArray[np.float64], start: Start, *, degree: int = 3
) -> Equilibrium:
    """Solve the equations of the thread at rest on one mesh."""
    _check_nodes(model, nodes)
    units = natural_units(model, start, nodes)
    scaled = units.scaled(model)
    places = np.asarray(nodes / model.length, dtype=np.float64)
    space = ThreadSpace(comm, places, degree, model.dimension, model.bends)
    forms = ThreadForms(scaled, space)
    solution = fem.Function(space.mixed)
    interpolate_start(solution, _between_ends(model, start), units)
    fixed = fixed_components(scaled, space)
    for condition in fixed:
        condition.set(solution.x.array)
    state = split_state(solution)
    residual = forms.static_residual(state, ThreadState(*ufl.TestFunctions(space.mixed)))

    def update() -> None:
        if forms.stream is not None:
            forms.stream.update(state.position)

    solver = NewtonSolver(residual, solution, fixed, update, ufl.TestFunctions(space.mixed)[1] * space.dx)
    steps = solver.solve()
    return Equilibrium(
        model=model,
        units=units,
        space=space,
        forms=forms,
        solution=solution,
        fixed=fixed,
        newton_steps=steps,
        stretch_response=solver.response,
        residual=solver.values,
    )


def natural_units(model: Thread, start: Start, nodes: NDArray[np.float64]) -> Units:
    """The thread's length, its characteristic tension, and the time in which the stream passes it."""
    speed = 0.0
    if model.stream is not None:
        speed = float(np.max(np.linalg.norm(model.stream.velocity_at(in_space(start.position(nodes))), axis=1)))
    force = max(force_scale(model, speed), float(np.max(np.abs(start.force(nodes))))) or 1.0
    if speed > 0.0:
        return Units(length=model.length, force=force, time=model.length / speed)
    inertia = model.mass + model.added_mass
    time = model.length * float(np.sqrt(inertia / force)) if inertia > 0.0 else 1.0
    return Units(length=model.length, force=force, time=time)


def in_space(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points or vectors of shape (n, 2) or (n, 3) with three components, y = 0."""
    if points.shape[1] == 3:
        return points
    return np.insert(points, 1, 0.0, axis=1)


def interpolate_start(solution: Any, start: Start, units: Units) -> None:
    """Give a function of the mixed space the values of a start."""
    parts: list[tuple[Along, float]] = [(start.position, units.length), (start.force, units.force)]
    if start.curvature is not None:
        parts.append((start.curvature, 1.0 / units.length))
    for index, (along, unit) in enumerate(parts[: solution.function_space.num_sub_spaces]):
        interpolate_part(solution, index, along, length=units.length, unit=unit)


def interpolate_part(function: Any, part: int, along: Along, *, length: float, unit: float) -> None:
    """Interpolate values along a thread into one part of a function of the mixed space."""
    space, places = collapsed(function.function_space, part)
    own = fem.Function(space)
    own.interpolate(lambda x: np.atleast_2d(along(x[0] * length).T) / unit)
    function.x.array[places] = own.x.array


def _between_ends(model: Thread, start: Start) -> Start:
    """The start moved linearly so that its ends are where they are held; moving the end nodes alone would fold
    elements."""
    places = start.position(np.array([0.0, model.length]))
    held = np.array([np.where(end.held, end.position, place) for end, place in zip(model.ends, places, strict=True)])
    moves = held - places

    def position(s: NDArray[np.float64]) -> NDArray[np.float64]:
        part = (s / model.length)[:, None]
        return start.position(s) + (1.0 - part) * moves[0] + part * moves[1]

    return Start(position=position, force=start.force, curvature=start.curvature)


def fixed_components(model: Thread, space: ThreadSpace) -> list[Any]:
    """Boundary conditions: held components of the ends, and no curvature where an end that bends is not clamped."""
    conditions = []
    space.mesh.topology.create_connectivity(0, 1)
    for tag, end in enumerate(model.ends, start=1):
        facets = space.end_tags.find(tag)
        # Unknown, component and value.
        given = [(0, axis, float(end.position[axis])) for axis in range(model.dimension) if end.held[axis]]
        if model.bends and end.clamp is None:
            given += [(2, axis, 0.0) for axis in range(model.dimension)]
        for part, axis, value in given:
            component = space.mixed.sub(part).sub(axis)
            places = fem.locate_dofs_topological(component, 0, facets)
            conditions.append(fem.dirichletbc(np.float64(value), places, component))
    return conditions


def _check_nodes(model: Thread, nodes: NDArray[np.float64]) -> None:
    length = model.length
    if len(nodes) < 2 or nodes[0] != 0.0 or abs(nodes[-1] - length) > 1e-12 * length or np.any(np.diff(nodes) <= 0.0):
        raise ValueError(f"nodes: {len(nodes)} values; they must increase from 0 to the length {length}")
    for s in model.loads:
        if np.min(np.abs(nodes - s)) > 1e-12 * length:
            raise ValueError(f"nodes: the load at s = {s} must be at one of them")


def force_scale(model: Thread, speed: float) -> float:
    """The largest force that acts on a thread: |F| + k u² of a body, |w| L, (kn u + nv) u L, EI/L², ma u² if
    reactive."""
    reactive = 0.0 if model.reactive == "none" else model.added_mass * speed**2
    largest = max(
        *(float(sum(part**2 for part in body.dead_force) ** 0.5) + body.drag * speed**2 for body in model.bodies),
        abs(model.weight) * model.length,
        (model.normal_drag * speed + model.viscous_drag) * speed * model.length,
        model.flexural_rigidity / model.length**2,
        reactive,
    )
    if largest > 0.0 or model.axial_rigidity == inf:
        return largest
    return _STRETCH * model.axial_rigidity
