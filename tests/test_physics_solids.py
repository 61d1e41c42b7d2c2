"""Volumes and motions of solids beside closed forms; forces from outside in other units."""

from math import pi

import numpy as np
import pytest

from hydroelastic.physics.attachments import Attachment
from hydroelastic.physics.scales import Scales
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


NOTHING = ((0.0, 0.0, 0.0),) * 3


@pytest.mark.parametrize("dimensions", [2, 3])
def test_the_power_of_drag_does_not_depend_on_units(dimensions: int) -> None:
    drag, speeds = (3.0, 4.0, 5.0), np.array([0.7, 0.4, 0.2])
    attachment = Attachment(body=0, point=(0.0, 0.0), stiffness=NOTHING, damping=NOTHING, drag=drag)
    units = Scales(length=2.0, density=1000.0, gravity=9.81, dimensions=dimensions)
    # Heave and sway in m/s, roll in rad/s; power in units of energy times frequency.
    scaled = speeds / np.array([units.length, units.length, 1.0]) / units.frequency
    energy = units.density * units.gravity * units.volume * units.length
    found = attachment.scaled(units).drag * scaled**3 * (energy * units.frequency)
    np.testing.assert_allclose(found, np.array(drag) * speeds**3, rtol=1e-12)
