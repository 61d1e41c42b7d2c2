"""`import hydroelastic as he`: scenes, results and files are those of the command line; imports come when needed."""

import json
import pickle
import subprocess
import sys
import tomllib
from html.parser import HTMLParser
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
import xarray
from command import run_command

import hydroelastic as he

ROOT = Path(__file__).parent.parent
# One cheap scene of each kind, and the number of modes in its table.
SCENES: dict[str, tuple[str, dict[str, Any], int]] = {
    "tank": ("sloshing", {"accuracy.modes": 2, "accuracy.tolerance": 1e-3}, 2),
    "open water": (
        "open_plate",
        {"analysis": [{"kind": "response", "omega": [2.5, 3.0]}], "accuracy.tolerance": 1e-2},
        0,
    ),
    "string": ("string_smooth", {"output.times": [0.5, 1.0]}, 10),
    "thread": ("catenary", {"analysis": [{"kind": "modes", "count": 2}]}, 2),
    "roll": ("swell", {}, 0),
}
# What a run measures of itself, and what is of its folder.
MEASURED = ("seconds", "memory_peak", "scene_file", "files")
BEAM = {"kind": "beam", "start": 3.0, "length": 4.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0}


@pytest.fixture(
    scope="module",
    params=[
        pytest.param(kind, marks=pytest.mark.slow) if kind in ("open water", "string", "thread") else kind
        for kind in SCENES
    ],
)
def solved(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[str, he.Result, Path]:
    """The kind of a scene, its result, and where the result was saved."""
    name, changes, _ = SCENES[request.param]
    result = he.solve(he.read(name, changes))
    folder = tmp_path_factory.mktemp("saved") / "result"
    result.save(folder, report=True)
    return request.param, result, folder


def content(summary: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in summary.items() if key not in MEASURED}


def numbers(dataset: xarray.Dataset) -> xarray.Dataset:
    measured = [name for name in map(str, dataset.variables) if name.startswith(MEASURED)]
    return dataset.drop_vars([*measured, "summary"])


def test_save_writes_the_folder_of_the_command(solved: tuple[str, he.Result, Path], tmp_path: Path) -> None:
    kind, result, saved = solved
    name, changes, _ = SCENES[kind]
    options = [word for key, value in changes.items() for word in ("--set", f"{key}={toml(value)}")]
    out = tmp_path / "of the command"
    ended = run_command("run", name, "--report", "--out", str(out), *options)
    assert ended.exit_code == 0
    files = {file.relative_to(saved) for file in saved.rglob("*") if file.is_file()}
    assert files == {file.relative_to(out) for file in out.rglob("*") if file.is_file()}
    measuring = {Path(name) for name in ("summary.json", "summary.md", "dataset.nc", "report.html")}
    assert measuring < files
    assert [str(file) for file in files - measuring if (saved / file).read_bytes() != (out / file).read_bytes()] == []
    first, second = (json.loads((folder / "summary.json").read_text()) for folder in (saved, out))
    assert json.dumps(content(first)) == json.dumps(content(second)) == json.dumps(content(result.summary))
    assert numbers(he.load(saved).dataset).identical(numbers(he.load(out).dataset))
    # The seconds of writing follow.
    told = str(result).rpartition("; seconds:")[0]
    assert len(told) > 200
    assert " ".join(ended.output.split()).startswith(" ".join(told.split()))


def toml(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {toml(entry)}" for key, entry in value.items()) + "}"
    return "[" + ", ".join(map(toml, value)) + "]" if isinstance(value, list) else json.dumps(value)


def test_what_is_loaded_is_what_was_saved(solved: tuple[str, he.Result, Path]) -> None:
    _, result, folder = solved
    loaded = he.load(folder)
    assert content(loaded.summary) == content(result.summary)
    assert content(loaded.summary) == content(json.loads((folder / "summary.json").read_text()))
    told = str(result).rpartition("; seconds:")[0]
    assert str(loaded).startswith(told)
    assert [section.notes for section in loaded.sections] == [section.notes for section in result.sections]
    assert loaded.pictures == {file.stem: file.read_bytes() for file in folder.glob("images/*.png")}
    assert numbers(result.dataset).identical(numbers(loaded.dataset))


def test_pickled_results_have_all_but_the_solution(solved: tuple[str, he.Result, Path], tmp_path: Path) -> None:
    _, result, _ = solved
    copy = pickle.loads(pickle.dumps(result))
    assert str(copy) == str(result)
    assert copy._repr_html_() == result._repr_html_()
    assert (copy.scene, copy.summary) == (result.scene, result.summary)
    assert copy.dataset.identical(result.dataset)
    assert np.array_equal(copy.modes, result.modes)
    with pytest.raises(he.SceneError, match="without its solution"):
        copy.save(tmp_path / "copy")
    assert list(tmp_path.iterdir()) == []


def test_modes_are_records(solved: tuple[str, he.Result, Path]) -> None:
    kind, result, _ = solved
    assert len(result.modes) == SCENES[kind][2]
    assert result.modes.omega.dtype == float
    assert np.all(result.modes.relative_error < 1e-2)
    if kind == "tank":
        assert result.modes.omega.tolist() == [mode["omega"] for mode in result.summary["modes"]]
        assert result.modes.symmetry.tolist() == [mode["symmetry"] for mode in result.summary["modes"]]


def test_resonances_are_modes_with_complex_frequencies() -> None:
    file = ROOT / "results/shipped/open_circle/summary.json"
    summary = json.loads(file.read_text(encoding="utf-8"))
    modes = he.Result(scene=None, summary=summary, sections=(), cost="").modes
    assert modes.omega.tolist() == [complex(*omega) for table in summary["resonance"] for omega in table["omega"]]
    assert len(modes) > 0
    assert np.all(modes.omega.imag < 0)


@pytest.mark.slow
def test_a_result_without_resonances_has_a_dataset() -> None:
    # A file of NetCDF 3 has no dimension of length 0.
    resonances = {"analysis": [{"kind": "resonance", "count": 1}], "accuracy.tolerance": 1e-2}
    result = he.solve(he.read("open_plate", resonances))
    assert result.summary["resonance"][0]["omega"] == []
    assert result.dataset.attrs["status"] == "ok"


def test_the_main_picture_is_shown_first(solved: tuple[str, he.Result, Path]) -> None:
    kind, _, folder = solved
    loaded = he.load(folder)
    main_one = {"tank": "overview", "open water": "response_1", "string": "space_time", "thread": "equilibrium"}
    assert next(iter(loaded.pictures)) == main_one.get(kind, "roll")
    assert loaded.plot().size[0] > 400
    with pytest.raises(he.SceneError, match=r'picture = "rolls": there is no such picture .* Allowed: '):
        loaded.plot("rolls")


class Page(HTMLParser):
    """Tags of a page, all of them closed."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.open: list[str] = []
        self.feed(html)
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        assert not {"src", "href"} & {name for name, _ in attrs}
        self.tags.append(tag)
        self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def test_notebooks_show_tables_that_need_nothing_else(solved: tuple[str, he.Result, Path]) -> None:
    _, result, _ = solved
    html = result._repr_html_()
    assert Page(html).tags.count("table") == 1 + sum(bool(section.rows) for section in result.sections)
    assert "url(" not in html
    assert all(section.title in html.replace("&#39;", "'").replace("&amp;", "&") for section in result.sections)


def test_printing_in_a_notebook_gives_the_same_text(
    solved: tuple[str, he.Result, Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    _, result, _ = solved
    text = str(result)
    monkeypatch.setattr("rich.console._is_jupyter", lambda: True)
    assert str(result) == text


def test_texts_in_notebooks_are_escaped() -> None:
    result = he.solve(he.read("swell", {"title": "<b>a & b"}))
    assert "<h3>&lt;b&gt;a &amp; b</h3>" in result._repr_html_()


def test_scenes_are_made_of_dictionaries_lists_and_arrays() -> None:
    read = he.read("aquarium_hydrostatic", {"title": "", "accuracy.modes": np.int64(4)})
    made = he.TankScene(
        tank={"length": np.float32(10.0)},
        liquid=[{"density": 1000, "depth": 5.0}],
        body=[BEAM],
        accuracy={"modes": np.int64(4)},
    )
    assert made == read
    parts = he.TankScene(
        tank=he.Tank(length=10.0),
        liquid=(he.Liquid(density=1000.0, depth=5.0),),
        body=(he.Beam(**BEAM),),
        accuracy=he.Accuracy(modes=4),
    )
    assert parts == read


def test_a_dictionary_with_the_keys_of_a_file_is_read_as_the_file() -> None:
    file = ROOT / "scenes/cross_waves.toml"
    read = he.read(file)
    document = tomllib.loads(file.read_text(encoding="utf-8"))
    made = he.read({**document, "liquid": [he.Liquid(**document["liquid"][0])]})
    assert made.model_dump() == read.model_dump()
    wider = he.read(made, {"tank.width": np.float64(30.0)})
    assert wider.model_dump() == he.read(file, {"tank.width": 30.0}).model_dump() != read.model_dump()


def test_a_scene_that_was_solved_can_be_changed() -> None:
    # The waves, which are computed once, are kept beside its keys.
    scene = he.read("swell")
    he.solve(scene)
    assert he.read(scene, {"title": "changed"}).model_dump() == he.read("swell", {"title": "changed"}).model_dump()


def test_scenes_are_made_of_keywords_alone() -> None:
    with pytest.raises(TypeError, match="Tank takes keywords alone: length, gravity, ends, top"):
        he.Tank(10.0)  # type: ignore[misc]


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (
            lambda: he.Tank(lenght=1.0),
            'key "lenght" = 1.0: it is not known here. Allowed: length, gravity, ends, top. Did',
        ),
        (
            lambda: he.TankScene(tank={"length": 5.0}, liquid=[{"density": 1e3, "depth": 5.0}], body=[BEAM]),
            '[[body]] number 1, key "start" = 3.0: the beam ends at 7 m, outside the tank, of 5 m. Allowed: 0 to 1 m',
        ),
        (
            lambda: he.read("aquarum"),
            'aquarum: there is no such file and no shipped scene of that name. Did you mean "aqu',
        ),
        (
            lambda: he.read("aquarium", {"body.2.start": 1.0}),
            'change = "body.2.start = 1.0": "2" is not an entry of the',
        ),
        (
            lambda: he.read("aquarium", {"tank.length": "long"}),
            'change tank.length = "long": [tank], key "length" = "long"',
        ),
        (lambda: he.solve(he.Tank(length=1.0)), "scene = Tank(length=1.0, gravity=9.81, ends='walls', top='free'): it"),
        (lambda: he.read(None), "scene = None: it is not a scene. Allowed: a scene, the name of a shipped scene"),
        (
            lambda: he.TankScene(tank={"length": 5.0, "width": 2.0}, liquid=[{"density": 1e3, "depth": 5.0}]),
            'this is a tank in three dimensions, and a TankScene is per metre of width. Make it with he.read({"kind"',
        ),
        (lambda: he.sweep("aquarium", ["body.1.start"]), "vary = ['body.1.start']: it is not a dictionary"),
        (lambda: he.sweep("swell", {"roll.damping_ratio": []}), 'vary = "roll.damping_ratio": there is no value. For'),
        (lambda: he.sweep("swell", {}), 'vary: nothing is varied. For example {"body.1.start"'),
        (lambda: he.sweep("swell", {"roll.damping_ratio": [0.2]}, jobs=0), "jobs = 0: it is too small. Allowed: 1 or"),
        (lambda: he.sweep("swell", {"roll.damping_ratio": [0.2]}).plot("roll"), 'show = "roll": there is no such quan'),
        (
            lambda: he.solve("swell").save("/proc/swell"),
            "it cannot be written (No such file or directory). Name another",
        ),
        (
            lambda: setattr(he.read("swell"), "title", "Mine"),
            'title = "Mine": scenes cannot be changed. Make a changed',
        ),
        (
            lambda: setattr(he.read("swell").roll, "damping_ratio", 0.3),
            "damping_ratio = 0.3: scenes cannot be changed.",
        ),
        (lambda: he.solve("swell").save("swell", images="png"), "images = 'png': it is no option. Allowed: he.Pic"),
        (
            lambda: he.load("nowhere"),
            "result folder nowhere: it cannot be read (No such file or directory). Name a folder",
        ),
    ],
)
def test_errors_name_what_is_wrong_and_what_to_do(make: Any, said: str) -> None:
    with pytest.raises(he.SceneError) as caught:
        make()
    assert said in str(caught.value)
    assert "--" not in str(caught.value)


def test_notebooks_complete_the_keys_of_scenes_that_were_not_used_before() -> None:
    code = "import inspect, hydroelastic as he; print(*inspect.signature(he.ThreadScene).parameters)"
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ended.stdout.split() == [*he.ThreadScene.model_fields]


def test_a_notebook_shows_the_current_step_without_ipywidgets(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[str] = []

    class Shown:
        def update(self, data: dict[str, str], *, raw: bool) -> None:
            seen.append(data["text/plain"])

    fake = ModuleType("IPython.display")
    fake.display = lambda data, *, raw, display_id: Shown()  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "IPython", ModuleType("IPython"))
    monkeypatch.setitem(sys.modules, "IPython.display", fake)
    monkeypatch.setattr("rich.console._is_jupyter", lambda: True)
    he.solve("swell", report=True)
    assert seen[-1] == f"solved – {he.read('swell').title}"
    assert len(seen) > 1


def test_a_folder_that_is_not_of_a_result_is_not_touched(tmp_path: Path) -> None:
    (tmp_path / "mine.txt").write_text("mine")
    with pytest.raises(he.SceneError, match="not a result folder"):
        he.solve("swell").save(tmp_path)
    assert [file.name for file in tmp_path.iterdir()] == ["mine.txt"]
    (tmp_path / "dataset.nc").write_text("no NetCDF")
    with pytest.raises(he.SceneError, match="is damaged"):
        he.load(tmp_path)


def test_what_could_not_be_fulfilled_is_a_warning(tmp_path: Path) -> None:
    with pytest.warns(UserWarning, match="an animation has no effect"):
        he.solve("swell").save(tmp_path / "swell", images=he.PictureOptions(animate=True))


@pytest.mark.only_on_ranks
@pytest.mark.mpi
def test_all_processes_have_the_same_result(tmp_path_factory: pytest.TempPathFactory) -> None:
    from mpi4py import MPI

    comm = MPI.COMM_WORLD
    folder = Path(comm.bcast(str(tmp_path_factory.mktemp("mpi"))))
    result = he.solve(he.read("sloshing", {"accuracy.modes": 2, "accuracy.tolerance": 1e-3}))
    dataset = comm.bcast(result.dataset)
    assert result.dataset.identical(dataset)
    assert comm.bcast(result.modes.omega[0]) == result.modes.omega[0]
    result.save(folder / "saved", images=None)
    comm.barrier()
    assert content(he.load(folder / "saved").summary) == content(result.summary)
