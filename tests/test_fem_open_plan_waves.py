"""The elevation around solids of revolution in plan view."""

import numpy as np

from hydroelastic.fem.open_water.plan_waves import PlanWaves


def test_scattered_waves_of_each_order_turn_with_the_angle() -> None:
    radii, parts = np.array([1.0, 4.0]), np.array([0.1, 0.2j, -0.3])
    waves = PlanWaves(
        name="response_1",
        title="",
        omega=1.0,
        radii=radii,
        wavenumber=0.5,
        phase_at=1.0,
        orders=np.repeat(parts[:, None], 2, axis=1),
        waterplanes=((0.0, 1.0),),
    )
    angles = np.array([0.0, 0.4, 0.5 * np.pi, np.pi])
    x, y = 3.0 * np.cos(angles), 3.0 * np.sin(angles)
    scattered = sum(part * np.cos(order * angles) for order, part in enumerate(parts))
    np.testing.assert_allclose(waves.elevation(x, y), np.exp(0.5j * (x - 1.0)) + scattered, atol=1e-14)
    # In a body, and beyond what was solved for.
    assert np.isnan(waves.elevation(np.array([0.5, 5.0]), np.zeros(2))).all()
