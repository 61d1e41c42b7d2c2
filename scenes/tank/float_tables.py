"""Rigid floats in the printed tables."""

from __future__ import annotations

from typing import Any

from hydroelastic.output.digits import number, per_cent, with_certain_digits

Summary = dict[str, Any]

_UNITS = {"heave": "kg/m", "sway": "kg/m", "roll": "kg·m"}


def float_lines(summary: Summary) -> list[str]:
    """Yield hydrostatics and modes of each float, and growing motions."""
    lines = [line for row in summary["floats"] for line in _lines(row)]
    for growing in summary["growing"]:
        rate = with_certain_digits(growing["growth_rate"], growing["relative_error"])
        lines.append(
            f"UNSTABLE: a motion ({growing['kind']}) grows like e^(σt), σ = {rate} 1/s "
            f"(estimated relative error {growing['relative_error']:.1e}). It is not among the modes listed."
        )
    return lines


def _lines(row: dict[str, Any]) -> list[str]:
    left, right = row["waterplane"]
    thin = row["boundary"] == "thin"
    width = "thin, its flux on the middle line" if thin else f"waterplane {left:.6g} to {right:.6g} m"
    lines = [
        f"Float {row['body']}: mass {row['mass']:.7g} kg/m, {width}, heave stiffness {row['heave_stiffness']:.7g} N/m²."
    ]
    lines += [_mode_line(mode) for mode in row["modes"]]
    if row["high_frequency"] is not None:
        matrix, error = row["high_frequency"]["added_mass"], row["high_frequency"]["relative_error"]
        own = ", ".join(
            f"{motion} {with_certain_digits(matrix[place][place], max(error, 1e-9))} {_UNITS[motion]}"
            for place, motion in enumerate(row["motions"])
        )
        lines.append(f"  Added mass at infinite frequency: {own}.")
    return lines


def _mode_line(mode: dict[str, Any]) -> str:
    if mode["omega"] is None:
        return f"  Mode of {mode['motion']}: none; {mode['note']}."
    omega = with_certain_digits(mode["omega"], mode["relative_error"])
    added = with_certain_digits(mode["added_mass"], max(mode["added_mass_relative_error"], 1e-9))
    text = (
        f"  Mode of {mode['motion']}: mode {mode['index']}, ω = {omega} rad/s (estimated relative error "
        f"{mode['relative_error']:.1e}), modal mass {mode['modal_mass']:.6g}"
    )
    if mode["runner_up_modal_mass"] is not None:
        text += f" (runner-up {mode['runner_up_modal_mass']:.6g})"
    text += f" {_UNITS[mode['motion']]}, added mass {added} {_UNITS[mode['motion']]}."
    return text + (f" Note: {mode['note']}." if mode["note"] else "")


FLOAT_ESTIMATE_HEADINGS = ("estimate of heave", "ω, rad/s", "to field", "added mass, kg/m", "to field")

PRINTED_HEADINGS = ("constant of the paper", "as printed", "corrected", "printed/corrected")


def float_estimate_rows(row: dict[str, Any]) -> list[tuple[str, ...]]:
    """One row for each estimate of a float's heave."""
    return [
        (
            name,
            number(estimate["omega"]),
            per_cent(estimate["difference"]),
            number(estimate["added_mass"]),
            per_cent(estimate["added_mass_difference"]),
        )
        for name, estimate in row["estimates"].items()
    ]


def printed_rows(row: dict[str, Any]) -> list[tuple[str, ...]]:
    """One row for each constant that the paper prints."""
    return [
        (name, number(value["printed"]), number(value["corrected"]), f"{value['printed'] / value['corrected']:.6g}")
        for name, value in row["printed_constants"].items()
    ]
