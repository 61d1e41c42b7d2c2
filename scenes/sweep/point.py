"""One point of a sweep: solve a scene, and keep what its tables, pictures and neighbours need."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any, Literal

from mpi4py import MPI
from pydantic import BaseModel

from hydroelastic.fem.sweep.mode_vectors import ModeVectors, array_of_text, array_text
from hydroelastic.output.plots import DEFAULT_PICTURES
from hydroelastic.output.provenance import Summary, versions
from hydroelastic.output.variables import Variable
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.kinds import runner_of
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.read import Scene, read_scene

Status = Literal["ok", "unconverged", "failed"]


@dataclass(frozen=True, kw_only=True)
class PointOptions:
    """What is done at each point beside the solution.

    Attributes:
        estimates: whether the estimates of older theories are made too.
        follow: whether the modes of closed tanks are kept for following them.
        pictures: folder for a result folder of each point, with its pictures; ``None`` writes none.
    """

    estimates: bool = False
    follow: bool = True
    pictures: Path | None = None


@dataclass(frozen=True, kw_only=True)
class SolvedPoint:
    """The result of one point.

    Attributes:
        status: "ok", "unconverged" (solved, but not to its tolerance), or "failed".
        reasons: why it is not "ok".
        summary: content of ``summary.json``; ``None`` if it failed.
        arrays: variables that are no part of the summary, of open water.
        modes: of a closed tank, for following them.
    """

    status: Status
    reasons: tuple[str, ...]
    summary: Summary | None = None
    arrays: tuple[Variable, ...] = ()
    modes: ModeVectors | None = None

    def as_json(self) -> dict[str, Any]:
        """Return the point in types of JSON."""
        content: dict[str, Any] = {"status": self.status, "reasons": self.reasons, "summary": self.summary}
        content["arrays"] = [vars(one) | {"values": array_text(one.values)} for one in self.arrays]
        return content | {"modes": None if self.modes is None else self.modes.as_texts()}

    @classmethod
    def from_json(cls, content: dict[str, Any]) -> SolvedPoint:
        """Return the point of `as_json`."""
        modes = content["modes"]
        return cls(
            status=content["status"],
            reasons=tuple(content["reasons"]),
            summary=content["summary"],
            arrays=tuple(
                Variable(**one | {"values": array_of_text(one["values"]), "dimensions": tuple(one["dimensions"])})
                for one in content["arrays"]
            ),
            modes=None if modes is None else ModeVectors.of_texts(modes),
        )


@dataclass(frozen=True, kw_only=True)
class Task:
    """One point to solve.

    Attributes:
        key: of the point in the journal.
        scene: of the point.
        name: of its folder, if it has one.
    """

    key: str
    scene: Scene
    name: str


def identity(scene: Scene) -> str:
    """Return what identifies a scene: its values, and hashes of the bytes of all files that it names, of its section
    too."""
    texts = [scene.model_dump_json()]
    for named in _paths(scene):
        file = scene.folder / named
        # The names of the parts of a mesh, and the numbers of XDMF, stand in files beside it.
        beside = (file.with_name(f"{file.name}.names.json"), file.with_suffix(".h5"))
        texts += [f"{one.name} {sha256(one.read_bytes()).hexdigest()}" for one in (file, *beside) if one.is_file()]
    if scene.kind == "roll" and scene.section_file is not None:
        with suppress(SceneError):
            texts.append(identity(read_scene(scene.section_file)))
    return "\n".join(texts)


def _paths(value: Any) -> Iterator[Path]:
    if isinstance(value, Path):
        yield value
    elif isinstance(value, BaseModel):
        for _, entry in value:
            yield from _paths(entry)
    elif isinstance(value, tuple):
        for entry in value:
            yield from _paths(entry)


def point_key(scene: Scene, options: PointOptions) -> str:
    """Return what identifies a result: a hash of the scene, of files that it names, of options and of versions."""
    content = [options.estimates, options.follow, str(options.pictures or ""), versions()]
    return sha256(f"{identity(scene)}{json.dumps(content, sort_keys=True)}".encode()).hexdigest()


def solve_point(task: Task, options: PointOptions) -> SolvedPoint:
    """Solve a point (collective); what goes wrong with it is kept as its reason."""
    try:
        return _solved(task, _solution(task, options), options)
    except Exception as error:
        return failed(error)


def _solution(task: Task, options: PointOptions) -> Any:
    run = runner_of(task.scene)
    solve: Callable[..., Any] = run.solve if options.estimates else run.solve_alone or run.solve
    return solve(task.scene, MPI.COMM_WORLD, lambda _message: None)


def _solved(task: Task, solution: Any, options: PointOptions) -> SolvedPoint:
    run, scene = runner_of(task.scene), task.scene
    outcome = run.outcome(scene, solution, tables=options.pictures is not None)
    if options.pictures is not None:
        outcome = run.written(outcome, options.pictures / task.name, images=DEFAULT_PICTURES)
    modes = None
    if options.follow and isinstance(scene, TankScene) and not scene.is_open:
        from hydroelastic.fem.closed.shapes import mode_vectors

        modes = mode_vectors(solution.tank)
    return SolvedPoint(
        status="unconverged" if outcome.reasons else "ok",
        reasons=outcome.reasons,
        summary=outcome.summary,
        arrays=() if run.swept is None else tuple(run.swept(solution)),
        modes=modes,
    )


def failed(error: BaseException) -> SolvedPoint:
    """Return the point that an error prevented."""
    said = str(error) or type(error).__name__
    known = isinstance(error, SceneError) or not said
    return SolvedPoint(status="failed", reasons=(said if known else f"{type(error).__name__}: {said}",))
