"""The tables of a rolling ship."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees

from hydroelastic.output.digits import counted
from hydroelastic.output.provenance import Summary, spent
from hydroelastic.output.quantity_tables import columns, headings, listed
from hydroelastic.output.roll.quantities import EXCEEDANCES, FREE_DECAY, LINEAR_UP_TO, RESPONSE, SECTION, SHIP
from hydroelastic.output.sections import Section


def roll_sections(summary: Summary) -> Iterator[Section]:
    """Yield the tables of the section, the ship and its motion; `summary` is the content of ``summary.json``."""
    if summary["section"] is not None:
        yield _section(summary["section"])
    yield _ship(summary)
    yield _response(summary["response"])
    if summary["response"]["exceedances"]:
        yield _exceedances(summary["response"])


def _section(section: Summary) -> Section:
    followers = " and ".join(section["followers"])
    return Section(
        title=f"Section: {section['title'] or 'untitled'}, per metre of length",
        headings=("roll", "value"),
        rows=listed(SECTION, section),
        lines=(f"The section is free to follow its roll in {followers}: no force acts on it there.",) * bool(followers),
    )


def _ship(summary: Summary) -> Section:
    ship, decay = summary["ship"], summary["free_decay"]
    rows = listed(SHIP, {key: value for key, value in ship.items() if key != "quadratic_damping" or value})
    if decay is not None and ship["damping"]:
        rows += listed(FREE_DECAY, decay)
    return Section(title="Ship", headings=("quantity", "value"), rows=rows)


def _response(response: Summary) -> Section:
    waves = response["waves"]
    title = f"Motion {'on ' + counted(waves, 'wave') if waves else 'in calm water'}, until {response['until']:.6g} s"
    lines = () if response["restoring_is_linear"] else (_beyond_linear(response),)
    return Section(title=title, headings=("quantity", "value"), rows=listed(RESPONSE, response), lines=lines)


def _beyond_linear(response: Summary) -> str:
    return (
        f"BEYOND THE THEORY: the angle reaches {abs(response['largest_angle_degrees']):.4g} degrees. What restores a "
        f"ship is linear up to about {degrees(LINEAR_UP_TO):.0f} degrees only, so none rolls like this. "
        "Were slopes and angles given in rad?"
    )


def _exceedances(response: Summary) -> Section:
    level, swings = headings(EXCEEDANCES)
    rows = [
        (cell, f"{degrees(entry['level']):.4g}", count)
        for entry, (cell, count) in zip(
            response["exceedances"], columns(EXCEEDANCES, response["exceedances"]), strict=True
        )
    ]
    return Section(title="Exceedances", headings=(level, "level, degrees", swings), rows=rows)


def roll_cost(summary: Summary) -> str:
    """Return a line about size and time of the solution."""
    return f"{summary['size']['times']} times{spent(summary)}"
