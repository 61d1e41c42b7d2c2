"""Tables of open water, printed and written as Markdown."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from math import pi
from typing import Any

import numpy as np

from hydroelastic.fem.open_water.irregular_results import SpectrumTable
from hydroelastic.fem.open_water.results import (
    DecayTable,
    RadiationTable,
    ResonanceTable,
    UnresolvedPeak,
)
from hydroelastic.modal.floats.infinite_draught import InfiniteDraughtFloat
from hydroelastic.output.columns import Column, columns_of, headings_of, rows_of
from hydroelastic.output.digits import beyond_error, number, with_certain_digits
from hydroelastic.output.open_water import estimates
from hydroelastic.output.open_water import quantities as water
from hydroelastic.output.open_water.bodies import bodies_section
from hydroelastic.output.open_water.files import STRAIN, open_columns
from hydroelastic.output.open_water.irregular import AIR_GAPS, LOADS, RESPONSES, SPECTRUM
from hydroelastic.output.open_water.linear_limits import beyond_linear_theory
from hydroelastic.output.open_water.quantities import WavesAndMotions, region_words
from hydroelastic.output.open_water.shown_rows import MOST_ROWS, largest, shown_rows
from hydroelastic.output.open_water.time_tables import sections_over_time
from hydroelastic.output.provenance import spent
from hydroelastic.output.quantities import Group, Quantity
from hydroelastic.output.quantity_tables import columns
from hydroelastic.output.reading import Reading
from hydroelastic.output.sections import Row, Section
from hydroelastic.output.whole_units import of_whole_solids
from hydroelastic.physics.dofs import Dof

_MOST_MOTIONS = 4


def open_sections(solution: Any, summary: Reading) -> Iterator[Section]:
    """Yield the bodies at rest, the tables by analysis, the limits of the model, and the comparison with the thin-float
    theory."""
    yield bodies_section(solution)
    whole = solution.tank.geometry.is_whole
    for radiation in solution.radiation:
        yield from _radiation(radiation, of_whole_solids(water.RADIATION) if whole else water.RADIATION)
    for response in water.RESPONSE.of(solution):
        yield from _response(response, of_whole_solids(water.RESPONSE) if whole else water.RESPONSE)
    for resonance in solution.resonance:
        yield _resonance(resonance)
    for decay in solution.decay:
        yield _decay(decay)
    for spectrum in SPECTRUM.of(solution):
        yield from _spectrum(spectrum, whole)
    yield from sections_over_time(solution, whole)
    yield from beyond_linear_theory(solution)
    if solution.left_out:
        yield Section(title="Left out of the model", lines=solution.left_out)
    yield from _estimates(solution.endless_float, summary)


def _estimates(infinite: InfiniteDraughtFloat | None, summary: Reading) -> Iterator[Section]:
    found = summary[estimates.ESTIMATES]
    thin_float = found[estimates.THIN_FLOAT]
    rows, round_rows = thin_float[estimates.THIN_FLOAT_ROWS], found[estimates.ROUND_BODY][estimates.ROUND_BODY_ROWS]
    headings = tuple(part.key for part in estimates.THIN_FLOAT_ROWS.parts)
    if rows:
        yield Section(
            title="The thin-float theory beside the field solution",
            headings=headings,
            rows=columns(rows),
            lines=(
                f"{thin_float[estimates.NOTE]} Of curves the largest difference is shown, in parts of the largest "
                "value, or of the displacement at first.",
            ),
            compares=True,
        )
    if round_rows:
        of_surge = "Of surge the largest difference of all frequencies is shown, as a part of the largest value."
        yield Section(
            title="Closed forms and older estimates beside the field solution",
            headings=headings,
            rows=columns(round_rows),
            lines=(of_surge,) if any(" of surge " in row[estimates.QUANTITY] for row in round_rows) else (),
            compares=True,
        )
    if infinite is not None:
        yield Section(
            title="The float of infinite draught of the paper, by its closed form",
            headings=("pole", "Re ω, rad/s", "Im ω, 1/s", "Re residue", "Im residue"),
            rows=[
                (name, number(omega.real), number(omega.imag), number(residue.real), number(residue.imag))
                for name, omega, residue in zip(
                    ("heave", "second"), infinite.resonances, infinite.residues, strict=True
                )
            ],
            lines=("After a release s/s₀ contains 2 Re(residue e^(−iωt)) of each.", infinite_draught_message(infinite)),
        )


def infinite_draught_message(infinite: InfiniteDraughtFloat) -> str:
    """Return a message on the difference from the float of infinite draught."""
    return (
        "The float ends at its tail. After a release it differs from the paper's float of infinite draught by "
        f"up to about {infinite.cut:.1g} of the displacement at first, which no estimated error of the field solution "
        "holds: that is of the float with its end. A smaller tail brings them together."
    )


def open_cost(summary: Reading) -> str:
    """Size and cost of the solution."""
    size = summary[water.SIZE]
    cells = f"{size[water.CELLS]} cells, degree {size[water.DEGREE]}"
    return f"{cells}, {size[water.DOFS]} unknowns{spent(summary)}"


def _radiation(table: RadiationTable, group: Group) -> Iterator[Section]:
    """One table for each motion: the diagonals of a and b, and the excitation by waves from the left."""
    several = len(table.waves) > 1
    shown, thinned = shown_rows(len(table.omega), "frequencies", "radiation.csv")
    worst = f"Largest residuals: energy {largest(table.energy_residual)}, Haskind {largest(table.haskind_residual)}."
    further = (
        "The last column is the error of a over |H|, the magnitude of a + ib/ω of the motion; ± b is the error of b.",
        "Coupling of motions, phases and waves from the right: radiation.csv and dataset.nc.",
        f"{worst} {table.factorizations} factorizations.",
    )
    left_out = water.WAVENUMBERS.key if several else ""
    found = [column for column in open_columns(group, table) if column.quantity.key != left_out]
    for place, motion in enumerate(table.dofs):
        own = {"influenced_dof": place, "radiating_dof": place, "wave_direction": 0}
        columns = [column for column in found if all(own.get(name, at) == at for name, at in column.places.items())]
        printed = [column for column in columns if column.quantity.printed]
        damping, error = table.radiation_damping[:, place, place], table.radiation_damping_error[:, place, place]
        hidden = np.count_nonzero((damping <= error) & (error > 0.0))
        yield Section(
            title=f"Radiation by {motion.words}",
            headings=headings_of(printed, "wave" if several else ""),
            rows=rows_of(group, printed, shown, columns),
            lines=(
                *thinned,
                *((f"NOT RESOLVED: b is not larger than its error at {hidden} frequencies.",) if hidden else ()),
                *(further if place == len(table.dofs) - 1 else ()),
            ),
        )


def _response(table: WavesAndMotions, group: Group) -> Iterator[Section]:
    """Outgoing waves and motions of the bodies for each incident wave."""
    count = len(table.waves)
    places = max(MOST_ROWS // count, 2)
    shown, thinned = shown_rows(len(table.omega), "frequencies", "response.csv", places=places)
    rows = [place * count + wave for place in shown for wave in range(count)]
    of = partial(_of, list(open_columns(group, table)))
    first = of(water.OMEGA, *((water.WAVES,) if count > 1 else ()))
    absorbed = (water.ABSORPTION, water.CAPTURE_WIDTH) if table.absorption.any() else ()
    # Of two waves the table is as wide as a terminal without it.
    drift = (water.DRIFT_FORCE,) if count == 1 else ()
    scattered = water.REFLECTION, water.TRANSMISSION, water.SCATTERING_WIDTH
    errors = water.ENERGY_RESIDUAL, water.RESPONSE_ERROR
    ratios = [*first, *of(water.WAVENUMBERS, *scattered, *absorbed, *drift, *errors)]
    what = "ratios of elevations" if table.partial_waves is None else "scattered waves"
    yield Section(
        title=f"Waves from the {table.waves_from}: {what}",
        headings=headings_of(ratios, "outgoing_wave" if count > 1 else ""),
        rows=rows_of(group, ratios, rows, of(water.DRIFT_ERROR, water.SCATTERING_WIDTH_ERROR)),
        lines=(
            *thinned,
            "The last column is the error of motions and waves over the incident or the largest one.",
        ),
    )
    motions, phases = of(water.AMPLITUDES)[:_MOST_MOTIONS], of(water.PHASE_AT_BODY)[:_MOST_MOTIONS]
    shown_parts = (first, motions, phases)
    left_out = len(table.dofs) - len(motions)
    yield Section(
        title=f"Motions in waves from the {table.waves_from}, per unit elevation",
        headings=headings_of([*first, *motions], "radiating_dof"),
        rows=[
            (*begin, *(f"{size} ∠ {angle}°" for size, angle in zip(sizes, angles, strict=True)))
            for begin, sizes, angles in zip(
                *(rows_of(group, part, rows, of(water.AMPLITUDE_ERROR)) for part in shown_parts), strict=True
            )
        ],
        lines=(
            "|a| ∠ θ is the motion |a| cos(ωt − θ); at t = 0 the crest of the wave is at the middle of the body.",
            *((f"{left_out} more motions: response.csv.",) if left_out else ()),
            *(_missed(peak) for peak in table.missed_peaks),
        ),
    )
    yield from _strains(table, rows)


def _of(found: Sequence[Column], *quantities: Quantity) -> list[Column]:
    """The columns of some quantities, in units of sections or of whole solids."""
    return [column for one in quantities for column in found if column.quantity.key == one.key]


def _strains(table: WavesAndMotions, shown: list[int]) -> Iterator[Section]:
    for plate in table.deflections:
        if plate.largest_strain is not None:
            columns = list(columns_of(STRAIN, plate, ("omega", "wave"), {"wave": table.waves}))
            yield Section(
                title=f"Largest strain and stress at the faces of body {plate.number}, per unit elevation",
                headings=headings_of(columns, ""),
                rows=rows_of(STRAIN, columns, shown),
            )


def _missed(peak: UnresolvedPeak) -> str:
    return (
        f"NOT SHOWN: between {peak.below:.6g} and {peak.above:.6g} rad/s {Dof(peak.quantity).words} changes by more "
        f"than the curve shows: {peak.value:.3g} at {peak.omega:.6g} rad/s, where the line between these has "
        f"{peak.drawn:.3g}. Ask for more frequencies there."
    )


def _resonance(table: ResonanceTable) -> Section:
    rows: list[Row] = []
    for place, (omega, label, error, residual) in enumerate(
        zip(table.omega, table.labels, table.relative_error, table.residuals, strict=True), 1
    ):
        rows.append(
            (
                str(place),
                label.words,
                with_certain_digits(omega.real, float(error)) if omega.real else "0",
                with_certain_digits(omega.imag, float(error) * abs(omega) / abs(omega.imag)) if omega.imag else "0",
                f"{2.0 * pi / omega.real:.6g}" if omega.real else "–",
                f"{-omega.imag / abs(omega):.4g}",
                f"{error:.1e}",
                f"{residual:.1e}",
            )
        )
    return Section(
        title="Resonances e^(−iωt)",
        headings=("", "motion", "Re ω, rad/s", "Im ω, 1/s", "period, s", "−Im ω/|ω|", "relative error", "residual"),
        rows=rows,
        lines=(_counted(table), *_not_sought(table)),
    )


def _counted(table: ResonanceTable) -> str:
    if table.counted is None:
        return f"Searched in {region_words(table.region)}; not counted independently."
    verdict = "as many as were found" if table.counted == len(table.omega) else f"{len(table.omega)} are listed"
    return f"An independent count of {region_words(table.region)} gives {table.counted}: {verdict}."


def _not_sought(table: ResonanceTable) -> Iterator[str]:
    if table.not_sought is not None:
        yield (
            f"Elastic tones from about {table.not_sought:.3g} rad/s on were not sought: waves are far shorter there "
            "than the body. below has them sought, at the cost of a mesh for these waves."
        )


def _decay(table: DecayTable) -> Section:
    shown, thinned = shown_rows(len(table.times), "times", "decay.csv")
    of = partial(_of, list(open_columns(water.DECAY, table)))
    (time,), (error,) = of(water.DECAY_TIMES), of(water.DECAY_ERROR)
    # Released motions are first.
    motions = sorted(of(water.DISPLACEMENT), key=lambda column: table.initial[column.places["dof"]] == 0.0)
    motions = motions[:_MOST_MOTIONS]
    left_out = len(table.dofs) - len(motions)
    units = {"rad" if table.dofs[column.places["dof"]].is_rotation else "m" for column in motions}
    rows = [
        (
            f"{time.values[row]:.6g}",
            *(beyond_error(float(column.values[row]), float(error.values[row])) for column in motions),
            f"{error.values[row]:.1e}",
        )
        for row in shown
    ]
    power = "⁴" if table.tail_power == 4 else "²"
    tail = f"The released motion decays asymptotically like {table.tail or 0.0:.6g}/t{power}, t in seconds."
    return Section(
        title="Motion after release",
        headings=(*headings_of([time, *motions], "dof"), f"error, {' or '.join(sorted(units))}"),
        rows=rows,
        lines=(
            *thinned,
            *((f"{left_out} more motions: decay.csv.",) if left_out else ()),
            *((tail,) if table.tail is not None else ()),
            f"The estimated errors hold up to the last time, t = {table.certified_until:.6g} s.",
        ),
    )


def _spectrum(table: SpectrumTable, whole: bool) -> Iterator[Section]:
    """Statistics of the responses to irregular waves, and of loads along beams, of whole solids or of sections."""
    per = "" if whole else "/m"
    power = f", mean power that damping takes: {table.mean_absorbed_power:.5g} W{per}"
    about = (
        f"Mean drift force along x: {beyond_error(table.mean_drift_force, table.mean_drift_error)} N{per}"
        f"{power if table.mean_absorbed_power else ''}.",
        f"{table.waves}; {table.duration:g} s from the {table.waves_from}. Amplitudes are half of heights.",
        f"{len(table.omega)} frequencies from {table.omega[0]:.4g} to {table.omega[-1]:.4g} rad/s, chosen so that no "
        "peak lies between them: spectrum.csv.",
    )
    for group, title, lines in (
        (RESPONSES, "Responses to irregular waves", about),
        (
            AIR_GAPS,
            "Air gaps: elevation of the water less the motion of the point, and the smallest height above it",
            (f"Most probable largest and smallest values in {table.duration:g} s, linear in the waves.",),
        ),
        (
            LOADS,
            "Moment M, shear force Q and deflection w of beams in irregular waves, per metre of width",
            # Without points beams have no other table.
            () if table.responses else about,
        ),
    ):
        found = [Reading(group, group.evaluated(one)) for one in group.records(table)]
        parts = [part for part in group.quantities if part.printed and any(one[part] is not None for one in found)]
        if found:
            yield Section(
                title=title,
                headings=tuple(part.heading for part in parts),
                rows=[tuple(map(one.cell, parts)) for one in found],
                lines=lines,
            )
