"""The study of a tank in three dimensions: error against seconds of each model that takes it."""

from __future__ import annotations

import csv
import io
import json
from dataclasses import asdict, dataclass
from itertools import groupby
from pathlib import Path

from rich import box
from rich.table import Table

from hydroelastic.fem.level_bed.choice import MODEL_WORDS
from hydroelastic.fem.progress import Report
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.study.level_tank import LevelReference, LevelRow, level_reference, level_rows
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.output.folder import SUMMARY, result_folder
from hydroelastic.output.plots import BLUE, DEFAULT_PICTURES, GREEN, VERMILLION, PictureOptions, Sheets
from hydroelastic.output.sections import text_console, text_of
from hydroelastic.physics.volume_tank import VolumeTank
from hydroelastic.scenes.errors import Problem, SceneError, UnsolvedError, cannot_be_meshed, folder_errors
from hydroelastic.scenes.level_tank.solve import require_treated
from hydroelastic.scenes.models.level_tank import LevelTankScene
from hydroelastic.scenes.models.level_tank_physics import physical_level_tank
from hydroelastic.scenes.study.plan import StudyPlan

_WIDTH = 120
_STYLES = {"orders": (BLUE, "o"), "box": (GREEN, "s"), "plan": (VERMILLION, "^")}


@dataclass(frozen=True, kw_only=True)
class LevelStudy:
    """Results of a study.

    Attributes:
        scene: the scene.
        tolerances: that were asked.
        reference: what errors are measured against.
        rows: all solutions, model by model.
    """

    scene: LevelTankScene
    tolerances: tuple[float, ...]
    reference: LevelReference
    rows: tuple[LevelRow, ...]

    @property
    def reasons(self) -> tuple[str, ...]:
        """Tolerances that were not kept, with reasons; empty if all were."""
        return tuple(
            f"{row.model}, tolerance {row.tolerance:g}: {reason}" for row in self.rows for reason in row.reasons
        )


def study_level_tank(scene: LevelTankScene, plan: StudyPlan, *, report: Report = lambda _message: None) -> LevelStudy:
    """Solve a scene in each of its models to each tolerance (collective)."""
    require_treated(scene)
    if "tolerance" not in plan.families:
        raise SceneError(
            Problem(
                key="families",
                wrong="in three dimensions each model is asked for tolerances; meshes are of tanks per metre of width",
                allowed="tolerance",
                argument=True,
            )
        )
    tank, modes = physical_level_tank(scene), scene.accuracy.modes
    if isinstance(tank, VolumeTank):
        raise SceneError(
            Problem(
                key="[tank]",
                wrong="a study compares models of upright tanks with a level bed, and this one is solved in its volume",
                remedy="The command run solves it, with an error estimate at any accuracy.tolerance",
            )
        )
    rows = []
    try:
        report("reference solution")
        reference = level_reference(tank, modes)
        for row in level_rows(tank, reference, plan.tolerances, modes):
            report(f"{row.model}, tolerance {row.tolerance:g}: error {row.error:.1e}")
            rows.append(row)
    except EigenSolverError as error:
        raise UnsolvedError(f"the tank could not be solved: {error}") from error
    except MeshError as error:
        raise cannot_be_meshed(error, scene) from error
    return LevelStudy(scene=scene, tolerances=plan.tolerances, reference=reference, rows=tuple(rows))


def level_study_table(study: LevelStudy) -> str:
    """All rows by model, as text."""
    console = text_console(_WIDTH)
    reference = study.reference
    certain = f", estimated error {reference.uncertainty:.1e}" if reference.uncertainty else ", exact"
    for line in (
        f"{study.scene.title or 'Untitled scene'}: error against cost",
        f"Reference: {reference.name}{certain}.",
        f"error: largest relative error of {study.scene.accuracy.modes} frequencies; ratio: estimate over error.",
        "Seconds without elastic tones and compiling; MB: highest resident memory, above what was held before.",
    ):
        console.print(line, markup=False)
    headings = ("asked", "degree", "layers", "poles", "problems", "unknowns", "error", "estimate", "ratio")
    for model, group in groupby(study.rows, key=lambda row: row.model):
        rows = list(group)
        console.print(f"\n{MODEL_WORDS[model][:1].upper()}{MODEL_WORDS[model][1:]}", markup=False)
        table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1, 0, 0))
        for heading in (*headings, "seconds", "MB"):
            table.add_column(heading, justify="right", no_wrap=True)
        for row in rows:
            above = row.error > row.floor
            table.add_row(
                f"{row.tolerance:.0e}",
                *map(str, (row.degree, row.layers, row.poles, row.problems, row.unknowns)),
                f"{row.error:.1e}" if above else f"<{row.floor:.0e}",
                f"{row.estimate:.1e}",
                f"{row.estimate / row.error:.1f}" if above else "",
                f"{row.seconds:.3f}",
                "" if row.memory is None else f"{row.memory / 1e6:.3g}",
            )
        console.print(table)
    told = [row.estimate / row.error for row in study.rows if row.error > row.floor]
    between = f"estimate over error from {min(told):.1f} to {max(told):.1f}" if told else "all errors are rounding"
    kept = "not all kept: " + "; ".join(study.reasons) if study.reasons else "all kept"
    console.print(f"Tolerances: {kept}; {between}.", markup=False)
    return "\n".join(line.rstrip() for line in text_of(console).splitlines())


def write_level_study(
    study: LevelStudy, folder: Path, options: PictureOptions = DEFAULT_PICTURES, *, scene_file: Path | None = None
) -> None:
    """Write tables, rows, figure and summary into a result folder, whole or not at all."""
    with folder_errors(), result_folder(folder, scene_file=scene_file) as inside:
        (inside / "study.txt").write_text(level_study_table(study) + "\n", encoding="utf-8")
        (inside / "study.csv").write_text(level_study_csv(study), encoding="utf-8")
        _draw(study, Sheets(folder=inside, title=study.scene.title, options=options))
        summary = {
            "scene": study.scene.model_dump(mode="json"),
            "status": "unconverged" if study.reasons else "ok",
            "reasons": study.reasons,
            "plan": {"tolerances": study.tolerances},
            "reference": {
                "name": study.reference.name,
                "omega": study.reference.omega.tolist(),
                "relative_error": study.reference.uncertainty,
            },
            "rows": [asdict(row) for row in study.rows],
        }
        (inside / SUMMARY).write_text(json.dumps(summary, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def level_study_csv(study: LevelStudy) -> str:
    """All rows at full precision."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    keys = ("model", "tolerance", "degree", "layers", "poles", "problems", "unknowns", "error", "floor")
    writer.writerow([*keys, "estimate", "seconds", "memory"])
    for row in study.rows:
        writer.writerow([*(getattr(row, key) for key in keys), row.estimate, row.seconds, row.memory])
    return text.getvalue()


def _draw(study: LevelStudy, sheets: Sheets) -> None:
    with sheets.sheet("study", "error against cost", width=13.0, height=6.0) as figure:
        left, right = figure.subplots(1, 2, sharey=True)
        for model, group in groupby(study.rows, key=lambda row: row.model):
            rows = list(group)
            colour, marker = _STYLES[model]
            for axes, values in (left, [row.seconds for row in rows]), (right, [row.unknowns for row in rows]):
                axes.loglog(values, [row.error for row in rows], color=colour, marker=marker, label=model)
                axes.loglog(values, [row.estimate for row in rows], color=colour, linestyle=":", linewidth=1.0)
        left.set_xlabel("time, s")
        right.set_xlabel("number of unknowns")
        left.set_ylabel(f"largest relative error of {study.scene.accuracy.modes} frequencies (dotted: estimated)")
        figure.legend(*right.get_legend_handles_labels(), loc="outside right center", handlelength=3.5)
