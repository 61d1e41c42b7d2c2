"""Make floats.json: reference frequencies of tanks with rigid floats in one or two liquids.

    ./hydro python tests/reference/make_floats.py [NAME ...]

Each tank is solved twice by `float_reference` (tests/), with few and with many trial functions; the finer values are
stored to the digits that both share, with their distance. With names, only these are made anew. How far boundary
integrals were, a second method, is kept from the first table, of version 0.1.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

from float_added_mass import high_frequency_added_mass
from float_reference import reference_modes
from float_tanks import Fineness, FloatTank, float_tank

PATH = Path(__file__).with_name("floats.json")
COUNT = 6
MOST_DIGITS = 12
LIGHT = 1e4
"""Modal masses above this many times the mass of the float are not stored: the float hardly moves there."""

HEADER = {
    "about": "Closed 2-D tanks with rigid floats in one or two liquids, per metre of width, SI units. Exact linear "
    "theory: Laplace's equation in each liquid up to the float's own surface at rest.",
    "source": "Made for this catalogue by tests/reference/make_floats.py: Ritz's method with harmonic trial functions, "
    "poles that cluster at corners and powers of corners (tests/support/float_reference.py).",
    "command": "./hydro python tests/reference/make_floats.py",
    "schema": {
        "scene": "keys as in docs/scenes.md; liquids from the bottom up",
        "omega": "lowest frequencies, rad/s, without those that are zero, to the digits that are certain",
        "self_convergence": "largest relative difference of omega between a coarser and a finer solution",
        "agreement": "largest relative difference of omega from a second method, boundary integrals on the whole "
        "boundary, when the table was first made; null where it does not apply",
        "floats": "per float, from left to right: mass kg/m, inertia about the centre of mass kg m, centre of mass m "
        "(y = 0 is the still level), ends of the waterplane m, stiffness of heave, sway and roll (anticlockwise)",
        "added_mass": "at the highest frequencies (psi = 0 on a free surface, rho psi continuous at the interface, the "
        "tank as it is), per motion and motion, kg/m, kg or kg m; null with beams",
        "modal_masses": "per motion, in the order of the floats and of their motions, and per mode: twice the kinetic "
        "energy of the mode over the square of the velocity of this motion, kg/m or kg m; null where it hardly moves",
    },
}


def tank(length: float, *liquids: tuple[float, float], top: str = "free") -> dict[str, Any]:
    """A tank of liquids given by density and depth."""
    return {
        "tank": {"length": length, "gravity": 9.81, "top": top},
        "liquid": [{"density": density, "depth": depth} for density, depth in liquids],
    }


def rigid(shape: str, position: float, motions: str = "heave", **keys: Any) -> dict[str, Any]:
    """A float."""
    return {"kind": "float", "shape": shape, "position": position, "motions": motions.split()} | keys


def beam(start: float, length: float, rigidity: float, mass: float, **keys: Any) -> dict[str, Any]:
    """A beam."""
    return {
        "kind": "beam",
        "start": start,
        "length": length,
        "flexural_rigidity": rigidity,
        "mass_per_length": mass,
        "hydrostatic": True,
    } | keys


ALL = "heave sway roll"
CIRCLE: dict[str, Any] = {"half_width": 0.4, "half_height": 0.4}
SHIP = [[-0.5, -0.1], [-0.3, -0.3], [0.2, -0.3], [0.45, -0.05], [0.5, 0.25], [-0.5, 0.25]]
ONE = tank(4.0, (1000.0, 1.5))
LID = tank(3.0, (1000.0, 1.2), (800.0, 0.8), top="rigid")
CLOSE = tank(3.0, (1000.0, 1.2), (990.0, 0.8), top="rigid")
OPEN = tank(3.0, (1000.0, 1.2), (800.0, 0.8), top="free")

SCENES: dict[str, dict[str, Any]] = {
    "circle": ONE | {"body": [rigid("ellipse", 2.0, **CIRCLE)]},
    "circle_all_motions": ONE | {"body": [rigid("ellipse", 2.0, ALL, centre_of_mass=-0.1, **CIRCLE)]},
    "circle_off_centre": ONE | {"body": [rigid("ellipse", 1.3, ALL, centre_of_mass=-0.1, **CIRCLE)]},
    "ellipse_heavy": ONE | {"body": [rigid("ellipse", 1.3, ALL, mass=250.0, half_width=0.4, half_height=0.25)]},
    "rectangle": ONE | {"body": [rigid("rectangle", 2.0, half_width=0.4, half_height=0.3)]},
    "rectangle_off_centre": ONE | {"body": [rigid("rectangle", 1.1, ALL, half_width=0.4, half_height=0.2)]},
    "wedge": ONE | {"body": [rigid("wedge", 2.0, half_width=0.3, half_height=0.5)]},
    "ship": ONE | {"body": [rigid("polygon", 1.4, ALL, vertices=SHIP, centre_of_mass=0.02)]},
    "two_floats": ONE
    | {
        "body": [
            rigid("ellipse", 1.1, half_width=0.4, half_height=0.3),
            rigid("rectangle", 2.7, ALL, half_width=0.4, half_height=0.2),
        ]
    },
    "two_liquids_ellipse": LID | {"body": [rigid("ellipse", 1.5, half_width=0.2, half_height=0.4)]},
    "two_liquids_ellipse_close": CLOSE | {"body": [rigid("ellipse", 1.2, half_width=0.3, half_height=0.2)]},
    "two_liquids_wedge": LID | {"body": [rigid("wedge", 1.5, half_width=0.2, half_height=0.4)]},
    "two_liquids_wedge_close": CLOSE | {"body": [rigid("wedge", 1.2, half_width=0.2, half_height=0.4)]},
    "two_liquids_parabola": LID | {"body": [rigid("parabola", 1.5, half_width=0.1, half_height=0.5)]},
    "two_liquids_rectangle": LID | {"body": [rigid("rectangle", 1.1, ALL, half_width=0.3, half_height=0.2)]},
    "two_liquids_ship": LID | {"body": [rigid("polygon", 1.4, ALL, vertices=SHIP, centre_of_mass=-0.1, mass=440.0)]},
    "two_liquids_1_to_100": tank(1.0, (1000.0, 2.0), (800.0, 0.02), top="rigid")
    | {"body": [rigid("ellipse", 0.5, half_width=0.05, half_height=0.01)]},
    "two_liquids_open": OPEN | {"body": [rigid("ellipse", 1.3, ALL, half_width=0.4, half_height=0.3)]},
    "two_liquids_float_and_beam": LID
    | {"body": [rigid("ellipse", 0.8, half_width=0.3, half_height=0.3), beam(1.5, 1.0, 50.0, 4.0)]},
    "two_liquids_open_float_and_beam": OPEN
    | {
        "body": [
            rigid("rectangle", 0.8, half_width=0.3, half_height=0.2),
            beam(1.5, 1.0, 50.0, 4.0, at="surface"),
        ]
    },
    "thin_wedge": ONE | {"body": [rigid("wedge", 1.3, half_width=0.1, half_height=0.5, boundary="thin")]},
    "two_liquids_thin_parabola": LID
    | {"body": [rigid("parabola", 1.2, half_width=0.1, half_height=0.5, boundary="thin")]},
    "two_liquids_thin_wedge_close": CLOSE
    | {"body": [rigid("wedge", 1.2, half_width=0.1, half_height=0.4, boundary="thin")]},
}

FINENESS = {
    "two_liquids_1_to_100": (Fineness(waves=150), Fineness(corner=26, waves=220, inner=50, powers=8)),
}
USUAL = (Fineness(inner=48), Fineness(corner=26, waves=90, inner=60, powers=8))


def certain(value: float, distance: float) -> str:
    """A value to the digits that two solutions share."""
    digits = int(np.clip(-np.log10(2 * max(distance, 1e-16)), 1, MOST_DIGITS))
    return f"{value:#.{digits}g}"


def matrix_of(coarse: np.ndarray, fine: np.ndarray) -> list[list[str]]:
    """A symmetric matrix to the digits that two solutions share, beside its diagonal; zeros by symmetry as 0."""
    scale = np.sqrt(np.diag(fine))
    sizes, distances = np.abs(fine) / np.outer(scale, scale), np.abs(coarse - fine) / np.outer(scale, scale)
    return [
        ["0" if size < 1e-11 else certain(value, distance / size) for value, size, distance in zip(*row, strict=True)]
        for row in zip(fine, sizes, distances, strict=True)
    ]


def floats_of(scene_tank: FloatTank) -> list[dict[str, Any]]:
    """What a float is at rest."""
    return [
        {
            "mass": part.mass,
            "inertia": float(part.inertia),
            "centre": [part.centre.real, part.centre.imag],
            "ends": [float(end) for end in part.ends],
            "stiffness": part.stiffness.tolist(),
        }
        for part, _ in scene_tank.sections
    ]


def solved(name: str, agreement: float | None) -> dict[str, Any]:
    """The entry of a tank."""
    scene = SCENES[name]
    given = float_tank(scene)
    finenesses = FINENESS.get(name, USUAL)
    coarse, fine = (reference_modes(given, COUNT, fineness) for fineness in finenesses)
    distances = np.abs(coarse.omega / fine.omega - 1)
    rows = []
    owners = [part for part, motions in given.sections for _ in motions]
    for part, before, after in zip(owners, coarse.modal_masses, fine.modal_masses, strict=False):
        rows.append(
            [
                certain(value, abs(other / value - 1)) if value < LIGHT * part.mass else None
                for other, value in zip(before, after, strict=True)
            ]
        )
    motions = [motion for _, moving in given.sections for motion in moving]
    loaded = [] if given.beams else [high_frequency_added_mass(given, fineness).matrix for fineness in finenesses]
    return {
        "scene": scene,
        "floats": floats_of(given),
        "omega": [certain(value, distance) for value, distance in zip(fine.omega, distances, strict=True)],
        "self_convergence": float(f"{distances.max():.1e}"),
        "agreement": agreement,
        "modal_masses": rows,
        "motions": motions,
        "added_mass": matrix_of(*loaded) if loaded else None,
        "unknowns": [coarse.size, fine.size],
    }


def main(names: list[str]) -> None:
    """Write the file, or renew some of its cases."""
    stored = json.loads(PATH.read_text(encoding="utf-8"))["cases"] if PATH.exists() else {}
    cases = dict(stored) if names else {}
    for name in names or SCENES:
        cases[name] = solved(name, stored.get(name, {}).get("agreement"))
        print(name, cases[name]["self_convergence"], *cases[name]["omega"], flush=True)
        ordered = {name: cases[name] for name in SCENES if name in cases}
        PATH.write_text(json.dumps(HEADER | {"cases": ordered}, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
