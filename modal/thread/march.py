"""Static shape of a thread without bending stiffness, integrated along it from an end at which its force is known.

N' = −q(r, N/|N|), r' = (N/|N|)(1 + |N|/EA): the vector form has no angle, and no singular place but N = 0.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp
from scipy.optimize import root, root_scalar

from hydroelastic.modal.thread.critical import critical_direction
from hydroelastic.modal.thread.shape import NoTensionError, ThreadShape
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.thread_load import UP, ThreadLoad

Force = ArrayLike | Callable[[FloatArray], ArrayLike]

# Of the largest force on the thread: below, the direction N/|N| is lost in rounding after a few steps.
_LEAST_TENSION = 1e-9
# Distance from a free tail within which the thread is taken as straight, of the length.
_TAIL = 1e-5
# First distances of B from A, of the length.
_GUESSES = (1.0, 0.7, 0.3)
# Of the length; a difference step well above the noise of an adaptive integrator.
_DIFFERENCE = 1e-5


@dataclass(frozen=True)
class MarchedThread(ThreadShape):
    """A thread at the steps of the integration, and between them."""

    # (r, N) of s between point forces, of shape (6, n), from end A
    pieces: tuple[Callable[[FloatArray], FloatArray], ...]
    ends: FloatArray  # where the pieces begin and end, m, increasing

    def at(self, s: ArrayLike) -> ThreadShape:
        """Return the thread at places s from 0 to L, m, shape (n,); at a point force, just beyond it."""
        places = np.asarray(s, dtype=float)
        number = np.clip(np.searchsorted(self.ends, places, side="right") - 1, 0, len(self.pieces) - 1)
        states = np.empty((len(places), 6))
        for index, piece in enumerate(self.pieces):
            if (number == index).any():
                states[number == index] = piece(places[number == index]).T
        return ThreadShape(s=places, positions=states[:, :3], forces=states[:, 3:])


def march_back(
    load: ThreadLoad,
    length: float,
    end_force: Force,
    *,
    axial_rigidity: float = math.inf,
    start: ArrayLike = (0.0, 0.0, 0.0),
    point_forces: Sequence[tuple[float, Force]] = (),
    tolerance: float = 1e-10,
) -> MarchedThread:
    """Return the shape of a thread that is held at A and pulled at B by a force that may depend on where B is.

    The thread is integrated from B to A, and the place of B is found for which A comes to lie at ``start``.

    Args:
        load: q.
        length: L, unstretched, m.
        end_force: N(L), N, three components, or a function of the position of B, m.
        axial_rigidity: EA, N; infinite if the thread does not stretch.
        start: position of A, m.
        point_forces: pairs of a place 0 < s < L, m, and the force that acts there on the thread, N, or a function of
            the position of that place.
        tolerance: relative, of each step.
    """
    _check(length, axial_rigidity)
    places = [place for place, _ in point_forces]
    if any(not 0 < place < length for place in places):
        raise ValueError(f"point_forces act at {places}: they must act between 0 and the length, {length} m")
    knots = sorted(point_forces, key=lambda pair: pair[0])

    def march(end: FloatArray) -> MarchedThread:
        return _march(load, length, end, _force(end_force, end), axial_rigidity, knots, tolerance)

    beginning = np.asarray(start, dtype=float)
    pull = _force(end_force, beginning + length * UP)
    size = float(np.linalg.norm(pull))
    if size == 0:
        raise NoTensionError("no force acts at the end: for a free tail use march_tail")
    return _placed(march, beginning, length, pull / size, tolerance)


def march_tail(
    load: ThreadLoad,
    length: float,
    *,
    axial_rigidity: float = math.inf,
    start: ArrayLike = (0.0, 0.0, 0.0),
    tolerance: float = 1e-10,
) -> MarchedThread:
    """Return the shape of a thread that is held at A and free at B, T(L) = 0.

    A tail is regular only along the local critical direction, in which q is tangential and pulls away from the thread.
    It is taken to be straight over the last 1e-5 of the length.

    Args:
        load: q.
        length: L, unstretched, m.
        axial_rigidity: EA, N; infinite if the thread does not stretch.
        start: position of A, m.
        tolerance: relative, of each step.
    """
    _check(length, axial_rigidity)
    tail = _TAIL * length

    def march(end: FloatArray) -> MarchedThread:
        direction, pull = critical_direction(load, end)
        near = _march(
            load, length - tail, end - tail * direction, pull * tail * direction, axial_rigidity, [], tolerance
        )
        return _with_tail(near, length, end)

    beginning = np.asarray(start, dtype=float)
    direction, _ = critical_direction(load, beginning)
    return _placed(march, beginning, length, direction, tolerance)


def _check(length: float, axial_rigidity: float) -> None:
    if not (math.isfinite(length) and length > 0):
        raise ValueError(f"length is {length}: it must be finite and positive")
    if not axial_rigidity > 0:
        raise ValueError(f"axial_rigidity is {axial_rigidity}: it must be positive, infinite without stretch")


def _force(force: Force, position: FloatArray) -> FloatArray:
    return np.asarray(force(position) if callable(force) else force, dtype=float)


def _placed(
    march: Callable[[FloatArray], MarchedThread],
    start: FloatArray,
    length: float,
    direction: FloatArray,
    tolerance: float,
) -> MarchedThread:
    """Find the place of B, about ``direction`` from A, for which the march ends at ``start``."""
    reason = "the march from B does not end at A"
    for guess in _GUESSES:
        try:
            marched = march(start + length * guess * direction)
            # Where the profile has breaks the error of the integration is some ten tolerances.
            for improved, allowed in ((_shifted, 1), (_at_height, 100), (_anywhere, 100)):
                marched = improved(march, marched, start, length, tolerance)
                if _miss(marched, start, length) < allowed * tolerance:
                    return marched
        except NoTensionError as error:
            reason = str(error)
    raise NoTensionError(reason)


def _shifted(
    march: Callable[[FloatArray], MarchedThread], marched: MarchedThread, start: FloatArray, length: float, _: float
) -> MarchedThread:
    """Translate the thread: exact where neither stream nor force depends on the position."""
    return march(marched.positions[-1] + start - marched.positions[0])


def _at_height(
    march: Callable[[FloatArray], MarchedThread],
    marched: MarchedThread,
    start: FloatArray,
    length: float,
    tolerance: float,
) -> MarchedThread:
    """Find the height of B, the only unknown where stream and forces depend on the height alone."""
    end = marched.positions[-1]

    def miss(height: float) -> float:
        return float(march(np.array([end[0], end[1], height])).positions[0, 2] - start[2])

    off = float(marched.positions[0, 2] - start[2])
    # B is at its height already; the secant method needs two different heights.
    if abs(off) <= tolerance * length:
        return marched
    found = root_scalar(miss, method="secant", x0=end[2], x1=end[2] - off, xtol=10 * tolerance * length)
    if not found.converged:
        return marched
    return _shifted(march, march(np.array([end[0], end[1], found.root])), start, length, tolerance)


def _anywhere(
    march: Callable[[FloatArray], MarchedThread],
    marched: MarchedThread,
    start: FloatArray,
    length: float,
    tolerance: float,
) -> MarchedThread:
    found = root(
        lambda x: (march(start + length * x).positions[0] - start) / length,
        (marched.positions[-1] - start) / length,
        options={"xtol": tolerance, "eps": _DIFFERENCE**2},
    )
    return march(start + length * found.x)


def _miss(marched: MarchedThread, start: FloatArray, length: float) -> float:
    return float(np.linalg.norm(marched.positions[0] - start)) / length


def _march(
    load: ThreadLoad,
    length: float,
    end: FloatArray,
    end_force: FloatArray,
    axial_rigidity: float,
    knots: Sequence[tuple[float, Force]],
    tolerance: float,
) -> MarchedThread:
    """Integrate from B, at ``end`` with N = ``end_force``, to A."""
    state = np.concatenate([end, end_force])
    pieces, steps, states = [], [], []
    ends = [0.0, *(place for place, _ in knots), length]
    for (low, high), knot in zip(reversed(list(pairwise(ends))), [*reversed(knots), None], strict=True):
        solved = _piece(load, low, high, state, axial_rigidity, tolerance)
        pieces.append(solved.sol)
        steps.append(solved.t)
        states.append(solved.y)
        state = solved.y[:, -1].copy()
        if knot is not None:
            state[3:] += _force(knot[1], state[:3])
    # At a point force the later piece, which was marched first, comes last: the values just beyond it are kept.
    s, columns = np.concatenate(steps)[::-1], np.concatenate(states, axis=1)[:, ::-1]
    beyond = np.append(np.diff(s) > 0, True)
    return MarchedThread(
        s=s[beyond],
        positions=columns[:3, beyond].T,
        forces=columns[3:, beyond].T,
        pieces=tuple(reversed(pieces)),
        ends=np.array(ends),
    )


def _piece(
    load: ThreadLoad, low: float, high: float, state: FloatArray, axial_rigidity: float, tolerance: float
) -> Any:
    """Return SciPy's solution from s = high to low."""
    force = float(np.linalg.norm(state[3:]))
    if force == 0:
        raise NoTensionError(f"the tension vanishes at s = {high:.6g} m")

    def slope(_: float, y: FloatArray) -> FloatArray:
        tension = math.sqrt(y[3] * y[3] + y[4] * y[4] + y[5] * y[5])
        tangent = y[3:] / tension
        return np.concatenate([tangent * (1 + tension / axial_rigidity), -load.load(y[None, :3], tangent[None])[0]])

    def slack(_: float, y: FloatArray) -> float:
        return float(np.linalg.norm(y[3:])) - _LEAST_TENSION * force

    slack.terminal = True  # type: ignore[attr-defined]
    allowed = tolerance * np.repeat([high - low, force], 3)
    solved = solve_ivp(
        slope, (high, low), state, "DOP853", dense_output=True, events=slack, rtol=tolerance, atol=allowed
    )
    tangents = solved.y[3:] / np.linalg.norm(solved.y[3:], axis=0)
    # Steps are far shorter than a smooth turn: a reversal in one of them is a fold, where N has passed through 0.
    folds = np.sum(tangents[:, 1:] * tangents[:, :-1], axis=0) < 0
    if solved.status != 0 or folds.any():
        place = solved.t[:-1][folds][0] if folds.any() else solved.t[-1]
        raise NoTensionError(f"the tension vanishes near s = {place:.6g} m, and the thread would fold there")
    return solved


def _with_tail(near: MarchedThread, length: float, end: FloatArray) -> MarchedThread:
    """Add the straight end of a free tail, along which the force falls to 0 in proportion."""
    begin = near.s[-1]
    before = np.concatenate([near.positions[-1], near.forces[-1]])
    after = np.concatenate([end, np.zeros(3)])

    def straight(s: FloatArray) -> FloatArray:
        return before[:, None] + np.outer(after - before, (s - begin) / (length - begin))

    return MarchedThread(
        s=np.append(near.s, length),
        positions=np.vstack([near.positions, after[:3]]),
        forces=np.vstack([near.forces, after[3:]]),
        pieces=(*near.pieces, straight),
        ends=np.append(near.ends, length),
    )
