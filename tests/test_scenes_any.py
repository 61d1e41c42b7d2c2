"""Whatever a scene holds, it is accepted or refused in words; and what a check accepts, the start of a run accepts."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from any_scenes import MODELS, Document, as_toml, damaged, documents, holds_nan, kind_of, shipped_documents
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from hydroelastic.output.sections import Section
from hydroelastic.scenes.errors import MOST_PROBLEMS_SHOWN, SceneError, shown_value
from hydroelastic.scenes.kinds import checker_of
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.read import SHIPPED_FOLDER, Scene, read_scene
from hydroelastic.scenes.tank.check import modelled_tank
from hydroelastic.scenes.validation_errors import scene_error

# The same examples in every run: a failure is found again.
REPRODUCIBLE = settings(
    derandomize=True,
    deadline=None,
    database=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)
QUICK = settings(REPRODUCIBLE, max_examples=15)
MANY = settings(REPRODUCIBLE, max_examples=2500)

# What Python and its libraries say of values and errors.
FOREIGN = re.compile(
    r"array\(|<class|<function|object at 0x|Input should|validation error|pydantic|Traceback|float64|int64|\bNone\b|"
    r"\bdict\b|\btuple\b|PosixPath|ValueError|TypeError|Errno|\{'\w"
)


@pytest.fixture(scope="module")
def folder() -> Iterator[Path]:
    """Where scenes are written, with a table of two columns and those of the shipped scenes."""
    with TemporaryDirectory() as name:
        for table in SHIPPED_FOLDER.glob("*.csv"):
            shutil.copy(table, name)
        (Path(name) / "table.csv").write_text("0, 0\n1, 0.1\n2, 0.3\n3, 0.2\n4, 0\n", encoding="utf-8")
        yield Path(name)


def is_in_words(error: SceneError, document: Document) -> bool:
    """One line for each problem, with what is wrong and where, and nothing of what only programmers know."""
    said = str(error)
    problems = len(error.problems)
    lines = 1 if problems == 1 else 1 + min(problems, MOST_PROBLEMS_SHOWN) + (problems > MOST_PROBLEMS_SHOWN)
    assert len(re.split("[\n\r]", said)) == lines, said
    assert all(part.isprintable() for part in said.split("\n")), said
    assert all(problem.wrong and _is_found(problem.key, document) for problem in error.problems), said
    assert not FOREIGN.search(said), said
    assert holds_nan(document) or not re.search(r"\bnan\b", said), said
    return True


def _is_found(key: str, document: Document) -> bool:
    """Whether the author can tell where a key is: its table, or its own name, is one of the scene's."""
    known = {*document, "kind", *(name for model in MODELS.values() for name in model.model_fields)}
    return not key or any(key.startswith((f"[{name}]", f"[[{name}]]", f'key "{name}')) for name in map(shown, known))


def shown(name: str) -> str:
    return shown_value(name)[1:-1]


def of_text(document: Document, folder: Path) -> Scene | None:
    """The scene of a document by its text; ``None`` if it is refused in words."""
    file = folder / "scene.toml"
    file.write_text(as_toml(document), encoding="utf-8")
    try:
        return read_scene(file)
    except SceneError as error:
        refused = error
    assert is_in_words(refused, document)
    return None


def of_model(document: Document, family: str) -> Scene | None:
    """The scene of a document by its model; ``None`` if it is refused in words."""
    try:
        return MODELS[family].model_validate(document)
    except ValidationError as error:
        refused = scene_error(error, MODELS[family])
    assert is_in_words(refused, document)
    return None


def start(scene: Scene, document: Document) -> None:
    """Do what comes before anything is solved; a tank's mesh takes too long here."""
    try:
        if isinstance(scene, TankScene) and not scene.is_open:
            physical_tank(scene).scaled()
            sections = tuple(modelled_tank(scene, requests=(), scale=Section(title="Size")))
        else:
            sections = tuple(checker_of(scene)(scene))
    except SceneError as error:
        refused = error
    else:
        told = "\n".join(
            part for section in sections for row in (section.lines, section.notes, *section.rows) for part in row
        )
        assert not re.search(r"\bnan\b|array\(|<class", told), told
        return
    assert is_in_words(refused, document)


def follow(family: str, document: Document, folder: Path) -> None:
    """A document through its text and through its model, and on as far as nothing is solved."""
    by_text = of_text(document, folder)
    by_model = of_model(document, family) if document.get("kind") in (None, kind_of(family)) else None
    for scene in (by_text, by_model):
        if scene is not None:
            start(scene, document)
    if by_model is not None:
        # What was accepted is accepted again as it is written.
        assert MODELS[family].model_validate(by_model.model_dump(mode="json")).model_dump() == by_model.model_dump()


TANK: Document = {"kind": "tank", "tank": {"length": 10.0}, "liquid": [{"density": 1000.0, "depth": 5.0}]}
STRING: Document = {"kind": "string", "string": {"length": 1.0, "linear_density": 1.0}}
STEP: Document = {"motion": {"kind": "step", "amplitude": 1.0}}
ONCE_WRONG: dict[str, tuple[Document, str]] = {
    "a mesh whose name is no path": (TANK | {"mesh": {"file": "a\0b.msh"}}, "there is no file"),
    "a mesh whose name has two lines": (TANK | {"mesh": {"file": "a\nb.msh"}}, "there is no file"),
    "a section whose name has two lines": (
        {"kind": "roll", "roll": {"section": "a\nb", "angle": 0.1}},
        "there is no such file",
    ),
    "times by default beyond all limits, of a ship": (
        {"kind": "roll", "roll": {"natural_frequency": 1e-30, "angle": 0.1}},
        '[output], key "times" = ',
    ),
    "times by default beyond all limits, of a string": (
        STRING | STEP | {"string": {"length": 1e30, "linear_density": 1.0, "gravity": 1e-30}},
        "a wave would take 2e+30 s along the string",
    ),
    "ratios that overflow": (
        STRING | STEP | {"output": {"times": {"start": 5e-324, "stop": 1e30, "number": 5, "spacing": "logarithmic"}}},
        "equal ratios cannot start so close to 0",
    ),
}


def _read_and_check(file: Path) -> None:
    scene = read_scene(file)
    tuple(checker_of(scene)(scene))


@pytest.mark.parametrize("case", ONCE_WRONG)
def test_what_was_once_refused_in_other_words(case: str, folder: Path) -> None:
    document, said = ONCE_WRONG[case]
    (folder / "scene.toml").write_text(as_toml(document), encoding="utf-8")
    with pytest.raises(SceneError) as caught:
        _read_and_check(folder / "scene.toml")
    assert is_in_words(caught.value, document)
    assert said in str(caught.value)


@pytest.mark.parametrize("family", MODELS)
def test_any_scene_is_accepted_or_refused_in_words(family: str, folder: Path) -> None:
    @QUICK
    @given(damaged(family))
    def check(document: Document) -> None:
        follow(family, document, folder)

    check()


@pytest.mark.slow
@pytest.mark.parametrize("family", MODELS)
def test_ten_thousand_scenes_are_accepted_or_refused_in_words(family: str, folder: Path) -> None:
    @MANY
    @given(damaged(family))
    def check(document: Document) -> None:
        follow(family, document, folder)

    check()


@pytest.mark.slow
@pytest.mark.parametrize("family", MODELS)
def test_what_is_drawn_reaches_every_key_of_the_models(family: str) -> None:
    """Else the properties above would say nothing of a key that was added later."""
    seen: set[str] = set()

    @settings(QUICK, max_examples=1500)
    @given(documents(MODELS[family]))
    def draw(document: Document) -> None:
        seen.update(_keys(document))

    draw()
    assert seen >= set(_keys_of(MODELS[family].model_json_schema()))
    assert shipped_documents(family)


def _keys(value: Any) -> Iterator[str]:
    for key, inner in value.items() if isinstance(value, dict) else ():
        yield key
        yield from _keys(inner)
    for inner in value if isinstance(value, list) else ():
        yield from _keys(inner)


def _keys_of(schema: Any) -> Iterator[str]:
    for key, inner in schema.items() if isinstance(schema, dict) else ():
        yield from inner if key == "properties" else ()
        yield from _keys_of(inner)
    for inner in schema if isinstance(schema, list) else ():
        yield from _keys_of(inner)


@settings(REPRODUCIBLE, max_examples=150)
@given(st.one_of(st.binary(max_size=60), st.text(max_size=60).map(lambda text: text.encode("utf-8", "surrogatepass"))))
def test_any_bytes_are_refused_in_words(folder: Path, content: bytes) -> None:
    (folder / "bytes.toml").write_bytes(content)
    with pytest.raises(SceneError) as caught:
        read_scene(folder / "bytes.toml")
    assert len(str(caught.value).splitlines()) == 1


@settings(REPRODUCIBLE, max_examples=150)
@given(st.one_of(st.text(max_size=30), st.from_regex(r"[a-z.0-9]{1,12}=[^\x00]{0,12}", fullmatch=True)))
def test_any_override_is_taken_or_refused_in_words(change: str) -> None:
    try:
        read_scene("aquarium", [change])
    except SceneError as error:
        refused = error
    else:
        return
    assert not FOREIGN.search(str(refused).replace(change, ""))
