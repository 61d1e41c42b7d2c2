"""The committed benchmark is of the tanks, cases and columns as they stand."""

import csv
import runpy
from pathlib import Path

import pytest

from hydroelastic.benchmarks import output
from hydroelastic.benchmarks.buoy.cases import BUOYS, buoy_cases
from hydroelastic.benchmarks.buoy.report import BUOY_COLUMNS
from hydroelastic.benchmarks.circle.cases import CIRCLE, circle_cases
from hydroelastic.benchmarks.circle.report import CIRCLE_COLUMNS
from hydroelastic.benchmarks.measure import cases_of
from hydroelastic.benchmarks.string.cases import MOTIONS, string_cases
from hydroelastic.benchmarks.string.report import STRING_COLUMNS
from hydroelastic.benchmarks.sweep.cases import SWEEPS, sweep_cases
from hydroelastic.benchmarks.sweep.report import SWEEP_COLUMNS
from hydroelastic.benchmarks.tank.cases import TANKS
from hydroelastic.benchmarks.tank.report import CSV_COLUMNS
from hydroelastic.benchmarks.thread.cases import THREADS, thread_cases
from hydroelastic.benchmarks.thread.report import THREAD_COLUMNS

FOLDER = Path(__file__).parent.parent / "results" / "benchmarks"


@pytest.fixture(scope="module")
def rows() -> list[dict[str, str]]:
    with (FOLDER / f"{output.TANKS.name}.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_every_case_was_measured(rows: list[dict[str, str]]) -> None:
    assert tuple(rows[0]) == CSV_COLUMNS
    measured = [
        (row["code"], row["tank"], row["variant"], int(row["degree"] or 0), float(row["tolerance"] or 0.0))
        for row in rows
    ]
    assert measured == [
        (case.code, case.tank, case.variant, case.degree, case.tolerance)
        for tank in TANKS
        for case in cases_of(tank, quick=False)
    ]


def test_hydroelastic_kept_every_tolerance_asked(rows: list[dict[str, str]]) -> None:
    own = [row for row in rows if row["code"] == "hydroelastic"]
    assert all(float(row["error"]) <= float(row["tolerance"]) for row in own)


def test_page_and_figure_are_there() -> None:
    assert "Milliseconds at equal error" in (FOLDER / f"{output.TANKS.name}.md").read_text(encoding="utf-8")
    assert (FOLDER / f"{output.TANKS.name}.png").stat().st_size > 10_000


def test_every_case_of_sweeps_was_measured_and_kept_its_tolerance() -> None:
    with (FOLDER / f"{output.SWEEPS.name}.csv").open(encoding="utf-8", newline="") as file:
        found = list(csv.DictReader(file))
    assert tuple(found[0]) == SWEEP_COLUMNS
    assert [(row["code"], row["sweep"], row["variant"]) for row in found] == [
        (case.code, case.tank, case.variant) for sweep in SWEEPS for case in sweep_cases(sweep, quick=False)
    ]
    assert all(float(row["error"]) <= float(row["tolerance"]) for row in found if row["code"] == "sweep")


@pytest.fixture(scope="module")
def circle_rows() -> list[dict[str, str]]:
    with (FOLDER / f"{output.CIRCLE.name}.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_every_case_of_the_circle_was_measured(circle_rows: list[dict[str, str]]) -> None:
    assert tuple(circle_rows[0]) == CIRCLE_COLUMNS
    measured = [
        (
            *(row["code"], row["frequency"], row["variant"]),
            *(float(row["length"] or 0.0), int(row["panels"] or 0), float(row["tolerance"] or 0.0)),
        )
        for row in circle_rows
    ]
    assert measured == [
        (case.code, case.tank, case.variant, case.length, case.panels, case.tolerance)
        for frequency in CIRCLE
        for case in circle_cases(frequency, quick=False)
    ]


def test_hydroelastic_kept_every_tolerance_of_the_circle(circle_rows: list[dict[str, str]]) -> None:
    own = [row for row in circle_rows if row["code"] == "hydroelastic radiation"]
    assert all(float(row["error"]) <= float(row["tolerance"]) for row in own)


def test_page_and_figure_of_the_circle_are_there() -> None:
    assert "not a comparison of like with like" in (FOLDER / f"{output.CIRCLE.name}.md").read_text(encoding="utf-8")
    assert (FOLDER / f"{output.CIRCLE.name}.png").stat().st_size > 10_000


def test_every_buoy_was_measured_and_every_tolerance_kept() -> None:
    with (FOLDER / f"{output.BUOYS.name}.csv").open(encoding="utf-8", newline="") as file:
        found = list(csv.DictReader(file))
    assert tuple(found[0]) == BUOY_COLUMNS
    keys = ("panels", "terms", "tolerance")
    assert [(row["code"], row["buoy"], row["variant"], *(float(row[key] or 0.0) for key in keys)) for row in found] == [
        (case.code, case.tank, case.variant, case.panels, case.terms, case.tolerance)
        for buoy in BUOYS
        for case in buoy_cases(buoy, quick=False)
    ]
    own = [row for row in found if row["code"] == "hydroelastic buoy"]
    assert all(float(row["error"]) <= float(row["tolerance"]) for row in own)
    assert (FOLDER / f"{output.BUOYS.name}.png").stat().st_size > 10_000


@pytest.fixture(scope="module")
def string_rows() -> list[dict[str, str]]:
    with (FOLDER / f"{output.STRING.name}.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_every_case_of_the_string_was_measured(string_rows: list[dict[str, str]]) -> None:
    assert tuple(string_rows[0]) == STRING_COLUMNS
    measured = [
        (row["code"], row["motion"], float(row["tolerance"] or 0.0), int(row["terms"] or 0)) for row in string_rows
    ]
    assert measured == [
        (case.code, case.tank, case.tolerance, case.terms)
        for motion in MOTIONS
        for case in string_cases(motion, quick=False)
    ]


def test_field_and_series_kept_every_tolerance_of_the_string(string_rows: list[dict[str, str]]) -> None:
    own = [row for row in string_rows if row["tolerance"]]
    assert all(float(row["error"]) <= float(row["tolerance"]) for row in own)


def test_page_and_figure_of_the_string_are_there() -> None:
    assert "cut sharply" in (FOLDER / f"{output.STRING.name}.md").read_text(encoding="utf-8")
    assert (FOLDER / f"{output.STRING.name}.png").stat().st_size > 10_000


@pytest.fixture(scope="module")
def thread_rows() -> list[dict[str, str]]:
    with (FOLDER / f"{output.THREADS.name}.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_every_case_of_threads_was_measured(thread_rows: list[dict[str, str]]) -> None:
    assert tuple(thread_rows[0]) == THREAD_COLUMNS
    measured = [
        (
            *(row["code"], row["thread"], row["variant"]),
            *(int(row["segments"] or 0), float(row["step"] or 0.0), float(row["tolerance"] or 0.0)),
        )
        for row in thread_rows
    ]
    assert measured == [
        (case.code, case.tank, case.variant, case.segments, case.step, case.tolerance)
        for thread in THREADS
        for case in thread_cases(thread, quick=False)
    ]


def test_field_kept_every_tolerance_of_threads_at_rest(thread_rows: list[dict[str, str]]) -> None:
    # In motion the tolerance is that of positions, and the error that of a tension, which no tolerance bounds.
    own = [row for row in thread_rows if row["code"] == "thread field" and row["thread"] != "jumper moved"]
    assert all(float(row["error"]) <= float(row["tolerance"]) for row in own if row["tolerance"])


def test_page_and_figure_of_threads_are_there() -> None:
    assert "Flexible threads" in (FOLDER / f"{output.THREADS.name}.md").read_text(encoding="utf-8")
    assert (FOLDER / f"{output.THREADS.name}.png").stat().st_size > 10_000


def test_pages_have_the_tables_of_the_committed_measurements() -> None:
    pages = runpy.run_path(str(FOLDER.parent / "page_tables.py"))["pages"]()
    assert {page.name for page in pages} == {"speed_against_error.md", "performance.md"}
    for page, content in pages.items():
        assert page.read_text(encoding="utf-8") == content
