"""The command ``sweep``. Heavy libraries are imported inside it, so that help and errors come at once."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from hydroelastic.meshes.interrupts import interrupted_with
from hydroelastic.output.folder import written_by_run
from hydroelastic.output.pictures.options import CurveFormat
from hydroelastic.scenes.command_options import (
    dpi_option,
    format_option,
    picture_options,
    scene_argument,
    set_option,
)
from hydroelastic.scenes.command_parts import NOT_TO_TOLERANCE, folder_of_results
from hydroelastic.scenes.progress import progress
from hydroelastic.scenes.read import scene_source


@click.command()
@scene_argument
@click.option(
    "--vary",
    "vary",
    multiple=True,
    required=True,
    metavar="KEY=VALUES",
    help="Values of a key: start:stop:number, start:stop:number:log in equal ratios, or v1,v2,v3. Several make a grid.",
)
@set_option
@click.option("--out", type=click.Path(path_type=Path), help="Folder; default results/<scene name>_sweep.")
@click.option(
    "--jobs",
    type=click.IntRange(min=1),
    default=1,
    help="Processes that solve at the same time; default 1. Fewer than 1000 points of one liquid take one.",
)
@click.option("--show", multiple=True, metavar="NAME", help="Quantity to print and draw, a column of sweep.csv.")
@click.option("--estimates", is_flag=True, help="Make the estimates of older theories at each point too.")
@click.option("--pictures", is_flag=True, help="Write a result folder with pictures for each point, in points/.")
@click.option("--no-follow", is_flag=True, help="Do not follow the modes of closed tanks from point to point.")
@click.option(
    "--refinements",
    type=click.IntRange(min=0),
    help="Points that may be added between others for following modes; default four for each value.",
)
@click.option("--no-images", is_flag=True, help="Do not draw the sweep.")
@format_option
@dpi_option
@click.option("--quiet", is_flag=True, help="Print nothing but errors.")
@click.pass_context
def sweep(
    context: click.Context,
    scene: str,
    vary: tuple[str, ...],
    overrides: tuple[str, ...],
    out: Path | None,
    jobs: int,
    show: tuple[str, ...],
    estimates: bool,
    pictures: bool,
    no_follow: bool,
    refinements: int | None,
    no_images: bool,
    formats: tuple[CurveFormat, ...],
    dpi: int | None,
    quiet: bool,
) -> None:
    """Solve SCENE for many values of its keys, and write curves, a table and a dataset.

    Points that are solved are kept in the folder: the same command goes on after an interruption. Points that fail
    stay in the table with their reason, and the exit code is then 3, as where followed modes are not resolved.

    \b
    Example:
      hydroelastic sweep aquarium --vary body.1.start=0:6:25 --jobs 2
    """
    from hydroelastic.scenes.sweep.axes import grid_from_texts

    grid = grid_from_texts(vary)
    source = scene_source(scene)
    folder = folder_of_results(scene, out, suffix="_sweep")
    replaces = written_by_run(folder) is not None
    title = source.document.get("title") or "Untitled scene"
    with (
        interrupted_with(f"the points solved so far are kept in {folder}/; the same command goes on from there."),
        progress(str(title), shown=not quiet and sys.stderr.isatty()) as report,
    ):
        from hydroelastic.scenes.sweep.files import write_sweep
        from hydroelastic.scenes.sweep.report import sweep_report
        from hydroelastic.scenes.sweep.result import Sweep
        from hydroelastic.scenes.sweep.run import SweepOptions, solve_sweep

        options = SweepOptions(
            jobs=jobs, estimates=estimates, pictures=pictures, follow=not no_follow, refinements=refinements, show=show
        )
        found = Sweep(solved=solve_sweep(scene, grid, overrides=overrides, options=options, out=folder, report=report))
        report("tables and pictures")
        write_sweep(found, folder, show, None if no_images else picture_options(formats, dpi=dpi))
    if not quiet:
        click.echo(sweep_report(found, show, folder, replaces=replaces))
    if found.status != "ok":
        if found.solved.complaints:
            click.echo(f"{len(found.solved.complaints)} of {len(found.solved.points)} points are not ok:", err=True)
        for line in found.solved.reasons:
            click.echo(line, err=True)
        context.exit(NOT_TO_TOLERANCE)
