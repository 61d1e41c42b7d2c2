"""All numbers of a solution of open water as CSV: one row for each frequency, resonance or time."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from hydroelastic.fem.open_water.results import DecayTable, RadiationTable, ResonanceTable, ResponseTable
from hydroelastic.scenes.open_water.results import OpenSolution

_Row = dict[str, float | int | str]


def write_csv(solution: OpenSolution, folder: Path) -> None:
    """Write ``radiation.csv``, ``response.csv``, ``deflection.csv``, ``resonance.csv`` and ``decay.csv``.

    Those without rows are left out. The column ``analysis`` counts analyses of a kind from 1; ``re_`` and ``im_`` are
    the parts of a complex number; of a matrix, the first name is the force and the second the motion, or the wave that
    comes and the wave that leaves. Phases are those beside an
    incident wave whose crest is at x = 0 of the scene at t = 0.

    Args:
        solution: the solution.
        folder: an existing folder.
    """
    files = {
        "radiation": [row for number, table in enumerate(solution.radiation, 1) for row in _radiation(number, table)],
        "response": [row for number, table in enumerate(solution.response, 1) for row in _response(number, table)],
        "deflection": [row for number, table in enumerate(solution.response, 1) for row in _deflection(number, table)],
        "resonance": [row for number, table in enumerate(solution.resonance, 1) for row in _resonance(number, table)],
        "decay": [row for number, table in enumerate(solution.decay, 1) for row in _decay(number, table)],
    }
    for name, rows in files.items():
        if not rows:
            continue
        # Analyses of one kind may have different motions: a column for each, in order of appearance.
        columns = list({column: None for row in rows for column in row})
        with (folder / f"{name}.csv").open("w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, columns, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)


def _parts(name: str, value: complex) -> _Row:
    return {f"re_{name}": float(value.real), f"im_{name}": float(value.imag)}


def _column(dof: str) -> str:
    return dof.replace(" ", "_")


def _radiation(number: int, table: RadiationTable) -> Iterator[_Row]:
    motions = [_column(dof) for dof in table.dofs]
    forces = {
        "excitation_force": table.excitation_force,
        "froude_krylov_force": table.froude_krylov_force,
        "diffraction_force": table.diffraction_force,
    }
    for place, omega in enumerate(table.omega):
        row: _Row = {"analysis": number, "omega": float(omega)}
        row |= {f"wavenumber_{wave}": float(k) for wave, k in zip(table.waves, table.wavenumbers[place], strict=True)}
        for name, matrix in (("added_mass", table.added_mass), ("radiation_damping", table.radiation_damping)):
            for force, motion in np.ndindex(matrix.shape[1:]):
                row[f"{name}_{motions[force]}_{motions[motion]}"] = float(matrix[place, force, motion])
        for name, values in forces.items():
            for wave, direction, motion in np.ndindex(values.shape[1:]):
                side = ("left", "right")[direction]
                said = f"{name}_{table.waves[wave]}_from_{side}_{motions[motion]}"
                row |= _parts(said, values[place, wave, direction, motion])
        yield row | {
            "relative_error": float(table.relative_error[place]),
            "energy_residual": float(table.energy_residual[place]),
            "haskind_residual": float(table.haskind_residual[place]),
        }


def _response(number: int, table: ResponseTable) -> Iterator[_Row]:
    for place, omega in enumerate(table.omega):
        for incident, wave in enumerate(table.waves):
            row: _Row = {"analysis": number, "omega": float(omega), "waves_from": table.waves_from, "wave": wave}
            row["wavenumber"] = float(table.wavenumbers[place, incident])
            for outgoing, name in enumerate(table.waves):
                row |= _parts(f"reflection_{name}", table.reflection[place, incident, outgoing])
                row |= _parts(f"transmission_{name}", table.transmission[place, incident, outgoing])
            for motion, dof in enumerate(table.dofs):
                row |= _parts(_column(dof), table.amplitudes[place, incident, motion])
            yield row | {
                "energy_residual": float(table.energy_residual[place, incident]),
                "relative_error": float(table.relative_error[place]),
            }


def _deflection(number: int, table: ResponseTable) -> Iterator[_Row]:
    for plate in table.plates:
        for place, wave, point in np.ndindex(plate.deflection.shape):
            row: _Row = {"analysis": number, "body": plate.body + 1, "omega": float(table.omega[place])}
            row |= {"wave": table.waves[wave], "x": float(plate.positions[point])}
            yield row | _parts("deflection", plate.deflection[place, wave, point])


def _resonance(number: int, table: ResonanceTable) -> Iterator[_Row]:
    for place, omega in enumerate(table.omega):
        row: _Row = {"analysis": number, "resonance": place + 1, "label": table.labels[place]}
        row |= _parts("omega", omega)
        for motion, dof in enumerate(table.dofs):
            row |= _parts(_column(dof), table.body_amplitudes[place, motion])
        yield row | {
            "relative_error": float(table.relative_error[place]),
            "residual": float(table.residuals[place]),
        }


def _decay(number: int, table: DecayTable) -> Iterator[_Row]:
    for place, time in enumerate(table.times):
        row: _Row = {"analysis": number, "time": float(time)}
        row |= {_column(dof): float(value) for dof, value in zip(table.dofs, table.displacement[place], strict=True)}
        yield row | {"absolute_error": float(table.absolute_error[place])}
