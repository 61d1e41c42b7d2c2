"""Tables of the comparison of a thread with estimates."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from hydroelastic.output.digits import number
from hydroelastic.output.provenance import Summary
from hydroelastic.output.quantities import Group, Quantity
from hydroelastic.output.quantity_tables import columns, headings
from hydroelastic.output.reading import Reading
from hydroelastic.output.sections import Section
from hydroelastic.output.thread import comparison as compared

_EXPLAINED = {True: "yes", False: "NO"}
_NOT_EXPLAINED = (
    "NO: larger than the error of the field solution and twice what the theory says it leaves out, together."
)


def comparison_sections(comparison: Summary) -> Iterator[Section]:
    """Yield the tables of shapes, of values and of estimates that do not apply."""
    told = Reading(compared.COMPARISON, comparison)
    if told[compared.SHAPES]:
        yield _shapes(told, "position", compared.POSITION, compared.POSITION_ERROR)
        yield _shapes(told, "tension", compared.TENSION, compared.TENSION_ERROR)
    yield from map(_values, told[compared.VALUES])
    if told[compared.INAPPLICABLE]:
        yield _inapplicable(told[compared.INAPPLICABLE])


def _inapplicable(entries: list[Reading]) -> Section:
    names: dict[str, list[str]] = {}
    for entry in entries:
        names.setdefault(entry[compared.REASON], []).append(entry[compared.NAME])
    notes = tuple(f"{'; '.join(those)}: {reason}." for reason, those in names.items())
    return Section(title="Estimates that do not apply, and why", notes=notes)


def _shapes(comparison: Reading, what: str, beside: Group, field_error: Quantity) -> Section:
    field, estimates, unit = comparison[compared.FIELD], comparison[compared.SHAPES], field_error.unit
    rows = [
        (
            estimate[compared.NAME],
            _order(estimate),
            "–" if estimate[compared.ORDER] is None else estimate.cell(compared.SMALL),
            f"{estimate[beside][compared.DIFFERENCE]:.2e}",
            estimate[beside].cell(compared.LEFT_OUT),
            _EXPLAINED[estimate[beside][compared.EXPLAINED]],
            estimate.cell(compared.ESTIMATE_SECONDS),
        )
        for estimate in estimates
    ]
    error, seconds = field.cell(field_error), field.cell(compared.SECONDS)
    lines = [f"Estimated error of the field solution: {error} {unit}; it took {seconds} s."]
    parameters = {estimate[compared.PARAMETER] for estimate in estimates if estimate[compared.PARAMETER]}
    if parameters:
        lines.append(f"What must be small: {'; '.join(sorted(parameters))}.")
    if not all(estimate[beside][compared.EXPLAINED] for estimate in estimates):
        lines.append(_NOT_EXPLAINED)
    return Section(
        title=f"Largest difference of a {what} from older theories",
        headings=("estimate", "order", "small", f"difference, {unit}", f"left out, {unit}", "explained", "seconds"),
        rows=rows,
        lines=tuple(lines),
    )


def _order(estimate: Reading) -> str:
    return "exact" if estimate[compared.ORDER] is None else str(estimate[compared.ORDER])


def _values(estimate: Reading) -> Section:
    entries = estimate[compared.COMPARED]
    kind = "exact" if estimate[compared.ORDER] is None else f"order {estimate[compared.ORDER]}"
    parameter = estimate[compared.PARAMETER]
    small = f", {parameter} = {estimate.cell(compared.SMALL)}" if parameter else ""
    lines = [f"The estimate took {estimate.cell(compared.ESTIMATE_SECONDS)} s."]
    if not entries:
        lines.append("The field solution has none of them.")
    if not all(entry[compared.EXPLAINED] for entry in entries):
        lines.append(_NOT_EXPLAINED)
    return Section(
        title=f"{estimate[compared.NAME]} ({kind}{small}): {estimate[compared.QUANTITY]}",
        headings=headings(compared.COMPARED),
        rows=columns([_shown(entry) for entry in entries]),
        lines=tuple(lines),
    )


def _shown(entry: Reading) -> Reading:
    """A compared value as it is shown: complex ones as one number, and loudly what is not explained."""
    values = {part: _complex(entry[part]) for part in (compared.OF_FIELD, compared.OF_ESTIMATE)}
    return entry | values | {compared.EXPLAINED: _EXPLAINED[entry[compared.EXPLAINED]]}


def _complex(value: Any) -> str:
    return f"{value[0]:.6g} {value[1]:+.7g}i" if isinstance(value, list) else number(value)
