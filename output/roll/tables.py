"""The tables of a rolling ship."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees

from hydroelastic.output.digits import counted
from hydroelastic.output.provenance import spent
from hydroelastic.output.quantity_tables import columns, headings, listed
from hydroelastic.output.reading import Reading
from hydroelastic.output.roll import quantities as roll
from hydroelastic.output.sections import Section


def roll_sections(summary: Reading) -> Iterator[Section]:
    """Yield the tables of the section, the ship and its motion."""
    if summary[roll.SECTION] is not None:
        yield _section(summary[roll.SECTION])
    yield _ship(summary)
    response = summary[roll.RESPONSE]
    yield _response(response)
    if response[roll.EXCEEDANCES]:
        yield _exceedances(response[roll.EXCEEDANCES])


def _section(section: Reading) -> Section:
    followers = " and ".join(section[roll.FOLLOWERS])
    return Section(
        title=f"Section: {section[roll.TITLE] or 'untitled'}, per metre of length",
        headings=("roll", "value"),
        rows=listed(section),
        lines=(f"The section is free to follow its roll in {followers}: no force acts on it there.",) * bool(followers),
    )


def _ship(summary: Reading) -> Section:
    ship, decay = summary[roll.SHIP], summary[roll.FREE_DECAY]
    rows = listed(ship if ship[roll.QUADRATIC_DAMPING] else ship.without(roll.QUADRATIC_DAMPING))
    if decay is not None and ship[roll.DAMPING]:
        rows += listed(decay)
    return Section(title="Ship", headings=("quantity", "value"), rows=rows)


def _response(response: Reading) -> Section:
    waves = response[roll.WAVES]
    sea = f"on {counted(waves, 'wave')}" if waves else "in calm water"
    return Section(
        title=f"Motion {sea}, until {response.cell(roll.UNTIL)} s",
        headings=("quantity", "value"),
        rows=listed(response),
        lines=() if response[roll.RESTORING_IS_LINEAR] else (_beyond_linear(response),),
    )


def _beyond_linear(response: Reading) -> str:
    return (
        f"BEYOND THE THEORY: the angle reaches {abs(response[roll.LARGEST_ANGLE_DEGREES]):.4g} degrees. What restores "
        f"a ship is linear up to about {degrees(roll.LINEAR_UP_TO):.0f} degrees only, so none rolls like this. "
        "Were slopes and angles given in rad?"
    )


def _exceedances(found: list[Reading]) -> Section:
    level, swings = headings(roll.EXCEEDANCES)
    rows = [
        (cell, f"{degrees(entry[roll.LEVEL]):.4g}", count)
        for entry, (cell, count) in zip(found, columns(found), strict=True)
    ]
    return Section(title="Exceedances", headings=(level, "level, degrees", swings), rows=rows)


def roll_cost(summary: Reading) -> str:
    """Return a line about size and time of the solution."""
    return f"{summary[roll.SIZE][roll.TIMES]} times{spent(summary)}"
