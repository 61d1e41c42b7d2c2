"""Where followed modes meet: crossings, and veerings, in which they exchange their shapes without meeting."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np

from hydroelastic.fem.sweep.follow import FollowedModes, error_of
from hydroelastic.fem.sweep.mode_vectors import ModeVectors
from hydroelastic.fem.sweep.two_levels import nearest

Array = np.ndarray

# The exchange is looked at between points where the gap is this many times the smallest.
_WIDE = 3.0
# Energy that the shapes of both modes have exchanged there at least.
_EXCHANGED = 0.5


@dataclass(frozen=True, kw_only=True)
class Encounter:
    """Two frequencies that meet, or nearly.

    Attributes:
        kind: "crossing"; "veering", where the gap is larger than the errors of the frequencies; "unresolved", where
            the shapes change more from one point to the next than can be followed.
        at: value of the parameter.
        omega: ω there, the mean of both, rad/s.
        gap: smallest difference of both ω, rad/s; 0 of a crossing.
        gap_error: its estimated error, rad/s; below it two modes count as crossing.
        branches: both, the lower one before the encounter first.
        reason: why the modes cross, or "".
    """

    kind: Literal["crossing", "veering", "unresolved"]
    at: float
    omega: float
    gap: float
    gap_error: float
    branches: tuple[int, int]
    reason: str = ""


def encounters(followed: FollowedModes) -> tuple[Encounter, ...]:
    """Return the encounters of followed modes, by the parameter: those of one at least of the asked modes."""
    highest = np.array([one.omega[min(followed.count, len(one.omega)) - 1] for one in followed.modes])
    found = (
        one
        for one in (*_crossings(followed), *_veerings(followed), *_unresolved(followed))
        if one.omega - 0.5 * one.gap <= np.interp(one.at, followed.values, highest)
    )
    return tuple(sorted(found, key=lambda one: (one.at, one.omega)))


def _crossings(followed: FollowedModes) -> Iterator[Encounter]:
    omega = followed.of_branches("omega")
    for place, (before, after) in enumerate(pairwise(omega)):
        step = followed.steps[place]
        pairs = np.argwhere((before[:, None] < before) & (after[:, None] >= after))
        for low, high in pairs:
            row = followed.branches[place]
            modes = int(row[low]), int(row[high])
            differences = np.array([before[high] ** 2 - before[low] ** 2, after[high] ** 2 - after[low] ** 2])
            part = float(differences[0] / (differences[0] - differences[1]))
            met = before[low] + part * (after[low] - before[low])
            yield Encounter(
                kind="crossing",
                at=float(followed.values[place] + part * (followed.values[place + 1] - followed.values[place])),
                omega=float(met),
                gap=0.0,
                gap_error=float(met) * error_of(followed.modes[place], modes),
                branches=(int(low), int(high)),
                reason="no coupling within the errors" if modes in step.swapped else "opposite symmetry",
            )


def _veerings(followed: FollowedModes) -> Iterator[Encounter]:
    """Neighbouring branches of one symmetry whose gap has a minimum, on both sides of which each has the shape that the
    other has on the other side."""
    omega, symmetry = followed.of_branches("omega"), followed.of_branches("symmetry")
    branches = followed.branches.shape[1]
    for low in range(branches):
        for high in range(branches):
            gaps = omega[:, high] ** 2 - omega[:, low] ** 2
            for place in range(1, len(gaps) - 1):
                # False where one of the branches is missing.
                least = 0.0 < gaps[place] <= min(gaps[place - 1], gaps[place + 1])
                apart = symmetry[place, low] * symmetry[place, high] < 0
                if not least or apart or not _are_neighbours(omega[place], symmetry[place], low, high):
                    continue
                row = followed.branches[place]
                doubtful = {*followed.steps[place - 1].doubtful, *followed.steps[place].doubtful}
                error = error_of(followed.modes[place], [row[low], row[high]])
                if omega[place, high] - omega[place, low] <= omega[place, high] * error or doubtful & {
                    row[low],
                    row[high],
                }:
                    continue
                left, right = _sides(gaps, place)
                if _exchanged(followed, (left, right), (low, high)):
                    around = slice(place - 1, place + 2)
                    meeting = nearest(followed.values[around], gaps[around])
                    mean = 0.5 * (omega[place, low] + omega[place, high])
                    yield Encounter(
                        kind="veering",
                        at=meeting.at,
                        omega=float(mean),
                        gap=meeting.gap / (2.0 * float(mean)),
                        gap_error=float(mean) * error,
                        branches=(low, high),
                    )


def _are_neighbours(omega: Array, symmetry: Array, low: int, high: int) -> bool:
    """Whether no mode of the same symmetry lies between two branches."""
    between = (omega > omega[low]) & (omega < omega[high]) & (symmetry * symmetry[low] >= 0)
    return not bool(np.any(between))


def _sides(gaps: Array, place: int) -> tuple[int, int]:
    """The places on both sides of a smallest gap where it is wide, or begins to fall again."""
    wide = _WIDE * gaps[place]
    left = right = place
    while left > 0 and gaps[left] < wide and gaps[left - 1] >= gaps[left]:
        left -= 1
    while right < len(gaps) - 1 and gaps[right] < wide and gaps[right + 1] >= gaps[right]:
        right += 1
    return left, right


def _exchanged(followed: FollowedModes, places: tuple[int, int], branches: tuple[int, int]) -> bool:
    one, two = (followed.modes[place] for place in places)
    products = one.overlaps(two) ** 2
    (low, high), (low_after, high_after) = (followed.branches[place, list(branches)] for place in places)
    return bool(products[low, high_after] + products[high, low_after] > 2.0 * _EXCHANGED)


def _unresolved(followed: FollowedModes) -> Iterator[Encounter]:
    """Steps along which shapes do not confirm the continuation of a mode."""
    for place, step in enumerate(followed.steps):
        for mode in step.doubtful:
            one, two = followed.modes[place], followed.modes[place + 1]
            branch = int(np.flatnonzero(followed.branches[place] == mode)[0])
            other = _partner(one, two, mode, int(step.match[mode]))
            if other is None or other < mode:
                continue
            pair = branch, int(np.flatnonzero(followed.branches[place] == other)[0])
            yield Encounter(
                kind="unresolved",
                at=float(followed.values[place : place + 2].mean()),
                omega=float(one.omega[mode]),
                gap=float(one.omega[other] - one.omega[mode]),
                gap_error=float(one.omega[mode]) * error_of(one, (mode, other)),
                branches=pair,
                reason=f"the shape keeps {step.kept[mode]:.2f} of its energy over one step",
            )


def _partner(one: ModeVectors, two: ModeVectors, mode: int, match: int) -> int | None:
    """The other mode whose shape the continuation of a mode has most of."""
    products = one.overlaps(two)[:, match] ** 2
    products[mode] = 0.0
    return int(np.argmax(products)) if products.any() else None
