"""The tables of a tank in three dimensions."""

from __future__ import annotations

from collections.abc import Iterator

from hydroelastic.fem.level_bed.solution import BY_INERTIA
from hydroelastic.output.digits import counted
from hydroelastic.output.level_tank import quantities as tank
from hydroelastic.output.provenance import PROCESSES, spent
from hydroelastic.output.quantity_tables import headings, labelled_columns, listed, without_zeros
from hydroelastic.output.reading import Reading
from hydroelastic.output.sections import Section


def level_tank_sections(summary: Reading) -> Iterator[Section]:
    """Yield the tables of modes, of first elastic tones, of estimates and of closed forms."""
    yield _modes(summary)
    for tone in summary[tank.TONES]:
        note = tone[tank.TONE_NOTE]
        yield Section(
            title=f"First elastic tone of plate {tone[tank.TONE_BODY]}",
            headings=("quantity", "value"),
            rows=[row for row in listed(tone) if row[1] != "–"],
            lines=(f"{note[:1].upper()}{note[1:]}.",) if note else (),
        )
    yield from compared_level_tank(summary)


def compared_level_tank(summary: Reading) -> Iterator[Section]:
    """Yield the tables that compare the solution with estimates and closed forms."""
    estimates, exact = summary[tank.ESTIMATES], summary[tank.EXACT]
    if estimates:
        yield Section(
            title="Estimates of motions of the plates",
            headings=("estimate", *headings(tank.ESTIMATES)),
            rows=labelled_columns(estimates),
            notes=tuple(f"{name}: {one[tank.ESTIMATE_NOTE]}." for name, one in estimates.items()),
            compares=True,
        )
    if exact:
        yield Section(
            title=f"Closed form {exact[0][tank.FORMULA]}",
            headings=("mode", *headings(tank.EXACT)),
            rows=labelled_columns(exact),
            compares=True,
        )


def _modes(summary: Reading) -> Section:
    zero, modes, solver = summary[tank.ZERO_MODES], summary[tank.MODES], summary[tank.SOLVER]
    model, method = solver[tank.MODEL], solver[tank.COUNT_METHOD]
    lines = [f"{model[:1].upper()}{model[1:]}."]
    if method != BY_INERTIA:
        lines.append(f"Their number is confirmed by {method}.")
    if any(mode[tank.MULTIPLICITY] == 2 for mode in modes):
        lines.append("Modes of multiplicity 2 are pairs, cos nθ and sin nθ, of one frequency.")
    if zero:
        lines.append(f"{counted(zero, 'motion')} of bodies without stiffness {'are' if zero > 1 else 'is'} not listed.")
    told, rows = without_zeros(tank.BENDING, modes, tank.MODES)
    return Section(
        title="Natural modes",
        headings=("mode", *headings(told)),
        rows=labelled_columns(rows),
        lines=tuple(lines),
    )


def level_tank_cost(summary: Reading) -> str:
    """Return size and cost of the solution."""
    size = summary[tank.SIZE]
    mebibytes, processes = size[tank.MEMORY_OF_A_PROCESS] / 2**20, size[PROCESSES]
    largest = f", at most {mebibytes:.0f} of one of {processes} processes" if processes > 1 else ""
    problems = counted(size[tank.PROBLEMS], "problem")
    return f"{problems}, degree {size[tank.DEGREE]}, {size[tank.DOFS]} unknowns{spent(summary, largest)}"
