"""The tables of a closed tank."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from hydroelastic.output.digits import counted, with_certain_digits
from hydroelastic.output.provenance import SCENE, STATUS, spent
from hydroelastic.output.quantity_tables import headings, labelled_columns, without_zeros
from hydroelastic.output.reading import Reading
from hydroelastic.output.sections import Section
from hydroelastic.output.tank import quantities as tank

_FLOAT_UNITS = {"heave": "kg/m", "sway": "kg/m", "roll": "kg·m"}


def tank_sections(summary: Reading, expected: Iterable[str] = ()) -> Iterator[Section]:
    """Yield the tables of the modes, the floats and the estimates."""
    tones = {tone[tank.TONE_INDEX] for tone in summary[tank.FIRST_ELASTIC_TONES] if tone[tank.ONE_MODE]}
    modes = [
        mode | {tank.KIND: f"{mode[tank.KIND]}, first elastic tone"} if place in tones else mode
        for place, mode in enumerate(summary[tank.MODES], 1)
    ]
    told, rows = without_zeros(tank.BENDING, modes, tank.MODES)
    yield Section(
        title="Natural modes",
        headings=("mode", *headings(told)),
        rows=labelled_columns(rows),
        lines=(*_lines(summary), *expected),
    )
    yield from _estimates(summary)


def compared_sections(summary: Reading) -> Iterator[Section]:
    """Yield the tables of the estimates with the field solution."""
    yield from _estimates(summary)
    yield Section(title="Field solution", lines=tuple(_lines(summary)))


def _lines(summary: Reading) -> Iterator[str]:
    yield from _mode_lines(summary)
    yield from tone_lines(summary)
    for body in summary[tank.FLOATS]:
        yield from _float_lines(body)
    for motion in summary[tank.GROWING]:
        yield (
            f"UNSTABLE: a motion ({motion[tank.KIND]}) grows like e^(σt), σ = {motion.cell(tank.GROWTH_RATE)} 1/s "
            f"(estimated relative error {motion.cell(tank.RELATIVE_ERROR)}). It is not among the modes listed."
        )


def _mode_lines(summary: Reading) -> Iterator[str]:
    """Difference of the modes from a known exact solution, where there is one, and modes that are not listed."""
    exact, zero_modes = summary[tank.EXACT], summary[tank.ZERO_MODES]
    if exact:
        largest = max(abs(row[tank.EXACT_DIFFERENCE]) for row in exact)
        yield f"{exact[0][tank.FORMULA]}: the largest relative difference to this exact solution is {largest:.1e}."
    if summary[STATUS] == "ok" and len(summary[tank.MODES]) < summary[SCENE]["accuracy"]["modes"]:
        yield "There are no more modes than these."
    if zero_modes:
        yield f"{counted(zero_modes, 'rigid motion')} without stiffness (ω = 0), not listed."


def tone_lines(summary: Reading) -> Iterator[str]:
    """Yield text on the first elastic tone of each beam."""
    tones = summary[tank.FIRST_ELASTIC_TONES]
    one_liquid = len(summary[SCENE]["liquid"]) == 1
    for tone in tones:
        name = f"First elastic tone of beam {tone[tank.TONE_BODY]}" if len(tones) > 1 else "First elastic tone"
        if tone[tank.TONE_OMEGA] is None:
            yield f"{name}: none; {tone[tank.NOTE]}."
        else:
            yield (
                f"{name}: {_which_mode(tone)}, ω = {tone.cell(tank.TONE_OMEGA)} rad/s (estimated relative error "
                f"{tone.cell(tank.RELATIVE_ERROR)}), added mass {tone.cell(tank.ADDED_MASS_PER_LENGTH)} kg/m², "
                f"participation {tone.cell(tank.PARTICIPATION)} (runner-up {tone.cell(tank.RUNNER_UP)})."
            )
            if tone[tank.NOTE]:
                yield f"  Note: {tone[tank.NOTE]}."
        limits = f"In vacuo: {tone.cell(tank.DRY_OMEGA)} rad/s"
        if tone[tank.PRESSURE_RELEASE_OMEGA] is not None:
            limit = "ψ = 0 on the water, " * one_liquid + "the limit of infinite frequency"
            limits += f"; pressure-release tone ({limit}): {tone.cell(tank.PRESSURE_RELEASE_OMEGA)} rad/s"
        yield f"  {limits}."


def _which_mode(tone: Reading) -> str:
    if tone[tank.ONE_MODE]:
        return f"mode {tone[tank.TONE_INDEX]}"
    first, last = tone[tank.FIRST_SHARING_MODE], tone[tank.LAST_SHARING_MODE]
    return f"no single mode; modes from {first} to {last} share it, most of it in mode {tone[tank.TONE_INDEX]}"


def _float_lines(body: Reading) -> Iterator[str]:
    left, right = body[tank.WATERPLANE]
    thin = body[tank.BOUNDARY] == "thin"
    width = "thin, its flux on the middle line" if thin else f"waterplane {left:.6g} to {right:.6g} m"
    yield (
        f"Float {body[tank.FLOAT_BODY]}: mass {body.cell(tank.MASS)} kg/m, {width}, "
        f"heave stiffness {body.cell(tank.HEAVE_STIFFNESS)} N/m²."
    )
    for mode in body[tank.FLOAT_MODES]:
        yield _float_mode_line(mode)
    limit = body[tank.HIGH_FREQUENCY]
    if limit is not None:
        matrix, error = limit[tank.HIGH_FREQUENCY_ADDED_MASS], limit[tank.HIGH_FREQUENCY_ERROR]
        own = ", ".join(
            f"{motion} {with_certain_digits(matrix[place][place], max(error, 1e-9))} {_FLOAT_UNITS[motion]}"
            for place, motion in enumerate(body[tank.MOTIONS])
        )
        yield f"  Added mass at infinite frequency: {own}."


def _float_mode_line(mode: Reading) -> str:
    motion, note, runner_up = mode[tank.MOTION], mode[tank.NOTE], mode[tank.RUNNER_UP_MODAL_MASS]
    if mode[tank.FLOAT_OMEGA] is None:
        return f"  Mode of {motion}: none; {note}."
    unit = _FLOAT_UNITS[motion]
    second = "" if runner_up is None else f" (runner-up {mode.cell(tank.RUNNER_UP_MODAL_MASS)})"
    return (
        f"  Mode of {motion}: mode {mode[tank.FLOAT_MODE_INDEX]}, ω = {mode.cell(tank.FLOAT_OMEGA)} rad/s (estimated "
        f"relative error {mode.cell(tank.RELATIVE_ERROR)}), modal mass {mode.cell(tank.MODAL_MASS)}{second} {unit}, "
        f"added mass {mode.cell(tank.ADDED_MASS)} {unit}." + (f" Note: {note}." if note else "")
    )


def _estimates(summary: Reading) -> Iterator[Section]:
    found = summary[tank.ESTIMATES]
    if found:
        yield Section(
            title="Estimates of the first elastic tone beside the field solution",
            headings=("estimate", *headings(tank.ESTIMATES)),
            rows=labelled_columns({name: one | {tank.BOUND: _bound(one)} for name, one in found.items()}),
            notes=_notes(found),
            compares=True,
        )
    elif summary[tank.FIRST_ELASTIC_TONES]:
        yield Section(
            title="Estimates of the first elastic tone",
            lines=("None: the older theories know one beam with free ends beside free water.",),
            compares=True,
        )
    for body in summary[tank.FLOATS]:
        of_heave = body[tank.FLOAT_ESTIMATES]
        if of_heave:
            yield Section(
                title=f"Estimates of the heave of float {body[tank.FLOAT_BODY]} beside the field solution",
                headings=("estimate of heave", *headings(tank.FLOAT_ESTIMATES)),
                rows=labelled_columns(of_heave),
                notes=_notes(of_heave),
                compares=True,
            )


def _bound(estimate: Reading) -> str:
    if estimate[tank.BOUND] == "none":
        return "none"
    what = f"≥ mode {estimate[tank.BOUND_MODE]}"
    if estimate[tank.BOUND] == "above_pressure_release_tone":
        what += ", ψ = 0"
    return what + {True: ": holds", False: ": VIOLATED", None: ": not checked"}[estimate[tank.BOUND_HOLDS]]


def _notes(estimates: dict[str, Reading]) -> tuple[str, ...]:
    return tuple(f"{name}: {estimate[tank.ESTIMATE_NOTE]}" for name, estimate in estimates.items())


def tank_cost(summary: Reading) -> str:
    """Return size and cost of the solution."""
    size = summary[tank.SIZE]
    return (
        f"{size[tank.CELLS]} cells, degree {size[tank.DEGREE]}, {size[tank.DOFS]} unknowns "
        f"({size[tank.SURFACE_UNKNOWNS]} on the surface){spent(summary)}"
    )


def mode_columns(summary: Reading) -> dict[str, list[Any]]:
    """Return all modes at full precision, as the columns of ``modes.csv``."""
    modes = summary[tank.MODES]
    columns = {quantity.key: [mode[quantity] for mode in modes] for quantity in tank.MODES.quantities}
    return {"mode": list(range(1, len(modes) + 1)), **columns}
