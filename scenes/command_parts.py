"""What several commands do alike: exit codes, result folders, which process prints."""

from __future__ import annotations

import os
from pathlib import Path

import click

from hydroelastic.output.folder import check_output
from hydroelastic.scenes.errors import Problem, SceneError, folder_errors
from hydroelastic.scenes.program import RANK_VARIABLES
from hydroelastic.scenes.read import STANDARD_INPUT, scene_path

NOT_TO_TOLERANCE = 3
"""Exit code where something was not solved to its tolerance."""


def file_of_scene(scene: str) -> Path | None:
    """Return the file of a scene; ``None`` for the standard input."""
    path = scene_path(scene)
    return None if path == STANDARD_INPUT else Path(os.path.realpath(path))


def folder_of_results(scene: str, out: Path | None, *, suffix: str = "") -> Path:
    """Return the result folder of a scene, after a check that nothing in it would be lost."""
    file = file_of_scene(scene)
    stem = "standard_input" if file is None else file.stem
    folder = out if out is not None else Path("results") / f"{stem}{suffix}"
    with folder_errors("--out"):
        earlier = check_output(folder)
    other = earlier.path_of_scene(folder) if earlier is not None else None
    if other is None or other == file:
        return folder
    if out is None:
        raise SceneError(
            Problem(
                key=f"output folder {folder}",
                wrong=f"it has the results of another scene, {other}",
                remedy=f"Name another folder with --out; --out {folder} replaces them",
            ),
            file=file or "the standard input",
        )
    click.echo(f"Note: the results of {other} in {folder}/ will be replaced.", err=True)
    return folder


def is_first_rank() -> bool:
    """Return whether this process prints and writes."""
    return all(os.environ.get(name, "0") == "0" for name in RANK_VARIABLES)
