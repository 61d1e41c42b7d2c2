"""The comparison of two golden corpora finds what differs, and nothing where there is nothing."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
import xarray
from golden_corpus import folder_differences

from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.run import run_scene


@pytest.fixture(scope="module")
def before(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("before") / "sloshing"
    run_scene(read_scene("sloshing", ["accuracy.modes=2"]), out=folder, images=None)
    return folder


def change_frequency(folder: Path) -> None:
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    # The scene asks for 1e-6.
    summary["modes"][1]["omega"] *= 1.0 + 3e-6
    (folder / "summary.json").write_text(json.dumps(summary), encoding="utf-8")


def change_word(folder: Path) -> None:
    text = (folder / "summary.json").read_text(encoding="utf-8")
    (folder / "summary.json").write_text(text.replace('"kind": "sloshing"', '"kind": "elastic"'), encoding="utf-8")


def lose_key(folder: Path) -> None:
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    del summary["modes"][0]["frequency_hz"]
    (folder / "summary.json").write_text(json.dumps(summary), encoding="utf-8")


def change_table(folder: Path) -> None:
    head, first, *rows = (folder / "modes.csv").read_text(encoding="utf-8").splitlines()
    (folder / "modes.csv").write_text("\n".join([head, first.replace(",1.", ",1.1"), *rows]), encoding="utf-8")


def change_dataset(folder: Path) -> None:
    with xarray.open_dataset(folder / "dataset.nc") as found:
        changed = found.load()
    (folder / "dataset.nc").unlink()
    changed.assign(elevation_of_free_surface_1=-changed.elevation_of_free_surface_1).to_netcdf(folder / "dataset.nc")


def lose_file(folder: Path) -> None:
    (folder / "modes.csv").unlink()


CHANGES = {
    change_frequency: "modes[1].omega: differs by",
    change_word: "'sloshing', then 'elastic'",
    lose_key: "keys ['frequency_hz']",
    change_table: "modes.csv: omega",
    change_dataset: "dataset: elevation_of_free_surface_1",
    lose_file: "files ['modes.csv']",
}


def test_equal_results_have_no_differences(before: Path) -> None:
    assert list(folder_differences(before, before)) == []


@pytest.mark.parametrize(("change", "said"), CHANGES.items())
def test_what_changed_is_found(before: Path, tmp_path: Path, change: Callable[[Path], None], said: str) -> None:
    after = tmp_path / "after"
    shutil.copytree(before, after)
    change(after)
    found = "\n".join(folder_differences(before, after))
    assert said in found
