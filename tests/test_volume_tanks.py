"""Tanks on tetrahedra: references of level beds, closed forms, columns, baffles, two liquids, hulls, solids."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise, product
from math import hypot, pi, radians, sqrt
from pathlib import Path
from typing import Any

import gmsh
import numpy as np
import pytest
import pyvista
from level_tanks import frequencies, plate, reference, reference_tank, solved, tank

import hydroelastic as he
from hydroelastic.physics.solid_floats import RIGID_MOTIONS, SolidFloat
from hydroelastic.physics.wetted_hulls import Hydrostatics, Triangles, WettedHull

G = 9.81
BOX = {"length": 10.0, "width": 6.0}
VOLUME = {"model": "volume"}
LAYERS = [{"density": 1025.0, "depth": 1.2}, {"density": 300.0, "depth": 0.8}]


def wavenumbers(length: float, width: float) -> list[float]:
    return sorted(pi * hypot(i / length, j / width) for i, j in product(range(9), repeat=2) if i + j)


@pytest.mark.slow_but("slosh_box*", "slosh_cylinder*", "rectangle_base_s0-0.001")
@pytest.mark.parametrize(
    ("name", "tolerance"),
    [
        ("slosh_box", 1e-6),
        ("slosh_cylinder", 1e-4),
        ("rectangle_base_s0", 1e-3),
        ("rectangle_base_s0", 1e-5),
        ("rectangle_base_s0", 1e-6),
        ("disc_base_s0", 1e-4),
        ("strip_base_s1", 1e-4),
        ("annulus_s0", 1e-3),
    ],
)
def test_frequencies_of_level_beds_keep_the_tolerance_and_its_estimate(name: str, tolerance: float) -> None:
    document = reference_tank(name)
    document["tank"] |= VOLUME
    result = solved(document, tolerance, 6)
    errors = result.modes.omega / reference(name)[:6] - 1.0
    # Ritz values come from above, but for curved walls.
    below = 0.01 if "cylinder" in name or "disc" in name or "annulus" in name else 0.0
    assert errors.min() >= -1e-12 - below * tolerance
    assert errors.max() <= tolerance
    # Estimates of waves and of curved walls are large where the cells are made for a higher mode.
    assert np.all(result.modes.relative_error >= errors)
    assert result.modes.relative_error.max() <= 10.0 * errors.max()


@pytest.mark.slow
def test_a_plate_that_follows_the_water_reaches_1e_6_in_one_cheap_attempt() -> None:
    """Its edges are a hundred times less singular than those of a plate without hydrostatic restoring."""
    document = reference_tank("rectangle_base_s0")
    document["body"][0]["hydrostatic"] = True
    exact = solved(document, 1e-8, 4).modes.omega
    document["tank"] = document["tank"] | VOLUME
    result = solved(document, 1e-6, 4)
    errors = result.modes.omega / exact - 1.0
    # Measured 2.1e-7, with an estimate of 1.5 to 7 times the error; 3e-9 is that of the box.
    assert np.all((errors > -3e-9) & (errors < 5e-7))
    assert np.all(result.modes.relative_error >= errors)
    # Of four symmetries together.
    assert result.summary["size"]["problems"] == 4
    assert result.summary["size"]["dofs"] < 4 * 20_000


@pytest.mark.mpi
def test_a_plane_bed_by_its_slope_and_by_points_is_one() -> None:
    """One is cut from a solid, the other moves the nodes of a level tank."""
    slope = (0.15, -0.05)
    corners = [[x, y, slope[0] * x + slope[1] * y] for x in (0.0, 10.0) for y in (0.0, 6.0)]
    sloping = solved(tank(BOX | {"bed": {"slope": list(slope)}}, 2.0), 1e-5, 2).modes.omega
    surveyed = solved(tank(BOX | {"bed": {"points": corners}}, 2.0 + 5.0 * slope[0] - 3.0 * slope[1]), 1e-5, 2)
    assert sloping == pytest.approx(surveyed.modes.omega, rel=1e-5)
    # The bed matters: 1 % of the first one, of a level bed.
    level = solved(tank(BOX, 2.0), 1e-6, 1).modes.omega[0]
    assert abs(sloping[0] / level - 1.0) > 2.5e-3


def solid(file: Path, make: Callable[[Any], None], *, mesh: Callable[[], None] | None = None) -> Path:
    """Write what gmsh makes as a solid, or its mesh, in metres."""
    gmsh.initialize(readConfigFiles=False, interruptible=False)
    gmsh.option.setNumber("General.Verbosity", 0)
    gmsh.model.add("by a user")
    make(gmsh.model.occ)
    gmsh.model.occ.synchronize()
    gmsh.option.setString("Geometry.OCCTargetUnit", "M")
    if mesh:
        mesh()
    gmsh.write(str(file))
    gmsh.model.remove()
    return file


def canal(occ: Any) -> None:
    """A V canal of 3 m with walls of 45 degrees, with the tip below, 2.5 m high."""
    lines = [(x, 0.0, abs(x)) for x in (0.0, 2.5, -2.5)]
    points = [occ.addPoint(*place) for place in lines]
    loop = occ.addCurveLoop([occ.addLine(points[i], points[(i + 1) % 3]) for i in range(3)])
    occ.extrude([(2, occ.addPlaneSurface([loop]))], 0.0, 3.0, 0.0)


def canal_mesh() -> None:
    top = [tag for _, tag in gmsh.model.getEntities(2) if gmsh.model.occ.getCenterOfMass(2, tag)[2] > 2.4]
    gmsh.model.addPhysicalGroup(2, top, name="free_surface")
    gmsh.model.addPhysicalGroup(3, [1], name="liquid")
    gmsh.option.setNumber("Mesh.MeshSizeMax", 1.0)
    gmsh.model.mesh.generate(3)


@pytest.mark.parametrize(("name", "depth"), [("canal.step", 2.0), ("canal.msh", 2.5)])
def test_a_canal_with_walls_of_45_degrees_has_its_closed_frequency(name: str, depth: float, tmp_path: Path) -> None:
    """ψ = xz, z from the tip, is harmonic with ψ_n = 0 on both walls: ω² = g/H. A mesh is as deep as it is."""
    file = solid(tmp_path / name, canal, mesh=canal_mesh if name.endswith("msh") else None)
    # A polynomial of degree 2: rounding is left.
    omega = solved(tank({"shape": str(file)}, depth), 1e-3, 1).modes.omega
    assert omega == pytest.approx([sqrt(G / depth)], rel=1e-10)


@pytest.mark.slow
def test_a_cone_has_its_closed_frequency_and_those_of_the_meridian_plane(tmp_path: Path) -> None:
    file = solid(tmp_path / "cone.brep", lambda occ: occ.addCone(0.0, 0.0, 0.0, 0.0, 0.0, 2.5, 0.0, 2.5))
    omega = solved(tank({"shape": str(file)}, 2.0), 1e-5, 7).modes.omega
    # n = 1 twice, ω² = g/H; n = 0 by polynomials of degree 8 in the meridian plane, ten digits.
    assert omega[:2] == pytest.approx([sqrt(G / 2.0)] * 2, rel=2e-6)
    assert omega[6] == pytest.approx(3.788779183, rel=2e-6)


def layered(k: float, *, lid: bool) -> np.ndarray:
    """Lamb, Hydrodynamics, § 231: interface and surface, or the interface under a lid alone."""
    below, above = 1025.0, 300.0
    one, other = 1.0 / np.tanh(1.2 * k), 1.0 / np.tanh(0.8 * k)
    if lid:
        return np.array([np.sqrt((below - above) * G * k / (below * one + above * other))])
    terms = below * one * other + above, -below * (one + other) * G * k, (below - above) * (G * k) ** 2
    return np.sqrt(np.roots(terms))


@pytest.mark.mpi
@pytest.mark.parametrize("case", ["free", "rigid", "divided"])
def test_two_liquids_in_a_box_have_the_waves_of_the_closed_form(case: str) -> None:
    """Under a surface, under a lid, and on both sides of a baffle through both liquids."""
    lengths = (4.0, 6.0) if case == "divided" else (10.0,)
    baffles = [{"start": [4.0, 0.0], "end": [4.0, 6.0]}] if case == "divided" else []
    exact = np.sort(
        np.concatenate([layered(k, lid=case == "rigid") for size in lengths for k in wavenumbers(size, 6.0)])
    )[:8]
    plan = BOX | ({"top": "rigid"} if case == "rigid" else {})
    modes = solved(tank(plan, 1.0, liquid=LAYERS, baffle=baffles), 1e-3, 8).modes
    errors = modes.omega / exact - 1.0
    # Among the lowest ones are waves of the interface and of the surface.
    assert case != "free" or exact[-1] > layered(pi / 10.0, lid=False).max() > exact[1]
    assert np.all((errors >= -1e-12) & (errors <= modes.relative_error))
    assert errors.max() < 1e-3


def test_a_column_on_the_axis_makes_a_ring() -> None:
    ring = frequencies(solved(tank({"radius": 5.0, "inner_radius": 1.5}, 2.0), 1e-6, 4))[:6]
    document = tank({"radius": 5.0}, 2.0, column=[{"radius": 1.5}])
    assert solved(document, 1e-3, 6).modes.omega == pytest.approx(ring, rel=1e-4)
    # The column matters: 1 % and more of each.
    k = 1.8411838 / 5.0
    assert abs(sqrt(G * k * np.tanh(2.0 * k)) / ring[0] - 1.0) > 1e-2


@pytest.mark.slow
@pytest.mark.parametrize("places", [[(0.7, 0.0808)], [(0.4, 0.35), (0.5608, 0.35)]])
def test_a_column_may_nearly_touch_a_wall_or_another_one(places: list[tuple[float, float]]) -> None:
    """A gap of a hundredth of the radius; without cells of its own size curved cells are inverted in it."""
    columns = [{"radius": 0.08, "position": list(place)} for place in places]
    result = solved(tank({"length": 1.0, "width": 0.7}, 0.25, column=columns), 0.1, 1)
    # Less than the bare tank: the column narrows it.
    assert 0.8 < result.modes.omega[0] / sqrt(G * pi * np.tanh(0.25 * pi)) < 1.0
    assert result.summary["size"]["dofs"] < 60_000


def test_a_baffle_from_bed_to_surface_divides_a_box_into_two() -> None:
    baffle = {"start": [4.0, -1.0], "end": [4.0, 7.0]}
    exact = sorted(sqrt(G * k * np.tanh(2.0 * k)) for length in (4.0, 6.0) for k in wavenumbers(length, 6.0))[:6]
    errors = solved(tank(BOX, 2.0, baffle=[baffle]), 1e-4, 6).modes.omega / np.array(exact) - 1.0
    assert np.all((errors >= -1e-12) & (errors <= 1e-4))


SLIT = {0: 1.1854130, 2: 2.8973937}
"""Frequencies of a tank of 10 m × 2 m in the plane with a wall of 1.2 m on its bed in the middle, rad/s, of polynomials
of degree 10 on 1,619 triangles graded to its top; certain to 1e-7. Those odd about the middle."""


@pytest.mark.slow_but("0.01")
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
def test_a_baffle_on_the_bed_has_the_frequencies_of_the_plane(tolerance: float) -> None:
    baffle = {"start": [5.0, 0.0], "end": [5.0, 0.8], "top": -0.8}
    modes = solved(tank({"length": 10.0, "width": 0.8}, 2.0, baffle=[baffle]), tolerance, 3).modes
    for place, exact in SLIT.items():
        error = modes.omega[place] / exact - 1.0
        # Measured: 1.1 to 1.4 times by the mesh, and up to 5 times with the bound of what the eigen-solver leaves.
        assert 0.0 < error <= modes.relative_error[place] <= min(tolerance, 8.0 * error)


def test_a_baffle_close_under_the_surface_slows_the_water_above_it() -> None:
    """A ring at the wall, much of the surface: waves above it are those of shallow water, and slower."""
    ring = {"level": -0.05, "radius": 1.0, "inner_radius": 0.5}
    bare, baffled = (
        solved(tank({"radius": 1.0}, 1.0, baffle=baffles), 0.1, 1).modes.omega
        for baffles in ([{"level": -0.9, "radius": 1.0, "inner_radius": 0.95}], [ring])
    )
    assert bare[0] == pytest.approx(sqrt(G * 1.8411838 * np.tanh(1.8411838)), rel=1e-2)
    assert baffled[0] < 0.8 * bare[0]


@pytest.mark.slow
def test_a_strip_of_plate_on_two_liquids_has_the_frequencies_of_the_plane() -> None:
    """Its modes without waves across are those of a beam of the same stiffness on two liquids."""
    beam = {"kind": "beam", "at": "surface", "start": 3.0, "length": 4.0}
    beam |= {"flexural_rigidity": 5e3, "mass_per_length": 50.0}
    exact = solved(tank({"length": 10.0}, 1.0, beam, liquid=LAYERS), 1e-6, 6).modes.omega
    strip = plate("strip", 5e3, 50.0, start=3.0, length=4.0)
    modes = solved(tank({"length": 10.0, "width": 0.5}, 1.0, strip, liquid=LAYERS), 1e-3, 6).modes
    errors = modes.omega / exact - 1.0
    assert errors.min() > -1e-6
    # Internal waves hardly move the plate; where they do, its estimate is too small for a mode.
    assert errors.max() <= modes.relative_error.max() <= 1e-3
    bare = solved(tank({"length": 10.0, "width": 0.5}, 1.0, liquid=LAYERS), 1e-3, 6).modes.omega
    assert np.abs(bare / exact - 1.0).max() > 1e-2


# Floats: their rest


def body(shape: str, **keys: Any) -> dict[str, Any]:
    return {"kind": "float", "shape": shape} | keys


def rest(float_: dict[str, Any], plan: dict[str, Any] = BOX, depth: float = 2.5, **keys: Any) -> dict[str, Any]:
    """The float at rest, as the summary tells it."""
    (told,) = solved(tank(plan, depth, float_, **keys), 0.1, 1).summary["bodies"]
    return dict(told)


CYLINDER = body("cylinder", radius=1.0, vertical_centre_of_gravity=-0.3)
OUTLINE = body("revolved", outline=[[0.0, -0.5], [0.6, -0.5], [0.9, 0.4], [0.0, 0.4]])


def test_mass_and_draught_follow_from_one_another() -> None:
    sphere = rest(body("sphere", radius=0.6, mass=2000.0 / 3.0 * pi * 0.216, motions=["heave"]))
    assert sphere["draught"] == pytest.approx(0.6)
    # A frustum of a cone: π h (R² + Rr + r²)/3, with the waterline of radius 0.6 + 0.5 · 0.3/0.9.
    radius = 0.6 + 0.5 / 3.0
    volume = pi * 0.5 / 3.0 * (0.36 + 0.6 * radius + radius**2)
    outline = rest(OUTLINE | {"mass": 1000.0 * volume})
    assert outline["draught"] == pytest.approx(0.5, rel=1e-9)
    assert outline["waterplane_area"] == pytest.approx(pi * radius**2, rel=1e-9)
    assert outline["heave_stiffness"] == pytest.approx(1000.0 * G * pi * radius**2, rel=1e-9)
    # Homogeneous: the centre of the frustum, by h (R² + 2Rr + 3r²)/(4 (R² + Rr + r²)) from its larger end.
    height = 0.9 * (0.9**2 + 2.0 * 0.9 * 0.6 + 3.0 * 0.6**2) / (4.0 * (0.9**2 + 0.9 * 0.6 + 0.6**2))
    assert outline["centre_of_gravity"] == pytest.approx([5.0, 3.0, 0.4 - height])
    # On a lighter upper liquid it is deeper.
    two = [{"density": 1025.0, "depth": 1.0}, {"density": 800.0, "depth": 1.5}]
    assert rest(CYLINDER | {"mass": 800.0 * pi * 0.6}, liquid=two)["draught"] == pytest.approx(0.6)


def test_moments_of_inertia_are_those_of_their_radii() -> None:
    mass = 1000.0 * pi * 0.5
    given = [{"inertia": [mass * radius**2 for radius in (0.4, 0.5, 0.6)]}, {"radii_of_gyration": [0.4, 0.5, 0.6]}]
    found = [solved(tank(BOX, 2.0, CYLINDER | {"mass": mass} | one), 0.1, 4).modes.omega for one in given]
    assert found[0] == pytest.approx(found[1], rel=1e-9)


def test_the_shipped_hull_is_at_rest_in_its_place() -> None:
    """A prism: its section immersed to T has the area 2.8 T + (0.2 + 1.2) T²/2 but for the width of 1.6 m."""
    result = he.solve(he.read("scow_in_a_basin", {"accuracy.tolerance": 0.1, "accuracy.modes": 1}))
    (told,) = result.summary["bodies"]
    draught = told["draught"]
    assert 1.6 * (2.8 * draught + 0.7 * draught**2) == pytest.approx(2.5, rel=1e-6)
    length = 2.8 + 1.4 * draught
    assert told["waterplane_area"] == pytest.approx(1.6 * length, rel=1e-6)
    assert (told["mass"], told["displaced_volume"]) == pytest.approx((2500.0, 2.5), rel=1e-6)
    # BM of roll is b³l/12 over V; the centre of gravity lies 0.05 m below the still level.
    metacentric = 1.6**3 * length / 12.0 / 2.5 + told["centre_of_buoyancy"][2] + 0.05
    assert told["metacentric_heights"][0] == pytest.approx(metacentric, rel=1e-6)
    assert told["centre_of_gravity"][:2] == told["centre_of_buoyancy"][:2]


PYRAMID = Triangles(
    points=np.array([[0.0, 0.0, 0.0], [3.0, -3.0, 3.0], [3.0, 3.0, 3.0], [-3.0, 3.0, 3.0], [-3.0, -3.0, 3.0]]),
    corners=np.array([[0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 1, 4], [1, 2, 3], [1, 3, 4]]),
)
"""It stands on its tip, with a base of 6 m at 3 m above it."""


def test_triangles_are_cut_where_they_cross_the_level() -> None:
    wetted = PYRAMID.below(1.0)
    wetted.require_closed()
    found = wetted.hydrostatics()
    # A base of 2 m at a height of 1 m; rounding.
    assert found.volume == pytest.approx(4.0 / 3.0, rel=1e-12)
    assert found.buoyancy == pytest.approx(-0.25, rel=1e-12)
    assert found.waterplane == pytest.approx(4.0, rel=1e-12)
    assert found.second == pytest.approx((4.0 / 3.0, 4.0 / 3.0), rel=1e-12)


def test_a_box_that_is_turned_has_a_product_of_inertia() -> None:
    """About axes turned by α, ∫xy = ½(I_y − I_x) sin 2α of its principal second moments."""
    corners = np.array(
        [[x, y, z] for z in (-0.6, 0.4) for x, y in ((-1.0, -0.7), (1.0, -0.7), (1.0, 0.7), (-1.0, 0.7))]
    )
    turn = radians(25.0)
    corners[:, :2] = corners[:, :2] @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    sides = [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (3, 2, 1, 0), (4, 5, 6, 7)]
    triangles = np.array([[side[0], side[i], side[i + 1]] for side in sides for i in (1, 2)])
    found = Triangles(points=corners, corners=triangles).below(0.0).hydrostatics()
    about_x, about_y = 2.0 * 1.4**3 / 12.0, 1.4 * 2.0**3 / 12.0
    assert found.volume == pytest.approx(2.0 * 1.4 * 0.6)
    assert found.product == pytest.approx(0.5 * (about_y - about_x) * np.sin(2.0 * turn))
    assert found.second[0] == pytest.approx(about_x * np.cos(turn) ** 2 + about_y * np.sin(turn) ** 2)


def test_an_unsymmetric_waterplane_couples_heave_roll_and_pitch() -> None:
    """The stiffness is the second derivative of the energy of a tilted waterplane, by its polygon."""
    found = Hydrostatics(volume=1.0, buoyancy=-0.3, waterplane=2.0, second=(0.5, 0.8), first=(0.2, -0.1), product=0.05)
    hull = WettedHull(
        file=Path("hull.stl"),
        level=0.0,
        low=(-1.0, -0.5, -0.6),
        high=(1.0, 0.5, 0.0),
        hydrostatics=found,
        symmetric=(False, False),
    )
    float_ = SolidFloat(
        shape="hull",
        size=(2.0, 1.0),
        draught=0.6,
        position=(0.0, 0.0),
        centre_of_gravity=-0.05,
        gyration=(0.4, 0.9, 1.0),
        motions=RIGID_MOTIONS,
        hull=hull,
    )
    lever = -0.3 + 0.05
    # Heave, roll and pitch raise a point by 1, y and −x.
    assert float_.stiffness()[2:5, 2:5] == pytest.approx(
        np.array([[2.0, -0.1, -0.2], [-0.1, 0.5 + lever, -0.05], [-0.2, -0.05, 0.8 + lever]])
    )
    points = np.array([[0.3, -0.4], [0.7, 0.2], [0.0, 0.0]])
    heights = [float_.displacement(motion, points)[2] for motion in ("heave", "roll", "pitch")]
    assert heights == pytest.approx(np.array([[1.0, 1.0], [0.7, 0.2], [-0.3, 0.4]]))


# Hulls from files

AXES = (2.0, 0.8, 0.6)
"""Half axes of the ellipsoid, m, whose middle is at the still level."""
SIZE = (2.0, 1.4, 0.6)


def ellipsoid(around: int, shift: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> np.ndarray:
    """Triangles with corners on an ellipsoid, those without an area left out, shape (triangles, 3, 3)."""
    polar, turn = np.linspace(0.0, pi, around // 2 + 1)[:, None], np.linspace(0.0, 2.0 * pi, around + 1)
    unit = [np.cos(polar) + 0.0 * turn, np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn)]
    corners = np.stack([axis * one + moved for axis, one, moved in zip(AXES, unit, shift, strict=True)], axis=2)
    one, two, three, four = corners[:-1, :-1], corners[1:, :-1], corners[1:, 1:], corners[:-1, 1:]
    parts = [np.stack(part, axis=2).reshape(-1, 3, 3) for part in ((one, two, three), (one, three, four))]
    triangles = np.concatenate(parts)
    sides = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    return np.asarray(triangles[np.linalg.norm(sides, axis=1) > 1e-12])


def written(file: Path, triangles: np.ndarray) -> Path:
    facets = (
        "facet normal 0 0 0\nouter loop\n"
        + "".join("vertex {:.9g} {:.9g} {:.9g}\n".format(*corner) for corner in triangle)
        + "endloop\nendfacet\n"
        for triangle in triangles
    )
    file.write_text(f"solid hull\n{''.join(facets)}endsolid hull\n", encoding="ascii")
    return file


def ellipsoid_solid(file: Path) -> Path:
    def make(occ: Any) -> None:
        occ.dilate([(3, occ.addSphere(0.0, 0.0, 0.0, 1.0))], 0.0, 0.0, 0.0, *AXES)

    return solid(file, make)


def box_solid(file: Path) -> Path:
    """A box of twice its draught, beside the origin of its file."""
    along, across, depth = SIZE

    def make(occ: Any) -> None:
        occ.addBox(0.3 - 0.5 * along, -0.2 - 0.5 * across, -depth, along, across, 2.0 * depth)

    def mesh() -> None:
        gmsh.model.mesh.generate(2)

    return solid(file, make, mesh=mesh if file.suffix == ".stl" else None)


def hull(file: Path, **keys: Any) -> dict[str, Any]:
    given = {"vertical_centre_of_gravity": -0.05, "radii_of_gyration": [0.4, 0.9, 1.0]}
    return body("hull", file=str(file), **given, **keys)


def test_hydrostatics_of_triangles_converge_like_their_chords(tmp_path: Path) -> None:
    a, b, c = AXES
    exact = [2.0 / 3.0 * pi * a * b * c, -0.375 * c, pi * a * b]
    errors = []
    for around in (12, 24, 48):
        # Its origin is elsewhere, and the file lies deeper than its still level.
        file = written(tmp_path / f"{around}.stl", ellipsoid(around, shift=(0.5, -0.3, 0.2)))
        told = rest(hull(file, draught=c, position=[4.5, 3.3], motions=["heave"]))
        assert told["centre_of_buoyancy"][:2] == pytest.approx([5.0, 3.0], abs=1e-6)
        values = [told["displaced_volume"], told["centre_of_buoyancy"][2], told["waterplane_area"]]
        errors.append(np.abs(np.array(values) / exact - 1.0).max())
        # Of the chord, 1 − cos(π/n); areas and moments lack up to five times as much.
        assert errors[-1] < 5.0 * (1.0 - np.cos(pi / around))
    assert all(np.log2(one / other) == pytest.approx(2.0, abs=0.15) for one, other in pairwise(errors)), errors


def test_a_mass_immerses_a_hull_to_its_volume(tmp_path: Path) -> None:
    told = rest(hull(written(tmp_path / "hull.stl", ellipsoid(40)), mass=1000.0, motions=["heave"]))
    assert told["displaced_volume"] == pytest.approx(1.0, rel=1e-6)
    # Of an ellipsoid of height 2c filled to h: V = πab/c² · (c h² − h³/3).
    a, b, c = AXES
    height = told["draught"]
    assert pi * a * b / c**2 * (c * height**2 - height**3 / 3.0) == pytest.approx(1.0, rel=2e-2)


def test_hulls_that_are_no_body_are_refused(tmp_path: Path) -> None:
    triangles = ellipsoid(20)
    lowest = np.argsort(triangles[:, :, 2].mean(axis=1))[3]
    turned = triangles.copy()
    turned[lowest] = turned[lowest, ::-1]
    aside = np.add(triangles, [0.0, 0.5, 0.0])
    for name, given, keys, said in (
        ("hole", np.delete(triangles, lowest, axis=0), {}, "is not closed: 3 of its edges below the still level"),
        ("turned", turned, {}, "has neighbours that are not turned alike at 3 edges"),
        ("twice", np.concatenate([triangles, aside]), {"draught": 0.5}, "crosses itself near x = "),
        ("whole", triangles, {"draught": 3.0}, "is not between its lowest and highest point"),
        ("heavy", triangles, {"mass": 9000.0}, "displaces 9 m³ at no level"),
        ("outside", triangles, {"position": [0.5, 3.0]}, "does not lie inside the tank"),
    ):
        file = written(tmp_path / f"{name}.stl", given)
        with pytest.raises(he.SceneError, match=rf"(?s)({name}\.stl|body 1|number 1).*{said}|{said}"):
            solved(tank(BOX, 2.5, hull(file, **keys)), 0.1, 1)
    # Open above the still level it is a hull, and two that do not meet are one.
    opened = written(tmp_path / "open.stl", triangles[triangles[:, :, 2].min(axis=1) < 1e-9])
    pair = written(tmp_path / "pair.stl", np.concatenate([triangles, np.add(triangles, [0.0, 2.0, 0.0])]))
    one, two = (rest(hull(file, draught=0.6, motions=["heave"])) for file in (opened, pair))
    assert two["displaced_volume"] == pytest.approx(2.0 * one["displaced_volume"], rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["box.stl", "box.step"])
def test_a_box_of_a_file_has_the_modes_of_the_box(name: str, tmp_path: Path) -> None:
    own = {"vertical_centre_of_gravity": -0.05, "radii_of_gyration": [0.4, 0.9, 1.0], "position": [4.0, 3.5]}
    shaped = body("box", size=list(SIZE[:2]), draught=SIZE[2], **own)
    of_file = hull(box_solid(tmp_path / name), draught=SIZE[2], position=[3.7, 3.7])
    one, other = (solved(tank(BOX, 2.5, float_), 1e-2, 8).modes for float_ in (shaped, of_file))
    assert np.all(np.abs(one.omega / other.omega - 1.0) < one.relative_error + other.relative_error)


@pytest.mark.slow
def test_a_turned_box_has_the_modes_of_the_box(tmp_path: Path) -> None:
    """In a round tank nothing tells them apart; the product of inertia of the waterplane couples roll and pitch."""
    own = {"vertical_centre_of_gravity": -0.05, "radii_of_gyration": [0.6, 0.6, 0.8], "position": [0.0, 0.0]}
    along, across, depth = SIZE
    turn = radians(25.0)
    corners = np.array(
        [[x, y, z] for z in (-depth, depth) for x, y in product((-along / 2, along / 2), (-across / 2, across / 2))]
    )
    corners[:, :2] = corners[:, :2] @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = np.array([corners[[side[0], side[i], side[i + 1]]] for side in sides for i in (1, 2)])
    of_file = body("hull", file=str(written(tmp_path / "turned.stl", triangles)), draught=depth, **own)
    shaped = body("box", size=[along, across], draught=depth, **own)
    one, other = (solved(tank({"radius": 3.0}, 2.0, float_), 1e-2, 8).modes for float_ in (shaped, of_file))
    assert np.all(np.abs(one.omega / other.omega - 1.0) < one.relative_error + other.relative_error)


@pytest.mark.slow
def test_a_hull_of_triangles_converges_to_the_solid(tmp_path: Path) -> None:
    """The frequencies of an ellipsoid by its triangles, against those of the same hull from CAD."""
    exact = solved(tank(BOX, 2.5, hull(ellipsoid_solid(tmp_path / "hull.step"))), 3e-3, 8).modes.omega
    errors = []
    for around in (12, 24):
        file = written(tmp_path / f"{around}.stl", ellipsoid(around))
        found = solved(tank(BOX, 2.5, hull(file)), 3e-3, 8).modes.omega
        errors.append(float(np.abs(found / exact - 1.0).max()))
        # Of the chord, 1 − cos(π/n), beside the tolerance of both.
        assert errors[-1] < 0.15 * (1.0 - np.cos(pi / around)) + 6e-3
    assert errors[1] < errors[0]


@pytest.mark.slow
def test_a_revolved_rectangle_is_a_cylinder() -> None:
    own = {"vertical_centre_of_gravity": -0.05, "radii_of_gyration": [0.5, 0.5, 1.0]}
    corners = [[0.0, -0.7], [1.2, -0.7], [1.2, 0.5], [0.0, 0.5]]
    floats = (body("cylinder", radius=1.2, draught=0.7, **own), body("revolved", outline=corners, **own))
    found = [solved(tank(BOX, 2.5, float_), 5e-3, 6).modes.omega for float_ in floats]
    assert found[0] == pytest.approx(found[1], rel=5e-4)


# Files


def test_files_hold_the_shapes_of_modes_on_their_mesh(tmp_path: Path) -> None:
    """Of a sloping bed in a volume, and both modes of a pair of a disc: gη = ω²ψ on the water."""
    sloping = tank(BOX | {"bed": {"slope": [0.2, 0.0]}}, 3.0)
    result = solved(sloping, 1e-2, 2)
    result.save(tmp_path / "basin", images=None)
    surface, volume = (pyvista.read(tmp_path / "basin" / "fields" / f"{name}.vtu") for name in ("surface", "volume"))
    # Both halves beside the plane of symmetry y = 3, and the bed from 4 m to 2 m.
    assert np.ptp(surface.points, axis=0) == pytest.approx([10.0, 6.0, 0.0], abs=1e-6)
    assert volume.points[np.argmin(volume.points[:, 2])][[0, 2]] == pytest.approx([0.0, -4.0], abs=1e-6)
    corners = [np.argmin(np.hypot(*(surface.points[:, :2] - at).T)) for at in ([0.0, 0.0], [0.0, 6.0])]
    eta = surface.point_data["displacement_002"][corners, 2]
    # The second mode is the first across: odd about y = 3.
    assert result.modes.symmetry[1] == "yA"
    assert eta[0] == pytest.approx(-eta[1], rel=1e-9)
    psi = volume.point_data["potential_002"][np.argmin(np.linalg.norm(volume.points, axis=1))]
    assert G * eta[0] == pytest.approx(result.modes.omega[1] ** 2 * psi, rel=1e-9)
    disc = solved(reference_tank("disc_base_s0"), 1e-5, 3)
    disc.save(tmp_path / "disc", images=None)
    surface, volume = (pyvista.read(tmp_path / "disc" / "fields" / f"{name}.vtu") for name in ("surface", "volume"))
    shapes = ("001", "002_cos", "002_sin", "003_cos", "003_sin")
    assert {f"displacement_{name}" for name in shapes} <= set(surface.point_data)
    even, odd = (surface.point_data[f"displacement_002_{name}"][:, 2] for name in ("cos", "sin"))
    x, y = surface.points[:, 0], surface.points[:, 1]
    # f(r) cos θ and f(r) sin θ.
    assert even * y == pytest.approx(odd * x, abs=1e-6 * np.abs(even).max() * 5.0)
    water = disc.dataset["plate"].values == 0
    eta, psi = surface.point_data["displacement_001"][:, 2], volume.point_data["potential_001"][: len(x)]
    assert G * eta[water] == pytest.approx(
        disc.modes.omega[0] ** 2 * psi[water], rel=1e-4, abs=1e-4 * np.abs(eta).max() * G
    )
    # Under the plate the pressure bends it: gη is something else.
    assert np.abs(G * eta[~water] / (disc.modes.omega[0] ** 2 * psi[: len(x)][~water]) - 1.0).max() > 1e-3


@pytest.mark.mpi
@pytest.mark.only_on_ranks
def test_each_process_writes_its_part_of_the_volume(tmp_path: Path) -> None:
    """Of a box of 30 m × 12 m × 6 m without the barge, 12 m × 5 m × 1.5 m; a quarter of it is solved."""
    from mpi4py import MPI

    folder = MPI.COMM_WORLD.bcast(tmp_path) / "result"
    result = he.solve(he.read("barge_in_a_dock", {"accuracy.tolerance": 5e-2, "accuracy.modes": 1}))
    result.save(folder, images=None)
    assert result.summary["size"]["memory_of_a_process"] < result.summary["memory_peak"]
    MPI.COMM_WORLD.Barrier()
    parts = [pyvista.read(file) for file in sorted(folder.glob("fields/volume/*.vtu"))]
    assert len(parts) == MPI.COMM_WORLD.size
    whole = pyvista.read(folder / "fields" / "volume.pvtu")
    assert whole.n_cells == sum(part.n_cells for part in parts)
    # Straight cells fill it to rounding.
    assert whole.compute_cell_sizes()["Volume"].sum() == pytest.approx(30.0 * 12.0 * 6.0 - 12.0 * 5.0 * 1.5, rel=1e-9)
    assert all(part["potential_001"].any() for part in parts)


def test_floats_are_the_volumes_that_they_leave_out(tmp_path: Path) -> None:
    """The liquid's cells around a box and a half immersed sphere: as much is missing as the float displaces."""
    for float_, left in (
        (body("box", size=[1.0, 0.8], draught=0.4, position=[1.5, 1.2], vertical_centre_of_gravity=-0.2), 0.32),
        (body("sphere", radius=0.5, draught=0.5), pi / 12.0),
    ):
        (told,) = (result := solved(tank({"length": 4.0, "width": 3.0}, 1.0, float_), 0.1, 1)).summary["bodies"]
        assert told["displaced_volume"] == pytest.approx(left, rel=1e-9)
        result.save(tmp_path / float_["shape"], images=None)
        cells = pyvista.read(tmp_path / float_["shape"] / "fields" / "volume.vtu").compute_cell_sizes()["Volume"]
        # Cells of a sphere are drawn with straight faces.
        assert 12.0 - cells.sum() == pytest.approx(left, rel=1e-6 if float_["shape"] == "box" else 0.1)


CORNERS = [[x, y, 0.0] for x in (0.0, 10.0) for y in (0.0, 6.0)]
BAD: dict[str, tuple[dict[str, Any], str]] = {
    "no draught and no mass": ({"body": [CYLINDER]}, "draught"),
    "mass beside draught": ({"body": [CYLINDER | {"draught": 0.5, "mass": 1000.0}]}, "displaces 1570.8 kg"),
    "sinking": ({"body": [OUTLINE | {"mass": 1e5}]}, "it sinks"),
    "outline beside the axis": ({"body": [OUTLINE | {"outline": [[0.1, -0.5], [0.6, 0.0], [0.0, 0.4]]}]}, "r > 0"),
    "yaw of a round float": ({"body": [OUTLINE | {"motions": ["yaw"]}]}, "does not feel the yaw"),
    "unstable": ({"body": [CYLINDER | {"draught": 0.5, "vertical_centre_of_gravity": 3.0}]}, "unstable in"),
    "column in a float": (
        {"body": [CYLINDER | {"draught": 0.5}], "column": [{"radius": 0.5, "position": [6.0, 3.0]}]},
        "touches a column",
    ),
    "column outside": ({"column": [{"radius": 0.5, "position": [12.0, 3.0]}]}, "column does not lie inside"),
    "columns together": ({"column": [{"radius": 0.5}, {"size": [1.0, 1.0]}]}, "touches another one"),
    "baffle of both kinds": ({"baffle": [{"start": [1.0, 0.0], "end": [1.0, 2.0], "radius": 1.0}]}, "vertical baffle"),
    "baffle above the water": ({"baffle": [{"level": 0.5, "radius": 1.0}]}, "not below the still surface"),
    "baffle outside": ({"baffle": [{"start": [12.0, 0.0], "end": [12.0, 6.0]}]}, "a baffle does not lie in the liquid"),
    "baffle in a float": (
        {"body": [CYLINDER | {"draught": 0.5}], "baffle": [{"start": [5.0, 0.0], "end": [5.0, 6.0]}]},
        "a baffle meets a float",
    ),
    "heavy liquid above": ({"liquid": [LAYERS[1], LAYERS[0]]}, "overturns at every wavelength"),
    "float through the interface": (
        {"liquid": [LAYERS[0], LAYERS[1] | {"depth": 0.4}], "body": [OUTLINE]},
        "no liquid",
    ),
    "bed on a line": (
        {"tank": BOX | {"bed": {"points": [[0.0, 0.0, 0.0], [5.0, 1.0, 0.5], [10.0, 2.0, 0.2]]}}},
        "lie on a line",
    ),
    "bed too steep": (
        {"tank": BOX | {"bed": {"points": [*CORNERS, [5.0, 3.0, 1.5], [5.5, 3.0, 0.0]]}}},
        "bed through the points is too steep",
    ),
    "beach": ({"tank": BOX | {"bed": {"slope": [0.7, 0.0]}}}, "A beach is drawn"),
    "no file": ({"tank": {"shape": "none.step"}}, "there is no file"),
    "too many cells": (
        {"tank": {"radius": 9281.0} | VOLUME, "liquid": [LAYERS[0] | {"depth": 2.5}, LAYERS[1] | {"depth": 0.1}]},
        "tetrahedra are needed",
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_what_does_not_fit_is_refused(case: str) -> None:
    changes, said = BAD[case]
    with pytest.raises(he.SceneError, match=said):
        solved(tank(BOX, 2.0) | changes, 1e-2, 1)


@pytest.mark.parametrize("x", [9.0, 0.5])
def test_a_float_beside_a_solid_of_cad_or_at_its_wall_is_refused(x: float, tmp_path: Path) -> None:
    file = solid(tmp_path / "tank.step", lambda occ: occ.addBox(0.0, 0.0, 0.0, 4.0, 3.0, 2.0))
    float_ = CYLINDER | {"radius": 0.5, "draught": 0.4, "position": [x, 1.5], "vertical_centre_of_gravity": -0.1}
    with pytest.raises(he.SceneError, match="body 1 does not lie in the liquid, or touches the tank"):
        solved(tank({"shape": str(file)}, 2.0, float_), 1e-2, 1)
