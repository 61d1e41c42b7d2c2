"""The thread at rest to a tolerance: the error is estimated from solutions on a mesh and on its halves.

Rounding errors of a thread at rest, by the residual and by the response to a stretch of the whole thread.

Lengths of elements are differences of positions, so that |r_s| is known to some eps times the number of elements. A
taut thread answers to a stretch ε with the tension ε/(1/EA + |Pq|²L²/12T³), EA ε if it is nearly straight: 1e-9 of the
tension and more where that is far below EA. The response y of all unknowns solves F'(w) y = ∫μ.

Nodes where the thread passes heights at which a derivative of its stream jumps.

Between rows of a table the stream is smooth; at them a derivative jumps, the first one of straight lines, the second of
monotone cubics, the third of a spline. An element that contains such a place has an error of low order that depends on
the position within it: comparison with halved elements does not estimate it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray

from hydroelastic.fem.adaptive import ErrorEstimate, adaptive_solve
from hydroelastic.fem.thread.continuation import solve_with_ramps
from hydroelastic.fem.thread.equilibrium import Along, Equilibrium, Start
from hydroelastic.fem.thread.initial_mesh import initial_nodes
from hydroelastic.fem.thread.newton import ThreadSolverError
from hydroelastic.fem.thread.profile import ThreadProfile, start_from, thread_profile
from hydroelastic.fem.thread.table import line_table
from hydroelastic.meshes.compat import collapsed
from hydroelastic.physics.thread import Thread

# Compression below this part of the characteristic tension is rounding.
COMPRESSION = 1e-8
# Rounding of a solution, relative: measured 1e-13 for straight threads, whose discrete solution is exact.
ROUNDING = 1e-12
# Compression above this part of the largest force is not an error of discretization.
_FOLDED = 0.05
# Inner points of an element at which two solutions are compared.
_PLACES = np.arange(1, 8) / 8.0
_MOST_ROUNDS = 12
# Number of meshes after which nodes are no longer moved to kinks of the stream.
_SETTLED = 6
_MOST_PARTS = 8
_MOST_ELEMENTS = 4_000
# Target error of refined elements, of the tolerance.
_AIM = 0.3

# Number of samples on each element in search of a passage.
_LOOKS = 16
_BISECTIONS = 50
# Of the smaller element beside it: a node this near is moved to the passage, otherwise there is another one.
_NEAR = 0.4
# Of the same: the remaining error of a kink falls with its square.
_THERE = 1e-3
# With more passages elements are as short as the rows of the table are dense, and nodes are left where they are.
_MOST = 300


class CompressionError(ThreadSolverError):
    """The thread would be in compression, which a thread without bending stiffness cannot carry."""


class NoEquilibriumError(ThreadSolverError):
    """No equilibrium was found from any start; the message says what was tried."""


@dataclass(frozen=True, kw_only=True)
class ThreadErrors:
    """Bounds of errors, estimated, SI."""

    position: float  # of the whole thread, m
    tension: float  # of the whole thread, N
    reaction: float  # N
    moment: float  # of the ends, N m
    # the largest of these, of positions by the length, of forces by the largest contact force or the characteristic
    # tension if that is larger, of moments by the largest one or by that which bends the thread by a radian along its
    # length
    relative: float


@dataclass(frozen=True, kw_only=True)
class ThreadSolution:
    """A thread at rest, of known accuracy."""

    equilibrium: Equilibrium  # the finer one of the last two field solutions
    profile: ThreadProfile  # its tables
    errors: ThreadErrors  # the difference of the two, which bounds the error of the finer one, and rounding
    elements: tuple[int, ...]  # numbers of elements of all meshes, in order
    newton_steps: tuple[int, ...]  # on each of them
    ramps: tuple[tuple[str, int], ...]  # name and number of steps of each continuation that was needed


def solve_thread(
    comm: MPI.Comm, model: Thread, start: Start, *, tolerance: float = 1e-6, degree: int = 5
) -> ThreadSolution:
    """Solve a thread at rest until positions, tensions, reactions and moments are within a tolerance."""
    if not 1e-11 <= tolerance <= 0.1:
        raise ValueError(f"tolerance is {tolerance}: it must be between 1e-11 and 0.1")
    if degree < 2:
        raise ValueError(f"degree is {degree}: it must be at least 2")
    kinks = () if model.stream is None else model.stream.breaks

    def with_knots(nodes: NDArray[np.float64], position: Along) -> NDArray[np.float64]:
        return at_knots(nodes, knots_along(kinks, position, nodes), list(model.loads))

    elements: list[int] = []
    steps: list[int] = []
    ramps: list[tuple[str, int]] = []
    last: _Pair | None = None

    def on_mesh(nodes: NDArray[np.float64], start: Start) -> tuple[Equilibrium, ThreadProfile]:
        ramped = solve_with_ramps(comm, model, nodes, start, degree=degree)
        elements.append(len(nodes) - 1)
        steps.append(ramped.equilibrium.newton_steps)
        if ramped.ramp:
            ramps.append((ramped.ramp, ramped.steps))
        return ramped.equilibrium, thread_profile(ramped.equilibrium)

    def solve(nodes: NDArray[np.float64]) -> _Pair:
        nonlocal last
        if last is not None and np.array_equal(nodes, last.nodes):
            coarse = last.fine
        else:
            _, coarse = on_mesh(nodes, start if last is None else start_from(last.fine))
        halves = _cut(nodes, np.full(len(nodes) - 1, 2))
        equilibrium, fine = on_mesh(halves, start_from(coarse))
        comparison = _Comparison(coarse, fine, equilibrium.units.force)
        # Folds depend on the mesh: finer meshes do not converge.
        _refuse_compression(fine, _FOLDED * comparison.largest)
        moved = not np.array_equal(with_knots(halves, fine.position), halves)
        last = _Pair(
            equilibrium=equilibrium,
            fine=fine,
            nodes=halves,
            comparison=comparison,
            differences=comparison.errors(),
            errors=comparison.errors(thread_rounding(equilibrium)),
            # A thread tangent to the height of a knot may pass it on one mesh and not on the next.
            knots_moved=moved and len(elements) < _SETTLED,
        )
        return last

    def refine(_nodes: NDArray[np.float64], pair: _Pair) -> NDArray[np.float64] | None:
        parts = None if pair.error.within(tolerance) else pair.comparison.parts(tolerance, degree)
        coarse = pair.comparison.coarse.nodes
        finer = with_knots(coarse if parts is None else _cut(coarse, parts), pair.fine.position)
        return finer if len(finer) <= _MOST_ELEMENTS else None

    found = adaptive_solve(
        with_knots(initial_nodes(model, start), start.position),
        solve,
        lambda pair: ErrorEstimate(discretization=inf) if pair.knots_moved else pair.error,
        refine,
        tolerance,
        rounds=_MOST_ROUNDS,
    )
    pair = found.solution
    if not found.converged:
        raise ThreadSolverError(
            f"the error is still {pair.errors.relative:.1e} with {len(pair.nodes) - 1} elements, which is more than "
            f"{tolerance:.1e}"
        )
    _refuse_compression(pair.fine, COMPRESSION * pair.equilibrium.units.force)
    return ThreadSolution(
        equilibrium=pair.equilibrium,
        profile=pair.fine,
        errors=pair.errors,
        elements=tuple(elements),
        newton_steps=tuple(steps),
        ramps=tuple(ramps),
    )


@dataclass(frozen=True, kw_only=True)
class _Pair:
    """Solutions on a mesh and on its halves."""

    equilibrium: Equilibrium  # on the halves
    fine: ThreadProfile  # its profile
    nodes: NDArray[np.float64]  # of the halves, m
    comparison: _Comparison  # of both
    differences: ThreadErrors  # of both, without rounding
    errors: ThreadErrors  # the differences and rounding
    knots_moved: bool  # whether knots of the stream lie elsewhere along the thread than the mesh has them

    @property
    def error(self) -> ErrorEstimate:
        """The relative error; finer meshes do not reduce its rounding."""
        rounding = self.errors.relative - self.differences.relative
        return ErrorEstimate(discretization=self.differences.relative, rounding=rounding)


@dataclass(frozen=True, kw_only=True)
class ThreadRounding:
    """Estimated bounds of rounding errors, SI."""

    position: float  # of the whole thread, m
    tension: float  # of the whole thread, N
    reaction: float  # N
    moment: float  # N m


_NOTHING = ThreadRounding(position=0.0, tension=0.0, reaction=0.0, moment=0.0)


class _Comparison:
    def __init__(self, coarse: ThreadProfile, fine: ThreadProfile, characteristic: float) -> None:
        """Take the differences; `characteristic` is the characteristic tension, N."""
        self.coarse, self.fine = coarse, fine
        starts, sizes = coarse.nodes[:-1], np.diff(coarse.nodes)
        places = (starts[:, None] + sizes[:, None] * _PLACES).ravel()
        shape = (len(starts), len(_PLACES))
        self._inner = (fine.position(places) - coarse.position(places)).reshape(*shape, -1)
        self._nodal = fine.position(coarse.nodes) - coarse.position(coarse.nodes)
        self._tension = np.abs(fine.tension_at(places) - coarse.tension_at(places)).reshape(shape)
        self._force = np.stack(
            [fine.force[::2, 0] - coarse.force[:, 0], fine.force[1::2, 1] - coarse.force[:, 1]], axis=1
        )
        self._nodal_tension = np.abs(
            np.stack(
                [fine.tension[::2, 0] - coarse.tension[:, 0], fine.tension[1::2, 1] - coarse.tension[:, 1]], axis=1
            )
        )
        self.length = coarse.model.length
        self.largest = max(float(np.max(np.linalg.norm(fine.force, axis=2))), characteristic)

    def errors(self, rounding: ThreadRounding = _NOTHING) -> ThreadErrors:
        """Return the estimated errors: the differences and rounding."""
        position = max(_size(self._inner), _size(self._nodal)) + ROUNDING * self.length + rounding.position
        # At a kink of the load two errors of its integral may agree by chance: the polynomial remainder counts as well.
        missed = float(np.sum(_tail(self.fine))) + ROUNDING * self.largest
        tension = float(max(np.max(self._tension), np.max(self._nodal_tension))) + missed + rounding.tension
        reaction = _size(self.fine.reactions() - self.coarse.reactions()) + missed + rounding.reaction
        moment, moments = 0.0, self._largest_moment()
        if moments > 0.0:
            change = float(np.max(np.abs(self.fine.end_moments() - self.coarse.end_moments())))
            moment = change + ROUNDING * moments + rounding.moment
        parts = [position / self.length, moment / (moments or 1.0)]
        if self.largest > 0.0:
            parts += [tension / self.largest, reaction / self.largest]
        return ThreadErrors(position=position, tension=tension, reaction=reaction, moment=moment, relative=max(parts))

    def parts(self, tolerance: float, degree: int) -> NDArray[np.int64]:
        """Return into how many parts each element is to be divided.

        The shape of an element between its nodes is its own, of order p + 1; so is the change of the contact force
        along it, where the load has kinks; where the thread bends its tension, N along a tangent of order p, too. If
        none of these exceeds its share, all elements are halved.
        """
        linear = (1.0 - _PLACES[:, None]) * self._nodal[:-1, None] + _PLACES[:, None] * self._nodal[1:, None]
        shape = np.max(np.linalg.norm(self._inner - linear, axis=2), axis=1) / self.length
        change = np.linalg.norm(self._force[:, 1] - self._force[:, 0], axis=1) / (self.largest or 1.0)
        own = np.maximum(shape, np.maximum(change, _tail(self.fine).reshape(-1, 2).sum(axis=1) / (self.largest or 1.0)))
        wanted = (own / (_AIM * tolerance)) ** (1.0 / (degree + 1))
        if self.fine.model.bends:
            tension = np.max(self._tension, axis=1) / (self.largest or 1.0)
            wanted = np.maximum(wanted, (tension / (_AIM * tolerance)) ** (1.0 / degree))
        parts = np.clip(np.ceil(wanted - 1e-9), 1, _MOST_PARTS).astype(np.int64)
        return parts if np.any(parts > 1) else np.full(len(parts), 2)

    def _largest_moment(self) -> float:
        table = self.fine.curvature_table
        if table is None:
            return 0.0
        rigidity = self.fine.model.flexural_rigidity
        return rigidity * max(_size(table.values), 1.0 / self.length)


def _tail(profile: ThreadProfile) -> NDArray[np.float64]:
    """Part of the change of N on each element by the last two terms of the load, N."""
    tail: NDArray[np.float64] = np.sum(np.linalg.norm(profile.balance[:, -2:], axis=2), axis=1)
    return tail


def _size(vectors: NDArray[np.float64]) -> float:
    return float(np.max(np.linalg.norm(vectors, axis=-1)))


def _cut(nodes: NDArray[np.float64], parts: NDArray[np.int64]) -> NDArray[np.float64]:
    pieces = [
        np.linspace(first, last, count, endpoint=False)
        for first, last, count in zip(nodes[:-1], nodes[1:], parts, strict=True)
    ]
    return np.concatenate([*pieces, nodes[-1:]])


def _refuse_compression(profile: ThreadProfile, limit: float) -> None:
    # A thread with bending stiffness may be in compression.
    if profile.model.bends:
        return
    smallest, place = profile.smallest_tension()
    if smallest < -limit:
        raise CompressionError(
            f"the thread would be in compression: its tension is {smallest:.3e} N at s = {place:.6g} m "
            f"of {profile.model.length:.6g} m"
        )


def thread_rounding(equilibrium: Equilibrium) -> ThreadRounding:
    """Rounding of a solution by Newton's method (collective)."""
    space, units, response = equilibrium.space, equilibrium.units, equilibrium.stretch_response
    stretch = _stretch_unknown(equilibrium)
    position = line_table(response, space.nodes, 0)
    tension = stretch * float(np.max(np.abs(line_table(response, space.nodes, 1).values)))
    largest = float(np.max(np.abs(line_table(equilibrium.solution, space.nodes, 1).values)))
    turn = stretch * float(np.max(np.linalg.norm(position.at_ends(derivative=1), axis=2)))
    moment = 0.0
    if equilibrium.model.bends:
        bend = float(np.max(np.linalg.norm(line_table(response, space.nodes, 2).values, axis=2)))
        moment = stretch * bend * equilibrium.model.flexural_rigidity / units.length
    return ThreadRounding(
        position=stretch * float(np.max(np.linalg.norm(position.values, axis=2))) * units.length,
        tension=tension * units.force,
        reaction=(tension + largest * turn) * units.force,
        moment=moment,
    )


def _stretch_unknown(equilibrium: Equilibrium) -> float:
    """Uncertainty of the stretch of the whole thread: the residuals of ∫μ(|r_s| − 1 − S/EA), whose test functions add
    up to one, with equal signs; and no less than eps for each element and each length from the origin.
    """
    space = equilibrium.space
    rows = collapsed(space.mixed, 1)[1]
    left = equilibrium.residual[rows[rows < len(equilibrium.residual)]]
    total = float(space.mesh.comm.allreduce(float(np.sum(np.abs(left))), op=MPI.SUM))
    farthest = float(np.max(np.abs(line_table(equilibrium.solution, space.nodes, 0).values)))
    least = float(np.finfo(float).eps) * (len(space.nodes) - 1) * max(farthest, 1.0)
    return max(total, least)


def knots_along(heights: tuple[float, ...], position: Along, nodes: NDArray[np.float64]) -> NDArray[np.float64]:
    """Places at which a thread passes heights where a derivative of its stream jumps."""
    breaks = np.array(heights, dtype=np.float64)
    if len(breaks) == 0:
        return breaks
    looks = np.append((nodes[:-1, None] + np.diff(nodes)[:, None] * np.arange(_LOOKS) / _LOOKS).ravel(), nodes[-1])
    # The number of breaks below each place changes where the thread passes some.
    below = np.searchsorted(breaks, position(looks)[:, -1])
    if np.sum(np.abs(np.diff(below))) > _MOST:
        return np.empty(0)
    intervals: list[int] = []
    passed: list[float] = []
    for place in np.flatnonzero(np.diff(below)):
        first, last = sorted((below[place], below[place + 1]))
        passed += list(breaks[first:last])
        intervals += [place] * (last - first)
    low, high, levels = looks[intervals], looks[np.array(intervals, dtype=int) + 1], np.array(passed)
    if len(levels) == 0:
        return levels
    rising = position(high)[:, -1] > position(low)[:, -1]
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        beyond = (position(middle)[:, -1] > levels) == rising
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    found: NDArray[np.float64] = np.unique(0.5 * (low + high))
    return found


def at_knots(nodes: NDArray[np.float64], knots: NDArray[np.float64], kept: list[float]) -> NDArray[np.float64]:
    """Nodes of which one is at each knot: the nearest one is moved, or one is added between two that are far."""
    fixed = [nodes[0], *kept, nodes[-1]]
    for knot in knots:
        index = int(np.argmin(np.abs(nodes - knot)))
        size = _smaller_element(nodes, index)
        distance = abs(nodes[index] - knot)
        if distance <= _THERE * size:
            fixed.append(nodes[index])
        elif distance < _NEAR * size and nodes[index] not in fixed:
            nodes = np.concatenate([nodes[:index], [knot], nodes[index + 1 :]])
            fixed.append(knot)
        elif distance > 1e-9 * nodes[-1]:
            nodes = np.sort(np.append(nodes, knot))
            fixed.append(knot)
    return nodes


def _smaller_element(nodes: NDArray[np.float64], index: int) -> float:
    return float(np.min(np.diff(nodes[max(index - 1, 0) : index + 2])))
