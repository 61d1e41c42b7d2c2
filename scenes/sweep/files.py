"""The result folder of a sweep: dataset, table, summary, picture."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mpi4py import MPI

from hydroelastic.output.csv_files import write_csv
from hydroelastic.output.dataset import DATASET, write_dataset
from hydroelastic.output.folder import raise_on_all, result_folder, write_summary
from hydroelastic.output.markdown import markdown_table, markdown_text
from hydroelastic.output.plots import PictureOptions
from hydroelastic.output.provenance import versions
from hydroelastic.output.writer import TABLES
from hydroelastic.scenes.errors import folder_errors
from hydroelastic.scenes.sweep.axes import shown_number
from hydroelastic.scenes.sweep.branches import branch_rows, encounter_rows
from hydroelastic.scenes.sweep.contents import SweepContents
from hydroelastic.scenes.sweep.dataset import sweep_attributes
from hydroelastic.scenes.sweep.figure import draw_sweep
from hydroelastic.scenes.sweep.quantities import shown_columns
from hydroelastic.scenes.sweep.run import SolvedSweep

TABLE = "sweep.csv"
BRANCHES = "branches.csv"
ENCOUNTERS = "encounters.csv"


def write_sweep(sweep: SweepContents, folder: Path, show: tuple[str, ...], images: PictureOptions | None) -> None:
    """Write the result folder of a sweep on the first process (collective)."""
    problem: BaseException | None = None
    if MPI.COMM_WORLD.rank == 0:
        try:
            with folder_errors(), result_folder(folder, scene_file=sweep.solved.file) as inside:
                write_dataset(inside / DATASET, sweep.variables, sweep_attributes(sweep.solved))
                write_csv(inside / TABLE, sweep.columns)
                _write_rows(inside / BRANCHES, branch_rows(sweep.solved))
                _write_rows(inside / ENCOUNTERS, encounter_rows(sweep.solved))
                write_summary(sweep_summary(sweep), inside)
                (inside / TABLES).write_text(sweep_text(sweep, show), encoding="utf-8")
                if images is not None:
                    draw_sweep(sweep, inside, images, show)
        except BaseException as error:
            # Any exception must reach the other processes, which wait for it.
            problem = error
    with folder_errors():
        raise_on_all(problem, MPI.COMM_WORLD)


def _write_rows(file: Path, rows: list[dict[str, Any]]) -> None:
    if rows:
        write_csv(file, {name: [row[name] for row in rows] for name in rows[0]})


def sweep_summary(sweep: SweepContents) -> dict[str, Any]:
    """Return the content of ``summary.json``."""
    solved = sweep.solved
    found, followed = [point.status for point in solved.points], followed_modes(solved)
    return {
        "scene": solved.scene.model_dump(mode="json"),
        "status": solved.status,
        "reasons": solved.reasons,
        "vary": {axis.key: axis.values for axis in solved.grid.axes},
        "points": {status: found.count(status) for status in ("ok", "unconverged", "failed")},
        "followed": None if followed is None else vars(followed),
        "versions": versions(),
    }


@dataclass(frozen=True, kw_only=True)
class FollowedModes:
    """How the modes were followed: numbers of points added and of encounters by kind, whether more points are needed,
    and the least part of a first elastic tone that the modes hold, ``None`` without beams."""

    added_points: int
    more_needed: bool
    crossings: int
    veerings: int
    unresolved: int
    least_participation_sum: float | None


def followed_modes(solved: SolvedSweep) -> FollowedModes | None:
    """Return how the modes were followed; ``None`` where they were not."""
    if not solved.lines:
        return None
    kinds = [one.kind for line in solved.lines for one in line.encounters]
    sums = [one.participation.sum(axis=1) for line in solved.lines for one in line.followed.modes]
    return FollowedModes(
        added_points=sum(int(line.followed.refined.sum()) for line in solved.lines),
        more_needed=any(line.followed.exhausted for line in solved.lines),
        crossings=kinds.count("crossing"),
        veerings=kinds.count("veering"),
        unresolved=kinds.count("unresolved"),
        least_participation_sum=min((float(one) for some in sums for one in some), default=None),
    )


def followed_lines_of_text(solved: SolvedSweep) -> list[str]:
    """Return what is said of the followed modes."""
    found = followed_modes(solved)
    if found is None:
        return []
    lines = [
        f"Modes followed along {solved.grid.axes[0].key}: {found.crossings} crossings, {found.veerings} "
        f"veerings; {found.added_points} points were added for that."
    ]
    if found.least_participation_sum is not None:
        lines.append(f"The modes hold {found.least_participation_sum:.4f} or more of each first elastic tone.")
    if found.unresolved or found.more_needed:
        lines.append(
            f"NOT RESOLVED: {found.unresolved} encounters of modes, see encounters.csv. Take more values, or allow "
            f"more refinements."
        )
    return lines


def sweep_rows(sweep: SweepContents, show: tuple[str, ...]) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Return headings and rows of the main quantities of all points, or of those to show."""
    table, keys = sweep.columns, [axis.key for axis in sweep.solved.grid.axes]
    headings = (*keys, "status", *shown_columns(table, show))
    return headings, [tuple(map(_cell, row)) for row in zip(*(table[name] for name in headings), strict=True)]


def _cell(value: Any) -> str:
    return shown_number(float(value)) if isinstance(value, float) else str(value)


def sweep_text(sweep: SweepContents, show: tuple[str, ...]) -> str:
    """Return the content of ``summary.md``."""
    solved = sweep.solved
    headings, rows = sweep_rows(sweep, show)
    escaped = tuple(map(markdown_text, headings)), [tuple(map(markdown_text, row)) for row in rows]
    complaints = [f"- {markdown_text(line)}" for line in solved.complaints]
    title = markdown_text(
        f"{solved.scene.title or 'Untitled scene'}: sweep over {', '.join(headings[: len(solved.grid.axes)])}"
    )
    said = [f"{markdown_text(line)}\n" for line in followed_lines_of_text(solved)]
    return "\n".join([f"# {title}", "", markdown_table(*escaped), "", *said, *complaints]).rstrip() + "\n"
