"""Quantities of a flexible thread in a stream: its equilibrium and the results of all analyses.

They are taken from `fem.thread.analyses.ThreadAnalyses` with, in addition, the places `s` at which the equilibrium is
reported, m, and `derived`, what follows from the scene alone, by key.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from hydroelastic.output.provenance import PROCESSES
from hydroelastic.output.quantities import Group, Quantity, array

if TYPE_CHECKING:
    from hydroelastic.fem.thread.frame import Frame
    from hydroelastic.fem.thread.modes import Roots, ThreadModes
    from hydroelastic.fem.thread.motion_in_space import MotionInSpace
    from hydroelastic.fem.thread.stability import Stability


@dataclass(frozen=True, kw_only=True)
class _ModesInSpace:
    modes: ThreadModes
    frame: Frame

    def joined(self, name: str) -> NDArray[Any]:
        return np.concatenate([getattr(self.modes.oscillating, name), getattr(self.modes.aperiodic, name)])


def _roots(roots: Roots) -> list[dict[str, Any]]:
    return [_root(roots, place) for place in range(len(roots.values))]


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
        "factors": sweep.values,
        "growing": sweep.growing,
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
        "roots": sweep.roots,
    }


def _largest_at(motion: MotionInSpace) -> list[float]:
    high = int(motion.extremes.highest.argmax())
    return [float(motion.step_ends[high]), float(motion.extremes.highest_at[high])]


def _smallest_at(motion: MotionInSpace) -> list[float]:
    low = int(motion.extremes.lowest.argmin())
    return [float(motion.step_ends[low]), float(motion.extremes.lowest_at[low])]


def _energy(motion: MotionInSpace) -> NDArray[np.float64]:
    return np.asarray(motion.energies.sum(axis=1))


# fmt: off
# A table: as many arguments on a line as fit.
_ALONG = "distance from end A along the thread"
EQUILIBRIUM = Group("equilibrium", "the equilibrium", (
    Quantity("end_positions", "positions of the ends A and B", "m", dimensions=("end", "axis"), error="position_error"),
    END_TENSIONS := Quantity("end_tensions", "tensions at the ends A and B", "N", dimensions=("end",),
        error="tension_error"),
    Quantity("reactions", "support forces on the thread at A and B", "N", dimensions=("end", "axis"), variable="",
        error="reaction_error"),
    END_MOMENTS := Quantity("end_moments", "bending moments at A and B", "N m", "|EI κ|", dimensions=("end",),
        variable="", error="moment_error"),
    Quantity("largest_tension", "largest tension of the whole thread", "N", error="tension_error", printed=False),
    Quantity("smallest_tension", "smallest tension of the whole thread", "N", error="tension_error"),
    Quantity("smallest_tension_at", "place of the smallest tension along the thread", "m",
        value=lambda rest: rest.smallest_at),
    Quantity("largest_curvature", "largest curvature at the positions asked", "1/m", "κ",
        value=lambda rest: np.max(rest.curvatures), printed=False),
    Quantity("lowest_point", "lowest z at the positions asked", "m", value=lambda rest: np.min(rest.positions[:, 2]),
        printed=False),
    Quantity("highest_point", "highest z at the positions asked", "m", value=lambda rest: np.max(rest.positions[:, 2]),
        printed=False),
    Quantity("position_error", "estimated error of positions", "m", shown=".1e", contract=False),
    Quantity("tension_error", "estimated error of tensions", "N", shown=".1e", contract=False),
    Quantity("reaction_error", "estimated error of the support forces", "N", shown=".1e", contract=False),
    MOMENT_ERROR := Quantity("moment_error", "estimated error of moments", "N m", shown=".1e", contract=False),
    Quantity("relative_error", "largest of these errors, of the length, the largest force, the largest moment", "1",
        shown=".1e", printed=False, contract=False),
    START := Quantity("start", "[start](../scenes_threads.md#how-a-start-is-chosen) of Newton's method", printed=False,
        contract=False),
    NEWTON_STEPS := Quantity("newton_steps", "steps of Newton's method on each mesh", "1", dimensions=("newton_mesh",),
        printed=False, contract=False),
    Quantity("failed_starts", "why the starts before it failed", dimensions=("failed_start",), printed=False,
        contract=False),
    array("position", "position at rest, z upwards", "m", "s axis", lambda it: it.positions, error="position_error"),
    array("tension", "tension at rest", "N", "s", lambda rest: rest.tensions, error="tension_error"),
    array("contact_force", "force of the part beyond on the part before", "N", "s axis", lambda rest: rest.forces),
    array("curvature", "curvature at rest", "1/m", "s", lambda rest: rest.curvatures),
    array("reaction", "support force on the thread", "N", "end axis", lambda rest: rest.reactions,
        error="reaction_error"),
    array("end_moment", "bending moment", "N m", "end", lambda rest: rest.end_moments, error="moment_error"),
), record=lambda solution: solution.rest)
_OF_A_ROOT = (
    ROOT_OMEGA := Quantity("omega", "magnitude of the root of a free motion", "rad/s", "|λ|", printed=False),
    DAMPED_OMEGA := Quantity("damped_omega", "angular frequency of a free motion", "rad/s", "Im λ",
        error="relative_error", digits=12),
    FREQUENCY := Quantity("frequency_hz", "frequency of a free motion", "Hz", "f", shown=".6g"),
    DECAY := Quantity("decay", "rate at which a free motion decays", "1/s", "−Re λ"),
    DAMPING_RATIO := Quantity("damping_ratio", "damping ratio of a free motion", "1", "−Re λ/|λ|",
        short="damping ratio", shown=".4g"),
    OUT_OF_PLANE := Quantity("out_of_plane", "part of the kinetic energy across the plane of the equilibrium", "1",
        short="direction", note="0 to 1, `null` where the plane is not unique"),
    ROOT_ERROR := Quantity("relative_error", "estimated relative error of the root", "1", short="relative error",
        shown=".1e", contract=False),
)
MODES = Group("modes", "free motions e^{λt} about the equilibrium, by analysis", (
    OSCILLATING := Group("oscillating", "motions that oscillate, as many as asked", _OF_A_ROOT,
        record=lambda it: _roots(it.modes.oscillating), dimension="oscillating_mode", prefix="oscillating"),
    APERIODIC := Group("aperiodic", "motions that do not oscillate, up to the magnitude of the last one that does",
        _OF_A_ROOT, record=lambda it: _roots(it.modes.aperiodic), dimension="aperiodic_mode", prefix="aperiodic"),
    STABLE := Quantity("stable", "whether no motion grows", value=lambda it: it.modes.is_stable),
    array("mode", "number of the mode", None, "mode", lambda it: np.arange(1, len(it.joined("values")) + 1)),
    array("mode_s", _ALONG, "m", "mode_s", lambda it: it.modes.nodes, contract=False),
    array("root", "root λ of a free motion e^{λt}", "1/s", "mode", lambda it: it.joined("values")),
    array("root_error", "estimated error of the root", "1/s", "mode", lambda it: it.joined("errors"), contract=False),
    array("mode_shape", "displacement in a free motion, at a generalized mass of that of the thread", "1",
        "mode mode_s axis", lambda it: it.frame.to_space(it.joined("shapes"))),
), record=lambda it: [_ModesInSpace(modes=modes, frame=it.frame) for modes in it.modes], dimension="modes_analysis")
THRESHOLDS = Group("thresholds", "thresholds of stability", (
    THRESHOLD_KIND := Quantity("kind", "kind", note='`"divergence"`, K is singular, or `"flutter"`'),
    FACTOR := Quantity("factor", "factor of the stream", "1", error="relative_error", digits=12),
    Quantity("omega", "angular frequency at the threshold", "rad/s", "ω"),
    Quantity("growing_below", "number of growing motions below", "1", short="growing below"),
    Quantity("growing_above", "number of growing motions above", "1", short="growing above"),
    Quantity("relative_error", "estimated relative error of the factor", "1", short="relative error", shown=".1e",
        contract=False),
), dimension="threshold", prefix="threshold")
STABILITY = Group("stability", "stability in the stream multiplied by factors, by analysis", (
    FACTORS := Quantity("factors", "factors of the stream", "1", dimensions=("factor",), variable=""),
    Quantity("growing", "number of growing motions at each factor", "1", dimensions=("factor",), variable=""),
    THRESHOLDS,
    ILL_POSED_FROM := Quantity("ill_posed_from", "first factor at which the problem is ill-posed", "1",
        note="or `null`"),
    ILL_POSED_REASON := Quantity("ill_posed_reason", "why it is ill-posed there", note="or `null`"),
    array("factor", "factor of the stream", "1", "factor", lambda sweep: sweep["factors"]),
    array("followed_root", "root followed through the factors", "1/s", "factor branch", lambda sweep: sweep["roots"]),
    array("growing_motions", "number of motions that grow", "1", "factor", lambda sweep: sweep["growing"],
        variable="growing"),
), record=lambda it: [_stability(sweep) for sweep in it.stability], dimension="stability_analysis")
MOTION = Group("motion",
    "motion in time, by analysis; extremes are those over all steps, between the times asked too", (
    UNTIL := Quantity("until", "last time", "s", value=lambda motion: motion.times[-1], shown=".6g", printed=False),
    MOTION_STEPS := Quantity("steps", "number of steps", "1", printed=False, contract=False),
    MOTION_NODES := Quantity("nodes", "number of nodes", "1", value=lambda motion: len(motion.nodes), printed=False,
        contract=False),
    LARGEST_TENSION := Quantity("largest_tension", "largest tension over all steps", "N",
        value=lambda motion: motion.extremes.highest.max(), error="extreme_tension_error"),
    LARGEST_TENSION_AT := Quantity("largest_tension_at", "time and place along the thread of the largest tension",
        "s and m", value=_largest_at, dimensions=("time_and_s",)),
    Quantity("smallest_tension", "smallest tension over all steps", "N",
        value=lambda motion: motion.extremes.lowest.min(), error="extreme_tension_error"),
    Quantity("smallest_tension_at", "time and place along the thread of the smallest tension", "s and m",
        value=_smallest_at, dimensions=("time_and_s",)),
    Quantity("end_tensions_range", "smallest and largest tension at A, at B over all steps", "N",
        value=lambda motion: [[tensions.min(), tensions.max()] for tensions in motion.extremes.end_tensions.T],
        dimensions=("end", "extreme"), error="extreme_tension_error"),
    Quantity("extreme_tension_error", "estimated error of the extremes of tension", "N",
        value=lambda motion: motion.extremes.error, shown=".2g", contract=False),
    Quantity("energy_at_start", "energy at the start", "J", value=lambda motion: _energy(motion)[0],
        note="kinetic, of weight and dead forces, of stretch, of bending"),
    Quantity("energy_at_end", "energy at the end", "J", value=lambda motion: _energy(motion)[-1]),
    Quantity("work_of_drag", "work of drag", "J", value=lambda motion: motion.drag_work[-1]),
    SLACK := Group("slack", "times at which a part would be in compression", (
        SLACK_FROM := Quantity("from", "beginning", "s", value=lambda slack: slack.start),
        Quantity("to", "end", "s", value=lambda slack: slack.end),
        SLACK_AT := Quantity("at", "place along the thread", "m", value=lambda slack: slack.where),
        SLACK_TENSION := Quantity("tension", "lowest tension", "N"),
    ), dimension="slack", prefix="slack"),
    Quantity("distance_to_rest", "last distance from the equilibrium", "m", shown=".3g"),
    Quantity("step_error", "estimated error of positions by the steps", "m", shown=".1e", contract=False),
    Quantity("mesh_error", "estimated error of positions by the mesh", "m", shown=".1e", contract=False),
    Quantity("position_error", "estimated error of positions", "m", shown=".1e", contract=False),
    Quantity("tension_error", "estimated error of tensions at the times asked", "N", shown=".2g", contract=False),
    array("time", "time", "s", "time", lambda motion: motion.times),
    array("node", _ALONG, "m", "node", lambda motion: motion.nodes, contract=False),
    array("step_end", "end of a step in time", "s", "step_end", lambda motion: motion.step_ends, contract=False),
    array("motion_position", "position in motion", "m", "time node axis", lambda motion: motion.positions,
        error="position_error"),
    array("motion_tension", "tension in motion", "N", "time node", lambda motion: motion.tensions,
        error="tension_error"),
    array("end_tension", "tension at A and B at the ends of steps", "N", "step_end end",
        lambda motion: motion.extremes.end_tensions, error="extreme_tension_error"),
    array("tension_range", "lowest and highest tension along the thread at the ends of steps", "N", "step_end extreme",
        lambda motion: np.column_stack([motion.extremes.lowest, motion.extremes.highest]),
        error="extreme_tension_error"),
    array("energy", "energy at the ends of steps", "J", "step_end energy_kind", lambda motion: motion.energies),
    array("work_so_far", "work of the drag so far", "J", "step_end", lambda motion: motion.drag_work,
        variable="work_of_drag"),
), record=lambda solution: solution.motions, dimension="motion_analysis")
THREAD = Group("", "a flexible thread in a stream", (
    DERIVED := Group("thread", "what follows from the scene", (
        Quantity("weight", "weight in the liquid", "N/m", "w"),
        Quantity("normal_drag", "normal drag", "N s^2/m^3", "kn"),
        Quantity("tangential_drag", "tangential drag", "N s^2/m^3", "kt"),
        Quantity("added_mass", "added mass", "kg/m", "ma"),
        DIMENSION := Quantity("dimension", "dimension in which it was solved", "1", note="2 or 3"),
    ), record=lambda solution: solution.derived),
    EQUILIBRIUM, MODES, STABILITY, MOTION,
    SIZE := Group("size", "size of the problem", (
        CELLS := Quantity("cells", "number of cells of the equilibrium", "1"),
        DEGREE := Quantity("degree", "degree of its polynomials", "1"),
        DOFS := Quantity("dofs", "number of its unknowns", "1"),
        STEPS := Quantity("steps", "number of steps of all motions", "1"),
        PROCESSES,
    ), contract=False),
    array("s", _ALONG, "m", "s"),
    array("axis", "direction, z upwards", None, "axis", lambda _: ("x", "y", "z")),
    array("end", "end of the thread", None, "end", lambda _: ("A", "B")),
    array("extreme", "which extreme", None, "extreme", lambda _: ("lowest", "highest")),
    array("energy_kind", "kind of energy", None, "energy_kind",
        lambda _: ("kinetic", "potential", "stretch", "bending")),
))
