"""Shapes of modes with two liquids and floats: what the curves, sections and fields say of each other."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest

from hydroelastic.fem.pictures.mode import SurfaceCurve
from hydroelastic.fem.shape_curves import largest_of
from hydroelastic.fem.tank.mode_shapes import ModeShapes, sample_shapes
from hydroelastic.scenes.models.bodies import Beam, Float
from hydroelastic.scenes.models.body_kinds import Body
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.models.tank_parts import Accuracy, Liquid, Tank
from hydroelastic.scenes.run import run_scene

LENGTH = 10.0
LOWER, UPPER = (1000.0, 4.0), (800.0, 3.0)
BOX: dict[str, Any] = {"kind": "float", "shape": "rectangle", "half_width": 1.2, "half_height": 0.5}
ALL: dict[str, Any] = {"motions": ("heave", "sway", "roll")}
LENS: dict[str, Any] = {"kind": "float", "shape": "parabola", "half_width": 0.3, "half_height": 1.2}
# Upright on the left, lopsided below: heave and roll are coupled.
KEEL: dict[str, Any] = {"kind": "float", "shape": "polygon"} | ALL
KEEL["vertices"] = ((-1.0, 0.5), (-1.0, -0.4), (0.3, -0.7), (1.0, -0.4), (1.0, 0.5))
TALL: dict[str, Any] = BOX | ALL | {"half_width": 0.4, "half_height": 1.0, "unstable": "solve"}


def scene(
    *bodies: Body, layers: Any = (LOWER, UPPER), top: Any = "free", modes: int = 4, tolerance: float = 1e-8
) -> TankScene:
    return TankScene(
        tank=Tank(length=LENGTH, top=top),
        liquid=tuple(Liquid(density=density, depth=depth) for density, depth in layers),
        body=bodies,
        accuracy=Accuracy(tolerance=tolerance, modes=modes),
    )


def sample(solution: Any) -> ModeShapes:
    shapes = sample_shapes(solution)
    assert shapes is not None
    return shapes


def integral(values: np.ndarray, x: np.ndarray) -> float:
    """∫ over a curve whose facets have an even number of equal steps each, by Simpson's rule."""
    from scipy.integrate import simpson

    return float(simpson(values, x=x))


def of_kind(curves: tuple[SurfaceCurve, ...], kind: str) -> list[SurfaceCurve]:
    return [curve for curve in curves if curve.kind == kind]


def test_a_heaving_circle_moves_as_a_whole_by_its_amplitude(tanks: Any) -> None:
    circle = Float(kind="float", shape="ellipse", half_width=1.0, half_height=1.0, position=5.0)
    solution = tanks.solve(scene(circle, layers=(LOWER,)))
    shapes = sample(solution)
    for mode, (section,) in zip(solution.asked, shapes.floats, strict=True):
        assert np.hypot(*(section.contour - [5.0, 0.0]).T) == pytest.approx(1.0, rel=1e-14)
        # To metres at 1 kg/m: by the root of the unit of mass, ρL².
        amplitude = abs(mode.body_amplitudes[0]) / np.sqrt(LOWER[0] * LENGTH**2)
        assert section.displacement == pytest.approx(np.tile([0.0, amplitude], (len(section.contour), 1)), abs=1e-17)


@pytest.mark.slow_but("True-exact", "False-thin")
@pytest.mark.parametrize("boundary", ["exact", "thin"])
@pytest.mark.parametrize("halves", [True, False])
def test_the_interface_makes_room_for_the_float(tanks: Any, boundary: Any, halves: bool) -> None:
    """Under a lid ∫η = −2b a for a heave a of a float 2b wide: the lower liquid keeps its volume."""
    solution = tanks.solve(
        scene(Float(**LENS, position=5.0, boundary=boundary), top="rigid", tolerance=1e-6), halves=halves
    )
    shapes = sample(solution)
    assert solution.field.half is halves
    moved = 0
    for curves, (section,) in zip(shapes.curves, shapes.floats, strict=True):
        volume = sum(integral(curve.displacement, curve.x) for curve in of_kind(curves, "interface"))
        heave = section.displacement[0, 1]
        largest = max(np.abs(curve.displacement).max() for curve in curves)
        # Simpson's rule on 2p steps a facet; measured 4e-7 of the volume where the float moves.
        assert volume == pytest.approx(-2.0 * 0.3 * heave, rel=2e-6, abs=1e-9 * largest)
        moved += abs(heave) > 1e-3 * largest
        assert (section.slit is not None) == (boundary == "thin")
    assert moved == 2


@pytest.mark.slow
def test_halves_give_the_floats_and_surfaces_of_the_whole_tank(tanks: Any) -> None:
    asked = scene(Float(**BOX, **ALL, position=5.0), tolerance=1e-9)
    one, other = tanks.solve(asked), tanks.solve(asked, halves=False)
    assert (one.field.half, other.field.half) == (True, False)
    mine, theirs = sample(one), sample(other)
    for number in range(4):
        (section,), (expected,) = mine.floats[number], theirs.floats[number]
        size = np.abs(expected.displacement).max()
        assert section.contour == pytest.approx(expected.contour, abs=1e-12)
        # Amplitudes err like the frequencies, 1e-9; measured 1e-10.
        assert section.displacement == pytest.approx(expected.displacement, abs=1e-8 * size)
        for curve, same in zip(mine.curves[number], theirs.curves[number], strict=True):
            assert (curve.kind, curve.level) == (same.kind, same.level)
            assert curve.x[[0, -1]] == pytest.approx(same.x[[0, -1]], abs=1e-12)
            moments = [integral(c.displacement * np.cos(c.x), c.x) for c in (curve, same)]
            # Both by Simpson's rule on their own facets.
            assert moments[0] == pytest.approx(moments[1], abs=1e-6 * size)


@pytest.mark.slow_but("keel")
@pytest.mark.parametrize("body", [BOX | ALL, KEEL], ids=["box", "keel"])
def test_the_liquid_follows_the_side_of_a_float(tanks: Any, body: dict[str, Any]) -> None:
    """∂ψ/∂x is the float's displacement to the right on its upright side, in both liquids."""
    shapes = sample(tanks.solve(scene(Float(**body, position=3.7), tolerance=1e-6)))
    points = shapes.liquid.points
    for number, (section,) in enumerate(shapes.floats):
        left = section.contour[:, 0].min()
        side = np.flatnonzero(section.contour[:, 0] < left + 1e-9)
        side = side[np.argsort(section.contour[side, 1])]
        # Away from the corners, where ∇ψ has no bound.
        (on,) = np.nonzero((np.abs(points[:, 0] - left) < 1e-9) & (np.abs(points[:, 1]) < 0.25))
        assert len(on) > 20
        expected = np.interp(points[on, 1], section.contour[side, 1], section.displacement[side, 0])
        flow = shapes.liquid.displacement[number, on, 0]
        # Gradients err like the root of the frequency's error, 1e-6; measured 4e-4.
        assert np.abs(flow - expected).max() <= 2e-3 * np.abs(section.displacement).max()


def test_the_section_of_a_float_stays_rigid(tanks: Any) -> None:
    for (section,) in sample(tanks.solve(scene(Float(**KEEL, position=3.7), tolerance=1e-6))).floats:
        x, y = section.contour.T
        ones, zeros = np.ones_like(x), np.zeros_like(x)
        motions = np.vstack([np.column_stack([ones, zeros, -y]), np.column_stack([zeros, ones, x])])
        moved = section.displacement.T.ravel()
        fitted = motions @ np.linalg.lstsq(motions, moved, rcond=None)[0]
        assert fitted == pytest.approx(moved, abs=1e-13 * np.abs(moved).max())


@pytest.mark.slow
def test_twin_floats_mirror_each_other(tanks: Any) -> None:
    twins = [Float(**BOX | ALL | {"half_width": 0.9}, position=position) for position in (2.5, 7.5)]
    solution = tanks.solve(scene(*twins))
    shapes = sample(solution)
    assert solution.field.half
    for number, (left, right) in enumerate(shapes.floats):
        sign = 1.0 if solution.field.parity(number) == "symmetric" else -1.0
        corners = [section.contour - [5.0, 0.0] for section in (left, right)]
        image = np.abs(corners[1][:, None] * [-1.0, 1.0] - corners[0][None]).max(axis=2).argmin(axis=0)
        assert right.displacement[image] * [-sign, sign] == pytest.approx(
            left.displacement, abs=1e-12 * np.abs(left.displacement).max()
        )


def test_both_liquids_follow_the_interface_and_the_upper_one_the_top(tanks: Any) -> None:
    """∂ψ/∂y = η from below and from above, and ζ at the top."""
    shapes = sample(tanks.solve(scene()))
    points, triangles = shapes.liquid.points, shapes.liquid.triangles
    for number, curves in enumerate(shapes.curves):
        (interface,), (top,) = of_kind(curves, "interface"), of_kind(curves, "free_surface")
        assert (interface.level, top.level) == (0.0, UPPER[1])
        for curve, liquid in ((interface, 1), (interface, 2), (top, 2)):
            own = np.unique(triangles[shapes.liquid.liquid == liquid])
            on = own[np.abs(points[own, 1] - curve.level) < 1e-12]
            assert len(on) > 20
            rise = shapes.liquid.displacement[number, on, 1]
            expected = np.interp(points[on, 0], curve.x, curve.displacement)
            # Linear interpolation between samples 0.1 m apart, (k·0.1)²/8 with k = 4π/10: 2e-3.
            assert np.abs(rise - expected).max() <= 4e-3 * np.abs(interface.displacement).max()
        assert largest_of(interface.displacement) > 0.0


@pytest.mark.slow
def test_beams_lie_on_their_levels(tanks: Any) -> None:
    beam = {"length": 4.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0}
    solution = tanks.solve(scene(Beam(start=1.0, **beam), Beam(start=5.0, at="surface", **beam), tolerance=1e-2))
    for curves in sample(solution).curves:
        assert [curve.level for curve in of_kind(curves, "body")] == [0.0, UPPER[1]]
        bounds = [tuple(curve.x[[0, -1]].round(9)) for curve in of_kind(curves, "interface")]
        assert bounds == [(0.0, 1.0), (5.0, 10.0)]


# --- files


@pytest.fixture(scope="module")
def unstable(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A slender box that capsizes, run to its folder."""
    folder = tmp_path_factory.mktemp("shapes") / "result"
    run_scene(scene(Float(**TALL, position=3.7), top="rigid", modes=2, tolerance=1e-5), out=folder)
    return folder


@pytest.mark.slow
def test_the_file_tells_the_liquids_apart(unstable: Path) -> None:
    grid = meshio.read(unstable / "fields" / "modes.vtu")
    (cells,), (liquid,) = grid.cells, grid.cell_data["liquid"]
    assert np.issubdtype(liquid.dtype, np.integer)
    corners = grid.points[cells.data, :2]
    areas = 0.5 * np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1]))
    for number, (_, depth), sign in ((1, LOWER, -1), (2, UPPER, 1)):
        own = liquid == number
        assert (sign * corners[own, :, 1] >= -1e-12).all()
        # A half of the box lies in each liquid.
        assert areas[own].sum() == pytest.approx(LENGTH * depth - 0.8 * 1.0, rel=1e-12)


def test_growing_modes_have_names_of_their_own(unstable: Path) -> None:
    grid = meshio.read(unstable / "fields" / "modes.vtu")
    names = ("001", "002", "growing_001")
    assert set(grid.point_data) == {f"{kind}_{name}" for kind in ("potential", "displacement") for name in names}
    images = sorted((unstable / "images").iterdir())
    assert [path.name for path in images] == ["growing_001.png", "mode_001.png", "mode_002.png", "overview.png"]
    assert all(path.stat().st_size > 10_000 for path in images)


def test_a_growing_roll_turns_anticlockwise_and_hardly_moves_the_water(tanks: Any) -> None:
    """The half and the whole agree on it."""
    asked = scene(Float(**TALL, position=5.0), layers=(LOWER,), modes=2, tolerance=1e-5)
    found = []
    for halves in (True, False):
        shapes = sample(tanks.solve(asked, halves=halves))
        assert shapes.growing == 1
        ((section,), curves) = shapes.floats[-1], shapes.curves[-1]
        right = section.contour[:, 0].argmax()
        assert section.displacement[right, 1] > 0.0
        # It grows too fast for waves: λψ/g is a few percent of the roll.
        waves = max(np.abs(curve.displacement).max() for curve in curves)
        assert 0.0 < waves < 0.2 * section.largest
        found.append(section.displacement)
    assert found[0] == pytest.approx(found[1], abs=1e-4 * np.abs(found[1]).max())


def test_rounding_does_not_choose_the_sign_of_a_mode() -> None:
    # An antisymmetric mode: both ends move alike, and differ by a few units of rounding.
    for rounding in (-1e-13, 1e-13):
        assert largest_of(np.array([-0.3 * (1.0 + rounding), 0.0, 0.3])) == pytest.approx(-0.3, rel=1e-12)
    assert largest_of(np.array([-0.3, 0.0, 0.31])) == 0.31
