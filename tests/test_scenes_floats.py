"""Hydrostatics of floats against sections that are really displaced, turned and cut by the levels; outline files."""

from __future__ import annotations

from math import cos, pi, sin, sqrt
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hydroelastic.physics.hydrostatics import Hydrostatics, still_level
from hydroelastic.scenes.models.bodies import Float
from hydroelastic.scenes.models.floats import float_contour, placed_float
from hydroelastic.scenes.models.outline_files import read_outline
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.models.tank_parts import Liquid, Tank

GRAVITY = 9.81
# Gauss points and weights of numpy are good to some 1e-15 of the interval; moments add up a few of them.
EXACT = 1e-13

HULL = ((-0.9, -0.6), (0.7, -0.5), (1.2, 0.1), (0.9, 0.8), (-0.4, 1.0), (-1.1, 0.2))
"""A section without any symmetry."""


def scene(*, upper: float | None = 800.0, at: str | None = None, **body: Any) -> TankScene:
    liquids = [Liquid(density=1000.0, depth=5.0)]
    if upper is not None:
        liquids.append(Liquid(density=upper, depth=4.0))
    values = {"position": 10.0, "unstable": "solve"} | body
    return TankScene(
        tank=Tank(length=20.0, gravity=GRAVITY),
        liquid=tuple(liquids),
        body=(Float(at=at, **values),),  # type: ignore[arg-type]
    )


def at_rest(**values: Any) -> Hydrostatics:
    return placed_float(scene(**values), 0).hydrostatics


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


def measured_stiffness(given: TankScene, found: Hydrostatics) -> np.ndarray:
    """Stiffness of heave and roll from a section displaced and turned by a little, as a polygon of many corners."""
    contour = placed_float(given, 0).hull.contour
    t = np.linspace(0, 1, 4001)[:-1]
    points = np.vstack([arc.point(t[:1] if arc.straight else t) for arc in contour.arcs]) - [0.0, found.level]
    pivot = np.array(found.centre_of_mass) - [0.0, found.level]
    densities = given.densities_at(given.level_of(given.body[0]))

    def displaced(heave: float, roll: float) -> np.ndarray:
        turn = np.array([[cos(roll), -sin(roll)], [sin(roll), cos(roll)]])
        shift = np.array([0.0, heave])
        return force((points - pivot) @ turn.T + pivot + shift, pivot + shift, found.mass, densities)

    rest, step = displaced(0.0, 0.0), 1e-6
    weight = GRAVITY * found.mass
    # Archimedes, and the centre of mass over the centre of buoyancy; a polygon of n corners misses the curve by n⁻².
    np.testing.assert_allclose(rest / weight, 0.0, atol=1e-6)
    columns = [(displaced(-h, -r) - displaced(h, r)) / (2 * step) for h, r in ((step, 0.0), (0.0, step))]
    return np.array(columns).T


SECTIONS: dict[str, dict[str, Any]] = {
    "exponential": {"shape": "exponential", "half_width": 0.6, "half_height": 0.3},
    "parabola": {"shape": "parabola", "half_width": 0.6, "half_height": 0.9},
    "ellipse": {"shape": "ellipse", "half_width": 1.2, "half_height": 0.5},
    "wedge": {"shape": "wedge", "half_width": 0.8, "half_height": 0.9},
    "rectangle": {"shape": "rectangle", "half_width": 0.8, "half_height": 0.5},
    "hull": {"shape": "polygon", "vertices": HULL},
    "low mass": {"shape": "polygon", "vertices": HULL, "centre_of_mass": -0.4, "radius_of_gyration": 0.3},
}


@pytest.mark.slow_but("0.35-800.0-interface-*", "None-800.0-surface-hull", "0.8-None-None-hull")
@pytest.mark.parametrize("section", SECTIONS)
@pytest.mark.parametrize(("upper", "at"), [(None, None), (800.0, "interface"), (800.0, "surface"), (0.0, None)])
@pytest.mark.parametrize("part", [None, 0.35, 0.8])
def test_stiffnesses_are_those_of_a_section_that_is_moved(
    section: str, upper: float | None, at: str | None, part: float | None
) -> None:
    values: dict[str, Any] = {"upper": upper, "at": at} | SECTIONS[section]
    densities = scene(**values).densities_at("interface" if at == "interface" else "surface")
    if part is not None:
        area = float_contour(Float(position=0, **SECTIONS[section]), Path()).moments().area
        values["mass"] = area * (part * densities[0] + (1 - part) * densities[1])
    given = scene(**values)
    found = placed_float(given, 0).hydrostatics
    measured = measured_stiffness(given, found)
    expected = np.delete(np.delete(found.stiffness, 1, axis=0), 1, axis=1)
    # Polygons of 4000 corners an arc, and central differences of 1e-6 m, in which a corner passes the level:
    # measured 1.5e-6 of the larger terms at most.
    largest = np.abs(expected).max() + GRAVITY * found.mass * 0.5
    np.testing.assert_allclose(measured / largest, expected / largest, atol=3e-6)


def test_the_sign_of_the_coupling() -> None:
    # A waterplane to the right of the centre of mass: a roll that lifts it makes the float heavier, and heave up
    # turns it clockwise. Section: a deep keel on the left, a wide deck to the right.
    found = at_rest(
        shape="polygon", vertices=((-1, -2), (0, -2), (0, -0.2), (2, -0.2), (2, 0.2), (-1, 0.2)), upper=None
    )
    assert sum(found.waterplane) / 2 > found.centre_of_mass[0]
    assert found.coupling_stiffness > 0
    assert found.roll_stiffness > found.free_roll_stiffness


def test_a_half_immersed_circle_is_neutral_exactly() -> None:
    for radius in (0.1, 1 / 3, 1.7):
        for upper in (None, 0.0, 800.0, 990.0):
            found = at_rest(shape="ellipse", half_width=radius, half_height=radius, upper=upper)
            assert found.roll_stiffness == 0.0
            assert found.free_roll_stiffness == 0.0
            assert found.coupling_stiffness == 0.0
    # Anywhere else the section is neutral too, if its centre of mass is that of the circle.
    assert at_rest(shape="ellipse", half_width=1, half_height=1, upper=None, mass=1000.0).roll_stiffness == 0.0
    lower = at_rest(shape="ellipse", half_width=1, half_height=1, upper=None, centre_of_mass=-1e-6)
    assert lower.roll_stiffness == pytest.approx(GRAVITY * 500 * pi * 1e-6, rel=1e-9)


def test_closed_forms() -> None:
    # Wedge, b = 0.8, h = 0.9, half immersed in both liquids: A = bh on either side, centroids at ∓h/3.
    found = at_rest(**SECTIONS["wedge"])
    area = 0.8 * 0.9
    assert found.mass == pytest.approx(1800 * area, rel=EXACT)
    assert found.areas == pytest.approx((area, area), rel=EXACT)
    assert found.centroids == (pytest.approx((10.0, -0.3), rel=EXACT), pytest.approx((10.0, 0.3), rel=EXACT))
    assert found.waterplane == (9.2, 10.8)
    assert found.centre_of_mass == pytest.approx((10.0, 0.0), abs=EXACT)
    assert found.heave_stiffness == pytest.approx(200 * GRAVITY * 1.6, rel=EXACT)
    roll = 200 * GRAVITY * 1.6**3 / 12 - GRAVITY * 200 * area * 0.3
    assert found.roll_stiffness == pytest.approx(roll, rel=EXACT)
    assert found.radius_of_gyration == pytest.approx(sqrt((0.8**2 + 0.9**2) / 6), rel=EXACT)
    # Archimedes' rectangle of half the density: m = 500·1.6·1.0; y from the still surface.
    block = at_rest(**SECTIONS["rectangle"], upper=None, mass=400.0)
    assert block.reference_level == pytest.approx(0.25, rel=EXACT)
    assert block.centroids[0] == pytest.approx((10.0, -0.125), rel=EXACT)
    assert block.centre_of_mass == pytest.approx((10.0, 0.25), rel=EXACT)


def test_the_centre_of_mass_counts_from_the_reference_level() -> None:
    for mass in (None, 1180.0, 1250.0):
        found = at_rest(**SECTIONS["wedge"], centre_of_mass=-0.4, mass=mass)
        assert found.centre_of_mass[1] - found.reference_level == pytest.approx(-0.4, rel=EXACT)
        assert (found.reference_level == 0.0) == (mass is None)


def test_the_upper_level_is_that_of_the_upper_liquid() -> None:
    low, high = at_rest(**SECTIONS["hull"]), at_rest(**SECTIONS["hull"], at="surface")
    assert (low.level, high.level) == (0.0, 4.0)
    alone = placed_float(
        TankScene(
            tank=Tank(length=20.0, gravity=GRAVITY),
            liquid=(Liquid(density=800.0, depth=4.0),),
            body=(Float(position=10.0, **SECTIONS["hull"]),),
        ),
        0,
    ).hydrostatics
    np.testing.assert_array_equal(high.stiffness, alone.stiffness)
    assert high.centre_of_mass == pytest.approx((alone.centre_of_mass[0], 4.0 + alone.centre_of_mass[1]), rel=1e-15)


@pytest.mark.parametrize("section", SECTIONS)
@pytest.mark.parametrize("seed", range(5))
def test_the_still_level_follows_from_the_mass(section: str, seed: int) -> None:
    random = np.random.default_rng(seed)
    contour = float_contour(Float(position=0, **SECTIONS[section]), Path())
    _, _, low, high = contour.bounds
    below, above = random.uniform(500, 1000), random.choice([0.0, random.uniform(1, 500)])
    wanted = random.uniform(0.95 * low, 0.95 * high)
    mass = below * contour.moments(wanted).area + above * contour.moments(wanted, side="above").area
    # The tip of the exponential holds little area: what rounding leaves of the area moves the level by more there.
    assert still_level(contour, mass, (below, above)) == pytest.approx(wanted, abs=1e-11 * (high - low))


def test_a_mass_in_decimals_lets_the_level_pass_through_a_corner() -> None:
    contour = float_contour(Float(position=0, **SECTIONS["wedge"]), Path())
    exact = 1000 * contour.moments(0.0).area
    assert still_level(contour, exact * (1 + 1e-10), (1000.0, 0.0)) == 0.0
    assert still_level(contour, exact * (1 + 1e-6), (1000.0, 0.0)) > 0.0


@pytest.mark.parametrize("mass", [1e-3, 1151.9, 1440.1, 1e9])
def test_what_sinks_or_rises_does_not_float(mass: float) -> None:
    contour = float_contour(Float(position=0, **SECTIONS["wedge"]), Path())
    with pytest.raises(ValueError, match=r"between 1152 and 1440 kg/m"):
        still_level(contour, mass, (1000.0, 800.0))


def test_thin_floats_have_the_hydrostatics_of_their_profile() -> None:
    for section in ("exponential", "parabola", "ellipse", "wedge"):
        thin, exact = at_rest(**SECTIONS[section], boundary="thin"), at_rest(**SECTIONS[section])
        assert thin == exact
    thin_scene, exact_scene = scene(**SECTIONS["wedge"], boundary="thin"), scene(**SECTIONS["wedge"])
    (interface, _), (exact_interface, surface) = (physical_tank(given).levels for given in (thin_scene, exact_scene))
    found = [(piece.body, piece.start, piece.end) for piece in interface.pieces]
    assert found == [(None, 0, 10), (0, 10, 10), (None, 10, 20)]
    found = [(piece.body, piece.start, piece.end) for piece in exact_interface.pieces]
    assert found == [(None, 0, 9.2), (0, 9.2, 10.8), (None, 10.8, 20)]
    assert (surface.kind, [piece.body for piece in surface.pieces]) == ("free", [None])


def test_metres_and_millimetres_give_the_same_digits() -> None:
    def float_in(unit: float) -> Hydrostatics:
        body = Float(
            position=10 * unit, shape="polygon", vertices=tuple((x * unit, y * unit) for x, y in HULL), unstable="solve"
        )
        tank = Tank(length=20 * unit, gravity=GRAVITY * unit)
        liquids = tuple(Liquid(density=density / unit**3, depth=4 * unit) for density in (1000.0, 800.0))
        return placed_float(TankScene(tank=tank, liquid=liquids, body=(body,)), 0).hydrostatics

    metres, millimetres = float_in(1.0), float_in(1000.0)
    # c33 in N/m² is kg/(m s²): per millimetre a thousandth; c55 in N = kg m/s²: a thousandfold.
    assert millimetres.heave_stiffness == pytest.approx(metres.heave_stiffness / 1000, rel=EXACT)
    assert millimetres.roll_stiffness == pytest.approx(metres.roll_stiffness * 1000, rel=EXACT)


def write(folder: Path, text: str) -> Path:
    path = folder / "outline.csv"
    path.write_text(text, encoding="utf-8")
    return path


SQUARE = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]


@pytest.mark.parametrize(
    "text",
    [
        "-1,-1\n1,-1\n1,1\n-1,1\n",
        "x, y\n-1 , -1\n1, -1\n1, 1\n-1, 1\n-1, -1\n",
        "# metres\n\n-1 -1\n 1\t-1\n1 -1 # twice\n1 1\n-1 1",
        "x;y\n-1;-1\n1;-1\n1;1\n-1;1\n",
        "\ufeff-1e0,-1.0\n+1,-1\n1,1\n-1,1\n",
    ],
)
def test_outlines_are_read_from_columns(tmp_path: Path, text: str) -> None:
    assert read_outline(write(tmp_path, text)).tolist() == SQUARE


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "holds no points"),
        ("x,y\n", "holds no points"),
        ("0,0\n1,1\n", "holds 2 points"),
        ("0,0\n1,1\n0,0\n0,0", "holds 2 points"),
        ("1\n2\n3\n", 'line 1, "1", does not have two columns'),
        ("0,0\n1,2,3\n", "line 2"),
        ("0,0\n1,\n", "line 2"),
        ("0,0\n1,nan\n", "not two finite numbers"),
        ("0,0\n1,inf\n", "not two finite numbers"),
        ("x,y\na,b\n0,0\n", "line 2"),
        ("0,0\nx,y\n", "line 2"),
        ("\n".join(f"{n},{n * n}" for n in range(1001)), "holds 1001 points"),
    ],
)
def test_what_is_no_outline_is_said_with_its_line(tmp_path: Path, text: str, reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        read_outline(write(tmp_path, text))


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="no such file"):
        read_outline(tmp_path / "missing.csv")
    with pytest.raises(ValueError, match="not a regular file"):
        read_outline(tmp_path)
    (tmp_path / "binary.csv").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ValueError, match="UTF-8"):
        read_outline(tmp_path / "binary.csv")


def test_an_outline_that_is_edited_is_read_again(tmp_path: Path) -> None:
    path = write(tmp_path, "\n".join(f"{x},{y}" for x, y in SQUARE))
    given = scene(shape="outline", file=path)
    assert placed_float(given, 0).hydrostatics.areas == pytest.approx((2.0, 2.0))
    write(tmp_path, "\n".join(f"{x},{2 * y:.3f}" for x, y in SQUARE))
    assert placed_float(given, 0).hydrostatics.areas == pytest.approx((4.0, 4.0))
