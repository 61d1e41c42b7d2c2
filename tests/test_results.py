"""What is committed in results/ is of the scenes and cases as they stand, true, and small."""

import csv
import importlib
import json
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import hard_cases
import numpy as np
import pytest
import random_threads

import hydroelastic as he

ROOT = Path(__file__).parent.parent
RESULTS = ROOT / "results"
SHIPPED = RESULTS / "shipped"
KINDS = {scene.name: he.read(scene.name).kind for scene in he.shipped_scenes()}
FLOATS = json.loads((ROOT / "tests" / "reference" / "floats.json").read_text(encoding="utf-8"))["cases"]
LARGEST = 12 * 2**20
# Estimates and errors follow the mesh, and the mesh the release of gmsh.
ALIKE = 10.0
# Of those in three dimensions.
WITHOUT_PICTURES = {"barge_in_a_dock", "ring_pontoon", "scow_in_a_basin", "sloping_basin", "two_plates"}


@cache
def stored_of(name: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((SHIPPED / name / "summary.json").read_text(encoding="utf-8"))
    return found


def rows_of(path: str) -> list[dict[str, str]]:
    with (RESULTS / path).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


@cache
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


# --- shipped scenes


def test_every_shipped_scene_has_its_results_and_no_other() -> None:
    assert {path.name for path in SHIPPED.iterdir() if path.is_dir()} == set(KINDS)
    assert (SHIPPED / "README.md").read_text(encoding="utf-8") == script("regenerate").index()


@pytest.mark.parametrize("name", KINDS)
def test_results_are_of_the_scene_as_it_stands(name: str) -> None:
    assert stored_of(name)["scene"] == he.read(name).model_dump(mode="json")
    assert stored_of(name)["status"] == "ok"
    files = list((SHIPPED / name).iterdir())
    assert {"summary.json", "summary.md"} < {file.name for file in files}
    assert name in WITHOUT_PICTURES or any(file.suffix == ".png" for file in files)
    assert all(file.stat().st_size > 100 for file in files)


def pairs(old: Any, new: Any) -> Iterator[tuple[dict[str, Any], dict[str, Any]]]:
    """All tables of two summaries that stand at the same place."""
    if isinstance(old, dict) and isinstance(new, dict):
        yield old, new
        for key in old.keys() & new.keys():
            yield from pairs(old[key], new[key])
    elif isinstance(old, list) and isinstance(new, list):
        for one, other in zip(old, new, strict=True):
            yield from pairs(one, other)


# Values, and the key beside them that holds their relative error.
VALUES = {
    "omega": "relative_error",
    "factor": "relative_error",
    "largest_displacement": "relative_error",
    "largest_angle": "relative_error",
    "added_mass_per_length": "added_mass_relative_error",
    "added_mass_per_area": "added_mass_relative_error",
    "pressure_release_omega": "pressure_release_relative_error",
}
# Of open water, whose errors are below the tolerance that is asked for.
TABLES = ("added_mass", "radiation_damping", "excitation_force", "amplitudes", "reflection", "transmission")


def different(old: dict[str, Any], new: dict[str, Any], tolerance: float) -> Iterator[str]:
    for one, other in pairs(old, new):
        for key in one.keys() & other.keys():
            if key in VALUES and isinstance(one[key], float) and isinstance(one.get(VALUES[key]), float):
                # Both carry an estimated error; the rest is rounding.
                allowed = one[VALUES[key]] + other[VALUES[key]] + 1e-12
                if abs(one[key] - other[key]) > allowed * abs(other[key]):
                    yield f"{key}: {one[key]} is {other[key]}"
            elif key in TABLES and one[key] is not None:
                values = np.array(other[key], dtype=float)
                if np.abs(np.array(one[key], dtype=float) - values).max() > 2.0 * tolerance * np.abs(values).max():
                    yield key
            elif key in ("kind", "order", "multiplicity", "zero_modes", "index", "symmetry") and one[key] != other[key]:
                yield f"{key}: {one[key]} is {other[key]}"


@pytest.mark.slow_but("aquarium", "string_smooth", "swell")
@pytest.mark.parametrize("name", KINDS)
def test_results_are_true(name: str) -> None:
    scene = he.read(name)
    old, new = stored_of(name), he.solve(scene).summary
    assert list(different({**old, "scene": None}, {**new, "scene": None}, scene.accuracy.tolerance)) == []
    if KINDS[name] == "thread":
        rest, again = old["equilibrium"], new["equilibrium"]
        allowed = rest["position_error"] + again["position_error"] + 1e-12 * scene.thread.length
        assert np.array(rest["end_positions"]) == pytest.approx(np.array(again["end_positions"]), abs=allowed)
        allowed = rest["tension_error"] + again["tension_error"] + 1e-12 * max(abs(rest["largest_tension"]), 1.0)
        assert rest["end_tensions"] == pytest.approx(again["end_tensions"], abs=allowed)


# --- catalogues


@pytest.mark.parametrize("folder", ["hard_cases", "float_cases", "level_cases"])
def test_tanks_keep_their_tolerances(folder: str) -> None:
    rows = rows_of(f"{folder}/{folder}.csv")
    if folder == "level_cases":
        asked = [(name, one) for name, case in script(folder).CASES.items() for one in case.tolerances]
    else:
        names = [case.name for case in hard_cases.CASES] if folder == "hard_cases" else list(FLOATS)
        asked = [(name, one) for name in names for one in hard_cases.TOLERANCES]
    assert [(row["case"], float(row["tolerance"])) for row in rows] == asked
    for row in rows:
        assert row["status"] == "ok", row
        assert float(row["true_error"]) <= float(row["tolerance"])
        # What docs/hard_cases.md claims, but where references and rounding end.
        assert float(row["estimate"]) >= float(row["true_error"]) / 3.0 or float(row["true_error"]) < 1e-12


def assert_alike(stored: dict[str, str], measured: dict[str, Any], *columns: str) -> None:
    for column in columns:
        if isinstance(measured[column], float):
            ratio = float(stored[column]) / measured[column]
            assert 1.0 / ALIKE < ratio < ALIKE, column
        else:
            assert stored[column] == str(measured[column]), column


@pytest.mark.slow_but("free")
@pytest.mark.parametrize("kind", ["hard", "float", "free", "slack"])
def test_a_case_measured_anew(kind: str) -> None:
    if kind == "hard":
        case = next(case for case in hard_cases.CASES if case.name == "tip_1e-04_from_the_wall")
        reference = json.loads((ROOT / "tests/reference/hard_cases.json").read_text(encoding="utf-8"))["cases"]
        found = script("hard_cases").measured(case, 1e-6, reference[case.name])
        rows = [row for row in rows_of("hard_cases/hard_cases.csv") if row["case"] == case.name]
        columns = ("status", "modes", "true_error", "estimate", "pressure_release_estimate")
    elif kind == "float":
        found = script("float_cases").measured("two_liquids_wedge", FLOATS["two_liquids_wedge"], 1e-6)
        rows = [row for row in rows_of("float_cases/float_cases.csv") if row["case"] == "two_liquids_wedge"]
        columns = ("status", "modes", "true_error", "estimate")
    else:
        found = script("thread_cases").measured(kind, 0)
        rows = [row for row in rows_of("thread_cases/thread_cases.csv") if row["kind"] == kind]
        columns = ("status", "start", "smallest_tension", "estimate")
    assert_alike(next(row for row in rows if row.get("tolerance", "1e-06") == "1e-06"), found, *columns)


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


@pytest.mark.slow
@pytest.mark.parametrize("name", script("regenerate").STUDIED)
def test_studies_are_those_of_the_scenes(name: str) -> None:
    """Rows of coarse meshes and few digits, which take a second."""
    stored = rows_of(f"shipped/{name}/study.csv")
    study = he.study(name, degrees=[1, 2], halvings=2, geometric_degrees=[4], tolerances=[1e-4])
    for row in csv.DictReader(study.csv.splitlines()):
        key = ("family", "degree", "tolerance")
        (same,) = (
            other
            for other in stored
            if [other[name] for name in key] == [row[name] for name in key]
            and float(other["element_size"]) == pytest.approx(float(row["element_size"]))
        )
        # Rounding of eigenvalues ends what can be compared.
        assert 1.0 / ALIKE < (float(same["error"]) + 1e-12) / (float(row["error"]) + 1e-12) < ALIKE


@pytest.mark.slow
def test_a_veering_of_the_sweep_measured_anew() -> None:
    stored = rows_of("sweeps/aquarium_position/encounters.csv")
    assert {row["kind"] for row in stored} == {"veering"}
    veering = min(stored, key=lambda row: float(row["omega"]))
    # The tank has no symmetry but in the middle, so that branches are modes in their order.
    low, high = (int(veering[f"{side}_branch"]) - 1 for side in ("lower", "upper"))
    changes = {"body.1.start": float(veering["body.1.start"]), "accuracy.modes": high + 1}
    omega = he.solve(he.read("aquarium", changes)).modes.omega
    # The stored gap is that of a parabola through three points 0.15 m apart.
    assert omega[high] - omega[low] == pytest.approx(float(veering["gap"]), rel=0.01)


def test_every_folder_is_on_the_page_and_all_of_it_is_small() -> None:
    page = (RESULTS / "README.md").read_text(encoding="utf-8")
    # Not the folders of runs that a reader has made here.
    folders = [folder for folder in RESULTS.iterdir() if folder.is_dir() and folder.name != "__pycache__"]
    folders = [folder for folder in folders if not (folder / "summary.json").is_file()]
    assert [folder.name for folder in folders if f"| `{folder.name}/" not in page] == []
    files = [file for folder in folders for file in folder.rglob("*") if file.is_file()]
    assert sum(file.stat().st_size for file in files) < LARGEST
