"""Quantities of the motion of a flexible thread in time."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.thread.motion_in_space import MotionInSpace
from hydroelastic.output.quantities import Group, Quantity, array


def _largest_at(motion: MotionInSpace) -> list[float]:
    high = int(motion.extremes.highest.argmax())
    return [float(motion.step_ends[high]), float(motion.extremes.highest_at[high])]


def _smallest_at(motion: MotionInSpace) -> list[float]:
    low = int(motion.extremes.lowest.argmin())
    return [float(motion.step_ends[low]), float(motion.extremes.lowest_at[low])]


def _energy(motion: MotionInSpace) -> NDArray[np.float64]:
    return np.asarray(motion.energies.sum(axis=1))


MOTION = Group(
    "motion",
    "motion in time, by analysis; extremes are those over all steps, between the times asked too",
    (
        Quantity("until", "last time", "s", value=lambda motion: motion.times[-1]),
        Quantity("steps", "number of steps", "1"),
        Quantity("nodes", "number of nodes", "1", value=lambda motion: len(motion.nodes)),
        Quantity(
            "largest_tension",
            "largest tension over all steps",
            "N",
            value=lambda motion: motion.extremes.highest.max(),
            error="extreme_tension_error",
        ),
        Quantity(
            "largest_tension_at",
            "time, s, and place along the thread, m, of the largest tension",
            "s and m",
            value=_largest_at,
            dimensions=("time_and_s",),
        ),
        Quantity(
            "smallest_tension",
            "smallest tension over all steps",
            "N",
            value=lambda motion: motion.extremes.lowest.min(),
            error="extreme_tension_error",
        ),
        Quantity(
            "smallest_tension_at",
            "time, s, and place along the thread, m, of the smallest tension",
            "s and m",
            value=_smallest_at,
            dimensions=("time_and_s",),
        ),
        Quantity(
            "end_tensions_range",
            "smallest and largest tension at A and B",
            "N",
            value=lambda motion: [
                [float(tensions.min()), float(tensions.max())] for tensions in motion.extremes.end_tensions.T
            ],
            dimensions=("end", "extreme"),
            error="extreme_tension_error",
        ),
        Quantity(
            "extreme_tension_error",
            "estimated error of the extremes of tension",
            "N",
            value=lambda motion: motion.extremes.error,
            shown=".2g",
        ),
        Quantity(
            "energy_at_start",
            "energy at the start",
            "J",
            value=lambda motion: _energy(motion)[0],
            note="kinetic, of weight and dead forces, of stretch, of bending",
        ),
        Quantity("energy_at_end", "energy at the end", "J", value=lambda motion: _energy(motion)[-1]),
        Quantity("work_of_drag", "work of drag", "J", value=lambda motion: motion.drag_work[-1]),
        Group(
            "slack",
            "times at which a part would be in compression",
            (
                Quantity("from", "beginning", "s", value=lambda slack: slack.start),
                Quantity("to", "end", "s", value=lambda slack: slack.end),
                Quantity("at", "place along the thread", "m", value=lambda slack: slack.where),
                Quantity("tension", "lowest tension", "N"),
            ),
            dimension="slack",
            prefix="slack",
        ),
        Quantity("distance_to_rest", "last distance from the equilibrium", "m", shown=".3g"),
        Quantity("step_error", "estimated error of positions by the steps", "m", shown=".1e"),
        Quantity("mesh_error", "estimated error of positions by the mesh", "m", shown=".1e"),
        Quantity("position_error", "estimated error of positions", "m", shown=".1e"),
        Quantity("tension_error", "estimated error of tensions at the times asked", "N", shown=".2g"),
        array("time", "time", "s", "time", lambda motion: motion.times),
        array("node", "distance from end A along the thread", "m", "node", lambda motion: motion.nodes),
        array("step_end", "end of a step in time", "s", "step_end", lambda motion: motion.step_ends),
        array(
            "motion_position",
            "position in motion",
            "m",
            "time node axis",
            lambda motion: motion.positions,
            error="position_error",
        ),
        array(
            "motion_tension",
            "tension in motion",
            "N",
            "time node",
            lambda motion: motion.tensions,
            error="tension_error",
        ),
        array(
            "end_tension",
            "tension at A and B at the ends of steps",
            "N",
            "step_end end",
            lambda motion: motion.extremes.end_tensions,
            error="extreme_tension_error",
        ),
        array(
            "tension_range",
            "lowest and highest tension along the thread at the ends of steps",
            "N",
            "step_end extreme",
            lambda motion: np.column_stack([motion.extremes.lowest, motion.extremes.highest]),
            error="extreme_tension_error",
        ),
        array("energy", "energy at the ends of steps", "J", "step_end energy_kind", lambda motion: motion.energies),
        array(
            "work_so_far",
            "work of the drag so far",
            "J",
            "step_end",
            lambda motion: motion.drag_work,
            variable="work_of_drag",
        ),
    ),
    record=lambda solution: solution.motions,
    dimension="motion_analysis",
)
