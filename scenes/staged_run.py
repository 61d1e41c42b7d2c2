"""The run of a scene in stages, which each kind of scene implements: solve, summarize, tabulate, write, draw."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from time import perf_counter
from typing import Any, Generic, TypeVar

from mpi4py import MPI
from pydantic import BaseModel

from hydroelastic.fem.progress import Report
from hydroelastic.output.folder import written_by_run
from hydroelastic.output.outcome import Outcome
from hydroelastic.output.pictures.options import DEFAULT_PICTURES, PictureOption, PictureOptions
from hydroelastic.output.provenance import SECONDS, Solved, Summary, read_summary, summarize
from hydroelastic.output.quantities import Group
from hydroelastic.output.reading import Reading
from hydroelastic.output.sections import Section, markdown_sections
from hydroelastic.output.variables import Variable, array_variables
from hydroelastic.output.writer import write_results
from hydroelastic.scenes.errors import folder_errors

_Scene = TypeVar("_Scene", bound=BaseModel, contravariant=True)
_Solution = TypeVar("_Solution", bound=Solved, contravariant=True)


def _as_solved(solution: Any, _summary: Reading) -> Any:
    return solution


def _nothing(_solution: Any) -> tuple[str, ...]:
    return ()


def _no_parts(_sample: Any) -> None:
    return None


@dataclass(frozen=True, kw_only=True)
class StagedRun(Generic[_Scene, _Solution]):
    """Runs scenes of one kind.

    Attributes:
        solve: returns the solution of a scene (collective).
        kind: the quantities of a solution, from which ``summary.json`` and ``dataset.nc`` are made.
        sections: returns the tables.
        cost: returns a line about size and time.
        write: writes files of numbers into a folder, on rank 0.
        draw: draws into a folder, on rank 0, and reports each picture.
        used_options: the options that the pictures use; a run warns that others have no effect.
        animation_warnings: returns limitations of an animation of the solution, and the key to set; none by default.
        sample: samples the solution for files and pictures (collective); the solution itself by default.
        sampling_warnings: returns what could not be sampled, and why; none by default.
        arrays: returns the arrays of ``dataset.nc`` alone, on rank 0; by default those declared in `kind`.
        attributes: of ``dataset.nc`` as a whole, further ones.
        swept: returns labelled arrays of a solution that a sweep keeps beside its summary; ``None`` for none.
        write_parts: returns what writes files of each process into a folder (collective); ``None`` by default.
        solve_alone: as `solve`, without the estimates of older theories; `solve` by default, which then makes none.
    """

    solve: Callable[[_Scene, MPI.Comm, Report], _Solution]
    kind: Group
    sections: Callable[[_Solution, Reading], Iterable[Section]]
    cost: Callable[[Reading], str]
    write: Callable[[Any, Path], None]
    draw: Callable[[Any, Path, PictureOptions, Report], None]
    used_options: frozenset[PictureOption]
    animation_warnings: Callable[[_Solution], tuple[str, ...]] = _nothing
    sample: Callable[[_Solution, Reading], Any] = _as_solved
    sampling_warnings: Callable[[Any], tuple[str, ...]] = _nothing
    arrays: Callable[[Any], Iterable[Variable]] | None = None
    attributes: Mapping[str, str] = field(default_factory=dict)
    swept: Callable[[_Solution], Iterable[Variable]] | None = None
    write_parts: Callable[[Any], Callable[[Path], None] | None] = _no_parts
    solve_alone: Callable[[_Scene, MPI.Comm, Report], _Solution] | None = None

    def __call__(
        self,
        scene: _Scene,
        *,
        out: Path | None = None,
        scene_file: Path | None = None,
        images: PictureOptions | None = DEFAULT_PICTURES,
        page: Callable[[Outcome, Path], None] | None = None,
        import_seconds: float = 0.0,
        report: Report = lambda _message: None,
    ) -> Outcome:
        """Solve a scene and write its result folder (collective)."""
        outcome = self.solved(scene, import_seconds=import_seconds, report=report)
        if out is None:
            return outcome
        return self.written(outcome, out, scene_file=scene_file, images=images, page=page, report=report)

    def solved(self, scene: _Scene, *, import_seconds: float = 0.0, report: Report = lambda _message: None) -> Outcome:
        """Solve a scene; write nothing (collective). The arguments and errors are those of a call."""
        start = perf_counter()
        solution = self.solve(scene, MPI.COMM_WORLD, report)
        return self.outcome(scene, solution, seconds=import_seconds + perf_counter() - start)

    def outcome(self, scene: _Scene, solution: _Solution, *, tables: bool = True, seconds: float = 0.0) -> Outcome:
        """Return the outcome of a solution (collective)."""
        summary = self.summarized(scene, solution, seconds)
        told = self.read(summary)
        sections = tuple(self.sections(solution, told)) if tables else ()
        return Outcome(solution=solution, summary=summary, sections=sections, cost=self.cost(told))

    def summarized(self, scene: _Scene, solution: _Solution, seconds: float = 0.0) -> Summary:
        """Return the content of ``summary.json`` (collective)."""
        return summarize(self.kind, solution, scene.model_dump(mode="json"), seconds)

    def read(self, summary: Summary) -> Reading:
        """Return a summary as sections read it."""
        return read_summary(summary, self.kind)

    def written(
        self,
        outcome: Outcome,
        out: Path,
        *,
        scene_file: Path | None = None,
        images: PictureOptions | None = DEFAULT_PICTURES,
        page: Callable[[Outcome, Path], None] | None = None,
        report: Report = lambda _message: None,
    ) -> Outcome:
        """Write the result folder of a solved scene (collective). The arguments and errors are those of a call."""
        solution = outcome.solution
        summary, start = {**outcome.summary}, perf_counter()
        # Read before anything is written there.
        replaces = written_by_run(out) is not None
        report("fields")
        sampled = self.sample(solution, self.read(summary))
        summary[SECONDS.key] += perf_counter() - start
        missing = self.sampling_warnings(sampled)
        if images is not None:
            missing += images.without_effect(self.used_options)
            missing += self.animation_warnings(solution) if images.animate else ()

        def with_warnings(warnings: tuple[str, ...]) -> Outcome:
            # Writing has added its seconds to the summary.
            return replace(
                outcome,
                summary=summary,
                cost=self.cost(self.read(summary)),
                folder=out,
                warnings=(*warnings, *missing),
                replaces=replaces,
            )

        with folder_errors():
            warnings = write_results(
                out,
                summary,
                scene_file=scene_file,
                tables=lambda folder: self.write(sampled, folder),
                arrays=lambda: array_variables(self.kind, sampled) if self.arrays is None else self.arrays(sampled),
                kind=self.kind,
                attributes=self.attributes,
                pictures=None if images is None else (lambda folder: self.draw(sampled, folder, images, report)),
                text=lambda content: markdown_sections(content, outcome.sections, self.cost(self.read(content))),
                page=None if page is None else lambda folder, warnings: page(with_warnings(warnings), folder),
                report=report,
                parts=self.write_parts(sampled),
            )
        return with_warnings(warnings)
