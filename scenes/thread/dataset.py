"""Labelled arrays of a thread: its equilibrium and the results of all analyses."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from hydroelastic.scenes.output.summary_variables import SummaryNames
from hydroelastic.scenes.thread.files import numbered
from hydroelastic.scenes.thread.results import MotionInSpace, ThreadSolutionOfScene

if TYPE_CHECKING:
    import xarray

    from hydroelastic.fem.thread.modes import ThreadModes
    from hydroelastic.fem.thread.stability import Stability

THREAD_NAMES = SummaryNames(
    dimensions={
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
    import xarray

    rest = solution.rest
    return xarray.Dataset(
        {
            "position": (
                ("s", "axis"),
                rest.positions,
                _said("position at rest, z upwards", "m", rest.position_error),
            ),
            "tension": ("s", rest.tensions, _said("tension at rest", "N", rest.tension_error)),
            "contact_force": (
                ("s", "axis"),
                rest.forces,
                _said("force of the part beyond on the part before", "N"),
            ),
            "curvature": ("s", rest.curvatures, _said("curvature at rest", "1/m")),
            "reaction": (
                ("end", "axis"),
                rest.reactions,
                _said("force on the thread by what holds it", "N", rest.reaction_error),
            ),
            "end_moment": ("end", rest.end_moments, _said("bending moment", "N m", rest.moment_error)),
        },
        {
            "s": ("s", solution.s, _said("distance from end A along the thread", "m")),
            "axis": ["x", "y", "z"],
            "end": ["A", "B"],
        },
    )


def _said(long_name: str, units: str, absolute_error: float | None = None) -> dict[str, str | float]:
    """Attributes of a variable."""
    said: dict[str, str | float] = {"units": units, "long_name": long_name}
    return said if absolute_error is None else said | {"absolute_error": absolute_error}


def _mode_variables(solution: ThreadSolutionOfScene, number: int, modes: ThreadModes) -> xarray.Dataset:
    import xarray

    mode, node = numbered("mode", number), numbered("mode_s", number)
    roots = np.concatenate([modes.oscillating.values, modes.aperiodic.values])
    errors = np.concatenate([modes.oscillating.errors, modes.aperiodic.errors])
    shapes = solution.frame.to_space(np.concatenate([modes.oscillating.shapes, modes.aperiodic.shapes]))
    return xarray.Dataset(
        {
            numbered("root", number): (mode, roots, _said("root λ of a free motion exp(λt)", "1/s")),
            numbered("root_error", number): (mode, errors, _said("estimated error of the root", "1/s")),
            numbered("mode_shape", number): (
                (mode, node, "axis"),
                shapes,
                _said("displacement in a free motion, at a generalized mass of that of the thread", "1"),
            ),
        },
        {
            mode: (mode, np.arange(1, len(roots) + 1, dtype=np.int32), {"long_name": "number of the mode"}),
            node: (node, modes.nodes, _said("distance from end A along the thread", "m")),
        },
    )


def _stability_variables(number: int, sweep: Stability) -> xarray.Dataset:
    import xarray

    factor, branch = numbered("factor", number), numbered("branch", number)
    return xarray.Dataset(
        {
            numbered("followed_root", number): (
                (factor, branch),
                sweep.roots,
                _said("root followed through the factors", "1/s"),
            ),
            numbered("growing", number): (
                factor,
                sweep.growing.astype(np.int32),
                _said("number of motions that grow", "1"),
            ),
        },
        {factor: (factor, sweep.values, _said("factor of the stream", "1"))},
    )


def _motion_variables(number: int, motion: MotionInSpace) -> xarray.Dataset:
    import xarray

    time, node, end = numbered("time", number), numbered("node", number), numbered("step_end", number)
    return xarray.Dataset(
        {
            numbered("motion_position", number): (
                (time, node, "axis"),
                motion.positions,
                _said("position in motion", "m", motion.position_error),
            ),
            numbered("motion_tension", number): (
                (time, node),
                motion.tensions,
                _said("tension in motion", "N", motion.tension_error),
            ),
            numbered("end_tension", number): (
                (end, "end"),
                motion.extremes.end_tensions,
                _said("tension at A and B at the ends of steps", "N", motion.extremes.error),
            ),
            numbered("tension_range", number): (
                (end, "extreme"),
                np.column_stack([motion.extremes.lowest, motion.extremes.highest]),
                _said("lowest and highest tension along the thread at the ends of steps", "N", motion.extremes.error),
            ),
            numbered("energy", number): (
                (end, "energy_kind"),
                motion.energies,
                _said("energy at the ends of steps", "J"),
            ),
            numbered("work_of_drag", number): (end, motion.drag_work, _said("work of the drag so far", "J")),
        },
        {
            time: (time, motion.times, _said("time", "s")),
            node: (node, motion.nodes, _said("distance from end A along the thread", "m")),
            end: (end, motion.step_ends, _said("end of a step in time", "s")),
            "extreme": ["lowest", "highest"],
            "energy_kind": ["kinetic", "potential", "stretch", "bending"],
        },
    )
