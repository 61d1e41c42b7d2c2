"""What each command does with each kind of scene. Its libraries are imported when it is asked for."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from hydroelastic.scenes.errors import Problem, SceneError, shown_value
from hydroelastic.scenes.model_string import StringScene
from hydroelastic.scenes.model_thread import ThreadScene
from hydroelastic.scenes.models import TankScene
from hydroelastic.scenes.outcome import Outcome
from hydroelastic.scenes.read import Scene, closed_tank


def runner_of(scene: Scene) -> Callable[..., Outcome]:
    """Return what runs a scene: ``run(scene, out=…, images=…, import_seconds=…, report=…)``."""
    if isinstance(scene, TankScene):
        from hydroelastic.scenes.run import run_scene

        return run_scene
    if isinstance(scene, StringScene):
        from hydroelastic.scenes.string_run import run_string

        return run_string
    if isinstance(scene, ThreadScene):
        from hydroelastic.scenes.thread_run import run_thread

        return run_thread
    from hydroelastic.scenes.roll_run import run_roll

    return run_roll


def comparer_of(scene: Scene) -> Callable[..., Outcome]:
    """Return what sets the field solution of a scene beside the theories: ``compare(scene, report=…)``.

    Raises:
        SceneError: if there is no field solution of such a scene, or no theory.
    """
    if isinstance(scene, TankScene):
        closed_tank(scene, "the older theories that are compared are those of closed tanks")
        from hydroelastic.scenes.compare import compare_scene

        return compare_scene
    if isinstance(scene, StringScene):
        from hydroelastic.scenes.string_compare import compare_string

        return compare_string
    if isinstance(scene, ThreadScene):
        from hydroelastic.scenes.thread_compare import compare_thread

        return compare_thread
    raise SceneError(
        Problem(
            key='key "kind"',
            value=shown_value(scene.kind),
            wrong="the roll of a ship is a closed form, with no field solution to set beside it",
            allowed='"tank", "string" or "thread"',
            remedy="The command run takes this kind",
        )
    )


def checker_of(scene: Scene) -> Callable[[Any, Any], None]:
    """Return what says how a scene will be modelled: ``check(scene, console)``."""
    if isinstance(scene, TankScene):
        from hydroelastic.scenes.check import print_check

        return print_check
    if isinstance(scene, StringScene):
        from hydroelastic.scenes.string_check import print_string_check

        return print_string_check
    if isinstance(scene, ThreadScene):
        from hydroelastic.scenes.thread_check import print_thread_check

        return print_thread_check
    from hydroelastic.scenes.roll_check import print_roll_check

    return print_roll_check
