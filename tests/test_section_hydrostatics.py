"""Hydrostatics of floats against sections that are really displaced, turned and cut by the levels; outline files."""

from __future__ import annotations

from math import cos, pi, sin, sqrt
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from answers import answer
from section_tanks import GRAVITY, layered

import hydroelastic as he
from hydroelastic.physics.profiles import float_profile

# Gauss points and weights of numpy are good to some 1e-15 of the interval; moments add up a few of them.
EXACT = 1e-13
HULL = ((-0.9, -0.6), (0.7, -0.5), (1.2, 0.1), (0.9, 0.8), (-0.4, 1.0), (-1.1, 0.2))
"""A section without any symmetry."""


def at_rest(*, upper: float | None = 800.0, unit: float = 1.0, **body: Any) -> dict[str, Any]:
    """What a coarse solution tells of a float at rest."""
    values = {"kind": "float", "position": 10.0 * unit, "unstable": "solve", "motions": ("heave", "sway", "roll")}
    scene = layered(
        he.Float(**values | body),
        densities=(1000.0,) if upper is None else (1000.0, upper),
        depths=(5.0 * unit, 4.0 * unit),
        length=20.0 * unit,
        top="free",
        tolerance=1e-2,
        modes=1,
    )
    return answer(scene).summary["floats"][0]


def corners_of(section: dict[str, Any]) -> np.ndarray:
    """The contour as a polygon of many corners, anticlockwise."""
    if section["shape"] == "polygon":
        return np.array(section["vertices"], dtype=float)
    profile = float_profile(section["shape"], section["half_width"], section["half_height"])
    # Dense towards the ends, where some profiles turn, and towards the kink in the middle.
    y = profile.extent * np.sin(0.5 * pi * np.linspace(-1.0, 1.0, 4001) ** 3)
    half = profile.half_width_at(y)
    return np.vstack([np.column_stack([half, y]), np.column_stack([-half, y])[::-1]])


def clipped(points: np.ndarray, *, below: bool) -> tuple[float, np.ndarray]:
    """Area and first moments of the part of a polygon below or above y = 0, by the shoelace formula."""
    sign = -1.0 if below else 1.0
    kept = []
    for one, other in zip(points, np.roll(points, -1, axis=0), strict=True):
        if sign * one[1] >= 0:
            kept.append(one)
        if one[1] * other[1] < 0:
            kept.append(one + one[1] / (one[1] - other[1]) * (other - one))
    (x, y) = np.array(kept).T
    cross = x * np.roll(y, -1) - np.roll(x, -1) * y
    first = np.array([((x + np.roll(x, -1)) * cross).sum(), ((y + np.roll(y, -1)) * cross).sum()]) / 6
    return cross.sum() / 2, first


def force(points: np.ndarray, pivot: np.ndarray, mass: float, densities: tuple[float, float]) -> np.ndarray:
    """Upward force and anticlockwise moment about a pivot, of weight and buoyancy; the level is y = 0."""
    up, moment = -GRAVITY * mass, 0.0
    for density, below in zip(densities, (True, False), strict=True):
        area, first = clipped(points, below=below)
        up += GRAVITY * density * area
        moment += GRAVITY * density * (first[0] - area * pivot[0])
    return np.array([up, moment])


SECTIONS: dict[str, dict[str, Any]] = {
    "exponential": {"shape": "exponential", "half_width": 0.6, "half_height": 0.3},
    "parabola": {"shape": "parabola", "half_width": 0.6, "half_height": 0.9},
    "ellipse": {"shape": "ellipse", "half_width": 1.2, "half_height": 0.5},
    "wedge": {"shape": "wedge", "half_width": 0.8, "half_height": 0.9},
    "hull": {"shape": "polygon", "vertices": HULL},
    "low mass": {"shape": "polygon", "vertices": HULL, "centre_of_mass": -0.4, "radius_of_gyration": 0.3},
}


@pytest.mark.slow_but("0.35-800.0-interface-*", "None-800.0-surface-hull", "0.8-None-None-hull")
@pytest.mark.parametrize("section", SECTIONS)
@pytest.mark.parametrize(("upper", "at"), [(None, None), (800.0, "interface"), (800.0, "surface")])
@pytest.mark.parametrize("part", [None, 0.35, 0.8])
def test_stiffnesses_are_those_of_a_section_that_is_moved(
    section: str, upper: float | None, at: str | None, part: float | None
) -> None:
    """From a section displaced and turned by a little, as a polygon of many corners."""
    values: dict[str, Any] = {"upper": upper, "at": at} | SECTIONS[section]
    densities = (800.0 if at == "surface" else 1000.0, 800.0 if at == "interface" else 0.0)
    points = corners_of(SECTIONS[section])
    if part is not None:
        x, y = points.T
        area = 0.5 * (x * np.roll(y, -1) - np.roll(x, -1) * y).sum()
        values["mass"] = area * (part * densities[0] + (1 - part) * densities[1])
    found = at_rest(**values)
    level = 4.0 if at == "surface" else 0.0
    points += np.array([10.0, found["reference_level"] - level])
    pivot = np.array(found["centre_of_mass"]) - [0.0, level]

    def displaced(heave: float, roll: float) -> np.ndarray:
        turn = np.array([[cos(roll), -sin(roll)], [sin(roll), cos(roll)]])
        shift = np.array([0.0, heave])
        return force((points - pivot) @ turn.T + pivot + shift, pivot + shift, found["mass"], densities)

    step, weight = 1e-6, GRAVITY * found["mass"]
    # Archimedes, and the centre of mass over the centre of buoyancy; a polygon of n corners misses the curve by n⁻².
    np.testing.assert_allclose(displaced(0.0, 0.0) / weight, 0.0, atol=2e-6)
    columns = [(displaced(-h, -r) - displaced(h, r)) / (2 * step) for h, r in ((step, 0.0), (0.0, step))]
    coupling = found["coupling_stiffness"]
    expected = np.array([[found["heave_stiffness"], coupling], [coupling, found["roll_stiffness"]]])
    # Polygons of thousands of corners, and central differences of 1e-6 m, in which a corner passes the level:
    # measured 1.5e-6 of the larger terms at most.
    largest = np.abs(expected).max() + weight * 0.5
    np.testing.assert_allclose(np.array(columns).T / largest, expected / largest, atol=3e-6)


def test_the_sign_of_the_coupling() -> None:
    """A waterplane to the right of the centre of mass: a roll that lifts it makes the float heavier."""
    # A deep keel on the left, a wide deck to the right.
    corners = ((-1, -2), (0, -2), (0, -0.2), (2, -0.2), (2, 0.2), (-1, 0.2))
    found = at_rest(shape="polygon", vertices=corners, upper=None)
    assert sum(found["waterplane"]) / 2 > found["centre_of_mass"][0]
    assert found["coupling_stiffness"] > 0


@pytest.mark.parametrize("upper", [None, 800.0])
def test_a_half_immersed_circle_is_neutral_exactly(upper: float | None) -> None:
    circle = {"shape": "ellipse", "half_width": 1 / 3, "half_height": 1 / 3, "upper": upper}
    found = at_rest(**circle)
    assert (found["roll_stiffness"], found["coupling_stiffness"]) == (0.0, 0.0)
    if upper is None:
        # Anywhere else the section is neutral too, if its centre of mass is that of the circle.
        assert at_rest(**circle, mass=100.0)["roll_stiffness"] == 0.0
        lower = at_rest(**circle, centre_of_mass=-1e-6)["roll_stiffness"]
        assert lower == pytest.approx(GRAVITY * 500 * pi / 9 * 1e-6, rel=1e-9)


def test_closed_forms() -> None:
    # Wedge, b = 0.8, h = 0.9, half immersed in both liquids: A = bh on either side, centroids at ∓h/3.
    found = at_rest(**SECTIONS["wedge"])
    area = 0.8 * 0.9
    assert found["mass"] == pytest.approx(1800 * area, rel=EXACT)
    assert found["waterplane"] == pytest.approx([9.2, 10.8], rel=1e-15)
    assert found["centre_of_mass"] == pytest.approx([10.0, 0.0], abs=EXACT)
    assert found["heave_stiffness"] == pytest.approx(200 * GRAVITY * 1.6, rel=EXACT)
    roll = 200 * GRAVITY * 1.6**3 / 12 - GRAVITY * 200 * area * 0.3
    assert found["roll_stiffness"] == pytest.approx(roll, rel=EXACT)
    assert sqrt(found["moment_of_inertia"] / found["mass"]) == pytest.approx(sqrt((0.8**2 + 0.9**2) / 6), rel=EXACT)
    # A thin float has the hydrostatics of its profile.
    thin = at_rest(**SECTIONS["wedge"], boundary="thin", motions=("heave",))
    assert thin["heave_stiffness"] == pytest.approx(found["heave_stiffness"], rel=EXACT)
    # Archimedes' rectangle of a quarter of the density: m = 400 = 1000·1.6·0.25; y from the still surface.
    block = at_rest(shape="rectangle", half_width=0.8, half_height=0.5, upper=None, mass=400.0)
    assert block["reference_level"] == pytest.approx(0.25, rel=EXACT)
    assert block["centre_of_mass"] == pytest.approx([10.0, 0.25], rel=EXACT)


@pytest.mark.parametrize("mass", [None, 1180.0])
def test_the_centre_of_mass_counts_from_the_reference_level(mass: float | None) -> None:
    found = at_rest(**SECTIONS["wedge"], centre_of_mass=-0.4, mass=mass)
    assert found["centre_of_mass"][1] - found["reference_level"] == pytest.approx(-0.4, rel=EXACT)
    assert (found["reference_level"] == 0.0) == (mass is None)


def test_metres_and_millimetres_give_the_same_digits() -> None:
    metres = at_rest(shape="polygon", vertices=HULL)
    small = at_rest(shape="polygon", vertices=tuple((1e-3 * x, 1e-3 * y) for x, y in HULL), unit=1e-3)
    for name, power in (("mass", 2), ("heave_stiffness", 1), ("coupling_stiffness", 2), ("roll_stiffness", 3)):
        assert small[name] == pytest.approx(metres[name] * 1e-3**power, rel=1e-12)


OUTLINES = [
    "-1,-1\n1,-1\n1,1\n-1,1\n",
    "x, y\n-1 , -1\n1, -1\n1, 1\n-1, 1\n-1, -1\n",
    "# metres\n\n-1 -1\n 1\t-1\n1 -1 # twice\n1 1\n-1 1",
    "x;y\n-1;-1\n1;-1\n1;1\n-1;1\n",
    "\ufeff-1e0,-1.0\n+1,-1\n1,1\n-1,1\n",
]


def test_outlines_are_read_from_columns_and_again_when_they_are_edited(tmp_path: Path) -> None:
    path = tmp_path / "outline.csv"
    square = {"shape": "outline", "file": path, "upper": None}
    for text in OUTLINES:
        path.write_text(text, encoding="utf-8")
        answer.cache_clear()
        found = at_rest(**square)
        assert found["mass"] == pytest.approx(2000.0, rel=EXACT)
        assert found["waterplane"] == pytest.approx([9.0, 11.0], rel=EXACT)
    path.write_text("-1,-1\n1,-1\n1,1.5\n-1,1.5\n", encoding="utf-8")
    answer.cache_clear()
    assert at_rest(**square, mass=2500.0)["reference_level"] == pytest.approx(-0.25, rel=EXACT)
