"""Rigid motions of the bodies of a tank: which cost no energy, which the volume of the liquids forbids."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from hydroelastic.physics.motions import Level
from hydroelastic.physics.tank import Tank


@dataclass(frozen=True, kw_only=True)
class LooseMotion:
    """A rigid motion without stiffness.

    Attributes:
        body: index among the bodies.
        name: what it is.
        level: where the body floats.
        displaces: whether it displaces volume on the whole, which must then go elsewhere.
    """

    body: int
    name: str
    level: Level
    displaces: bool


def loose_motions(tank: Tank) -> tuple[LooseMotion, ...]:
    """Return the motions that cost no energy, each of them alone.

    A free beam without hydrostatics heaves, pitches and turns about its hinges at no cost. A float sways at no cost,
    and rolls so if it is neutral; where it may heave, heave follows the roll so that the force on it, and with it the
    volume it displaces, is zero.
    """
    return (*_loose_beams(tank), *_loose_floats(tank))


def _loose_beams(tank: Tank) -> Iterator[LooseMotion]:
    for index, beam in tank.beams.items():
        if not beam.hydrostatic and beam.ends == "free":
            yield LooseMotion(body=index, name="heave", level=beam.level, displaces=True)
            yield LooseMotion(body=index, name="pitch", level=beam.level, displaces=False)
            for number in range(len(beam.hinges)):
                yield LooseMotion(body=index, name=f"hinge {number + 1}", level=beam.level, displaces=False)


def _loose_floats(tank: Tank) -> Iterator[LooseMotion]:
    for index, body in tank.floats.items():
        if "sway" in body.motions:
            yield LooseMotion(body=index, name="sway", level=body.level, displaces=False)
        if "roll" in body.motions and body.roll_stiffness == 0.0:
            displaces = "heave" not in body.motions and body.hydrostatics.coupling_stiffness != 0.0
            yield LooseMotion(body=index, name="roll", level=body.level, displaces=displaces)


def zero_mode_count(tank: Tank) -> int:
    """Return how many motions have neither stiffness nor, by the volume of the liquids, a constraint.

    Two liquids each keep their volume, so that what displaces it at one level takes turns with all else there. At the
    top it is not kept where ψ = 0.
    """
    loose = loose_motions(tank)
    held = {motion.level for motion in loose if motion.displaces}
    if _volume_is_free(tank):
        held -= {"surface"}
    return len(loose) - len(held)


def mode_count(tank: Tank) -> int | None:
    """Return how many modes oscillate where nothing but rigid bodies can, else None: as many as one asks for."""
    if tank.beams or len(tank.layers) > 1 or tank.top == "free":
        return None
    motions = sum(len(body.motions) for body in tank.floats.values())
    # Whether a float has a motion that displaces volume on the whole.
    displaced = any(
        "heave" in body.motions or ("roll" in body.motions and body.hydrostatics.coupling_stiffness != 0.0)
        for body in tank.floats.values()
    )
    constraints = int(displaced and not _volume_is_free(tank))
    return motions - constraints - zero_mode_count(tank)


def _volume_is_free(tank: Tank) -> bool:
    return tank.top == "pressure_release" and tank.levels[-1].is_open


def heave_is_held(tank: Tank, index: int) -> bool:
    """Return whether a body can displace no liquid: nothing else at its level could give way."""
    level = tank.level_of(index)
    if any(piece.body not in (None, index) for piece in level.pieces):
        return False
    return not ((level.above is not None or tank.top != "rigid") and level.is_open)
