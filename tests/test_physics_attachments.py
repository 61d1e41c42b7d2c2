"""Forces from outside in other units."""

import numpy as np
import pytest

from hydroelastic.physics.attachments import Attachment
from hydroelastic.physics.scales import Scales

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
