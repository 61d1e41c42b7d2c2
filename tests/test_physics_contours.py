"""Contours: cut by a level exactly, with exact areas; splines through points; crossings are found."""

from __future__ import annotations

from itertools import pairwise
from math import asin, cos, hypot, pi, sin, sqrt
from pathlib import Path

import numpy as np
import pytest

from hydroelastic.physics.contours import Arc, Contour, straight_arc, turn_between
from hydroelastic.physics.point_contours import outline_contour, polygon_contour, self_crossing
from hydroelastic.physics.profiles import FloatShape, float_profile
from hydroelastic.scenes.models.bodies import Float
from hydroelastic.scenes.models.floats import float_contour

SHAPES: tuple[FloatShape, ...] = ("exponential", "parabola", "ellipse", "wedge", "rectangle")
# Gauss points and weights of numpy are good to some 1e-15 of the interval.
EXACT = 2e-14


def profile(shape: FloatShape, half_width: float = 0.3, half_height: float = 2.0) -> Contour:
    return float_contour(Float(shape=shape, position=0, half_width=half_width, half_height=half_height), Path())


def random_polygon(random: np.random.Generator) -> np.ndarray:
    """A polygon whose vertices are seen from the origin one after the other, but which is seldom convex."""
    angles = np.sort(random.uniform(0, 2 * pi, random.integers(4, 12)))
    radii = random.uniform(0.3, 2.0, len(angles))
    return np.column_stack([radii * np.cos(angles), radii * np.sin(angles)]) + random.uniform(-0.2, 0.2, 2)


def vertices(points: np.ndarray) -> tuple[tuple[float, float], ...]:
    return tuple((float(x), float(y)) for x, y in points)


def clipped_area_and_moments(points: np.ndarray, level: float) -> np.ndarray:
    """Area, ∫x dA and ∫y dA of a polygon below a level, by cutting each trapezium between an edge and the level."""
    sums = np.zeros(3)
    for (x1, y1), (x2, y2) in zip(points, np.roll(points, -1, axis=0), strict=True):
        if max(y1, y2) <= level:
            ends = [(x1, y1), (x2, y2)]
        elif min(y1, y2) >= level:
            continue
        else:
            x = x1 + (level - y1) / (y2 - y1) * (x2 - x1)
            ends = [(x1, y1), (x, level)] if y1 < level else [(x, level), (x2, y2)]
        (a, ya), (b, yb) = ends
        p, q = level - ya, level - yb
        # Depth is linear in x between the ends: Simpson's rule is exact for its products with x.
        for weight, x, depth in ((1, a, p), (4, (a + b) / 2, (p + q) / 2), (1, b, q)):
            part = weight * (b - a) / 6 * depth
            sums += part * np.array([1.0, x, level - depth / 2])
    return sums


@pytest.mark.parametrize("shape", SHAPES)
def test_contours_run_counterclockwise_without_gaps(shape: FloatShape) -> None:
    contour = profile(shape)
    for before, after in zip(contour.arcs, (*contour.arcs[1:], contour.arcs[0]), strict=True):
        assert before.end == after.start
    assert contour.moments().area > 0
    for arc in contour.arcs:
        ends = arc.point(np.array([0.0, 1.0]))
        np.testing.assert_array_equal(ends, [arc.start, arc.end])
        np.testing.assert_allclose(arc.curve(np.array([0.0, 1.0])), ends, atol=1e-15)


@pytest.mark.parametrize("shape", SHAPES)
def test_velocities_are_derivatives(shape: FloatShape) -> None:
    t, step = np.linspace(0.05, 0.95, 7), 1e-5
    for arc in profile(shape).arcs:
        difference = (arc.curve(t + step) - arc.curve(t - step)) / (2 * step)
        # Central differences: step² times the third derivative, some 300 of the exponential, over 6.
        np.testing.assert_allclose(arc.velocity(t), difference, atol=2e-8)


@pytest.mark.parametrize("shape", SHAPES)
def test_corners_are_those_of_the_profile(shape: FloatShape) -> None:
    right = float_profile(shape, 0.3, 2.0).corners
    assert set(profile(shape).corners) == {(sign * float(x), float(y)) for x, y in right for sign in (1, -1)}


# Areas, centroids and radii of gyration in closed form, for half width b and half height h.
@pytest.mark.parametrize(
    ("shape", "area", "height", "gyration_x", "gyration_y"),
    [
        ("ellipse", pi, 4 / (3 * pi), 1 / 4, 1 / 4),
        ("parabola", 8 / 3, 3 / 8, 8 / 35, 1 / 5),
        ("wedge", 2, 1 / 3, 1 / 6, 1 / 6),
        ("rectangle", 4, 1 / 2, 1 / 3, 1 / 3),
    ],
)
def test_areas_are_those_of_closed_forms(
    shape: FloatShape, area: float, height: float, gyration_x: float, gyration_y: float
) -> None:
    b, h = 0.3, 2.0
    contour = profile(shape, b, h)
    whole, below = contour.moments(), contour.moments(0.0)
    assert whole.area == pytest.approx(area * b * h, rel=EXACT)
    assert below.area == pytest.approx(area * b * h / 2, rel=EXACT)
    assert below.centroid == pytest.approx((0.0, -height * h), rel=EXACT, abs=EXACT)
    assert whole.second == pytest.approx((gyration_x * b * b * whole.area, gyration_y * h * h * whole.area), rel=EXACT)
    assert whole.radius_of_gyration == pytest.approx(sqrt(gyration_x * b * b + gyration_y * h * h), rel=EXACT)


def test_the_area_of_the_exponential_holds_its_tail() -> None:
    # 4 b h ∫₀^T (e^{-s} - τ)/(1 - τ) ds with T = ln 1/τ: 4 b h (1 - τ - τ T)/(1 - τ).
    tail = 1e-3
    expected = 4 * 0.3 * 2.0 * (1 - tail - tail * np.log(1 / tail)) / (1 - tail)
    assert profile("exponential").moments().area == pytest.approx(expected, rel=EXACT)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("part", [-0.97, -0.4, 0.0, 1e-6, 0.3, 0.95])
def test_a_level_cuts_a_profile_in_two_chains(shape: FloatShape, part: float) -> None:
    contour = profile(shape)
    left, right, _, high = contour.bounds
    level = part * high
    below, above = contour.below(level), contour.above(level)
    for chain in (below, above):
        assert chain[0].start[1] == chain[-1].end[1] == level
        for one, other in pairwise(chain):
            assert one.end == other.start
    assert below[0].start == above[-1].end
    assert below[-1].end == above[0].start
    assert left <= below[0].start[0] < 0 < below[-1].end[0] <= right
    t = np.linspace(0, 1, 33)
    assert all(arc.point(t)[:, 1].max() <= level for arc in below)
    assert all(arc.point(t)[:, 1].min() >= level for arc in above)
    parts = [contour.moments(level, side=side).area for side in ("below", "above")]  # type: ignore[arg-type]
    assert sum(parts) == pytest.approx(contour.moments().area, rel=EXACT)
    # The contact point lies on the curve: the profile's own half-width there.
    assert below[-1].end[0] == pytest.approx(-below[0].start[0], rel=1e-13)


def test_contact_points_of_the_ellipse_are_those_of_its_equation() -> None:
    for y in (-1.99, -0.7, 0.1, 1.5):
        (x, _) = profile("ellipse").below(y)[-1].end
        # Near the top an ulp of y is h/√(h² - y²) of them in x.
        assert x == pytest.approx(0.3 * sqrt(1 - (y / 2) ** 2), rel=1e-13)
    chord = profile("ellipse", 1.0, 1.0).moments(0.5).area
    assert chord == pytest.approx(pi - (pi / 3 - 0.5 * sqrt(0.75)), rel=EXACT)


def test_corners_on_the_level_are_contact_points_exactly() -> None:
    for shape in ("wedge", "exponential"):
        below = profile(shape).below(0.0)
        assert (below[0].start, below[-1].end) == ((-0.3, 0.0), (0.3, 0.0))
        # What rounding puts beside the level is on it.
        beside = profile(shape).moved((0.0, 1e-12)).below(0.0)
        assert beside[0].start == (-0.3, 0.0)
        assert len(beside) == len(below)
    house = polygon_contour(((-1, -1), (1, -1), (1, 0), (0, 1), (-1, 0)))
    assert [arc.start for arc in house.below(0.0)] == [(-1, 0), (-1, -1), (1, -1)]
    assert [arc.start for arc in house.above(0.0)] == [(1, 0), (0, 1)]


@pytest.mark.parametrize("shape", SHAPES)
def test_levels_beside_a_corner_are_cut_too(shape: FloatShape) -> None:
    contour, section = profile(shape, 0.0444, 0.1603), float_profile(shape, 0.0444, 0.1603)
    for distance in np.geomspace(1e-16, 1e-2, 200):
        for level in (float(distance), -float(distance)):
            contact = contour.below(level)[-1].end
            # Levels within AT_LEVEL of a corner meet it; half-widths have slopes of 1 at most here.
            assert contact == pytest.approx((float(section.half_width_at(level)), level), abs=5e-12)


@pytest.mark.parametrize(
    ("corners", "reason"),
    [
        (((-1, -1), (1, -1), (1, 0), (-1, 0)), "along the still level"),
        (((-1, -1), (1, -1), (1, 1), (0.5, 0), (0.2, 0), (-1, 1)), "along the still level"),
        (((-1, 0.5), (1, 0.5), (0, 1)), "wholly above"),
        (((-1, -1), (1, -1), (0, 0)), "wholly below"),
        (((-1, -1), (1, -1), (1, 1), (0, -0.5), (-1, 1)), "in 4 points"),
        (((-1, -1), (1, -1), (1, 1), (0, 0), (-1, 1)), "in 3 points"),
    ],
)
def test_other_cuts_are_refused(corners: tuple[tuple[float, float], ...], reason: str) -> None:
    for chain in (polygon_contour(corners).below, polygon_contour(corners).above):
        with pytest.raises(ValueError, match=reason):
            chain(0.0)


@pytest.mark.parametrize("seed", range(40))
def test_polygons_are_cut_like_trapezia(seed: int) -> None:
    random = np.random.default_rng(seed)
    points = random_polygon(random)
    contour = polygon_contour(vertices(points))
    assert contour.bounds == (*sorted((points[:, 0].min(), points[:, 0].max())), points[:, 1].min(), points[:, 1].max())
    # Also where the level cuts the polygon more than twice, or passes through a vertex.
    for level in (random.uniform(-1, 1), points[1, 1]):
        found = contour.moments(level)
        expected = clipped_area_and_moments(points, level)
        np.testing.assert_allclose([found.area, *found.first], expected, atol=1e-13)


@pytest.mark.parametrize("seed", range(10))
def test_moments_follow_a_contour(seed: int) -> None:
    random = np.random.default_rng(seed)
    contour = profile(SHAPES[seed % len(SHAPES)])
    factor, (x, y) = random.uniform(0.01, 100), random.uniform(-3, 3, 2)
    moved = contour.moved((x, y)).scaled(factor)
    one, other = contour.moments(0.5), moved.moments(factor * (0.5 + y))
    assert other.area == pytest.approx(factor**2 * one.area, rel=1e-13)
    assert other.centroid[0] == pytest.approx(factor * (one.centroid[0] + x), rel=1e-13)
    assert other.centroid[1] == pytest.approx(factor * (one.centroid[1] + y), rel=1e-12)
    assert other.radius_of_gyration == pytest.approx(factor * one.radius_of_gyration, rel=1e-10)
    # The level of one cut is that of the other.
    np.testing.assert_allclose(
        [arc.start for arc in moved.below(factor * (0.5 + y))],
        [(factor * (arc.start[0] + x), factor * (arc.start[1] + y)) for arc in contour.below(0.5)],
        rtol=1e-12,
    )


def test_parts_of_arcs_keep_exact_ends_and_knots() -> None:
    points = np.array([[0.0, 0.0], [1.0, 0.2], [2.0, 0.5], [3.0, 0.9], [1.5, 3.0]])
    arc = next(arc for arc in outline_contour(points, 60).arcs if not arc.straight)
    part = arc.part(0.3, 0.9, end=(7.0, 7.0))
    np.testing.assert_allclose(part.point(np.array([0.5])), arc.point(np.array([0.6])), rtol=1e-14)
    assert part.point(np.array([1.0])).tolist() == [[7.0, 7.0]]
    assert part.start == pytest.approx(tuple(arc.point(np.array([0.3]))[0]))
    assert all(0 < knot < 1 for knot in part.knots)
    assert len(part.knots) == sum(0.3 < knot < 0.9 for knot in arc.knots)


def test_turns_and_bounds_of_a_smooth_outline() -> None:
    angles = np.linspace(0, 2 * pi, 60, endpoint=False)
    tilt = 0.4
    x, y = 2 * np.cos(angles), np.sin(angles)
    points = np.column_stack([x * cos(tilt) - y * sin(tilt), x * sin(tilt) + y * cos(tilt)])
    contour = outline_contour(points, 30)
    width = hypot(2 * cos(tilt), sin(tilt))
    height = hypot(2 * sin(tilt), cos(tilt))
    # Measured: 1.2e-6; splines through 60 points of an ellipse miss it by some (2π/60)⁴ of its size over 100.
    assert contour.bounds == pytest.approx((-width, width, -height, height), abs=3e-6)
    assert contour.moments().area == pytest.approx(2 * pi, rel=1e-5)
    assert contour.corners == ()


@pytest.mark.parametrize("count", [24, 48, 96])
def test_splines_converge_with_their_fourth_power(count: int) -> None:
    angles = np.linspace(0, 2 * pi, count, endpoint=False)
    area = outline_contour(np.column_stack([np.cos(angles), np.sin(angles)]), 30).moments().area
    # Measured: 0.5 (2π/n)⁴ π/180 at most.
    assert abs(area / pi - 1) < (2 * pi / count) ** 4 / 180


def ship_section() -> np.ndarray:
    """A flat bottom 16 m wide and sides 6 m high, joined by bilges of radius 2 m, in 15 degrees each."""
    angles = np.radians(np.arange(-90, 1, 15))
    bilge = np.column_stack([8 + 2 * np.cos(angles), 2 + 2 * np.sin(angles)])
    right = np.vstack([[0.0, 0.0], [4.0, 0.0], bilge, [10.0, 5.0], [10.0, 8.0]])
    return np.vstack([right, (right * (-1.0, 1.0))[:0:-1]])


def test_three_points_in_a_line_are_a_straight_side() -> None:
    contour = outline_contour(ship_section(), 30)
    straight = [arc for arc in contour.arcs if arc.straight]
    assert [(arc.start, arc.end) for arc in straight] == [
        ((10.0, 2.0), (10.0, 8.0)),
        ((10.0, 8.0), (-10.0, 8.0)),
        ((-10.0, 8.0), (-10.0, 2.0)),
        ((-8.0, 0.0), (8.0, 0.0)),
    ]
    assert contour.corners == ((10.0, 8.0), (-10.0, 8.0))
    # The bilges are circles to (π/12)⁴/384 of their radius.
    for arc in contour.arcs:
        if not arc.straight:
            x, y = arc.point(np.linspace(0, 1, 50)).T
            np.testing.assert_allclose(np.hypot(np.abs(x) - 8, y - 2), 2, atol=1e-4)
    assert contour.moments().area == pytest.approx(160 - 2 * (4 - pi), rel=1e-5)


def test_outlines_may_be_given_in_either_sense_and_begin_anywhere() -> None:
    points = ship_section()
    expected = outline_contour(points, 30).moments()
    for shift in (1, 5, 9):
        found = outline_contour(np.roll(points, shift, axis=0)[::-1], 30).moments()
        assert found.area == pytest.approx(expected.area, rel=1e-13)
        assert found.second == pytest.approx(expected.second, rel=1e-13)


def test_outlines_of_corners_are_polygons() -> None:
    square = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    contour = outline_contour(square, 30)
    assert all(arc.straight for arc in contour.arcs)
    assert set(contour.corners) == {(-1, -1), (1, -1), (1, 1), (-1, 1)}


def test_points_too_far_apart_for_a_smooth_curve_are_refused() -> None:
    # Without a third point on the bottom, the spline of the bilges would sag under it.
    with pytest.raises(ValueError, match=r"30.6 times as long as the next, between the points \(-8, 0\) and \(8, 0\)"):
        outline_contour(np.delete(ship_section(), [0, 1, -1], axis=0), 30)
    angles = np.radians([0, 50, 110, 180, 240, 300])
    with pytest.raises(ValueError, match="bulges by"):
        outline_contour(np.column_stack([np.cos(angles), np.sin(angles)]), 90)


@pytest.mark.parametrize("seed", range(20))
def test_polygons_that_cross_themselves_are_found(seed: int) -> None:
    random = np.random.default_rng(seed)
    assert self_crossing(polygon_contour(vertices(random_polygon(random)))) is None
    # Of a convex polygon any two neighbours that change places make two edges cross.
    angles = np.sort(random.uniform(0, 2 * pi, random.integers(4, 30)))
    points = np.column_stack([3 * np.cos(angles), np.sin(angles)])
    assert self_crossing(polygon_contour(vertices(points))) is None
    first = random.integers(0, len(points) - 1)
    points[[first, first + 1]] = points[[first + 1, first]]
    assert self_crossing(polygon_contour(vertices(points))) is not None


@pytest.mark.parametrize(
    "corners",
    [
        ((-1, -1), (1, 1), (1, -1), (-1, 1)),
        ((0, 0), (2, 0), (1, 0), (1, 1)),
        ((0, 0), (2, 0), (2, 2), (1, 0), (0, 2)),
        ((0, 0), (1, 0), (0.5, 0)),
    ],
)
def test_contours_that_touch_or_fold_back_are_found(corners: tuple[tuple[float, float], ...]) -> None:
    assert self_crossing(polygon_contour(corners)) is not None


def test_smooth_loops_are_found() -> None:
    t = np.linspace(0, 2 * pi, 80, endpoint=False)
    assert self_crossing(outline_contour(np.column_stack([np.sin(t) + 0.01, np.sin(2 * t + 0.1)]), 40)) is not None
    assert self_crossing(outline_contour(np.column_stack([np.sin(t), np.cos(t)]), 40)) is None


def test_turns_are_signed_angles() -> None:
    east, north = straight_arc((0.0, 0.0), (1.0, 0.0)), straight_arc((1.0, 0.0), (1.0, 1.0))
    assert turn_between(east, north) == pytest.approx(pi / 2)
    assert turn_between(north, straight_arc((1.0, 1.0), (2.0, 1.0))) == pytest.approx(-pi / 2)
    assert asin(1) == pytest.approx(turn_between(east, north))


def test_a_level_is_crossed_to_rounding_also_next_to_the_start_of_an_arc() -> None:
    curve = Arc(
        curve=lambda t: np.column_stack([t, t**3]),
        velocity=lambda t: np.column_stack([np.ones_like(t), 3 * t**2]),
        start=(0.0, 0.0),
        end=(1.0, 1.0),
    )
    assert curve.crossing(1e-30, 0.0, 1.0) == pytest.approx(1e-10, abs=2e-17)
    assert curve.crossing(0.5, 0.0, 1.0, axis=0) == 0.5
