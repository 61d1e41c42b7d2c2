"""The hanging string in SI units: travel of waves, fronts, the dimensionless string, what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad
from uniform_strings import uniform_string

from hydroelastic.modal.string.closed_form import natural_frequencies, relative_roots
from hydroelastic.physics.string import HangingString

LOADED = HangingString(
    length=7.0,
    linear_density=0.8,
    resistance=(0.3, 0.1),
    tip_mass=2.0,
    added_mass=0.1,
    displaced_mass=0.1,
    tip_displaced_mass=0.7,
)
# Lighter than the liquid, held down by its tip mass: the tension falls upwards.
BUOYANT = HangingString(length=2.0, linear_density=0.5, tip_mass=3.0, displaced_mass=1.2)


@pytest.mark.parametrize("string", [LOADED, BUOYANT])
def test_travel_time_is_the_integral_of_the_slowness(string: HangingString) -> None:
    def slowness(x: float) -> float:
        hung = string.tip_mass - string.tip_displaced_mass + (string.linear_density - string.displaced_mass) * x
        return math.sqrt((string.linear_density + string.added_mass) / (9.81 * hung))

    for position in (0.3, string.length):
        # The quadrature is exact to rounding: the integrand is smooth.
        assert float(string.travel_times(position)) == pytest.approx(quad(slowness, 0.0, position)[0], rel=1e-12)
    assert string.travel_time == float(string.travel_times(string.length))
    assert float(string.arrival_times(string.length)) == 0.0


def test_travel_time_without_a_tip_mass() -> None:
    string = HangingString(length=2.0, linear_density=0.5, added_mass=0.3, displaced_mass=0.1)
    assert string.apparent_gravity == pytest.approx(9.81 * 0.4 / 0.8, rel=1e-15)
    assert string.travel_time == pytest.approx(2.0 * math.sqrt(2.0 / string.apparent_gravity), rel=1e-15)
    assert float(string.travel_times(0.0)) == 0.0


def test_distance_from_fronts_is_that_of_rays() -> None:
    positions, times = np.array([0.0, 2.0, 7.0]), np.linspace(0.0, 9.0, 500)
    # Rays followed up and down, one after another.
    own = LOADED.travel_times(positions) / LOADED.travel_time
    rays = np.concatenate([[2 * number + 1 - own, 2 * number + 1 + own] for number in range(12)])
    expected = np.abs(times / LOADED.travel_time - rays[..., None]).reshape(-1, 3, 500).min(axis=0)
    # Rounding of 20 travel times.
    assert LOADED.front_distance(positions, times) == pytest.approx(expected, abs=1e-14)


@pytest.mark.parametrize("string", [LOADED, BUOYANT, uniform_string(length=3.0, damping=0.4)])
def test_the_dimensionless_string_has_the_same_motion_in_its_units(string: HangingString) -> None:
    scaled = string.dimensionless()
    assert (scaled.length, scaled.linear_density, scaled.gravity, scaled.time_unit) == (1.0, 1.0, 1.0, 1.0)
    # All are a few operations away from one another: roundings.
    assert scaled.travel_time * string.time_unit == pytest.approx(string.travel_time, rel=1e-14)
    assert scaled.damping / string.time_unit == pytest.approx(string.damping, rel=1e-14)
    assert scaled.smallest_damping / string.time_unit == pytest.approx(string.smallest_damping, rel=1e-14)
    weight = string.gravity * string.linear_density * string.length
    assert scaled.tension[0] * weight == pytest.approx(string.tension[0], rel=1e-14)
    assert scaled.tension[1] * weight / string.length == pytest.approx(string.tension[1], rel=1e-14)
    assert scaled.has_closed_form == string.has_closed_form


def test_modes_are_undamped_ones_only_where_the_drag_is_in_proportion_to_the_mass() -> None:
    assert uniform_string(damping=0.4).uniform_damping == 0.4
    assert LOADED.uniform_damping is None
    # Drag along the string but none on the body at its end.
    assert HangingString(length=1.0, linear_density=1.0, resistance=(0.1, 0.1), tip_mass=1.0).uniform_damping is None
    assert BUOYANT.uniform_damping == 0.0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"length": 0.0}, "length is 0"),
        ({"length": math.nan}, "length is nan"),
        ({"linear_density": -1.0}, "linear_density is -1"),
        ({"gravity": -9.81}, "gravity is -9.81"),
        ({"resistance": (0.1, -0.1)}, "resistance is -0.1"),
        ({"displaced_mass": 1.0}, "displaced_mass"),
        ({"tip_mass": 1.0, "tip_displaced_mass": 1.0}, "tip_displaced_mass"),
        ({"tip_mass": 1.0, "displaced_mass": 2.5}, "displaced_mass"),
    ],
)
def test_what_does_not_hang_under_tension_is_refused(options: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        HangingString(**({"length": 1.0, "linear_density": 1.0} | options))  # type: ignore[arg-type]


def test_closed_forms_are_refused_where_there_are_none() -> None:
    for function in (lambda: natural_frequencies(LOADED, 1), lambda: relative_roots(BUOYANT, 0.5)):
        with pytest.raises(ValueError, match="no closed form"):
            function()
