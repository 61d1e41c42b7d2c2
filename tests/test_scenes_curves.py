"""Curves of every kind of scene, of studies and of benchmarks: axes are named with units, and all words can be read."""

from __future__ import annotations

import csv
import re
import warnings
from collections.abc import Callable
from dataclasses import replace
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import Bbox
from mpi4py import MPI
from open_tables import ANALYSES, CIRCLE, DEEP, OIL, PLATE, arbitrary_solution, open_scene

from hydroelastic.benchmarks.cases import Case
from hydroelastic.benchmarks.circle.figure import draw_circle
from hydroelastic.benchmarks.rows import Row
from hydroelastic.benchmarks.string.figure import draw_strings
from hydroelastic.benchmarks.tank.figure import draw_speed
from hydroelastic.benchmarks.thread.figure import draw_threads
from hydroelastic.fem.study.reference import Reference
from hydroelastic.fem.study.row import StudyRow
from hydroelastic.fem.thread.stability import Stability, Threshold
from hydroelastic.output.pictures.curves import Sheets
from hydroelastic.output.pictures.options import SCALE_LIMITS, PictureOptions
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.roll import RollScene
from hydroelastic.scenes.models.string import StringScene
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.open_water.figures import draw_open
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.roll.figure import draw_roll
from hydroelastic.scenes.roll.solve import solve_roll
from hydroelastic.scenes.string.drawn import drawn_solution
from hydroelastic.scenes.string.figures import draw_string
from hydroelastic.scenes.string.solve import solve_string
from hydroelastic.scenes.study.figure import draw_study
from hydroelastic.scenes.study.plan import StudyPlan
from hydroelastic.scenes.study.run import Study
from hydroelastic.scenes.thread import figures as thread_figures
from hydroelastic.scenes.thread.solve import solve_thread_scene

# Where words have the least room.
SMALLEST = PictureOptions(scale=SCALE_LIMITS[0])
RESULTS = Path(__file__).parent.parent / "results"
UNIT = re.compile(
    r",\s(m|s|rad|rad/s|1/s|N|kN|MN|kg/m|kg·m|kg/\(m·s\)|kg·m/s|N/m|N/m²|m/m|rad/m|degrees|degrees/s)(?=$|:|,| )"
)
DIMENSIONLESS = (
    "displacement over the largest one",
    "factor of the stream",
    "half width l over half height",
    "half width l over tank length",
    "largest error over the largest displacement",
    "number of unknowns",
)
ERRORS = re.compile(r"\brelative (error|difference)\b")


def silent(_message: str) -> None:
    pass


def of_strings(folder: Path) -> None:
    for name, changes in (
        ("string_step", ("output.frames=1",)),
        ("string_sine", ("output.frames=1", "accuracy.modes=3")),
        ("string_smooth", ("output.frames=1", "output.positions=[0.0, 0.5, 1.0]", "output.times=[0.0, 1.0, 2.0]")),
    ):
        scene = read_scene(name, changes)
        assert isinstance(scene, StringScene)
        (folder / name).mkdir()
        draw_string(solve_string(scene, MPI.COMM_SELF), folder / name, SMALLEST)


def of_ships(folder: Path) -> None:
    for name in ("swell", "swell_record"):
        scene = read_scene(name)
        assert isinstance(scene, RollScene)
        draw_roll(solve_roll(scene, MPI.COMM_SELF, silent), folder, SMALLEST)


def of_threads(folder: Path) -> None:
    analyses = '{kind = "modes", count = 3}, {kind = "motion", times = [0.0, 0.5, 1.0], tolerance = 1e-2}'
    scene = read_scene("released_chain", (f"analysis=[{analyses}]", "output.frames=0"))
    assert isinstance(scene, ThreadScene)
    solution = solve_thread_scene(scene, MPI.COMM_SELF, silent)
    values = np.linspace(1.0, 5.0, 9)
    threshold = Threshold(value=3.0, error=1e-9, kind="flutter", frequency=2.0, growing=(0, 2))
    sweep = Stability(
        values=values,
        roots=np.column_stack([0.1 * values + 2j, 0.1 * values - 2j, -values + 0j]),
        growing=np.zeros(9, dtype=np.int64),
        thresholds=(threshold, replace(threshold, value=3.1, kind="divergence")),
        ill_posed=None,
    )
    thread_figures.draw_thread(replace(solution, stability=(sweep,)), folder, SMALLEST)


def of_open_water(folder: Path) -> None:
    rolling = CIRCLE | {"half_height": 0.3, "motions": ["heave", "sway", "roll"]}
    both_sides = [*ANALYSES, {"kind": "response", "omega": [1.0], "waves_from": "right"}]
    for scene in (open_scene(rolling), open_scene(CIRCLE, PLATE, liquids=(DEEP, OIL), analyses=both_sides)):
        draw_open(arbitrary_solution(scene), folder, SMALLEST)


def of_studies(folder: Path) -> None:
    scene = read_scene("aquarium")
    assert isinstance(scene, TankScene)
    with (RESULTS / "shipped" / "aquarium" / "study.csv").open(encoding="utf-8") as file:
        rows = tuple(map(study_row, csv.DictReader(file)))
    sheets = Sheets(folder=folder, title=scene.title)
    tank, exact = physical_tank(scene).scaled(), Reference(name="exact", omega=np.ones(1), uncertainty=0.0)
    draw_study(Study(scene=scene, plan=StudyPlan(), tank=tank, reference=exact, halves=True, rows=rows), sheets)


def study_row(row: dict[str, str]) -> StudyRow:
    def number(key: str) -> float | None:
        return float(row[key]) if row[key] else None

    return StudyRow(
        family=row["family"],  # type: ignore[arg-type]
        degree=int(row["degree"]),
        element_size=float(row["element_size"]),
        grading=number("grading"),
        tolerance=number("tolerance"),
        attempts=1,
        unknowns=int(row["unknowns"]),
        errors=(float(row["error"]),),
        floor=float(row["floor"]),
        estimate=number("estimate"),
        reasons=(),
        seconds={"solve": float(row["seconds"])},
        memory=None,
    )


def of_benchmarks(folder: Path) -> None:
    sheets = Sheets(folder=folder, title="")
    for name, key, draw in (
        ("speed_against_error", "tank", draw_speed),
        ("open_circle", "frequency", draw_circle),
        ("hanging_string", "motion", draw_strings),
        ("threads", "thread", draw_threads),
    ):
        with (RESULTS / "benchmarks" / f"{name}.csv").open(encoding="utf-8") as file:
            draw([benchmark_row(row, key) for row in csv.DictReader(file)], sheets, name)


def benchmark_row(row: dict[str, str], key: str) -> Row:
    case = Case(
        code=row["code"],  # type: ignore[arg-type]
        tank=row[key],
        variant=row.get("variant", "certified"),  # type: ignore[arg-type]
        length=float(row.get("length") or 0.0),
    )
    seconds = (float(row["seconds_median"]),)
    return Row(case=case, unknowns=0, error=float(row["error"]), seconds=seconds, stages={}, note="")


KINDS: dict[str, tuple[Callable[[Path], None], int]] = {
    # How many figures are drawn, with the frames.
    "strings": (of_strings, 3 * (3 + 1)),
    "ships": (of_ships, 2),
    "threads": (of_threads, 5),
    "open water": (of_open_water, 4 + 7),
    "studies": (of_studies, 2),
    "benchmarks": (of_benchmarks, 4),
}


FAST = ("threads",)


@pytest.fixture(
    scope="module", params=[kind if kind in FAST else pytest.param(kind, marks=pytest.mark.slow) for kind in KINDS]
)
def figures(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> list[Figure]:
    """All figures of a kind as they are when they are saved; a thread is not rendered in space."""
    draw, count = KINDS[request.param]
    found: list[Figure] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Figure, "savefig", lambda figure, *_places, **_options: found.append(figure))
        patch.setattr(thread_figures, "draw_equilibrium", lambda *_things, **_options: None)
        draw(tmp_path_factory.mktemp("figures"))
    assert len(found) == count
    with warnings.catch_warnings():
        # Such as that of a layout that has no room.
        warnings.simplefilter("error", UserWarning)
        for figure in found:
            figure.draw_without_rendering()
    return found


def shown_axes(figure: Figure) -> list[Axes]:
    return [axes for axes in figure.axes if axes.get_visible() and axes.axison]


@pytest.mark.slow
def test_axes_are_named_with_units(figures: list[Figure]) -> None:
    for figure in figures:
        for axes in shown_axes(figure):
            for axis, whole in ((axes.xaxis, figure.get_supxlabel()), (axes.yaxis, figure.get_supylabel())):
                numbers = any(label.get_visible() and label.get_text() for label in axis.get_ticklabels())
                name = axis.get_label().get_text() or whole
                if not numbers and not name:
                    # Its numbers and name are those of the panel below, or on the left.
                    continue
                known = UNIT.search(name) or ERRORS.search(name) or name in DIMENSIONLESS
                assert known, f"{name!r} of {figure.get_suptitle()!r}"


def test_figures_say_what_they_show(figures: list[Figure]) -> None:
    for figure in figures:
        titles = [figure.get_suptitle(), *(axes.get_title() for axes in figure.axes)]
        assert any(titles)


def test_curves_are_told_apart_by_a_legend(figures: list[Figure]) -> None:
    """Where there are several curves of different looks in a panel, a legend or words beside them name them."""
    for figure in figures:
        legends = [*figure.legends, *(axes.get_legend() for axes in figure.axes)]
        looks = {(line.get_color(), line.get_linestyle()) for axes in shown_axes(figure) for line in axes.get_lines()
                 if len(line.get_xdata()) > 2}  # fmt: skip
        named = any(legend is not None for legend in legends) or any(axes.texts for axes in figure.axes)
        assert named or len(looks) <= 1 or len(shown_axes(figure)) >= len(looks), figure.get_suptitle()


def words(figure: Figure) -> dict[str, Bbox]:
    """Where titles, names of axes and legends stand, in pixels."""
    found: dict[str, Bbox] = {}

    def put(text: Text | None) -> None:
        if text is not None and text.get_text() and text.get_visible():
            found[f"{len(found)} {text.get_text()}"] = text.get_window_extent()

    put(figure._suptitle)  # type: ignore[attr-defined]
    put(figure._supxlabel)  # type: ignore[attr-defined]
    put(figure._supylabel)  # type: ignore[attr-defined]
    for axes in figure.axes:
        if axes.get_visible():
            put(axes.title)
            if axes.axison:
                put(axes.xaxis.label)
                put(axes.yaxis.label)
    for legend in (*figure.legends, *(axes.get_legend() for axes in figure.axes)):
        if legend is not None:
            found[f"{len(found)} legend"] = legend.get_window_extent()
    return found


def test_no_words_are_cut_off_or_cover_each_other(figures: list[Figure]) -> None:
    for figure in figures:
        placed = words(figure)
        page = figure.bbox
        for name, box in placed.items():
            # A pixel for the rounding of letters.
            inside = box.x0 > -1 and box.y0 > -1 and box.x1 < page.x1 + 1 and box.y1 < page.y1 + 1
            assert inside, f"{name!r} leaves the page of {figure.get_suptitle()!r}"
        for (one, first), (other, second) in combinations(placed.items(), 2):
            assert not first.padded(-1).overlaps(second.padded(-1)), f"{one!r} covers {other!r}"


def test_numbers_of_axes_are_apart(figures: list[Figure]) -> None:
    for figure in figures:
        for axes in shown_axes(figure):
            for axis in (axes.xaxis, axes.yaxis):
                low, high = sorted(axis.get_view_interval())
                ticks = [*axis.get_major_ticks(), *axis.get_minor_ticks()]
                boxes = [
                    tick.label1.get_window_extent().padded(-1)
                    for tick in ticks
                    if low <= tick.get_loc() <= high and tick.label1.get_visible() and tick.label1.get_text()
                ]
                apart = not any(one.overlaps(other) for one, other in combinations(boxes, 2))
                assert apart, f"numbers of {axis.get_label().get_text()!r} of {figure.get_suptitle()!r}"


@pytest.mark.slow
def test_values_beside_fronts_make_no_spots(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """At the focus of a step U has no bound, and a sample there is a matter of chance."""
    found: list[Figure] = []
    monkeypatch.setattr(Figure, "savefig", lambda figure, *_places, **_options: found.append(figure))
    scene = read_scene("string_step", ("output.frames=0",))
    assert isinstance(scene, StringScene)
    result = solve_string(scene, MPI.COMM_SELF)
    draw_string(result, tmp_path, SMALLEST)
    solution = drawn_solution(result)
    drawn = np.asarray(found[0].axes[0].images[0].get_array())
    assert np.array_equal(drawn[solution.trusted], solution.displacement[solution.trusted])
    assert np.abs(drawn).max() <= solution.largest
    # Without it the test would show nothing.
    assert np.abs(solution.displacement[~solution.trusted]).max() > solution.largest
    # At t = 0 the end has jumped by 1 m: no part of the string lies across the jump.
    at_start = next(line for line in found[2].axes[0].lines if line.get_label() == "0 s")
    assert np.nanmax(np.abs(np.diff(np.asarray(at_start.get_xdata())))) == 0.0
