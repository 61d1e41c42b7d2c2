"""Conversion of a scene to a `physics.tank.Tank`, in SI units."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

from hydroelastic.physics import attachments as physics
from hydroelastic.physics.beams import Beam
from hydroelastic.physics.round_plates import RoundPlate
from hydroelastic.physics.tank import Tank, tank
from hydroelastic.scenes.models.attachments import Attachment
from hydroelastic.scenes.models.body_kinds import AnyFloat
from hydroelastic.scenes.models.floats import placed_float
from hydroelastic.scenes.models.tank_parts import TankParts

if TYPE_CHECKING:
    from hydroelastic.physics.floats import RigidFloat


def physical_tank(scene: TankParts) -> Tank:
    """Return the tank, or the open water, of a scene; SI units, per metre of width or of revolution.

    Raises:
        ValueError: if a float cannot float at its level.
    """
    return _physical_tank(scene, tuple(scene.state_of_file(body) for _, body in scene.floats))


# Points of a sweep are asked for theirs several times, one after the other.
@lru_cache(maxsize=256)
def _physical_tank(scene: TankParts, _states_of_files: tuple[object, ...]) -> Tank:
    found = tank(
        length=scene.tank.length,
        gravity=scene.tank.gravity,
        is_open=scene.is_open,
        liquids=tuple((layer.density, layer.depth) for layer in scene.layers),
        top=scene.top,
        bodies=tuple(_body(scene, index) for index in range(len(scene.body))),
        geometry=scene.geometry,
    )
    return replace(
        found,
        start=scene.stretch[0],
        phase_at=scene.phase_at,
        # Of closed tanks the floats have the springs.
        attachments=tuple(_attachment(scene, one) for one in scene.attachment if scene.is_open),
        bed=scene.bed,
    )


def _attachment(scene: TankParts, one: Attachment) -> physics.Attachment:
    point = one.at
    if point is None:
        # Without a point it holds a float, at its centre of mass.
        point = placed_float(scene, one.body - 1).hydrostatics.centre_of_mass
    return physics.Attachment(
        body=one.body - 1,
        other=None if one.to is None else one.to - 1,
        point=point,
        stiffness=one.stiffness,
        damping=one.damping,
        drag=one.quadratic_damping,
    )


def _body(scene: TankParts, index: int) -> Beam | RigidFloat | RoundPlate:
    body = scene.body[index]
    if isinstance(body, AnyFloat):
        # Contours need SciPy's root finders, whose import is slow.

        return placed_float(scene, index)
    return body.physical(scene.level_of(body))
