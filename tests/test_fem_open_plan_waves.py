"""The elevation around solids of revolution in plan view."""

import math
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from solids_at_sea import problem_of

from hydroelastic.fem.open_water.plan_waves import PlanWaves, plan_waves
from hydroelastic.fem.open_water.requests import ResponseRequest
from hydroelastic.fem.open_water.solve import solve_open_water
from hydroelastic.output.open_water.quantities import SCATTERING_ANGLES, directional_scattering, scattering_width
from hydroelastic.output.open_water.wave_views import draw_wave_view
from hydroelastic.output.pictures.options import PictureOptions


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


def test_bodies_in_long_waves_are_seen_move_with_them_and_scatter_to_all_sides(tmp_path: Path) -> None:
    """The picture ends at twelve radii, not at two of the waves' 250 m; both bodies rise as the water does."""
    cylinder = {"shape": "cylinder", "draught": 0.5, "vertical_centre_of_gravity": -0.25}
    bodies = [cylinder | {"radius": 1.0}, cylinder | {"radius": 3.0, "inner_radius": 2.0}]
    problem = problem_of(bodies, math.inf, 1e-2, motions=("heave", "surge"))
    (table,) = solve_open_water(problem, (ResponseRequest(omega=(0.5,)),)).response
    (waves,) = plan_waves(problem, table, 1)
    assert waves.radii[-1] == pytest.approx(39.0, rel=1e-6)
    assert waves.waterplanes == ((0.0, 1.0), (2.0, 3.0))
    within, around = waves.solids
    # From the axis to the axis, and all around the ring.
    np.testing.assert_allclose(within.outline[[0, -1]], [[0.0, -0.5], [0.0, 0.5]], atol=1e-12)
    assert around.outline[:, 0].min() == 2.0
    np.testing.assert_array_equal(around.outline[0], around.outline[-1])
    for solid in waves.solids:
        assert solid.heave == pytest.approx(1.0, abs=0.1)
        # Water turns in circles: it goes forth while the crest is there.
        assert solid.surge == pytest.approx(1.0j, abs=0.2)
        assert solid.pitch == 0.0
    draw_wave_view(waves, "Two cylinders", tmp_path, PictureOptions(width=400))
    with Image.open(tmp_path / "view_response_1.png") as picture:
        painted = np.asarray(picture.convert("RGB")).min(axis=2) < 240
    # Water and bodies fill the middle, and are not cut at the edges.
    assert painted.mean() > 0.15
    assert not painted[:, [0, -1]].any()
    # The trapezoidal rule is exact of a few orders, over both sides.
    width, found = scattering_width(table), directional_scattering(table, SCATTERING_ANGLES)
    assert width is not None
    assert found is not None
    assert 2.0 * np.trapezoid(found[0, 0], SCATTERING_ANGLES) == pytest.approx(width[0, 0], rel=1e-12)
    # All orders have one phase forwards.
    assert table.partial_waves is not None
    forward = table.partial_waves[0, 0, 0] @ [1.0, *[2.0] * (table.partial_waves.shape[-1] - 1)]
    assert 2.0 * abs(forward) ** 2 / (math.pi * table.wavenumbers[0, 0]) == pytest.approx(found[0, 0, 0], rel=1e-12)
