"""What a study leaves: a table, a CSV file, and a log-log figure of error against seconds and against unknowns."""

from __future__ import annotations

import csv
import io
import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from rich import box
from rich.console import Console
from rich.table import Table

from hydroelastic.scenes.output import SUMMARY, result_folder
from hydroelastic.scenes.study import Study, StudyRow

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COLUMNS = (
    "family",
    "degree",
    "size",
    "tolerance",
    "dofs",
    "error",
    "lowest_error",
    "estimate",
    "seconds",
    "mesh_seconds",
    "assemble_seconds",
    "solve_seconds",
    "memory",
)

# Okabe and Ito's colours, which colour-blind readers tell apart, and a marker each.
_STYLES = {
    "uniform, degree 1": ("#999999", "v"),
    "uniform, degree 2": ("#E69F00", "s"),
    "uniform, degree 3": ("#CC79A7", "D"),
    "graded, degree 2 to 10": ("#0072B2", "o"),
    "tolerance asked": ("#009E73", "*"),
}


def study_table(study: Study) -> str:
    """Table of all rows, and the observed rates, as text."""
    console = Console(file=io.StringIO(), width=120, color_system=None, highlight=False)
    console.print(f"{study.scene.title}: error against cost", markup=False)
    console.print(f"Errors against: {study.reference}", markup=False)
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for heading in ("series", "degree", "element", "asked", "unknowns", "error", "estimate", "seconds"):
        table.add_column(heading, justify="left" if heading == "series" else "right", no_wrap=True)
    for row in study.rows:
        table.add_row(
            row.family,
            str(row.degree),
            "" if row.size is None else f"{row.size:.4g}",
            "" if row.tolerance is None else f"{row.tolerance:.0e}",
            str(row.dofs),
            f"{row.error:.1e}",
            "" if row.estimate is None else f"{row.estimate:.1e}",
            f"{row.total_seconds:.3f}",
        )
    console.print(table)
    for rate in study.rates:
        console.print(
            f"Uniform meshes, degree {rate.degree}: the lowest frequency converges with order {rate.observed:.2f} "
            f"({rate.points} meshes); theory: {rate.expected:g}.",
            markup=False,
        )
    text: str = console.file.getvalue()  # type: ignore[attr-defined]
    return text.rstrip()


def study_csv(study: Study) -> str:
    """All rows at full precision."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    for row in study.rows:
        stages = (row.seconds.get(stage, 0.0) for stage in ("mesh", "assemble", "solve"))
        writer.writerow(
            [
                row.family,
                row.degree,
                row.size,
                row.tolerance,
                row.dofs,
                row.error,
                row.lowest_error,
                row.estimate,
                row.total_seconds,
                *stages,
                row.memory,
            ]
        )
    return text.getvalue()


def draw_study(study: Study, path: Path) -> None:
    """Write the figure: error against seconds, and error against unknowns."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11.0, 5.0), layout="constrained")
    FigureCanvasAgg(figure)
    left, right = figure.subplots(1, 2, sharey=True)
    for label, rows in _series(study).items():
        colour, marker = _STYLES[label]
        for axes, costs in (
            (left, [row.total_seconds for row in rows]),
            (right, [float(row.dofs) for row in rows]),
        ):
            axes.loglog(costs, [row.error for row in rows], color=colour, marker=marker, label=label, markersize=5)
    _label(left, "seconds (tolerance asked: with estimate, count and tones)")
    _label(right, "unknowns")
    left.set_ylabel(f"largest relative error of {study.scene.accuracy.modes} frequencies")
    right.legend(frameon=False)
    figure.suptitle(study.scene.title)
    figure.savefig(path, dpi=150)


def write_study(study: Study, folder: Path) -> None:
    """Write table, rows, figure and summary into a result folder, whole or not at all.

    Raises:
        SceneError: if the folder cannot be written.
    """
    with result_folder(folder) as inside:
        (inside / "study.csv").write_text(study_csv(study), encoding="utf-8")
        (inside / "study.txt").write_text(study_table(study) + "\n", encoding="utf-8")
        draw_study(study, inside / "study.png")
        summary = {
            "scene": study.scene.model_dump(mode="json"),
            "status": "ok",
            "reference": study.reference,
            "rates": [asdict(rate) for rate in study.rates],
            "rows": [asdict(row) for row in study.rows],
        }
        (inside / SUMMARY).write_text(json.dumps(summary, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def _series(study: Study) -> dict[str, list[StudyRow]]:
    series: dict[str, list[StudyRow]] = {}
    for row in study.rows:
        label = {"graded": "graded, degree 2 to 10", "tolerance": "tolerance asked"}.get(
            row.family, f"uniform, degree {row.degree}"
        )
        series.setdefault(label, []).append(row)
    return series


def _label(axes: Axes, cost: str) -> None:
    axes.set_xlabel(cost)
    axes.grid(which="major", color="#dddddd", linewidth=0.6)
