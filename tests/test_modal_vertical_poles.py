"""Poles of the depth: their error is bounded, they are positive, and they are few."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hydroelastic.modal.liquid.vertical_poles import surface_response, vertical_poles


def _relative(depth: float, wavenumber: float, tolerance: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    poles = vertical_poles(depth, wavenumber, tolerance, lowest=0.5)
    # Beyond the samples of the poles themselves, and between them.
    k = np.geomspace(0.5, 1e5 * wavenumber, 4001)
    exact = surface_response(k, depth)
    return k, (exact - poles.values(k)) / exact, poles.error * (1.0 + (k / poles.wavenumber) ** 2)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(
    depth=st.floats(-2.5, 1.5).map(lambda power: 10.0**power),
    wavenumber=st.floats(1.0, 60.0),
    digits=st.floats(3.0, 8.0),
)
def test_the_error_keeps_its_bound_and_never_lifts_the_response(depth: float, wavenumber: float, digits: float) -> None:
    poles = vertical_poles(depth, wavenumber, 10.0**-digits, lowest=0.5)
    assert poles.error <= 10.0**-digits
    assert poles.weights.min() > 0.0
    assert poles.shifts[0] == 0.0
    assert np.all(np.diff(poles.shifts) > 0.0)
    assert poles.weights[0] == pytest.approx(1.0 / depth, rel=1e-15)
    _, relative, bound = _relative(depth, wavenumber, 10.0**-digits)
    # Between samples the error may be larger than at them by a few per cent.
    assert np.all(relative <= 1.05 * bound)
    # Galerkin's method in depth: from below, but for the rounding of its small eigenproblem (measured 1e-9).
    assert relative.min() > -3e-9


@pytest.mark.parametrize(("tolerance", "most"), [(1.4e-5, 12), (1e-7, 16), (1e-8, 20)])
def test_few_poles_are_enough(tolerance: float, most: int) -> None:
    # Numbers of a least-squares fit for H = 3 m in a tank of 10 m, and two more.
    assert len(vertical_poles(0.3, 20.0, tolerance, lowest=2.0).shifts) <= most
