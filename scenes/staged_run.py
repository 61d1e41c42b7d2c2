"""The run of a scene in stages that each kind has its own of: solve, summarize, write, draw."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, Protocol, TypeVar

from mpi4py import MPI

from hydroelastic.scenes.outcome import Outcome
from hydroelastic.scenes.provenance import Summary
from hydroelastic.scenes.result_writer import write_results
from hydroelastic.scenes.stopwatch import Report

_Scene = TypeVar("_Scene", contravariant=True)
_Solution = TypeVar("_Solution", contravariant=True)


class _Summarize(Protocol[_Solution]):
    def __call__(self, solution: _Solution, comm: MPI.Comm, /, *, import_seconds: float) -> Summary: ...


@dataclass(frozen=True, kw_only=True)
class StagedRun(Generic[_Scene, _Solution]):
    """What runs scenes of one kind.

    Attributes:
        solve: gives the solution of a scene (collective).
        summarize: gives the content of ``summary.json`` (collective).
        write: writes files of numbers into a folder.
        draw: draws into a folder.
        markdown: gives the content of ``summary.md``.
        printed: gives the tables for a terminal.
    """

    solve: Callable[[_Scene, MPI.Comm, Report], _Solution]
    summarize: _Summarize[_Solution]
    write: Callable[[_Solution, Path], None]
    draw: Callable[[_Solution, Path], None]
    markdown: Callable[[Summary], str]
    printed: Callable[[Summary], str]

    def __call__(
        self,
        scene: _Scene,
        *,
        out: Path | None = None,
        images: bool = True,
        import_seconds: float = 0.0,
        report: Report = lambda _message: None,
    ) -> Outcome:
        """Solve a scene and write its result folder (collective).

        Args:
            scene: the scene.
            out: result folder, made whole or not at all; ``None`` writes nothing.
            images: whether to draw.
            import_seconds: time that importing libraries took, for the record.
            report: told what is being done.

        Raises:
            SceneError: if a file that the scene names cannot be used, or the folder cannot be written.
            UnsolvedError: if the scene cannot be solved.
        """
        comm = MPI.COMM_WORLD
        solution = self.solve(scene, comm, report)
        summary = self.summarize(solution, comm, import_seconds=import_seconds)
        if out is not None:
            write_results(
                out,
                summary,
                tables=lambda folder: self.write(solution, folder),
                pictures=(lambda folder: self.draw(solution, folder)) if images else None,
                text=self.markdown,
                report=report,
            )
        return Outcome(summary=summary, tables=self.printed(summary), folder=out)
