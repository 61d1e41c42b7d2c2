"""Make open_circle.json: a half-immersed circle in open water of infinite depth.

./hydro python tests/reference/make_open_circle.py
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

from open_circle import MOTIONS, radiation, release, resonance

PATH = Path(__file__).with_name("open_circle.json")
SQUARES = (1e-4, 1e-3, 0.01, 0.03, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9, 1.1, 1.4, 1.8, 2.4, 3.2, 4.5, 6.0, 8.0, 10.0)
TIMES = (0.5, 1.0, 2.0, 3.0, 5.0, 8.0, 12.0, 16.0, 20.0, 30.0, 40.0, 60.0, 80.0, 120.0, 160.0)

HEADER = {
    "about": "Half-immersed circular cylinder of radius a, one liquid of infinite depth, waves leave on both sides, "
    "exp(-i omega t). Linear theory, per metre of width.",
    "source": "Made for this list by tests/reference/make_open_circle.py: Ursell's multipoles with 400 or 800 terms, "
    "extrapolated (tests/support/open_circle.py).",
    "command": "./hydro python tests/reference/make_open_circle.py",
    "schema": {
        "radiation": "Ka = omega^2 a/g; added mass over rho pi a^2/2, damping over rho omega pi a^2/2; error: change "
        "from 400 to 800 terms or distance of the damping from the energy flux, the larger one, at least 1e-14",
        "resonance": "omega - i gamma in sqrt(g/a), freely heaving, mass rho pi a^2/2; error as above",
        "release": "t in sqrt(a/g), s(t)/s(0) of the same body let go in still water; error: change from 104 to 200 "
        "terms; its tail is -(4/pi)/t^2",
    },
}


def radiation_row(square: float) -> dict[str, Any]:
    """Added masses and damping with their error."""
    row: dict[str, Any] = {"Ka": square}
    error = 1e-14
    for motion in MOTIONS:
        fine, coarse = (radiation(square, motion, count) for count in (800, 400))
        error = max(error, abs(fine.impedance - coarse.impedance), abs(fine.impedance.imag - fine.flux_damping))
        row |= {f"{motion}_a": fine.impedance.real, f"{motion}_b": fine.impedance.imag}
    return row | {"error": float(f"{error:.0e}")}


def main() -> None:
    """Solve and write."""
    fine, coarse = resonance(800), resonance(400)
    moved, before = release(np.array(TIMES)), release(np.array(TIMES), 104)
    content = HEADER | {
        "radiation": [radiation_row(square) for square in SQUARES],
        "resonance": {"omega": fine.real, "gamma": -fine.imag, "error": float(f"{abs(fine - coarse):.0e}")},
        "release": {
            "t": TIMES,
            "s": [float(f"{value:.12g}") for value in moved],
            # The integral ends at ω = 14: 4e-12.
            "error": float(f"{4e-12 + np.max(np.abs(moved - before)):.0e}"),
        },
    }
    PATH.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
