"""The flexible threads of the benchmark: lines at rest, lines that move, their cases, and what is certain of them.

At rest, the forces on both ends are compared, relative to the larger one. The jumper of Lowe and Langley (2006) is
moved at its top, x = f(t/T) A sin(2πt/T) with A = 10 m, T = 27 s and a ramp f of fifth degree in the first period; its
top tension is compared at 109 times of the third, relative to the largest one. The chain with a body swings in liquid
at rest; compared is the place of the body at four times, relative to the length.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from math import pi, sin
from pathlib import Path
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray
from scipy.special import j0, y0

from hydroelastic.benchmarks.cases import Case, Variant

Array = NDArray[np.float64]
Reference = Literal["field", "MoorDyn", "OrcaFlex"]

# Lines of the file of references before its numbers.
_HEAD = 3

JUMPER, SWING = "jumper moved", "chain that swings"
MOVING = (JUMPER, SWING)

AMPLITUDE, PERIOD = 10.0, 27.0
TENSION_TIMES = np.linspace(2.0 * PERIOD, 3.0 * PERIOD, 109)
SWING_TIMES = (0.25, 0.5, 1.0, 1.5)
SWING_SPEED = 2.5

FIELD_TOLERANCES = (1e-2, 1e-4, 1e-6, 1e-8, 1e-10)
CATENARY_TOLERANCES = (1e-2, 1e-6, 1e-10)
LINES = (1, 2, 4, 8, 16)
SEGMENTS = (10, 20, 40, 80)
JUMPER_SEGMENTS = (17, 34, 68, 136)
JUMPER_STEPS = ((4, 0.5), (10, 0.25), (10, 0.125), (20, 0.0625), (20, 0.03125))
JUMPER_TOLERANCES = (1e-3, 1e-4)
SWING_SEGMENTS = (5, 10, 20, 40)
SWING_STEPS = ((4, 0.05), (6, 0.025), (6, 0.0125), (10, 0.00625), (10, 0.003125))


@dataclass(frozen=True, kw_only=True)
class BenchmarkLine:
    """A line between two held ends in a vertical plane (x, z), z = 0 at the surface, SI.

    Attributes:
        a: end A, m.
        b: end B, m.
        length: without stretch, m.
        diameter: m.
        weight: in the liquid, by length, N/m.
        axial_rigidity: EA, N.
        density: of the liquid, kg/m³.
        gravity: m/s².
        normal_drag: Cn.
        tangential_drag: Ct.
        stream: velocity at the height of A, m/s.
        shear: its growth with the height, 1/s.
        exact: (x, z) of the contact force N at A, then at B, N.
    """

    a: tuple[float, float]
    b: tuple[float, float]
    length: float
    diameter: float
    weight: float
    axial_rigidity: float
    density: float = 1025.0
    gravity: float = 9.81
    normal_drag: float = 0.0
    tangential_drag: float = 0.0
    stream: float = 0.0
    shear: float = 0.0
    exact: tuple[float, float, float, float]

    @property
    def displaced_mass(self) -> float:
        """Mass of the liquid in its place, by length, kg/m."""
        return self.density * pi * self.diameter**2 / 4.0

    @property
    def mass(self) -> float:
        """Mass by length, kg/m."""
        return self.weight / self.gravity + self.displaced_mass


def _in_stream(stream: float, shear: float, exact: tuple[float, float, float, float]) -> BenchmarkLine:
    """The line of the project's reference case S12: kn = 12.3 N·s²/m³, kt = 0.644 N·s²/m³."""
    density, diameter = 1025.0, 0.02
    return BenchmarkLine(
        a=(0.0, -60.0),
        b=(80.0, -30.0),
        length=100.0,
        diameter=diameter,
        weight=5.0,
        axial_rigidity=1e5,
        density=density,
        normal_drag=2.0 * 12.3 / (density * diameter),
        tangential_drag=2.0 * 0.644 / (density * pi * diameter),
        stream=stream,
        shear=shear,
        exact=exact,
    )


# Catenaries by Newton's method with 40 digits. In the stream: by shooting with a tolerance of 1e-13, `shoot` of the
# project's tests/support/thread_shooting.py; S12 is the case of that name in tests/reference/thread.json.
LINES_AT_REST = {
    "catenary": BenchmarkLine(
        a=(0.0, -100.0),
        b=(89.9, -40.8),
        length=130.0,
        diameter=0.1,
        weight=881.05,
        axial_rigidity=7.51e8,
        normal_drag=1.0,
        exact=(31373.234876305674797, -26650.338700035084206, 31373.234876305674797, 87886.161299964915794),
    ),
    "jumper at rest": BenchmarkLine(
        a=(-100.0, -55.0),
        b=(0.0, -5.0),
        length=170.0,
        diameter=0.396,
        weight=(165.0 - 1000.0 * pi * 0.396**2 / 4.0) * 9.807,
        axial_rigidity=5e8,
        density=1000.0,
        gravity=9.807,
        normal_drag=1.0,
        exact=(11472.278893533218334, -24028.004141042691878, 11472.278893533218334, 45722.226570908752994),
    ),
    "uniform stream": _in_stream(
        0.7, 0.0, (272.2391567886824, -149.27091314563603, 109.97912747358475, 424.284001399347)
    ),
    "sheared stream": _in_stream(0.4, 0.02, (235.6331121736, -153.2774636944, 81.12209473771, 417.0482022254)),
}


@dataclass(frozen=True, kw_only=True)
class SwingingChain:
    """The chain of the project's reference case D05, which hangs from (0, 0) and begins to move at its straight rest.

    Attributes:
        length: m.
        mass: by length, kg/m.
        weight: by length, N/m.
        normal_drag: kn, N·s²/m³.
        tangential_drag: kt, N·s²/m³.
        added_mass: by length, kg/m.
        tip_mass: of the body at its end, kg.
        tip_weight: N.
        omega: of the first small motion in empty space, whose shape the velocities have at first, rad/s.
        exact: (x, z) of the body at `SWING_TIMES`, m, known to 1e-6.
    """

    length: float = 1.0
    mass: float = 1.0
    weight: float = 9.81
    normal_drag: float = 2.0
    tangential_drag: float = 0.05
    added_mass: float = 0.4
    tip_mass: float = 0.5
    tip_weight: float = 4.905
    omega: float = 3.40352409229
    exact: tuple[float, ...] = (
        *(0.4789342936282, -0.8738379559197, 0.5945522657304, -0.8025393755176),
        *(0.02059164431636, -0.9993354872723, -0.4280445270357, -0.9032349977752),
    )

    def velocity(self, s: Array) -> Array:
        """Horizontal velocities at first, m/s, at places from its upper end, m."""
        shape = self._shape(s) / self._shape(np.array([self.length]))
        return np.asarray(SWING_SPEED * shape)

    def _shape(self, s: Array) -> Array:
        """J₀ and Y₀ of 2ω√(mT)/w, together zero at the upper end."""

        def argument(place: Array) -> Array:
            tension = self.tip_weight + self.weight * (self.length - place)
            return np.asarray(2.0 * self.omega * np.sqrt(self.mass * tension) / self.weight)

        top = argument(np.zeros(1))
        return np.asarray(j0(argument(s)) - j0(top) / y0(top) * y0(argument(s)))


CHAIN = SwingingChain()


def top_displacement(time: float) -> float:
    """How far the top of the jumper is from where it was, m, at a time in s."""
    part = min(time / PERIOD, 1.0)
    ramp = part**3 * (10.0 + part * (6.0 * part - 15.0))
    return ramp * AMPLITUDE * sin(2.0 * pi * time / PERIOD)


@cache
def jumper_tension(reference: Reference = "field") -> Array:
    """Top tension of the moved jumper at `TENSION_TIMES`, N: by fine runs of two codes, and digitised.

    The file says where they are from.
    """
    column = 1 + get_args(Reference).index(reference)
    path = Path(__file__).parent / "jumper_tension.csv"
    return 1e3 * np.loadtxt(path, delimiter=",", skiprows=_HEAD, usecols=column)


def tension_difference(values: Array, reference: Reference = "field") -> float:
    """Largest difference of tensions of the moved jumper to a reference, relative to the largest one."""
    expected = jumper_tension(reference)
    return float(np.abs(values - expected).max() / expected.max())


def thread_error(name: str, values: tuple[float, ...]) -> float:
    """The error of an answer, relative; see the head of this file."""
    found = np.array(values)
    if name == JUMPER:
        return tension_difference(found)
    if name == SWING:
        return float(np.linalg.norm((found - CHAIN.exact).reshape(-1, 2), axis=1).max() / CHAIN.length)
    exact = np.array(LINES_AT_REST[name].exact).reshape(2, 2)
    differences = np.linalg.norm(found.reshape(2, 2) - exact, axis=1)
    return float(differences.max() / np.linalg.norm(exact, axis=1).max())


THREADS = (*LINES_AT_REST, *MOVING)


def thread_cases(name: str, *, quick: bool) -> tuple[Case, ...]:
    """All cases of a thread; a quick run takes every third."""
    cases: list[tuple[Case, ...]]
    if name == JUMPER:
        cases = [
            tuple(_moved(name, elements, step) for elements, step in JUMPER_STEPS),
            tuple(Case(code="thread field", tank=name, variant="certified", tolerance=t) for t in JUMPER_TOLERANCES),
            _lumped(name, JUMPER_SEGMENTS),
        ]
    elif name == SWING:
        cases = [
            tuple(_moved(name, elements, step) for elements, step in SWING_STEPS),
            _lumped(name, SWING_SEGMENTS),
        ]
    else:
        line = LINES_AT_REST[name]
        cases = [
            tuple(Case(code="thread field", tank=name, variant="certified", tolerance=t) for t in FIELD_TOLERANCES)
        ]
        if line.stream == 0.0:
            cases.append((Case(code="thread catenary", tank=name, variant="closed form"),))
            tolerances = CATENARY_TOLERANCES
            cases.append(tuple(Case(code="moorpy", tank=name, variant="closed form", tolerance=t) for t in tolerances))
            # With the most segments both take five seconds and more.
            numbers = (JUMPER_SEGMENTS if name == "jumper at rest" else SEGMENTS)[:-1]
            cases += [_lumped(name, numbers, "relaxed"), _lumped(name, numbers, "relaxed in motion")]
        else:
            if line.shear == 0.0:
                cases.append(tuple(Case(code="moorpy", tank=name, variant="catenaries", segments=n) for n in LINES))
            cases.append(_lumped(name, SEGMENTS))
    return tuple(case for group in cases for case in group[:: 3 if quick else 1])


def _moved(name: str, elements: int, step: float) -> Case:
    return Case(code="thread field", tank=name, variant="one run", segments=elements, step=step)


def _lumped(name: str, numbers: tuple[int, ...], variant: Variant = "lumped") -> tuple[Case, ...]:
    return tuple(Case(code="moordyn", tank=name, variant=variant, segments=number) for number in numbers)
