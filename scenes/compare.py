"""The field solution beside the estimates of the older theories."""

from __future__ import annotations

from hydroelastic.scenes.models import TankScene
from hydroelastic.scenes.outcome import Outcome
from hydroelastic.scenes.run import solved_scene
from hydroelastic.scenes.stopwatch import Report
from hydroelastic.scenes.tables import printed


def compare_scene(scene: TankScene, *, report: Report = lambda _message: None) -> Outcome:
    """Solve a closed tank and compare, with what each estimate neglects; writes nothing (collective).

    Raises:
        SceneError: if the scene's ends are open, or its mesh does not fit it.
    """
    _, summary = solved_scene(scene, report=report)
    return Outcome(summary=summary, tables=printed(summary, notes=True))
