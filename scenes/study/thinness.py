"""The float of a scene with the thin and the exact boundary condition, at decreasing thinness."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, TypeAlias

from pydantic import ValidationError

from hydroelastic.physics.tank import Tank
from hydroelastic.scenes.errors import Problem, SceneError
from hydroelastic.scenes.models.bodies import THIN_SHAPES
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.validation_errors import scene_error

Boundary: TypeAlias = Literal["thin", "exact"]


def check_thinness(scene: TankScene) -> None:
    """Refuse scenes whose float has only one of the boundary conditions.

    Raises:
        SceneError: saying which float is needed.
    """
    floats = [body for _, body in scene.floats]
    if len(floats) == 1 and floats[0].shape in THIN_SHAPES and set(floats[0].motions) == {"heave"}:
        return
    raise SceneError(
        Problem(
            key="families",
            value="thinness",
            wrong="it compares both boundary conditions of one float, and the scene has none that allows both",
            allowed=f"scenes with one float, of shape {', '.join(THIN_SHAPES)}, that heaves alone",
            remedy="Leave it out, or see float_parabola",
        )
    )


def both_boundaries(scene: TankScene, halvings: int) -> Iterator[tuple[Tank, Tank]]:
    """Yield the tank with a thin and with an exact float of its own width, a half of it, a quarter and so on.

    It ends early where the float is narrower than a mesh can follow.

    Args:
        scene: one that `check_thinness` accepts.
        halvings: how often the width is halved, at most.

    Raises:
        SceneError: if one of the models is refused at the float's own width.
    """
    for halving in range(halvings + 1):
        try:
            thin, exact = (_with_boundary(scene, 0.5**halving, boundary) for boundary in ("thin", "exact"))
        except SceneError:
            if halving:
                return
            raise
        yield physical_tank(thin), physical_tank(exact)


def _with_boundary(scene: TankScene, factor: float, boundary: Boundary) -> TankScene:
    """The scene with a float of another width; a given mass is changed by Archimedes' principle."""
    index, body = scene.floats[0]
    assert body.half_width is not None
    changed = body.model_copy(
        update={
            "half_width": factor * body.half_width,
            "mass": None if body.mass is None else factor * body.mass,
            "boundary": boundary,
        }
    )
    bodies = (*scene.body[:index], changed, *scene.body[index + 1 :])
    try:
        return TankScene.model_validate(scene.model_copy(update={"body": bodies}).model_dump())
    except ValidationError as error:
        raise scene_error(error, TankScene) from error
