"""The tables of a rolling ship."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees

from hydroelastic.output.digits import counted, number, with_certain_digits
from hydroelastic.output.provenance import Summary
from hydroelastic.output.sections import Section
from hydroelastic.scenes.roll.summary import LINEAR_UP_TO


def roll_sections(summary: Summary) -> Iterator[Section]:
    """Yield the tables of the section, the ship and its motion; `summary` is the content of ``summary.json``."""
    if summary["section"] is not None:
        yield _section(summary["section"])
    yield _ship(summary)
    yield _response(summary["response"])
    if summary["response"]["exceedances"]:
        yield _exceedances(summary["response"])


def _section(section: Summary) -> Section:
    rows = [
        ("natural frequency k, rad/s", with_certain_digits(section["natural_frequency"], section["relative_error"])),
        ("stiffness, N", number(section["stiffness"])),
        ("inertia of the body, kg·m", number(section["inertia"])),
        ("added inertia, kg·m", number(section["added_inertia"])),
        ("wave damping, kg·m/s", number(section["wave_damping"])),
        ("damping by waves n, 1/s", number(section["damping"])),
        ("estimated error, of the whole inertia", f"{section['relative_error']:.1e}"),
    ]
    followers = " and ".join(section["followers"])
    return Section(
        title=f"Section: {section['title'] or 'untitled'}, per metre of length",
        headings=("roll", "value"),
        rows=rows,
        lines=(f"The section is free to follow its roll in {followers}: no force acts on it there.",) * bool(followers),
    )


def _ship(summary: Summary) -> Section:
    ship, decay = summary["ship"], summary["free_decay"]
    rows = [
        ("natural period 2π/k, s", number(ship["natural_period"])),
        ("natural frequency k, rad/s", number(ship["natural_frequency"])),
        ("damping n, 1/s", number(ship["damping"])),
        ("damping ratio n/k", f"{number(ship['damping_ratio'])}, {ship['regime']}"),
    ]
    if ship["quadratic_damping"]:
        rows.append(("quadratic damping d, 1/rad", number(ship["quadratic_damping"])))
    if decay is not None and ship["damping"]:
        rows += [
            ("period of free motion, s", number(decay["period"])),
            ("logarithmic decrement", number(decay["logarithmic_decrement"])),
            ("ratio of successive swings", number(decay["ratio_of_swings"])),
        ]
    return Section(title="Ship", headings=("quantity", "value"), rows=rows)


def _response(response: Summary) -> Section:
    # Angles are rounded for reading; summary.json has all digits.
    error = max(response["relative_error"], 1e-6)
    rows = [
        ("largest angle, rad", with_certain_digits(response["largest_angle"], error)),
        ("largest angle, degrees", with_certain_digits(response["largest_angle_degrees"], error)),
        ("at, s", number(response["time_of_largest_angle"])),
        ("root mean square, rad", number(response["root_mean_square"])),
        ("swings", str(response["swings"])),
        ("mean of the largest third of swings, rad", number(response["significant_angle"])),
        ("estimated error of the angle, of the largest", f"{response['relative_error']:.1e}"),
    ]
    waves = response["waves"]
    title = f"Motion {'on ' + counted(waves, 'wave') if waves else 'in calm water'}, until {response['until']:.6g} s"
    lines = () if response["restoring_is_linear"] else (_beyond_linear(response),)
    return Section(title=title, headings=("quantity", "value"), rows=rows, lines=lines)


def _beyond_linear(response: Summary) -> str:
    return (
        f"BEYOND THE THEORY: the angle reaches {abs(response['largest_angle_degrees']):.4g} degrees. What restores a "
        f"ship is linear up to about {degrees(LINEAR_UP_TO):.0f} degrees only, so none rolls like this. "
        "Were slopes and angles given in rad?"
    )


def _exceedances(response: Summary) -> Section:
    rows = [
        (number(row["level"]), f"{degrees(row['level']):.4g}", str(row["swings"])) for row in response["exceedances"]
    ]
    return Section(title="Exceedances", headings=("level, rad", "level, degrees", "swings above it"), rows=rows)


def roll_cost(summary: Summary) -> str:
    """Return a line about size and time of the solution."""
    seconds = ", ".join(f"{stage} {value:.3f}" for stage, value in summary["timing"].items() if value >= 0.0005)
    return (
        f"{summary['size']['times']} times; seconds: {seconds}; peak memory {summary['memory_peak'] / 2**20:.0f} MiB."
    )
