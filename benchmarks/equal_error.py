"""Seconds at equal error, by interpolation between measurements on logarithmic scales."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from hydroelastic.benchmarks.cases import Code
from hydroelastic.benchmarks.rows import Row


def front(points: Iterable[tuple[float, float]]) -> tuple[tuple[float, float], ...]:
    """What no other measurement beats in both: (seconds, error), seconds rising and errors falling."""
    kept: list[tuple[float, float]] = []
    for seconds, error in sorted(points):
        if not kept or error < kept[-1][1]:
            kept.append((seconds, error))
    return tuple(kept)


_SLACK = 1e-2


def seconds_at(points: Iterable[tuple[float, float]], error: float) -> float | None:
    """Seconds in which an error is reached."""
    best = front(points)
    if not best or error * (1.0 + _SLACK) < best[-1][1]:
        return None
    seconds, errors = np.log([point[0] for point in best]), np.log([point[1] for point in best])
    return float(np.exp(np.interp(-np.log(error), -errors, seconds)))


def points_of(rows: Iterable[Row], code: Code, tank: str) -> list[tuple[float, float]]:
    """All measurements of a code on a tank, whole and halves alike: (seconds, error)."""
    return [(row.median, row.error) for row in rows if (row.case.code, row.case.tank) == (code, tank)]


def times_slower(row: Row, rows: Iterable[Row], code: Code) -> float | None:
    """Seconds of a row over those in which a code reaches the row's error, if it does."""
    seconds = seconds_at(points_of(rows, code, row.case.tank), row.error)
    return None if seconds is None else row.median / seconds


def best_of(rows: Iterable[Row], code: Code, tank: str) -> list[Row]:
    """The rows of a code on a tank that no other of them beats in both seconds and error, the fastest one first."""
    kept: list[Row] = []
    for row in sorted((row for row in rows if (row.case.code, row.case.tank) == (code, tank)), key=lambda r: r.median):
        if not kept or row.error < kept[-1].error:
            kept.append(row)
    return kept


def fastest_as_good(rows: Iterable[Row], peer: Row, *own: Code) -> Row | None:
    """The fastest row of given codes with no larger error than a row of a peer on the same tank, if any."""
    good = [r for r in rows if r.case.code in own and r.case.tank == peer.case.tank and r.error <= peer.error]
    return min(good, key=lambda r: r.median, default=None)
