"""The tables of a hanging string."""

from __future__ import annotations

from collections.abc import Iterator

from hydroelastic.output.digits import number
from hydroelastic.output.provenance import Summary, spent
from hydroelastic.output.quantity_tables import columns, headings, listed
from hydroelastic.output.sections import Row, Section
from hydroelastic.output.string.quantities import MODES, RESPONSE


def string_sections(summary: Summary) -> Iterator[Section]:
    """Yield the tables of free motions and of the response."""
    yield _modes(summary)
    yield _response(summary)


def _modes(summary: Summary) -> Section:
    rows = [(str(number), *row) for number, row in enumerate(columns(MODES, summary["modes"]), 1)]
    lines = tuple(_criterion(summary["string"]))
    return Section(title="Free motions", headings=("motion", *headings(MODES)), rows=rows, lines=lines)


def _criterion(string: Summary) -> Iterator[str]:
    yield f"A wave takes R = {number(string['travel_time'])} s along the string; α = {number(string['damping'])} 1/s."
    if string["first_oscillating_mode"] is None:
        return
    critical = f"critical λ of the first mode {number(string['critical_resistance'])} kg/(m·s)"
    first = string["first_oscillating_mode"]
    if first == 1:
        yield f"All modes oscillate ({critical})."
    else:
        yield f"Modes below number {first} are aperiodic ({critical}); all above oscillate."


def _response(summary: Summary) -> Section:
    response = summary["response"]
    rows = listed(RESPONSE, response)
    if summary["steady"] is not None:
        rows += _steady(summary["steady"])
    beside = response["beside_fronts"]
    error = f"the error is up to {beside['absolute_error']:.1e} m"
    if beside["absolute_error"] > abs(response["largest_displacement"]):
        error = "the motion is not resolved"
    line = (
        f"{beside['points']} values lie within {100 * beside['within']:g} % of R from a wave front, where the motion "
        f"or a derivative of it jumps; there {error}."
    )
    how = "by series" if summary["method"] == "series" else "field solution"
    return Section(
        title=f"Response until {response['until']:.6g} s, {how}",
        headings=("quantity", "value"),
        rows=rows,
        lines=(line,) if beside["points"] else (),
    )


def _steady(steady: Summary) -> Iterator[Row]:
    """The steady response to a sine, after the free motions have decayed."""
    amplitude, peak = steady["amplitude"][0], steady["nearest_resonance"]
    yield f"amplitude of the forced motion at the height {steady['positions'][0]:g} m, m", _or_infinite(amplitude)
    if peak["omega"] is not None:
        yield f"largest one at the free end near mode {peak['mode']}, m", _or_infinite(peak["amplitude"])
        yield "at ω, rad/s", number(peak["omega"])


def _or_infinite(value: float | None) -> str:
    return "infinite" if value is None else number(value)


def string_cost(summary: Summary) -> str:
    """Return size and cost of the solution."""
    size = summary["size"]
    what = (
        f"{size['terms']} terms"
        if "terms" in size
        else f"{size['cells']} cells, degree {size['degree']}, {size['dofs']} unknowns, {size['steps']} steps"
    )
    return f"{what}{spent(summary)}"
