"""The result of a study: rows, a table, files; of tanks per metre of width and of those in three dimensions."""

from __future__ import annotations

import html
import io
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mpi4py import MPI

from hydroelastic.fem.progress import Report
from hydroelastic.output.plots import DEFAULT_PICTURES, PictureOptions
from hydroelastic.scenes.models.level_tank import LevelTankScene
from hydroelastic.scenes.models.scene_model import plain
from hydroelastic.scenes.progress import progress
from hydroelastic.scenes.read import Scene, closed_tank, read_scene, title_of_scene
from hydroelastic.scenes.study.plan import Family, StudyPlan


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Study:
    """The errors and costs of a scene in many solutions. ``print`` shows the tables of the command line.

    Attributes:
        measured: all that was found: ``rows`` with family or model, degree, errors, estimate, seconds and
            memory; per metre of width ``rates`` and ``gain``, the fitted orders beside those of theory.
        text: the tables.
        csv: the rows, at full precision.
    """

    measured: Any
    text: str
    csv: str
    _write: Callable[..., None]

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        title = title_of_scene(self.measured.scene)
        return f"<Study of {title!r}, {len(self.measured.rows)} solutions: {self.status}>"

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self.text)}</pre>"

    @property
    def status(self) -> str:
        """ "ok", or "unconverged" where a tolerance that was asked was not kept."""
        return "unconverged" if self.measured.reasons else "ok"

    @property
    def table(self) -> Any:
        """The content of ``study.csv`` as a data frame of pandas, one row for each solution."""
        # It comes with xarray, and takes a while to import.
        import pandas

        return pandas.read_csv(io.StringIO(self.csv), float_precision="round_trip")

    def save(
        self, folder: str | Path, *, images: PictureOptions = DEFAULT_PICTURES, scene_file: Path | None = None
    ) -> None:
        """Write the result folder of the command study, whole or not at all, on the first process.

        Args:
            folder: the folder; files of an earlier result are replaced, all else is kept.
            images: how the figures are drawn.
            scene_file: where the scene was read; ``None`` if it was made in Python.

        Raises:
            SceneError: if the folder cannot be written.
        """
        if MPI.COMM_WORLD.rank == 0:
            self._write(self.measured, Path(folder), images, scene_file=scene_file)


def study(
    scene: Scene | str | Path,
    *,
    families: Sequence[Family] | None = None,
    degrees: Sequence[int] | None = None,
    geometric_degrees: Sequence[int] | None = None,
    tolerances: Sequence[float] | None = None,
    halvings: int | None = None,
    most_unknowns: int | None = None,
    report: bool = False,
) -> Study:
    """Solve a scene on many meshes, at many degrees and to many tolerances, and measure error and cost of each
    (collective); writes nothing.

    Args:
        scene: a closed tank, or the name or file of one; its own tolerance plays no part.
        families: of "uniform", "algebraic", "geometric" and "tolerance", all by default; in three
            dimensions each model that takes the scene is asked for the tolerances.
        degrees: of ψ on uniform and algebraic meshes; 1 to 4 by default.
        geometric_degrees: of ψ on geometric rings; 2 to 10 by default.
        tolerances: relative errors that are asked; 1e-3 to 1e-10 by default.
        halvings: how often elements are halved, at most; 4 by default.
        most_unknowns: a series of meshes ends before a mesh with more; 250 000 by default.
        report: whether the current step is shown, on a terminal or below the cell of a notebook.

    Raises:
        SceneError: if the scene is not that of a closed tank, brings a mesh of its own, or a number cannot be used.
        UnsolvedError: if the eigen-solver fails.
    """
    asked: dict[str, Any] = {
        "families": families,
        "degrees": degrees,
        "geometric_degrees": geometric_degrees,
        "tolerances": tolerances,
        "halvings": halvings,
        "most_unknowns": most_unknowns,
    }
    plan = StudyPlan(**{name: plain(value) for name, value in asked.items() if value is not None})
    given = read_scene(scene)
    with progress(title_of_scene(given), shown=report and MPI.COMM_WORLD.rank == 0) as told:
        return measured_study(given, plan, told)


def measured_study(scene: Scene, plan: StudyPlan, report: Report) -> Study:
    """Return the study of a plan (collective), with the errors of `study`; `report` is called with each step."""
    if isinstance(scene, LevelTankScene):
        from hydroelastic.scenes.study import level_tank

        level = level_tank.study_level_tank(scene, plan, report=report)
        return Study(
            measured=level,
            text=level_tank.level_study_table(level),
            csv=level_tank.level_study_csv(level),
            _write=level_tank.write_level_study,
        )
    tank = closed_tank(scene, "a study measures the errors of frequencies of closed tanks")
    from hydroelastic.scenes.study.report import study_csv, study_table, write_study
    from hydroelastic.scenes.study.run import study_scene

    found = study_scene(tank, plan, report=report)
    return Study(measured=found, text=study_table(found), csv=study_csv(found), _write=write_study)
