"""The plan of a study from the command line: lists such as ``1,2,5-8``, one message for each mistake."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from hydroelastic.scenes.errors import Problem, SceneError, shown_value
from hydroelastic.scenes.study.plan import LIMITS, StudyPlan

EXAMPLES = {
    "families": "uniform,geometric",
    "degrees": "1,2,3 or 1-8",
    "geometric_degrees": "2-10",
    "tolerances": "1e-3,1e-6",
    "halvings": "4",
    "most_unknowns": "50000",
}
"""Example of each option, by attribute of `StudyPlan`."""

# Longer than any allowed range, whose ends are checked later.
_LONGEST_RANGE = 1000


def plan_from_options(options: Mapping[str, str | None]) -> StudyPlan:
    """Return the plan of the options of a command line."""
    values: dict[str, Any] = {}
    problems: list[Problem] = []
    for name, text in options.items():
        if text is None:
            continue
        try:
            value = _READERS[name](text)
            # One at a time, so that an error of the plan belongs to this option.
            StudyPlan(**{name: value})
        except ValueError as error:
            problems.append(Problem(key=name, value=shown_value(text), wrong=str(error), allowed=LIMITS[name].words))
        except SceneError as error:
            problems += error.problems
        else:
            values[name] = value
    if problems:
        raise SceneError(*(_said_of_option(problem) for problem in problems))
    return StudyPlan(**values)


def _said_of_option(problem: Problem) -> Problem:
    option = f"--{problem.key.replace('_', '-')}"
    return replace(problem, key=option, remedy=problem.remedy or f"Write for example {option} {EXAMPLES[problem.key]}")


def _entries(text: str) -> tuple[str, ...]:
    return tuple(entry.strip() for entry in text.split(",")) if text.strip() else ()


def _whole_number(text: str) -> int:
    # Python itself would also read 1_0, digits of other scripts.
    if not (text.isascii() and text.removeprefix("-").isdigit() and len(text) < 1000):
        raise ValueError(f'"{text}" is not a whole number' if text else "an entry is empty")
    return int(text)


def _whole_numbers(text: str) -> tuple[int, ...]:
    numbers: list[int] = []
    for entry in _entries(text):
        first, dash, last = entry.partition("-")
        if not (first and dash):
            numbers.append(_whole_number(entry))
            continue
        low, high = _whole_number(first.strip()), _whole_number(last.strip())
        if high < low:
            raise ValueError(f"the range {entry} runs downwards")
        numbers += [*range(low, min(high, low + _LONGEST_RANGE)), high]
    return tuple(numbers)


def _numbers(text: str) -> tuple[float, ...]:
    numbers = []
    for entry in _entries(text):
        try:
            numbers.append(float(entry))
        except ValueError as error:
            raise ValueError(f'"{entry}" is not a number' if entry else "an entry is empty") from error
    return tuple(numbers)


_READERS: dict[str, Callable[[str], Any]] = {
    "families": _entries,
    "degrees": _whole_numbers,
    "geometric_degrees": _whole_numbers,
    "tolerances": _numbers,
    "halvings": _whole_number,
    "most_unknowns": _whole_number,
}
