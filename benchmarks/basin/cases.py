"""The basin: a soft plate in the middle of a box, its cases, and its frequencies."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydroelastic.benchmarks.cases import Case
from hydroelastic.physics.level_tank import Box, LevelTank
from hydroelastic.physics.plate import Plate, Rectangle

TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
# Degree, and size of the cells at the plate's edge in m.
VOLUMES = ((2, 0.5), (3, 0.5), (3, 0.3), (3, 0.15))
# Degree on the plan; layers follow from it.
PLANS = (3, 4, 5)


@dataclass(frozen=True, kw_only=True)
class Basin:
    """A basin and its twelve lowest frequencies.

    Attributes:
        name: as cases name it.
        tank: in SI units; the plate lies in the middle.
        omega: rad/s, ascending: cases of the project's tests/reference/three_dimensions.json, 10 digits at least.
    """

    name: str
    tank: LevelTank
    omega: tuple[float, ...]


BASINS = (
    Basin(
        name="soft plate",
        tank=LevelTank(
            plan=Box(length=10.0, width=8.0),
            depth=3.0,
            density=1000.0,
            gravity=9.81,
            plates=(
                Plate(
                    outline=Rectangle(position=(5.0, 4.0), size=(6.0, 4.0)),
                    flexural_rigidity=50.0,
                    mass_per_area=20.0,
                ),
            ),
        ),
        omega=(
            1.505931560666849,
            1.784122945801745,
            2.1145622053417856,
            2.4226110482730743,
            2.6632472957234383,
            2.7453332999362945,
            2.8597338691518788,
            3.0225617244615233,
            3.1280087052237224,
            3.155359164569122,
            3.3864184081929265,
            3.4513560083234682,
        ),
    ),
)


def basin_named(name: str) -> Basin:
    """The basin of that name."""
    return {basin.name: basin for basin in BASINS}[name]


def basin_error(name: str, values: tuple[float, ...]) -> float:
    """Largest relative error of the frequencies."""
    return float(np.abs(np.array(values) / np.array(basin_named(name).omega) - 1.0).max())


def basin_cases(basin: Basin, *, quick: bool) -> tuple[Case, ...]:
    """All cases of a basin; a quick run takes few."""
    step = 3 if quick else 1
    return (
        *(Case(code="basin field", tank=basin.name, variant="certified", tolerance=one) for one in TOLERANCES[::step]),
        *(
            Case(code="basin field", tank=basin.name, variant="triangles", tolerance=one)
            for one in TOLERANCES[:-1:step]
        ),
        *(Case(code="ngsolve plan", tank=basin.name, variant="quarters", degree=degree) for degree in PLANS[::step]),
        *(
            Case(code="ngsolve volume", tank=basin.name, variant="quarters", degree=degree, size=size)
            for degree, size in VOLUMES[::step]
        ),
    )
