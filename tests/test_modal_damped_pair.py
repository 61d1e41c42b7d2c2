"""Free motions of a damped oscillator, against the exponential of its matrix and at the borders of regimes."""

import numpy as np
import pytest
from scipy.linalg import expm

from hydroelastic.modal.damped_pair import damped_pair

TIMES = np.array([0.0, 1e-9, 0.1, 1.0, 7.0])


@pytest.mark.parametrize("damping", [0.0, 0.3, 0.999999, 1.0, 1.000001, 1.0 + 1e-15, 3.0])
def test_is_the_exponential_of_the_matrix(damping: float) -> None:
    first, second = damped_pair([1.0], damping, TIMES)
    for time, c, s in zip(TIMES, first[0], second[0], strict=True):
        exponential = expm(time * np.array([[0.0, 1.0], [-1.0, -2.0 * damping]]))
        # expm itself keeps about 14 digits here.
        assert c + damping * s == pytest.approx(exponential[0, 0], abs=1e-13)
        assert s == pytest.approx(exponential[0, 1], abs=1e-13)


@pytest.mark.parametrize("damping", [0.2, 1.0, 5.0])
def test_derivatives_are_combinations_of_both(damping: float) -> None:
    step = 1e-5
    (before, at, after), (s_before, s_at, s_after) = (
        pair[0] for pair in damped_pair([1.0], damping, [1.0 - step, 1.0, 1.0 + step])
    )
    # A central difference: its error is step²/6 of the third derivative, at most 1e3, and rounding over the step.
    assert (after - before) / (2 * step) == pytest.approx(-damping * at - (1 - damping**2) * s_at, abs=1e-7)
    assert (s_after - s_before) / (2 * step) == pytest.approx(at - damping * s_at, abs=1e-7)


def test_heavy_damping_neither_overflows_nor_loses_the_slow_root() -> None:
    first, second = damped_pair([1.0], 1e8, [1.0, 1e9])
    # The slow root is −1/(2α) to 16 digits: C + αS → e^{−t/(2α)}.
    assert (first + 1e8 * second)[0] == pytest.approx(np.exp([-0.5e-8, -5.0]), rel=1e-14)


def test_regimes_meet() -> None:
    below, at, above = (np.array(damped_pair([1.0], 1.0 + shift, TIMES)) for shift in (-1e-12, 0.0, 1e-12))
    # d/dα is at most t²e^{−t} here: a shift of 1e-12 changes little more than rounding does.
    assert below == pytest.approx(at, abs=1e-11)
    assert above == pytest.approx(at, abs=1e-11)
