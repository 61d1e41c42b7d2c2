"""Tables of the analyses of open water over time: impulse responses, and motions in waves."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from hydroelastic.fem.time_domain.results import ImpulseResponseTable, MotionTable
from hydroelastic.output.columns import headings_of, rows_of
from hydroelastic.output.digits import number
from hydroelastic.output.open_water import time_quantities as over_time
from hydroelastic.output.open_water.files import open_columns
from hydroelastic.output.open_water.shown_rows import largest, shown_rows
from hydroelastic.output.quantities import Group
from hydroelastic.output.sections import Section
from hydroelastic.output.whole_units import of_whole_solids

_MOST_MOTIONS = 4


def sections_over_time(solution: Any, whole: bool) -> Iterator[Section]:
    """Yield the tables of impulse responses and of motions in waves, of whole solids or per metre of width."""
    for impulse_response in solution.impulse_response:
        group = over_time.IMPULSE_RESPONSE
        yield _impulse_response(impulse_response, of_whole_solids(group) if whole else group)
    for motion in solution.motion:
        yield _motion(motion)


def _impulse_response(table: ImpulseResponseTable, group: Group) -> Section:
    """The diagonal of K; what it gives back in the frequency domain is a file."""
    shown, thinned = shown_rows(len(table.times), "times", "impulse_response.csv")
    columns = [
        column
        for column in open_columns(group, table)
        if len(set(column.places.values())) < 2 and column.places.get("influenced_dof", 0) < _MOST_MOTIONS
    ]
    added = group[over_time.INFINITE_FREQUENCY_ADDED_MASS.key]
    units = [(unit or "").replace(" ", "·") for unit in (added.unit, added.of_roll[-1])]
    far = ", ".join(
        f"{dof.words} {number(float(value))} {units[dof.is_rotation]}"
        for dof, value in zip(table.dofs, np.diag(table.infinite_frequency_added_mass), strict=True)
    )
    return Section(
        title="Impulse responses K of radiation",
        headings=headings_of(columns, "influenced_dof"),
        rows=rows_of(group, columns, shown),
        lines=(
            *thinned,
            f"Added mass at infinite frequency: {far}.",
            f"Added mass and damping by K at {len(table.omega)} frequencies from {table.omega[0]:.3g} to "
            f"{table.omega[-1]:.3g} rad/s differ from the frequency domain by {largest(table.causality_error)} of "
            f"themselves, added mass at infinite frequency by Ogilvie's relation from its limit by "
            f"{largest(table.ogilvie_error)}; estimated error {table.relative_error:.1e}.",
            "Coupling of motions: impulse_response.csv; what K gives back: impulse_response_check.csv.",
        ),
    )


def _motion(table: MotionTable) -> Section:
    elevation = (over_time.ELEVATION,) if len(table.wave_omega) else ()
    printed = over_time.MOTION_TIMES, *elevation, over_time.MOTION_DISPLACEMENT
    shown, thinned = shown_rows(len(table.times), "times", "motion.csv")
    columns = [
        column
        for column in open_columns(over_time.MOTION, table)
        if column.quantity in printed and column.places.get("dof", 0) < _MOST_MOTIONS
    ]
    about = "η is that of the incident waves at the middle of the first body. " if len(table.wave_omega) else ""
    sizes = "; ".join(
        f"{dof.words} {deviation:.4g} and {largest:.4g} {'rad' if dof.is_rotation else 'm'}"
        for dof, deviation, largest in zip(table.dofs, table.standard_deviation, table.largest, strict=True)
    )
    return Section(
        title=f"Motion {table.beginning}",
        headings=headings_of(columns, "dof"),
        rows=rows_of(over_time.MOTION, columns, shown),
        lines=(
            *thinned,
            f"Standard deviation and largest motion after {table.ramp:g} s: {sizes}.",
            f"{about}Estimated error relative to the largest motion {table.relative_error:.1e}.",
        ),
    )
