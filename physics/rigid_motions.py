"""Rigid motions of the bodies of a tank: those without stiffness, and those that conservation of volume excludes."""

from __future__ import annotations

from dataclasses import dataclass

from hydroelastic.physics.dofs import Dof, Level
from hydroelastic.physics.tank import Tank


@dataclass(frozen=True, kw_only=True)
class ZeroStiffnessMotion:
    """A rigid motion without stiffness."""

    body: int  # index among the bodies
    name: Dof  # name of the motion
    level: Level  # where the body floats
    displaces: bool  # whether it displaces a net volume, which another part of the level must take up


def zero_stiffness_motions(tank: Tank) -> tuple[ZeroStiffnessMotion, ...]:
    """Return the motions without stiffness, each by itself."""
    return tuple(
        ZeroStiffnessMotion(body=index, name=motion, level=body.level, displaces=displaces)
        for index, body in enumerate(tank.bodies)
        for motion, displaces in body.zero_stiffness_motions()
    )


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
    if tank.elastic or len(tank.layers) > 1 or tank.top == "free":
        return None
    motions = sum(len(body.rigid_motions) for body in tank.bodies)
    displaced = any(body.displaces_volume for body in tank.bodies)
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
