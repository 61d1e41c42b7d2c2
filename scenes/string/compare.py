"""The field solution of a hanging string beside its series."""

from __future__ import annotations

from dataclasses import replace
from time import perf_counter

import numpy as np
from pydantic import ValidationError

from hydroelastic.fem.progress import Report
from hydroelastic.modal.string.solution import StringSolution
from hydroelastic.output.outcome import Outcome
from hydroelastic.output.provenance import SECONDS, Summary
from hydroelastic.output.quantities import Group, Quantity
from hydroelastic.output.reading import Reading
from hydroelastic.output.sections import Section
from hydroelastic.scenes.errors import Problem, SceneError
from hydroelastic.scenes.models.string import StringScene
from hydroelastic.scenes.string.run import run_string
from hydroelastic.scenes.string.solve import solve_series
from hydroelastic.scenes.validation_errors import scene_error

# fmt: off
# A table: as many arguments on a line as fit.
COMPARISON = Group("comparison", "the field solution beside the series, relative to the series", (
    DISPLACEMENT := Quantity("displacement", "displacement away from fronts, of the largest", "1", shown=".1e"),
    DISPLACEMENT_ESTIMATE := Quantity("displacement_estimate", "its error by the field solution", "1", shown=".1e",
        contract=False),
    ROOT_MEAN_SQUARE := Quantity("displacement_root_mean_square", "displacement everywhere, root mean square", "1",
        shown=".1e"),
    MODES := Quantity("modes", "frequencies of free motions", "1", shown=".1e"),
    MODES_ESTIMATE := Quantity("modes_estimate", "their error by the field solution", "1", shown=".1e", contract=False),
    FIELD_SECONDS := Quantity("field_seconds", "time of the field solution", "s", shown=".2f", contract=False),
    SERIES_SECONDS := Quantity("series_seconds", "time of the series", "s", shown=".2f", contract=False),
))
# fmt: on


def compare_string(scene: StringScene, *, report: Report = lambda _message: None) -> Outcome:
    """Solve a scene by series and by a field solution, and compare; writes nothing (collective)."""
    if not scene.string.physical.has_closed_form:
        raise SceneError(
            Problem(
                key="[string]",
                wrong="with a tip mass or a resistance that varies there is no series to compare with",
                allowed="tip_mass = 0 and one resistance",
                remedy="The command run solves for the field",
            )
        )
    as_field = _as_field(scene)
    field = run_string.solved(as_field, report=report)
    report("series")
    start = perf_counter()
    series = solve_series(scene)
    seconds = {FIELD_SECONDS.key: field.summary[SECONDS.key], SERIES_SECONDS.key: perf_counter() - start}
    differences = compared(field.solution.solution, series) | seconds
    summary = field.summary | {COMPARISON.key: differences}
    return replace(field, summary=summary, sections=(comparison_section(differences),))


def _as_field(scene: StringScene) -> StringScene:
    """The scene for the field solution, which is limited to slower and shorter motions than the series."""
    given = scene.model_dump(mode="json")
    given["accuracy"]["method"] = "field"
    try:
        return StringScene.model_validate(given, context={"folder": scene.folder})
    except ValidationError as error:
        raise scene_error(error, StringScene) from error


def compared(field: StringSolution, series: StringSolution) -> Summary:
    """Return the differences of two solutions of one scene."""
    scale = series.largest or 1.0
    difference = np.abs(field.displacement - series.displacement) / scale
    away = ~field.beside_fronts
    count = min(len(field.free_motions.roots), len(series.free_motions.roots))
    roots = np.abs(field.free_motions.roots[:count] - series.free_motions.roots[:count]) / np.abs(
        series.free_motions.roots[:count]
    )
    return {
        DISPLACEMENT.key: float(difference[away].max(initial=0.0)),
        DISPLACEMENT_ESTIMATE.key: field.relative_error,
        ROOT_MEAN_SQUARE.key: float(np.sqrt(np.mean(difference**2))),
        MODES.key: float(roots.max(initial=0.0)),
        MODES_ESTIMATE.key: field.frequency_error,
    }


def comparison_section(comparison: Summary) -> Section:
    """Return the table of differences; `comparison` is that of `compared`."""
    told = Reading(COMPARISON, comparison)
    return Section(
        title="The field solution beside the series",
        headings=("quantity", "difference", "estimated error of the field solution"),
        rows=[
            (DISPLACEMENT.meaning, told.cell(DISPLACEMENT), told.cell(DISPLACEMENT_ESTIMATE)),
            (ROOT_MEAN_SQUARE.meaning, told.cell(ROOT_MEAN_SQUARE), ""),
            (MODES.meaning, told.cell(MODES), told.cell(MODES_ESTIMATE)),
        ],
        lines=(f"Seconds: {told.cell(FIELD_SECONDS)} (field), {told.cell(SERIES_SECONDS)} (series).",)
        if FIELD_SECONDS.key in comparison
        else (),
    )
