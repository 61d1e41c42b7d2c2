"""Estimates of a float's heave, side by side."""

from __future__ import annotations

import math

import pytest

from hydroelastic.modal.floats.box import box_modes
from hydroelastic.modal.floats.estimates import all_float_estimates
from hydroelastic.modal.floats.in_tank import FloatInTank
from hydroelastic.modal.floats.thin_float import thin_float_mass, thin_float_stiffness
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.profiles import float_profile

NAMES = ["hydrostatic", "high_frequency", "thin_float", "thin_float_box"]


def body(shape: str, half_width: float = 0.1, density_above: float = 0.8) -> FloatInTank:
    profile = float_profile(shape, half_width, 1.0 if shape != "exponential" else 0.15)
    layers = TwoLayers(
        density_below=1.0, density_above=density_above, depth_below=2.0, depth_above=1.5, gravity=9.81, top="rigid"
    )
    return FloatInTank(
        layers=layers,
        tank_length=12.0,
        position=6.0,
        # The displaced liquids of the rectangle: both halves of 2b·2h.
        mass=(1 + density_above) * 2 * half_width
        if shape == "rectangle"
        else thin_float_mass(profile, 1.0, density_above),
        stiffness=thin_float_stiffness(profile, 1.0, density_above, 9.81),
        profile=profile,
    )


def test_every_method_answers_or_says_why() -> None:
    values = {"ellipse": 4, "wedge": 4, "parabola": 3, "exponential": 3, "rectangle": 2}
    for shape, count in values.items():
        estimates = all_float_estimates(body(shape))
        assert list(estimates) == NAMES
        assert sum(estimate.omega is not None for estimate in estimates.values()) == count
        for estimate in estimates.values():
            assert estimate.note
            assert (estimate.omega is None) == (estimate.added_mass is None)
            assert (estimate.omega is None) == ("No value" in estimate.note)


def test_values_of_a_thin_ellipse() -> None:
    # (π/2)(ρ₁ + ρ₂) b² is exact and that of the thin theory; m = (ρ₁ + ρ₂)(π/2) b h.
    estimates = all_float_estimates(body("ellipse"))
    mass, added, stiffness = 1.8 * math.pi / 2 * 0.1, 1.8 * math.pi / 2 * 0.01, 0.2 * 9.81 * 0.2
    assert estimates["hydrostatic"].omega == pytest.approx(math.sqrt(stiffness / mass), rel=1e-14)
    assert estimates["hydrostatic"].added_mass == 0
    for name in ("high_frequency", "thin_float"):
        assert estimates[name].added_mass == pytest.approx(added, rel=1e-14)
        assert estimates[name].omega == pytest.approx(math.sqrt(stiffness / (mass + added)), rel=1e-14)


def test_the_box_is_the_float_mode_of_the_secular_equation() -> None:
    estimate = all_float_estimates(body("parabola"))["thin_float_box"]
    # Box 1 of the references: the third symmetric mode.
    assert estimate.omega == pytest.approx(1.2346058274144639, rel=1e-14)
    assert "symmetric mode 3" in estimate.note
    assert "64 %" in estimate.note
    assert estimate.added_mass == pytest.approx(0.3924 / estimate.omega**2 - 0.24, rel=1e-12)
    assert estimate.omega == box_modes(body("parabola"), 16).omega[2]
