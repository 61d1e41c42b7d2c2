"""Solids of revolution at sea beside every value of `reference/axisymmetric_sea.json`, with true and stated errors.

    ./hydro python tests/support/solid_references.py [TOLERANCE] [PART OF A NAME]

prints a line for each value, and at the end those that miss the tolerance or whose estimate is not between two thirds
of the true error and thirty times it, as far as the digits of the references tell. Plates are those of
`test_fem_round_plates.py`, cylinders on the bed those of `test_modal_round_bodies.py`.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from math import inf, sqrt
from typing import Any

import numpy as np
from open_cases import TOO_SMALL, complex_of
from solids_at_sea import CASES, GRAVITY, MOTIONS, bodies_of, depth_of, radiation, resonance, solved

GROUPS = ("hemisphere", "cylinder", "hemisphere_limits", "cylinder_limits", "multi", "resonance")
_TOO_LARGE = 30.0


@dataclass(frozen=True, kw_only=True)
class Compared:
    """A value beside its reference.

    Attributes:
        value: its name.
        known: the reference.
        found: the answer.
        scale: what errors are relative to.
        estimate: the stated relative error of added mass, damping and resonances; forces have none of their own.
        digits: of the reference.
    """

    value: str
    known: complex
    found: complex
    scale: float
    estimate: float
    digits: int

    @property
    def error(self) -> float:
        """True relative error."""
        return abs(self.found - self.known) / self.scale

    @property
    def unknown(self) -> float:
        """Relative error of the reference."""
        return 10.0 ** (1 - self.digits)

    @property
    def is_stated_too_small(self) -> bool:
        """Whether the error is above the estimate by more than the reference's."""
        return not self.is_force and self.error > TOO_SMALL * self.estimate + self.unknown

    @property
    def is_force(self) -> bool:
        """Whether it is an excitation force."""
        return self.value.startswith("force")


def compared(name: str, tolerance: float) -> list[Compared]:
    """Solve a case of the references and return all of its values."""
    case = CASES[name]
    match case["group"]:
        case "hemisphere" | "cylinder":
            return list(_frequency(case, tolerance))
        case "hemisphere_limits" | "cylinder_limits":
            return list(_limits(case, tolerance))
        case "multi":
            return list(_columns(case, tolerance))
        case _:
            return list(_resonance(case, tolerance))


def _frequency(case: dict[str, Any], tolerance: float) -> Iterator[Compared]:
    values = case["values"]
    motions, omega = MOTIONS if "added_mass_pitch" in values else MOTIONS[:2], values["omega"]
    table = solved(bodies_of(case), depth_of(case), tolerance, radiation(omega), motions=motions).radiation[0]
    found = table.added_mass[0] + 1j * table.radiation_damping[0] / omega
    known = {(one, one): values[f"added_mass_{one}"] + 1j * values[f"damping_{one}"] / omega for one in motions}
    if "pitch" in motions:
        known["surge", "pitch"] = values["added_mass_surge_pitch"] + 1j * values["damping_surge_pitch"] / omega
    for (one, other), value in known.items():
        yield Compared(
            value=f"{one} {other}",
            known=value,
            found=found[motions.index(one), motions.index(other)],
            scale=sqrt(abs(known[one, one] * known[other, other])),
            estimate=table.relative_error[0],
            digits=case["digits"],
        )
    for place, motion in enumerate(motions):
        force = complex(complex_of(values[f"excitation_{motion}"]))
        yield Compared(
            value=f"force {motion}",
            known=force,
            found=table.excitation_force[0, 0, 0, place],
            # Haskind: |X|² is as large as b. That of heave vanishes below a deep cylinder, and pitch nearly cancels.
            scale=max(abs(force), GRAVITY * 1e-3 * abs(known[motion, motion])),
            estimate=table.relative_error[0],
            digits=case["digits"],
        )


def _limits(case: dict[str, Any], tolerance: float) -> Iterator[Compared]:
    values = case["values"]
    is_sphere = case["group"] == "hemisphere_limits"
    motions = MOTIONS[:2] if is_sphere else MOTIONS
    table = solved(bodies_of(case), depth_of(case), tolerance, radiation(0.0, inf), motions=motions).radiation[0]
    pairs = {one: (one, one) for one in motions} | ({} if is_sphere else {"surge_pitch": ("surge", "pitch")})
    for row, limit in enumerate(("omega_0", "omega_inf")):
        for key, (one, other) in pairs.items():
            value = values.get(f"added_mass_{key}_{limit}", values.get(f"added_mass_{limit}_{key}"))
            if value is not None:
                places = motions.index(one), motions.index(other)
                own = np.diag(table.added_mass[row])[list(places)]
                yield Compared(
                    value=f"{limit} {key}",
                    known=value,
                    found=table.added_mass[row][places],
                    scale=float(np.sqrt(own.prod())),
                    estimate=table.relative_error[row],
                    digits=case["digits"],
                )


def _columns(case: dict[str, Any], tolerance: float) -> Iterator[Compared]:
    """Of columns that touch, as one body: the sum of all entries in heave."""
    values, columns = case["values"], case["inputs"]["list"]
    omega = values["omega"]
    touching = all(body is not None for _, _, body in columns)
    orders = [order for order in (0, 1) if f"motions_n{order}" in values]
    named = [name for order in orders for name in values[f"motions_n{order}"]]
    table = solved(
        [_compound(columns)] if touching else bodies_of(case),
        depth_of(case),
        tolerance,
        radiation(omega),
        motions=tuple(motion for motion in MOTIONS if any(name.endswith(motion) for name in named)),
    ).radiation[0]
    for order in orders:
        known = np.array(values[f"added_mass_n{order}"]) + 1j * np.array(values[f"damping_n{order}"]) / omega
        force = complex_of(values[f"excitation_n{order}"])
        if touching:
            known, force = known.sum(keepdims=True), force.sum(keepdims=True)
        own = [place for place, dof in enumerate(table.dofs) if str(dof).endswith("heave") == (order == 0)]
        found = (table.added_mass[0] + 1j * table.radiation_damping[0] / omega)[np.ix_(own, own)]
        sizes = np.sqrt(np.abs(np.diag(known)))
        entries = [
            (f"{table.dofs[own[row]]} {table.dofs[own[column]]}", known[row, column], found[row, column], scale)
            for (row, column), scale in np.ndenumerate(np.outer(sizes, sizes))
            if row <= column
        ]
        for place, one in enumerate(own):
            answer = table.excitation_force[0, 0, 0, one]
            entries.append((f"force {table.dofs[one]}", force[place], answer, float(np.abs(force).max())))
        for name, reference, answer, scale in entries:
            yield Compared(
                value=name,
                known=reference,
                found=answer,
                scale=scale,
                estimate=table.relative_error[0],
                digits=case["digits"],
            )


def _compound(columns: list[list[float]]) -> dict[str, Any]:
    outline, inner = [], 0.0
    for outer, draught, _ in columns:
        outline += [[inner, -draught], [outer, -draught]]
        inner = outer
    return {"shape": "revolved", "outline": [*outline, [inner, 0.5], [0.0, 0.5]]}


def _resonance(case: dict[str, Any], tolerance: float) -> Iterator[Compared]:
    table = solved(bodies_of(case), depth_of(case), tolerance, resonance(count=1), motions=("heave",)).resonance[0]
    known = complex(complex_of(case["values"]["omega"]))
    yield Compared(
        value="heave",
        known=known,
        found=table.omega[0],
        scale=abs(known),
        estimate=table.relative_error[0],
        digits=case["digits"],
    )


def main(tolerance: float, part: str) -> None:
    """Print all values."""
    missed: list[str] = []
    for name in (name for name, case in CASES.items() if case["group"] in GROUPS and part in name):
        start = time.process_time()
        rows = compared(name, tolerance)
        seconds = time.process_time() - start
        for row in rows:
            ratio = row.estimate / row.error if row.error else inf
            line = (
                f"{name:40s} {row.value:30s} {row.found:28.10g} {row.known:28.10g} {row.error:9.1e} {row.estimate:9.1e}"
                f" {ratio:9.1f} {seconds:6.2f}"
            )
            print(line, flush=True)
            # An estimate is that of the worst of the values that are solved together.
            worst = max(other.error for other in rows if other.estimate == row.estimate and not other.is_force)
            is_too_large = row.error == worst and row.estimate > _TOO_LARGE * (worst + row.unknown)
            if row.error > tolerance + row.unknown or row.is_stated_too_small or is_too_large:
                missed.append(line)
    print("\nmissed, or not between two thirds and thirty times:", *(missed or ["none"]), sep="\n")


if __name__ == "__main__":
    main(float(sys.argv[1]) if len(sys.argv) > 1 else 1e-6, sys.argv[2] if len(sys.argv) > 2 else "")
