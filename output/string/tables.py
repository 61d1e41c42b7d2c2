"""The tables of a hanging string."""

from __future__ import annotations

from collections.abc import Iterator

from hydroelastic.output.digits import number
from hydroelastic.output.provenance import spent
from hydroelastic.output.quantity_tables import headings, labelled_columns, listed
from hydroelastic.output.reading import Reading
from hydroelastic.output.sections import Row, Section
from hydroelastic.output.string import quantities as string


def string_sections(summary: Reading) -> Iterator[Section]:
    """Yield the tables of free motions and of the response."""
    yield _modes(summary)
    yield _response(summary)


def _modes(summary: Reading) -> Section:
    return Section(
        title="Free motions",
        headings=("motion", *headings(string.MODES)),
        rows=labelled_columns(summary[string.MODES]),
        lines=tuple(_criterion(summary[string.STRING])),
    )


def _criterion(given: Reading) -> Iterator[str]:
    yield (
        f"A wave takes R = {given.cell(string.TRAVEL_TIME)} s along the string; α = {given.cell(string.DAMPING)} 1/s."
    )
    first = given[string.FIRST_OSCILLATING_MODE]
    if first is None:
        return
    critical = f"critical λ of the first mode {given.cell(string.CRITICAL_RESISTANCE)} kg/(m·s)"
    if first == 1:
        yield f"All modes oscillate ({critical})."
    else:
        yield f"Modes below number {first} are aperiodic ({critical}); all above oscillate."


def _response(summary: Reading) -> Section:
    response = summary[string.RESPONSE]
    rows = listed(response)
    if summary[string.STEADY] is not None:
        rows += _steady(summary[string.STEADY])
    beside = response[string.BESIDE_FRONTS]
    error = f"the error is up to {beside.cell(string.BESIDE_ERROR)} m"
    if beside[string.BESIDE_ERROR] > abs(response[string.LARGEST_DISPLACEMENT]):
        error = "the motion is not resolved"
    line = (
        f"{beside[string.POINTS]} values lie within {100 * beside[string.WITHIN]:g} % of R from a wave front, where "
        f"the motion or a derivative of it jumps; there {error}."
    )
    how = "by series" if summary[string.METHOD] == "series" else "field solution"
    return Section(
        title=f"Response until {response.cell(string.UNTIL)} s, {how}",
        headings=("quantity", "value"),
        rows=rows,
        lines=(line,) if beside[string.POINTS] else (),
    )


def _steady(steady: Reading) -> Iterator[Row]:
    """The steady response to a sine, after the free motions have decayed."""
    height, amplitude = steady[string.POSITIONS][0], steady[string.AMPLITUDE][0]
    yield f"amplitude of the forced motion at the height {height:g} m, m", _or_infinite(amplitude)
    peak = steady[string.NEAREST_RESONANCE]
    if peak[string.RESONANT_OMEGA] is not None:
        name = f"largest one at the free end near mode {peak[string.RESONANT_MODE]}, m"
        yield name, _or_infinite(peak[string.RESONANT_AMPLITUDE])
        yield "at ω, rad/s", peak.cell(string.RESONANT_OMEGA)


def _or_infinite(value: float | None) -> str:
    return "infinite" if value is None else number(value)


def string_cost(summary: Reading) -> str:
    """Return size and cost of the solution."""
    size = summary[string.SIZE]
    if string.TERMS in size:
        return f"{size[string.TERMS]} terms{spent(summary)}"
    cells = f"{size[string.CELLS]} cells, degree {size[string.DEGREE]}, {size[string.DOFS]} unknowns"
    return f"{cells}, {size[string.STEPS]} steps{spent(summary)}"
