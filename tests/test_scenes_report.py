"""Reports of every kind of scene: what stands in the page, that nothing is missing, and that it needs nothing else."""

import re
import shutil
from collections.abc import Callable
from functools import cache
from itertools import pairwise
from pathlib import Path

import pytest
from command import run_command
from mpi4py import MPI
from reports import SCENES, Page, parsed
from scene_files import read_written

import hydroelastic as he

SHIPPED_FOLDER = Path(__file__).parent.parent / "scenes"
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

Reports = Callable[[str], tuple[he.Result, str]]


@pytest.fixture(scope="module")
def reports(tmp_path_factory: pytest.TempPathFactory) -> Reports:
    """Returns the result and the page of a kind of scene, without pictures, made when it is asked for first."""

    @cache
    def made(kind: str) -> tuple[he.Result, str]:
        folder = tmp_path_factory.mktemp("reports") / kind
        result = he.solve(he.read(*SCENES[kind]))
        result.save(folder, images=None, report=True)
        return result, (folder / "report.html").read_text(encoding="utf-8")

    return made


@pytest.mark.slow_but("tank", "roll")
@pytest.mark.parametrize("kind", SCENES)
def test_a_page_is_whole(reports: Reports, kind: str) -> None:
    result, html = reports(kind)
    page = parsed(html)
    assert page.headings[0] == (1, result.summary["scene"]["title"])
    found = [title for level, title in page.headings if level == 2]
    assert found == [part for part in PARTS if kind not in ALONE or not part.startswith("Comparison")]
    assert ALONE.get(kind, "") in page.text
    below = [title for level, title in page.headings if level == 3]
    shown = [section.title for section in result.sections]
    assert set(shown) <= set(below)
    assert {"Unknown fields", "How the answer was found", "Size and time", "Versions"} <= set(below)
    words = re.sub(r"\s+", " ", page.text)
    for section in result.sections:
        for text in (*section.lines, *section.notes, *(cell for row in section.rows for cell in row)):
            assert re.sub(r"\s+", " ", text.strip()) in words


def rows_of_answer(html: str) -> list[list[str]]:
    answer = html[html.index('<h2 id="answer"') : html.index('<h2 id="results"')]
    rows = re.findall(r"<tr>(.*?)</tr>", answer, re.DOTALL)[1:]
    return [[parsed(cell).text.strip() for cell in re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row)] for row in rows]


@pytest.mark.slow_but("tank", "roll")
@pytest.mark.parametrize("kind", SCENES)
def test_the_answer_stands_first(reports: Reports, kind: str) -> None:
    """A few numbers, each with its error."""
    rows = rows_of_answer(reports(kind)[1])
    assert 1 <= len(rows) <= 16
    for quantity, value, error in rows:
        assert quantity[0].islower() or quantity.startswith(("ω", "Im λ"))
        assert value == "0" or float(value)
        assert 0.0 < float(error.removesuffix(" absolute")) < 1.0


def test_the_answer_is_that_of_the_summary(reports: Reports) -> None:
    result, html = reports("tank")
    rows = {quantity: (float(value), float(error)) for quantity, value, error in rows_of_answer(html)}
    first = result.summary["modes"][0]
    value, error = rows["ω of mode 1 (sloshing), rad/s"]
    # Digits beyond the estimated error are not shown; it is shown with two.
    assert value == pytest.approx(first["omega"], rel=10 * first["relative_error"])
    assert error == pytest.approx(first["relative_error"], rel=0.06)


def test_the_first_picture_belongs_to_the_answer(tmp_path: Path) -> None:
    he.solve("swell").save(tmp_path / "out", report=True)
    html = (tmp_path / "out/report.html").read_text(encoding="utf-8")
    assert html.index('<h2 id="answer"') < html.index("<img") < html.index('<h2 id="results"')
    # There is no other one.
    assert '<h2 id="pictures"' not in html
    assert re.search(r'<img[^>]* alt="[^"]{10,}"', html)


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
    result, html = reports("tank")
    results, theories, model = (html.index(f'<h2 id="{part}"') for part in ("results", "comparison", "model"))
    assert [section.compares for section in result.sections] == [False, True]
    assert results < html.index(result.sections[0].rows[0][1], results) < theories
    assert theories < html.rindex(result.sections[1].rows[0][1]) < model


@pytest.mark.slow
def test_a_string_solved_as_a_field_is_set_beside_its_series(tmp_path: Path) -> None:
    changes = ["accuracy.method=field", "accuracy.tolerance=1e-3", "output.frames=0"]
    he.solve(he.read("string_ramp", changes)).save(tmp_path / "out", images=None, report=True)
    text = parsed((tmp_path / "out/report.html").read_text(encoding="utf-8")).text
    assert "The field solution beside the series" in text


def scene_of(html: str) -> str:
    """The scene as the page shows it, the only text that begins with its kind."""
    blocks = [parsed(block).text for block in re.findall(r"<pre[^>]*>(.*?)</pre>", html, re.DOTALL)]
    (text,) = (block for block in blocks if re.search(r"^kind = ", block, re.MULTILINE))
    return text


@pytest.mark.slow_but("tank", "roll")
@pytest.mark.parametrize("kind", SCENES)
def test_the_scene_in_the_page_reads_back_as_the_same(reports: Reports, kind: str, tmp_path: Path) -> None:
    for file in (file for suffix in ("csv", "stl") for file in SHIPPED_FOLDER.glob(f"*.{suffix}")):
        shutil.copy(file, tmp_path)
    result, html = reports(kind)
    text = scene_of(html)
    assert result.scene is not None
    assert read_written(tmp_path, text).model_dump() == result.scene.model_dump()
    assert max(len(line) for line in text.splitlines()) <= 120


ATTACK = "</style></title><script>alert('x')</script><img src=http://x onerror=y> & 'too' \"quoted\" \\ ψ"


def test_whatever_a_scene_is_called_is_shown_as_text(tmp_path: Path) -> None:
    scene = he.read("swell", {"title": ATTACK, "output.times": {"start": 0.0, "stop": 60.0, "number": 601}})
    he.solve(scene).save(tmp_path / "out", images=None, report=True)
    html = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    page = parsed(html)
    assert_self_contained(page)
    # In the head, as the heading; quoted in the scene.
    assert page.text.count(ATTACK) == 2
    text = scene_of(html)
    assert read_written(tmp_path, text).model_dump() == scene.model_dump()
    assert "# default" in text
    assert "number = 601" in text


def test_what_is_not_converged_is_loud(tmp_path: Path) -> None:
    given = ("--set", "accuracy.tolerance=1e-12", "--out", str(tmp_path / "out"), "--no-images", "--report")
    ended = run_command("run", "sloshing", *given)
    page = parsed((tmp_path / "out" / "report.html").read_text(encoding="utf-8"))
    assert ended.exit_code == 3
    assert ("div", {"class": "status failed", "role": "alert"}) in page.tags
    assert "NOT CONVERGED to the tolerance 1e-12:" in page.text
    assert "Converged to" not in page.text


def test_a_page_is_written_only_when_asked(reports: Reports, tmp_path: Path) -> None:
    result, html = reports("roll")
    result.save(tmp_path / "out", images=None)
    assert not (tmp_path / "out/report.html").exists()
    assert "Converged to the tolerance" in parsed(html).text


@pytest.mark.slow_on_ranks_but("tank")
@pytest.mark.only_on_ranks
@pytest.mark.mpi
@pytest.mark.parametrize("kind", ["tank", "thread"])
def test_one_process_writes_the_page(tmp_path: Path, kind: str) -> None:
    folder = MPI.COMM_WORLD.bcast(tmp_path / "out", root=0)
    he.solve(he.read(*SCENES[kind])).save(folder, images=None, report=True)
    MPI.COMM_WORLD.barrier()
    assert parsed((folder / "report.html").read_text(encoding="utf-8")).headings
    MPI.COMM_WORLD.barrier()
