"""Closed forms and estimates of bodies of revolution in waves."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from open_cases import complex_of, stored

from hydroelastic.modal.floats.round_bodies import depth_integrals, haskind_damping, standing_cylinder

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
