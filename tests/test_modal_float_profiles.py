"""Profiles of rigid floats: width, slope, outline."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from hydroelastic.physics.profiles import float_profile

SHAPES = ["exponential", "parabola", "ellipse", "wedge", "rectangle"]
EPS = np.finfo(float).eps


@pytest.mark.parametrize("shape", SHAPES)
def test_outline_runs_along_the_width_from_the_lowest_to_the_highest_point(shape: str) -> None:
    profile = float_profile(shape, 0.3, 2.0)
    ends = []
    for arc in profile.arcs:
        points = arc.point(np.linspace(0, 1, 101))
        ends.append(points[[0, -1]])
        inner = np.abs(points[:, 1]) < profile.extent * (1 - 1e-9)
        # Points on the curve: the ellipse's √ turns an ulp of y into √ulp of x at its ends, which are left out.
        np.testing.assert_allclose(points[inner, 0], profile.half_width_at(points[inner, 1]), rtol=1e-11)
        assert np.all(np.diff(points[:, 1]) >= 0)
    np.testing.assert_allclose(ends[0][0], [0, -profile.extent], atol=4 * EPS)
    np.testing.assert_allclose(ends[-1][1], [0, profile.extent], atol=4 * EPS)
    for before, after in itertools.pairwise(ends):
        np.testing.assert_array_equal(before[1], after[0])
        assert any(np.allclose(before[1], corner, rtol=0, atol=0) for corner in profile.corners)


@pytest.mark.parametrize("shape", SHAPES)
def test_slope_is_the_derivative_odd_and_negative_above(shape: str) -> None:
    profile = float_profile(shape, 0.3, 2.0)
    y = np.array([-0.9, -0.4, 0.1, 0.55, 0.95]) * profile.extent
    step = 1e-5
    difference = (profile.half_width_at(y + step) - profile.half_width_at(y - step)) / (2 * step)
    # Central difference: h²ω'''/6 + eps/h, about 1e-10 here.
    np.testing.assert_allclose(profile.slope_at(y), difference, atol=1e-8)
    np.testing.assert_array_equal(profile.slope_at(-y), -profile.slope_at(y))
    assert np.all(profile.slope_at(np.abs(y)) <= 0)
    assert profile.slope_at(0.0) == 0


@pytest.mark.parametrize("tail", [1e-300, 1e-12, 1e-3, 0.5, 1 - 1e-9])
def test_the_exponential_ends_in_a_point(tail: float) -> None:
    profile = float_profile("exponential", 0.3, 2.0, tail=tail)
    y = np.linspace(0, profile.extent, 50)
    expected = 0.3 * (np.exp(-y / 2) - tail) / (1 - tail)
    # The plain formula on the right loses e^{-y}/(e^{-y} − tail) digits near the end, and 1/(1 − tail) of them.
    np.testing.assert_allclose(profile.half_width_at(y), expected, atol=0.3 * 8 * EPS / (1 - tail))
    assert profile.half_width_at(profile.extent) == 0
    assert profile.extent == pytest.approx(-2 * math.log(tail), rel=1e-15)
