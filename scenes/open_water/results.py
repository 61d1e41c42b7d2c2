"""The solution of a scene with open ends: the tables of its analyses, and what they cost."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from hydroelastic.fem.open_water.region import Region
from hydroelastic.fem.open_water.results import DecayTable, RadiationTable, ResonanceTable, ResponseTable
from hydroelastic.scenes.models.tank import TankScene


@dataclass(frozen=True, kw_only=True)
class OpenSolution:
    """The solution of a scene with open ends; tables in the order of the scene's analyses.

    Attributes:
        scene: the scene.
        radiation: one for each radiation analysis.
        response: one for each response analysis.
        resonance: one for each resonance analysis.
        decay: one for each decay analysis.
        size: "cells", "dofs" (unknowns of ψ) and "degree".
        seconds: time by stage.
        reasons: why the solution does not keep what was asked; empty if it does.
    """

    scene: TankScene
    radiation: tuple[RadiationTable, ...] = ()
    response: tuple[ResponseTable, ...] = ()
    resonance: tuple[ResonanceTable, ...] = ()
    decay: tuple[DecayTable, ...] = ()
    size: dict[str, int]
    seconds: dict[str, float]
    reasons: tuple[str, ...] = ()

    @property
    def status(self) -> Literal["ok", "unconverged"]:
        """Whether everything that was asked is kept."""
        return "unconverged" if self.reasons else "ok"


def region_words(region: Region | None) -> str:
    """Return in which region of ω resonances were sought, in words."""
    if region is None:
        return "any ω: the bodies have no restoring force"
    return f"{region.lowest:.4g} < Re ω < {region.highest:.4g} rad/s, −Im ω < {region.damping:g} Re ω"
