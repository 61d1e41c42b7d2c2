"""The field solution beside the estimates of the older theories."""

from __future__ import annotations

from dataclasses import dataclass

from hydroelastic.scenes.models import TankScene
from hydroelastic.scenes.run import solved_scene
from hydroelastic.scenes.solve import Report
from hydroelastic.scenes.summary import Summary
from hydroelastic.scenes.tables import printed


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """A solved scene and its estimates.

    Attributes:
        summary: as in ``summary.json``.
    """

    summary: Summary

    @property
    def status(self) -> str:
        """The word "ok", or "unconverged"."""
        return str(self.summary["status"])

    def table(self) -> str:
        """The tables for a terminal, with what each estimate neglects."""
        return printed(self.summary, notes=True)


def compare_scene(scene: TankScene, *, report: Report = lambda _message: None) -> Comparison:
    """Solve a scene and compare; writes nothing (collective).

    Raises:
        SceneError: if the scene's mesh does not fit it.
    """
    _, summary = solved_scene(scene, report=report)
    return Comparison(summary=summary)
