"""Tanks on meshes of their volume."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from level_tanks import CASES

from hydroelastic.physics.level_tank import Box, LevelTank
from hydroelastic.physics.plate import Plate, Rectangle
from hydroelastic.physics.volume_tank import VolumeTank


def as_volume(tank: LevelTank, **changes: Any) -> VolumeTank:
    given = {field.name: getattr(tank, field.name) for field in fields(tank)}
    return VolumeTank(**(given | changes))


def rectangle_in_a_box() -> VolumeTank:
    given = CASES["rectangle_base_s0"]["inputs"]
    plate = Plate(
        outline=Rectangle(position=(given["L"] / 2.0, given["B"] / 2.0), size=(given["l"], given["b"])),
        flexural_rigidity=given["D"],
        mass_per_area=given["m"],
        hydrostatic=False,
    )
    plan = Box(length=given["L"], width=given["B"])
    return VolumeTank(plan=plan, depth=given["H"], density=1000.0, gravity=9.81, plates=(plate,))
