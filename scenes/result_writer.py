"""Write what was solved: on the first process, whole or not at all."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from mpi4py import MPI

from hydroelastic.scenes.output import raise_on_all, result_folder, write_summary
from hydroelastic.scenes.provenance import Summary
from hydroelastic.scenes.stopwatch import Report, Stopwatch


def write_results(
    out: Path,
    summary: Summary,
    *,
    tables: Callable[[Path], None],
    pictures: Callable[[Path], None] | None,
    text: Callable[[Summary], str],
    report: Report,
) -> None:
    """Write a result folder on rank 0 (collective).

    Args:
        out: the folder, made whole or not at all.
        summary: content of ``summary.json``; the seconds that writing takes are added.
        tables: writes files of numbers into a folder.
        pictures: draws into a folder; ``None`` draws nothing.
        text: gives the content of ``summary.md``.
        report: told what is being done.

    Raises:
        SceneError: if the folder cannot be written.
    """
    comm, watch = MPI.COMM_WORLD, Stopwatch()
    problem: BaseException | None = None
    if comm.rank == 0:
        try:
            with result_folder(out) as folder:
                with watch.stage("write"):
                    report("tables")
                    tables(folder)
                if pictures is not None:
                    with watch.stage("draw"):
                        report("images")
                        (folder / "images").mkdir()
                        pictures(folder / "images")
                summary["timing"].update(watch.seconds)
                (folder / "summary.md").write_text(text(summary), encoding="utf-8")
                write_summary(summary, folder)
        except BaseException as error:
            # Whatever it is, the other processes wait to hear of it.
            problem = error
    raise_on_all(problem, comm)
