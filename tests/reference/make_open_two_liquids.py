"""Make open_two_liquids.json: plates on the surface or on the interface of two liquids in open water.

./hydro python tests/reference/make_open_two_liquids.py
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

from open_plates import Plate, Segment, rigid_radiation, scattering
from open_two_liquids import TwoLiquids

PATH = Path(__file__).with_name("open_two_liquids.json")
POINTS = np.linspace(0, 1, 11)

HEADER = {
    "about": "Plates of zero draught on the free surface or on the interface of two liquids, per metre of width, SI "
    "units, gravity 9.81, exp(-i omega t), x = 0 at the left end of the plate. Waves in ascending wave number: with a "
    "free top the surface wave, then the interface wave; with a lid the interface wave alone. All elevations are those "
    "of the level on which the plate lies.",
    "source": "Made for this list by tests/reference/make_open_two_liquids.py: an integral equation along the plate "
    "(tests/support/open_plates.py, tests/support/open_two_liquids.py).",
    "command": "./hydro python tests/reference/make_open_two_liquids.py",
    "schema": {
        "densities, depths": "below, above: kg/m3, m",
        "top": "free or lid",
        "level": "where the plate lies",
        "wave_numbers": "1/m",
        "interface_over_surface": "elevation of the interface over that of the surface, per wave; null under a lid",
        "flux": "mean energy flux of each wave of unit elevation at the level, W/m per m2",
        "evanescent": "lowest decay rates 1/m of the modes exp(-kappa |x|)",
        "plate": "length m, rigidity EI N m, mass kg/m2, free ends",
        "waves_in": "per incident wave exp(i k x) of unit elevation: complex elevations of all waves exp(-i k x) "
        "(reflected) and exp(i k x) (transmitted), complex deflection at 11 points of equal distance",
        "rigid": "a rigid plate of the same length: added mass and damping of heave and of pitch about the middle "
        "(anticlockwise); complex elevations of the waves exp(-i k x) and exp(i k x) per unit motion",
        "error": "largest relative change of these numbers between polynomials of degree 13 and 17 in each panel, or "
        "relative error of the energy balance",
    },
}

CASES = [
    # ρ₁/ρ₂, depths, top, level, ω, length, bending length over length, mass over ρ₂ length
    (0.5, (1.2, 0.5), "free", "surface", 2.5, 1.5, 0.2, 0.01),
    (0.5, (1.2, 0.5), "free", "interface", 2.5, 1.5, 0.2, 0.01),
    (0.5, (1.2, 0.5), "lid", "interface", 3.0, 2.0, 0.1, 0.005),
    (0.5, (0.6, 1.0), "free", "surface", 4.0, 1.0, 0.15, 0.02),
    (0.9, (1.2, 0.5), "free", "surface", 0.8, 2.0, 0.1, 0.01),
    (0.9, (1.2, 0.5), "free", "interface", 1.2, 1.5, 0.15, 0.01),
    (0.9, (0.5, 1.0), "lid", "interface", 1.0, 1.0, 0.3, 0.02),
    (0.99, (1.0, 0.4), "free", "surface", 0.2, 2.0, 0.1, 0.005),
    (0.99, (1.0, 0.4), "free", "interface", 0.3, 2.0, 0.1, 0.005),
    (0.99, (1.0, 1.0), "lid", "interface", 0.4, 1.5, 0.2, 0.01),
]


def pairs(values: np.ndarray) -> Any:
    """Real and imaginary parts to 13 digits, nested as the array is."""
    if values.ndim == 0:
        return [float(f"{part:.13g}") for part in (values.real, values.imag)]
    return [pairs(value) for value in values]


def solved(case: tuple[Any, ...]) -> dict[str, Any]:
    """A row of the list."""
    ratio, depths, top, place, omega, length, bending, mass = case
    liquids = TwoLiquids(densities=(1000.0, 1000.0 * ratio), depths=depths, lid=top == "lid")
    level = liquids.surface(omega) if place == "surface" else liquids.interface(omega)
    segment = Segment(
        length=length,
        rigidity=float(f"{level.stiffness * (bending * length) ** 4:.4g}"),
        mass=1000 * mass * length,
    )
    flux = omega / 4 / level.residues
    errors, rows = [1e-13], []
    for wave in range(len(flux)):
        coarse, fine = (scattering(Plate((segment,)), level, POINTS * length, wave, order=order) for order in (14, 18))
        outgoing = np.concatenate([fine.reflected, fine.transmitted])
        errors.append(np.max(np.abs(fine.deflection - coarse.deflection)))
        errors.append(np.max(np.abs(outgoing - np.concatenate([coarse.reflected, coarse.transmitted]))))
        errors.append(abs(np.tile(flux, 2) @ np.abs(outgoing) ** 2 / flux[wave] - 1))
        rows.append({name: pairs(getattr(fine, name)) for name in ("reflected", "transmitted", "deflection")})
    (before, _), (impedance, waves) = (rigid_radiation(length, level, order) for order in (14, 18))
    damping = np.diag(impedance.imag) * omega
    errors.append(np.max(np.abs(np.diag(impedance - before) / np.diag(impedance))))
    errors.append(np.max(np.abs(np.einsum("w,dwm->m", flux, np.abs(waves) ** 2) * 2 / omega**2 / damping - 1)))
    return {
        "densities": liquids.densities,
        "depths": depths,
        "top": top,
        "level": place,
        "omega": omega,
        "wave_numbers": list(level.wave_numbers),
        "interface_over_surface": None if liquids.lid else list(liquids.interface_over_surface(omega)),
        "flux": list(flux),
        "evanescent": list(liquids.evanescent(omega, 6)),
        "plate": {"length": length, "rigidity": segment.rigidity, "mass": segment.mass},
        "waves_in": rows,
        "rigid": {
            "added_mass": [float(f"{value:.13g}") for value in np.diag(impedance.real)],
            "damping": [float(f"{value:.13g}") for value in damping],
            "waves": {"left": pairs(waves[0]), "right": pairs(waves[1])},
        },
        "error": float(f"{max(errors):.0e}"),
    }


def main() -> None:
    """Solve and write."""
    rows = []
    for case in CASES:
        rows.append(solved(case))
        print(case, rows[-1]["wave_numbers"], rows[-1]["interface_over_surface"], rows[-1]["error"], flush=True)
    PATH.write_text(json.dumps(HEADER | {"cases": rows}, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
