"""Run the benchmark: ``python -m hydroelastic.benchmarks``, which is what ``hydroelastic bench`` starts."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

import click

from hydroelastic.benchmarks import output
from hydroelastic.benchmarks.basin.cases import BASINS, basin_cases
from hydroelastic.benchmarks.buoy.cases import BUOYS, buoy_cases
from hydroelastic.benchmarks.cases import Case
from hydroelastic.benchmarks.circle.cases import CIRCLE, circle_cases
from hydroelastic.benchmarks.measure import cases_of, run_benchmark
from hydroelastic.benchmarks.output import Output, OutputError, check_folder, write_results
from hydroelastic.benchmarks.string.cases import MOTIONS, string_cases
from hydroelastic.benchmarks.sweep.cases import SWEEPS, sweep_cases
from hydroelastic.benchmarks.tank.cases import TANKS
from hydroelastic.benchmarks.thread.cases import THREADS, thread_cases

BAD_INPUT = 2
NOTHING_MEASURED = 3
INTERRUPTED = 130


@dataclass(frozen=True, kw_only=True)
class Problem:
    """What is solved, how often, and where its results go.

    Attributes:
        members: tanks, frequencies, motions or threads; a quick run takes the first one.
        cases: gives those of a member, all or for a quick run.
        repeats: rounds that count.
        output: what is written of it.
    """

    members: Sequence[Any]
    cases: Callable[..., tuple[Case, ...]]
    repeats: int
    output: Output


PROBLEMS = {
    "tanks": Problem(members=TANKS, cases=cases_of, repeats=7, output=output.TANKS),
    "sweeps": Problem(members=tuple(SWEEPS), cases=sweep_cases, repeats=3, output=output.SWEEPS),
    # Half a minute for each round of each frequency.
    "circle": Problem(members=CIRCLE, cases=circle_cases, repeats=3, output=output.CIRCLE),
    "string": Problem(members=MOTIONS, cases=string_cases, repeats=3, output=output.STRING),
    "thread": Problem(members=THREADS, cases=thread_cases, repeats=3, output=output.THREADS),
    "basin": Problem(members=BASINS, cases=basin_cases, repeats=3, output=output.BASINS),
    "buoys": Problem(members=BUOYS, cases=buoy_cases, repeats=3, output=output.BUOYS),
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
    """Measure error against seconds: tanks beside NGSolve, scikit-fem and a lower bound, sweeps
    beside a loop over NGSolve, a circle beside Capytaine, a
    hanging string by series and as a field, flexible threads beside MoorPy and MoorDyn,
    heaving buoys beside Capytaine and OpenFLASH.

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
    members = problem.members[:1] if quick else problem.members
    cases = [case for member in members for case in problem.cases(member, quick=quick)]
    rounds = repeats or (_QUICK_REPEATS if quick else problem.repeats)
    try:
        with _progress() as report:
            benchmark = run_benchmark(cases, repeats=rounds, install=install, report=report)
        if not benchmark.rows:
            reasons = "; ".join(f"{code}: {reason}" for code, reason in benchmark.not_measured.items())
            _end(f"nothing was measured: {reasons}", NOTHING_MEASURED)
        write_results(benchmark, out, problem.output)
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
