"""Run the benchmark: ``python -m hydroelastic.benchmarks``, which is what ``hydroelastic bench`` starts."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NoReturn

import click

from hydroelastic.benchmarks.measure import cases_of, run_benchmark
from hydroelastic.benchmarks.output import OutputError, check_folder, write_results
from hydroelastic.benchmarks.tanks import TANKS

BAD_INPUT = 2
NOTHING_MEASURED = 3
INTERRUPTED = 130


@click.command(context_settings={"help_option_names": ["-h", "--help"]})
@click.option(
    "--out", type=click.Path(path_type=Path), default=Path("results/benchmarks"), help="Folder of the results."
)
@click.option("--quick", is_flag=True, help="One tank, every third case.")
@click.option("--repeats", type=click.IntRange(min=1), help="Rounds that count; default 7, or 3 if quick.")
@click.option("--no-install", is_flag=True, help="Leave out peers that are not installed.")
def main(out: Path, quick: bool, repeats: int | None, no_install: bool) -> None:
    """Measure error against seconds: this solver, NGSolve, scikit-fem, and a bare lower bound.

    \b
    Example:
      python -m hydroelastic.benchmarks --quick --out results/quick
    """
    try:
        check_folder(out)
    except OutputError as error:
        _end(str(error), BAD_INPUT)
    cases = [case for tank in (TANKS[:1] if quick else TANKS) for case in cases_of(tank, quick=quick)]
    try:
        with _progress() as report:
            rounds = repeats or (3 if quick else 7)
            benchmark = run_benchmark(cases, repeats=rounds, install=not no_install, report=report)
        if not benchmark.rows:
            reasons = "; ".join(f"{code}: {reason}" for code, reason in benchmark.not_measured.items())
            _end(f"nothing was measured: {reasons}", NOTHING_MEASURED)
        write_results(benchmark, out)
    except OutputError as error:
        _end(str(error), BAD_INPUT)
    except KeyboardInterrupt:
        click.echo("Interrupted: no results were written.", err=True)
        sys.exit(INTERRUPTED)
    for code, reason in benchmark.not_measured.items():
        click.echo(f"Warning: {code} was not measured: {reason}", err=True)
    click.echo(f"Written to {out}/")


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
