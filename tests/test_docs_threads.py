"""The page of threads: its examples run; its refusals and results are those of the code."""

import re
from copy import deepcopy
from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError

from hydroelastic.output.outcome import Outcome
from hydroelastic.output.thread.quantities import THREAD
from hydroelastic.output.variables import array_variables
from hydroelastic.scenes.kinds import runner_of
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.read import read_scene, shipped_scenes

DOCS = Path(__file__).parent.parent / "docs"
PAGE = (DOCS / "scenes_threads.md").read_text(encoding="utf-8")
EXAMPLES = [block for block in re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL) if block.startswith("kind")]
RESULTS = PAGE.split("## Results")[1].split("\n## ")[0]
REFUSED = re.findall(r'^\| "(.*?)" \|', PAGE.split("## What is refused")[1].split("\n## ")[0], re.MULTILINE)

BUOY: dict[str, Any] = {
    "thread": {"length": 10.0, "diameter": 0.02, "mass": 1.0, "weight": 5.0, "normal_drag": 1.0},
    "stream": {"density": 1000.0, "velocity": [1.0, 0.0]},
    "ends": {"a": {"kind": "fixed"}, "b": {"kind": "free", "weight": -100.0}},
}
HELD: dict[str, Any] = {**BUOY, "ends": {"a": {"kind": "fixed"}, "b": {"kind": "fixed", "position": [8.0, 0.0, 0.0]}}}
LIGHT = {"thread.weight": 0.0, "thread.normal_drag": 0.0}
TAIL = {"kind": "free"}
REACTIVE = {"thread.reactive": "lighthill", "thread.added_mass": 1.0}
MOTION = {"kind": "motion", "times": [0.0, 1.0]}
MOVED = {"end": "a", "file": "motion.csv"}
# What is changed in a scene that is well, by keys; a value of nothing takes a key out.
REFUSALS: list[tuple[dict[str, Any], dict[str, Any], str]] = [
    (BUOY, {"stream.veer": {"speed": 1.0, "rate": 0.1}}, "it is given beside velocity"),
    (BUOY, {"stream.velocity": None, "stream.shear": [0.1, 0.0]}, "there is no velocity that it adds to"),
    (
        BUOY,
        {"stream.velocity": None, "stream.profile": [[0, 1, 0], [0, 2, 0]]},
        "does not lie above that before it",
    ),
    (BUOY, {"stream": None}, "there is no liquid"),
    (BUOY, {"thread.diameter": None}, "it is missing, and"),
    (BUOY, {"thread.reactive": "lighthill"}, "it takes a stream and an added mass"),
    (BUOY, {"thread.stretch_drag": "volume"}, "the thread does not stretch"),
    (BUOY, {"load": [{"at": 10.0}]}, "it does not lie between the ends"),
    (BUOY, {"load": [{"at": 5.0}, {"at": 5.0}]}, "another body is there"),
    (BUOY, {"output": {"positions": [0.0, 11.0]}}, "it lies beyond end B"),
    (BUOY, {"ends.a.clamp": [0.0, 0.0, 1.0]}, "a thread without flexural rigidity turns freely at its ends"),
    (BUOY, {"ends.a": TAIL}, "neither end is fixed"),
    (HELD, {"thread.length": 7.0}, "the ends are"),
    (HELD, {"thread.length": 8.0}, "has no determined tension"),
    (HELD, {"thread.tension": 1.0}, "the equilibrium determines the tension"),
    (
        HELD,
        {"thread.length": 8.0, "thread.tension": 1.0, "analysis": [MOTION]},
        "in a large motion of a straight thread",
    ),
    (HELD, LIGHT, "between its ends it is slack"),
    (BUOY, {**LIGHT, "ends.b": TAIL}, "nothing pulls at this end or along the thread"),
    (HELD, {"thread.weight": 0.0}, "the stream runs along the line between the ends"),
    (HELD, {"stream.velocity": None, "ends.b.position": [0, 0, 2]}, "both ends lie on one vertical"),
    (
        BUOY,
        {"thread.reactive": "lighthill", "thread.added_mass": 1.0, "ends.b": TAIL},
        "the tension falls below that required by the moving liquid",
    ),
    (BUOY, {"stream.velocity": None, "analysis": [{"kind": "stability", "factors": [1, 2]}]}, "there is no stream"),
    (BUOY, {"thread.mass": 0.0, "analysis": [{"kind": "modes"}]}, "the analysis modes needs it"),
    (BUOY, {"analysis": [{**MOTION, "release": [{"end": "b"}]}]}, "this end is not fixed"),
    (
        BUOY,
        {"stream": None, "thread.normal_drag": 0.0, "analysis": [{**MOTION, "vortices": {"lift": 1}}]},
        "it takes a liquid and drag across the thread",
    ),
    (BUOY, {"load": [{"at": 1e-8}]}, "it is as good as at an end"),
    (BUOY, {"analysis": [{"kind": "stability", "factors": [1]}]}, "there is one"),
    (BUOY, {"analysis": [{**MOTION, "times": [0.0]}]}, "nothing moves by then"),
    (HELD, {"analysis": [{**MOTION, "release": [{"end": "b"}, {"end": "b"}]}]}, "it is let go twice"),
    (HELD, {"analysis": [{**MOTION, "release": [{"end": "b", "time": 2.0}]}]}, "the motion ends before"),
    (
        HELD,
        {**REACTIVE, "analysis": [{**MOTION, "release": [{"end": "b"}]}]},
        "an end is released with a reactive model",
    ),
    (
        BUOY,
        {**REACTIVE, "thread.axial_rigidity": 1e6, "analysis": [{**MOTION, "integrator": "generalized_alpha"}]},
        "Lighthill's momentum needs the midpoint rule",
    ),
    (
        BUOY,
        {"ends.b": {"kind": "surface", "level": 5.0}, "analysis": [{**MOTION, "start": "straight"}]},
        "it puts the other end at",
    ),
    (
        BUOY,
        {
            "thread.flexural_rigidity": 1.0,
            "ends.a.clamp": [1.0, 0.0, 0.0],
            "analysis": [{**MOTION, "start": "straight"}],
        },
        "the end is clamped in another",
    ),
    (HELD, {"analysis": [{**MOTION, "start": "straight"}]}, "both ends are fixed"),
    (BUOY, {"analysis": [{**MOTION, "move": [MOVED]}]}, "its times go from"),
]


@pytest.fixture(
    scope="module", params=[EXAMPLES[0], pytest.param(EXAMPLES[1], marks=pytest.mark.slow)], ids=["buoy", "hose"]
)
def outcome(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Outcome:
    """An example of the page, with its result folder but for the pictures."""
    folder = tmp_path_factory.mktemp("thread")
    file = folder / "example.toml"
    file.write_text(request.param, encoding="utf-8")
    # Coarser than the page asks, to be quick.
    scene = read_scene(file, ["accuracy.tolerance=1e-3"])
    return runner_of(scene)(scene, out=folder / "results", images=None)


@pytest.mark.slow
def test_examples_run(outcome: Outcome) -> None:
    assert outcome.status == "ok"


def test_all_files_columns_and_variables_are_told(outcome: Outcome) -> None:
    assert outcome.folder is not None
    for file in outcome.folder.glob("*.csv"):
        row = next(line for line in RESULTS.splitlines() if line.startswith(f"| `{file.name}`"))
        assert f"`{file.read_text(encoding='utf-8').splitlines()[0].replace(',', ', ')}`" in row
    arrays = array_variables(THREAD, outcome.solution)
    names = {name for array in arrays for name in (array.name, *array.dimensions)}
    assert {name for name in names if f"`{name}`" not in RESULTS} == set()
    assert all(f"`{file.name}`" in RESULTS for file in outcome.folder.iterdir() if file.is_file())


def _changed(base: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    scene = deepcopy(base)
    for way, value in changes.items():
        *tables, key = way.split(".")
        table = scene
        for name in tables:
            table = table[name]
        if value is None:
            del table[key]
        else:
            table[key] = value
    return scene


@pytest.mark.parametrize(("base", "changes", "said"), REFUSALS, ids=[said for _, _, said in REFUSALS])
def test_what_is_refused_is_said_so(base: dict[str, Any], changes: dict[str, Any], said: str, tmp_path: Path) -> None:
    (tmp_path / "motion.csv").write_text("0,0,0,0\n0.1,0,0,0\n0.2,0,0,0\n0.3,0,0,0\n", encoding="utf-8")
    context = {"folder": tmp_path}
    ThreadScene.model_validate(base, context=context)
    with pytest.raises(ValidationError, match=re.escape(said)):
        ThreadScene.model_validate(_changed(base, changes), context=context)


def test_all_that_is_told_to_be_refused_is_tried() -> None:
    assert sorted(REFUSED) == sorted(said for _, _, said in REFUSALS)


def test_all_shipped_threads_are_listed() -> None:
    names = [scene.name for scene in shipped_scenes() if read_scene(scene.name).kind == "thread"]
    assert len(names) == 7
    assert all(f"`{name}`" in PAGE for name in names)
