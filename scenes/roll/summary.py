"""The answer to the scene of a rolling ship as one JSON-ready value."""

from __future__ import annotations

from dataclasses import asdict
from math import degrees, exp, pi
from typing import TYPE_CHECKING, Any

from hydroelastic.modal.roll.motion import Roll
from hydroelastic.scenes.output.provenance import Summary, framed_summary
from hydroelastic.scenes.roll.solve import RollSolution

if TYPE_CHECKING:
    from mpi4py import MPI

LINEAR_UP_TO = 0.5
"""Angle, rad, up to which restoring is taken to be linear. A righting arm like sin φ is 4 % below φ there."""


def summarize_roll(solution: RollSolution, comm: MPI.Comm, *, import_seconds: float) -> Summary:
    """Build the summary of a solved scene (collective: peak memory is summed over processes).

    Args:
        solution: the motion.
        comm: the processes.
        import_seconds: time spent importing libraries.

    Returns:
        The content of ``summary.json``.
    """
    statistics, levels = solution.statistics, solution.scene.output.levels
    largest = abs(statistics.largest_angle)
    content = {
        "ship": _ship(solution),
        "free_decay": free_decay(solution.roll),
        "section": asdict(solution.section) if solution.section is not None else None,
        "response": {
            "waves": len(solution.train.periods),
            "end_of_waves": float(solution.train.starts[-1]),
            "until": float(solution.motion.times[-1]),
            "largest_angle": statistics.largest_angle,
            "largest_angle_degrees": degrees(statistics.largest_angle),
            "restoring_is_linear": largest <= LINEAR_UP_TO,
            "time_of_largest_angle": statistics.largest_time,
            "absolute_error": solution.angle_error,
            "relative_error": solution.angle_error / largest if largest else 0.0,
            "root_mean_square": statistics.root_mean_square,
            "swings": len(statistics.swing_angles),
            "significant_angle": statistics.significant_angle,
            "exceedances": [{"level": level, "swings": statistics.swings_above(level)} for level in levels],
        },
    }
    return framed_summary(
        solution,
        content,
        {"times": len(solution.motion.times), "waves": len(solution.train.periods)},
        comm,
        import_seconds,
    )


def _ship(solution: RollSolution) -> dict[str, Any]:
    roll = solution.roll
    ratio = roll.damping / roll.natural_frequency
    return {
        "natural_frequency": roll.natural_frequency,
        "natural_period": 2.0 * pi / roll.natural_frequency,
        "damping": roll.damping,
        "damping_ratio": ratio,
        "quadratic_damping": solution.scene.roll.quadratic_damping,
        "regime": regime(roll),
    }


def regime(roll: Roll) -> str:
    """Return the name of the regime of linear damping."""
    k, n = roll.natural_frequency, roll.damping
    if n == 0.0:
        return "undamped"
    return "underdamped" if n < k else "critically damped" if n == k else "overdamped"


def free_decay(roll: Roll) -> dict[str, float] | None:
    """Return what linear damping makes of free motion; ``None`` where it does not oscillate.

    The exact decrement is δ = 2πn/√(k² − n²), the logarithm of the ratio of two largest angles a period apart.
    """
    if not roll.damped_frequency:
        return None
    decrement = 2.0 * pi * roll.damping / roll.damped_frequency
    return {
        "period": 2.0 * pi / roll.damped_frequency,
        "logarithmic_decrement": decrement,
        "ratio_of_swings": exp(-0.5 * decrement),
    }
