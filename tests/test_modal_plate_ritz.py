"""Dry modes of rectangular and polygonal plates against closed forms and converged numbers."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from hydroelastic.modal.plate.polygon import polygon_modes, polygon_quadrature
from hydroelastic.modal.plate.rectangle import rectangle_modes
from hydroelastic.physics.plate import Edge

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
# Free square, ν = 0.3: Legendre–Ritz of growing degree, digits that no longer change.
CORNERS = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
FREE_SQUARE = np.array([13.468198, 19.596137, 24.270201, 34.800891, 34.800891])


def test_a_free_square_has_three_rigid_motions_and_the_known_modes() -> None:
    values = np.concatenate(
        [rectangle_modes((1.0, 1.0), 0.3, 20, parities=(x, y)).stiffness for x in (0, 1) for y in (0, 1)]
    )
    values = np.sort(values)
    assert np.count_nonzero(values == 0.0) == 3
    # From above; corners leave 3e-8 at 20 polynomials.
    excess = np.sqrt(values[3:8]) / FREE_SQUARE - 1.0
    assert excess.min() > -5e-8
    assert excess.max() < 1e-7


@pytest.mark.parametrize("parities", [(None, None), (0, 1)])
def test_hinged_and_sliding_rectangles_are_products_of_sines_and_cosines(parities: Any) -> None:
    size = (1.0, 1.5)
    wanted: dict[Edge, int] = {"hinged": 1, "sliding": 0}
    for edge, first in wanted.items():
        modes = rectangle_modes(size, 0.3, 24, edges=((edge, edge), (edge, edge)), parities=parities)
        numbers = [(m, n) for m in range(first, 7) for n in range(first, 7)]
        if parities != (None, None):
            # sin mπx/a is even about the middle for odd m, cos for even m.
            numbers = [(m, n) for m, n in numbers if (m + first) % 2 == 0 and (n + first) % 2 == 1]
        exact = np.sort([np.pi**4 * (m**2 / size[0] ** 2 + n**2 / size[1] ** 2) ** 2 for m, n in numbers])
        # Rounding of a stiffness whose largest value is 10⁹ times the lowest, at most 2e-7; measured 1.1e-9.
        assert modes.stiffness[:6] == pytest.approx(exact[:6], rel=1e-8)


def test_a_plate_on_one_hinged_edge_turns_about_it() -> None:
    modes = rectangle_modes((2.0, 1.0), 0.3, 12, edges=(("hinged", "free"), ("free", "free")))
    assert np.count_nonzero(modes.stiffness == 0.0) == 1
    turn = modes.deflection(np.array([-1.0, 0.0, 1.0]), np.array([0.1, 0.3, -0.2]))[0]
    assert turn / turn[2] == pytest.approx([0.0, 0.5, 1.0], abs=1e-9)


def test_a_square_is_a_polygon() -> None:
    modes = polygon_modes(CORNERS, 0.3, 14)
    assert np.sqrt(modes.stiffness[3:8]) == pytest.approx(FREE_SQUARE, rel=1e-6)
    points, weights = polygon_quadrature(SQUARE, 30)
    shapes = modes.deflection(points)[:20]
    assert (shapes * weights) @ shapes.T == pytest.approx(np.eye(20), abs=1e-10)


def test_a_turned_square_has_the_same_modes() -> None:
    turn = np.array([[np.cos(0.4), np.sin(0.4)], [-np.sin(0.4), np.cos(0.4)]])
    # The polynomials of a degree in x and y together are the same in any axes.
    assert polygon_modes(tuple(map(tuple, SQUARE @ turn)), 0.3, 12).stiffness[3:20] == pytest.approx(
        polygon_modes(CORNERS, 0.3, 12).stiffness[3:20], rel=1e-9
    )


def test_a_concave_polygon_is_integrated_exactly() -> None:
    corner = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]])
    points, weights = polygon_quadrature(corner, 4)
    # ∫x³y² over [0, 2]² less that over [1, 2]².
    assert weights.sum() == pytest.approx(3.0, rel=1e-14)
    assert (points[0] ** 3 * points[1] ** 2) @ weights == pytest.approx(4.0 * 8.0 / 3.0 - 3.75 * 7.0 / 3.0, rel=1e-13)


# Three unit squares, ν = 0.3. A second method, C¹ rectangles of degree 7 graded to the corner, gives 3.9272176,
# 4.2509065, 6.8049961 and 8.4038388 from above.
L_SHAPE = ((0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0))
L_FREQUENCIES = np.array([3.92721582, 4.25089381, 6.80499379, 8.4038228])


def test_a_plate_with_a_reentrant_corner_has_its_modes_to_seven_digits() -> None:
    modes = polygon_modes(L_SHAPE, 0.3, 12)
    excess = np.sqrt(modes.stiffness[3:7]) / L_FREQUENCIES - 1.0
    # From above; measured 1e-8 to 4e-7. Polynomials alone have 1e-4.
    assert excess.min() > -1e-9
    assert excess.max() < 6e-7
    assert np.all(modes.stiffness[:3] == 0.0)


def test_parts_of_a_symmetric_polygon_have_the_modes_of_the_whole() -> None:
    # With corners on both planes of symmetry, where functions of one parity vanish.
    rhombus = ((1.0, 0.0), (0.0, 0.6), (-1.0, 0.0), (0.0, -0.6))
    parts = [polygon_modes(rhombus, 0.3, 10, (x, y)) for x in (0, 1) for y in (0, 1)]
    together = np.sort(np.concatenate([part.stiffness for part in parts]))
    assert together[:20] == pytest.approx(polygon_modes(rhombus, 0.3, 10).stiffness[:20], rel=1e-8, abs=1e-9)
    points = np.array([[0.3, 0.1], [0.1, 0.2]]).T
    for part in parts:
        sign = -1.0 if part.basis.parity[0] == 1 else 1.0
        mirrored = points * np.array([[-1.0], [1.0]])
        assert part.deflection(mirrored) == pytest.approx(sign * part.deflection(points), abs=1e-7)
