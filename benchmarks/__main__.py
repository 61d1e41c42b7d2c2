"""Run the benchmark: ``python -m hydroelastic.benchmarks``, which is what ``hydroelastic bench`` starts."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

import click

from hydroelastic.benchmarks.cases import Case
from hydroelastic.benchmarks.circle.cases import CIRCLE, circle_cases
from hydroelastic.benchmarks.measure import Benchmark, cases_of, run_benchmark
from hydroelastic.benchmarks.output import (
    OutputError,
    check_folder,
    write_circle,
    write_results,
    write_strings,
    write_threads,
)
from hydroelastic.benchmarks.string.cases import MOTIONS, string_cases
from hydroelastic.benchmarks.tank.cases import TANKS
from hydroelastic.benchmarks.thread.cases import THREADS, thread_cases

BAD_INPUT = 2
NOTHING_MEASURED = 3
INTERRUPTED = 130


@dataclass(frozen=True, kw_only=True)
class Problem:
    """What is solved, how often, and where its results go."""

    cases: Callable[[bool], list[Case]]
    repeats: int
    write: Callable[[Benchmark, Path], None]


def _tank_cases(quick: bool) -> list[Case]:
    return [case for tank in (TANKS[:1] if quick else TANKS) for case in cases_of(tank, quick=quick)]


def _circle_cases(quick: bool) -> list[Case]:
    return [case for one in (CIRCLE[:1] if quick else CIRCLE) for case in circle_cases(one, quick=quick)]


def _string_cases(quick: bool) -> list[Case]:
    return [case for motion in (MOTIONS[:1] if quick else MOTIONS) for case in string_cases(motion, quick=quick)]


def _thread_cases(quick: bool) -> list[Case]:
    return [case for thread in (THREADS[:1] if quick else THREADS) for case in thread_cases(thread, quick=quick)]


PROBLEMS = {
    "tanks": Problem(cases=_tank_cases, repeats=7, write=write_results),
    # Half a minute for each round of each frequency.
    "circle": Problem(cases=_circle_cases, repeats=3, write=write_circle),
    "string": Problem(cases=_string_cases, repeats=3, write=write_strings),
    "thread": Problem(cases=_thread_cases, repeats=3, write=write_threads),
}
_QUICK_REPEATS = 3


@click.command(context_settings={"help_option_names": ["-h", "--help"]})
@click.option(
    "--out", type=click.Path(path_type=Path), default=Path("results/benchmarks"), help="Folder of the results."
)
@click.option("--problem", type=click.Choice(list(PROBLEMS)), multiple=True, help="Only this one; all by default.")
@click.option("--quick", is_flag=True, help="One tank, frequency, motion and thread, every third case.")
@click.option("--repeats", type=click.IntRange(min=1), help="Rounds that count; 7 of tanks, else or if quick 3.")
@click.option("--no-install", is_flag=True, help="Leave out peers that are not installed.")
def main(out: Path, problem: tuple[str, ...], quick: bool, repeats: int | None, no_install: bool) -> None:
    """Measure error against seconds: tanks beside NGSolve, scikit-fem and a lower bound, a circle beside Capytaine, a
    hanging string by series and as a field, flexible threads beside MoorPy and MoorDyn.

    \b
    Example:
      python -m hydroelastic.benchmarks --quick --out results/quick
    """
    try:
        check_folder(out)
    except OutputError as error:
        _end(str(error), BAD_INPUT)
    for name in problem or PROBLEMS:
        _measure(PROBLEMS[name], out, quick=quick, repeats=repeats, install=not no_install)
    click.echo(f"Written to {out}/")


def _measure(problem: Problem, out: Path, *, quick: bool, repeats: int | None, install: bool) -> None:
    """Measure a problem and write its results; ends the process where there are none."""
    rounds = repeats or (_QUICK_REPEATS if quick else problem.repeats)
    try:
        with _progress() as report:
            benchmark = run_benchmark(problem.cases(quick), repeats=rounds, install=install, report=report)
        if not benchmark.rows:
            reasons = "; ".join(f"{code}: {reason}" for code, reason in benchmark.not_measured.items())
            _end(f"nothing was measured: {reasons}", NOTHING_MEASURED)
        problem.write(benchmark, out)
    except OutputError as error:
        _end(str(error), BAD_INPUT)
    except KeyboardInterrupt:
        click.echo("Interrupted: the results of what was being measured were not written.", err=True)
        sys.exit(INTERRUPTED)
    for code, reason in benchmark.not_measured.items():
        click.echo(f"Warning: {code} was not measured: {reason}", err=True)


@contextlib.contextmanager
def _progress() -> Iterator[Callable[[str], None]]:
    """A line on the terminal that says what is being done; nothing where there is no terminal."""
    if not sys.stderr.isatty():
        yield lambda _message: None
        return
    from rich.console import Console

    with Console(stderr=True).status("starting") as status:
        yield status.update


def _end(message: str, code: int) -> NoReturn:
    click.echo(f"Error: {message}", err=True)
    sys.exit(code)


if __name__ == "__main__":
    main()
