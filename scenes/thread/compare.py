"""Differences of the field solution of a thread from estimates, beside the errors of both."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import isfinite
from typing import Any, assert_never

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.progress import Report
from hydroelastic.fem.thread.analyses import ThreadAnalyses
from hydroelastic.modal.thread.estimate import (
    Found,
    Inapplicable,
    ShapeEstimate,
    ThreadEstimate,
    ValueEstimate,
)
from hydroelastic.output.outcome import Outcome
from hydroelastic.output.provenance import SECONDS, Summary
from hydroelastic.output.thread.comparison import COMPARISON
from hydroelastic.output.thread.comparison_tables import comparison_sections
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.thread.estimates import compared_places, thread_estimates
from hydroelastic.scenes.thread.results import ThreadSolutionOfScene
from hydroelastic.scenes.thread.run import run_thread

# Factor of truncation errors, which are estimated by the leading term that is left out, or by the last one kept.
_LEFT_OUT = 2.0
# Rounding of the estimates, of the length, of the largest tension and of values.
_ROUNDING = 1e-12

# Values of an estimate beyond the largest one of the field solution are compared up to this factor.
_BEYOND = 1.02


def thread_differences(solution: ThreadSolutionOfScene, estimates: Sequence[Found], seconds: float) -> Summary:
    """Return the difference of each estimate from the field solution, JSON-ready.

    A difference is explained if it is not larger than the estimated error of the field solution and twice the estimate
    of what the theory leaves out, together.
    """
    rest = solution.rest
    return {
        "field": {
            "position_error": rest.position_error,
            "tension_error": rest.tension_error,
            "seconds": seconds,
        },
        "shapes": [_shape(solution, found) for found in estimates if isinstance(found, ShapeEstimate)],
        "values": [_values(solution, found) for found in estimates if isinstance(found, ValueEstimate)],
        "inapplicable": [
            {"name": found.name, "reason": found.reason} for found in estimates if isinstance(found, Inapplicable)
        ],
    }


def _head(found: ThreadEstimate) -> dict[str, Any]:
    return {
        "name": found.name,
        "order": found.order,
        "parameter": found.parameter,
        "small": found.small,
        "seconds": found.seconds,
    }


def _beside(difference: float, error: float, left_out: float, size: float) -> dict[str, Any]:
    explained = difference <= error + _LEFT_OUT * left_out + _ROUNDING * size
    return {"difference": difference, "field_error": error, "left_out": left_out, "explained": bool(explained)}


def _shape(solution: ThreadSolutionOfScene, found: ShapeEstimate) -> dict[str, Any]:
    rest, shape = solution.rest, found.shape
    chosen = slice(None) if len(shape.s) == len(compared_places(solution.scene)) else [0, -1]
    positions = np.vstack([rest.end_positions[:1], rest.positions, rest.end_positions[1:]])[chosen]
    tensions = np.concatenate([rest.end_tensions[:1], rest.tensions, rest.end_tensions[1:]])[chosen]
    apart = float(np.linalg.norm(shape.positions - positions, axis=1).max())
    pulled = float(np.abs(shape.tensions - tensions).max())
    ends = [0, -1]
    return {
        **_head(found),
        "end_positions": shape.positions[ends].tolist(),
        "end_tensions": shape.tensions[ends].tolist(),
        "smallest_tension": float(shape.tensions.min()),
        "position": _beside(apart, rest.position_error, found.position_truncation, solution.scene.thread.length),
        "tension": _beside(pulled, rest.tension_error, found.force_truncation, float(np.max(tensions))),
    }


def _values(solution: ThreadSolutionOfScene, found: ValueEstimate) -> dict[str, Any]:
    fields = compared_values(solution, found)
    entries = [
        {
            "number": number,
            "estimate": _plain(value),
            "field": _plain(field),
            **_beside(float(abs(value - field)), float(error), float(left_out), float(abs(value))),
        }
        for number, (value, field, error, left_out) in enumerate(
            zip(found.values, fields.values, fields.errors, found.truncation, strict=True), 1
        )
        if isfinite(error)
    ]
    return {**_head(found), "quantity": found.label, "compared": entries}


def _plain(value: Any) -> Any:
    return [float(value.real), float(value.imag)] if np.iscomplexobj(value) else float(value)


@dataclass(frozen=True)
class ComparedValues:
    """Values of the field solution."""

    values: NDArray[Any]  # NaN where there is none, shape (values,)
    errors: FloatArray  # estimates of their absolute errors, shape (values,)


def compared_values(solution: ThreadAnalyses, estimate: ValueEstimate) -> ComparedValues:
    """Return the values of the field solution that an estimate is of, in its order."""
    analysis = estimate.analysis
    match estimate.quantity:
        case "frequency" | "frequency in the plane" | "frequency out of the plane":
            roots = solution.modes[analysis].oscillating
            chosen = np.ones(len(roots.values), dtype=bool)
            if estimate.quantity != "frequency":
                chosen = (roots.out_of_plane > 0.5) == (estimate.quantity == "frequency out of the plane")
            return _nearest(estimate.values, roots.values[chosen].imag, roots.errors[chosen])
        case "root":
            parts = (solution.modes[analysis].oscillating, solution.modes[analysis].aperiodic)
            values, errors = (np.concatenate([getattr(part, name) for part in parts]) for name in ("values", "errors"))
            return _nearest(estimate.values, values, errors)
        case "divergence speed" | "flutter speed":
            kind = "divergence" if estimate.quantity == "divergence speed" else "flutter"
            assert solution.thread.stream is not None
            speed = float(np.linalg.norm(solution.thread.stream.velocity_at(np.zeros((1, 3)))))
            found = [threshold for threshold in solution.stability[analysis].thresholds if threshold.kind == kind]
            speeds, errors = (speed * np.array([getattr(one, name) for one in found]) for name in ("value", "error"))
            return _nearest(estimate.values, speeds, errors)
        case _:
            assert_never(estimate.quantity)


def _nearest(values: NDArray[Any], field: NDArray[Any], errors: FloatArray) -> ComparedValues:
    """Of each value the nearest one of the field solution; none for values beyond its largest one."""
    found = np.full(len(values), np.nan, dtype=np.asarray(field).dtype)
    found_errors = np.full(len(values), np.nan)
    if len(field) == 0:
        return ComparedValues(found, found_errors)
    reached = np.flatnonzero(np.abs(values) <= _BEYOND * np.max(np.abs(field)))
    chosen = np.argmin(np.abs(values[reached, None] - field[None, :]), axis=1)
    found[reached], found_errors[reached] = field[chosen], errors[chosen]
    return ComparedValues(found, found_errors)


def compare_thread(scene: ThreadScene, *, report: Report = lambda _message: None) -> Outcome:
    """Solve a scene and compare the solution with all estimates that apply; writes nothing (collective)."""
    at_rest = scene.model_copy(update={"analysis": tuple(asked for asked in scene.analysis if asked.kind != "motion")})
    outcome = run_thread.solved(at_rest, report=report)
    report("estimates")
    estimates = tuple(thread_estimates(at_rest))
    differences = thread_differences(outcome.solution, estimates, outcome.summary[SECONDS.key])
    summary = outcome.summary | {COMPARISON.key: differences}
    return replace(outcome, summary=summary, sections=tuple(comparison_sections(differences)), notes=True)
