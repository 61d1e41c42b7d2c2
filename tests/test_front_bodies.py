"""Bodies at the front door: one above another, in the middle of a tank, at curved walls; volumes beside revolution."""

from __future__ import annotations

from itertools import pairwise
from math import cos, pi, sin
from pathlib import Path
from typing import Any, TypeAlias

import gmsh
import pytest
from click.testing import CliRunner

import hydroelastic as he
from hydroelastic.scenes.command_line import main

Place: TypeAlias = tuple[float, float, float]

WATER = {"density": 1000.0, "depth": 8.0}
RING = {"kind": "float", "shape": "revolved", "outline": [[2.0, -1.0], [3.0, -1.0], [3.0, 1.0], [2.0, 1.0]]}
AT_ONE = [{"kind": "radiation", "omega": [1.0]}]


def spar(foot: float, top: float = -4.0) -> dict[str, Any]:
    """A column with a heave plate of a radius, whose upper side lies at a height."""
    corners = [[0.0, -5.0], [foot, -5.0], [foot, top], [1.0, top], [1.0, 1.0], [0.0, 1.0]]
    return {"kind": "float", "shape": "revolved", "outline": corners, "vertical_centre_of_gravity": -4.0}


def section(foot: float, top: float = -4.0) -> dict[str, Any]:
    """A column with a heave plate of a half width under the edge of a rectangle from x = 2 m to 4 m, in deep water."""
    right = [[foot, -5.0], [foot, top], [0.5, top], [0.5, 2.0]]
    vertices = [*right, *([-x, y] for x, y in right[::-1])]
    common = {"kind": "float", "motions": ["heave"]}
    column = {"shape": "polygon", "vertices": vertices, "vertical_centre_of_gravity": -4.5}
    rectangle = {"shape": "rectangle", "position": 3.0, "half_width": 1.0, "half_height": 1.0}
    return {
        "kind": "sea",
        "liquid": [{"density": 1000.0, "depth": float("inf")}],
        "body": [common | column, common | rectangle],
        "analysis": AT_ONE,
        "accuracy": {"tolerance": 1e-3},
    }


def round_tank(*bodies: dict[str, Any], tolerance: float, volume: bool, modes: int = 4) -> dict[str, Any]:
    """Coaxial bodies in a round tank, as solids of revolution, or in a mesh of the volume."""
    motions = ["heave", "surge", "pitch"] + ["sway", "roll"] * volume
    place = {"position": [0.0, 0.0]} if volume else {}
    return {
        "kind": "tank",
        "tank": {"radius": 5.0},
        "liquid": [WATER],
        "body": [{"motions": motions} | body | place for body in bodies],
        "accuracy": {"tolerance": tolerance, "modes": modes},
    }


def box(*bodies: dict[str, Any], tolerance: float = 1e-1, **more: Any) -> dict[str, Any]:
    return {
        "kind": "tank",
        "tank": {"length": 12.0, "width": 8.0},
        "liquid": [{"density": 1000.0, "depth": 4.0}],
        "body": [{"kind": "float", "motions": ["heave"]} | body for body in bodies],
        "accuracy": {"tolerance": tolerance, "modes": 3},
    } | more


def heave_added_mass(scene: dict[str, Any]) -> tuple[float, float]:
    (found,) = he.solve(scene).summary["radiation"]
    return found["added_mass"][0][0][0], found["relative_error"][0]


def excess(volume: dict[str, Any], revolved: dict[str, Any]) -> list[float]:
    """Of each mode of a volume: its difference from the nearest one of revolution over the stated errors of both."""
    reference = he.solve(revolved).summary["modes"]
    found = []
    for mode in he.solve(volume).summary["modes"]:
        one = min(reference, key=lambda other: abs(other["omega"] - mode["omega"]))
        difference = abs(mode["omega"] / one["omega"] - 1.0)
        found.append(difference / (mode["relative_error"] + one["relative_error"]))
    return found


def test_a_heave_plate_may_reach_below_a_section() -> None:
    """Its added mass goes on as it did beside the section: 1.9 and 1.96 m are beside it, 2.02 m is below.

    A cubic or higher part of the curve over steps of 0.06 m of 2 m is less than (0.03)² = 1e-3 of the change by foot²,
    6 % a step; the stated errors are less than 1e-3.
    """
    beside, nearer, below = (heave_added_mass(section(foot)) for foot in (1.9, 1.96, 2.02))
    assert below[0] == pytest.approx(2.0 * nearer[0] - beside[0], rel=3.0 * 1e-3)
    assert below[0] > 1.02 * nearer[0]


@pytest.mark.slow
def test_a_heave_plate_under_a_ring_is_that_of_the_volume() -> None:
    """Two models of one tank; each mode within both stated errors."""
    bodies = RING | {"motions": ["heave"]}, spar(2.6) | {"motions": ["heave"]}
    revolved = round_tank(*bodies, tolerance=1e-4, volume=False, modes=5)
    assert max(excess(round_tank(*bodies, tolerance=3e-2, volume=True), revolved)) < 1.0


def test_a_heave_plate_may_reach_below_a_sphere_beside_its_column_until_it_touches() -> None:
    sphere = {"shape": "sphere", "radius": 0.5, "position": [7.2, 4.0]}

    def plate(top: float) -> dict[str, Any]:
        outline = [[0.0, -3.2], [1.5, -3.2], [1.5, top], [0.3, top], [0.3, 1.0], [0.0, 1.0]]
        return {"shape": "revolved", "outline": outline, "vertical_centre_of_gravity": -3.0}

    he.read(box(sphere, plate(-0.6)))
    with pytest.raises(he.SceneError, match=r"overlaps or touches \[\[body\]\] number 1"):
        he.read(box(sphere, plate(-0.5)))


@pytest.mark.parametrize(
    ("scene", "said"),
    [
        (section(2.5, top=-1.0), r"overlaps or touches \[\[body\]\] number 1, which reaches from -2.5 to 2.5 m"),
        (section(3.0, top=-1.001), "Leave a gap of at least 0.007 m"),
        (section(5.0, top=0.5), "overlaps or touches"),
        (round_tank(RING, spar(2.6, top=-1.0), tolerance=1e-2, volume=False), "overlaps or touches"),
        (
            round_tank(RING, spar(2.6, top=-1.0), tolerance=1e-2, volume=True),
            r"overlaps or touches \[\[body\]\] number 1",
        ),
        (
            box({"shape": "box", "size": [4.0, 4.0], "draught": 1.0}, {"shape": "sphere", "radius": 0.5}),
            r"overlaps or touches \[\[body\]\] number 1",
        ),
    ],
)
def test_bodies_that_overlap_or_touch_are_refused(scene: dict[str, Any], said: str) -> None:
    with pytest.raises(he.SceneError, match=said):
        he.read(scene)


def test_a_column_may_stand_in_the_hole_of_a_float_and_beside_another_one_at_an_angle() -> None:
    """Boxes around these overlap; what touches is refused."""
    ring = RING | {"outline": [[1.0, -1.0], [1.5, -1.0], [1.5, 1.0], [1.0, 1.0]], "position": [4.0, 4.0]}
    columns = [{"position": [4.0, 4.0], "radius": 0.5}, {"position": [5.3, 5.3], "radius": 0.3}]
    he.read(box(ring, column=columns))
    with pytest.raises(he.SceneError, match="the float touches a column"):
        he.read(box(ring, column=[{"position": [5.0, 5.0], "radius": 0.3}]))
    with pytest.raises(he.SceneError, match="the column touches another one"):
        he.read(box(column=[columns[0], {"position": [4.6, 4.6], "radius": 0.4}]))


@pytest.mark.slow_but("ring")
@pytest.mark.parametrize(
    "outline",
    [
        [[0.5, -1.0], [1.5, -1.0], [1.5, 1.0], [0.5, 1.0]],
        [[0.0, -1.5], [1.8, -1.5], [1.8, -1.0], [0.8, -1.0], [0.8, 1.0], [0.0, 1.0]],
    ],
    ids=["ring", "stepped"],
)
def test_revolved_floats_in_the_middle_of_a_box_are_those_beside_it(outline: list[list[float]]) -> None:
    """5 mm of 12 m beside it frequencies change by (π 0.005/12)² = 2e-6, which is less than the stated errors."""
    body = {"shape": "revolved", "outline": outline, "vertical_centre_of_gravity": -1.0}
    middle, beside = (
        he.solve(box(body | place, tolerance=3e-2)).summary for place in ({}, {"position": [6.005, 4.005]})
    )
    assert middle["status"] == beside["status"] == "ok"
    for one, other in zip(middle["modes"], beside["modes"], strict=True):
        difference = abs(one["omega"] / other["omega"] - 1.0)
        assert difference < one["relative_error"] + other["relative_error"]


@pytest.mark.slow_but("narrow hole")
@pytest.mark.parametrize(
    "outline",
    [
        [[0.1, -0.6], [1.0, -0.6], [1.0, 0.6], [0.1, 0.6]],
        [[0.0, -2.5], [0.3, 0.5], [0.0, 0.5]],
    ],
    ids=["narrow hole", "needle"],
)
def test_cells_that_a_curved_wall_would_invert_are_replaced(outline: list[list[float]]) -> None:
    """Large cells in a narrow hole have two edges on one circle, and at a tip all walls are curved too much; what
    straight cells there lose is in the stated error."""
    body = {"kind": "float", "shape": "revolved", "outline": outline, "vertical_centre_of_gravity": -1.8}
    scenes = (
        round_tank(body, tolerance=tolerance, volume=volume) for tolerance, volume in ((1e-1, True), (1e-5, False))
    )
    volume, revolved = scenes
    assert max(excess(volume, revolved)) < 1.0


SHAPES: dict[str, dict[str, Any]] = {
    "cylinder": {"shape": "cylinder", "radius": 1.5, "draught": 1.2, "vertical_centre_of_gravity": -0.5},
    "shallow cylinder": {"shape": "cylinder", "radius": 2.5, "draught": 0.2, "vertical_centre_of_gravity": -0.1},
    "sphere": {"shape": "sphere", "radius": 1.5, "vertical_centre_of_gravity": -0.2},
    "cone": {"shape": "revolved", "outline": [[0.0, -1.5], [1.5, 0.5], [0.0, 0.5]], "vertical_centre_of_gravity": -0.5},
}


@pytest.mark.slow_but("0.1-cone")
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("tolerance", [1e-1, 1e-2])
def test_the_stated_error_of_a_volume_covers_its_difference_from_the_solid_of_revolution(
    shape: str, tolerance: float
) -> None:
    """In the mean the shown part of a corner's error is 0.8 of it; of some modes on coarse meshes it is 0.42."""
    body = {"kind": "float"} | SHAPES[shape]
    revolved = round_tank(body, tolerance=1e-6, volume=False, modes=8)
    ratios = excess(round_tank(body, tolerance=tolerance, volume=True, modes=8), revolved)
    assert max(ratios) < 1.0


def square(half: float) -> list[tuple[float, float]]:
    return [(-half, -half), (half, -half), (half, half), (-half, half)]


def circle(radius: float, count: int) -> list[tuple[float, float]]:
    angles = [2.0 * pi * number / count for number in range(count)]
    return [(radius * cos(angle), radius * sin(angle)) for angle in angles]


def walls(*loops: tuple[list[tuple[float, float]], float]) -> list[tuple[Place, Place, Place]]:
    """Triangles of the faces from each loop of corners at a height to the next one, which has as many corners."""
    found: list[tuple[Place, Place, Place]] = []
    for (one, low), (other, high) in pairwise(loops):
        for number in range(len(one)):
            after = (number + 1) % len(one)
            a, b, c, d = (*one[number], low), (*one[after], low), (*other[after], high), (*other[number], high)
            found += [(a, b, c), (a, c, d)]
    return found


def hull_file(file: Path, triangles: list[tuple[Place, Place, Place]]) -> Path:
    facets = (
        "facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in corners)
        for corners in triangles
    )
    file.write_text("solid x\n" + "".join(one + "endloop\nendfacet\n" for one in facets) + "endsolid x\n")
    return file


def hull(file: Path, **more: Any) -> dict[str, Any]:
    given = {
        "shape": "hull",
        "file": str(file),
        "vertical_centre_of_gravity": -0.6,
        "radii_of_gyration": [1.0, 1.2, 1.3],
    }
    return given | more


def square_ring(folder: Path) -> Path:
    """A square ring of 4 m with a moonpool of 2 m, immersed by 1 m; open above the water."""
    outer, inner = square(2.0), square(1.0)
    return hull_file(folder / "ring.stl", walls((inner, 0.5), (inner, -1.0), (outer, -1.0), (outer, 0.5)))


SPHERE = {"shape": "sphere", "radius": 0.4}


@pytest.mark.slow_but("empty")
@pytest.mark.parametrize("inside", [(), (SPHERE,)], ids=["empty", "with a sphere"])
def test_a_moonpool_of_triangles_is_that_of_the_solid(inside: tuple[dict[str, Any], ...], tmp_path: Path) -> None:
    """Two meshes of one tank: of triangles, and of a solid of CAD. The sixth mode is the water of the moonpool's."""
    with_solid = tmp_path / "ring.step"
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Verbosity", 0)
    gmsh.option.setString("Geometry.OCCTargetUnit", "M")
    boxes = [(3, gmsh.model.occ.addBox(-half, -half, -1.0, 2.0 * half, 2.0 * half, 1.5)) for half in (2.0, 1.0)]
    gmsh.model.occ.cut(boxes[:1], boxes[1:])
    gmsh.model.occ.synchronize()
    gmsh.write(str(with_solid))
    gmsh.finalize()
    accuracy = {"accuracy": {"tolerance": 1e-1, "modes": 8}}
    one, other = (
        he.solve(box(hull(file), *inside) | accuracy).summary["modes"] for file in (square_ring(tmp_path), with_solid)
    )
    for mode, same in zip(one, other, strict=True):
        assert abs(mode["omega"] / same["omega"] - 1.0) < mode["relative_error"] + same["relative_error"]


def test_a_body_in_the_wall_of_a_hull_of_triangles_is_refused(tmp_path: Path) -> None:
    file = square_ring(tmp_path)
    he.read(box(hull(file), SPHERE))
    for x in (6.7, 7.5):
        with pytest.raises(he.SceneError, match=r"overlaps or touches \[\[body\]\] number 1"):
            he.read(box(hull(file), SPHERE | {"position": [x, 4.0]}))


@pytest.mark.slow
@pytest.mark.parametrize("turn", [0, 31])
def test_a_thin_rim_is_meshed_in_any_order_of_its_triangles(turn: int, tmp_path: Path) -> None:
    """A column on a plate of 2 m radius and 0.02 m thickness of 48 chords, beside the solid of revolution, which is
    larger by the chords: 1 − sin(2π/48)/(2π/48) = 2.9e-3 of the volume, and so at most half of it in frequency."""
    wide, thin, middle = circle(2.0, 48), circle(0.7, 48), (0.0, 0.0, -1.5)
    bottom = [((*two, -1.5), (*one, -1.5), middle) for one, two in pairwise([*wide, wide[0]])]
    triangles = bottom + walls((wide, -1.5), (wide, -1.48), (thin, -1.48), (thin, 0.5))
    file = hull_file(tmp_path / "rim.stl", triangles[turn:] + triangles[:turn])
    body = hull(file, vertical_centre_of_gravity=-1.2)
    outline = [[0.0, -1.5], [2.0, -1.5], [2.0, -1.48], [0.7, -1.48], [0.7, 0.5], [0.0, 0.5]]
    revolved = {"shape": "revolved", "outline": outline, "vertical_centre_of_gravity": -1.2}
    one, other = (he.solve(box(given, tolerance=1e-2)).summary["modes"][0] for given in (body, revolved))
    assert one["kind"] == other["kind"] == "heave"
    stated = one["relative_error"] + other["relative_error"]
    assert abs(one["omega"] / other["omega"] - 1.0) < stated + 1.5e-3


def command(*words: str) -> tuple[int, str]:
    found = CliRunner().invoke(main, words)
    return found.exit_code, " ".join(found.output.split())


def test_a_ledge_at_the_still_level_is_told_with_both_waterplanes(tmp_path: Path) -> None:
    """A block of 4 m with another one of 2 m on it: 16 m² below the ledge, 4 m² above."""
    wide, narrow = square(2.0), square(1.0)
    bottom = [
        ((-2.0, -2.0, -1.0), (2.0, 2.0, -1.0), (2.0, -2.0, -1.0)),
        ((-2.0, -2.0, -1.0), (-2.0, 2.0, -1.0), (2.0, 2.0, -1.0)),
    ]
    hull_file(tmp_path / "ledge.stl", bottom + walls((wide, -1.0), (wide, 0.0), (narrow, 0.0), (narrow, 0.5)))
    scene = tmp_path / "ledge.toml"
    scene.write_text(
        'kind = "tank"\ntank = {length = 12.0, width = 8.0}\nliquid = [{density = 1000.0, depth = 4.0}]\n'
        'accuracy = {tolerance = 1e-1, modes = 1}\n[[body]]\nkind = "float"\nshape = "hull"\nfile = "ledge.stl"\n'
        'vertical_centre_of_gravity = -0.9\nradii_of_gyration = [0.7, 1.2, 1.3]\nmotions = ["heave"]\n'
    )
    said = (
        "lie exactly at the still level. The waterplane just below them is taken, of 16 m²; just above them it is 4 m²."
    )
    for words in (("check", str(scene)), ("run", str(scene), "--no-images", "--out", str(tmp_path / "out"))):
        code, output = command(*words)
        assert code == 0
        assert said in output
    (rest,) = he.load(tmp_path / "out").summary["bodies"]
    assert rest["heave_stiffness"] == pytest.approx(1000.0 * 9.81 * 16.0)
    code, output = command("check", str(scene), "--set", "body.1.draught=0.999")
    assert code == 0
    assert "still level. The waterplane" not in output


def test_a_float_of_no_draught_is_one_error_of_check_and_run(tmp_path: Path) -> None:
    changes = ("--set", "body.1.draught=3e-8")
    out = tmp_path / "out"
    checked, run = (
        command("check", "barge_in_a_dock", *changes),
        command("run", "barge_in_a_dock", *changes, "--out", str(out)),
    )
    assert checked == run
    code, said = checked
    assert code == 2
    assert said.count("Error") == 1
    assert 'key "draught" = 3e-08' in said
    assert "Allowed: 0.0003 m at least" in said
    assert not out.exists()
