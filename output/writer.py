"""Write the results on the first process, all or nothing."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterable, Mapping
from contextlib import ExitStack, suppress
from pathlib import Path
from time import perf_counter

from mpi4py import MPI

from hydroelastic.fem.progress import Report
from hydroelastic.output.dataset import DATASET, complete_variables, global_attributes, write_dataset
from hydroelastic.output.folder import raise_on_all, result_folder, write_summary
from hydroelastic.output.pictures.rendering import NoRendererError
from hydroelastic.output.provenance import SECONDS, Summary
from hydroelastic.output.quantities import Group
from hydroelastic.output.variables import Variable

TABLES = "summary.md"


def write_results(
    out: Path,
    summary: Summary,
    *,
    scene_file: Path | None,
    tables: Callable[[Path], None],
    arrays: Callable[[], Iterable[Variable]],
    kind: Group,
    attributes: Mapping[str, str],
    pictures: Callable[[Path], None] | None,
    text: Callable[[Summary], str],
    page: Callable[[Path, tuple[str, ...]], None] | None,
    report: Report,
    parts: Callable[[Path], None] | None = None,
) -> tuple[str, ...]:
    """Write a result folder on rank 0 (collective)."""
    comm, start = MPI.COMM_WORLD, perf_counter()
    problem: BaseException | None = None
    warnings: list[str] = []
    # Others than rank 0 wait for the folder until it is there, or will not be.
    wait = parts is not None
    if comm.rank and parts is not None:
        shared = comm.bcast(None)
        # An error is that of rank 0 too.
        with suppress(OSError):
            if shared is not None:
                parts(shared)
    elif comm.rank == 0:
        try:
            with result_folder(out, scene_file=scene_file) as folder, ExitStack() as drawing:
                report("tables")
                tables(folder)
                labelled = arrays()
                if parts is not None:
                    comm.bcast(folder)
                    wait = False
                    parts(folder)
                if pictures is not None:
                    report("pictures")
                    (folder / "images").mkdir()
                    from hydroelastic.output.pictures.page import saving  # needs matplotlib

                    drawing.enter_context(saving())
                    try:
                        pictures(folder / "images")
                    except NoRendererError as error:
                        drawing.close()
                        shutil.rmtree(folder / "images")
                        warnings.append(f"no images: {error}")
                summary[SECONDS.key] += perf_counter() - start
                (folder / TABLES).write_text(text(summary), encoding="utf-8")
                write_summary(summary, folder)
                # The dataset contains the summary, which by now has the seconds of all but this.
                variables = complete_variables(labelled, summary, kind)
                write_dataset(folder / DATASET, variables, {**global_attributes(summary), **attributes})
                # The last page is written beside the dataset.
                drawing.close()
                if page is not None:
                    report("page")
                    page(folder, tuple(warnings))
        except BaseException as error:
            # Any exception must reach the other processes, which wait for it.
            problem = error
            if wait:
                comm.bcast(None)
    raise_on_all(problem, comm)
    return tuple(warnings)
