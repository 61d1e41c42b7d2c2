"""Heaving solids of revolution: a hemisphere in deep water and cylinders over a bed, their cases and exact answers."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from hydroelastic.benchmarks.cases import Case

DENSITY = 1000.0
GRAVITY = 9.81
RADIUS = 1.0

TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
PANELS = (8, 14, 20)
"""Panels from the axis to the water line; four times as many around."""
TERMS = (10, 40, 160, 320)
"""Eigenfunctions in each region."""


@dataclass(frozen=True, kw_only=True)
class Buoy:
    """A solid and a frequency, with the exact answer.

    Attributes:
        name: as cases name it.
        draught: of a cylinder, m; ``None`` of the hemisphere.
        depth: of the water, m.
        omega: rad/s.
        heave: a + ib/ω, kg.
    """

    name: str
    draught: float | None
    depth: float
    omega: float
    heave: complex


# Multipoles of A. Hulme (1982) extrapolated to 11 digits, and a Galerkin method with exact radial functions to 11 or 12
# digits: `tests/reference/axisymmetric_sea.json`, cases "hemisphere Ka=1.5", "c1 Ka=0.5" and "c8 Ka=1.0".
BUOYS = (
    Buoy(
        name="hemisphere, deep, Ka = 1.5",
        draught=None,
        depth=inf,
        omega=3.8360135557633264,
        heave=814.8148294097806 + 1290.3935874658343j / 3.8360135557633264,
    ),
    Buoy(
        name="cylinder d = a/2, H = 2a, Ka = 0.5",
        draught=0.5,
        depth=2.0,
        omega=2.2147234590350102,
        heave=1745.1295630447753 + 1762.0408682120596j / 2.2147234590350102,
    ),
    Buoy(
        name="cylinder d = 0.9a, H = a, Ka = 1",
        draught=0.9,
        depth=1.0,
        omega=3.132091952673165,
        heave=6248.334248258174 + 2106.706485038847j / 3.132091952673165,
    ),
)


def buoy_named(name: str) -> Buoy:
    """The buoy of that name."""
    return {buoy.name: buoy for buoy in BUOYS}[name]


def buoy_error(name: str, values: tuple[float, ...]) -> float:
    """Relative error |h − h_exact|/|h_exact| of h = a + ib/ω, from a and b/ω, kg."""
    return abs(complex(*values) / buoy_named(name).heave - 1.0)


def buoy_cases(buoy: Buoy, *, quick: bool) -> tuple[Case, ...]:
    """All cases of a buoy; a quick run takes few."""
    cases = [
        Case(code="hydroelastic buoy", tank=buoy.name, variant="certified", tolerance=tolerance)
        for tolerance in TOLERANCES[:: 3 if quick else 1]
    ]
    cases += [
        Case(code="capytaine buoy", tank=buoy.name, variant=variant, panels=panels)
        for variant in ("without lid", "with lid")
        for panels in PANELS[: 1 if quick else None]
    ]
    if buoy.draught is not None:
        cases += [
            Case(code="open-flash", tank=buoy.name, variant="matched", terms=terms)
            for terms in TERMS[: 2 if quick else None]
        ]
    return tuple(cases)
