"""The summary of the scene of a thread as one JSON-ready value."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from hydroelastic.fem.thread.modes import Roots, ThreadModes
from hydroelastic.fem.thread.motion_in_space import MotionInSpace
from hydroelastic.fem.thread.stability import Stability
from hydroelastic.output.provenance import Summary, complete_summary
from hydroelastic.scenes.thread.results import ThreadSolutionOfScene

if TYPE_CHECKING:
    from mpi4py import MPI


def summarize_thread(solution: ThreadSolutionOfScene, comm: MPI.Comm, *, import_seconds: float) -> Summary:
    """Build the summary of a solved scene (collective: peak memory is summed over processes).

    Args:
        solution: the thread.
        comm: the processes.
        import_seconds: time spent importing libraries.

    Returns:
        The content of ``summary.json``.
    """
    scene = solution.scene
    content = {
        "thread": {
            "weight": scene.weight,
            "normal_drag": scene.normal_drag,
            "tangential_drag": scene.tangential_drag,
            "added_mass": scene.added_mass,
            "dimension": solution.frame.dimension,
        },
        "equilibrium": _equilibrium(solution),
        "modes": [_modes(modes) for modes in solution.modes],
        "stability": [_stability(sweep) for sweep in solution.stability],
        "motion": [_motion(motion) for motion in solution.motions],
    }
    return complete_summary(solution, content, solution.size, comm, import_seconds)


def _equilibrium(solution: ThreadSolutionOfScene) -> dict[str, Any]:
    rest = solution.rest
    return {
        "end_positions": rest.end_positions.tolist(),
        "end_tensions": rest.end_tensions.tolist(),
        "reactions": rest.reactions.tolist(),
        "end_moments": rest.end_moments.tolist(),
        "largest_tension": rest.largest_tension,
        "smallest_tension": rest.smallest_tension,
        "smallest_tension_at": rest.smallest_at,
        "largest_curvature": float(np.max(rest.curvatures)),
        "lowest_point": float(np.min(rest.positions[:, 2])),
        "highest_point": float(np.max(rest.positions[:, 2])),
        "position_error": rest.position_error,
        "tension_error": rest.tension_error,
        "reaction_error": rest.reaction_error,
        "moment_error": rest.moment_error,
        "relative_error": rest.relative_error,
        "start": rest.start,
        "newton_steps": list(rest.newton_steps),
        "failed_starts": list(rest.failed_starts),
    }


def _modes(modes: ThreadModes) -> dict[str, Any]:
    """Oscillating motions, and aperiodic ones up to the magnitude of the last of them."""
    return {
        "oscillating": [_root(modes.oscillating, place) for place in range(len(modes.oscillating.values))],
        "aperiodic": [_root(modes.aperiodic, place) for place in range(len(modes.aperiodic.values))],
        "stable": modes.is_stable,
    }


def _root(roots: Roots, place: int) -> dict[str, Any]:
    root, out = complex(roots.values[place]), float(roots.out_of_plane[place])
    return {
        "omega": abs(root),
        "damped_omega": root.imag,
        "frequency_hz": root.imag / (2.0 * pi),
        # No negative zero.
        "decay": 0.0 - root.real,
        "damping_ratio": float(roots.damping_ratios[place]) + 0.0,
        "out_of_plane": None if np.isnan(out) else out,
        "relative_error": float(roots.relative_errors[place]),
    }


def _stability(sweep: Stability) -> dict[str, Any]:
    return {
        "factors": sweep.values.tolist(),
        "growing": sweep.growing.tolist(),
        "thresholds": [
            {
                "factor": threshold.value,
                "kind": threshold.kind,
                "omega": threshold.frequency,
                "growing_below": threshold.growing[0],
                "growing_above": threshold.growing[1],
                "relative_error": threshold.error / threshold.value,
            }
            for threshold in sweep.thresholds
        ],
        "ill_posed_from": None if sweep.ill_posed is None else sweep.ill_posed[0],
        "ill_posed_reason": None if sweep.ill_posed is None else sweep.ill_posed[1],
    }


def _motion(motion: MotionInSpace) -> dict[str, Any]:
    extremes = motion.extremes
    high, low = int(extremes.highest.argmax()), int(extremes.lowest.argmin())
    energy = motion.energies.sum(axis=1)
    return {
        "until": float(motion.times[-1]),
        "steps": motion.steps,
        "nodes": len(motion.nodes),
        "largest_tension": float(extremes.highest[high]),
        "largest_tension_at": [float(motion.step_ends[high]), float(extremes.highest_at[high])],
        "smallest_tension": float(extremes.lowest[low]),
        "smallest_tension_at": [float(motion.step_ends[low]), float(extremes.lowest_at[low])],
        "end_tensions_range": [[float(tensions.min()), float(tensions.max())] for tensions in extremes.end_tensions.T],
        "extreme_tension_error": extremes.error,
        "energy_at_start": float(energy[0]),
        "energy_at_end": float(energy[-1]),
        "work_of_drag": float(motion.drag_work[-1]),
        "slack": [
            {"from": slack.start, "to": slack.end, "at": slack.where, "tension": slack.tension}
            for slack in motion.slack
        ],
        "distance_to_rest": motion.distance_to_rest,
        "step_error": motion.step_error,
        "mesh_error": motion.mesh_error,
        "position_error": motion.position_error,
        "tension_error": motion.tension_error,
    }
