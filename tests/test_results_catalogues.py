"""The measured catalogues and studies in results/ are of the cases as they stand, true, and small."""

import csv
import importlib
import json
import sys
from pathlib import Path
from typing import Any

import hard_cases
import pytest
import random_threads

from hydroelastic.output.manifest import read_manifest
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.result import solve
from hydroelastic.scenes.study.plan import StudyPlan
from hydroelastic.scenes.study.run import study_scene

ROOT = Path(__file__).parent.parent
RESULTS = ROOT / "results"
FLOATS = json.loads((ROOT / "tests" / "reference" / "floats.json").read_text(encoding="utf-8"))["cases"]
LARGEST = 12 * 2**20
# Estimates and errors follow the mesh, and the mesh the release of gmsh.
ALIKE = 10.0


def rows_of(path: str) -> list[dict[str, str]]:
    with (RESULTS / path).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def script(name: str) -> Any:
    """A script of results/, under a name of its own: some of them are called like the catalogue that they measure."""
    specification = importlib.util.spec_from_file_location(f"results_{name}", RESULTS / f"{name}.py")
    assert specification is not None
    assert specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(RESULTS))
        patch.setitem(sys.modules, specification.name, module)
        # Of a catalogue that has the script's own name.
        patch.setitem(sys.modules, name, sys.modules.get(name, module))
        specification.loader.exec_module(module)
    return module


def assert_alike(stored: dict[str, str], measured: dict[str, Any], *columns: str) -> None:
    for column in columns:
        if isinstance(measured[column], float):
            ratio = float(stored[column]) / measured[column]
            assert 1.0 / ALIKE < ratio < ALIKE, column
        else:
            assert stored[column] == str(measured[column]), column


@pytest.mark.parametrize("folder", ["hard_cases", "float_cases"])
def test_tanks_keep_their_tolerances(folder: str) -> None:
    rows = rows_of(f"{folder}/{folder}.csv")
    names = [case.name for case in hard_cases.CASES] if folder == "hard_cases" else list(FLOATS)
    assert [(row["case"], float(row["tolerance"])) for row in rows] == [
        (name, tolerance) for name in names for tolerance in hard_cases.TOLERANCES
    ]
    for row in rows:
        assert row["status"] == "ok", row
        assert float(row["true_error"]) <= float(row["tolerance"])
        # What docs/hard_cases.md claims, but where references and rounding end.
        assert float(row["estimate"]) >= float(row["true_error"]) / 3.0 or float(row["true_error"]) < 1e-12
    page = (RESULTS / folder / f"{folder}.md").read_text(encoding="utf-8")
    assert all(f"| `{name}` |" in page for name in names)


def test_tanks_in_three_dimensions_keep_their_tolerances() -> None:
    rows = rows_of("level_cases/level_cases.csv")
    cases = script("level_cases").CASES
    assert [(row["case"], float(row["tolerance"])) for row in rows] == [
        (name, tolerance) for name, case in cases.items() for tolerance in case.tolerances
    ]
    for row in rows:
        assert row["status"] == "ok", row
        assert float(row["true_error"]) <= float(row["tolerance"])
        assert float(row["estimate"]) >= float(row["true_error"]) / 3.0
    page = (RESULTS / "level_cases" / "level_cases.md").read_text(encoding="utf-8")
    assert all(f"| {name} |" in page for name in cases)


def test_a_hard_case_measured_anew() -> None:
    case = next(case for case in hard_cases.CASES if case.name == "tip_1e-04_from_the_wall")
    reference = json.loads((ROOT / "tests" / "reference" / "hard_cases.json").read_text(encoding="utf-8"))["cases"]
    found = script("hard_cases").measured(case, 1e-6, reference[case.name])
    (stored,) = (r for r in rows_of("hard_cases/hard_cases.csv") if (r["case"], r["tolerance"]) == (case.name, "1e-06"))
    assert_alike(stored, found, "status", "modes", "true_error", "estimate", "pressure_release_estimate")


def test_a_float_measured_anew() -> None:
    found = script("float_cases").measured("two_liquids_wedge", FLOATS["two_liquids_wedge"], 1e-6)
    rows = rows_of("float_cases/float_cases.csv")
    (stored,) = (row for row in rows if (row["case"], row["tolerance"]) == ("two_liquids_wedge", "1e-06"))
    assert_alike(stored, found, "status", "modes", "true_error", "estimate")


def test_all_random_threads_are_found_under_tension() -> None:
    rows = rows_of("thread_cases/thread_cases.csv")
    assert [(row["kind"], int(row["number"])) for row in rows] == random_threads.all_numbers()
    assert {row["status"] for row in rows} == {"ok"}
    # At a free tail it is zero, but for rounding.
    assert all(float(row["smallest_tension"]) > -1e-12 for row in rows if row["kind"] != "bending")
    compared = [row for row in rows if row["true_error"]]
    assert len(compared) > 50
    integration = script("thread_cases").INTEGRATION
    assert all(float(row["true_error"]) <= float(row["estimate"]) + integration for row in compared)


@pytest.mark.parametrize("kind", ["free", "slack"])
def test_a_random_thread_measured_anew(kind: str) -> None:
    found = script("thread_cases").measured(kind, 0)
    stored = next(row for row in rows_of("thread_cases/thread_cases.csv") if row["kind"] == kind)
    assert_alike(stored, found, "status", "start", "smallest_tension", "estimate")


def test_stages_of_the_start_are_those_of_a_run() -> None:
    rows = rows_of("start_up/start_up.csv")
    stages = [row["stage"] for row in rows if not row["stage"].startswith(("import of", "total"))]
    assert set(stages) <= set(script("start_up").WHAT)
    shipped = json.loads((RESULTS / "shipped" / "aquarium" / "summary.json").read_text(encoding="utf-8"))
    assert set(stages) >= set(shipped["timing"])
    for column in ("cold_seconds", "warm_seconds"):
        # The least of each stage: together they take no longer than the fastest run.
        (total,) = (float(row[column]) for row in rows if row["stage"] == "total")
        rounding = 0.0005 * len(stages)
        assert sum(float(row[column]) for row in rows if row["stage"] in stages) <= total + rounding


@pytest.mark.slow
@pytest.mark.parametrize("name", script("regenerate").STUDIED)
def test_studies_are_those_of_the_scenes(name: str) -> None:
    """Rows of coarse meshes and few digits, which take a second."""
    stored = rows_of(f"shipped/{name}/study.csv")
    plan = StudyPlan(degrees=(1, 2), halvings=2, geometric_degrees=(4,), tolerances=(1e-4,))
    for row in study_scene(read_scene(name), plan).rows:
        (same,) = (
            other
            for other in stored
            if (other["family"], int(other["degree"]), float(other["tolerance"] or 0.0))
            == (row.family, row.degree, row.tolerance or 0.0)
            and float(other["element_size"]) == pytest.approx(row.element_size)
        )
        assert 1.0 / ALIKE < float(same["error"]) / max(row.error, row.floor) < ALIKE


def kept_folders() -> list[Path]:
    """The folders that belong to the project: not those of runs that a reader has made here."""
    found = [folder for folder in RESULTS.iterdir() if folder.is_dir() and folder.name != "__pycache__"]
    return [folder for folder in found if read_manifest(folder) is None]


def test_every_folder_is_on_the_page() -> None:
    page = (RESULTS / "README.md").read_text(encoding="utf-8")
    assert [folder.name for folder in kept_folders() if f"| `{folder.name}/" not in page] == []


def test_all_of_it_is_small() -> None:
    files = [file for folder in kept_folders() for file in folder.rglob("*") if file.is_file()]
    assert sum(file.stat().st_size for file in files) < LARGEST


def test_the_list_of_scenes_is_that_of_their_results() -> None:
    assert (RESULTS / "shipped" / "README.md").read_text(encoding="utf-8") == script("regenerate").index()


def test_a_veering_of_the_sweep_measured_anew() -> None:
    stored = rows_of("sweeps/aquarium_position/encounters.csv")
    assert {row["kind"] for row in stored} == {"veering"}
    veering = min(stored, key=lambda row: float(row["omega"]))
    # The tank has no symmetry but in the middle, so that branches are modes in their order.
    low, high = (int(veering[f"{side}_branch"]) - 1 for side in ("lower", "upper"))
    scene = read_scene("aquarium", {"body.1.start": float(veering["body.1.start"]), "accuracy.modes": high + 1})
    omega = solve(scene).modes.omega
    # The stored gap is that of a parabola through three points 0.15 m apart.
    assert omega[high] - omega[low] == pytest.approx(float(veering["gap"]), rel=0.01)
