"""Reports of every kind of scene: what stands in the page, that nothing is missing, and that it needs nothing else."""

import json
import re
import shutil
from collections.abc import Callable
from functools import cache
from itertools import pairwise
from pathlib import Path

import pytest
from click.testing import CliRunner
from mpi4py import MPI
from reports import SCENES, Page, parsed, shown
from scene_files import read_written

from hydroelastic.output.outcome import Outcome
from hydroelastic.output.sections import Section
from hydroelastic.scenes.command_line import main
from hydroelastic.scenes.read import SHIPPED_FOLDER, read_scene, shipped_scenes
from hydroelastic.scenes.report import content, write
from hydroelastic.scenes.report.answer import answer
from hydroelastic.scenes.report.page import Part, is_numeric, is_warning
from hydroelastic.scenes.report.scene_text import scene_text
from hydroelastic.scenes.run import run_scene

PARTS = [
    "Answer",
    "Results",
    "Comparison with estimates and closed forms",
    "What was modelled, and why",
    "Scene",
    "Cost",
]
# What is the only thing of its kind is a sentence among the results, not a part of its own.
ALONE = {
    "open": "There is no comparison with older theories",
    "round tank": "There is no comparison",
    "canal": "There is no comparison",
    "string": "This is the closed form",
    "roll": "The solution is a closed form.",
}

Reports = Callable[[str], tuple[Outcome, str]]


@pytest.fixture(scope="module")
def reports(tmp_path_factory: pytest.TempPathFactory) -> Reports:
    """Returns the outcome and the page of a kind of scene, without pictures, made when it is asked for first."""

    @cache
    def made(kind: str) -> tuple[Outcome, str]:
        folder = tmp_path_factory.mktemp("reports") / kind
        outcome = run_scene(read_scene(*SCENES[kind]), out=folder, images=None, page=True)
        return outcome, (folder / "report.html").read_text(encoding="utf-8")

    return made


@pytest.mark.slow_but("tank", "roll", "sea", "round tank", "canal")
@pytest.mark.parametrize("kind", SCENES)
def test_a_page_is_whole(reports: Reports, kind: str) -> None:
    outcome, html = reports(kind)
    page = parsed(html)
    assert page.headings[0] == (1, outcome.summary["scene"]["title"])
    found = [title for level, title in page.headings if level == 2]
    assert found == [part for part in PARTS if kind not in ALONE or not part.startswith("Comparison")]
    assert ALONE.get(kind, "") in page.text
    below = [title for level, title in page.headings if level == 3]
    shown = [section.title for section in outcome.sections]
    assert set(shown) <= set(below)
    assert {"Unknown fields", "How the answer was found", "Seconds by stage", "Versions"} <= set(below)
    words = re.sub(r"\s+", " ", page.text)
    for section in outcome.sections:
        for text in (*section.lines, *section.notes, *(cell for row in section.rows for cell in row)):
            assert re.sub(r"\s+", " ", text.strip()) in words


@pytest.mark.parametrize("name", [shipped.name for shipped in shipped_scenes()])
def test_the_answer_stands_first(name: str) -> None:
    """Of every shipped result: a few numbers, each with its error."""
    summary = json.loads((SHIPPED_FOLDER.parent / "results/shipped" / name / "summary.json").read_text())
    section = answer(summary)
    assert 1 <= len(section.rows) <= 16
    for quantity, value, error in section.rows:
        assert quantity[0].islower() or quantity.startswith(("ω", "Im λ"))
        assert value == "0" or float(value)
        assert 0.0 < float(error.removesuffix(" absolute")) < 1.0


def test_the_answer_is_that_of_the_tables() -> None:
    summary = json.loads((SHIPPED_FOLDER.parent / "results/shipped/aquarium/summary.json").read_text())
    rows = {quantity: float(value) for quantity, value, _ in answer(summary).rows}
    first = summary["first_elastic"]
    # Digits beyond the estimated error are not shown.
    assert rows["ω of mode 1 (sloshing), rad/s"] == pytest.approx(summary["modes"][0]["omega"], rel=1e-6)
    name = f"ω of the first elastic tone of beam 1, mode {first['index']}, rad/s"
    assert rows[name] == pytest.approx(first["omega"], rel=1e-6)


def test_an_answer_without_errors_says_so() -> None:
    summary = {
        "scene": {"kind": "tank", "tank": {"ends": "open"}, "body": []},
        **{kind: [] for kind in ("radiation", "decay", "spectrum", "impulse_response", "motion")},
        "response": [
            {
                "waves": ["surface"],
                "largest": None,
                "largest_reflection": {"value": [0.5], "omega": [2.0], "error": [None]},
            },
        ],
        "resonance": [{"omega": [[1.0, -0.1]], "relative_error": ["inf"]}],
    }
    assert [row[1:] for row in answer(summary).rows] == [("0.5", "unknown"), ("1", "unknown"), ("0.1", "unknown")]


def test_the_first_picture_belongs_to_the_answer(tmp_path: Path) -> None:
    scene = read_scene("swell")
    run_scene(scene, out=tmp_path / "out", page=True)
    html = (tmp_path / "out/report.html").read_text(encoding="utf-8")
    assert html.index('<h2 id="answer"') < html.index("<img") < html.index('<h2 id="results"')
    # There is no other one.
    assert '<h2 id="pictures"' not in html


@pytest.mark.slow_but("tank", "roll")
@pytest.mark.parametrize("kind", SCENES)
def test_a_page_is_accessible_and_needs_nothing_else(reports: Reports, kind: str) -> None:
    page = parsed(reports(kind)[1])
    assert_self_contained(page)
    assert dict(page.tags)["html"] == {"lang": "en-GB"}
    levels = [level for level, _ in page.headings]
    assert all(after <= before + 1 for before, after in pairwise(levels))
    assert all(cell.get("scope") in ("col", "row") for tag, cell in page.tags if tag == "th")
    assert all(title.strip() for _, title in page.headings)
    anchors = [of["id"] for _, of in page.tags if "id" in of]
    assert len(set(anchors)) == len(anchors)
    links = [of["href"] or "" for tag, of in page.tags if tag == "a"]
    assert links
    assert all(link.startswith("#") and link[1:] in anchors for link in links)


def assert_self_contained(page: Page) -> None:
    assert not {"script", "iframe", "object", "embed", "form"} & {tag for tag, _ in page.tags}
    for tag, attributes in page.tags:
        assert not any(name.startswith("on") for name in attributes), tag
        for name in ("src", "href", "srcset", "action", "data"):
            assert re.match(r"data:|#", attributes.get(name) or "#"), (tag, attributes)


# What is known of each scene: groups by hand (test_scenes_check.py), the note of an estimate, and so on.
KNOWN = {
    "tank": ("EI/(ρ g l⁴)", "0.001991", "grammel_1", "neglects", "tolerance = 0.0001"),
    "float": ("c33 heave, N/m²", "thin_float", "half_width"),
    "open": ("outgoing waves only", "Lengths of outgoing waves at 3 rad/s", 'ends = "open"'),
    "sea": ("radiation damping of heave", 'shape = "sphere"'),
    "plates": ("cross-wave", "flexural_rigidity"),
    "round tank": ("One problem in the half-plane of revolution", 'shape = "sphere"'),
    "canal": ("One problem in the section", "outline"),
    "string": ("Series of Bessel functions", "hydroelastic compare", "gravity = 9.81  # default"),
    "thread": ("Largest difference of a tension from older theories", "catenary", "Estimates that do not apply"),
    "roll": ("Closed form from wave to wave", "number = 1201"),
}


@pytest.mark.slow_but("tank", "roll")
@pytest.mark.parametrize("kind", SCENES)
def test_a_page_says_what_is_known_of_the_scene(reports: Reports, kind: str) -> None:
    text = parsed(reports(kind)[1]).text
    for words in KNOWN[kind]:
        assert words in text


def test_theories_stand_apart_from_results(reports: Reports) -> None:
    outcome, html = reports("tank")
    results, theories, model = (html.index(f'<h2 id="{part}"') for part in ("results", "comparison", "model"))
    assert [section.compares for section in outcome.sections] == [False, True]
    assert results < html.index(outcome.sections[0].rows[0][1], results) < theories
    assert theories < html.rindex(outcome.sections[1].rows[0][1]) < model


@pytest.mark.slow
def test_a_string_solved_as_a_field_is_set_beside_its_series(tmp_path: Path) -> None:
    scene = read_scene("string_ramp", ["accuracy.method=field", "accuracy.tolerance=1e-3", "output.frames=0"])
    run_scene(scene, out=tmp_path / "out", images=None, page=True)
    text = parsed((tmp_path / "out/report.html").read_text(encoding="utf-8")).text
    assert "The field solution beside the series" in text


@pytest.mark.parametrize("name", [shipped.name for shipped in shipped_scenes()])
def test_the_scene_in_the_page_reads_back_as_the_same(tmp_path: Path, name: str) -> None:
    for file in (file for kind in ("toml", "csv", "stl") for file in SHIPPED_FOLDER.glob(f"*.{kind}")):
        shutil.copy(file, tmp_path)
    scene = read_scene(name)
    assert read_written(tmp_path, scene_text(scene)).model_dump() == scene.model_dump()


def test_texts_and_lists_of_a_scene_read_back(tmp_path: Path) -> None:
    title = 'A "quoted" \\ title, ünïcode ψ and $'
    omega = [round(0.3 + 0.01 * place**1.5, 5) for place in range(40)]
    changes = [f"analysis.1.omega={omega}", f"accuracy.tolerance={1e-3}"]
    scene = read_scene("open_plate", changes).model_copy(update={"title": title})
    text = scene_text(scene)
    assert read_written(tmp_path, text).model_dump() == scene.model_dump()
    assert max(len(line) for line in text.splitlines()) <= 120


def test_defaults_are_marked(tmp_path: Path) -> None:
    lines = scene_text(read_scene("aquarium", ["accuracy.modes=3"])).splitlines()
    assert "modes = 3" in lines
    written = "[tank]\nlength = 2.0\n[[liquid]]\ndensity = 1000.0\ndepth = 1.0\n"
    lines = scene_text(read_written(tmp_path, f'kind = "tank"\n{written}')).splitlines()
    assert {"length = 2.0", "gravity = 9.81  # default", "[accuracy]  # default", "modes = 10  # default"} <= set(lines)


ATTACK = "</style></title><script>alert('x')</script><img src=http://x onerror=\"y\"> & \"quoted\" 'too'"


def test_whatever_a_scene_holds_is_shown_as_text() -> None:
    section = Section(title=ATTACK, headings=(ATTACK,), rows=[(ATTACK,)], lines=(ATTACK,), notes=(ATTACK,))
    part = Part(anchor="a", title="A", lines=(ATTACK,), text=ATTACK, sections=(section, section))
    html = write.rendered(
        "page.html.jinja", page=shown(title=ATTACK, reasons=(ATTACK,), warnings=(ATTACK,), parts=(part,))
    )
    page = parsed(html)
    assert_self_contained(page)
    # Title, h1, reason, warning; twice in the contents; lines, text; heading, header, cell, line and note, twice.
    assert page.text.count(ATTACK) == 4 + 2 + 2 + 2 * 5


def test_what_is_not_converged_is_loud() -> None:
    html = write.rendered("page.html.jinja", page=shown(reasons=("mode 1 is off", "so is mode 2")))
    page = parsed(html)
    assert ("div", {"class": "status failed", "role": "alert"}) in page.tags
    assert "NOT CONVERGED to the tolerance 1e-06:" in page.text
    assert "so is mode 2" in page.text
    assert "Converged to" not in page.text
    assert "Converged to the tolerance 1e-06." in parsed(write.rendered("page.html.jinja", page=shown())).text


def test_an_unconverged_run_is_reported_as_such(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    given = ["run", "sloshing", "--set", "accuracy.tolerance=1e-12", "--out", str(folder), "--no-images", "--report"]
    ended = CliRunner().invoke(main, given)
    page = parsed((folder / "report.html").read_text(encoding="utf-8"))
    assert ended.exit_code == 3
    assert "NOT CONVERGED to the tolerance 1e-12:" in page.text
    assert '<h2 id="pictures"' not in (folder / "report.html").read_text(encoding="utf-8")


def test_a_page_is_written_only_when_asked(tmp_path: Path) -> None:
    run_scene(read_scene("swell"), out=tmp_path / "out", images=None)
    assert not (tmp_path / "out/report.html").exists()


def test_a_page_that_fails_leaves_no_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise RuntimeError("no page")

    monkeypatch.setattr(content, "comparison_of", fail)
    with pytest.raises(RuntimeError, match="no page"):
        run_scene(read_scene("swell"), out=tmp_path / "out", images=None, page=True)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow_on_ranks_but("tank")
@pytest.mark.only_on_ranks
@pytest.mark.mpi
@pytest.mark.parametrize("kind", ["tank", "thread"])
def test_one_process_writes_the_page(tmp_path: Path, kind: str) -> None:
    folder = MPI.COMM_WORLD.bcast(tmp_path / "out", root=0)
    run_scene(read_scene(*SCENES[kind]), out=folder, images=None, page=True)
    assert parsed((folder / "report.html").read_text(encoding="utf-8")).headings
    MPI.COMM_WORLD.barrier()


@pytest.mark.parametrize(
    ("cells", "numeric"),
    [
        (["1", "-2.5", "3e-07", "+0.2 %", "inf", "–", "1.5 -0.2i", ""], True),
        (["1", "stable"], False),
        (["4 to 6"], False),
        (["1.2, 3.4"], False),
        (["3.22.2"], True),
    ],
)
def test_columns_of_numbers_stand_to_the_right(cells: list[str], numeric: bool) -> None:
    assert is_numeric(cells) is numeric


def test_warnings_are_told_from_formulas() -> None:
    assert is_warning("UNSTABLE: a motion grows")
    assert is_warning("NO: larger than")
    assert not is_warning("EI w⁗ = 0")
    assert not is_warning("Float 1: mass")
