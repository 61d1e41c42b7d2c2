"""The half-immersed circle in open water: its frequencies, its cases, and what is certain of it.

Radius 1 m, water of infinite depth, waves leave on both sides; heave and sway. a' and b' are added mass over ρπa²/2 and
damping over ρωπa²/2, both per metre of width.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt

from hydroelastic.benchmarks.cases import Case

RADIUS = 1.0
DENSITY = 1000.0
GRAVITY = 9.81

TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
LENGTHS = (20.0, 40.0, 80.0)
PANELS = (4, 8, 12)
# With as many panels the longest cylinder is solved once, beside the half as long one: it takes ten seconds.
_MOST_OF_LONGEST = 8


@dataclass(frozen=True, kw_only=True)
class CircleFrequency:
    """A frequency, and the exact answer.

    Attributes:
        ka: ω²a/g.
        heave: a' + ib'.
        sway: a' + ib'.
    """

    ka: float
    heave: complex
    sway: complex

    @property
    def name(self) -> str:
        """As cases name it."""
        return f"Ka = {self.ka:g}"

    @property
    def omega(self) -> float:
        """ω, rad/s."""
        return sqrt(self.ka * GRAVITY / RADIUS)


# Ursell's multipoles with 800 terms, extrapolated: `radiation` of the project's tests/support/open_circle.py, of which
# tests/reference/open_circle.json is made. 400 terms differ by less than 4e-14.
CIRCLE = (
    CircleFrequency(
        ka=0.25,
        heave=0.8779899297683667 + 1.2447402359516002j,
        sway=1.304028804523256 + 0.3738865916418588j,
    ),
    CircleFrequency(
        ka=1.0,
        heave=0.6049768849379362 + 0.3963432849536318j,
        sway=0.3817802044751505 + 0.7472072780461818j,
    ),
    CircleFrequency(
        ka=2.5,
        heave=0.7758976349533908 + 0.07286614948331445j,
        sway=0.18590358844229887 + 0.29104513454128045j,
    ),
)


def circle_frequency(name: str) -> CircleFrequency:
    """The frequency of that name."""
    return {frequency.name: frequency for frequency in CIRCLE}[name]


def circle_error(name: str, values: tuple[float, ...]) -> float:
    """Largest relative error |h − h_exact|/|h_exact| of heave and sway, h = a' + ib'."""
    exact = circle_frequency(name)
    heave, sway = complex(values[0], values[1]), complex(values[2], values[3])
    return max(abs(heave / exact.heave - 1.0), abs(sway / exact.sway - 1.0))


def unit_added_mass() -> float:
    """ρπa²/2, the displaced mass, kg/m."""
    return DENSITY * pi * RADIUS**2 / 2.0


def circle_cases(frequency: CircleFrequency, *, quick: bool) -> tuple[Case, ...]:
    """All cases of a frequency; a quick run takes few."""
    cases = [
        Case(code="hydroelastic radiation", tank=frequency.name, variant="certified", tolerance=tolerance)
        for tolerance in TOLERANCES[:: 3 if quick else 1]
    ]
    for length in LENGTHS[: 1 if quick else None]:
        for panels in PANELS[: 2 if quick else None]:
            if length == LENGTHS[-1] and panels > _MOST_OF_LONGEST:
                continue
            cases.append(
                Case(code="capytaine", tank=frequency.name, variant="one length", length=length, panels=panels)
            )
    for length in LENGTHS[1 : 2 if quick else None]:
        for panels in PANELS[: 2 if quick else None]:
            cases.append(
                Case(code="capytaine", tank=frequency.name, variant="two lengths", length=length, panels=panels)
            )
    return tuple(cases)
