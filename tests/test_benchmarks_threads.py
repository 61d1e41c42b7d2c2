"""The benchmark's flexible threads: what is exact, the codes, what is written."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import numpy as np
import pytest
from thread_cases import inputs, results
from thread_shooting import shoot

from hydroelastic.benchmarks.cases import Case, Code
from hydroelastic.benchmarks.measure import Benchmark
from hydroelastic.benchmarks.output import THREADS as OUTPUT
from hydroelastic.benchmarks.output import write_results
from hydroelastic.benchmarks.peers import PeerError, peer_folder
from hydroelastic.benchmarks.rows import Row, row_of
from hydroelastic.benchmarks.thread import hydroelastic as hydroelastic_thread
from hydroelastic.benchmarks.thread.cases import (
    CHAIN,
    JUMPER,
    LINES_AT_REST,
    PERIOD,
    SWING,
    THREADS,
    jumper_tension,
    tension_difference,
    thread_cases,
    thread_error,
    top_displacement,
)
from hydroelastic.benchmarks.thread.report import THREAD_COLUMNS, threads_csv, threads_markdown
from hydroelastic.benchmarks.workers import start_worker
from hydroelastic.modal.thread.catenary import elastic_catenary
from hydroelastic.physics.stream import ShearedStream
from hydroelastic.physics.thread_load import ThreadLoad

_REFERENCE = Path(__file__).parent / "reference"


def rows_of(name: str) -> list[dict[str, str]]:
    lines = (_REFERENCE / name).read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def test_catenaries_are_those_of_moorpy() -> None:
    for row in rows_of("moorpy_catenaries.csv"):
        x, z, length, rigidity, weight = (float(row[name]) for name in ("x", "z", "L", "EA", "w"))
        shape = elastic_catenary((0, 0, 0), (x, 0, z), length, weight, rigidity, [0.0, length])
        expected = np.array([[float(row[f"f{end}{way}"]) for way in "HV"] for end in "AB"])
        # MoorPy's own tests allow 1e-5.
        assert np.abs(shape.forces[:, [0, 2]] * [[1], [-1]] - expected).max() < 1e-5 * np.abs(expected).max()


def test_the_jumper_at_rest_is_that_of_other_programs() -> None:
    a_x, a_z, b_x, b_z = LINES_AT_REST["jumper at rest"].exact
    own = {
        "top_tension": np.hypot(b_x, b_z),
        "bottom_tension": np.hypot(a_x, a_z),
        "vertical_top": b_z,
        "horizontal_top": b_x,
        "vertical_bottom": -a_z,
    }
    for row in rows_of("jumper_static.csv"):
        # Four digits are given, and 26.6 for 26.63; both are elastic catenaries.
        assert float(row["FRyDoM"]) == pytest.approx(own[row["quantity"]] / 1e3, abs=0.006)
        assert float(row["catenary"]) == pytest.approx(own[row["quantity"]] / 1e3, abs=0.03)
        # With bending stiffness, by elements: 1.2 % at the most.
        assert float(row["OrcaFlex"]) == pytest.approx(own[row["quantity"]] / 1e3, rel=0.015)
        assert float(row["DeepLines"]) == pytest.approx(own[row["quantity"]] / 1e3, rel=0.015)


@pytest.mark.parametrize("name", ["uniform stream", "sheared stream"])
def test_exact_forces_in_a_stream_are_those_of_shooting(name: str) -> None:
    line, given = LINES_AT_REST[name], inputs("S12")
    stream = ShearedStream((line.stream, 0.0, 0.0), (line.shear, 0.0, 0.0), line.a[1])
    load = ThreadLoad(weight=line.weight, normal_drag=given["kn"], tangential_drag=given["kt"], stream=stream)
    ends = [(place[0], 0.0, place[1]) for place in (line.a, line.b)]
    found = shoot(load, line.length, *ends, line.axial_rigidity, (line.exact[0], 0.0, line.exact[1]))
    assert thread_error(name, tuple(found.forces([0.0, line.length])[:, [0, 2]].ravel())) < 1e-11


def test_the_line_in_the_stream_and_the_chain_are_reference_cases() -> None:
    line, given, known = LINES_AT_REST["sheared stream"], inputs("S12"), results("S12")
    assert line.exact == (known["N_A"][0], known["N_A"][2], known["N_B"][0], known["N_B"][2])
    assert 0.5 * line.density * line.normal_drag * line.diameter == pytest.approx(given["kn"], rel=1e-14)
    assert 0.5 * line.density * np.pi * line.tangential_drag * line.diameter == pytest.approx(given["kt"], rel=1e-14)
    chain = inputs("D05")
    assert tuple(results("D05")["tip"]) == CHAIN.exact
    assert (CHAIN.weight, CHAIN.mass, CHAIN.tip_mass, CHAIN.tip_weight) == (
        *(chain["w"], chain["m"], chain["M_tip"], chain["W_tip"]),
    )
    assert (CHAIN.normal_drag, CHAIN.tangential_drag, CHAIN.added_mass) == (chain["kn"], chain["kt"], chain["ma"])


def test_the_top_of_the_jumper_swings_when_the_ramp_is_over() -> None:
    assert top_displacement(0.0) == 0.0
    assert top_displacement(2.25 * PERIOD) == pytest.approx(10.0)
    # Half of the way up the ramp of fifth degree.
    assert top_displacement(0.25 * PERIOD) == pytest.approx(10.0 * (10 - 15 / 4 + 6 / 16) / 64)


def test_three_opinions_on_the_jumper_agree() -> None:
    # MoorDyn comes to the field's tensions in proportion to its segments, of which the fine run has 272: 2.4e-4.
    assert 1e-5 < tension_difference(jumper_tension("MoorDyn")) < 3e-4
    # Digitised, with bending stiffness: measured 6.1e-3.
    assert 1e-3 < tension_difference(jumper_tension("OrcaFlex")) < 1e-2


def test_errors_are_relative_to_the_largest() -> None:
    exact = LINES_AT_REST["catenary"].exact
    largest = float(np.hypot(exact[2], exact[3]))
    assert thread_error("catenary", (exact[0] + 1e-3 * largest, *exact[1:])) == pytest.approx(1e-3)
    assert thread_error(SWING, (CHAIN.exact[0] + 3e-3, CHAIN.exact[1] + 4e-3, *CHAIN.exact[2:])) == pytest.approx(5e-3)
    tension = jumper_tension("field").copy()
    tension[7] += 1e-3 * tension.max()
    assert thread_error(JUMPER, tuple(tension)) == pytest.approx(1e-3)


@pytest.mark.slow_but("[!j]*")
@pytest.mark.parametrize(
    ("case", "least", "most"),
    [
        (Case(code="thread catenary", tank="catenary", variant="closed form"), -1.0, 1e-15),
        (Case(code="thread field", tank="sheared stream", variant="certified", tolerance=1e-8), 0.0, 1e-8),
        # Steps of second order leave 2e-3 (measured), whatever the elements.
        (Case(code="thread field", tank=JUMPER, variant="one run", segments=4, step=0.5), 5e-4, 5e-3),
        (Case(code="thread field", tank=SWING, variant="one run", segments=4, step=0.05), 1e-3, 1e-2),
    ],
    ids=lambda value: f"{value.tank}" if isinstance(value, Case) else "",
)
def test_hydroelastic_comes_to_the_exact_values(case: Case, least: float, most: float) -> None:
    answer = hydroelastic_thread.solve(case)
    assert least < row_of(case, [answer], (1.0,)).error < most


@pytest.mark.slow_but("moorpy-catenary-*")
@pytest.mark.parametrize(
    ("code", "name", "bounds"),
    [
        # Measured with 1.3.0: 2e-5 for a displacement of 1 cm, in a stream 1.5e-1 and 5.0e-2.
        ("moorpy", "catenary", (1e-4,)),
        ("moorpy", "uniform stream", (2e-1, 7e-2)),
        # Measured with 2.7.2: 1.2e-2 and 3.4e-3; 1.0e-2 and 2.7e-3, of second order.
        ("moordyn", "sheared stream", (1.5e-2, 5e-3)),
        ("moordyn", SWING, (1.5e-2, 4e-3)),
    ],
)
def test_peers_come_near(code: Code, name: str, bounds: tuple[float, ...]) -> None:
    try:
        folder = peer_folder(code, install=False, report=lambda _message: None)
    except PeerError as error:
        pytest.skip(f"{error}; `./hydro bench` installs it")
    cases = [case for case in thread_cases(name, quick=False) if case.code == code]
    with start_worker(code, folder) as worker:
        for case, bound in zip(cases, bounds, strict=False):
            assert thread_error(name, tuple(worker.solve(case)[1].values)) < bound


ROWS = [
    Row(case=case, unknowns=10, error=1e-3 / (1 + number), seconds=(0.1, 0.2), stages={}, note="a note")
    for number, case in enumerate(case for name in THREADS for case in thread_cases(name, quick=True))
]
BENCHMARK = Benchmark(rows=tuple(ROWS), not_measured={}, versions={"moordyn": {"MoorDyn": "2.7"}}, repeats=2)


@pytest.mark.slow
def test_all_rows_are_written(tmp_path: Path) -> None:
    rows = list(csv.DictReader(io.StringIO(threads_csv(BENCHMARK))))
    assert tuple(rows[0]) == THREAD_COLUMNS
    assert [float(row["error"]) for row in rows] == [row.error for row in ROWS]
    page = threads_markdown(BENCHMARK)
    assert "| MoorDyn | 2.4e-04 |" in page
    assert "MoorDyn 2.7" in page
    assert all(f"### {name}" in page for name in THREADS)
    write_results(BENCHMARK, tmp_path, OUTPUT)
    assert {path.name for path in tmp_path.iterdir()} == {f"{OUTPUT.name}.{end}" for end in ("csv", "md", "png")}


def test_a_quick_run_has_few_cases() -> None:
    for name in THREADS:
        quick, whole = thread_cases(name, quick=True), thread_cases(name, quick=False)
        assert set(quick) < set(whole)
        assert {case.code for case in quick} == {case.code for case in whole}
