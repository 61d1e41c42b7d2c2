"""Scenes from TOML files: reading, overrides, and the scenes that come with the package."""

from __future__ import annotations

import contextlib
import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from pydantic import BaseModel, ValidationError

from hydroelastic.scenes import models
from hydroelastic.scenes.errors import Problem, SceneError, shown_value
from hydroelastic.scenes.models.scene_model import plain
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.models.tank_kinds import is_canal, is_level_tank, is_round_tank
from hydroelastic.scenes.number_texts import how_to_write_line
from hydroelastic.scenes.overrides import TOO_DEEP, Document, changes_of, is_too_deep, override, parsed_toml
from hydroelastic.scenes.program import PROGRAM
from hydroelastic.scenes.validation_errors import scene_error
from hydroelastic.scenes.words import nearest, proposal

if TYPE_CHECKING:
    from hydroelastic.scenes.models.level_tank import LevelTankScene
    from hydroelastic.scenes.models.roll import RollScene
    from hydroelastic.scenes.models.round_tank import OrderedTankScene
    from hydroelastic.scenes.models.sea import SeaScene
    from hydroelastic.scenes.models.string import StringScene
    from hydroelastic.scenes.models.thread import ThreadScene

Scene: TypeAlias = "TankScene | SeaScene | LevelTankScene | OrderedTankScene | StringScene | ThreadScene | RollScene"


class _SceneModels(Mapping[str, "type[Scene]"]):
    def __getitem__(self, kind: str) -> type[Scene]:
        if kind not in tuple(self):
            raise KeyError(kind)
        model: type[Scene] = getattr(models, f"{kind.title()}Scene")
        return model

    def __iter__(self) -> Iterator[str]:
        return iter(("tank", "sea", "string", "thread", "roll"))

    def __len__(self) -> int:
        return 5


SCENE_MODELS = _SceneModels()
"""Which model a ``kind`` is read with."""

MOST_BYTES = 20_000_000
"""Of a scene's file: 100,000 waves or points, written out, take less."""

STANDARD_INPUT = Path("-")
"""In place of a scene's file: the scene comes from the standard input; its paths start at the current folder."""

SHIPPED_FOLDER = Path(__file__).resolve().parent


@dataclass(frozen=True, kw_only=True)
class ShippedScene:
    """A scene that comes with the package.

    Attributes:
        name: the name by which it is read, such as ``aquarium``.
        path: its TOML file.
        title: its title.
    """

    name: str
    path: Path
    title: str


def shipped_scenes() -> tuple[ShippedScene, ...]:
    """Return the scenes that come with the package, sorted by name; each has ``name``, ``path`` and ``title``."""
    return tuple(
        # Not validated: the sections of floats need SciPy, whose import is slow.
        ShippedScene(name=path.stem, path=path, title=_parse(path)["title"])
        for path in sorted(SHIPPED_FOLDER.glob("*.toml"))
    )


def scene_path(scene: str | Path) -> Path:
    """Return the file of a scene given by its path or, for a shipped one, by its bare name; `STANDARD_INPUT` for ``-``.

    A file of that very name comes first.

    Raises:
        SceneError: if there is no such file, or it is a folder or a device.
    """
    path = Path(scene)
    if path == STANDARD_INPUT:
        return path
    shipped = SHIPPED_FOLDER / f"{path}.toml"
    try:
        if path.is_file():
            return path
        if path.name == str(scene) and shipped.is_file():
            return shipped
        exists, is_folder = path.exists(), path.is_dir()
    except OSError as error:
        raise _unusable(path, f"it cannot be read ({error.strerror})") from error
    if is_folder:
        raise _unusable(path, "it is a folder", "Name a scene file (*.toml) in it")
    if exists:
        raise _unusable(path, "it is not a regular file", "Save the scene in a file")
    raise _unusable(path, "there is no such file and no shipped scene of that name", _proposed_scene(path))


def _proposed_scene(path: Path) -> str:
    with_ending = path.with_name(f"{path.name}.toml")
    with contextlib.suppress(OSError):
        if with_ending.is_file():
            return f'Did you mean "{with_ending}"?'
    names = [file.stem for file in SHIPPED_FOLDER.glob("*.toml")]
    return proposal(path.stem, names) or f"See the shipped scenes with `{PROGRAM} list` or he.shipped_scenes()"


def read_scene(
    scene: Scene | str | Path | Mapping[str, Any], overrides: Iterable[str] | Mapping[str, Any] = ()
) -> Scene:
    """Read and validate a scene.

    Args:
        scene: a TOML file, or the bare name of a shipped scene such as ``aquarium``, or ``-`` for the standard input;
            or a dictionary with the keys of a file; or a scene that is to be changed.
        overrides: replacements by dotted key, made before validation; entries are numbered from 1:
            ``{"body.1.start": 2.5, "accuracy.tolerance": 1e-8}``. On the command line they are texts ``key=value``
            with TOML values, ``body.1.start=2.5``, where an unquoted word is a text.

    Returns:
        The scene; the path of a mesh file is complete.

    Raises:
        SceneError: if the file, an override or a value is invalid; it lists all errors.
    """
    return scene_source(scene).scene(overrides)


@dataclass(frozen=True, kw_only=True)
class SceneSource:
    """A scene before it is validated, in which values can be replaced.

    Attributes:
        document: its tables and values.
        file: where it was read; ``None`` if it was made in Python.
        folder: to which the paths of files that it names are relative; ``None`` is the current one.
    """

    document: Document
    file: Path | None
    folder: Path | None = None

    def scene(self, *overrides: Iterable[str] | Mapping[str, Any]) -> Scene:
        """Return the scene with replacements, see `read_scene`; later ones come after earlier ones.

        Raises:
            SceneError: if an override or a value is invalid.
        """
        label = _label(self.file) if self.file is not None else "the scene"
        if is_too_deep(self.document):
            raise SceneError(Problem(wrong=f"it is not a scene: {TOO_DEEP}"), file=label)
        document = deepcopy(self.document)
        changes = tuple(change for some in overrides for change in changes_of(some))
        for change in changes:
            override(document, change)
        if changes:
            label += f" with {' '.join(f'{change.option} {change.text}' for change in changes)}"
        model = _model_of(document, label)
        context: dict[str, Any] | None = None if self.folder is None else {"folder": self.folder}
        if self.file is not None:
            context = {"folder": self.file.parent, "source": label}
        try:
            scene = model.model_validate(document, context=context)
        except ValidationError as error:
            raise scene_error(error, model, file=label) from None
        return _with_mesh_beside(scene, self.file) if self.file is not None and isinstance(scene, TankScene) else scene


def scene_source(scene: Scene | str | Path | Mapping[str, Any]) -> SceneSource:
    """Return what a scene is made of.

    Args:
        scene: a scene, the name of a shipped one, a TOML file, or a dictionary with the keys of a file.

    Raises:
        SceneError: if the file cannot be read, or it is none of these.
    """
    if isinstance(scene, str | Path):
        file = scene_path(scene)
        return SceneSource(document=_parse(file), file=file)
    if not isinstance(scene, Mapping) and not is_scene(scene):
        allowed = "a scene, the name of a shipped scene, a file, or a dictionary with the keys of a file"
        raise SceneError(Problem(key="scene", value=repr(scene)[:60], wrong="it is not a scene", allowed=allowed))
    if isinstance(scene, Mapping):
        if is_too_deep(dict(scene)):
            raise SceneError(Problem(key="scene", wrong=TOO_DEEP))
        return SceneSource(document=_as_read(dict(scene)), file=None)
    # The dictionary of a scene would have what was computed of it, too.
    return SceneSource(document=_as_read(scene), file=None, folder=scene.folder)


def is_scene(value: Any) -> bool:
    """Return whether a value is a whole scene, which has a title, and not one of its tables."""
    return isinstance(value, BaseModel) and "title" in type(value).model_fields


def _as_read(value: Any) -> Any:
    """The values of a scene in the types that a file gives: lists in place of tuples, nothing in place of ``None``."""
    if isinstance(value, BaseModel):
        return _as_read(value.model_dump())
    value = plain(value)
    if isinstance(value, dict):
        return {key: _as_read(entry) for key, entry in value.items() if entry is not None}
    return [_as_read(entry) for entry in value] if isinstance(value, list | tuple) else value


def title_of_scene(scene: Scene) -> str:
    """Return the title of a scene for messages."""
    return scene.title or "Untitled scene"


def closed_tank(scene: Scene, because: str) -> TankScene:
    """Return the scene of a closed tank, and refuse any other.

    Args:
        scene: the scene.
        because: reason why other scenes are refused.

    Raises:
        SceneError: if it is of another kind, or the ends of the tank are open.
    """
    if not isinstance(scene, TankScene):
        if scene.kind == "tank":
            remedy = "The command run takes three dimensions, with an error estimate at any accuracy.tolerance"
            raise SceneError(Problem(key="[tank]", wrong=f"{because} per metre of width", remedy=remedy))
        raise SceneError(_misplaced('key "kind"', scene.kind, because, allowed='"tank"', what="this kind"))
    if scene.is_open:
        raise SceneError(
            _misplaced('[tank], key "ends"', scene.tank.ends, because, allowed='"walls"', what="open ends")
        )
    return scene


def _misplaced(key: str, value: str, because: str, *, allowed: str, what: str) -> Problem:
    remedy = f"The command run takes {what}"
    return Problem(key=key, value=shown_value(value), wrong=because, allowed=allowed, remedy=remedy)


def _unusable(path: Path, wrong: str, remedy: str = "") -> SceneError:
    return SceneError(Problem(wrong=wrong, remedy=remedy), file=_label(path))


def _parse(file: Path) -> Document:
    try:
        # One byte more tells that there are too many.
        piped = _piped() if file == STANDARD_INPUT else None
        size = file.stat().st_size if piped is None else len(piped)
        if size > MOST_BYTES:
            wrong = f"it is {size / 1e6:.3g} MB large, and a scene takes {MOST_BYTES / 1e6:g} MB at most"
            raise _unusable(file, wrong, "Name tables of numbers in files of their own")
        content = file.read_bytes() if piped is None else piped
    except OSError as error:
        raise _unusable(file, f"it cannot be read ({error.strerror})") from error
    try:
        # Some editors put a byte order mark in front.
        document = parsed_toml(content.decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise _unusable(file, f"it is not UTF-8 text (line {line})", "Save it as UTF-8") from error
    except ValueError as error:  # TOMLDecodeError, or a number of thousands of digits
        if str(error) == TOO_DEEP:
            raise _unusable(file, f"it is not a scene: {TOO_DEEP}") from error
        wrong = f"it is not TOML: {_uncapitalised(str(error))}"
        raise _unusable(file, wrong, _mended_line(content.decode("utf-8-sig"), str(error))) from error
    if not document:
        raise _unusable(file, "it is empty", f"A scene begins with {_known_kinds()}")
    return document


def _piped() -> bytes:
    if sys.stdin is None or sys.stdin.closed:
        raise _unusable(STANDARD_INPUT, "it is closed", "Pipe a scene into the command, or name its file")
    if sys.stdin.isatty():
        raise _unusable(STANDARD_INPUT, "it is a terminal", "Pipe a scene into the command, or name its file")
    return sys.stdin.buffer.read(MOST_BYTES + 1)


def _label(file: Path) -> str:
    return "the standard input" if file == STANDARD_INPUT else str(file)


def _mended_line(text: str, error: str) -> str:
    """The corrected number in the line of a TOML error, if a number is the cause."""
    named = re.search(r"at line (\d+)", error)
    return how_to_write_line(text.split("\n")[int(named[1]) - 1]) if named else ""


def _uncapitalised(text: str) -> str:
    return text[:1].lower() + text[1:]


def _known_kinds() -> str:
    return " or ".join(f'kind = "{kind}"' for kind in SCENE_MODELS)


def _model_of(document: Document, label: str) -> type[Scene]:
    if "kind" not in document:
        known = {key for model in SCENE_MODELS.values() for key in model.model_fields}
        near = nearest("kind", [key for key in document if key not in known])
        remedy = f'Instead there is "{near}"' if near is not None else ""
        missing = Problem(key='key "kind"', wrong="it is missing", allowed=_known_kinds(), remedy=remedy)
        raise SceneError(missing, file=label)
    kind = document["kind"]
    if not isinstance(kind, str) or kind not in SCENE_MODELS:
        allowed = " or ".join(f'"{known}"' for known in SCENE_MODELS)
        problem = Problem(
            key='key "kind"',
            value=shown_value(kind),
            wrong="it is not a kind of scene",
            allowed=allowed,
            remedy=proposal(str(kind), SCENE_MODELS),
        )
        raise SceneError(problem, file=label)
    if kind == "tank" and is_round_tank(document):
        from hydroelastic.scenes.models.round_tank import RoundTankScene

        return RoundTankScene
    if kind == "tank" and is_canal(document):
        from hydroelastic.scenes.models.round_tank import CanalScene

        return CanalScene
    if kind == "tank" and is_level_tank(document):
        from hydroelastic.scenes.models.level_tank import LevelTankScene

        return LevelTankScene
    return SCENE_MODELS[kind]


def _with_mesh_beside(scene: TankScene, file: Path) -> TankScene:
    """Complete the path of a user's mesh from the folder of the scene, and check that it exists."""
    if scene.mesh is None:
        return scene
    try:
        mesh_file = (file.parent / scene.mesh.file).resolve()
    except (OSError, ValueError, RuntimeError):  # a text that is no path, or links that lead to themselves
        mesh_file = file.parent / scene.mesh.file
    if not mesh_file.is_file():
        problem = Problem(
            key='[mesh], key "file"', value=shown_value(str(scene.mesh.file)), wrong=f"there is no file {mesh_file}"
        )
        raise SceneError(problem, file=file)
    return scene.model_copy(update={"mesh": scene.mesh.model_copy(update={"file": mesh_file})})
