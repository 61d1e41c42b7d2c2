"""The golden corpus: results of all shipped scenes and reference cases, made before a change and compared after it.

    ./hydro python tests/support/golden_corpus.py write FOLDER [NAME ...]
    ./hydro python tests/support/golden_corpus.py compare BEFORE AFTER

Under MPI, ``./hydro mpirun -n 2 python tests/support/golden_corpus.py write FOLDER`` makes it on two processes.
"""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click
import numpy as np
import xarray

from hydroelastic.output.manifest import file_names
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.read import Scene, read_scene, shipped_scenes
from hydroelastic.scenes.run import run_scene

REFERENCE = Path(__file__).parents[1] / "reference"
CASE_FILES = ("floats", "hard_cases", "two_liquid_beams")
# What differs from run to run, and measures of rounding, of which the size alone means something.
RUN_DEPENDENT = ("timing", "memory_peak", "memory_of_a_process", "versions", "processes", "pairs_converged")
MEASURES_OF_ROUNDING = ("residual", "error", "difference")
ROUNDING = 1e-12
"""Relative to the largest value of an array: beside the errors that are stated."""
SAME_ORDER = 30.0
"""Errors are estimates: they keep their order of magnitude, not their digits."""


def scenes() -> Iterator[tuple[str, Scene]]:
    """All scenes of the corpus by name: shipped ones first."""
    for shipped in shipped_scenes():
        yield shipped.name, read_scene(shipped.name)
    for file in CASE_FILES:
        for name, case in json.loads((REFERENCE / f"{file}.json").read_text(encoding="utf-8"))["cases"].items():
            yield f"{file}-{name}", TankScene.model_validate(case["scene"])


@click.group()
def main() -> None:
    """Make golden corpora and compare them."""


@main.command()
@click.argument("folder", type=click.Path(path_type=Path))
@click.argument("names", nargs=-1)
def write(folder: Path, names: tuple[str, ...]) -> None:
    """Solve all scenes, or those named, and write each result folder below FOLDER (collective)."""
    for name, scene in scenes():
        if not names or name in names:
            outcome = run_scene(scene, out=folder / name, images=None)
            click.echo(f"{name}: {outcome.status}")


@main.command()
@click.argument("before", type=click.Path(path_type=Path, exists=True))
@click.argument("after", type=click.Path(path_type=Path, exists=True))
def compare(before: Path, after: Path) -> None:
    """Print all that differs by more than the stated errors; exit code 1 if there is anything."""
    names = sorted({path.name for path in before.iterdir()} | {path.name for path in after.iterdir()})
    count = 0
    for name in names:
        for difference in folder_differences(before / name, after / name):
            click.echo(f"{name}: {difference}")
            count += 1
    click.echo(f"{len(names)} scenes, {count} differences")
    raise SystemExit(1 if count else 0)


def folder_differences(before: Path, after: Path) -> Iterator[str]:
    """What differs between two result folders, in words."""
    files = file_names(before)
    if files != file_names(after):
        yield f"files {sorted(set(files) ^ set(file_names(after)))} are in one of both only"
        return
    old, new = (json.loads((folder / "summary.json").read_text(encoding="utf-8")) for folder in (before, after))
    allowed = stated_error(old)
    yield from tree_differences("summary.json", old, new, allowed)
    for file in files:
        if file.endswith(".csv"):
            yield from table_differences(file, before / file, after / file, allowed)
    yield from dataset_differences(before / "dataset.nc", after / "dataset.nc", allowed)


def stated_error(summary: dict[str, Any]) -> float:
    """The relative error that a result may have: twice the tolerance asked for, once for each corpus."""
    return 2.0 * float(summary["scene"].get("accuracy", {}).get("tolerance", ROUNDING)) + ROUNDING


def tree_differences(key: str, old: Any, new: Any, allowed: float) -> Iterator[str]:
    """What differs between two trees of JSON."""
    if key.rpartition(".")[2] in RUN_DEPENDENT:
        return
    if isinstance(old, dict) and isinstance(new, dict):
        if old.keys() != new.keys():
            yield f"{key}: keys {sorted(old.keys() ^ new.keys())} are in one of both only"
        for inner in old.keys() & new.keys():
            yield from tree_differences(f"{key}.{inner}", old[inner], new[inner], allowed)
    elif isinstance(old, list) and isinstance(new, list) and not all(_is_number(entry) for entry in (*old, *new)):
        if len(old) != len(new):
            yield f"{key}: {len(old)} entries, then {len(new)}"
        for number, (one, other) in enumerate(zip(old, new, strict=False)):
            yield from tree_differences(f"{key}[{number}]", one, other, allowed)
    elif (_is_number(old) and _is_number(new)) or (isinstance(old, list) and isinstance(new, list)):
        yield from array_differences(key, np.array(old, dtype=float), np.array(new, dtype=float), allowed)
    elif old != new:
        yield f"{key}: {old!r}, then {new!r}"


def table_differences(name: str, before: Path, after: Path, allowed: float) -> Iterator[str]:
    """What differs between two CSV files: headings, texts, and numbers column by column."""
    old, new = (list(csv.reader(path.open(encoding="utf-8", newline=""))) for path in (before, after))
    if old[0] != new[0] or len(old) != len(new):
        yield f"{name}: other headings or numbers of rows"
        return
    for heading, one, other in zip(old[0], zip(*old[1:], strict=True), zip(*new[1:], strict=True), strict=True):
        numbers = [[_number(cell) for cell in cells] for cells in (one, other)]
        if all(None not in column for column in numbers):
            yield from array_differences(f"{name}: {heading}", np.array(numbers[0]), np.array(numbers[1]), allowed)
        elif one != other:
            yield f"{name}: {heading} has other texts"


def dataset_differences(before: Path, after: Path, allowed: float) -> Iterator[str]:
    """What differs between two datasets: names, dimensions, attributes, values."""
    with xarray.open_dataset(before) as old, xarray.open_dataset(after) as new:
        if set(old.variables) != set(new.variables):
            yield f"dataset: {sorted(set(old.variables) ^ set(new.variables))} are in one of both only"
        for name in sorted(set(old.variables) & set(new.variables)):
            if name == "summary" or any(run in name for run in RUN_DEPENDENT):
                continue
            one, other = old[name], new[name]
            if (one.dims, one.shape, one.attrs) != (other.dims, other.shape, other.attrs):
                yield f"dataset: {name} has other dimensions, lengths or attributes"
            elif one.dtype.kind in "fiu":
                yield from array_differences(f"dataset: {name}", one.values, other.values, allowed)
            elif not (one.values == other.values).all():
                yield f"dataset: {name} has other values"


def array_differences(key: str, old: np.ndarray, new: np.ndarray, allowed: float) -> Iterator[str]:
    """What differs between two arrays of numbers by more than is allowed of the largest."""
    if old.shape != new.shape:
        yield f"{key}: {old.shape} values, then {new.shape}"
        return
    if any(word in key.rpartition(".")[2].lower() for word in MEASURES_OF_ROUNDING):
        low, high = sorted((float(np.nanmax(np.abs(old), initial=0.0)), float(np.nanmax(np.abs(new), initial=0.0))))
        if high > max(SAME_ORDER * low, allowed):
            yield f"{key}: up to {low:.1e} in one, {high:.1e} in the other"
        return
    if (np.isfinite(old) != np.isfinite(new)).any():
        yield f"{key}: other values are infinite or unknown"
        return
    old, new = np.where(np.isfinite(old), old, 0.0), np.where(np.isfinite(new), new, 0.0)
    scale = float(np.abs(old).max(initial=0.0))
    difference = float(np.abs(old - new).max(initial=0.0))
    if difference > allowed * scale and scale + difference > ROUNDING:
        yield f"{key}: differs by {difference:.1e} of {scale:.3e}, allowed is {allowed:.1e} of it"


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _number(cell: str) -> float | None:
    try:
        return float(cell) if cell else math.nan
    except ValueError:
        return None


if __name__ == "__main__":
    main()
