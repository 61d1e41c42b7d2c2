"""Differences of the field solution of a thread from estimates, beside the errors of both."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite
from typing import Any

import numpy as np

from hydroelastic.fem.thread.compared_values import compared_values
from hydroelastic.modal.thread.estimate import (
    Found,
    Inapplicable,
    ShapeEstimate,
    ThreadEstimate,
    ValueEstimate,
)
from hydroelastic.output.provenance import Summary
from hydroelastic.scenes.thread.estimates import compared_places
from hydroelastic.scenes.thread.results import ThreadSolutionOfScene

# Factor of truncation errors, which are estimated by the leading term that is left out, or by the last one kept.
_LEFT_OUT = 2.0
# Rounding of the estimates, of the length, of the largest tension and of values.
_ROUNDING = 1e-12


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
