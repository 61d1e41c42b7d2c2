"""All numbers of a solution of open water as CSV: one row for each frequency, resonance, time or point of a beam."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from hydroelastic.output.columns import Column, columns_of, csv_columns
from hydroelastic.output.csv_files import write_csv
from hydroelastic.output.open_water import quantities as water
from hydroelastic.output.open_water.declarations import own_array
from hydroelastic.output.open_water.hull_pressures import ALONG_HULL, HULL_BODY, HULL_X, HULL_Y, PRESSURE
from hydroelastic.output.open_water.irregular import SPECTRUM
from hydroelastic.output.open_water.quantities import ALONG_BEAM, DECAY, RADIATION, RESONANCE, RESPONSE
from hydroelastic.output.open_water.time_quantities import IMPULSE_RESPONSE, MOTION
from hydroelastic.output.quantities import Group

ROWS = {
    "radiation": ("omega",),
    "response": ("omega", "wave"),
    "resonance": ("resonance",),
    "decay": ("time",),
    "spectrum": ("spectrum_omega",),
    "impulse_response": ("impulse_time",),
    "motion": ("motion_time",),
}
"""Dimensions whose places are the rows of the tables of an analysis."""
# fmt: off
# Tables: as many arguments on a line as fit.
_DEFLECTION = Group("deflection", "deflection of a beam", (
    water.PLATE_BODY, water.OMEGA, water.WAVES, water.POSITIONS, water.DEFLECTION, water.BENDING_MOMENT,
    water.SHEAR_FORCE,
))
STRAIN = Group("strain", "strain and stress of a plate", (water.OMEGA, water.LARGEST_STRAIN, water.LARGEST_STRESS))
"""Columns of the table of strains."""
_CURVE = Group("response_curve", "response between the frequencies", (
    water.OMEGA, water.WAVES_FROM, water.WAVES, water.REFLECTION, water.TRANSMISSION, water.AMPLITUDES,
    water.ABSORPTION, water.DRIFT_FORCE,
    own_array("basis_error", "estimated relative error by the reduced basis", "omega", lambda it: it.relative_error,
        column="basis_error", contract=False),
))
_PRESSURE = Group("pressure", "pressure along a hull", (HULL_BODY, water.OMEGA, water.WAVES, HULL_X, HULL_Y, PRESSURE))
# fmt: on


def open_columns(group: Group, table: Any, rows: tuple[str, ...] = ()) -> Iterator[Column]:
    """Yield the columns of the table of an analysis; its rows are those of `ROWS`, if no others are given."""
    motions = dict.fromkeys(("influenced_dof", "radiating_dof", "dof"), table.dofs)
    waves = dict.fromkeys(("wave", "outgoing_wave"), getattr(table, "waves", ()))
    motions["spectrum_quantity"] = getattr(table, "quantities", ())
    partial = getattr(table, "partial_waves", None)
    orders = [f"order_{number}" for number in range(0 if partial is None else partial.shape[-1])]
    labels = {**motions, **waves, "wave_direction": ("from_left", "from_right"), "azimuthal_order": orders}
    return columns_of(group, table, rows or ROWS[group.key], labels)


def write_open_csv(solution: Any, folder: Path) -> None:
    """Write ``radiation.csv``, ``response.csv``, ``response_curve.csv``, ``deflection.csv``, ``pressure.csv``,
    ``resonance.csv``, ``decay.csv``, ``spectrum.csv``, ``motion.csv``, ``impulse_response.csv`` and, with what this
    gives back in the frequency domain, ``impulse_response_check.csv``.

    Those without rows are left out. The column ``analysis`` counts analyses of a kind from 1; ``re_`` and ``im_`` are
    the parts of a complex number; of a matrix, the first name is the force and the second the motion, or the wave that
    comes and the wave that leaves. Phases are those beside an incident wave whose crest is at x = 0 of the scene, or
    at ``sea.phase_at``, at t = 0, but for ``phase_at_body``.
    """
    groups = (RADIATION, RESPONSE, RESONANCE, DECAY, SPECTRUM, IMPULSE_RESPONSE, MOTION)
    files = {
        group.key: csv_columns((number, open_columns(group, one)) for number, one in enumerate(group.of(solution), 1))
        for group in groups
    }
    files["response_curve"] = csv_columns(
        (number, open_columns(_CURVE, table.curve, ROWS["response"]))
        for number, table in enumerate(solution.response, 1)
        if table.curve is not None
    )
    files["deflection"] = csv_columns(
        (number, columns_of(_DEFLECTION, plate, ("omega", "wave", ALONG_BEAM), {}))
        for number, table in enumerate(RESPONSE.of(solution), 1)
        for plate in table.deflections
    )
    files["pressure"] = csv_columns(
        (number, columns_of(_PRESSURE, hull, ("omega", "wave", ALONG_HULL), {}))
        for number, table in enumerate(RESPONSE.of(solution), 1)
        for hull in table.pressures
    )
    files["impulse_response_check"] = csv_columns(
        (number, open_columns(IMPULSE_RESPONSE, table, ("impulse_omega",)))
        for number, table in enumerate(IMPULSE_RESPONSE.of(solution), 1)
    )
    for name, columns in files.items():
        if columns["analysis"]:
            write_csv(folder / f"{name}.csv", columns)
