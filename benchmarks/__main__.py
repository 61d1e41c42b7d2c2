"""Run the benchmark: ``python -m hydroelastic.benchmarks``, which is what ``hydroelastic bench`` starts."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import click

from hydroelastic.benchmarks.problems import PROBLEMS
from hydroelastic.benchmarks.runner import equal_error, measure, ratios, write

BAD_INPUT = 2
NOTHING_MEASURED = 3
INTERRUPTED = 130


@click.command(context_settings={"help_option_names": ["-h", "--help"]})
@click.option(
    "--out", type=click.Path(path_type=Path), default=Path("results/benchmarks"), help="Folder of the results."
)
@click.option("--problem", type=click.Choice(list(PROBLEMS)), multiple=True, help="Only this one; all by default.")
@click.option("--quick", is_flag=True, help="One case of each problem, every third resolution.")
@click.option("--repeats", type=click.IntRange(min=1), default=3, help="Rounds that count.", show_default=True)
@click.option("--no-install", is_flag=True, help="Leave out peers that are not installed.")
def main(out: Path, problem: tuple[str, ...], quick: bool, repeats: int, no_install: bool) -> None:
    """Measure error against seconds, beside NGSolve, scikit-fem, Capytaine, OpenFLASH, MoorPy and MoorDyn.

    \b
    Example:
      python -m hydroelastic.benchmarks --problem tanks --quick --out results/quick
    """
    try:
        out.mkdir(parents=True, exist_ok=True)
        for name in problem or PROBLEMS:
            asked = PROBLEMS[name]
            with _progress() as report:
                rows = measure(asked, name, quick=quick, repeats=repeats, install=not no_install, report=report)
            for row in rows:
                if not row["seconds"] > 0.0:
                    click.echo(f"Warning: {name}: {row['method']} was {row['note']}", err=True)
            if not any(row["seconds"] > 0.0 for row in rows):
                click.echo("Error: nothing was measured", err=True)
                sys.exit(NOTHING_MEASURED)
            write(asked, rows, out)
            click.echo(f"{asked.title}\n\n{equal_error(asked, rows)}\n\n{ratios(asked, rows) if asked.base else ''}")
    except OSError as error:
        wrong = f"output folder {out}: it cannot be written ({error.strerror or error}). Name another one with --out"
        click.echo(f"Error: {wrong}", err=True)
        sys.exit(BAD_INPUT)
    except KeyboardInterrupt:
        click.echo("Interrupted: the results of what was being measured were not written.", err=True)
        sys.exit(INTERRUPTED)
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


if __name__ == "__main__":
    main()
