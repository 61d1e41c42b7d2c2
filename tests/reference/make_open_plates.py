"""Make open_plates.json: elastic plates drawn at random on open water, in waves from the left.

./hydro python tests/reference/make_open_plates.py
"""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

from open_levels import one_liquid
from open_plates import plate_of, scattering

PATH = Path(__file__).with_name("open_plates.json")
POINTS = np.linspace(0, 1, 11)

HEADER = {
    "about": "Elastic plates of zero draught with free ends on one liquid, drawn at random, per metre of width, SI "
    "units, gravity 9.81. A wave of unit elevation exp(i k x - i omega t) comes from the left, x = 0 is the left end "
    "of the plate.",
    "source": "Made for this list by tests/reference/make_open_plates.py: an integral equation along the plate "
    "(tests/support/open_plates.py).",
    "command": "./hydro python tests/reference/make_open_plates.py",
    "schema": {
        "depth": "m, null where infinite",
        "segments": "from left to right: length m, rigidity EI N m, mass kg/m2",
        "joints": "rotational springs between the segments, N m/rad: 0 a hinge, null none (slope is continuous)",
        "reflected, transmitted": "complex elevations, real and imaginary part, of exp(-i k x) and exp(i k x)",
        "deflection": "complex, at 11 points of equal distance from the left end to the right end",
        "error": "largest change of these numbers between polynomials of degree 13 and 17 in each panel, or of "
        "|R|^2 + |T|^2 from 1",
    },
}


def drawn(number: int) -> dict[str, Any]:
    """A plate, liquid and frequency: 12 uniform ones, then 8 of two or three segments."""
    random = np.random.default_rng(7000 + number)

    def between(low: float, high: float) -> float:
        """Evenly in the logarithm, to three digits."""
        return float(f"{low * (high / low) ** random.random():.3g}")

    length, density = between(0.5, 400), float(random.choice([1000.0, 1025.0]))
    depth = None if number % 4 == 3 else float(f"{length * between(0.1, 2):.3g}")
    wave_number = 2 * math.pi / (length * between(0.25, 3))
    steepness = 1.0 if depth is None else math.tanh(wave_number * depth)
    count = 1 if number < 12 else 2 + number % 2
    parts = np.diff(np.concatenate([[0], np.sort(0.15 + 0.7 * random.random(count - 1)), [1]]))
    rigidity, mass = density * 9.81 * (length * between(0.04, 0.6)) ** 4, density * length * between(1e-3, 2e-2)
    segments = [
        {
            "length": float(f"{length * part:.4g}"),
            "rigidity": float(f"{rigidity * (between(0.02, 1) if number % 3 else 1.0):.4g}"),
            "mass": float(f"{mass * (between(0.3, 3) if number % 3 else 1.0):.4g}"),
        }
        for part in parts
    ]
    springs = [0.0, float(f"{rigidity / length * between(0.1, 10):.4g}"), None]
    joints = [springs[(number + joint) % 3] for joint in range(count - 1)]
    omega = float(f"{math.sqrt(9.81 * wave_number * steepness):.5g}")
    return {"density": density, "depth": depth, "omega": omega, "segments": segments, "joints": joints}


def solved(number: int) -> dict[str, Any]:
    """A row of the list."""
    row = drawn(number)
    depth = math.inf if row["depth"] is None else row["depth"]
    level, plate = one_liquid(row["omega"], density=row["density"], depth=depth), plate_of(row)
    results = [scattering(plate, level, POINTS * plate.length, order=order) for order in (14, 18)]
    coarse, fine = (np.concatenate([r.reflected, r.transmitted, r.deflection]) for r in results)
    energy = abs(np.sum(np.abs(fine[:2]) ** 2) - 1)
    error = max(np.max(np.abs(fine - coarse)), energy, 1e-13)
    pairs = [[float(f"{value.real:.13g}"), float(f"{value.imag:.13g}")] for value in fine]
    return (
        {"number": number + 1}
        | row
        | {
            "reflected": pairs[0],
            "transmitted": pairs[1],
            "deflection": pairs[2:],
            "error": float(f"{error:.0e}"),
        }
    )


def main() -> None:
    """Solve and write."""
    rows = []
    for number in range(20):
        rows.append(solved(number))
        print(number + 1, rows[-1]["depth"], rows[-1]["joints"], math.hypot(*rows[-1]["reflected"]), rows[-1]["error"])
    PATH.write_text(json.dumps(HEADER | {"plates": rows}, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
