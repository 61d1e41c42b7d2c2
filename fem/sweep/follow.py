"""Follow modes along a parameter, by their shapes.

Modes of one symmetry do not cross, but for those without any coupling: their frequencies approach each other, and the
modes exchange their shapes. So the n-th mode of a symmetry continues the n-th one of the next point, and the K-inner
products of their shapes must say so too, in the optimal assignment of one to the other. Where they do not, the step is
too long, and points between are solved: where the two frequencies come closest, which `two_levels` foresees, else in
the middle. If the frequencies of two modes are then equal within their errors, the modes cross.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.optimize import linear_sum_assignment

from hydroelastic.fem.sweep.mode_vectors import ModeVectors
from hydroelastic.fem.sweep.two_levels import approach

Array = np.ndarray
Solve = Callable[[Sequence[float]], Sequence[ModeVectors | None]]
"""From values of the parameter to the modes there; ``None`` where there is no solution."""

# Of the energy of a shape, what its continuation keeps at least: no other mode can have as much of it.
_KEPT = 0.5
# Shortest step over that of the whole sweep.
_SHORTEST = 1e-9
# Points closer to an end of the step than this part of it would tell nothing new.
_APART = 1e-3
# Relative difference of two ω near which a straight line shows where they are equal.
_CLOSE = 1e-3
# Relative error of ω where there is no estimate.
_UNKNOWN_ERROR = 1e-6
# Rounds of refinement.
_ROUNDS = 24


@dataclass(frozen=True, kw_only=True)
class Step:
    """From one solved value of the parameter to the next.

    Attributes:
        match: for each mode the index of its continuation, −1 where that is not among the modes of the next point.
        kept: squared K-inner product of each mode with its continuation, NaN without one.
        swapped: pairs of modes of one symmetry that cross here: their frequencies are equal within the errors.
        doubtful: modes whose continuation their shapes do not confirm.
    """

    match: Array
    kept: Array
    swapped: tuple[tuple[int, int], ...]
    doubtful: tuple[int, ...]


@dataclass(frozen=True, kw_only=True)
class FollowedModes:
    """Modes followed along a parameter.

    Attributes:
        values: solved values of the parameter, ascending.
        modes: the modes there.
        refined: whether each value was added to those that were given, shape (values,).
        steps: from each value to the next.
        branches: index of the mode of each branch at each value, −1 where it is not among the modes, shape (values,
            branches).
        count: number of modes, from the lowest, that are followed with certainty.
        exhausted: whether more refinement was needed than was allowed.
    """

    values: Array
    modes: tuple[ModeVectors, ...]
    refined: Array
    steps: tuple[Step, ...]
    branches: Array
    count: int
    exhausted: bool

    def of_branches(self, name: str) -> Array:
        """Return an attribute of the modes by branch, NaN where there is none, shape (values, branches)."""
        return np.array([_picked(getattr(one, name), row) for one, row in zip(self.modes, self.branches, strict=True)])

    def participation(self, beam: int) -> Array:
        """Return the part of each branch in the first elastic tone of a beam, shape (values, branches)."""
        return np.array(
            [_picked(one.participation[beam], row) for one, row in zip(self.modes, self.branches, strict=True)]
        )


def _picked(values: Array, row: Array) -> Array:
    return np.where(row >= 0, values[row], np.nan)


def follow(
    values: Sequence[float], modes: Sequence[ModeVectors | None], solve: Solve, *, count: int, most: int
) -> FollowedModes | None:
    """Follow the modes of some solutions, and refine the steps where that is doubtful."""
    known = {value: found for value, found in zip(values, modes, strict=True) if found is not None}
    given, asked = frozenset(known), set(values)
    if not known:
        return None
    left, wanted = most, False
    for _ in range(_ROUNDS):
        ordered = sorted(known)
        shortest = _SHORTEST * (ordered[-1] - ordered[0])
        points = [
            point
            for one, two in pairwise(ordered)
            for point in _refinement((one, two), known[one], known[two], count, shortest)
            if point not in asked
        ]
        wanted = len(points) > left
        points = points[:left]
        if not points:
            break
        left -= len(points)
        asked.update(points)
        found = solve(points)
        known |= {value: one for value, one in zip(points, found, strict=True) if one is not None}
    ordered = sorted(known)
    solved = tuple(known[value] for value in ordered)
    steps = tuple(step_between(one, two, count) for one, two in pairwise(solved))
    return FollowedModes(
        values=np.array(ordered),
        modes=solved,
        refined=np.array([value not in given for value in ordered]),
        steps=steps,
        branches=_branches(solved, steps),
        count=count,
        exhausted=wanted,
    )


def step_between(one: ModeVectors, two: ModeVectors, count: int) -> Step:
    """Assign the modes at two neighbouring values of the parameter to each other."""
    match = np.full(len(one.omega), -1)
    kept = np.full(len(one.omega), np.nan)
    swapped, doubtful = [], []
    products = one.overlaps(two) ** 2
    for before, after in _classes(one, two):
        size = min(len(before), len(after))
        before, after = before[:size], after[:size]
        block = products[np.ix_(before, after)]
        _, best = linear_sum_assignment(block, maximize=True)
        order = np.arange(size)
        for place in np.flatnonzero(best[:-1] == order[1:]):
            pair = slice(place, place + 2)
            crosses = best[place + 1] == place and (_are_equal(one, before[pair]) or _are_equal(two, after[pair]))
            if crosses and min(block[place, place + 1], block[place + 1, place]) > _KEPT:
                order[pair] = order[pair][::-1]
                swapped.append((int(before[place]), int(before[place + 1])))
        match[before] = after[order]
        kept[before] = block[np.arange(size), order]
        doubtful += [int(mode) for mode in before if mode < count and kept[mode] < _KEPT]
    return Step(match=match, kept=kept, swapped=tuple(swapped), doubtful=tuple(doubtful))


def _classes(one: ModeVectors, two: ModeVectors) -> Iterator[tuple[Array, Array]]:
    """The modes of each symmetry at both values, ascending; all of them where one of the two has none."""
    if not (np.all(one.symmetry) and np.all(two.symmetry)):
        yield np.arange(len(one.omega)), np.arange(len(two.omega))
        return
    for sign in (1.0, -1.0):
        yield np.flatnonzero(one.symmetry == sign), np.flatnonzero(two.symmetry == sign)


def _are_equal(modes: ModeVectors, pair: Array) -> bool:
    low, high = modes.omega[pair]
    return bool(high - low <= high * error_of(modes, pair))


def error_of(modes: ModeVectors, pair: Sequence[int] | Array) -> float:
    """Return the estimated relative error of a difference of frequencies, relative to a frequency."""
    return float(np.nan_to_num(modes.relative_error[np.asarray(pair)], nan=_UNKNOWN_ERROR).sum())


def _refinement(
    ends: tuple[float, float], one: ModeVectors, two: ModeVectors, count: int, shortest: float
) -> list[float]:
    step = step_between(one, two, count)
    length = ends[1] - ends[0]
    if length < shortest:
        return []
    points = [ends[0] + part * length for part in _rough_crossings(one, two, step, count)]
    if not step.doubtful:
        return points
    products = one.overlaps(two)
    for before, after in _classes(one, two):
        places = [place for place, mode in enumerate(before) if mode in step.doubtful]
        for low in sorted({place - shift for place in places for shift in (0, 1)}):
            if low >= 0 and low + 1 < min(len(before), len(after)):
                points += _foreseen(ends, one, two, before[low : low + 2], after[low : low + 2], products)
    inside = [point for point in points if min(point - ends[0], ends[1] - point) > _APART * length]
    return sorted(set(inside)) or [0.5 * (ends[0] + ends[1])]


def _rough_crossings(one: ModeVectors, two: ModeVectors, step: Step, count: int) -> Iterator[float]:
    """Where modes of opposite symmetry cross, as parts of the step, if neither of its ends is close to it."""
    there = np.where(step.match >= 0, two.omega[step.match], np.nan)
    for low, high in np.argwhere((one.omega[:count, None] < one.omega[:count]) & (there[:count, None] > there[:count])):
        before, after = one.omega[high] - one.omega[low], there[low] - there[high]
        if min(before, after) > _CLOSE * one.omega[high]:
            yield float(before / (before + after))


def _foreseen(
    ends: tuple[float, float], one: ModeVectors, two: ModeVectors, before: Array, after: Array, products: Array
) -> list[float]:
    """The approach of two modes, and the values on both sides where half of the exchange is done."""
    block = products[np.ix_(before, after)]
    # Other modes must take no part.
    if (block**2).sum(axis=1).min() < _KEPT or block[0, 0] ** 2 > _KEPT:
        return []
    gaps = float(np.diff(one.omega[before] ** 2)[0]), float(np.diff(two.omega[after] ** 2)[0])
    found = approach(ends, gaps, block)
    if found is None or not found.gap < found.slope * (ends[1] - ends[0]):
        return []
    return [found.at - found.half_width, found.at, found.at + found.half_width]


def _branches(modes: Sequence[ModeVectors], steps: Sequence[Step]) -> Array:
    """Chain the steps: index of the mode of each branch at each value."""
    chains = [{0: mode} for mode in range(len(modes[0].omega))]
    ends = dict(enumerate(range(len(chains))))
    for place, step in enumerate(steps, 1):
        continued = {int(after): ends[before] for before, after in enumerate(step.match) if after >= 0}
        for mode in range(len(modes[place].omega)):
            if mode not in continued:
                continued[mode] = len(chains)
                chains.append({})
            chains[continued[mode]][place] = mode
        ends = continued
    return np.array([[chain.get(place, -1) for chain in chains] for place in range(len(modes))])
