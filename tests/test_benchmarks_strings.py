"""The benchmark's hanging string: what is exact, the methods, what is written."""

import csv
import io
from pathlib import Path

import numpy as np
import pytest
from string_bromwich import bromwich, ramp_image, sine_image, smooth_image, step_image

from hydroelastic.benchmarks.cases import Case
from hydroelastic.benchmarks.measure import Benchmark
from hydroelastic.benchmarks.output import STRING as OUTPUT
from hydroelastic.benchmarks.output import write_results
from hydroelastic.benchmarks.rows import Row, row_of
from hydroelastic.benchmarks.string import hydroelastic as hydroelastic_string
from hydroelastic.benchmarks.string.cases import MOTIONS, compared, exact, string_cases, string_error, string_scene
from hydroelastic.benchmarks.string.report import STRING_COLUMNS, strings_csv, strings_markdown

IMAGES = {
    "smooth": smooth_image(1.0, 4.0),
    "ramp": ramp_image(1.0),
    "sine": sine_image(1.0, 8.0),
    "step": step_image(1.0),
}


@pytest.mark.parametrize("motion", MOTIONS)
def test_exact_values_are_those_of_a_bromwich_integral(motion: str) -> None:
    scene, values = string_scene(motion, 1e-6, "series"), exact(motion)
    places = np.argwhere(compared(motion))
    moving = np.flatnonzero(values)
    for number in moving[:: len(moving) // 5]:
        position, time = scene.positions[places[number][0]], scene.times[places[number][1]]
        if not 0.0 < position < 0.9:
            continue
        expected = bromwich(
            IMAGES[motion],
            length=1.0,
            damping=0.5,
            gravity=9.81,
            position=position,
            time=time,
            highest=8.0 if motion == "sine" else 0.0,
        )
        # The integral keeps twelve digits or so, of values up to ten.
        assert values[number] == pytest.approx(expected, abs=1e-11)


def test_the_error_is_relative_to_the_largest_displacement() -> None:
    values = exact("smooth").copy()
    values[3] += 1e-3 * np.abs(values).max()
    assert string_error("smooth", tuple(values)) == pytest.approx(1e-3, rel=1e-9)


@pytest.mark.slow_but("case1*")
@pytest.mark.parametrize(
    ("case", "bound"),
    [
        (Case(code="string field", tank="smooth", variant="certified", tolerance=1e-3), 1e-3),
        (Case(code="string series", tank="smooth", variant="certified", tolerance=1e-8), 1e-8),
        # Terms fall as k^{−3}: after 64 of them a few times 64^{−2} of 16 (βR)² is left.
        (Case(code="string sum", tank="smooth", variant="cut sharply", terms=64), 1e-3),
    ],
)
def test_each_method_comes_to_the_exact_values(case: Case, bound: float) -> None:
    answer = hydroelastic_string.solve(hydroelastic_string.prepare(case))
    assert 1e-15 < row_of(case, [answer], (1.0,)).error < bound


ROWS = [
    Row(case=case, unknowns=10, error=1e-3, seconds=(0.1, 0.2), stages={"modes": 0.1}, note="a note")
    for case in string_cases("smooth", quick=True)
]
BENCHMARK = Benchmark(rows=tuple(ROWS), not_measured={}, versions={}, repeats=2)


def test_all_rows_are_written(tmp_path: Path) -> None:
    rows = list(csv.DictReader(io.StringIO(strings_csv(BENCHMARK))))
    assert tuple(rows[0]) == STRING_COLUMNS
    assert [row["code"] for row in rows] == [row.case.code for row in ROWS]
    assert "series, cut sharply" in strings_markdown(BENCHMARK)
    write_results(BENCHMARK, tmp_path, OUTPUT)
    assert {path.name for path in tmp_path.iterdir()} == {f"{OUTPUT.name}.{end}" for end in ("csv", "md", "png")}
