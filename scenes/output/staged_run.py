"""The run of a scene in stages that each kind has its own of: solve, summarize, tabulate, write, draw."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Generic, Protocol, TypeVar

from mpi4py import MPI

from hydroelastic.fem.stopwatch import Report, Stopwatch
from hydroelastic.output.pictures.options import DEFAULT_PICTURES, PictureOption, PictureOptions
from hydroelastic.scenes.output.dataset import LabelledResults
from hydroelastic.scenes.output.manifest import read_manifest
from hydroelastic.scenes.output.outcome import Outcome
from hydroelastic.scenes.output.provenance import Summary
from hydroelastic.scenes.output.sections import Section, markdown_sections
from hydroelastic.scenes.output.writer import write_results

_Scene = TypeVar("_Scene", contravariant=True)
_Solution = TypeVar("_Solution", contravariant=True)


class _Summarize(Protocol[_Solution]):
    def __call__(self, solution: _Solution, comm: MPI.Comm, /, *, import_seconds: float) -> Summary: ...


def _as_solved(solution: Any, _summary: Summary) -> Any:
    return solution


def _nothing(_solution: Any) -> tuple[str, ...]:
    return ()


@dataclass(frozen=True, kw_only=True)
class StagedRun(Generic[_Scene, _Solution]):
    """What runs scenes of one kind.

    Attributes:
        solve: gives the solution of a scene (collective).
        summarize: gives the content of ``summary.json`` (collective).
        sections: gives the tables that a person reads.
        cost: gives a line that says what the result took.
        write: writes files of numbers into a folder, on rank 0.
        dataset: what `dataset.nc` is made of.
        draw: draws into a folder, on rank 0, and tells what is being drawn.
        heeds: the options that the pictures heed; of others a run says that they have no effect.
        lacking: says what an animation of the solution lacks, and which key gives it; nothing by default.
        sample: makes what is written and drawn of the solution and its summary (collective); the solution by default.
        unsampled: says what could not be sampled, and why; nothing by default.
    """

    solve: Callable[[_Scene, MPI.Comm, Report], _Solution]
    summarize: _Summarize[_Solution]
    sections: Callable[[_Solution, Summary], Iterable[Section]]
    cost: Callable[[Summary], str]
    write: Callable[[Any, Path], None]
    dataset: LabelledResults
    draw: Callable[[Any, Path, PictureOptions, Report], None]
    heeds: frozenset[PictureOption]
    lacking: Callable[[_Solution], tuple[str, ...]] = _nothing
    sample: Callable[[_Solution, Summary], Any] = _as_solved
    unsampled: Callable[[Any], tuple[str, ...]] = _nothing

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
        """Solve a scene and write its result folder (collective).

        Args:
            scene: the scene.
            out: result folder, made whole or not at all; ``None`` writes nothing.
            scene_file: where the scene was read; ``None`` if it was made in Python.
            images: how to draw; ``None`` draws nothing.
            page: writes a page about the outcome into the folder, on rank 0 and last; ``None`` writes none.
            import_seconds: time that importing libraries took, for the record.
            report: told what is being done.

        Raises:
            SceneError: if a file that the scene names cannot be used, or the folder cannot be written.
            UnsolvedError: if the scene cannot be solved.
        """
        comm = MPI.COMM_WORLD
        solution = self.solve(scene, comm, report)
        summary = self.summarize(solution, comm, import_seconds=import_seconds)
        sections = tuple(self.sections(solution, summary))
        outcome = Outcome(solution=solution, summary=summary, sections=sections, cost=self.cost(summary), folder=out)
        if out is not None:
            # Asked before anything is written there.
            replaces = read_manifest(out) is not None
            watch = Stopwatch()
            report("fields")
            with watch.stage("sample"):
                sampled = self.sample(solution, summary)
            summary["timing"].update(watch.seconds)
            missing = self.unsampled(sampled)
            if images is not None:
                missing += images.without_effect(self.heeds)
                missing += self.lacking(solution) if images.animate else ()

            def told(warnings: tuple[str, ...]) -> Outcome:
                # Writing has added its seconds to the summary.
                return replace(outcome, cost=self.cost(summary), warnings=(*warnings, *missing), replaces=replaces)

            warnings = write_results(
                out,
                summary,
                scene_file=scene_file,
                tables=lambda folder: self.write(sampled, folder),
                arrays=lambda: self.dataset.arrays(sampled),
                names=self.dataset.names,
                pictures=None if images is None else (lambda folder: self.draw(sampled, folder, images, report)),
                text=lambda content: markdown_sections(content, sections, self.cost(content)),
                page=None if page is None else lambda folder, warnings: page(told(warnings), folder),
                report=report,
            )
            return told(warnings)
        return outcome
