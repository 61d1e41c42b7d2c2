"""Closed forms and estimates of bodies of revolution in waves."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from open_cases import complex_of, stored
from scipy.special import j0

from hydroelastic.modal.floats.round_bodies import (
    depth_integrals,
    following_heave,
    haskind_damping,
    standing_cylinder,
    strip_force,
)
from hydroelastic.physics.solids import solid_of_revolution

CASES = {case["name"]: case for case in stored("axisymmetric_sea.json")["cases"]}
STANDING = [case for case in stored("axisymmetric_sea.json")["cases"] if case["group"] == "bottom_mounted"]
HEMISPHERES = [case for case in stored("axisymmetric_sea.json")["cases"] if case["group"] == "hemisphere"]


@pytest.mark.parametrize("case", STANDING, ids=lambda case: str(case["name"]))
def test_a_cylinder_on_the_bed_is_pushed_as_in_the_references(case: dict[str, Any]) -> None:
    """MacCamy and Fuchs, with phases; the references have 13 digits."""
    given, values = case["inputs"], case["values"]
    depth = float(given["depth"])
    found = standing_cylinder(values["k"], depth, given["radius"], depth, 9810.0)
    for force, key in zip(found, ("excitation_surge", "excitation_pitch"), strict=True):
        assert force == pytest.approx(complex_of(values[key]), rel=1e-11)


def test_a_cylinder_in_long_waves_is_pushed_in_the_middle_of_its_draught() -> None:
    """The pressure of long waves is that of the surface at any depth, but for kd = 2e-4."""
    arm = [standing_cylinder(1e-4, math.inf, 1.0, 2.0, 9810.0, about) for about in (0.0, -1.0, 0.5)]
    assert [(pitch / surge).real for surge, pitch in arm] == pytest.approx([1.0, 0.0, 1.5], abs=2e-4)


def test_integrals_over_the_depth_are_those_of_quadrature_and_tend_to_deep_water() -> None:
    """Gauss points of degree 79 integrate the smooth Z to rounding; at kH = 200 Z differs from e^{kz} by e^{−400}."""
    k, depth, draught = 0.7, 3.0, 2.0
    points, weights = np.polynomial.legendre.leggauss(40)
    z, whole = 0.5 * draught * (points - 1.0), 0.5 * depth * (points - 1.0)
    profile = [np.cosh(k * (at + depth)) / np.cosh(k * depth) for at in (z, whole)]
    known = (
        0.5 * draught * weights @ profile[0],
        0.5 * draught * weights @ (z * profile[0]),
        0.5 * depth * weights @ profile[1] ** 2,
    )
    assert depth_integrals(k, depth, draught) == pytest.approx(known, rel=1e-12)
    assert depth_integrals(2.0, 100.0, 1.5) == pytest.approx(depth_integrals(2.0, math.inf, 1.5), rel=1e-12)


@pytest.mark.parametrize("case", HEMISPHERES, ids=lambda case: str(case["name"]))
def test_the_damping_of_a_hemisphere_is_that_of_haskind(case: dict[str, Any]) -> None:
    """From the exact forces the relation is exact, for heave of order 0 and surge of order 1."""
    values = case["values"]
    spread = depth_integrals(values["Ka"], math.inf, 0.0)[2]
    for order, motion in enumerate(("heave", "surge")):
        force = abs(complex_of(values[f"excitation_{motion}"]))
        damping = haskind_damping(order, values["omega"], force, spread, 1000.0, 9.81)
        assert damping == pytest.approx(values[f"damping_{motion}"], rel=1e-8)


@pytest.mark.parametrize("depth", [3.0, math.inf])
def test_strips_of_a_pile_have_the_force_of_long_waves(depth: float) -> None:
    """MacCamy and Fuchs for ka → 0: the difference falls like (ka)² ln ka."""
    contour = solid_of_revolution("cylinder", radius=0.1, draught=2.0).below(0.0)
    differences = []
    for k in (0.1, 0.01):
        known = abs(standing_cylinder(k, depth, 0.1, 2.0, 9810.0)[0])
        differences.append(abs(strip_force(contour, k, depth, 9810.0) / known - 1.0))
    assert differences[0] < 1e-3
    assert differences[1] < 0.02 * differences[0]


@pytest.mark.parametrize(("name", "excess"), [("c5 Ka=0.05", 0.137), ("c9 deep Ka=0.05", 0.256)])
def test_strips_neglect_the_flow_below_the_end(name: str, excess: float) -> None:
    """They are too large, the less so the longer the cylinder is: of 2 and of 1 radius."""
    case = CASES[name]
    given, values = case["inputs"], case["values"]
    contour = solid_of_revolution("cylinder", radius=given["radius"], draught=given["draught"]).below(0.0)
    k = values.get("k", values["Ka"])
    found = strip_force(contour, k, float(given["depth"]), 9810.0)
    assert found / abs(complex_of(values["excitation_surge"])) - 1.0 == pytest.approx(excess, abs=2e-3)


def test_a_limp_plate_follows_the_water() -> None:
    """The mean of J₀(kr) over a ring, and 1 in long waves."""
    r = np.linspace(1.0, 2.0, 2001)
    # The trapezoidal rule of 2000 steps is off by 1e-8.
    assert following_heave(0.9, 1.0, 2.0) == pytest.approx(np.trapezoid(j0(0.9 * r) * r, r) / 1.5, rel=1e-7)
    assert following_heave(1e-4, 0.0, 2.0) == pytest.approx(1.0, abs=1e-8)
