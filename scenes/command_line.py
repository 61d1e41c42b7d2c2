"""The command ``hydroelastic``. Heavy libraries are imported inside the commands, so that help and errors come at
once."""

from __future__ import annotations

import contextlib
import io
import os
import signal
import subprocess
import sys
import time
import traceback
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NoReturn

import click

from hydroelastic.meshes.interrupts import end_on_interrupt
from hydroelastic.output.folder import results_message, written_by_run
from hydroelastic.output.plots import DEFAULT_PICTURES, CurveFormat
from hydroelastic.output.provenance import warnings_of
from hydroelastic.scenes.command_options import (
    animate_option,
    dpi_option,
    format_option,
    picture_options,
    scale_option,
    scene_argument,
    set_option,
    width_option,
)
from hydroelastic.scenes.command_parts import (
    NOT_TO_TOLERANCE,
    file_of_scene,
    folder_of_results,
    is_first_rank,
)
from hydroelastic.scenes.errors import SceneError, UnsolvedError, printable
from hydroelastic.scenes.kinds import checker_of, comparer_of, runner_of
from hydroelastic.scenes.program import PROGRAM
from hydroelastic.scenes.progress import progress
from hydroelastic.scenes.read import read_scene, shipped_scenes, title_of_scene
from hydroelastic.scenes.run import page_writer
from hydroelastic.scenes.sweep.command import sweep

BAD_INPUT = 2
INTERRUPTED = 130
_SECONDS_TO_END = 10
_PRINTING = ("click", "rich")


class _BadInput(click.ClickException):
    exit_code = BAD_INPUT


class _Unsolved(click.ClickException):
    exit_code = NOT_TO_TOLERANCE


class _Commands(click.Group):
    """A group that turns the errors of the project into one message and an exit code."""

    def main(self, *arguments: Any, **settings: Any) -> Any:
        with _printing_on_one_rank():
            try:
                return super().main(*arguments, **{"prog_name": PROGRAM} | settings)
            except OSError as error:
                # Others than the first process print nothing.
                if not is_first_rank():
                    raise
                _end_after_system_error(error)

    def invoke(self, ctx: click.Context) -> Any:
        try:
            return super().invoke(ctx)
        except SceneError as error:
            raise _BadInput(error.text(options=True)) from error
        except UnsolvedError as error:
            raise _Unsolved(str(error)) from error


def _end_after_system_error(error: OSError) -> NoReturn:
    """End the process with a message, because a file or the output cannot be written, for example on a full disk."""
    *_, (frame, _) = traceback.walk_tb(error.__traceback__)
    if error.filename is None and frame.f_globals["__name__"].partition(".")[0] in _PRINTING:
        words = f"nothing can be printed: {error.strerror}. Redirect the output, or use --quiet."
    else:
        place = "a file" if error.filename is None else os.fsdecode(error.filename)
        words = f"{place}: {error.strerror or error}. Check that its folder is there, can be written, and has room."
    click.echo(f"Error: {printable(words)}", err=True)
    # The interpreter flushes once more when it ends, and would complain.
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    sys.exit(BAD_INPUT)


@contextlib.contextmanager
def _printing_on_one_rank() -> Iterator[None]:
    if is_first_rank():
        yield
        return
    with (
        open(os.devnull, "w", encoding="utf-8") as nowhere,
        contextlib.redirect_stdout(nowhere),
        contextlib.redirect_stderr(nowhere),
    ):
        yield


def _print_version(context: click.Context, _parameter: click.Parameter, asked: bool) -> None:
    if not asked or context.resilient_parsing:
        return
    from importlib.metadata import PackageNotFoundError, version

    try:
        click.echo(f"hydroelastic {version('hydroelastic')}")
    except PackageNotFoundError:
        click.echo("hydroelastic, run from a checkout that is not installed")
    context.exit()


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.option(
    "--version", is_flag=True, is_eager=True, expose_value=False, callback=_print_version, help="Show the version."
)
def main() -> None:
    """Natural frequencies and mode shapes of elastic bodies that float in a liquid.

    A SCENE is a TOML file, the name of a shipped scene, or - for the standard input.

    \b
    Example:
      hydroelastic list
      hydroelastic run aquarium
    """
    # A terminal whose encoding lacks Greek letters shows question marks.
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="replace")


@main.command()
@scene_argument
@click.option("--out", type=click.Path(path_type=Path), help="Result folder; default results/<scene name>.")
@set_option
@click.option("--no-images", is_flag=True, help="Write no images.")
@format_option
@dpi_option
@scale_option
@width_option
@animate_option
@click.option("--report", "page", is_flag=True, help="Write report.html too: all results in one page.")
@click.option("--quiet", is_flag=True, help="Print nothing but errors.")
@click.pass_context
def run(
    context: click.Context,
    scene: str,
    out: Path | None,
    overrides: tuple[str, ...],
    no_images: bool,
    page: bool,
    quiet: bool,
    **of_pictures: Any,
) -> None:
    """Solve SCENE, print its tables and write the result folder.

    Files of a previous run in the result folder are replaced when the new ones are complete; all else in it is kept.

    \b
    Example:
      hydroelastic run aquarium --set accuracy.tolerance=1e-8 --out results/fine
    """
    options = picture_options(**of_pictures)
    if no_images and options != DEFAULT_PICTURES:
        raise click.UsageError("--no-images excludes the other options of images: leave out one or the other.")
    checked = read_scene(scene, overrides)
    folder = folder_of_results(scene, out)
    with progress(title_of_scene(checked), shown=not quiet and sys.stderr.isatty()) as report:
        start = time.perf_counter()
        run_kind = runner_of(checked)
        write_page = page_writer(checked) if page else None
        seconds = time.perf_counter() - start
        outcome = run_kind(
            checked,
            images=None if no_images else options,
            page=write_page,
            out=folder,
            scene_file=file_of_scene(scene),
            import_seconds=seconds,
            report=report,
        )
    for warning in outcome.warnings:
        click.echo(f"Warning: {warning}", err=True)
    if quiet:
        for warning in warnings_of(outcome.summary):
            click.echo(f"Warning: {warning}", err=True)
    else:
        click.echo(outcome.table())
    if outcome.status == "unconverged":
        if quiet:
            click.echo(f"Not converged: {'; '.join(outcome.reasons)}", err=True)
        context.exit(NOT_TO_TOLERANCE)


@main.command()
@scene_argument
@set_option
@click.pass_context
def compare(context: click.Context, scene: str, overrides: tuple[str, ...]) -> None:
    """Solve SCENE and print the field solution beside the estimates of the older theories.

    \b
    Example:
      hydroelastic compare aquarium --set body.1.start=0
    """
    checked = read_scene(scene, overrides)
    with progress(title_of_scene(checked), shown=sys.stderr.isatty()) as report:
        compare_kind = comparer_of(checked)
        comparison = compare_kind(checked, report=report)
    click.echo(comparison.table())
    if comparison.status == "unconverged":
        context.exit(NOT_TO_TOLERANCE)


@main.command()
@scene_argument
@click.option("--out", type=click.Path(path_type=Path), help="Folder; default results/<scene name>_study.")
@set_option
@click.option("--families", metavar="LIST", help="Of uniform, algebraic, geometric, tolerance: all by default.")
@click.option("--degrees", metavar="LIST", help="On uniform and algebraic meshes, e.g. 1,2,3 or 1-8; default 1-4.")
@click.option("--geometric-degrees", metavar="LIST", help="On geometric rings; default 2-10.")
@click.option("--tolerances", metavar="LIST", help="Asked relative errors, e.g. 1e-3,1e-6; default 1e-3 to 1e-10.")
@click.option("--halvings", metavar="NUMBER", help="How often elements are halved, at most; default 4.")
@click.option("--most-unknowns", metavar="NUMBER", help="No uniform or algebraic mesh has more; default 250000.")
@format_option
@dpi_option
def study(
    scene: str,
    out: Path | None,
    overrides: tuple[str, ...],
    formats: tuple[CurveFormat, ...],
    dpi: int | None,
    **options: str | None,
) -> None:
    """Measure error against cost: uniform and graded meshes, degrees, tolerances.

    Prints tables with the observed rates of convergence beside those of theory, and writes study.csv, study.txt,
    study.png and summary.json. It takes about a minute. A LIST is separated by commas, and 1-4 is short for 1,2,3,4.
    In three dimensions each model that takes the scene is asked for the tolerances.

    \b
    Example:
      hydroelastic study sloshing --families uniform --degrees 1-8 --set accuracy.modes=5
    """
    from hydroelastic.scenes.study.options import plan_from_options

    plan = plan_from_options(options)
    checked = read_scene(scene, overrides)
    folder = folder_of_results(scene, out, suffix="_study")
    replaces = written_by_run(folder) is not None
    with progress(title_of_scene(checked), shown=sys.stderr.isatty()) as report:
        from hydroelastic.scenes.study.result import measured_study

        measured = measured_study(checked, plan, report)
        measured.save(folder, images=picture_options(formats, dpi=dpi), scene_file=file_of_scene(scene))
    click.echo(measured.text)
    click.echo(f"Written to {results_message(folder, replaces=replaces)}")


@main.command()
@scene_argument
@set_option
def check(scene: str, overrides: tuple[str, ...]) -> None:
    """Validate SCENE and say what will be modelled; solve nothing.

    \b
    Example:
      hydroelastic check my_scene.toml
    """
    checked = read_scene(scene, overrides)
    from rich.console import Console

    from hydroelastic.output.check_text import print_check

    # Evaluated completely before printing: an error leaves no partial output.
    print_check(checked.title, tuple(checker_of(checked)(checked)), Console())


@main.command()
def schema() -> None:
    """Print the JSON schema of scenes, by which editors of TOML complete and check them.

    \b
    Example:
      hydroelastic schema > scene.schema.json
    """
    from hydroelastic.scenes.schema import schema_text

    click.echo(schema_text(), nl=False)


@main.command("list")
def list_scenes() -> None:
    """List the scenes that come with the package.

    \b
    Example:
      hydroelastic list
    """
    from rich.console import Console
    from rich.table import Table

    table = Table("name", "title")
    for shipped in shipped_scenes():
        table.add_row(shipped.name, shipped.title)
    Console().print(table)


@main.command()
@click.option("--out", type=click.Path(path_type=Path), help="Folder; default results/benchmarks.")
@click.option(
    "--problem",
    type=click.Choice(["start", "tanks", "sweeps", "circle", "buoys", "string", "thread", "basin"]),
    multiple=True,
    help="Only this one; all by default.",
)
@click.option("--quick", is_flag=True, help="One case of each problem, every third resolution.")
@click.option("--repeats", type=click.IntRange(min=1), help="Rounds that count; 3 by default.")
@click.option("--no-install", is_flag=True, help="Leave out other codes that are not installed.")
@click.pass_context
def bench(
    context: click.Context,
    out: Path | None,
    problem: tuple[str, ...],
    quick: bool,
    repeats: int | None,
    no_install: bool,
) -> None:
    """Measure error against seconds, beside NGSolve, scikit-fem, Capytaine, OpenFLASH, MoorPy and MoorDyn, and what a
    start costs beside the import of the libraries.

    The other codes are installed into the cache if they are missing. Writes a table as .csv, a page as .md and a
    figure as .png for each problem.

    \b
    Example:
      hydroelastic bench --quick --out results/quick
    """
    arguments = ["--quick"] * quick + ["--no-install"] * no_install
    arguments += [] if out is None else ["--out", os.fspath(out)]
    arguments += [word for name in problem for word in ("--problem", name)]
    arguments += [] if repeats is None else ["--repeats", str(repeats)]
    # A separate process: the package may not import the benchmarks.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    process = subprocess.Popen([sys.executable, "-m", "hydroelastic.benchmarks", *arguments])
    try:
        code = process.wait()
    except KeyboardInterrupt:
        # Ctrl-C reaches both processes; the other one reports it.
        try:
            process.wait(timeout=_SECONDS_TO_END)
        except subprocess.TimeoutExpired:
            process.terminate()
        code = INTERRUPTED
    context.exit(code if code >= 0 else 128 - code)


main.add_command(sweep)

for _command in (main, *main.commands.values()):
    _command.help = (_command.help or "").replace("\n  hydroelastic ", f"\n  {PROGRAM} ")


if __name__ == "__main__":
    end_on_interrupt()
    main()
