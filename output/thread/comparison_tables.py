"""Tables of the comparison of a thread with estimates."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from hydroelastic.output.digits import number
from hydroelastic.output.provenance import Summary
from hydroelastic.output.sections import Section

_EXPLAINED = {True: "yes", False: "NO"}
_NOT_EXPLAINED = (
    "NO: larger than the error of the field solution and twice what the theory says it leaves out, together."
)


def comparison_sections(comparison: Summary) -> Iterator[Section]:
    """Yield the tables of shapes, of values and of estimates that do not apply.

    Args:
        comparison: of `thread_differences`.
    """
    if comparison["shapes"]:
        yield from (_shapes(comparison, quantity) for quantity in ("position", "tension"))
    for estimate in comparison["values"]:
        yield _values(estimate)
    if comparison["inapplicable"]:
        yield _inapplicable(comparison)


def _inapplicable(comparison: Summary) -> Section:
    """Estimates that do not apply, by reasons."""
    names: dict[str, list[str]] = {}
    for entry in comparison["inapplicable"]:
        names.setdefault(entry["reason"], []).append(entry["name"])
    notes = tuple(f"{'; '.join(those)}: {reason}." for reason, those in names.items())
    return Section(title="Estimates that do not apply, and why", notes=notes)


def _shapes(comparison: Summary, quantity: str) -> Section:
    unit = {"position": "m", "tension": "N"}[quantity]
    rows = [
        (
            estimate["name"],
            _order(estimate),
            "–" if estimate["order"] is None else f"{estimate['small']:.2g}",
            f"{estimate[quantity]['difference']:.2e}",
            f"{estimate[quantity]['left_out']:.1e}",
            _EXPLAINED[estimate[quantity]["explained"]],
            f"{estimate['seconds']:.3f}",
        )
        for estimate in comparison["shapes"]
    ]
    headings = ("estimate", "order", "small", f"difference, {unit}", f"left out, {unit}", "explained", "seconds")
    error = comparison["field"][f"{quantity}_error"]
    lines = [f"Estimated error of the field solution: {error:.1e} {unit}; it took {_seconds(comparison)} s."]
    parameters = {estimate["parameter"] for estimate in comparison["shapes"] if estimate["parameter"]}
    if parameters:
        lines.append(f"What must be small: {'; '.join(sorted(parameters))}.")
    if any(not estimate[quantity]["explained"] for estimate in comparison["shapes"]):
        lines.append(_NOT_EXPLAINED)
    return Section(
        title=f"Largest difference of a {quantity} from older theories",
        headings=headings,
        rows=rows,
        lines=tuple(lines),
    )


def _seconds(comparison: Summary) -> str:
    return f"{comparison['field']['seconds']:.2f}"


def _order(estimate: Summary) -> str:
    return "exact" if estimate["order"] is None else str(estimate["order"])


def _values(estimate: Summary) -> Section:
    rows = [
        (
            str(entry["number"]),
            _shown(entry["field"]),
            _shown(entry["estimate"]),
            f"{entry['difference']:.1e}",
            f"{entry['field_error']:.1e}",
            f"{entry['left_out']:.1e}",
            _EXPLAINED[entry["explained"]],
        )
        for entry in estimate["compared"]
    ]
    headings = ("number", "field solution", "estimate", "difference", "error of field", "left out", "explained")
    kind = "exact" if estimate["order"] is None else f"order {estimate['order']}"
    small = f", {estimate['parameter']} = {estimate['small']:.2g}" if estimate["parameter"] else ""
    lines = [f"The estimate took {estimate['seconds']:.3f} s."]
    if not rows:
        lines.append("The field solution has none of them.")
    if any(not entry["explained"] for entry in estimate["compared"]):
        lines.append(_NOT_EXPLAINED)
    title = f"{estimate['name']} ({kind}{small}): {estimate['quantity']}"
    return Section(title=title, headings=headings, rows=rows, lines=tuple(lines))


def _shown(value: Any) -> str:
    return f"{value[0]:.6g} {value[1]:+.7g}i" if isinstance(value, list) else number(value)
