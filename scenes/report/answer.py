"""The main results of a run, each with its estimated error."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from math import hypot, inf
from typing import TypeAlias

from hydroelastic.output.digits import with_certain_digits
from hydroelastic.output.level_tank import quantities as level_tank
from hydroelastic.output.open_water import irregular
from hydroelastic.output.open_water import quantities as water
from hydroelastic.output.open_water import time_quantities as over_time
from hydroelastic.output.open_water.declarations import DOFS
from hydroelastic.output.provenance import SCENE, Summary
from hydroelastic.output.quantities import Quantity
from hydroelastic.output.reading import Reading
from hydroelastic.output.roll import quantities as roll
from hydroelastic.output.sections import Row, Section
from hydroelastic.output.string import quantities as string
from hydroelastic.output.tank import quantities as tank
from hydroelastic.output.thread import quantities as thread
from hydroelastic.physics.dofs import Dof, Turn
from hydroelastic.scenes.models.body_kinds import kind_of_sea_body
from hydroelastic.scenes.report.families import Family, family_of, reading_of

# Number of frequencies of one analysis; the others are in its table.
_MOST_MODES = 3
_ROUNDING = 1e-13
# In types of JSON: a number, "inf" or null.
_Error: TypeAlias = float | str | None


def answer(summary: Summary) -> Section:
    """Return the main numbers of a result, with their relative errors."""
    rows = list(_ROWS[family_of(summary)](reading_of(summary)))
    return Section(title="", headings=("quantity", "value", "estimated relative error"), rows=rows)


def _row(quantity: str, value: float, relative_error: _Error) -> Row:
    if not isinstance(relative_error, float):
        return quantity, f"{value:.4g}", "unknown"
    error = max(relative_error, _ROUNDING)
    return quantity, with_certain_digits(value, error), f"{error:.1e}"


def _of_absolute(quantity: str, value: float, error: _Error) -> Row:
    if not isinstance(error, float):
        return _row(quantity, value, None)
    if abs(value) <= error:
        return quantity, "0", f"{error:.1e} absolute"
    return _row(quantity, value, error / abs(value))


def _declared(reading: Reading, quantity: Quantity, name: str, index: int | None = None) -> Row:
    """A quantity with the unit and the error that are declared for it; of a list, one entry."""
    error: Quantity = reading.group[quantity.error]
    value = reading[quantity] if index is None else reading[quantity][index]
    name = ", ".join(filter(None, (name, quantity.unit_text)))
    return (_row if error.unit == "1" else _of_absolute)(name, value, reading[error])


def _tank(summary: Reading) -> Iterator[Row]:
    """Growing motions, the lowest frequencies, and those of the bodies."""
    for growing in summary[tank.GROWING][:1]:
        yield _declared(growing, tank.GROWTH_RATE, "fastest growth of an unstable motion")
    yield from _modes(summary[tank.MODES], tank.MODE_OMEGA, tank.KIND)
    for tone in summary[tank.FIRST_ELASTIC_TONES]:
        if tone[tank.TONE_OMEGA] is not None:
            name = f"ω of the first elastic tone of beam {tone[tank.TONE_BODY]}, mode {tone[tank.TONE_INDEX]}"
            yield _declared(tone, tank.TONE_OMEGA, name)
    for body in summary[tank.FLOATS]:
        for mode in body[tank.FLOAT_MODES]:
            if mode[tank.FLOAT_OMEGA] is not None:
                of_body = f"{mode[tank.MOTION]} of float {body[tank.FLOAT_BODY]}"
                yield _declared(mode, tank.FLOAT_OMEGA, f"ω of {of_body}, mode {mode[tank.FLOAT_MODE_INDEX]}")


def _level_tank(summary: Reading) -> Iterator[Row]:
    yield from _modes(summary[level_tank.MODES], level_tank.MODE_OMEGA, level_tank.KIND)
    for tone in summary[level_tank.TONES]:
        if tone[level_tank.TONE_OMEGA] is not None:
            # The tone is sought in its own order too, above the modes that were asked for.
            index = tone[level_tank.TONE_INDEX]
            name = f"ω of the first elastic tone of plate {tone[level_tank.TONE_BODY]}"
            yield _declared(tone, level_tank.TONE_OMEGA, name if index is None else f"{name}, mode {index}")


def _modes(modes: list[Reading], omega: Quantity, kind: Quantity) -> Iterator[Row]:
    for number, mode in enumerate(modes[:_MOST_MODES], 1):
        yield _declared(mode, omega, f"ω of mode {number} ({mode[kind]})")


def _open_water(summary: Reading) -> Iterator[Row]:
    """The largest values of each analysis, and the slowest resonances."""
    is_whole = any(kind_of_sea_body(body) in ("plate", "solid") for body in summary[SCENE]["body"])

    def motions(table: Reading) -> Iterator[tuple[int, Dof]]:
        """The first motions of an analysis; the pitch of solids and plates is an angle, that of beams is none."""
        for place, name in enumerate(table[DOFS][:_MOST_MODES]):
            yield place, Turn(name) if is_whole and Dof(name).kind == "pitch" else Dof(name)

    for table in summary[water.RADIATION]:
        yield from _largest_damping(table, motions(table), is_whole)
    # Results that were written by earlier versions lack them.
    for table in (one for one in summary[water.RESPONSE] if water.LARGEST in one):
        yield from _largest_motions(table, motions(table)) if is_whole else _largest_reflections(table)
    for table in summary[water.RESONANCE]:
        found = zip(table[water.RESONANCE_OMEGA], table[water.RESONANCE_ERROR], strict=True)
        for number, ((frequency, growth), error) in enumerate(list(found)[:_MOST_MODES], 1):
            # The error is that of |ω|, and so of each part.
            absolute = error * hypot(frequency, growth) if isinstance(error, float) else error
            yield _of_absolute(f"frequency of resonance {number}, Re ω, rad/s", frequency, absolute)
            yield _of_absolute(f"decay of resonance {number}, −Im ω, 1/s", -growth, absolute)
    for table in summary[water.DECAY]:
        times, dofs, initial = table[water.DECAY_TIMES], table[DOFS], table[water.INITIAL]
        displacement = table[water.DISPLACEMENT]
        released = max(range(len(dofs)), key=lambda place: abs(initial[place]))
        # At late times the motion has decayed: the largest swing to the other side is reported instead.
        sign = -1.0 if initial[released] > 0.0 else 1.0
        back = max(range(len(times)), key=lambda place: sign * displacement[place][released])
        motion = Turn(dofs[released]) if is_whole and Dof(dofs[released]).kind == "pitch" else Dof(dofs[released])
        name = f"{motion.words} largest swing to the other side after release, at t = {times[back]:.4g} s"
        name += ", rad" if motion.is_rotation else ", m"
        yield _of_absolute(name, displacement[back][released], table[water.DECAY_ERROR][back])
    for table in summary[water.SPECTRUM]:
        for response in table[irregular.RESPONSES][:_MOST_MODES]:
            name = f"significant amplitude of {response[irregular.QUANTITY]} in irregular waves"
            yield _declared(response, irregular.SIGNIFICANT_AMPLITUDE, f"{name}, {response[irregular.UNIT]}")
    for table in summary[water.IMPULSE_RESPONSE]:
        added, error = table[over_time.INFINITE_FREQUENCY_ADDED_MASS], table[over_time.IMPULSE_ERROR]
        for place, dof in motions(table):
            unit = ("kg", "kg·m²")[dof.is_rotation] if is_whole else ("kg/m", "kg·m")[dof.is_rotation]
            yield _row(f"added mass of {dof.words} at infinite frequency, {unit}", added[place][place], error)
    for table in summary[water.MOTION]:
        largest, error = table[over_time.LARGEST], table[over_time.MOTION_ERROR]
        for place, dof in motions(table):
            yield _row(f"largest {dof.words} in waves, {'rad' if dof.is_rotation else 'm'}", largest[place], error)


def _largest_reflections(table: Reading) -> Iterator[Row]:
    waves, largest = table[water.WAVES], table[water.LARGEST_REFLECTION]
    for wave, name in enumerate(waves):
        which = f" of {name} waves" if len(waves) > 1 else ""
        value, omega, error = (largest[water.LARGEST_REFLECTION[key]][wave] for key in ("value", "omega", "error"))
        yield _of_absolute(f"largest reflection |R|{which}, at ω = {omega:.4g} rad/s", value, error)


def _largest_motions(table: Reading, motions: Iterable[tuple[int, Dof]]) -> Iterator[Row]:
    largest = table[water.LARGEST]
    values, omegas, errors = (largest[water.LARGEST[key]][0] for key in ("value", "omega", "error"))
    for place, dof in motions:
        quantity = f"largest {dof.words} in waves, at ω = {omegas[place]:.4g} rad/s"
        unit = "rad/m" if dof.is_rotation else "m/m"
        yield _of_absolute(f"{quantity}, {unit}", values[place], errors[place])


def _largest_damping(table: Reading, motions: Iterable[tuple[int, Dof]], is_whole: bool) -> Iterator[Row]:
    """The largest damping of each motion of a rigid body, at the finite frequencies that were requested."""
    omegas, all_damping = table[water.OMEGA], table[water.RADIATION_DAMPING]
    finite = [place for place, omega in enumerate(omegas) if omega != "inf"]
    for motion, dof in motions if finite else ():
        damping = [all_damping[place][motion][motion] or -inf for place in finite]
        place = finite[damping.index(max(damping))]
        quantity = f"largest radiation damping of {dof.words}, of the requested ω at {omegas[place]:.4g} rad/s"
        units = ("kg/s", "kg·m²/s") if is_whole else ("kg/(m·s)", "kg·m/s")
        yield _row(f"{quantity}, {units[dof.is_rotation]}", max(damping), table[water.RADIATION_ERROR][place])


def _string(summary: Reading) -> Iterator[Row]:
    for number, mode in enumerate(summary[string.MODES][:_MOST_MODES], 1):
        if mode[string.KIND] == "oscillating":
            yield _declared(mode, string.MODE_OMEGA, f"ω of free motion {number}")
    response = summary[string.RESPONSE]
    where = f"{response[string.AT_TIME]:.4g} s, {response[string.AT_POSITION]:.4g} m above the free end"
    yield _declared(response, string.LARGEST_DISPLACEMENT, f"largest displacement, {where}")


def _thread(summary: Reading) -> Iterator[Row]:
    for index, end in enumerate("AB"):
        rest = summary[thread.EQUILIBRIUM]
        yield _declared(rest, thread.END_TENSIONS, f"tension at end {end} at rest", index)
    for modes in summary[thread.MODES]:
        for number, mode in enumerate(modes[thread.OSCILLATING][:_MOST_MODES], 1):
            yield _declared(mode, thread.DAMPED_OMEGA, f"Im λ of free motion {number}")
    for sweep in summary[thread.STABILITY]:
        for threshold in sweep[thread.THRESHOLDS][:1]:
            name = f"{threshold[thread.THRESHOLD_KIND]} begins at times the stream"
            yield _declared(threshold, thread.FACTOR, name)
    for motion in summary[thread.MOTION]:
        name = f"largest tension in motion, at {motion[thread.LARGEST_TENSION_AT][0]:.4g} s"
        yield _declared(motion, thread.LARGEST_TENSION, name)


def _roll(summary: Reading) -> Iterator[Row]:
    response = summary[roll.RESPONSE]
    name = f"largest angle, at {response[roll.TIME_OF_LARGEST_ANGLE]:.4g} s"
    yield _declared(response, roll.LARGEST_ANGLE, name)
    yield _declared(response, roll.LARGEST_ANGLE_DEGREES, "the same")


_ROWS: dict[Family, Callable[[Reading], Iterator[Row]]] = {
    "tank": _tank,
    "level tank": _level_tank,
    "open water": _open_water,
    "string": _string,
    "thread": _thread,
    "roll": _roll,
}
