"""Run the scene of a thread in a stream: solve, tabulate, write and draw."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from hydroelastic.fem.progress import Report
from hydroelastic.fem.thread.motion_in_space import MotionInSpace
from hydroelastic.output.csv_files import write_csv
from hydroelastic.output.line_sequence import Frame, frame_numbers, write_line, write_sequence
from hydroelastic.output.plots import OF_CURVES, OF_FIELDS, OF_MOTIONS, PictureOptions
from hydroelastic.output.thread.quantities import THREAD
from hydroelastic.output.thread.tables import thread_cost, thread_sections
from hydroelastic.output.variables import numbered
from hydroelastic.scenes.staged_run import StagedRun
from hydroelastic.scenes.thread.results import Floats, ThreadSolutionOfScene
from hydroelastic.scenes.thread.solve import solve_thread_scene

_ENOUGH_TIMES = 24


def _draw(solution: ThreadSolutionOfScene, folder: Path, options: PictureOptions, _report: Report) -> None:
    # Who only wants the numbers does without what draws.
    from hydroelastic.scenes.thread.figures import draw_thread

    draw_thread(solution, folder, options)


def animation_notes(solution: ThreadSolutionOfScene) -> tuple[str, ...]:
    """Return notes with the key to set: a motion is known at the output times alone."""
    oscillating = any(len(modes.oscillating.values) for modes in solution.modes)
    if not (solution.motions or oscillating):
        return ('nothing of this scene is animated: ask for an [[analysis]] with kind = "modes" or "motion"',)
    return tuple(
        f"the animation of motion {number} has {len(motion.times)} pages only, one for each of its times: give the "
        f'[[analysis]] key "times" {_ENOUGH_TIMES} or more'
        for number, motion in enumerate(solution.motions, 1)
        if len(motion.times) < _ENOUGH_TIMES
    )


def write_thread_files(solution: ThreadSolutionOfScene, folder: Path) -> None:
    """Write ``shape.csv``, a CSV for each analysis, and ``fields/`` into an existing folder; SI units.

    Several analyses of a kind are numbered: ``modes.csv``, ``modes_2.csv``.
    """
    rest = solution.rest
    shape = _vector("", rest.positions) | {"tension": rest.tensions} | _vector("force_", rest.forces)
    write_csv(folder / "shape.csv", {"s": solution.s} | shape | {"curvature": rest.curvatures})
    for number, modes in enumerate(solution.modes):
        roots = np.concatenate([modes.oscillating.values, modes.aperiodic.values])
        columns = {
            "oscillates": (np.arange(len(roots)) < len(modes.oscillating.values)).astype(int),
            "real_part": roots.real,
            "imaginary_part": roots.imag,
            **{
                name: np.concatenate([getattr(modes.oscillating, source), getattr(modes.aperiodic, source)])
                for name, source in (("out_of_plane", "out_of_plane"), ("relative_error", "relative_errors"))
            },
        }
        write_csv(folder / numbered("modes", number, ".csv"), columns)
    for number, sweep in enumerate(solution.stability):
        rows = [
            (t.value, int(t.kind == "flutter"), t.frequency, *t.growing, t.error / t.value) for t in sweep.thresholds
        ]
        names = ("factor", "flutter", "omega", "growing_below", "growing_above", "relative_error")
        columns = {name: [row[place] for row in rows] for place, name in enumerate(names)}
        write_csv(folder / numbered("stability", number, ".csv"), columns)
    for number, motion in enumerate(solution.motions):
        # One row for each time and node.
        times, s = np.meshgrid(motion.times, motion.nodes, indexing="ij")
        moved = _vector("", motion.positions.reshape(-1, 3)) | {"tension": motion.tensions.ravel()}
        write_csv(folder / numbered("motion", number, ".csv"), {"time": times.ravel(), "s": s.ravel()} | moved)
    _write_fields(solution, folder / "fields")


def _vector(name: str, values: Floats) -> dict[str, Floats]:
    return {f"{name}{axis}": component for axis, component in zip("xyz", values.T, strict=True)}


def _write_fields(solution: ThreadSolutionOfScene, folder: Path) -> None:
    folder.mkdir()
    rest = solution.rest
    write_line(folder / "equilibrium.vtu", rest.positions, {"s": solution.s, "tension": rest.tensions})
    for number, motion in enumerate(solution.motions):
        if solution.scene.output.frames:
            write_sequence(folder, numbered("motion", number), _frames(solution, motion))


def _frames(solution: ThreadSolutionOfScene, motion: MotionInSpace) -> Iterator[Frame]:
    for number in frame_numbers(solution.scene.output.frames, len(motion.times)):
        data = {"s": motion.nodes, "tension": motion.tensions[number]}
        yield float(motion.times[number]), motion.positions[number], data


run_thread = StagedRun(
    solve=solve_thread_scene,
    kind=THREAD,
    write=write_thread_files,
    draw=_draw,
    animation_warnings=animation_notes,
    used_options=OF_CURVES | OF_FIELDS | OF_MOTIONS,
    sections=lambda _solution, summary: thread_sections(summary),
    cost=thread_cost,
)
