"""A run of the benchmark: start the codes, let them take turns, and gather the rows."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from hydroelastic.benchmarks.cases import ALL_CODES, Answer, Case, Code, Variant
from hydroelastic.benchmarks.peers import PEER_MODULES, PeerError, peer_folder
from hydroelastic.benchmarks.rows import Row, row_of
from hydroelastic.benchmarks.tank.cases import BenchmarkTank
from hydroelastic.benchmarks.turns import take_turns
from hydroelastic.benchmarks.workers import Worker, WorkerError, start_worker

Report = Callable[[str], None]
Solve = Callable[[Case], tuple[float, Answer]]

TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9)
NGSOLVE_DEGREES = tuple(range(4, 13))
SCIKIT_FEM_DEGREES = tuple(range(4, 11))


@dataclass(frozen=True, kw_only=True)
class Benchmark:
    """What a run has measured.

    Attributes:
        rows: all cases that were solved.
        not_measured: codes that were not, and why.
        versions: of all codes that were, by code.
        repeats: rounds that count.
    """

    rows: tuple[Row, ...]
    not_measured: dict[Code, str]
    versions: dict[Code, dict[str, str]]
    repeats: int


def cases_of(tank: BenchmarkTank, *, quick: bool) -> tuple[Case, ...]:
    """All cases of a tank; a quick run takes every third."""
    step = 3 if quick else 1
    variants: tuple[Variant, ...] = ("whole", "halves") if tank.beam.is_centred else ("whole",)
    cases: list[Case] = []
    for tolerance in TOLERANCES[::step]:
        cases.append(Case(code="hydroelastic", tank=tank.name, variant="certified", tolerance=tolerance))
        cases.append(Case(code="hydroelastic modes", tank=tank.name, variant="modes alone", tolerance=tolerance))
        cases.append(Case(code="lower bound", tank=tank.name, variant="bare", tolerance=tolerance))
    for variant in variants:
        for degree in NGSOLVE_DEGREES[::step]:
            cases.append(Case(code="ngsolve", tank=tank.name, variant=variant, degree=degree))
        for degree in SCIKIT_FEM_DEGREES[::step]:
            cases.append(Case(code="scikit-fem", tank=tank.name, variant=variant, degree=degree))
    return tuple(cases)


def run_benchmark(cases: Sequence[Case], *, repeats: int, install: bool, report: Report) -> Benchmark:
    """Start all codes and measure all cases."""
    with contextlib.ExitStack() as stack:
        workers, not_measured = _start(stack, cases, install=install, report=report)
        solvers: dict[Code, Solve] = {code: worker.solve for code, worker in workers.items()}
        rows, failed = measure(cases, solvers, repeats=repeats, report=report)
    return Benchmark(
        rows=rows,
        not_measured=not_measured | failed,
        versions={code: worker.versions for code, worker in workers.items()},
        repeats=repeats,
    )


def _start(
    stack: contextlib.ExitStack, cases: Sequence[Case], *, install: bool, report: Report
) -> tuple[dict[Code, Worker], dict[Code, str]]:
    workers: dict[Code, Worker] = {}
    problems: dict[Code, str] = {}
    asked = {case.code for case in cases}
    for code in (code for code in ALL_CODES if code in asked):
        try:
            folder = peer_folder(code, install=install, report=report) if code in PEER_MODULES else None
            report(f"starting {code}")
            workers[code] = stack.enter_context(start_worker(code, folder))
        except (PeerError, WorkerError) as error:
            problems[code] = str(error)
            report(f"{code} is not measured: {error}")
    return workers, problems


def measure(
    cases: Sequence[Case], solvers: dict[Code, Solve], *, repeats: int, report: Report
) -> tuple[tuple[Row, ...], dict[Code, str]]:
    """Let the codes take turns."""
    seconds: dict[Case, list[float]] = {}
    answers: dict[Case, list[Answer]] = {}
    failed: dict[Code, str] = {}
    for number, case in take_turns([case for case in cases if case.code in solvers], repeats):
        if case.code in failed:
            continue
        report(f"{case.tank}, round {number} of {repeats}: {case.code}, {case.resolution}")
        try:
            spent, answer = solvers[case.code](case)
        except WorkerError as error:
            failed[case.code] = f"{case.tank}, {case.variant}, {case.resolution}: {error}"
            continue
        if number > 0:
            seconds.setdefault(case, []).append(spent)
            answers.setdefault(case, []).append(answer)
    rows = [row_of(case, answers[case], tuple(seconds[case])) for case in _measured(cases, seconds, failed)]
    return tuple(rows), failed


def _measured(cases: Sequence[Case], seconds: dict[Case, list[float]], failed: dict[Code, str]) -> Iterator[Case]:
    return (case for case in cases if case in seconds and case.code not in failed)
