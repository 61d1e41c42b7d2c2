"""Make hard_cases.json: reference frequencies of the hard cases and of tanks drawn at random.

    ./hydro python tests/reference/make_hard_cases.py [NAME ...]

Computed cases are solved twice by `surface_reference` (tests/), the second time with a higher degree, smaller panels
and more bending polynomials; the finer values are stored, with the distance of the coarser ones. With names, only these
cases are made anew, "random" for the tanks at random. It takes about half an hour on one core.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

from hard_cases import CASES
from random_tanks import draw_tanks
from surface_reference import (
    KINDS,
    Fineness,
    ReferenceModes,
    ReferenceTank,
    reference_modes,
    reference_tank,
    without_waves,
)

from hydroelastic.scenes.models.tank import TankScene

PATH = Path(__file__).with_name("hard_cases.json")
RANDOM_SEED, RANDOM_COUNT = 20260, 32
# A kind or a tone is stored where its share leads the next by this much, and the mode's λ differs from its neighbours'
# by as much as makes its shape its own.
CLEAR_LEAD, CLEAR_GAP = 0.05, 1e-4

HEADER = {
    "source": "Made for this catalogue by tests/reference/make_hard_cases.py: Galerkin's method on the surface alone, "
    "with the exact kernel of docs/theory_aquarium.md, section 0, on geometric panels "
    "(tests/support/surface_reference.py); closed forms for tanks without a beam or with a guided cover.",
    "command": "./hydro python tests/reference/make_hard_cases.py",
    "schema": {
        "scene": "the tank as a scene (docs/scenes.md), defaults left out",
        "omega": "lowest frequencies, rad/s, without those that are zero",
        "unknowns": "of the coarser and of the finer solution; absent for a closed form",
        "self_convergence": "largest relative difference of omega between them",
        "kinds": "group of the largest potential energy per mode, null where it does not lead clearly",
        "tone": "first elastic tone of the first beam: number of the mode, from 1, rad/s, participation",
        "pressure_release": "per beam, in the order of the scene: first elastic tone with psi = 0 on the water, rad/s, "
        "and its self-convergence; null where no mode clearly is it, or there is no such water",
    },
}


def frequencies(scene: TankScene, eigenvalues: np.ndarray) -> np.ndarray:
    """ω in rad/s of λ in g/L."""
    return np.sqrt(eigenvalues * scene.tank.gravity / scene.tank.length)


def closed_form(scene: TankScene) -> np.ndarray | None:
    """ω² = gk tanh kH without a beam; (EI k⁴ + sρg)/(m + ρ/(k tanh kH)) under a guided cover; k = nπ/L."""
    wavenumbers = np.pi * np.arange(1, scene.accuracy.modes + 1) / scene.tank.length
    gravity, density = scene.tank.gravity, scene.liquid[0].density
    inertia = 1.0 / (wavenumbers * np.tanh(wavenumbers * scene.liquid[0].depth))
    if not scene.body:
        return np.sqrt(gravity / inertia)
    (beam, *others) = scene.body
    if others or beam.ends != "guided":
        return None
    stiffness = beam.flexural_rigidity * wavenumbers**4 + float(beam.hydrostatic) * density * gravity
    return np.sqrt(stiffness / (beam.mass_per_length + density * inertia))


def twice(tank: ReferenceTank, count: int) -> tuple[ReferenceModes, ReferenceModes]:
    """A coarser and a finer solution."""
    return reference_modes(tank, count), reference_modes(tank, count, Fineness().finer())


def clear_kinds(modes: ReferenceModes) -> list[str | None]:
    """The kind of each mode, where it is clear and the mode is not one of a close pair."""
    ordered = np.sort(modes.shares, axis=0)
    leads = ordered[-1] - ordered[-2] > CLEAR_LEAD
    apart = np.diff(modes.eigenvalues) > CLEAR_GAP * modes.eigenvalues[1:]
    alone = np.r_[True, apart] & np.r_[apart, True]
    names = [KINDS[kind] for kind in modes.shares.argmax(axis=0)]
    return [name if clear else None for name, clear in zip(names, leads & alone, strict=True)]


def clear_tone(participations: np.ndarray) -> int | None:
    """Which mode is a beam's first elastic tone, from 0, if it leads the others and what lies above them clearly."""
    best, second = np.sort(participations)[::-1][:2]
    rest = 1.0 - participations.sum()
    return int(participations.argmax()) if best - max(second, rest) > CLEAR_LEAD else None


def pressure_release(scene: TankScene) -> list[dict[str, float] | None]:
    """The first elastic tones with ψ = 0 on the water."""
    tank = reference_tank(scene)
    if scene.tank.top != "free" or not tank.water:
        return [None] * len(scene.body)
    coarse, fine = twice(without_waves(tank), 6 * len(scene.body))
    place = {index: number for number, index in enumerate(np.argsort([beam.start for beam in scene.body]))}
    tones: list[dict[str, float] | None] = []
    for body in range(len(scene.body)):
        index = clear_tone(fine.participations[place[body]])
        if index is None:
            tones.append(None)
            continue
        omega = frequencies(scene, fine.eigenvalues[index])
        distance = abs(frequencies(scene, coarse.eigenvalues[index]) / omega - 1.0)
        tones.append({"omega": float(omega), "self_convergence": float(distance)})
    return tones


def solved(scene: TankScene, *, tone_within: int = 0) -> dict[str, Any]:
    """The entry of a scene."""
    entry: dict[str, Any] = {"scene": scene.model_dump(mode="json", exclude_defaults=True)}
    exact = closed_form(scene)
    if exact is not None:
        return entry | {"omega": exact.tolist(), "self_convergence": 0.0}
    tank = reference_tank(scene)
    asked = scene.accuracy.modes
    # One mode more, to see whether the last one asked for has a neighbour.
    coarse, fine = twice(tank, max(asked + 1, tone_within))
    omega = frequencies(scene, fine.eigenvalues)
    distances = np.abs(frequencies(scene, coarse.eigenvalues) / omega - 1.0)
    entry |= {
        "omega": omega[:asked].tolist(),
        "unknowns": [coarse.size, fine.size],
        "self_convergence": float(distances.max()),
        "kinds": clear_kinds(fine)[:asked],
        "pressure_release": pressure_release(scene),
    }
    if tone_within:
        index = clear_tone(fine.participations[0])
        if index is None:
            raise ValueError("no mode clearly is the first elastic tone of this scene")
        participation = float(fine.participations[0, index])
        entry["tone"] = {"index": index + 1, "omega": float(omega[index]), "participation": participation}
    return entry


def main() -> None:
    """Make the cases named on the command line, or all."""
    stored = json.loads(PATH.read_text(encoding="utf-8")) if PATH.exists() else {"cases": {}, "random": []}
    wanted = sys.argv[1:] or [*(case.name for case in CASES), "random"]
    cases = {name: entry for name, entry in stored["cases"].items() if name in {case.name for case in CASES}}
    for case in CASES:
        if case.name in wanted:
            cases[case.name] = solved(case.scene, tone_within=case.tone_within)
            print(f"{case.name}: self-convergence {cases[case.name]['self_convergence']:.1e}", flush=True)
    cases = {case.name: cases[case.name] for case in CASES if case.name in cases}
    random = stored["random"]
    if "random" in wanted:
        random = []
        for number, scene in enumerate(draw_tanks(RANDOM_SEED, RANDOM_COUNT)):
            random.append(solved(scene))
            print(f"random {number}: self-convergence {random[-1]['self_convergence']:.1e}", flush=True)
    PATH.write_text(json.dumps(HEADER | {"cases": cases, "random": random}, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
