"""A thread as files: CSV, and lines for ParaView."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from hydroelastic.fem.thread.modes import Roots
from hydroelastic.fem.thread.motion_in_space import MotionInSpace
from hydroelastic.output.line_sequence import Frame, frame_numbers, write_line, write_sequence
from hydroelastic.scenes.thread.results import Floats, ThreadSolutionOfScene

SHAPE_COLUMNS = ("s", "x", "y", "z", "tension", "force_x", "force_y", "force_z", "curvature")


def write_thread_files(solution: ThreadSolutionOfScene, folder: Path) -> None:
    """Write ``shape.csv``, a CSV for each analysis, and ``fields/`` into an existing folder; SI units.

    Several analyses of a kind are numbered: ``modes.csv``, ``modes_2.csv``.
    """
    rest = solution.rest
    shape = np.column_stack([solution.s, rest.positions, rest.tensions, rest.forces, rest.curvatures])
    _write_csv(folder / "shape.csv", SHAPE_COLUMNS, shape)
    for number, modes in enumerate(solution.modes):
        rows = np.vstack([_mode_rows(modes.oscillating, 1), _mode_rows(modes.aperiodic, 0)])
        columns = ("oscillates", "real_part", "imaginary_part", "out_of_plane", "relative_error")
        _write_csv(folder / numbered("modes", number, ".csv"), columns, rows)
    for number, sweep in enumerate(solution.stability):
        rows = np.array(
            [(t.value, t.kind == "flutter", t.frequency, *t.growing, t.error / t.value) for t in sweep.thresholds]
        )
        headings = ("factor", "flutter", "omega", "growing_below", "growing_above", "relative_error")
        _write_csv(folder / numbered("stability", number, ".csv"), headings, rows.reshape(-1, len(headings)))
    for number, motion in enumerate(solution.motions):
        _write_csv(folder / numbered("motion", number, ".csv"), ("time", "s", "x", "y", "z", "tension"), _rows(motion))
    _write_fields(solution, folder / "fields")


def numbered(name: str, number: int, suffix: str = "") -> str:
    """The name of a file of the first (0), second … analysis of a kind."""
    return f"{name}{suffix}" if number == 0 else f"{name}_{number + 1}{suffix}"


def _write_csv(file: Path, columns: tuple[str, ...], rows: Floats) -> None:
    np.savetxt(file, rows, delimiter=",", fmt="%.12g", header=",".join(columns), comments="", encoding="utf-8")


def _mode_rows(roots: Roots, oscillates: int) -> Floats:
    values = roots.values
    return np.column_stack(
        [np.full(len(values), oscillates), values.real, values.imag, roots.out_of_plane, roots.relative_errors]
    )


def _rows(motion: MotionInSpace) -> Floats:
    """One row for each time and node."""
    times, s = np.meshgrid(motion.times, motion.nodes, indexing="ij")
    return np.column_stack([times.ravel(), s.ravel(), motion.positions.reshape(-1, 3), motion.tensions.ravel()])


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
