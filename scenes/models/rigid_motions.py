"""Rigid motions of the bodies of a scene: which cost no energy, which the volume of the liquids forbids."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import isinf
from typing import TYPE_CHECKING

from hydroelastic.scenes.models.bodies import Float, Level
from hydroelastic.scenes.models.tank import TankScene, level_segments

if TYPE_CHECKING:
    from hydroelastic.scenes.models.floats import Hydrostatics


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


def loose_motions(scene: TankScene) -> tuple[LooseMotion, ...]:
    """Return the motions that cost no energy, each of them alone.

    A free beam without hydrostatics heaves, pitches and turns about its hinges at no cost. A float sways at no cost,
    and rolls so if it is neutral; where it may heave, heave follows the roll so that the force on it, and with it the
    volume it displaces, is zero.
    """
    return (*_loose_beams(scene), *_loose_floats(scene))


def _loose_beams(scene: TankScene) -> Iterator[LooseMotion]:
    for index, beam in scene.beams:
        if not beam.hydrostatic and beam.ends == "free":
            level = scene.level_of(beam)
            yield LooseMotion(body=index, name="heave", level=level, displaces=True)
            yield LooseMotion(body=index, name="pitch", level=level, displaces=False)
            for number in range(len(beam.hinges)):
                yield LooseMotion(body=index, name=f"hinge {number + 1}", level=level, displaces=False)


def _loose_floats(scene: TankScene) -> Iterator[LooseMotion]:
    for index, body in scene.floats:
        level = scene.level_of(body)
        if "sway" in body.motions:
            yield LooseMotion(body=index, name="sway", level=level, displaces=False)
        if "roll" in body.motions:
            # Contours need SciPy, which takes a while to import.
            from hydroelastic.scenes.models.floats import placed_float

            at_rest = placed_float(scene, index).hydrostatics
            if roll_stiffness(body, at_rest) == 0.0:
                displaces = "heave" not in body.motions and at_rest.coupling_stiffness != 0.0
                yield LooseMotion(body=index, name="roll", level=level, displaces=displaces)


def roll_stiffness(body: Float, at_rest: Hydrostatics) -> float:
    """Return the stiffness of the roll of a float, N: heave, where it may, follows so that no force acts on it."""
    return at_rest.free_roll_stiffness if "heave" in body.motions else at_rest.roll_stiffness


def zero_mode_count(scene: TankScene) -> int:
    """Return how many motions have neither stiffness nor, by the volume of the liquids, a constraint.

    Two liquids each keep their volume, so that what displaces it at one level takes turns with all else there. At the
    top it is not kept where ψ = 0.
    """
    loose = loose_motions(scene)
    held = {motion.level for motion in loose if motion.displaces}
    if _volume_is_free(scene):
        held -= {"surface"}
    return len(loose) - len(held)


def mode_count(scene: TankScene) -> int | None:
    """Return how many modes oscillate where nothing but rigid bodies can, else None: as many as one asks for."""
    if scene.beams or len(scene.layers) > 1 or scene.top == "free":
        return None
    motions = sum(len(body.motions) for _, body in scene.floats)
    displaced = any(_displaces(scene, index, body) for index, body in scene.floats)
    constraints = int(displaced and not _volume_is_free(scene))
    return motions - constraints - zero_mode_count(scene)


def _displaces(scene: TankScene, index: int, body: Float) -> bool:
    """Whether a float has a motion that displaces volume on the whole."""
    if "heave" in body.motions:
        return True
    if "roll" not in body.motions:
        return False
    from hydroelastic.scenes.models.floats import placed_float

    return placed_float(scene, index).hydrostatics.coupling_stiffness != 0.0


def _volume_is_free(scene: TankScene) -> bool:
    return scene.top == "pressure_release" and has_open(scene, "surface")


def levels_of(scene: TankScene) -> tuple[Level, ...]:
    """Return the still levels of a scene, from the top down; an upper liquid without end has no surface."""
    if len(scene.layers) == 1:
        return ("surface",)
    return ("interface",) if isinf(scene.layers[1].depth) else ("surface", "interface")


def has_open(scene: TankScene, level: Level) -> bool:
    """Return whether there is anything at a level beside the bodies."""
    return any(segment.body is None for segment in level_segments(scene, level))


def heave_is_held(scene: TankScene, index: int) -> bool:
    """Return whether a body can displace no liquid: nothing else at its level could give way."""
    level = scene.level_of(scene.body[index])
    if any(other != index and scene.level_of(body) == level for other, body in enumerate(scene.body)):
        return False
    return not ((level == "interface" or scene.top != "rigid") and has_open(scene, level))
