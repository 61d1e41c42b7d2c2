"""Followed modes of a sweep as rows of tables, and as variables of a dataset."""

from __future__ import annotations

from typing import Any

import numpy as np

from hydroelastic.output.variables import Variable
from hydroelastic.scenes.sweep.lines import place_of
from hydroelastic.scenes.sweep.run import SolvedSweep

_SYMMETRIES = {1.0: "symmetric", -1.0: "antisymmetric"}


def branch_rows(solved: SolvedSweep) -> list[dict[str, Any]]:
    """Return a row for each followed mode at each point; branches and modes are numbered from 1."""
    key = solved.grid.axes[0].key
    rows: list[dict[str, Any]] = []
    for line in solved.lines:
        for place, value in enumerate(line.values):
            modes = line.followed.modes[place]
            for branch, mode in enumerate(line.followed.branches[place]):
                if mode >= 0:
                    row: dict[str, Any] = {key: value} | line.others | {"added": bool(line.followed.refined[place])}
                    row |= {"branch": branch + 1, "mode": int(mode) + 1, "omega": float(modes.omega[mode])}
                    row["relative_error"] = float(modes.relative_error[mode])
                    row["symmetry"] = _SYMMETRIES.get(float(modes.symmetry[mode]), "")
                    rows.append(
                        row | {f"participation_{n + 1}": float(p[mode]) for n, p in enumerate(modes.participation)}
                    )
    return rows


def encounter_rows(solved: SolvedSweep) -> list[dict[str, Any]]:
    """Return a row for each encounter of two followed modes."""
    axis = solved.grid.axes[0]
    return [
        {axis.key: place_of(one, axis)}
        | line.others
        | {"kind": one.kind, "omega": one.omega, "gap": one.gap, "gap_error": one.gap_error}
        | {"lower_branch": one.branches[0] + 1, "upper_branch": one.branches[1] + 1, "reason": one.reason}
        for line in solved.lines
        for one in line.encounters
    ]


def branch_variables(solved: SolvedSweep) -> list[Variable]:
    """Return the followed modes on the grid of a sweep, and the encounters along a dimension of their own."""
    if not solved.lines:
        return []
    axes, shape = solved.grid.axes, solved.grid.shape
    along = tuple(axis.name for axis in axes)
    count = max(line.followed.branches.shape[1] for line in solved.lines)
    beams = len(solved.lines[0].followed.modes[0].participation)
    number = np.zeros((*shape, count), dtype=np.int32)
    omega = np.full((*shape, count), np.nan)
    parts = np.full((*shape, beams, count), np.nan)
    for line in solved.lines:
        rest: tuple[int, ...] = tuple(axis.values.index(line.others[axis.key]) for axis in axes[1:])
        by_value = {value: place for place, value in enumerate(line.values)}
        for row, value in enumerate(axes[0].values):
            place = by_value.get(float(value))
            if place is not None:
                modes, branches = line.followed.modes[place], line.followed.branches[place]
                there = np.flatnonzero(branches >= 0)
                here = (row, *rest)
                number[here][there] = branches[there] + 1
                omega[here][there] = modes.omega[branches[there]]
                parts[here][:, there] = modes.participation[:, branches[there]]
    found = [
        _variable("branch_mode", (*along, "branch"), number, "number of the mode of a branch, 0 where there is none"),
        _variable("branch_omega", (*along, "branch"), omega, "angular frequency of a branch", "rad/s"),
    ]
    if beams:
        said = "part of a branch in the first elastic tone"
        found.append(_variable("branch_participation", (*along, "elastic_body", "branch"), parts, said, "1"))
        said = "sum of the parts of all modes in the first elastic tone, 1 of infinitely many"
        found.append(_variable("participation_sum", (*along, "elastic_body"), np.nansum(parts, axis=-1), said, "1"))
    rows = encounter_rows(solved)
    for name in rows[0] if rows else ():
        unit = "rad/s" if name in ("omega", "gap", "gap_error") else None
        values, said = (
            np.array([row[name] for row in rows]),
            f"{name.replace('_', ' ')} of an encounter of two branches",
        )
        found.append(_variable(f"encounter_{name.replace('.', '_')}", ("encounter",), values, said, unit))
    return found


def _variable(
    name: str, dimensions: tuple[str, ...], values: np.ndarray, meaning: str, unit: str | None = None
) -> Variable:
    attributes = {"long_name": meaning} | ({} if unit is None else {"units": unit})
    return Variable(name=name, dimensions=dimensions, values=values, attributes=attributes)
