"""Labelled arrays of a thread: its equilibrium and the results of all analyses."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from hydroelastic.fem.thread.motion_in_space import MotionInSpace
from hydroelastic.output.dataset import Labelled, labelled
from hydroelastic.output.summary_variables import SummaryNames
from hydroelastic.scenes.thread.files import numbered
from hydroelastic.scenes.thread.results import ThreadSolutionOfScene

if TYPE_CHECKING:
    import xarray

    from hydroelastic.fem.thread.modes import ThreadModes
    from hydroelastic.fem.thread.stability import Stability

THREAD_NAMES = SummaryNames(
    by_place={
        "equilibrium.end_positions": ("end", "axis"),
        "equilibrium.end_tensions": ("end",),
        "equilibrium.newton_steps": ("newton_mesh",),
        "equilibrium.failed_starts": ("failed_start",),
        "modes": ("modes_analysis",),
        "modes.oscillating": ("oscillating_mode",),
        "modes.aperiodic": ("aperiodic_mode",),
        "stability": ("stability_analysis",),
        "stability.thresholds": ("threshold",),
        "motion": ("motion_analysis",),
        "motion.end_tensions_range": ("end", "extreme"),
        "motion.largest_tension_at": ("time_and_s",),
        "motion.smallest_tension_at": ("time_and_s",),
        "motion.slack": ("slack",),
    },
    prefixes={
        "modes.oscillating": "oscillating",
        "modes.aperiodic": "aperiodic",
        "stability.thresholds": "threshold",
        "motion.slack": "slack",
    },
    reported_by_arrays=frozenset(
        {"equilibrium.reactions", "equilibrium.end_moments", "stability.factors", "stability.growing"}
    ),
)


def thread_dataset(solution: ThreadSolutionOfScene) -> xarray.Dataset:
    """Return the equilibrium, and modes, stability and motion by analysis, SI units.

    Names of a second analysis of a kind end in its number, as do those of files.
    """
    # xarray takes a while to import.
    import xarray

    parts = [
        _rest_variables(solution),
        *(_mode_variables(solution, number, modes) for number, modes in enumerate(solution.modes)),
        *(_stability_variables(number, sweep) for number, sweep in enumerate(solution.stability)),
        *(_motion_variables(number, motion) for number, motion in enumerate(solution.motions)),
    ]
    return xarray.merge(parts, join="exact", compat="no_conflicts")


def _rest_variables(solution: ThreadSolutionOfScene) -> xarray.Dataset:
    rest, along = solution.rest, ("s", "axis")
    return labelled(
        {
            "position": (along, rest.positions, "m", "position at rest, z upwards", rest.position_error),
            "tension": ("s", rest.tensions, "N", "tension at rest", rest.tension_error),
            "contact_force": (along, rest.forces, "N", "force of the part beyond on the part before"),
            "curvature": ("s", rest.curvatures, "1/m", "curvature at rest"),
            "reaction": (
                ("end", "axis"),
                *(rest.reactions, "N", "support force on the thread", rest.reaction_error),
            ),
            "end_moment": ("end", rest.end_moments, "N m", "bending moment", rest.moment_error),
        },
        {"s": ("s", solution.s, "m", "distance from end A along the thread")},
        {"axis": ("x", "y", "z"), "end": ("A", "B")},
    )


def _mode_variables(solution: ThreadSolutionOfScene, number: int, modes: ThreadModes) -> xarray.Dataset:
    mode, node = numbered("mode", number), numbered("mode_s", number)
    roots, errors, shapes = (
        np.concatenate([getattr(modes.oscillating, name), getattr(modes.aperiodic, name)])
        for name in ("values", "errors", "shapes")
    )
    moved = "displacement in a free motion, at a generalized mass of that of the thread"
    return labelled(
        {
            numbered("root", number): (mode, roots, "1/s", "root λ of a free motion exp(λt)"),
            numbered("root_error", number): (mode, errors, "1/s", "estimated error of the root"),
            numbered("mode_shape", number): ((mode, node, "axis"), solution.frame.to_space(shapes), "1", moved),
        },
        {
            mode: (mode, np.arange(1, len(roots) + 1, dtype=np.int32), None, "number of the mode"),
            node: (node, modes.nodes, "m", "distance from end A along the thread"),
        },
    )


def _stability_variables(number: int, sweep: Stability) -> xarray.Dataset:
    factor, branch = numbered("factor", number), numbered("branch", number)
    growing = sweep.growing.astype(np.int32)
    followed = ((factor, branch), sweep.roots, "1/s", "root followed through the factors")
    return labelled(
        {
            numbered("followed_root", number): followed,
            numbered("growing", number): (factor, growing, "1", "number of motions that grow"),
        },
        {factor: (factor, sweep.values, "1", "factor of the stream")},
    )


def _motion_variables(number: int, motion: MotionInSpace) -> xarray.Dataset:
    time, node, end = numbered("time", number), numbered("node", number), numbered("step_end", number)
    extremes, ends = motion.extremes, "at the ends of steps"
    tensions = np.column_stack([extremes.lowest, extremes.highest])
    arrays: dict[str, Labelled] = {
        "motion_position": (
            (time, node, "axis"),
            *(motion.positions, "m", "position in motion", motion.position_error),
        ),
        "motion_tension": ((time, node), motion.tensions, "N", "tension in motion", motion.tension_error),
        "end_tension": ((end, "end"), extremes.end_tensions, "N", f"tension at A and B {ends}", extremes.error),
        "tension_range": (
            (end, "extreme"),
            *(tensions, "N", f"lowest and highest tension along the thread {ends}", extremes.error),
        ),
        "energy": ((end, "energy_kind"), motion.energies, "J", f"energy {ends}"),
        "work_of_drag": (end, motion.drag_work, "J", "work of the drag so far"),
    }
    return labelled(
        {numbered(name, number): array for name, array in arrays.items()},
        {
            time: (time, motion.times, "s", "time"),
            node: (node, motion.nodes, "m", "distance from end A along the thread"),
            end: (end, motion.step_ends, "s", "end of a step in time"),
        },
        {"extreme": ("lowest", "highest"), "energy_kind": ("kinetic", "potential", "stretch", "bending")},
    )
