"""Rigid motions of the bodies of a tank: which cost no energy, which the volume of the liquids forbids."""

from __future__ import annotations

from dataclasses import dataclass

from hydroelastic.physics.dofs import Dof
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
    name: Dof
    level: Level
    displaces: bool


def loose_motions(tank: Tank) -> tuple[LooseMotion, ...]:
    """Return the motions that cost no energy, each of them alone."""
    return tuple(
        LooseMotion(body=index, name=motion, level=body.level, displaces=displaces)
        for index, body in enumerate(tank.bodies)
        for motion, displaces in body.loose_motions()
    )


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
    if any(body.is_elastic for body in tank.bodies) or len(tank.layers) > 1 or tank.top == "free":
        return None
    motions = sum(len(body.rigid_motions) for body in tank.bodies)
    displaced = any(body.displaces_volume for body in tank.bodies)
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
