"""Volumes and motions of solids beside closed forms."""

from math import pi

import numpy as np
import pytest
from solids_at_sea import problem_of

from hydroelastic.physics.solid_floats import SolidFloat
from hydroelastic.physics.solids import solid_of_revolution


def test_half_a_sphere_has_its_volume_and_moments() -> None:
    wetted = solid_of_revolution("sphere", radius=2.0).moments(0.0)
    assert wetted.area == pytest.approx(2.0 / 3.0 * pi * 2.0**3, rel=1e-12)
    assert wetted.first == pytest.approx((0.0, -pi / 4.0 * 2.0**4), rel=1e-12)
    assert wetted.second == pytest.approx((2.0 / 15.0 * pi * 2.0**5,) * 2, rel=1e-12)


def test_a_ring_has_its_volume_and_moments() -> None:
    ring = solid_of_revolution("cylinder", radius=3.0, inner_radius=2.0, draught=1.5)
    wetted, area = ring.moments(0.0), pi * (3.0**2 - 2.0**2)
    assert ring.waterplane(2.0, 3.0) == pytest.approx((area, 0.25 * pi * (3.0**4 - 2.0**4)), rel=1e-12)
    assert wetted.area == pytest.approx(1.5 * area, rel=1e-12)
    assert wetted.first == pytest.approx((0.0, -0.5 * 1.5**2 * area), rel=1e-12)
    assert wetted.second == pytest.approx((1.5 * 0.25 * pi * (3.0**4 - 2.0**4), 1.5**3 / 3.0 * area), rel=1e-12)


def test_rotations_are_right_handed_about_the_centre_of_mass() -> None:
    box = SolidFloat(
        shape="box",
        size=(2.0, 1.0),
        draught=0.5,
        position=(3.0, 4.0),
        centre_of_gravity=0.2,
        gyration=(1.0, 1.0, 1.0),
        motions=("roll", "pitch", "yaw"),
    )
    beside = np.array([[3.0], [4.0], [0.2]]) + np.eye(3)
    np.testing.assert_allclose(box.displacement("roll", beside), np.cross([1.0, 0.0, 0.0], np.eye(3)).T, atol=1e-15)
    np.testing.assert_allclose(box.displacement("pitch", beside), np.cross([0.0, 1.0, 0.0], np.eye(3)).T, atol=1e-15)
    np.testing.assert_allclose(box.displacement("yaw", beside), np.cross([0.0, 0.0, 1.0], np.eye(3)).T, atol=1e-15)


@pytest.mark.parametrize("draught", [0.3, 0.6, 1.0, 1.01, 1.2, 1.4, 1.7])
def test_a_sphere_on_the_axis_keeps_both_halves_in_other_units(draught: float) -> None:
    """The contact points are each other's mirror images but for rounding, whatever the draught."""
    hull = problem_of([{"shape": "sphere", "radius": 1.0, "draught": draught}], 5.0, 1e-3).tank.scaled().bodies[0].hull
    assert hull is not None
    left, right = hull.below[0].start, hull.below[-1].end
    assert left == (-right[0], right[1])
    assert hull.below[0].end == hull.below[-1].start
    assert hull.below[0].end[0] == 0.0
