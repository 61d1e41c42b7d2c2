"""The main results of a run, each with its estimated error."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import hypot, inf
from typing import TypeAlias

from hydroelastic.output.digits import with_certain_digits
from hydroelastic.output.level_tank.quantities import LEVEL_TANK
from hydroelastic.output.provenance import Summary
from hydroelastic.output.quantities import Group
from hydroelastic.output.roll.quantities import RESPONSE as ROLL_RESPONSE
from hydroelastic.output.sections import Row, Section
from hydroelastic.output.string.quantities import HANGING_STRING
from hydroelastic.output.tank.quantities import TANK
from hydroelastic.output.thread.quantities import THREAD
from hydroelastic.physics.dofs import Dof
from hydroelastic.scenes.models.body_kinds import kind_of_sea_body
from hydroelastic.scenes.report.families import Family, family_of

# Number of frequencies of one analysis; the others are in its table.
_MOST_MODES = 3
_ROUNDING = 1e-13
# In types of JSON: a number, "inf" or null.
_Error: TypeAlias = float | str | None


def answer(summary: Summary) -> Section:
    """Return the main numbers of a result, with their relative errors.

    Args:
        summary: content of ``summary.json``.
    """
    rows = _ROWS[family_of(summary)]
    return Section(title="", headings=("quantity", "value", "estimated relative error"), rows=list(rows(summary)))


def _row(quantity: str, value: float, relative_error: _Error) -> Row:
    if not isinstance(relative_error, float):
        return quantity, f"{value:.4g}", "unknown"
    error = max(relative_error, _ROUNDING)
    return quantity, with_certain_digits(value, error), f"{error:.1e}"


def _of_absolute(quantity: str, value: float, error: _Error) -> Row:
    """A value with an absolute error."""
    if not isinstance(error, float):
        return _row(quantity, value, None)
    if abs(value) <= error:
        return quantity, "0", f"{error:.1e} absolute"
    return _row(quantity, value, error / abs(value))


def _declared(group: Group, values: Summary, key: str, name: str, index: int | None = None) -> Row:
    """A quantity with the unit and the error that are declared for it; of a list, one entry."""
    quantity = group[key]
    value = values[key] if index is None else values[key][index]
    name = ", ".join(filter(None, (name, quantity.unit_text)))
    return (_row if group[quantity.error].unit == "1" else _of_absolute)(name, value, values[quantity.error])


def _tank(summary: Summary) -> Iterator[Row]:
    """Growing motions, the lowest frequencies, and those of the bodies."""
    for growing in summary["growing"][:1]:
        yield _declared(TANK["growing"], growing, "growth_rate", "fastest growth of an unstable motion")
    yield from _modes(TANK, summary)
    yield from _elastic(TANK, summary, "beam")
    for body in summary["floats"]:
        for mode in body["modes"]:
            if mode["omega"] is not None:
                name = f"ω of {mode['motion']} of float {body['body']}, mode {mode['index']}"
                yield _declared(TANK["floats"]["modes"], mode, "omega", name)


def _level_tank(summary: Summary) -> Iterator[Row]:
    """The lowest frequencies, and those of the plates."""
    yield from _modes(LEVEL_TANK, summary)
    yield from _elastic(LEVEL_TANK, summary, "plate")


def _modes(kind: Group, summary: Summary) -> Iterator[Row]:
    for number, mode in enumerate(summary["modes"][:_MOST_MODES], 1):
        yield _declared(kind["modes"], mode, "omega", f"ω of mode {number} ({mode['kind']})")


def _elastic(kind: Group, summary: Summary, what: str) -> Iterator[Row]:
    for elastic in summary["first_elastic_by_body"]:
        if elastic["omega"] is not None:
            # Of plates the tone is sought in its own order too, above the modes that were asked for.
            index = "" if elastic["index"] is None else f", mode {elastic['index']}"
            name = f"ω of the first elastic tone of {what} {elastic['body']}{index}"
            yield _declared(kind["first_elastic_by_body"], elastic, "omega", name)


def _open_water(summary: Summary) -> Iterator[Row]:
    """The largest values of each analysis, and the slowest resonances."""
    is_whole = any(kind_of_sea_body(body) in ("plate", "solid") for body in summary["scene"]["body"])
    for table in summary["radiation"]:
        yield from _largest_damping(table, is_whole)
    for table in summary["response"]:
        if is_whole:
            yield from _largest_motions(table)
            continue
        for wave, name in enumerate(table["waves"]):
            sizes = [hypot(*row[wave][wave]) for row in table["reflection"]]
            place = sizes.index(max(sizes))
            which = f" of {name} waves" if len(table["waves"]) > 1 else ""
            quantity = f"largest reflection |R|{which}, at ω = {table['omega'][place]:.4g} rad/s"
            yield _of_absolute(quantity, sizes[place], table["relative_error"][place])
    for table in summary["resonance"]:
        found = zip(table["omega"], table["relative_error"], strict=True)
        for number, ((frequency, growth), error) in enumerate(list(found)[:_MOST_MODES], 1):
            # The error is that of |ω|, and so of each part.
            absolute = error * hypot(frequency, growth) if isinstance(error, float) else error
            yield _of_absolute(f"frequency of resonance {number}, Re ω, rad/s", frequency, absolute)
            yield _of_absolute(f"decay of resonance {number}, −Im ω, 1/s", -growth, absolute)
    for table in summary["decay"]:
        released = max(range(len(table["dofs"])), key=lambda place: abs(table["initial"][place]))
        # At late times the motion has decayed: the largest swing to the other side is reported instead.
        sign = -1.0 if table["initial"][released] > 0.0 else 1.0
        back = max(range(len(table["times"])), key=lambda place: sign * table["displacement"][place][released])
        motion = Dof(table["dofs"][released])
        name = f"{motion.words} largest swing to the other side after release, at t = {table['times'][back]:.4g} s"
        name += ", rad" if motion.is_rotation else ", m"
        yield _of_absolute(name, table["displacement"][back][released], table["absolute_error"][back])
    for table in summary["spectrum"]:
        for response in table["responses"][:_MOST_MODES]:
            quantity = f"significant amplitude of {response['quantity']} in irregular waves, {response['unit']}"
            yield _row(quantity, response["significant_amplitude"], response["relative_error"])
    for table in summary["impulse_response"]:
        for place, dof in enumerate(map(Dof, table["dofs"][:_MOST_MODES])):
            unit = "kg·m" if dof.is_rotation else "kg/m"
            quantity = f"added mass of {dof.words} at infinite frequency, {unit}"
            yield _row(quantity, table["infinite_frequency_added_mass"][place][place], table["relative_error"])
    for table in summary["motion"]:
        for place, dof in enumerate(map(Dof, table["dofs"][:_MOST_MODES])):
            quantity = f"largest {dof.words} in waves, {'rad' if dof.is_rotation else 'm'}"
            yield _row(quantity, table["largest"][place], table["relative_error"])


def _largest_motions(table: Summary) -> Iterator[Row]:
    """The largest motions of solids in waves of unit amplitude."""
    for motion, dof in enumerate(map(Dof, table["dofs"][:_MOST_MODES])):
        sizes = [hypot(*row[0][motion]) for row in table["amplitudes"]]
        place = sizes.index(max(sizes))
        quantity = f"largest {dof.words} in waves, at ω = {table['omega'][place]:.4g} rad/s"
        unit = "rad/m" if dof.is_rotation else "m/m"
        yield _of_absolute(f"{quantity}, {unit}", sizes[place], sizes[place] * table["relative_error"][place])


def _largest_damping(table: Summary, is_whole: bool) -> Iterator[Row]:
    """The largest damping of each motion of a rigid body, at finite frequencies."""
    finite = [place for place, omega in enumerate(table["omega"]) if omega != "inf"]
    for motion, dof in enumerate(map(Dof, table["dofs"][:_MOST_MODES] if finite else ())):
        damping = [table["radiation_damping"][place][motion][motion] or -inf for place in finite]
        place = finite[damping.index(max(damping))]
        quantity = f"largest radiation damping of {dof.words}, at ω = {table['omega'][place]:.4g} rad/s"
        units = ("kg/s", "kg·m²/s") if is_whole else ("kg/(m·s)", "kg·m/s")
        yield _row(f"{quantity}, {units[dof.is_rotation]}", max(damping), table["relative_error"][place])


def _string(summary: Summary) -> Iterator[Row]:
    for number, mode in enumerate(summary["modes"][:_MOST_MODES], 1):
        if mode["kind"] == "oscillating":
            yield _declared(HANGING_STRING["modes"], mode, "omega", f"ω of free motion {number}")
    response = summary["response"]
    name = f"largest displacement, {response['at_time']:.4g} s, {response['at_position']:.4g} m above the free end"
    yield _declared(HANGING_STRING["response"], response, "largest_displacement", name)


def _thread(summary: Summary) -> Iterator[Row]:
    for index, end in enumerate("AB"):
        name = f"tension at end {end} at rest"
        yield _declared(THREAD["equilibrium"], summary["equilibrium"], "end_tensions", name, index)
    for modes in summary["modes"]:
        for number, mode in enumerate(modes["oscillating"][:_MOST_MODES], 1):
            yield _declared(THREAD["modes"]["oscillating"], mode, "damped_omega", f"Im λ of free motion {number}")
    for sweep in summary["stability"]:
        for threshold in sweep["thresholds"][:1]:
            name = f"{threshold['kind']} begins at times the stream"
            yield _declared(THREAD["stability"]["thresholds"], threshold, "factor", name)
    for motion in summary["motion"]:
        name = f"largest tension in motion, at {motion['largest_tension_at'][0]:.4g} s"
        yield _declared(THREAD["motion"], motion, "largest_tension", name)


def _roll(summary: Summary) -> Iterator[Row]:
    response = summary["response"]
    name = f"largest angle, at {response['time_of_largest_angle']:.4g} s"
    yield _declared(ROLL_RESPONSE, response, "largest_angle", name)
    yield _declared(ROLL_RESPONSE, response, "largest_angle_degrees", "the same")


_ROWS: dict[Family, Callable[[Summary], Iterator[Row]]] = {
    "tank": _tank,
    "level tank": _level_tank,
    "open water": _open_water,
    "string": _string,
    "thread": _thread,
    "roll": _roll,
}
