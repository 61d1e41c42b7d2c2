"""The tables of a tank in three dimensions."""

from __future__ import annotations

from collections.abc import Iterator

from hydroelastic.fem.level_bed.solution import BY_INERTIA
from hydroelastic.output.level_tank.quantities import ESTIMATES, EXACT, FIRST_ELASTIC, MODES
from hydroelastic.output.provenance import Summary, spent
from hydroelastic.output.quantity_tables import headings, labelled_columns, listed, without_zeros
from hydroelastic.output.sections import Section


def level_tank_sections(summary: Summary) -> Iterator[Section]:
    """Yield the tables of modes, of first elastic tones, of estimates and of closed forms."""
    yield _modes(summary)
    for tone in summary["first_elastic_by_body"]:
        rows = [row for row in listed(FIRST_ELASTIC, tone) if row[1] != "–"]
        lines = (f"{tone['note'][:1].upper()}{tone['note'][1:]}.",) if tone["note"] else ()
        yield Section(
            title=f"First elastic tone of plate {tone['body']}", headings=("quantity", "value"), rows=rows, lines=lines
        )
    yield from compared_level_tank(summary)


def compared_level_tank(summary: Summary) -> Iterator[Section]:
    """Yield the tables that compare the solution with estimates and closed forms."""
    if summary["estimates"]:
        yield Section(
            title="Estimates of motions of the plates",
            headings=("estimate", *headings(ESTIMATES)),
            rows=labelled_columns(ESTIMATES, summary["estimates"]),
            notes=tuple(f"{name}: {one['note']}." for name, one in summary["estimates"].items()),
            compares=True,
        )
    if summary["exact"]:
        yield Section(
            title=f"Closed form {summary['exact'][0]['formula']}",
            headings=("mode", *headings(EXACT)),
            rows=labelled_columns(EXACT, summary["exact"]),
            compares=True,
        )


def _modes(summary: Summary) -> Section:
    zero = summary["zero_modes"]
    lines = [summary["solver"]["model"][:1].upper() + summary["solver"]["model"][1:] + "."]
    if summary["solver"]["count_method"] != BY_INERTIA:
        lines.append(f"Their number is confirmed by {summary['solver']['count_method']}.")
    if any(mode["multiplicity"] == 2 for mode in summary["modes"]):
        lines.append("Modes of multiplicity 2 are pairs, cos nθ and sin nθ, of one frequency.")
    if zero:
        lines.append(
            f"{zero} motion{'s' * (zero > 1)} of bodies without stiffness {'are' if zero > 1 else 'is'} not listed."
        )
    told = without_zeros(MODES, "elastic_energy_fraction", summary["modes"])
    return Section(
        title="Natural modes",
        headings=("mode", *headings(told)),
        rows=labelled_columns(told, summary["modes"]),
        lines=tuple(lines),
    )


def level_tank_cost(summary: Summary) -> str:
    """Return size and cost of the solution."""
    size = summary["size"]
    mebibytes = size["memory_of_a_process"] / 2**20
    largest = f", at most {mebibytes:.0f} of one of {size['processes']} processes" if size["processes"] > 1 else ""
    problems = f"{size['problems']} problem{'s' * (size['problems'] != 1)}"
    return f"{problems}, degree {size['degree']}, {size['dofs']} unknowns{spent(summary, largest)}"
