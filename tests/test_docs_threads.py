"""The page of threads: its examples run; its refusals and results are those of the code."""

import re
from copy import deepcopy
from pathlib import Path
from typing import Any

import pytest
import xarray
from mutated_scenes import as_toml

import hydroelastic as he

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


# The second one takes seconds.
@pytest.mark.slow_but("buoy")
@pytest.mark.parametrize("text", EXAMPLES[:2], ids=["buoy", "hose"])
def test_examples_run_and_all_their_files_columns_and_arrays_are_told(text: str, tmp_path: Path) -> None:
    (tmp_path / "example.toml").write_text(text, encoding="utf-8")
    # Coarser than the page asks, to be quick.
    result = he.solve(he.read(tmp_path / "example.toml", ["accuracy.tolerance=1e-3"]))
    assert result.summary["status"] == "ok"
    folder = tmp_path / "results"
    result.save(folder, images=None)
    for file in folder.glob("*.csv"):
        row = next(line for line in RESULTS.splitlines() if line.startswith(f"| `{file.name}`"))
        assert f"`{file.read_text(encoding='utf-8').splitlines()[0].replace(',', ', ')}`" in row
    assert all(f"`{file.name}`" in RESULTS for file in folder.iterdir() if file.is_file())
    with xarray.open_dataset(folder / "dataset.nc") as dataset:
        along = {name for name, array in dataset.data_vars.items() if {"node", "s"} & set(array.dims)}
    assert along
    assert {name for name in along if f"`{name}`" not in RESULTS} == set()


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
    accepted = {"kind": "thread", **base}
    assert he.read(accepted).kind == "thread"
    (tmp_path / "scene.toml").write_text(as_toml({"kind": "thread", **_changed(base, changes)}), encoding="utf-8")
    with pytest.raises(he.SceneError, match=re.escape(said)):
        he.read(tmp_path / "scene.toml")


def test_all_that_is_told_to_be_refused_is_tried() -> None:
    assert sorted(REFUSED) == sorted(said for _, _, said in REFUSALS)


def test_all_shipped_threads_are_listed() -> None:
    names = [scene.name for scene in he.shipped_scenes() if he.read(scene.name).kind == "thread"]
    assert len(names) == 7
    assert all(f"`{name}`" in PAGE for name in names)
