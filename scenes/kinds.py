"""The functions of the commands run, compare and check for each kind of scene, imported when needed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

from hydroelastic.output.outcome import Outcome
from hydroelastic.output.sections import Section
from hydroelastic.scenes.errors import Problem, SceneError, shown_value
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.read import Scene, closed_tank

if TYPE_CHECKING:
    from hydroelastic.scenes.staged_run import StagedRun


def runner_of(scene: Scene) -> StagedRun[Any, Any]:
    """Return what runs a scene: ``run(scene, out=…, images=…, page=…, import_seconds=…, report=…)``."""
    if isinstance(scene, TankScene) or scene.kind == "sea":
        if scene.is_open:
            from hydroelastic.scenes.open_water.run import run_open

            return run_open
        from hydroelastic.scenes.tank.run import run_tank

        return run_tank
    if scene.kind == "tank":
        from hydroelastic.scenes.models.round_tank import OrderedTankScene

        if isinstance(scene, OrderedTankScene):
            from hydroelastic.scenes.round_tank.run import run_round_tank

            return run_round_tank
        from hydroelastic.scenes.level_tank.run import run_level_tank

        return run_level_tank
    if scene.kind == "string":
        from hydroelastic.scenes.string.run import run_string

        return run_string
    if scene.kind == "thread":
        from hydroelastic.scenes.thread.run import run_thread

        return run_thread
    from hydroelastic.scenes.roll.run import run_roll

    return run_roll


def comparer_of(scene: Scene) -> Callable[..., Outcome]:
    """Return the function that compares the field solution of a scene with the theories: ``compare(scene,
    report=…)``."""
    if isinstance(scene, TankScene) or scene.kind == "sea":
        closed_tank(scene, "the older theories that are compared are those of closed tanks")
        from hydroelastic.scenes.tank.run import compare_tank

        return compare_tank
    if scene.kind == "tank":
        from hydroelastic.scenes.models.round_tank import OrderedTankScene

        if isinstance(scene, OrderedTankScene):
            from hydroelastic.scenes.round_tank.run import compare_round_tank

            return compare_round_tank
        from hydroelastic.scenes.level_tank.run import compare_level_tank

        return compare_level_tank
    if scene.kind == "string":
        from hydroelastic.scenes.string.compare import compare_string

        return compare_string
    if scene.kind == "thread":
        from hydroelastic.scenes.thread.compare import compare_thread

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


def checker_of(scene: Scene) -> Callable[[Any], Iterator[Section]]:
    """Return the function that describes the model of a scene in tables and lines: ``check(scene)``."""
    if isinstance(scene, TankScene) or scene.kind == "sea":
        if scene.is_open:
            from hydroelastic.scenes.open_water.check import check_open

            return check_open
        from hydroelastic.scenes.tank.check import check_tank

        return check_tank
    if scene.kind == "tank":
        from hydroelastic.scenes.models.round_tank import OrderedTankScene

        if isinstance(scene, OrderedTankScene):
            from hydroelastic.scenes.round_tank.check import check_round_tank

            return check_round_tank
        from hydroelastic.scenes.level_tank.check import check_level_tank

        return check_level_tank
    if scene.kind == "string":
        from hydroelastic.scenes.string.check import check_string

        return check_string
    if scene.kind == "thread":
        from hydroelastic.scenes.thread.check import check_thread

        return check_thread
    from hydroelastic.scenes.roll.check import check_roll

    return check_roll
