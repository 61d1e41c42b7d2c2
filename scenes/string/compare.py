"""The field solution of a hanging string beside its series."""

from __future__ import annotations

from typing import Any

import numpy as np
from mpi4py import MPI
from pydantic import ValidationError

from hydroelastic.fem.stopwatch import Report
from hydroelastic.modal.string.solution import StringSolution
from hydroelastic.output.outcome import Outcome
from hydroelastic.output.provenance import Summary
from hydroelastic.output.sections import Section
from hydroelastic.scenes.errors import Problem, SceneError, scene_error
from hydroelastic.scenes.models.string import StringScene
from hydroelastic.scenes.string.results import StringResult
from hydroelastic.scenes.string.run import run_string
from hydroelastic.scenes.string.solve import solve_series, solve_string_field


def compare_string(scene: StringScene, *, report: Report = lambda _message: None) -> Outcome:
    """Solve a scene by series and by a field solution, and compare; writes nothing (collective).

    Args:
        scene: with a uniform resistance and nothing on the free end.
        report: called with a word on what is being done.

    Raises:
        SceneError: if there is no series, or the motion is too fast or too long for a field solution.
        UnsolvedError: if the eigen-solver of the field solution fails.
    """
    if not scene.string.physical.has_closed_form:
        raise SceneError(
            Problem(
                key="[string]",
                wrong="with a tip mass or a resistance that varies there is no series to compare with",
                allowed="tip_mass = 0 and one resistance",
                remedy="The command run solves for the field",
            )
        )
    comm = MPI.COMM_WORLD
    as_field = _as_field(scene)
    field = StringResult(scene=as_field, solution=solve_string_field(as_field, comm, report))
    report("series")
    series = solve_series(scene)
    summary = run_string.summarized(as_field, field)
    summary["comparison"] = compared(field.solution, series)
    sections = (comparison_section(summary["comparison"]),)
    return Outcome(solution=field, summary=summary, sections=sections, cost=run_string.cost(summary))


def _as_field(scene: StringScene) -> StringScene:
    """The scene for the field solution, which is limited to slower and shorter motions than the series."""
    given = scene.model_dump(mode="json")
    given["accuracy"]["method"] = "field"
    try:
        return StringScene.model_validate(given, context={"folder": scene.folder})
    except ValidationError as error:
        raise scene_error(error, StringScene) from error


def compared(field: StringSolution, series: StringSolution) -> Summary:
    """Return the differences of two solutions of one scene, and the time of each.

    Args:
        field: the field solution.
        series: the series, whose errors are far smaller.
    """
    scale = series.largest or 1.0
    difference = np.abs(field.displacement - series.displacement) / scale
    away = ~field.beside_fronts
    count = min(len(field.free_motions.roots), len(series.free_motions.roots))
    roots = np.abs(field.free_motions.roots[:count] - series.free_motions.roots[:count]) / np.abs(
        series.free_motions.roots[:count]
    )
    found: dict[str, Any] = {
        "displacement": float(difference[away].max(initial=0.0)),
        "displacement_estimate": field.relative_error,
        "displacement_root_mean_square": float(np.sqrt(np.mean(difference**2))),
        "modes": float(roots.max(initial=0.0)),
        "modes_estimate": field.frequency_error,
        "field_seconds": sum(field.seconds.values()),
        "series_seconds": sum(series.seconds.values()),
    }
    return found


def comparison_section(comparison: Summary) -> Section:
    """Return the table of differences; `comparison` is that of `compared`."""
    rows = [
        (
            "displacement away from fronts, of the largest",
            f"{comparison['displacement']:.1e}",
            f"{comparison['displacement_estimate']:.1e}",
        ),
        ("displacement everywhere, root mean square", f"{comparison['displacement_root_mean_square']:.1e}", ""),
        ("frequencies of free motions", f"{comparison['modes']:.1e}", f"{comparison['modes_estimate']:.1e}"),
    ]
    return Section(
        title="The field solution beside the series",
        headings=("quantity", "difference", "estimated error of the field solution"),
        rows=rows,
        lines=(f"Seconds: {comparison['field_seconds']:.2f} (field), {comparison['series_seconds']:.2f} (series).",),
    )
