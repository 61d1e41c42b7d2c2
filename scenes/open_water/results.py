"""The solution of a scene with open ends: the tables of its analyses, and their cost."""

from __future__ import annotations

from dataclasses import dataclass

from hydroelastic.fem.open_water.region import Region
from hydroelastic.fem.open_water.solve import OpenWaterSolution
from hydroelastic.scenes.models.tank import TankScene


@dataclass(frozen=True, kw_only=True)
class OpenSolution(OpenWaterSolution):
    """The solution of a scene with open ends; tables in the order of the scene's analyses.

    Attributes:
        scene: the scene.
    """

    scene: TankScene


def region_words(region: Region | None) -> str:
    """Return a description of the region of ω in which resonances were sought."""
    if region is None:
        return "any ω: the bodies have no restoring force"
    return f"{region.lowest:.4g} < Re ω < {region.highest:.4g} rad/s, −Im ω < {region.damping:g} Re ω"
