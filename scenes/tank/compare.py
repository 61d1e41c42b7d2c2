"""The field solution beside the estimates of the older theories."""

from __future__ import annotations

from dataclasses import replace

from hydroelastic.fem.stopwatch import Report
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.output.outcome import Outcome
from hydroelastic.scenes.tank.run import run_tank
from hydroelastic.scenes.tank.tables import compared_sections


def compare_tank(scene: TankScene, *, report: Report = lambda _message: None) -> Outcome:
    """Solve a closed tank and compare, with what each estimate neglects; writes nothing (collective).

    Raises:
        SceneError: if the scene's ends are open, or its mesh does not fit it.
        UnsolvedError: if the eigen-solver fails.
    """
    outcome = run_tank(scene, report=report)
    return replace(outcome, sections=tuple(compared_sections(outcome.summary)), notes=True)
