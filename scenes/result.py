"""Results in Python: solve a scene, keep its result in memory, save it, read a saved one."""

from __future__ import annotations

import io
import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from math import inf, nan
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np

from hydroelastic.output.dataset import DATASET, read_dataset
from hydroelastic.output.json_values import json_ready
from hydroelastic.output.open_water import quantities as water
from hydroelastic.output.outcome import Outcome
from hydroelastic.output.plots import DEFAULT_PICTURES, PictureOptions
from hydroelastic.output.provenance import SCENE, STATUS, Summary, read_summary
from hydroelastic.output.reading import Reading
from hydroelastic.output.sections import Section, printed_sections, read_markdown_sections, title_of
from hydroelastic.output.thread import quantities as thread
from hydroelastic.output.writer import TABLES
from hydroelastic.scenes.errors import Problem, SceneError, shown_value
from hydroelastic.scenes.kinds import runner_of
from hydroelastic.scenes.progress import progress
from hydroelastic.scenes.read import Scene, is_scene, read_scene, title_of_scene
from hydroelastic.scenes.report.captions import place_among_others
from hydroelastic.scenes.run import page_writer
from hydroelastic.scenes.words import proposal

if TYPE_CHECKING:
    import xarray
    from PIL.Image import Image


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Result:
    """The result of a scene. ``print`` shows the tables of the command line, and a notebook shows them as HTML.

    A result can be pickled: it then has its numbers, tables and dataset, and the pictures if they were drawn before,
    but not the solution, without which nothing else can be drawn or saved.

    Attributes:
        scene: the scene; ``None`` where the result was read from a folder.
        summary: all numbers with their errors, as ``summary.json`` has them.
        sections: the tables that a person reads.
        cost: a line about size and time.
        outcome: the solution on this process; ``None`` after pickling or reading.
    """

    scene: Scene | None
    summary: Summary
    sections: tuple[Section, ...]
    cost: str
    outcome: Outcome | None = None

    def __str__(self) -> str:
        return printed_sections(self.summary, self.sections, self.cost)

    def __repr__(self) -> str:
        return f"<Result of {title_of(self.summary)!r}: {read_summary(self.summary)[STATUS]}>"

    def _repr_html_(self) -> str:
        from hydroelastic.scenes.report.answer import answer
        from hydroelastic.scenes.report.write import rendered

        return rendered("notebook.html.jinja", result=self, answer=answer(self.summary), title=title_of(self.summary))

    def __getstate__(self) -> dict[str, Any]:
        """Return what is pickled (collective, if the dataset was not used before)."""
        return {**self.__dict__, "dataset": self.dataset, "outcome": None}

    @property
    def modes(self) -> np.recarray[Any, Any]:
        """The modes as records, one row each: ``modes.omega``, ``modes.relative_error`` and others, by kind of scene.

        Modes of tanks and strings, free motions of threads, and resonances of open water, whose ``omega`` is complex;
        no row where the scene asks for none. Missing numbers are NaN.
        """
        rows = list(_mode_rows(self.summary))
        if not rows:
            return np.recarray(0, dtype=[("omega", float), ("relative_error", float)])
        columns = {
            name: np.array([_NUMBERS.get(row[name], row[name]) for row in rows])
            for name, first in rows[0].items()
            if not isinstance(first, list | dict)
        }
        return np.rec.fromarrays(list(columns.values()), dtype=[(name, one.dtype) for name, one in columns.items()])

    @cached_property
    def dataset(self) -> xarray.Dataset:
        """The content of ``dataset.nc`` (collective when it is first used)."""
        dataset: xarray.Dataset = self._of_files(None)[0]
        return dataset

    @cached_property
    def pictures(self) -> dict[str, bytes]:
        """All pictures as PNG by their names, the main one first (collective when they are first used)."""
        pictures: dict[str, bytes] = self._of_files(DEFAULT_PICTURES)[1]
        return pictures

    def plot(self, name: str | None = None) -> Image:
        """Return a picture (collective). Notebooks show it; it has the methods ``show()`` and ``save("modes.png")``.

        Args:
            name: which of `pictures`; the main one by default.

        Raises:
            SceneError: if there is no such picture.
        """
        from PIL import Image

        shown = next(iter(self.pictures), None) if name is None else name
        if shown not in self.pictures:
            problem = Problem(
                key="picture",
                value=shown_value(name),
                wrong="there is no such picture of this result" if self.pictures else "it was saved without pictures",
                allowed=", ".join(self.pictures),
                remedy=proposal(str(name), self.pictures),
            )
            raise SceneError(problem)
        return Image.open(io.BytesIO(self.pictures[shown]))

    def save(
        self, folder: str | Path, *, images: PictureOptions | None = DEFAULT_PICTURES, report: bool = False
    ) -> None:
        """Write the result folder that the command run writes, whole or not at all (collective).

        What was asked and could not be drawn is a warning.

        Args:
            folder: the folder; files of an earlier result are replaced, all else is kept.
            images: how to draw; ``None`` draws nothing.
            report: whether to write ``report.html`` too.

        Raises:
            SceneError: if the folder cannot be written, or the solution is no longer there.
        """
        if images is not None and not isinstance(images, PictureOptions):
            allowed = 'he.PictureOptions(…), for example he.PictureOptions(formats=("svg",)), or None for no pictures'
            raise SceneError(Problem(key="images", value=repr(images), wrong="it is no option", allowed=allowed))
        if self.outcome is None or self.scene is None:
            remedy = "Solve the scene again, and save or draw that result"
            raise SceneError(Problem(key="result", wrong="it was pickled or read, without its solution", remedy=remedy))
        written = runner_of(self.scene).written(
            self.outcome, Path(folder), images=images, page=page_writer(self.scene) if report else None
        )
        for warning in written.warnings:
            warnings.warn(warning, stacklevel=2)

    def _of_files(self, images: PictureOptions | None) -> tuple[Any, Any]:
        """Dataset and pictures of this result, on all processes, by way of the files (collective)."""
        from mpi4py import MPI

        with TemporaryDirectory() as temporary:
            folder = Path(temporary) / "result"
            self.save(folder, images=images)
            found = None
            if MPI.COMM_WORLD.rank == 0:
                found = read_dataset(folder / DATASET)[0], _pictures_in(folder)
            return MPI.COMM_WORLD.bcast(found)


def solve(scene: Scene | str | Path | Mapping[str, Any], *, report: bool = False) -> Result:
    """Solve a scene; writes nothing (collective).

    Args:
        scene: the scene, or what `read` takes: the name or file of one, or a dictionary with the keys of a file.
        report: whether the current step is shown while it is solved, on a terminal or below the cell of a notebook.

    Raises:
        SceneError: if the scene, or a file that it names, cannot be used.
        UnsolvedError: if the scene cannot be solved.
    """
    given: Any = scene if is_scene(scene) else read_scene(scene)
    runner = runner_of(given)
    from mpi4py import MPI

    with progress(title_of_scene(given), shown=report and MPI.COMM_WORLD.rank == 0) as told:
        outcome = runner.solved(given, report=told)
    summary = json_ready(outcome.summary)
    return Result(scene=given, summary=summary, sections=outcome.sections, cost=outcome.cost, outcome=outcome)


def load(folder: str | Path) -> Result:
    """Read a result folder of the command run or of `Result.save`.

    Args:
        folder: the folder, with ``dataset.nc`` and ``summary.md``; its pictures, if there are any, are read too.

    Returns:
        The result without its scene and solution: it has all numbers, and cannot be saved or drawn again.

    Raises:
        SceneError: if it is no such folder.
    """
    try:
        folder = Path(folder)
        dataset, summary = read_dataset(folder / DATASET)
        sections, cost = read_markdown_sections((folder / TABLES).read_text(encoding="utf-8"))
        result = Result(scene=None, summary=summary, sections=sections, cost=cost)
        # What every result has: another program's summary lacks it.
        _ = repr(result), result.modes, result._repr_html_()
    except (OSError, LookupError, TypeError, ValueError, AttributeError, RecursionError) as error:
        wrong = f"its {DATASET} or {TABLES} is damaged, or is not that of a solved scene"
        if isinstance(error, OSError) and error.strerror:
            wrong = f"it cannot be read ({error.strerror})"
        remedy = "Name a folder that the command run or Result.save has written"
        raise SceneError(Problem(key=f"result folder {folder}", wrong=wrong, remedy=remedy)) from error
    # In place of the cached properties that the solution would give.
    vars(result).update(dataset=dataset, pictures=_pictures_in(folder))
    return result


_NUMBERS: dict[Any, float] = {None: nan, "inf": inf, "-inf": -inf}


def _mode_rows(summary: Summary) -> Iterator[dict[str, Any]]:
    for number, analysis in enumerate(summary.get(water.RESONANCE.key, ()), 1):
        found = Reading(water.RESONANCE, analysis)
        for (real, imaginary), error in zip(found[water.RESONANCE_OMEGA], found[water.RESONANCE_ERROR], strict=True):
            yield {"analysis": number, "omega": complex(real, imaginary), "relative_error": error}
    for number, mode in enumerate(summary.get(thread.MODES.key, ()), 1):
        if read_summary(summary)[SCENE]["kind"] == "thread":
            of_analysis = Reading(thread.MODES, mode)
            for kind in (thread.OSCILLATING, thread.APERIODIC):
                yield from ({"analysis": number, "kind": kind.key, **one.values} for one in of_analysis[kind])
        else:
            yield mode


def _pictures_in(folder: Path) -> dict[str, bytes]:
    files = sorted(folder.glob("images/*.png"), key=lambda file: place_among_others(file.stem))
    return {file.stem: file.read_bytes() for file in files}
