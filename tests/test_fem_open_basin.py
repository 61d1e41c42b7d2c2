"""The basin that is cut out of open water."""

from __future__ import annotations

import numpy as np
import pytest
from open_cases import circle, plate, problem_of, stored

from hydroelastic.fem.open_water.basin import open_basin
from hydroelastic.physics.beams import Beam
from hydroelastic.scenes.models.tank import TankScene

PLATE = stored("open_plates.json")["plates"][0]
FAR = 1000.0


@pytest.mark.parametrize(
    ("here", "there"),
    [
        (circle(1e-3, "heave"), circle(1e-3, "heave", body={"position": 5.0 + FAR}, length=2.0 * FAR)),
        (plate(PLATE, 1e-3), plate(PLATE, 1e-3, start=FAR)),
    ],
    ids=["float", "beam"],
)
def test_a_basin_moves_with_its_bodies(here: TankScene, there: TankScene) -> None:
    one, other = (open_basin(problem_of(scene).tank, 1.0) for scene in (here, there))
    # Places are rounded at the far one: by 1e-16 of it, over a basin longer than 1 m.
    rounding = 1e-15 * FAR
    assert other.origin - one.origin == pytest.approx(FAR, rel=rounding)
    assert other.units.length == pytest.approx(one.units.length, rel=rounding)
    assert (other.layers, other.sides) == (one.layers, one.sides)
    near, far = one.tank.bodies[0], other.tank.bodies[0]
    if isinstance(near, Beam):
        assert isinstance(far, Beam)
        assert (far.start, far.end) == pytest.approx((near.start, near.end), abs=rounding)
        assert 0.0 < far.start < far.end < 1.0
    else:
        assert near.hull is not None
        assert far.hull is not None
        np.testing.assert_allclose(far.hull.bounds, near.hull.bounds, rtol=0, atol=rounding)
        assert far.waterplane == pytest.approx(near.waterplane, abs=rounding)
