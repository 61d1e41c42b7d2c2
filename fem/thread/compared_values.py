"""Values of the field solution of a thread that estimates are compared with."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, assert_never

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.thread.analyses import ThreadAnalyses
from hydroelastic.modal.thread.critical import critical_direction
from hydroelastic.modal.thread.estimate import ValueEstimate
from hydroelastic.modal.thread.layer_estimates import NEAR_CRITICAL
from hydroelastic.physics.arrays import FloatArray

# Angles to the critical line below this multiple of their error are left out: their logarithm has no digits.
_CERTAIN = 100.0
# Values of an estimate beyond the largest one of the field solution are compared up to this factor.
_BEYOND = 1.02


@dataclass(frozen=True)
class ComparedValues:
    """Values of the field solution.

    Attributes:
        values: NaN where there is none, shape (values,).
        errors: estimates of their absolute errors, shape (values,).
    """

    values: NDArray[Any]
    errors: FloatArray


def compared_values(solution: ThreadAnalyses, estimate: ValueEstimate) -> ComparedValues:
    """Return the values of the field solution that an estimate is of, in its order.

    Args:
        solution: the field solution.
        estimate: of the same thread.
    """
    rest, analysis = solution.rest, estimate.analysis
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
        case "moment at A" | "moment at B":
            place = 0 if estimate.quantity == "moment at A" else 1
            return ComparedValues(rest.end_moments[[place]], np.array([rest.moment_error]))
        case "exponent of the approach":
            return _approach(solution)
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


def _approach(solution: ThreadAnalyses) -> ComparedValues:
    """Slope of the logarithms of angle and tension at the two places nearest to the critical line that have digits."""
    rest = solution.rest
    direction, _ = critical_direction(solution.thread.distributed_load, np.zeros(3))
    tangents = rest.forces / np.linalg.norm(rest.forces, axis=1, keepdims=True)
    angles = np.arcsin(np.minimum(np.linalg.norm(np.cross(tangents, direction), axis=1), 1.0))
    error = rest.tension_error / rest.tensions
    certain = np.flatnonzero((angles > _CERTAIN * error) & (angles < NEAR_CRITICAL))
    if len(certain) < 2:
        return ComparedValues(np.array([np.nan]), np.array([np.nan]))
    first, second = certain[:2]
    stretch = float(np.log(rest.tensions[first] / rest.tensions[second]))
    slope = float(np.log(angles[first] / angles[second])) / stretch
    wrong = (error[first] / angles[first] + error[second] / angles[second]) / abs(stretch)
    return ComparedValues(np.array([slope]), np.array([wrong]))
