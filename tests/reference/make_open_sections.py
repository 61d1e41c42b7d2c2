"""Make open_sections.json: rectangular, trapezoidal and triangular floats in open water.

./hydro python tests/reference/make_open_sections.py
"""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

from open_sections import Water, section_answer

PATH = Path(__file__).with_name("open_sections.json")

HEADER = {
    "about": "Fixed or moving rigid floats of polygonal section in open water of one liquid, per metre of width, SI "
    "units, density 1000, gravity 9.81, exp(-i omega t), sway, heave, roll (anticlockwise about x = 0, y = 0).",
    "source": "Made for this list by tests/reference/make_open_sections.py: boundary integrals on the wetted sides "
    "(tests/support/open_sections.py).",
    "command": "./hydro python tests/reference/make_open_sections.py",
    "schema": {
        "corners": "from the left end of the waterplane round to the right end, m, y = 0 at the still surface",
        "depth": "m, null where infinite",
        "added_mass, damping": "3 x 3: sway, heave, roll; kg/m, kg, kg m and the same per second",
        "excitation": "complex force of a wave of unit elevation exp(i k x) at x = 0 that comes from the left",
        "error": "largest change of a number between polynomials of degree 7 and 9 in each panel, over the largest of "
        "its kind, or relative error of the energy balance",
    },
}

BOX = ((-0.5, 0.0), (-0.5, -0.5), (0.5, -0.5), (0.5, 0.0))
FLAT = ((-1.0, 0.0), (-1.0, -0.25), (1.0, -0.25), (1.0, 0.0))
SHIP = ((-0.6, 0.0), (-0.4, -0.4), (0.4, -0.4), (0.6, 0.0))
WEDGE = ((-0.5, 0.0), (0.0, -0.6), (0.5, 0.0))
CASES: tuple[tuple[tuple[tuple[float, float], ...], float | None, float], ...] = (
    (BOX, 1.0, 1.5),
    (BOX, 1.0, 3.5),
    (BOX, 3.0, 2.5),
    (BOX, None, 4.0),
    (FLAT, 0.5, 2.0),
    (FLAT, 2.0, 3.0),
    (SHIP, 1.2, 3.0),
    (WEDGE, 1.5, 3.0),
)


def solved(corners: tuple[tuple[float, float], ...], depth: float | None, omega: float) -> dict[str, Any]:
    """A row of the list."""
    water = Water(omega=omega, density=1000.0, depth=math.inf if depth is None else depth)
    coarse, fine = (section_answer(np.array(corners), water, order=order) for order in (8, 10))
    scale = np.sqrt(np.abs(np.diag(fine.impedance)))
    damping = fine.impedance.imag * omega
    errors = [
        np.max(np.abs(fine.impedance - coarse.impedance) / np.outer(scale, scale)),
        np.max(np.abs(fine.excitation - coarse.excitation) / np.abs(fine.excitation)),
        np.max(np.abs(fine.flux_damping / np.diag(damping) - 1)),
        1e-12,
    ]
    # Sway and roll do not meet heave in a symmetric section; what is left there is rounding.
    coupled = np.abs(fine.impedance) > 1e-8 * np.outer(scale, scale)
    return {
        "corners": corners,
        "depth": depth,
        "omega": omega,
        "added_mass": [[float(f"{v:.12g}") for v in row] for row in np.where(coupled, fine.impedance.real, 0.0)],
        "damping": [[float(f"{v:.12g}") for v in row] for row in np.where(coupled, damping, 0.0)],
        "excitation": [[float(f"{v.real:.12g}"), float(f"{v.imag:.12g}")] for v in fine.excitation],
        "error": float(f"{max(errors):.0e}"),
    }


def main() -> None:
    """Solve and write."""
    rows = []
    for case in CASES:
        rows.append(solved(*case))
        print(case, rows[-1]["damping"], rows[-1]["error"], flush=True)
    PATH.write_text(json.dumps(HEADER | {"cases": rows}, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
