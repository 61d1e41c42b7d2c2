"""Who solves when: all codes in turn, case by case, so that a busy moment of the machine hits all of them alike."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import zip_longest

from hydroelastic.benchmarks.cases import ALL_CODES, Case


def take_turns(cases: Sequence[Case], repeats: int) -> Iterator[tuple[int, Case]]:
    """Yield each case once for each round, tank by tank; round 0 warms up.

    In a round the codes follow one another, each with its next case. Each round begins at another case.
    """
    for tank in dict.fromkeys(case.tank for case in cases):
        queues = [[case for case in cases if case.tank == tank and case.code == code] for code in ALL_CODES]
        mixed = [case for turn in zip_longest(*queues) for case in turn if case is not None]
        for number in range(repeats + 1):
            first = number * len(mixed) // (repeats + 1)
            for case in (*mixed[first:], *mixed[:first]):
                yield number, case
