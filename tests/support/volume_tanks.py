"""A tank on a mesh of its volume."""

from __future__ import annotations

import json
from pathlib import Path

from hydroelastic.physics.level_tank import Box
from hydroelastic.physics.plate import Plate, Rectangle
from hydroelastic.physics.volume_tank import VolumeTank


def rectangle_in_a_box() -> VolumeTank:
    """The case ``rectangle_base_s0`` of the references."""
    file = Path(__file__).parents[1] / "reference" / "three_dimensions.json"
    cases = json.loads(file.read_text(encoding="utf-8"))["cases"]
    (given,) = [case["inputs"] for case in cases if case["id"] == "rectangle_base_s0"]
    plate = Plate(
        outline=Rectangle(position=(given["L"] / 2.0, given["B"] / 2.0), size=(given["l"], given["b"])),
        flexural_rigidity=given["D"],
        mass_per_area=given["m"],
        hydrostatic=False,
    )
    plan = Box(length=given["L"], width=given["B"])
    return VolumeTank(plan=plan, depth=given["H"], density=1000.0, gravity=9.81, plates=(plate,))
