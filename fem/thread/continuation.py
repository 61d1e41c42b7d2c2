"""Continuation in the angle of clamps, drag or stiffness to a thread at rest, where Newton's method fails at once.

For a thread with bending stiffness the discrete equations have spurious solutions whose direction turns by two right
angles at a node. There κ lies along the thread and grows without bound on finer meshes. Newton's method finds them
where a start is far from the direction of a clamp.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf

import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray

from hydroelastic.fem.thread.equilibrium import Equilibrium, Start, natural_units, solve_on_mesh
from hydroelastic.fem.thread.initial_mesh import initial_nodes
from hydroelastic.fem.thread.newton import ThreadSolverError
from hydroelastic.fem.thread.profile import start_from, thread_profile
from hydroelastic.fem.thread.table import line_table
from hydroelastic.physics.thread import PointLoad, Thread

# Where a continuation starts; its smallest and its first step.
_FIRST = 1e-3
_SMALLEST_STEP = 1e-2
_STEP = 0.25
_GROWTH = 1.5
# An extensible thread may fold within an element, where |r_s| passes through zero.
_CRUSHED = 0.5
_INNER = (np.arange(12) + 0.5) / 12.0
_MOST_STEPS = 60
# Of the length: distance over which the direction of a start is evaluated.
_NEAR = 1e-4
# Directions whose cosine is below this are opposite: the plane of the rotation between them is undetermined.
_OPPOSITE = -1.0 + 1e-4

# Number of places at which a start is evaluated.
_LOOKS = 33
# Sequence of flexural rigidities, in units of force times length².
_FADING = (1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5)


class FoldError(ThreadSolverError):
    """The direction of the thread jumps at a node."""


@dataclass(frozen=True)
class RampedEquilibrium:
    """An equilibrium and the continuation to it."""

    equilibrium: Equilibrium  # of the thread itself
    ramp: str  # name of the continuation, empty if none was needed
    steps: int  # number of intermediate equilibria, failed ones included


def solve_with_ramps(
    comm: MPI.Comm, model: Thread, nodes: NDArray[np.float64], start: Start, *, degree: int
) -> RampedEquilibrium:
    """Solve on one mesh: directly, else by continuation in clamps, drag, stiffness or rigidity."""
    reasons = []
    try:
        return RampedEquilibrium(_solve_unfolded(comm, model, nodes, start, degree), "", 0)
    except ThreadSolverError as error:
        reasons.append(f"at once: {error}")
    ramps: dict[str, Callable[[float], Thread]] = {}
    if any(end.clamp is not None for end in model.ends):
        ramps["turning clamps"] = lambda part: with_turned_clamps(model, part, start)
    if model.drags and model.stream is not None:
        ramps["growing drag"] = lambda part: with_drag(model, part)
    if model.bends:
        ramps["growing rigidity"] = lambda part: replace(model, flexural_rigidity=part * model.flexural_rigidity)
    else:
        force = natural_units(model, start, nodes).force
        ramps["growing stiffness"] = lambda part: with_stiffness(model, part, force)
    for name, at in ramps.items():
        try:
            return _ramped(comm, at, nodes, start, degree, name)
        except ThreadSolverError as error:
            reasons.append(f"with {name}: {error}")
    raise ThreadSolverError("; ".join(reasons))


def start_with_decreasing_rigidity(comm: MPI.Comm, model: Thread, start: Start, *, degree: int) -> Start:
    """The shape of a slack thread by continuation to decreasing flexural rigidity."""
    force = natural_units(model, start, np.arange(_LOOKS) * model.length / (_LOOKS - 1)).force
    for part in _FADING:
        bent = replace(model, flexural_rigidity=part * force * model.length**2)
        found = _solve_unfolded(comm, bent, initial_nodes(bent, start), start, degree)
        profile = thread_profile(found)
        start = start_from(profile)
    return Start(position=profile.position, force=profile.tension_at)


def with_drag(model: Thread, part: float) -> Thread:
    """The thread with a part of all its drags."""

    def load(of: PointLoad) -> PointLoad:
        return replace(of, drag=part * of.drag)

    first, second = model.ends
    return replace(
        model,
        normal_drag=part * model.normal_drag,
        tangential_drag=part * model.tangential_drag,
        viscous_drag=part * model.viscous_drag,
        ends=(replace(first, load=load(first.load)), replace(second, load=load(second.load))),
        loads={s: load(of) for s, of in model.loads.items()},
    )


def with_stiffness(model: Thread, part: float, force: float) -> Thread:
    """The thread with more stretch: 1/EA is that of the thread and (1 − part)/force."""
    compliance = 1.0 / model.axial_rigidity + (1.0 - part) / force
    return replace(model, axial_rigidity=1.0 / compliance if compliance > 0.0 else inf)


def with_turned_clamps(model: Thread, part: float, start: Start) -> Thread:
    """The thread with clamps rotated by a part of the angle from the direction of a start to their own."""
    steps = np.array([0.0, _NEAR, 1.0 - _NEAR, 1.0]) * model.length
    places = start.position(steps)
    chord = places[-1] - places[0]
    ends = []
    for end, way in zip(model.ends, (places[1] - places[0], places[3] - places[2]), strict=True):
        clamp = end.clamp
        ends.append(
            end if clamp is None else replace(end, clamp=_turned(way / np.linalg.norm(way), clamp, chord, part))
        )
    return replace(model, ends=(ends[0], ends[1]))


def _turned(
    first: NDArray[np.float64], last: NDArray[np.float64], chord: NDArray[np.float64], part: float
) -> NDArray[np.float64]:
    """A direction between two; by way of the chord, or any other, where they are opposite."""
    cosine = float(first @ last)
    towards = last - cosine * first
    if cosine < _OPPOSITE:
        # The axis that is farthest from both, unless the chord is away from them.
        other = np.eye(len(first))[int(np.argmin(np.abs(first)))]
        towards = next(
            way
            for way in (chord - (chord @ first) * first, other - (other @ first) * first)
            if np.linalg.norm(way) > _NEAR * np.linalg.norm(chord)
        )
    size = float(np.linalg.norm(towards))
    if size == 0.0 or part == 1.0:
        return last
    angle = part * float(np.arctan2(size, cosine) if cosine >= _OPPOSITE else np.pi)
    turned: NDArray[np.float64] = np.cos(angle) * first + np.sin(angle) * towards / size
    return turned


def _solve_unfolded(
    comm: MPI.Comm, model: Thread, nodes: NDArray[np.float64], start: Start, degree: int
) -> Equilibrium:
    equilibrium = solve_on_mesh(comm, model, nodes, start, degree=degree)
    if model.bends:
        _refuse_fold(equilibrium)
    return equilibrium


def _refuse_fold(equilibrium: Equilibrium) -> None:
    nodes, model = equilibrium.space.nodes, equilibrium.model
    position = line_table(equilibrium.solution, nodes, 0)
    inner = (nodes[:-1, None] + np.diff(nodes)[:, None] * _INNER).ravel()
    lengths = np.linalg.norm(position.at(inner, 1), axis=1)
    if np.min(lengths) < _CRUSHED:
        s = float(inner[np.argmin(lengths)]) * model.length
        raise FoldError(f"the thread is folded at s = {s:.6g} m: it is crushed to {np.min(lengths):.2g} of its length")
    tangents = position.at_ends(derivative=1)
    pairs = [
        (s, before, after) for s, before, after in zip(nodes[1:-1], tangents[:-1, 1], tangents[1:, 0], strict=True)
    ]
    outer = zip(nodes[[0, -1]], (tangents[0, 0], tangents[-1, 1]), model.ends, strict=True)
    pairs += [(s, tangent, end.clamp) for s, tangent, end in outer if end.clamp is not None]
    for s, before, after in pairs:
        if before @ after < 0.0:
            raise FoldError(f"the thread is folded at s = {s * model.length:.6g} m: its direction jumps there")


def _ramped(
    comm: MPI.Comm,
    at: Callable[[float], Thread],
    nodes: NDArray[np.float64],
    start: Start,
    degree: int,
    name: str,
) -> RampedEquilibrium:
    done, step = _FIRST, _STEP
    equilibrium = _solve_unfolded(comm, at(done), nodes, start, degree)
    for count in range(2, _MOST_STEPS + 1):
        part = min(1.0, done + step)
        try:
            equilibrium = _solve_unfolded(comm, at(part), nodes, start_from(thread_profile(equilibrium)), degree)
        except ThreadSolverError as error:
            step *= 0.5
            if step < _SMALLEST_STEP:
                raise ThreadSolverError(f"stopped at {done:.4g} of it: {error}") from error
            continue
        done, step = part, _GROWTH * step
        if done == 1.0:
            return RampedEquilibrium(equilibrium, name, count)
    raise ThreadSolverError(f"only {done:.4g} of it after {_MOST_STEPS} steps")
