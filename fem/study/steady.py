"""Times of short solutions: the least of a few, since other tasks of the computer only add to a time."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

from mpi4py import MPI

from hydroelastic.fem.study.row import StudyRow

# Time in s below which a solution is repeated, and number of repetitions.
_SHORT = 0.15
_REPEATS = 2

_Given = ParamSpec("_Given")
_Row = TypeVar("_Row", StudyRow, StudyRow | None)


def steadily_timed(solve: Callable[_Given, _Row]) -> Callable[_Given, _Row]:
    """Return a function that repeats short solutions of ``solve`` and keeps the fastest."""

    @wraps(solve)
    def timed(*given: _Given.args, **named: _Given.kwargs) -> _Row:
        row = solve(*given, **named)
        # All processes repeat, or none.
        if row is None or MPI.COMM_WORLD.bcast(row.seconds >= _SHORT):
            return row
        for _ in range(_REPEATS):
            again = solve(*given, **named)
            if again is not None and MPI.COMM_WORLD.bcast(again.seconds < row.seconds):
                row = again
        return row

    return timed
