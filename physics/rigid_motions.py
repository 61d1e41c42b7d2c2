"""Rigid motions of the bodies of a tank: those without stiffness, and those that conservation of volume excludes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from hydroelastic.physics.motions import Level
from hydroelastic.physics.tank import Tank


@dataclass(frozen=True, kw_only=True)
class ZeroStiffnessMotion:
    """A rigid motion without stiffness.

    Attributes:
        body: index among the bodies.
        name: name of the motion.
        level: where the body floats.
        displaces: whether it displaces a net volume, which another part of the level must take up.
    """

    body: int
    name: str
    level: Level
    displaces: bool


def zero_stiffness_motions(tank: Tank) -> tuple[ZeroStiffnessMotion, ...]:
    """Return the motions without stiffness, each by itself.

    A free beam without hydrostatics heaves, pitches and turns about its hinges without energy. A float sways without
    energy, and rolls without energy if its roll stiffness is zero; a float that heaves freely does so in the roll so
    that its heave force, and with it the displaced volume, is zero.
    """
    return (*_beam_motions(tank), *_float_motions(tank))


def _beam_motions(tank: Tank) -> Iterator[ZeroStiffnessMotion]:
    for index, beam in tank.beams.items():
        if not beam.hydrostatic and beam.ends == "free":
            yield ZeroStiffnessMotion(body=index, name="heave", level=beam.level, displaces=True)
            yield ZeroStiffnessMotion(body=index, name="pitch", level=beam.level, displaces=False)
            for number in range(len(beam.hinges)):
                yield ZeroStiffnessMotion(body=index, name=f"hinge {number + 1}", level=beam.level, displaces=False)


def _float_motions(tank: Tank) -> Iterator[ZeroStiffnessMotion]:
    for index, body in tank.floats.items():
        if "sway" in body.motions:
            yield ZeroStiffnessMotion(body=index, name="sway", level=body.level, displaces=False)
        if "roll" in body.motions and body.roll_stiffness == 0.0:
            displaces = "heave" not in body.motions and body.hydrostatics.coupling_stiffness != 0.0
            yield ZeroStiffnessMotion(body=index, name="roll", level=body.level, displaces=displaces)


def zero_mode_count(tank: Tank) -> int:
    """Return the number of motions that have no stiffness and are not excluded by conservation of volume.

    Each of two liquids keeps its volume, so that motions that displace volume at one level are constrained together. At
    a top with ψ = 0 the volume is not conserved.
    """
    loose = zero_stiffness_motions(tank)
    held = {motion.level for motion in loose if motion.displaces}
    if _volume_is_free(tank):
        held -= {"surface"}
    return len(loose) - len(held)


def mode_count(tank: Tank) -> int | None:
    """Return the number of oscillating modes where only rigid bodies move, else None (unlimited)."""
    if tank.beams or len(tank.layers) > 1 or tank.top == "free":
        return None
    motions = sum(len(body.motions) for body in tank.floats.values())
    # Whether a float has a motion that displaces a net volume.
    displaced = any(
        "heave" in body.motions or ("roll" in body.motions and body.hydrostatics.coupling_stiffness != 0.0)
        for body in tank.floats.values()
    )
    constraints = int(displaced and not _volume_is_free(tank))
    return motions - constraints - zero_mode_count(tank)


def _volume_is_free(tank: Tank) -> bool:
    return tank.top == "pressure_release" and tank.levels[-1].is_open


def heave_is_excluded(tank: Tank, index: int) -> bool:
    """Return whether conservation of volume excludes a body's heave: nothing else at its level moves."""
    level = tank.level_of(index)
    if any(piece.body not in (None, index) for piece in level.pieces):
        return False
    return not ((level.above is not None or tank.top != "rigid") and level.is_open)
