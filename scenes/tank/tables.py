"""Tables of a closed tank, printed and written as Markdown and CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator

from hydroelastic.output.digits import counted, number, per_cent, with_certain_digits
from hydroelastic.output.provenance import Summary
from hydroelastic.output.sections import Section
from hydroelastic.scenes.tank.float_tables import (
    FLOAT_ESTIMATE_HEADINGS,
    PRINTED_HEADINGS,
    float_estimate_rows,
    float_lines,
    printed_rows,
)

MODE_COLUMNS = (
    "mode",
    "omega",
    "frequency_hz",
    "relative_error",
    "kind",
    "symmetry",
    "elastic_energy_fraction",
    "residual",
)


def mode_rows(summary: Summary) -> list[tuple[str, ...]]:
    """One row for each mode, numbers at their certain digits."""
    tones = {tone["index"] for tone in summary["first_elastic_by_body"] if tone["one_mode"]}
    return [
        (
            str(number),
            with_certain_digits(mode["omega"], mode["relative_error"]),
            f"{mode['frequency_hz']:.6g}",
            f"{mode['relative_error']:.1e}",
            mode["kind"] + (", first elastic tone" if number in tones else ""),
            mode["symmetry"] or "–",
            f"{mode['elastic_energy_fraction']:.3f}",
        )
        for number, mode in enumerate(summary["modes"], 1)
    ]


MODE_HEADINGS = ("mode", "ω, rad/s", "f, Hz", "relative error", "kind", "symmetry", "bending energy")


def tone_lines(summary: Summary) -> list[str]:
    """Text on the first elastic tone of each beam."""
    lines = []
    several = len(summary["first_elastic_by_body"]) > 1
    for tone in summary["first_elastic_by_body"]:
        name = f"First elastic tone of beam {tone['body']}" if several else "First elastic tone"
        if tone["omega"] is None:
            lines.append(f"{name}: none; {tone['note']}.")
        else:
            omega = with_certain_digits(tone["omega"], tone["relative_error"])
            mass = with_certain_digits(tone["added_mass_per_length"], max(tone["added_mass_relative_error"], 1e-9))
            lines.append(
                f"{name}: {_which_mode(tone)}, ω = {omega} rad/s "
                f"(estimated relative error {tone['relative_error']:.1e}), added mass {mass} kg/m², "
                f"participation {tone['participation']:.3f} (runner-up {tone['runner_up']:.3f})."
            )
            if tone["note"]:
                lines.append(f"  Note: {tone['note']}.")
        limits = f"In vacuo: {tone['dry_omega']:.8g} rad/s"
        if tone["pressure_release_omega"] is not None:
            release = with_certain_digits(tone["pressure_release_omega"], tone["pressure_release_relative_error"])
            one = len(summary["scene"]["liquid"]) == 1
            limit = "ψ = 0 on the water, the limit of infinite frequency" if one else "the limit of infinite frequency"
            limits += f"; pressure-release tone ({limit}): {release} rad/s"
        lines.append(f"  {limits}.")
    return lines


def _which_mode(tone: Summary) -> str:
    if tone["one_mode"]:
        return f"mode {tone['index']}"
    first, last = tone["first_sharing_mode"], tone["last_sharing_mode"]
    return f"no single mode; modes from {first} to {last} share it, most of it in mode {tone['index']}"


ESTIMATE_HEADINGS = ("estimate", "ω, rad/s", "to field", "added mass, kg/m²", "to field", "bound")


def estimate_rows(summary: Summary) -> list[tuple[str, ...]]:
    """One row for each estimate."""
    rows: list[tuple[str, ...]] = []
    for name, estimate in summary["estimates"].items():
        rows.append(
            (
                name,
                number(estimate["omega"]),
                per_cent(estimate["difference"]),
                number(estimate["added_mass_per_length"]),
                per_cent(estimate["added_mass_difference"]),
                _bound(estimate),
            )
        )
    return rows


def _bound(estimate: Summary) -> str:
    if estimate["bound"] == "none":
        return "none"
    what = f"≥ mode {estimate['bound_mode']}"
    if estimate["bound"] == "above_pressure_release_tone":
        what += ", ψ = 0"
    return what + {True: ": holds", False: ": VIOLATED", None: ": not checked"}[estimate["bound_holds"]]


def mode_lines(summary: Summary) -> list[str]:
    """Difference of the modes from a known exact solution, where there is one, and modes that are not listed."""
    lines = []
    if summary["exact"]:
        largest = max(abs(row["difference"]) for row in summary["exact"])
        formula = summary["exact"][0]["formula"]
        lines.append(f"{formula}: the largest relative difference to this exact solution is {largest:.1e}.")
    if summary["status"] == "ok" and len(summary["modes"]) < summary["scene"]["accuracy"]["modes"]:
        lines.append("There are no more modes than these.")
    if summary["zero_modes"]:
        motions = counted(summary["zero_modes"], "rigid motion")
        lines.append(f"{motions} without stiffness (ω = 0), not listed.")
    return lines


def tank_sections(summary: Summary, expected: Iterable[str] = ()) -> Iterator[Section]:
    """Yield the tables of the modes, the floats and the estimates.

    Args:
        summary: content of ``summary.json``.
        expected: what to know of the model beside its answer.
    """
    yield Section(
        title="Natural modes",
        headings=MODE_HEADINGS,
        rows=mode_rows(summary),
        lines=(*mode_lines(summary), *tone_lines(summary), *float_lines(summary), *expected),
    )
    yield from _estimates(summary)


def compared_sections(summary: Summary) -> Iterator[Section]:
    """Yield the tables of the estimates with the field solution."""
    yield from _estimates(summary)
    yield Section(title="Field solution", lines=(*mode_lines(summary), *tone_lines(summary), *float_lines(summary)))


def _estimates(summary: Summary) -> Iterator[Section]:
    if summary["estimates"]:
        yield Section(
            title="Estimates of the first elastic tone beside the field solution",
            headings=ESTIMATE_HEADINGS,
            rows=estimate_rows(summary),
            notes=_notes(summary["estimates"]),
            compares=True,
        )
    elif summary["first_elastic_by_body"]:
        yield Section(
            title="Estimates of the first elastic tone",
            lines=("None: the older theories know one beam with free ends beside free water.",),
            compares=True,
        )
    for row in summary["floats"]:
        yield from _float_estimates(row)


def _float_estimates(row: Summary) -> Iterator[Section]:
    if row["estimates"]:
        yield Section(
            title=f"Estimates of the heave of float {row['body']} beside the field solution",
            headings=FLOAT_ESTIMATE_HEADINGS,
            rows=float_estimate_rows(row),
            notes=_notes(row["estimates"]),
            compares=True,
        )
    if row["printed_constants"]:
        yield Section(
            title=f"Constants of the paper for float {row['body']}",
            headings=PRINTED_HEADINGS,
            rows=printed_rows(row),
            compares=True,
        )


def _notes(estimates: Summary) -> tuple[str, ...]:
    """Return what each estimate neglects."""
    return tuple(f"{name}: {estimate['note']}" for name, estimate in estimates.items())


def tank_cost(summary: Summary) -> str:
    """Size and cost of the solution."""
    size, timing = summary["size"], summary["timing"]
    seconds = ", ".join(f"{stage} {value:.2f}" for stage, value in timing.items() if value >= 0.005)
    where = " in half the tank, symmetric and antisymmetric" if size["halves"] else ""
    return (
        f"{size['cells']} cells, degree {size['degree']}, {size['dofs']} unknowns "
        f"({size['surface_unknowns']} on the surface){where}; seconds: {seconds}; "
        f"peak memory {summary['memory_peak'] / 2**20:.0f} MiB."
    )


def mode_csv(summary: Summary) -> str:
    """All modes at full precision, as CSV."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(MODE_COLUMNS)
    for place, mode in enumerate(summary["modes"], 1):
        writer.writerow([place, *(mode[column] for column in MODE_COLUMNS[1:])])
    return text.getvalue()
