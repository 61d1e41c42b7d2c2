"""Outlines that are no domain are refused in words, and gmsh works on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import pi, radians

import gmsh
import numpy as np
import pytest
from outlines import (
    Circle,
    arc,
    circle_tank,
    surface_slit,
)

from hydroelastic.meshes.build import build_mesh
from hydroelastic.meshes.filling import Line, fill
from hydroelastic.meshes.outline import Curve, GradedPoint, Outline, Region
from hydroelastic.meshes.size_field import SizeField
from hydroelastic.meshes.tagged_mesh import MeshError

SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]


def square(**changes: object) -> Callable[[], Outline]:
    """A square of four sides a, b, c, d with something changed."""
    curves = tuple(
        Curve(name=name, start=start, end=end)
        for name, start, end in zip("abcd", SQUARE, [*SQUARE[1:], SQUARE[0]], strict=True)
    )
    loop = tuple((number, True) for number in range(4))
    first = replace(curves[0], **changes.pop("first", {}))  # type: ignore[arg-type, call-overload]
    values = {"curves": (first, *curves[1:]), "regions": (Region(name="liquid", loop=loop),)} | changes
    return lambda: Outline(**values)  # type: ignore[arg-type]


LOOP = ((0, True), (1, True), (2, True), (3, True))


@pytest.mark.parametrize(
    ("outline", "message"),
    [
        (square(regions=(Region(name="liquid", loop=LOOP[:3]),)), r"open between curves 2 \('c'\) and 0 \('a'\)"),
        (
            square(regions=(Region(name="liquid", loop=tuple((number, False) for number in (3, 2, 1, 0))),)),
            "must turn counterclockwise",
        ),
        (square(regions=(Region(name="liquid", loop=(*LOOP, (0, False), (0, True))),)), "passes a curve twice"),
        (
            square(regions=(Region(name="liquid", loop=LOOP), Region(name="oil", loop=LOOP))),
            r"curve 0 \('a'\) bounds two regions on the same side",
        ),
        (square(regions=()), r"curve 0 \('a'\) bounds no region"),
        (square(first={"name": ""}), "curve 0 has no name"),
        (square(first={"end": (0.0, 0.0)}), "ends where it starts"),
        (square(first={"size": 0.0}), "positive size"),
        (square(first={"path": arc((0.5, 0.0), 0.4, pi, 2 * pi)}), "does not lead from its start to its end"),
        (square(graded_points=(GradedPoint(point=(0.5, 0.0), inner=1e-3, outer=0.1),)), "not an end of a curve"),
        (square(graded_points=(GradedPoint(point=(0.0, 0.0), inner=0.0, outer=0.1),)), "rings of positive radii"),
        (
            square(graded_points=(GradedPoint(point=(0.0, 0.0), inner=1e-3, outer=0.1),) * 2),
            "two corners are at the same point",
        ),
    ],
)
def test_outlines_that_are_no_domain_are_refused(outline: Callable[[], Outline], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        outline()


@pytest.mark.slow_but("at the wall")
@pytest.mark.parametrize(
    ("outline", "message"),
    [
        (circle_tank(Circle(), depths=(0.4, 0.05)), "cross or touch one another: float and lid"),
        (
            circle_tank(Circle(centre=0.06, contact_angle=radians(150))),
            "cross or touch one another: float and left_wall",
        ),
        (circle_tank(Circle(), depths=(0.09, 0.3)), "cross or touch one another: bottom and float"),
    ],
    ids=["through the lid", "at the wall", "on the bottom"],
)
def test_curves_that_cross_or_touch_are_refused(outline: Outline, message: str) -> None:
    with pytest.raises(MeshError, match=message):
        build_mesh(outline, bulk_size=0.2)


@pytest.mark.skipif(
    tuple(map(int, gmsh.__version__.split(".")[:2])) >= (4, 14),
    reason="later versions of gmsh do not end on lines that cross; outlines that cross are refused before gmsh",
)
def test_gmsh_works_on_after_it_failed() -> None:
    bow_tie = np.array([[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]])
    line = Line(key=0, points=bow_tie, forward=True)
    size = SizeField(bulk_size=0.3, growth=0.7, straight=[], rings=[], bends=[])
    with pytest.raises(MeshError, match="gmsh finds no cells"):
        fill([bow_tie], [[line]], size)
    assert len(build_mesh(circle_tank(Circle()), bulk_size=0.5).cells) > 100


def test_options_of_an_earlier_mesh_do_not_change_the_next_one() -> None:
    first = build_mesh(circle_tank(Circle()), bulk_size=0.5)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.01)
    assert np.array_equal(build_mesh(circle_tank(Circle()), bulk_size=0.5).cells, first.cells)


def test_a_slit_of_one_element_is_refused() -> None:
    """Both its ends are single: nothing would be open."""
    outline = surface_slit(low=-0.3, high=-0.2, rings=False)
    with pytest.raises(MeshError, match="slit of a single element"):
        build_mesh(outline, bulk_size=0.5)
