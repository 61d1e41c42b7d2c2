"""The tables of a closed tank."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from hydroelastic.output.digits import counted, with_certain_digits
from hydroelastic.output.provenance import Summary, spent
from hydroelastic.output.quantity_tables import headings, labelled_columns, without_zeros
from hydroelastic.output.sections import Section
from hydroelastic.output.tank.quantities import (
    ESTIMATES,
    FIRST_ELASTIC_TONES,
    FLOAT_ESTIMATES,
    FLOAT_MODES,
    FLOATS,
    GROWING,
    MODES,
    PRINTED_CONSTANTS,
)

_FLOAT_UNITS = {"heave": "kg/m", "sway": "kg/m", "roll": "kg·m"}


def tank_sections(summary: Summary, expected: Iterable[str] = ()) -> Iterator[Section]:
    """Yield the tables of the modes, the floats and the estimates.

    Args:
        summary: content of ``summary.json``.
        expected: what to know of the model beside its answer.
    """
    tones = {tone["index"] for tone in summary["first_elastic_by_body"] if tone["one_mode"]}
    modes = [
        mode | {"kind": f"{mode['kind']}, first elastic tone"} if place in tones else mode
        for place, mode in enumerate(summary["modes"], 1)
    ]
    told = without_zeros(MODES, "elastic_energy_fraction", modes)
    yield Section(
        title="Natural modes",
        headings=("mode", *headings(told)),
        rows=labelled_columns(told, modes),
        lines=(*_lines(summary), *expected),
    )
    yield from _estimates(summary)


def compared_sections(summary: Summary) -> Iterator[Section]:
    """Yield the tables of the estimates with the field solution."""
    yield from _estimates(summary)
    yield Section(title="Field solution", lines=tuple(_lines(summary)))


def _lines(summary: Summary) -> Iterator[str]:
    yield from _mode_lines(summary)
    yield from tone_lines(summary)
    for values in summary["floats"]:
        yield from _float_lines(values)
    for motion in map(GROWING.cells, summary["growing"]):
        yield (
            f"UNSTABLE: a motion ({motion['kind']}) grows like e^(σt), σ = {motion['growth_rate']} 1/s "
            f"(estimated relative error {motion['relative_error']}). It is not among the modes listed."
        )


def _mode_lines(summary: Summary) -> Iterator[str]:
    """Difference of the modes from a known exact solution, where there is one, and modes that are not listed."""
    if summary["exact"]:
        largest = max(abs(row["difference"]) for row in summary["exact"])
        formula = summary["exact"][0]["formula"]
        yield f"{formula}: the largest relative difference to this exact solution is {largest:.1e}."
    if summary["status"] == "ok" and len(summary["modes"]) < summary["scene"]["accuracy"]["modes"]:
        yield "There are no more modes than these."
    if summary["zero_modes"]:
        yield f"{counted(summary['zero_modes'], 'rigid motion')} without stiffness (ω = 0), not listed."


def tone_lines(summary: Summary) -> Iterator[str]:
    """Yield text on the first elastic tone of each beam."""
    several = len(summary["first_elastic_by_body"]) > 1
    one_liquid = len(summary["scene"]["liquid"]) == 1
    for tone in summary["first_elastic_by_body"]:
        cells = FIRST_ELASTIC_TONES.cells(tone)
        name = f"First elastic tone of beam {tone['body']}" if several else "First elastic tone"
        if tone["omega"] is None:
            yield f"{name}: none; {tone['note']}."
        else:
            yield (
                f"{name}: {_which_mode(tone)}, ω = {cells['omega']} rad/s (estimated relative error "
                f"{cells['relative_error']}), added mass {cells['added_mass_per_length']} kg/m², "
                f"participation {cells['participation']} (runner-up {cells['runner_up']})."
            )
            if tone["note"]:
                yield f"  Note: {tone['note']}."
        limits = f"In vacuo: {cells['dry_omega']} rad/s"
        if tone["pressure_release_omega"] is not None:
            limit = (
                "ψ = 0 on the water, the limit of infinite frequency"
                if one_liquid
                else "the limit of infinite frequency"
            )
            limits += f"; pressure-release tone ({limit}): {cells['pressure_release_omega']} rad/s"
        yield f"  {limits}."


def _which_mode(tone: Summary) -> str:
    if tone["one_mode"]:
        return f"mode {tone['index']}"
    first, last = tone["first_sharing_mode"], tone["last_sharing_mode"]
    return f"no single mode; modes from {first} to {last} share it, most of it in mode {tone['index']}"


def _float_lines(values: dict[str, Any]) -> Iterator[str]:
    """Hydrostatics and modes of a float."""
    left, right = values["waterplane"]
    thin = values["boundary"] == "thin"
    width = "thin, its flux on the middle line" if thin else f"waterplane {left:.6g} to {right:.6g} m"
    cells = FLOATS.cells(values)
    yield f"Float {cells['body']}: mass {cells['mass']} kg/m, {width}, heave stiffness {cells['heave_stiffness']} N/m²."
    for mode in values["modes"]:
        yield _float_mode_line(mode)
    if values["high_frequency"] is not None:
        matrix, error = values["high_frequency"]["added_mass"], values["high_frequency"]["relative_error"]
        own = ", ".join(
            f"{motion} {with_certain_digits(matrix[place][place], max(error, 1e-9))} {_FLOAT_UNITS[motion]}"
            for place, motion in enumerate(values["motions"])
        )
        yield f"  Added mass at infinite frequency: {own}."


def _float_mode_line(mode: dict[str, Any]) -> str:
    if mode["omega"] is None:
        return f"  Mode of {mode['motion']}: none; {mode['note']}."
    cells, unit = FLOAT_MODES.cells(mode), _FLOAT_UNITS[mode["motion"]]
    second = "" if mode["runner_up_modal_mass"] is None else f" (runner-up {cells['runner_up_modal_mass']})"
    return (
        f"  Mode of {mode['motion']}: mode {mode['index']}, ω = {cells['omega']} rad/s (estimated relative error "
        f"{cells['relative_error']}), modal mass {cells['modal_mass']}{second} {unit}, "
        f"added mass {cells['added_mass']} {unit}." + (f" Note: {mode['note']}." if mode["note"] else "")
    )


def _estimates(summary: Summary) -> Iterator[Section]:
    if summary["estimates"]:
        estimates = {name: values | {"bound": _bound(values)} for name, values in summary["estimates"].items()}
        yield Section(
            title="Estimates of the first elastic tone beside the field solution",
            headings=("estimate", *headings(ESTIMATES)),
            rows=labelled_columns(ESTIMATES, estimates),
            notes=_notes(estimates),
            compares=True,
        )
    elif summary["first_elastic_by_body"]:
        yield Section(
            title="Estimates of the first elastic tone",
            lines=("None: the older theories know one beam with free ends beside free water.",),
            compares=True,
        )
    for values in summary["floats"]:
        if values["estimates"]:
            yield Section(
                title=f"Estimates of the heave of float {values['body']} beside the field solution",
                headings=("estimate of heave", *headings(FLOAT_ESTIMATES)),
                rows=labelled_columns(FLOAT_ESTIMATES, values["estimates"]),
                notes=_notes(values["estimates"]),
                compares=True,
            )
        if values["printed_constants"]:
            constants = values["printed_constants"]
            yield Section(
                title=f"Constants of the paper for float {values['body']}",
                headings=("constant of the paper", *headings(PRINTED_CONSTANTS), "printed/corrected"),
                rows=[
                    (*row, f"{value['printed'] / value['corrected']:.6g}")
                    for row, value in zip(
                        labelled_columns(PRINTED_CONSTANTS, constants), constants.values(), strict=True
                    )
                ],
                compares=True,
            )


def _bound(estimate: Summary) -> str:
    if estimate["bound"] == "none":
        return "none"
    what = f"≥ mode {estimate['bound_mode']}"
    if estimate["bound"] == "above_pressure_release_tone":
        what += ", ψ = 0"
    return what + {True: ": holds", False: ": VIOLATED", None: ": not checked"}[estimate["bound_holds"]]


def _notes(estimates: Summary) -> tuple[str, ...]:
    """Return what each estimate neglects."""
    return tuple(f"{name}: {estimate['note']}" for name, estimate in estimates.items())


def tank_cost(summary: Summary) -> str:
    """Return size and cost of the solution."""
    size = summary["size"]
    where = " in half the tank, symmetric and antisymmetric" if size["halves"] else ""
    return (
        f"{size['cells']} cells, degree {size['degree']}, {size['dofs']} unknowns "
        f"({size['surface_unknowns']} on the surface){where}{spent(summary)}"
    )


def mode_columns(summary: Summary) -> dict[str, list[Any]]:
    """Return all modes at full precision, as the columns of ``modes.csv``."""
    modes = summary["modes"]
    columns = {quantity.key: [mode[quantity.key] for mode in modes] for quantity in MODES.parts}
    return {"mode": list(range(1, len(modes) + 1)), **columns}
