"""A thread as files: CSV, a labelled dataset, lines for ParaView."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from hydroelastic.fem.thread_modes import Roots
from hydroelastic.scenes.line_sequence import Frame, frame_numbers, write_line, write_sequence
from hydroelastic.scenes.provenance import versions
from hydroelastic.scenes.thread_results import Floats, FollowedMotion, ThreadSolutionOfScene

SHAPE_COLUMNS = ("s", "x", "y", "z", "tension", "force_x", "force_y", "force_z", "curvature")


def write_thread_files(solution: ThreadSolutionOfScene, folder: Path) -> None:
    """Write ``shape.csv``, a CSV for each analysis, ``dataset.nc`` and ``fields/`` into an existing folder; SI units.

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
    _write_dataset(solution, folder / "dataset.nc")
    _write_fields(solution, folder / "fields")


def numbered(name: str, number: int, suffix: str = "") -> str:
    """The name of a file of the first (0), second … analysis of a kind."""
    return f"{name}{suffix}" if number == 0 else f"{name}_{number + 1}{suffix}"


def _write_csv(file: Path, columns: tuple[str, ...], rows: Floats) -> None:
    np.savetxt(file, rows, delimiter=",", fmt="%.12g", header=",".join(columns), comments="", encoding="utf-8")


def _mode_rows(roots: Roots, oscillates: int) -> Floats:
    values = roots.values
    return np.column_stack(
        [np.full(len(values), oscillates), values.real, values.imag, roots.out_of_plane, roots.errors / np.abs(values)]
    )


def _rows(motion: FollowedMotion) -> Floats:
    """One row for each time and node."""
    times, s = np.meshgrid(motion.times, motion.nodes, indexing="ij")
    return np.column_stack([times.ravel(), s.ravel(), motion.positions.reshape(-1, 3), motion.tensions.ravel()])


def _write_dataset(solution: ThreadSolutionOfScene, file: Path) -> None:
    # xarray takes a while to import.
    import xarray

    rest, axis = solution.rest, ["x", "y", "z"]
    parts = [
        xarray.Dataset(
            {
                "position": (("s", "axis"), rest.positions, {"units": "m"}),
                "tension": ("s", rest.tensions, {"units": "N", "absolute_error": rest.tension_error}),
                "contact_force": (("s", "axis"), rest.forces, {"units": "N"}),
                "curvature": ("s", rest.curvatures, {"units": "1/m"}),
                "reaction": (("end", "axis"), rest.reactions, {"units": "N", "absolute_error": rest.reaction_error}),
                "end_moment": ("end", rest.end_moments, {"units": "N m", "absolute_error": rest.moment_error}),
            },
            {
                "s": ("s", solution.s, {"units": "m", "long_name": "distance from end A along the thread"}),
                "axis": axis,
                "end": ["A", "B"],
            },
        )
    ]
    parts[0]["position"].attrs["absolute_error"] = rest.position_error
    for number, modes in enumerate(solution.modes):
        parts.append(_mode_variables(solution, number, modes))
    for number, sweep in enumerate(solution.stability):
        parts.append(_stability_variables(number, sweep))
    for number, motion in enumerate(solution.motions):
        parts.append(_motion_variables(number, motion))
    dataset = xarray.merge(parts).assign_attrs(
        title=solution.scene.title,
        hydroelastic_version=versions()["hydroelastic"],
        status="unconverged" if solution.reasons else "ok",
    )
    dataset.to_netcdf(file)


def _mode_variables(solution: ThreadSolutionOfScene, number: int, modes: Any) -> Any:
    import xarray

    mode, node = numbered("mode", number), numbered("mode_s", number)
    roots = np.concatenate([modes.oscillating.values, modes.aperiodic.values])
    errors = np.concatenate([modes.oscillating.errors, modes.aperiodic.errors])
    shapes = solution.frame.outside(np.concatenate([modes.oscillating.shapes, modes.aperiodic.shapes]))
    return xarray.Dataset(
        {
            numbered("root", number): (("complex", mode), np.array([roots.real, roots.imag]), {"units": "1/s"}),
            numbered("root_error", number): (mode, errors, {"units": "1/s"}),
            numbered("mode_shape", number): (
                ("complex", mode, node, "axis"),
                np.array([shapes.real, shapes.imag]),
                {"long_name": "displacement"},
            ),
        },
        {node: (node, modes.nodes, {"units": "m"}), "complex": ["re", "im"]},
    )


def _stability_variables(number: int, sweep: Any) -> Any:
    import xarray

    factor, branch = numbered("factor", number), numbered("branch", number)
    roots = np.array([sweep.roots.real, sweep.roots.imag])
    return xarray.Dataset(
        {
            numbered("followed_root", number): (("complex", factor, branch), roots, {"units": "1/s"}),
            numbered("growing", number): (factor, sweep.growing.astype(np.int32)),
        },
        {factor: (factor, sweep.values, {"long_name": "factor of the stream"}), "complex": ["re", "im"]},
    )


def _motion_variables(number: int, motion: FollowedMotion) -> Any:
    import xarray

    time, node, end = numbered("time", number), numbered("node", number), numbered("step_end", number)
    return xarray.Dataset(
        {
            numbered("motion_position", number): (
                (time, node, "axis"),
                motion.positions,
                {"units": "m", "absolute_error": motion.position_error},
            ),
            numbered("motion_tension", number): (
                (time, node),
                motion.tensions,
                {"units": "N", "absolute_error": motion.tension_error},
            ),
            numbered("energy", number): ((end, "energy_kind"), motion.energies, {"units": "J"}),
            numbered("work_of_drag", number): (end, motion.drag_work, {"units": "J"}),
        },
        {
            time: (time, motion.times, {"units": "s"}),
            node: (node, motion.nodes, {"units": "m"}),
            end: (end, motion.step_ends, {"units": "s"}),
            "energy_kind": ["kinetic", "potential", "stretch", "bending"],
        },
    )


def _write_fields(solution: ThreadSolutionOfScene, folder: Path) -> None:
    folder.mkdir()
    rest = solution.rest
    write_line(folder / "equilibrium.vtu", rest.positions, {"s": solution.s, "tension": rest.tensions})
    for number, motion in enumerate(solution.motions):
        if solution.scene.output.frames:
            write_sequence(folder, numbered("motion", number), _frames(solution, motion))


def _frames(solution: ThreadSolutionOfScene, motion: FollowedMotion) -> Iterator[Frame]:
    for number in frame_numbers(solution.scene.output.frames, len(motion.times)):
        data = {"s": motion.nodes, "tension": motion.tensions[number]}
        yield float(motion.times[number]), motion.positions[number], data
