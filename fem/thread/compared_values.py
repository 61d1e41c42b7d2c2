"""Values of the field solution of a thread that estimates are compared with."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, assert_never

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.thread.analyses import ThreadAnalyses
from hydroelastic.modal.thread.estimate import ValueEstimate
from hydroelastic.physics.arrays import FloatArray

# Values of an estimate beyond the largest one of the field solution are compared up to this factor.
_BEYOND = 1.02


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
