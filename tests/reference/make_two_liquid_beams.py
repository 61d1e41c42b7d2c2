"""Make two_liquid_beams.json: reference frequencies of beams that float in tanks with two liquids.

    ./hydro python tests/reference/make_two_liquid_beams.py

Under a lid each tank is solved by two methods that share nothing, `surface_reference` and `float_reference` (tests/),
each at two finenesses; with a free top by the second alone. What is stored has the digits that all solutions share.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

import surface_reference as surface
from float_reference import reference_modes
from float_tanks import Fineness, float_tank
from make_floats import beam, certain, tank

PATH = Path(__file__).with_name("two_liquid_beams.json")
COUNT = 8

HEADER = {
    "about": "Closed 2-D tanks with two liquids and thin free beams on the interface or on the free top, per metre of "
    "width, SI units.",
    "source": "Made for this catalogue by tests/reference/make_two_liquid_beams.py. Under a lid: Galerkin's method on "
    "the interface alone with the exact kernel of both liquids, and harmonic trial functions; with a free top these.",
    "command": "./hydro python tests/reference/make_two_liquid_beams.py",
    "schema": {
        "scene": "keys as in docs/scenes.md; liquids from the bottom up",
        "omega": "lowest frequencies, rad/s, without those that are zero, to the digits that are certain",
        "self_convergence": "largest relative difference of omega between a coarser and a finer solution, by method",
        "agreement": "largest relative difference of omega between the methods, null with one method",
    },
}

SMALL = tank(1.0, (1000.0, 0.3), (850.0, 0.2), top="rigid")
SMALL_OPEN = tank(1.0, (1000.0, 0.3), (850.0, 0.2), top="free")
BEAM = beam(0.3, 0.4, 50.0, 4.0)

SCENES: dict[str, dict[str, Any]] = {
    "oil_and_water": SMALL | {"body": [BEAM]},
    "without_a_beam": SMALL | {"body": []},
    "close_densities": tank(1.0, (1000.0, 0.3), (990.0, 0.2), top="rigid") | {"body": [beam(0.15, 0.5, 5.0, 2.0)]},
    "thin_layer": tank(1.0, (1000.0, 2.0), (800.0, 0.02), top="rigid") | {"body": [BEAM]},
    "two_beams": SMALL | {"body": [beam(0.1, 0.3, 20.0, 4.0), beam(0.5, 0.35, 1.0, 10.0)]},
    "beam_at_the_wall": SMALL | {"body": [beam(0.0, 0.4, 50.0, 4.0)]},
    "full_cover": SMALL | {"body": [beam(0.0, 1.0, 50.0, 4.0)]},
    "open_without_a_beam": SMALL_OPEN | {"body": []},
    "open_beam_on_the_interface": SMALL_OPEN | {"body": [BEAM]},
    "open_beam_on_the_surface": SMALL_OPEN | {"body": [BEAM | {"at": "surface"}]},
    "open_beams_on_both": SMALL_OPEN | {"body": [BEAM, beam(0.5, 0.35, 20.0, 10.0) | {"at": "surface"}]},
}


def surface_tank(scene: dict[str, Any]) -> surface.ReferenceTank:
    """The dimensionless tank under a lid, in units of the difference of densities."""
    length, gravity = scene["tank"]["length"], scene["tank"]["gravity"]
    lower, upper = scene["liquid"]
    step = lower["density"] - upper["density"]
    beams = tuple(
        surface.ReferenceBeam(
            start=body["start"] / length,
            end=(body["start"] + body["length"]) / length,
            rigidity=body["flexural_rigidity"] / (step * gravity * length**4),
            mass=body["mass_per_length"] / (step * length),
            restoring=float(body["hydrostatic"]),
        )
        for body in scene["body"]
    )
    return surface.ReferenceTank(
        depth=lower["depth"] / length,
        beams=beams,
        upper=(upper["density"] / lower["density"], upper["depth"] / length),
    )


def on_the_surface(scene: dict[str, Any]) -> list[np.ndarray]:
    """ω by `surface_reference`, coarser and finer."""
    unit = np.sqrt(scene["tank"]["gravity"] / scene["tank"]["length"])
    given = surface_tank(scene)
    finenesses = (surface.Fineness(), surface.Fineness().finer())
    return [unit * np.sqrt(surface.reference_modes(given, COUNT, fineness).eigenvalues) for fineness in finenesses]


def in_the_liquids(scene: dict[str, Any]) -> list[np.ndarray]:
    """ω by `float_reference`, coarser and finer."""
    # As many waves as the thinnest layer of a tank needs.
    waves = 60 if min(liquid["depth"] for liquid in scene["liquid"]) > 0.05 else 200
    finenesses = (Fineness(waves=waves), Fineness(waves=waves + 40, corner=28, bending=40))
    return [reference_modes(float_tank(scene), COUNT, fineness).omega for fineness in finenesses]


def solved(name: str) -> dict[str, Any]:
    """The entry of a tank."""
    scene = SCENES[name]
    methods = {"harmonic trial functions": in_the_liquids(scene)}
    if scene["tank"]["top"] == "rigid":
        methods["interface"] = on_the_surface(scene)
    best = list(methods.values())[-1][1]
    spread = np.max([abs(omega / best - 1) for pair in methods.values() for omega in pair], axis=0)
    finest = [pair[1] for pair in methods.values()]
    return {
        "scene": scene,
        "omega": [certain(value, distance) for value, distance in zip(best, spread, strict=True)],
        "self_convergence": {
            method: float(f"{abs(coarse / fine - 1).max():.1e}") for method, (coarse, fine) in methods.items()
        },
        "agreement": float(f"{abs(finest[0] / finest[1] - 1).max():.1e}") if len(finest) == 2 else None,
    }


def main() -> None:
    """Write the file."""
    cases = {}
    for name in SCENES:
        cases[name] = solved(name)
        print(name, cases[name]["self_convergence"], cases[name]["agreement"], *cases[name]["omega"], flush=True)
    PATH.write_text(json.dumps(HEADER | {"cases": cases}, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
