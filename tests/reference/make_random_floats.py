"""Make random_floats.json: reference frequencies of tanks with floats that `random_floats` (tests/) draws.

    ./hydro python tests/reference/make_random_floats.py

Each tank is solved twice by `float_reference` (tests/), as `make_floats.py` does; tanks whose two solutions differ by
more than a tenth of the tolerance that is asked of the package are left out.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

from float_reference import reference_modes
from float_tanks import Fineness, float_tank
from random_floats import draw_floats

from hydroelastic.scenes.models.tank import TankScene

PATH = Path(__file__).with_name("random_floats.json")
SEED, COUNT = 1, 72
FINENESS = (
    Fineness(corner=8, waves=20, inner=16, powers=4, reach=1.0),
    Fineness(corner=12, waves=30, inner=24, powers=5, reach=1.0),
)
NEAR_ENOUGH = 0.1
UNTRUE = (3, 36, 44)
"""Slender wedges and parabolas of a given mass: with poles inside of them `float_reference` misses low modes (its
frequencies lie a third above those without such poles, and it gives them from above)."""
LIGHT = 1e4
"""Modal masses above this many times the mass of the float are not stored: the float hardly moves there."""

HEADER = {
    "about": "Closed 2-D tanks with floats drawn at random (tests/support/random_floats.py), per metre of width, "
    "SI units.",
    "source": "Made for this list by tests/reference/make_random_floats.py, as floats.json is.",
    "command": "./hydro python tests/reference/make_random_floats.py",
    "schema": {
        "scene": "keys as in docs/scenes.md, with the tolerance and the number of modes that are asked",
        "omega": "lowest frequencies, rad/s, without those that are zero",
        "self_convergence": "largest relative difference of omega between a coarser and a finer solution",
        "modal_masses": "of each motion of the floats from left to right, and of each mode: twice the kinetic energy "
        "over the square of the velocity of this motion, kg/m or kg m; null where it hardly moves",
    },
}


def solved(scene: TankScene) -> dict[str, Any]:
    """The entry of a tank."""
    keys = scene.model_dump(mode="json", exclude_none=True)
    given = float_tank(keys)
    coarse, fine = (reference_modes(given, scene.accuracy.modes, fineness) for fineness in FINENESS)
    owners = [part for part, motions in given.sections for _ in motions]
    masses = [
        [float(value) if value < LIGHT * part.mass * part.size**2 else None for value in row]
        for part, row in zip(owners, fine.modal_masses, strict=False)
    ]
    return {
        "scene": keys,
        "omega": fine.omega.tolist(),
        "self_convergence": float(f"{np.abs(coarse.omega / fine.omega - 1).max():.1e}"),
        "modal_masses": masses,
    }


def main() -> None:
    """Write the file, after each tank anew."""
    tanks = []
    for number, scene in enumerate(draw_floats(SEED, COUNT)):
        entry = solved(scene)
        kept = number not in UNTRUE and entry["self_convergence"] <= NEAR_ENOUGH * scene.accuracy.tolerance
        print(number, [body.kind for body in scene.body], entry["self_convergence"], "" if kept else "out", flush=True)
        if kept:
            tanks.append({"number": number} | entry)
            PATH.write_text(json.dumps(HEADER | {"tanks": tanks}, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
