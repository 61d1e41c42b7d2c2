"""The tables that a person reads: printed, and kept as Markdown and CSV."""

from __future__ import annotations

import csv
import io

from rich.console import Console

from hydroelastic.scenes.digits import number, per_cent, with_certain_digits
from hydroelastic.scenes.float_tables import (
    FLOAT_ESTIMATE_HEADINGS,
    PRINTED_HEADINGS,
    float_estimate_rows,
    float_lines,
    printed_rows,
)
from hydroelastic.scenes.provenance import Summary
from hydroelastic.scenes.sections import markdown_table, rich_table, status_lines, title_of

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
    tones = {tone["index"] for tone in summary["first_elastic_by_body"]}
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


MODE_HEADINGS = ("mode", "ω, rad/s", "f, Hz", "estimated error", "kind", "symmetry", "bending energy")


def tone_lines(summary: Summary) -> list[str]:
    """What is said of each beam's first elastic tone."""
    lines = []
    several = len(summary["first_elastic_by_body"]) > 1
    for tone in summary["first_elastic_by_body"]:
        name = f"First elastic tone of body {tone['body']}" if several else "First elastic tone"
        if tone["omega"] is None:
            lines.append(f"{name}: none; {tone['note']}.")
        else:
            omega = with_certain_digits(tone["omega"], tone["relative_error"])
            mass = with_certain_digits(tone["added_mass_per_length"], max(tone["added_mass_relative_error"], 1e-9))
            lines.append(
                f"{name}: mode {tone['index']}, ω = {omega} rad/s "
                f"(estimated relative error {tone['relative_error']:.1e}), added mass {mass} kg/m², "
                f"participation {tone['participation']:.3f} (runner-up {tone['runner_up']:.3f})."
            )
            if tone["note"]:
                lines.append(f"  Note: {tone['note']}.")
        limits = f"In vacuo: {tone['dry_omega']:.8g} rad/s"
        if tone["pressure_release_omega"] is not None:
            release = with_certain_digits(tone["pressure_release_omega"], tone["pressure_release_relative_error"])
            one = len(summary["scene"]["liquid"]) == 1
            limit = (
                "with ψ = 0 on the water, the limit far above the waves" if one else "in the limit far above the waves"
            )
            limits += f"; {limit}: {release} rad/s"
        lines.append(f"  {limits}.")
    return lines


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
    """How far the modes lie from a known exact solution, where there is one, and what is not listed."""
    lines = []
    if summary["exact"]:
        largest = max(abs(row["difference"]) for row in summary["exact"])
        formula = summary["exact"][0]["formula"]
        lines.append(f"{formula}: the largest relative difference to this exact solution is {largest:.1e}.")
    if summary["status"] == "ok" and len(summary["modes"]) < summary["scene"]["accuracy"]["modes"]:
        lines.append("There are no more modes than these.")
    if summary["zero_modes"]:
        lines.append(f"{summary['zero_modes']} rigid motion(s) without stiffness (ω = 0) not listed.")
    return lines


def cost_line(summary: Summary) -> str:
    """Size and cost of the solution."""
    size, timing = summary["size"], summary["timing"]
    seconds = ", ".join(f"{stage} {value:.2f}" for stage, value in timing.items() if value >= 0.005)
    where = " in half the tank, symmetric and antisymmetric" if size["halves"] else ""
    return (
        f"{size['cells']} cells, degree {size['degree']}, {size['dofs']} unknowns "
        f"({size['surface_unknowns']} on the surface){where}; seconds: {seconds}; "
        f"peak memory {summary['memory_peak'] / 2**20:.0f} MiB."
    )


def printed(summary: Summary, *, notes: bool = False, width: int = 120) -> str:
    """All tables as text for a terminal.

    Args:
        summary: content of ``summary.json``.
        notes: whether to say what each estimate neglects.
        width: of the text, in characters.
    """
    console = Console(file=io.StringIO(), width=width, color_system=None, highlight=False)
    console.print(title_of(summary), markup=False)
    for line in status_lines(summary):
        console.print(line, markup=False, style="bold")
    console.print(rich_table(MODE_HEADINGS, mode_rows(summary)))
    for line in mode_lines(summary):
        console.print(line, markup=False)
    for line in (*tone_lines(summary), *float_lines(summary)):
        console.print(line, markup=False)
    for row in summary["floats"]:
        if row["estimates"]:
            console.print(rich_table(FLOAT_ESTIMATE_HEADINGS, float_estimate_rows(row)))
        if row["printed_constants"] and notes:
            console.print(rich_table(PRINTED_HEADINGS, printed_rows(row)))
        if notes:
            for name, estimate in row["estimates"].items():
                console.print(f"{name}: {estimate['note']}", markup=False)
    if notes and not summary["estimates"] and summary["first_elastic_by_body"]:
        console.print("No estimates of beams: the older theories know one with free ends beside free water.")
    if summary["estimates"]:
        console.print(rich_table(ESTIMATE_HEADINGS, estimate_rows(summary)))
        if notes:
            for name, estimate in summary["estimates"].items():
                console.print(f"{name}: {estimate['note']}", markup=False)
    console.print(cost_line(summary), markup=False)
    return console.file.getvalue().rstrip()  # type: ignore[attr-defined]


def markdown(summary: Summary) -> str:
    """All tables as Markdown."""
    parts = [f"# {title_of(summary)}", ""]
    complaint = [f"**{line}**" if number == 0 else line for number, line in enumerate(status_lines(summary))]
    parts += [*complaint, ""] if complaint else []
    parts += [markdown_table(MODE_HEADINGS, mode_rows(summary)), ""]
    parts += [line + "\n" for line in (*mode_lines(summary), *tone_lines(summary), *float_lines(summary))]
    if summary["estimates"]:
        parts += [markdown_table(ESTIMATE_HEADINGS, estimate_rows(summary)), ""]
        parts += [f"- `{name}`: {estimate['note']}" for name, estimate in summary["estimates"].items()]
        parts.append("")
    for row in summary["floats"]:
        if row["estimates"]:
            parts += [markdown_table(FLOAT_ESTIMATE_HEADINGS, float_estimate_rows(row)), ""]
        if row["printed_constants"]:
            parts += [markdown_table(PRINTED_HEADINGS, printed_rows(row)), ""]
        if row["estimates"]:
            parts += [f"- `{name}`: {estimate['note']}" for name, estimate in row["estimates"].items()]
            parts.append("")
    parts.append(cost_line(summary))
    return "\n".join(parts) + "\n"


def mode_csv(summary: Summary) -> str:
    """All modes at full precision, as CSV."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(MODE_COLUMNS)
    for place, mode in enumerate(summary["modes"], 1):
        writer.writerow([place, *(mode[column] for column in MODE_COLUMNS[1:])])
    return text.getvalue()
