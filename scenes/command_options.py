"""Arguments and options that commands share, and options of pictures."""

from __future__ import annotations

from typing import Any

import click
from click.shell_completion import CompletionItem

from hydroelastic.output.plots import (
    CURVE_FORMATS,
    DEFAULT_PICTURES,
    DPI_LIMITS,
    SCALE_LIMITS,
    WIDTH_LIMITS,
    CurveFormat,
    PictureOptions,
)
from hydroelastic.scenes.read import SHIPPED_FOLDER


def _scenes(_context: click.Context, _parameter: click.Parameter, typed: str) -> list[CompletionItem]:
    names = sorted(path.stem for path in SHIPPED_FOLDER.glob("*.toml"))
    return [*(CompletionItem(name) for name in names if name.startswith(typed)), CompletionItem(typed, type="file")]


scene_argument = click.argument("scene", metavar="SCENE", shell_complete=_scenes)
set_option = click.option(
    "--set",
    "overrides",
    multiple=True,
    metavar="KEY=VALUE",
    help="Replace a value of the scene, e.g. body.1.start=2.5 (entries are numbered from 1). May be repeated.",
)
format_option = click.option(
    "--image-format",
    "formats",
    type=click.Choice(CURVE_FORMATS),
    multiple=True,
    help="Of pictures; default png. May be repeated. Numbered frames are png always.",
)
dpi_option = click.option(
    "--dpi", type=click.IntRange(*DPI_LIMITS), help=f"Pixels per inch of curves; default {DEFAULT_PICTURES.dpi}."
)
scale_option = click.option(
    "--image-scale",
    "scale",
    type=click.FloatRange(*SCALE_LIMITS),
    metavar="FACTOR",
    help="Size of the pages of curves, default 1; letters keep their size.",
)
width_option = click.option(
    "--image-width",
    "width",
    type=click.IntRange(*WIDTH_LIMITS),
    metavar="PIXELS",
    help=f"Of pictures of fields and threads; default {DEFAULT_PICTURES.width}.",
)
animate_option = click.option(
    "--animate", is_flag=True, default=None, help="Draw what moves as an animation too, a GIF."
)


def picture_options(formats: tuple[CurveFormat, ...], **others: Any) -> PictureOptions:
    """Return what was given on the command line, and the default of the rest."""
    given = {name: value for name, value in others.items() if value is not None}
    return PictureOptions(**given | ({"formats": tuple(dict.fromkeys(formats))} if formats else {}))
