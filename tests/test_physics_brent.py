"""Roots by Brent's method."""

from __future__ import annotations

from math import exp, tanh

import numpy as np
import pytest
from scipy.optimize import brentq

from hydroelastic.physics.brent import brent_root


@pytest.mark.parametrize("tolerance", [4 * 2.0**-52, 1e-3])
def test_roots_are_those_of_scipy_to_the_last_bit(tolerance: float) -> None:
    random = np.random.default_rng(3)
    for wanted, depth in zip(10.0 ** random.uniform(-3, 6, 200), random.uniform(0.05, 3.0, 200), strict=True):

        def dispersion(k: float, wanted: float = wanted, depth: float = depth) -> float:
            return k * tanh(k * depth) - wanted

        ends = 1e-6, 4.0 * wanted + 10.0
        found = brent_root(dispersion, *ends, relative_tolerance=tolerance)
        assert found == brentq(dispersion, *ends, rtol=tolerance)

        def steep(x: float, wanted: float = wanted) -> float:
            return x**9 - 1.0 - wanted**0.2 + exp(-x)

        assert brent_root(steep, 0.0, 30.0, relative_tolerance=tolerance) == brentq(steep, 0.0, 30.0, rtol=tolerance)
    assert brent_root(lambda x: exp(x) - 1.0, 0.0, 2.0) == 0.0


def test_a_bracket_without_a_change_of_sign_is_refused() -> None:
    with pytest.raises(ValueError, match="same sign at 1 and 2"):
        brent_root(lambda x: x, 1.0, 2.0)
