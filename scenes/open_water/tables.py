"""Tables of a scene with open ends, printed and written as Markdown."""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterator
from itertools import product
from math import ceil, degrees, inf, isfinite, pi

import numpy as np

from hydroelastic.fem.open_water.results import (
    DecayTable,
    RadiationTable,
    ResonanceTable,
    ResponseTable,
    UnresolvedPeak,
)
from hydroelastic.output.digits import beyond_error, number, per_cent, with_certain_digits
from hydroelastic.output.provenance import Summary
from hydroelastic.output.sections import Row, Section
from hydroelastic.physics.dofs import Dof
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.open_water.estimates import infinite_draught_comparison, infinite_draught_message
from hydroelastic.scenes.open_water.results import OpenSolution, region_words
from hydroelastic.scenes.tank.check_hints import draughts_left_out

MOST_ROWS = 25
"""Largest number of rows of a table; longer ones are shown at equal distances."""

_MOST_MOTIONS = 4


def open_sections(solution: OpenSolution, summary: Summary) -> Iterator[Section]:
    """Yield the tables by analysis, and the comparison with the thin-float theory.

    Args:
        solution: the solution.
        summary: content of ``summary.json``.
    """
    for radiation in solution.radiation:
        yield from _radiation(radiation)
    for response in solution.response:
        yield from _response(response)
    for resonance in solution.resonance:
        yield _resonance(resonance)
    for decay in solution.decay:
        yield _decay(decay)
    left_out = tuple(draughts_left_out(solution.scene))
    if left_out:
        yield Section(title="Left out of the model", lines=left_out)
    yield from _estimates(solution.scene, summary)


def _estimates(scene: TankScene, summary: Summary) -> Iterator[Section]:
    """Comparison of the thin-float theory with the field solution."""
    estimate = summary["estimates"]["thin_float"]
    if estimate["rows"]:
        yield Section(
            title="The thin-float theory beside the field solution",
            headings=("quantity", "theory", "field", "difference"),
            rows=[
                (row["quantity"], number(row["theory"]), number(row["field"]), per_cent(row["difference"]))
                for row in estimate["rows"]
            ],
            lines=(
                f"{estimate['note']} Of curves the largest difference is shown, in parts of the largest value, or of "
                "the displacement at first.",
            ),
            compares=True,
        )
    infinite = infinite_draught_comparison(scene)
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


def open_cost(summary: Summary) -> str:
    """Size and cost of the solution."""
    size = summary["size"]
    seconds = ", ".join(f"{stage} {value:.2f}" for stage, value in summary["timing"].items() if value >= 0.005)
    return (
        f"{size['cells']} cells, degree {size['degree']}, {size['dofs']} unknowns; seconds: {seconds}; "
        f"peak memory {summary['memory_peak'] / 2**20:.0f} MiB."
    )


def _radiation(table: RadiationTable) -> Iterator[Section]:
    """One table for each motion: the diagonals of a and b, and the excitation by waves from the left."""
    several = len(table.waves) > 1
    shown, thinned = _shown(len(table.omega), "frequencies", "radiation.csv")
    worst = f"Largest residuals: energy {_largest(table.energy_residual)}, Haskind {_largest(table.haskind_residual)}."
    further = (
        "Coupling of motions, phases and waves from the right: radiation.csv and dataset.nc.",
        f"{worst} {table.factorizations} factorizations.",
    )
    for place, motion in enumerate(table.dofs):
        mass, force = ("kg·m", "N/m") if motion.is_rotation else ("kg/m", "N/m²")
        rows = []
        for row in shown:
            error = float(table.relative_error[row])
            rows.append(
                (
                    f"{table.omega[row]:.6g}",
                    *(() if several else (_number(table.wavenumbers[row, 0]),)),
                    _certain(table.added_mass[row, place, place], error),
                    _certain(table.radiation_damping[row, place, place], error),
                    *(_certain(abs(force), error) for force in table.excitation_force[row, :, 0, place]),
                    _error(error),
                )
            )
        waves = [f" {wave}" if several else "" for wave in table.waves]
        last = place == len(table.dofs) - 1
        yield Section(
            title=f"Radiation by {motion.words}",
            headings=(
                "ω, rad/s",
                *(() if several else ("k, 1/m",)),
                f"a, {mass}",
                f"b, {mass}/s",
                *(f"|f|{wave}, {force}" for wave in waves),
                "relative error",
            ),
            rows=rows,
            lines=(*thinned, *(further if last else ())),
        )


def _response(table: ResponseTable) -> Iterator[Section]:
    """Outgoing waves and motions of the bodies for each incident wave."""
    several = len(table.waves) > 1
    places = max(MOST_ROWS // len(table.waves), 2)
    shown, thinned = _shown(len(table.omega), "frequencies", "response.csv", places=places)
    motions = table.dofs[:_MOST_MOTIONS]
    ratios, amplitudes = [], []
    for row, (incident, wave) in product(shown, enumerate(table.waves)):
        error = float(table.relative_error[row])
        begin = (f"{table.omega[row]:.6g}", *((wave,) if several else ()))
        ratios.append(
            (
                *begin,
                _number(table.wavenumbers[row, incident]),
                *(_certain(abs(ratio), error) for ratio in table.reflection[row, incident]),
                *(_certain(abs(ratio), error) for ratio in table.transmission[row, incident]),
                _error(float(table.energy_residual[row, incident])),
                _error(error),
            )
        )
        amplitudes.append(
            (
                *begin,
                *(
                    f"{_certain(abs(value), error)} ∠ {_phase(value)}"
                    for value in table.amplitudes[row, incident, : len(motions)]
                ),
            )
        )
    outgoing = [f" {wave}" if several else "" for wave in table.waves]
    headings = ("ω, rad/s", *(("wave",) if several else ()))
    left_out = len(table.dofs) - len(motions)
    yield Section(
        title=f"Waves from the {table.waves_from}: ratios of elevations",
        headings=(
            *headings,
            "k, 1/m",
            *(f"|R|{wave}" for wave in outgoing),
            *(f"|T|{wave}" for wave in outgoing),
            "energy",
            "error/largest",
        ),
        rows=ratios,
        lines=thinned,
    )
    yield Section(
        title=f"Motions in waves from the {table.waves_from}, per unit elevation",
        headings=(
            *headings,
            *(f"{motion.words}, {'rad/m' if motion.is_rotation else 'm/m'}" for motion in motions),
        ),
        rows=amplitudes,
        lines=(
            "|a| ∠ θ is the motion |a| e^{i(θ − ωt)}; the crest of the wave is at x = 0 of the scene at t = 0.",
            *((f"{left_out} more motions: response.csv.",) if left_out else ()),
            *(_missed(peak) for peak in table.missed_peaks),
        ),
    )


def _missed(peak: UnresolvedPeak) -> str:
    """Message on a peak that the curve does not show."""
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
                _certain(omega.real, float(error)),
                _certain(omega.imag, float(error) * abs(omega) / abs(omega.imag) if omega.imag else 1.0),
                f"{2.0 * pi / omega.real:.6g}" if omega.real else "–",
                f"{-omega.imag / abs(omega):.4g}",
                _error(float(error)),
                _error(float(residual)),
            )
        )
    return Section(
        title="Resonances e^(−iωt)",
        headings=("", "motion", "Re ω, rad/s", "Im ω, 1/s", "period, s", "−Im ω/|ω|", "relative error", "residual"),
        rows=rows,
        lines=(_counted(table),),
    )


def _counted(table: ResonanceTable) -> str:
    if table.counted is None:
        return f"Searched in {region_words(table.region)}; not counted independently."
    verdict = "as many as were found" if table.counted == len(table.omega) else f"{len(table.omega)} are listed"
    return f"An independent count of {region_words(table.region)} gives {table.counted}: {verdict}."


def _decay(table: DecayTable) -> Section:
    shown, thinned = _shown(len(table.times), "times", "decay.csv")
    # Released motions are first.
    columns = sorted(range(len(table.dofs)), key=lambda place: table.initial[place] == 0.0)[:_MOST_MOTIONS]
    dofs = [table.dofs[place] for place in columns]
    left_out = len(table.dofs) - len(dofs)
    rows = [
        (
            f"{table.times[row]:.6g}",
            *(
                beyond_error(float(value), float(table.absolute_error[row]))
                for value in table.displacement[row, columns]
            ),
            f"{table.absolute_error[row]:.1e}",
        )
        for row in shown
    ]
    units = ["rad" if motion.is_rotation else "m" for motion in dofs]
    tail = (
        ()
        if table.tail is None
        else (f"The released motion decays asymptotically like {table.tail:.6g}/t², t in seconds.",)
    )
    return Section(
        title="Motion after release",
        headings=(
            "t, s",
            *(f"{motion.words}, {unit}" for motion, unit in zip(dofs, units, strict=True)),
            f"error, {' or '.join(sorted(set(units)))}",
        ),
        rows=rows,
        lines=(
            *thinned,
            *((f"{left_out} more motions: decay.csv.",) if left_out else ()),
            *tail,
            f"The estimated errors hold up to the last time, t = {table.certified_until:.6g} s.",
        ),
    )


def _shown(count: int, what: str, file: str, places: int = MOST_ROWS) -> tuple[list[int], tuple[str, ...]]:
    """Return the rows that are shown, at equal distances with the first and the last one, and a note on the others."""
    if count <= places:
        return list(range(count)), ()
    least = ceil((count - 1) / (places - 1))
    # With a few rows less all distances may be equal.
    stride = next((step for step in range(least, ceil(1.5 * least)) if (count - 1) % step == 0), least)
    rows = sorted({*range(0, count, stride), count - 1})
    return rows, (f"{len(rows)} of {count} {what}; all of them are in {file}.",)


def _certain(value: float, error: float) -> str:
    """A number at its certain digits; small ones beside others keep four."""
    if not isfinite(value):
        return "–" if value != inf else "inf"
    if value == 0.0:
        return "0"
    return with_certain_digits(float(value), error) if isfinite(error) and error < 1.0 else f"{value:.4g}"


def _phase(value: complex) -> str:
    """The phase in degrees; none of zero."""
    return f"{degrees(phase(value)) + 0.0:.1f}°" if value and isfinite(abs(value)) else "–"


def _number(value: float) -> str:
    return f"{value:.6g}" if isfinite(value) else "inf" if value == inf else "–"


def _error(value: float) -> str:
    return f"{value:.1e}" if isfinite(value) else "–"


def _largest(values: np.ndarray) -> str:
    known = np.abs(values[np.isfinite(values)])
    return f"{known.max():.1e}" if known.size else "–"
