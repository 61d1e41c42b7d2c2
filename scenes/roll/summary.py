"""The answer to the scene of a rolling ship as one JSON-ready value."""

from __future__ import annotations

from dataclasses import asdict
from math import degrees, exp, pi
from typing import TYPE_CHECKING, Any

from hydroelastic.output.provenance import Summary, complete_summary
from hydroelastic.physics.ship import Ship
from hydroelastic.scenes.roll.results import RollResult

if TYPE_CHECKING:
    from mpi4py import MPI

LINEAR_UP_TO = 0.5
"""Angle, rad, up to which restoring is taken to be linear. A righting arm like sin φ is 4 % below φ there."""


def summarize_roll(result: RollResult, comm: MPI.Comm, *, import_seconds: float) -> Summary:
    """Build the summary of a solved scene (collective: peak memory is summed over processes).

    Args:
        result: the solved scene.
        comm: the processes.
        import_seconds: time spent importing libraries.

    Returns:
        The content of ``summary.json``.
    """
    solution, levels = result.solution, result.scene.output.levels
    statistics = solution.statistics
    content = {
        "ship": _ship(solution.ship),
        "free_decay": free_decay(solution.ship),
        "section": asdict(result.section) if result.section is not None else None,
        "response": {
            "waves": len(solution.train.periods),
            "end_of_waves": float(solution.train.starts[-1]),
            "until": float(solution.motion.times[-1]),
            "largest_angle": statistics.largest_angle,
            "largest_angle_degrees": degrees(statistics.largest_angle),
            "restoring_is_linear": abs(statistics.largest_angle) <= LINEAR_UP_TO,
            "time_of_largest_angle": statistics.largest_time,
            "absolute_error": solution.angle_error + solution.ship_error,
            "relative_error": solution.relative_error,
            "root_mean_square": statistics.root_mean_square,
            "swings": len(statistics.swing_angles),
            "significant_angle": statistics.significant_angle,
            "exceedances": [{"level": level, "swings": statistics.swings_above(level)} for level in levels],
        },
    }
    return complete_summary(
        result,
        content,
        {"times": len(solution.motion.times), "waves": len(solution.train.periods)},
        comm,
        import_seconds,
    )


def _ship(ship: Ship) -> dict[str, Any]:
    return {
        "natural_frequency": ship.natural_frequency,
        "natural_period": 2.0 * pi / ship.natural_frequency,
        "damping": ship.damping,
        "damping_ratio": ship.damping / ship.natural_frequency,
        "quadratic_damping": ship.quadratic_damping,
        "regime": regime(ship),
    }


def regime(ship: Ship) -> str:
    """Return the name of the regime of linear damping."""
    k, n = ship.natural_frequency, ship.damping
    if n == 0.0:
        return "undamped"
    return "underdamped" if n < k else "critically damped" if n == k else "overdamped"


def free_decay(ship: Ship) -> dict[str, float] | None:
    """Return the decay of free oscillations by linear damping; ``None`` where they do not oscillate.

    The exact decrement is δ = 2πn/√(k² − n²), the logarithm of the ratio of two largest angles a period apart.
    """
    if not ship.damped_frequency:
        return None
    decrement = 2.0 * pi * ship.damping / ship.damped_frequency
    return {
        "period": 2.0 * pi / ship.damped_frequency,
        "logarithmic_decrement": decrement,
        "ratio_of_swings": exp(-0.5 * decrement),
    }
