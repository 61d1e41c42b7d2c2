"""Description of the model and method of the scene of a rolling ship, without solving it."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi

from hydroelastic.fem.cost import cost
from hydroelastic.output.digits import number
from hydroelastic.output.roll.quantities import regime
from hydroelastic.output.sections import Row, Section
from hydroelastic.scenes.models.roll import RollScene
from hydroelastic.scenes.roll.physics import rolling_ship
from hydroelastic.scenes.roll.section_file import section_scene

# Of ψ around a ship's section, and frequencies.
_UNKNOWNS, _SOLUTIONS = 6_000, 30


def check_roll(scene: RollScene) -> Iterator[Section]:
    """Yield the equation, its constants, the unknowns, the waves and the method."""
    yield Section(title="Equation", lines=tuple(_ship(scene)))
    yield Section(title="Unknown fields", headings=("field", "where", "why"), rows=tuple(_unknowns(scene)))
    yield Section(title="Waves", lines=tuple(_waves(scene)))
    yield Section(title="Method", lines=tuple(_method(scene)))


def _unknowns(scene: RollScene) -> Iterator[Row]:
    yield "φ", "ship", "angle of roll, small, so that the restoring moment is linear"
    if scene.natural_frequency is None:
        yield "ψ", "liquid around the section", "gives k, and in open water n by outgoing waves; solved first"
    else:
        yield "liquid: none", "around the ship", "it acts by k and n, which are given, and by the slope of its waves"


def _ship(scene: RollScene) -> Iterator[str]:
    quadratic = " + d|φ'|φ'" if scene.roll.quadratic_damping else ""
    yield f"φ'' + 2nφ'{quadratic} + k²φ = k² × slope of the waves."
    frequency = scene.natural_frequency
    if frequency is None:
        section = section_scene(scene)
        where = "open water, n by radiated waves" if section.is_open else "a closed tank, which absorbs no energy"
        yield f"k from the field solution of the section “{section.title or scene.section_file}” in {where}."
        given = scene.roll.damping or scene.roll.damping_ratio
        if given:
            unit = "1/s" if scene.roll.damping is not None else "k"
            yield f"n on top of that: {number(given)} {unit}."
    else:
        ship = rolling_ship(scene, None)
        yield (
            f"k = {number(frequency)} rad/s (T = {number(2.0 * pi / frequency)} s), n = {number(ship.damping)} 1/s = "
            f"{number(ship.damping / frequency)} k: {regime(ship)}."
        )
        times = scene.times(frequency)
        yield f"{len(times)} times until {number(times[-1])} s."
    if scene.roll.quadratic_damping:
        yield f"d = {number(scene.roll.quadratic_damping)} 1/rad."
    if scene.roll.angle or scene.roll.rate:
        yield f"At t = 0, φ = {number(scene.roll.angle)} rad and φ' = {number(scene.roll.rate)} rad/s."


def _waves(scene: RollScene) -> Iterator[str]:
    waves = scene.waves
    if not waves:
        yield "No waves: the ship is let go."
        return
    periods, slopes = [wave[0] for wave in waves], [abs(wave[1]) for wave in waves]
    if len(waves) == 1:
        yield f"1 wave: period {number(periods[0])} s, slope {number(slopes[0])} rad."
        return
    yield (
        f"{len(waves)} waves in {number(sum(periods))} s: periods {number(min(periods))} to {number(max(periods))} s, "
        f"slopes {number(min(slopes))} to {number(max(slopes))} rad."
    )


def _method(scene: RollScene) -> Iterator[str]:
    section = 0 if scene.natural_frequency is not None else _UNKNOWNS
    yield str(cost(section, 6, _SOLUTIONS, "sea" if section else "roll"))
    if scene.roll.quadratic_damping:
        yield "Integrated in time (DOP853), restarted at each wave and sign change of φ', until two tolerances agree."
    else:
        yield "Closed form from wave to wave, in every regime of damping and in resonance."
