"""The golden corpus: a subset of it is what it was; what changes in results is found, and nothing where all agrees."""

import json
import shutil
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray
from corpus_records import differences, read_record
from golden_corpus import CASES, REFERENCE, SUBSET, run_case

PROGRAM = (sys.executable, "-m", "hydroelastic.scenes")


@pytest.mark.parametrize("name", SUBSET)
def test_what_users_receive_is_what_it_was(name: str, tmp_path: Path) -> None:
    # Within the sum of the errors that both state. After a change that is meant, `reference` makes them anew.
    reference = REFERENCE / f"{name}.json"
    if not reference.is_file():
        pytest.skip("its record has not been made yet: python3 tests/support/golden_corpus.py reference")
    run_case(name, tmp_path, PROGRAM)
    assert list(differences(json.loads(reference.read_text(encoding="utf-8")), read_record(tmp_path))) == []


def test_the_reference_is_small_and_has_the_cases_that_there_are() -> None:
    assert sum(path.stat().st_size for path in REFERENCE.glob("*")) <= 300_000
    assert {path.stem for path in REFERENCE.glob("*.json")} <= set(SUBSET)


def test_the_cases_cover_the_front() -> None:
    text = json.dumps(CASES)
    commands = {case.get("command", "run").split()[0] for case in CASES.values()}
    assert commands == {"run", "sweep", "study", "compare", "check"}
    for analysis in ("radiation", "response", "resonance", "decay", "spectrum", "impulse_response", "motion"):
        assert f'kind = \\"{analysis}\\"' in text, analysis
    for export in ("wamit", "bemio", "nemoh", "capytaine"):
        assert f'\\"{export}\\"' in text, export
    for key in ("stiffness", "damping", "quadratic_damping", "to", "air_gaps", "points", "hull_pressures", "thickness"):
        assert f"{key} = " in text, key


@pytest.fixture(scope="module")
def before(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("before") / "sloshing"
    run_case("sloshing", folder, PROGRAM)
    read_record(folder)
    return folder


def change_summary(change: Callable[[dict], None]) -> Callable[[Path], None]:  # type: ignore[type-arg]
    def changed(folder: Path) -> None:
        path = folder / "summary.json"
        summary = json.loads(path.read_text(encoding="utf-8"))
        change(summary)
        path.write_text(json.dumps(summary), encoding="utf-8")

    return changed


def by_errors(factor: float) -> Callable[[Path], None]:
    def change(summary: dict) -> None:  # type: ignore[type-arg]
        mode = summary["modes"][1]
        # The stated error and the part that the record rounds away.
        mode["omega"] *= 1.0 + factor * (2.0 * mode["relative_error"] + 2e-8)

    return change_summary(change)


def change_table(folder: Path) -> None:
    head, first, *rows = (folder / "modes.csv").read_text(encoding="utf-8").splitlines()
    (folder / "modes.csv").write_text("\n".join([head, first.replace(",1.", ",1.1"), *rows]), encoding="utf-8")


def change_dataset(change: Callable[[np.ndarray], np.ndarray]) -> Callable[[Path], None]:
    def changed(folder: Path) -> None:
        with xarray.open_dataset(folder / "dataset.nc") as found:
            dataset = found.load()
        (folder / "dataset.nc").unlink()
        wave = dataset.elevation_of_free_surface_1
        dataset.assign(elevation_of_free_surface_1=wave.copy(data=change(wave.values))).to_netcdf(folder / "dataset.nc")

    return changed


def lose_file(folder: Path) -> None:
    (folder / "modes.csv").unlink()


NO_DIFFERENCE = {
    "nothing": lambda _folder: None,
    "within the errors": by_errors(0.5),
    "sign of a mode": change_dataset(lambda wave: wave * np.array([[1.0], [-1.0], [1.0], [-1.0]])),
    "a further key": change_summary(lambda summary: summary.update(further=1.0)),
    "other seconds": change_summary(lambda summary: summary.update(seconds=1e3)),
    "other size": change_summary(lambda summary: summary["size"].update(cells=7)),
}
DIFFERENCES = {
    "beyond the errors": (by_errors(2.0), "summary.modes.omega[1]"),
    "a word": (change_summary(lambda summary: summary["modes"][0].update(kind="elastic")), "summary.modes.kind"),
    "a key less": (change_summary(lambda summary: summary.pop("zero_modes")), "summary.zero_modes"),
    "a mode less": (change_summary(lambda summary: summary["modes"].pop()), "summary.modes.omega"),
    "a table": (change_table, "modes.csv: omega"),
    "a shape": (change_dataset(lambda wave: 1.01 * wave), "dataset.nc: elevation_of_free_surface_1"),
    "a file less": (lose_file, "files"),
}


def changed(before: Path, after: Path, change: Callable[[Path], None]) -> str:
    shutil.copytree(before, after)
    (after / "record.json").unlink()
    change(after / "results")
    return "\n".join(differences(read_record(before), read_record(after)))


@pytest.mark.parametrize("change", NO_DIFFERENCE.values(), ids=NO_DIFFERENCE)
def test_what_is_not_promised_is_no_difference(before: Path, tmp_path: Path, change: Callable[[Path], None]) -> None:
    assert changed(before, tmp_path / "after", change) == ""


@pytest.mark.parametrize(("change", "said"), DIFFERENCES.values(), ids=DIFFERENCES)
def test_what_changed_is_found(before: Path, tmp_path: Path, change: Callable[[Path], None], said: str) -> None:
    assert said in changed(before, tmp_path / "after", change)


def test_modes_of_one_frequency_are_compared_as_the_space_that_they_span() -> None:
    angle = np.radians(30.0)
    x = np.linspace(0.0, 1.0, 9)
    shapes = np.array([np.cos(x), np.sin(x), x])
    turned = np.array([[np.cos(angle), np.sin(angle), 0.0], [-np.sin(angle), np.cos(angle), 0.0], [0.0, 0.0, -1.0]])
    entry = {"shape": [3, 9], "largest": 1.0, "error": 1e-9, "signed": False}
    old = {"shapes": entry | {"values": shapes.tolist(), "groups": [[0, 1]]}}
    new = {"shapes": entry | {"values": (turned @ shapes).tolist(), "groups": [[0, 1]]}}
    assert list(differences(old, new)) == []
    apart = {"shapes": {key: value for key, value in new["shapes"].items() if key != "groups"}}
    alone = {"shapes": {key: value for key, value in old["shapes"].items() if key != "groups"}}
    assert list(differences(alone, apart))
