"""Swings of a free roll: exact relations against integration, and the coefficients of naval architects."""

from __future__ import annotations

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from hydroelastic.modal.roll.decrement import (
    FroudeCoefficients,
    damping_from_froude,
    equivalent_roll_damping,
    fit_froude,
    froude_coefficients,
    linear_decrement,
    quadratic_decrement,
    swing_amplitudes,
)
from hydroelastic.modal.roll.motion import roll_response
from hydroelastic.physics.ship import Ship
from hydroelastic.physics.wave import WaveTrain

IMO = np.loadtxt(Path(__file__).parent / "reference" / "imo_roll_decay.csv", delimiter=",", skiprows=2)
"""φ_m, °, and Bertin's N, 1/°; two digits after the first."""


def integrated_swing(n: float, d: float, amplitude: float) -> float:
    """Return the next swing of φ'' + 2nφ' + d|φ'|φ' + φ = 0."""

    def turn(_: float, state: object) -> float:
        return float(state[1])  # type: ignore[index]

    turn.terminal, turn.direction = True, 1.0  # type: ignore[attr-defined]
    result = solve_ivp(
        lambda t, y: (y[1], -y[0] - 2 * n * y[1] - d * abs(y[1]) * y[1]),
        (0, 1e3),
        (amplitude, 0.0),
        method="DOP853",
        rtol=1e-12,
        atol=1e-13 * amplitude,
        events=turn,
    )
    return -float(result.y_events[0][0][0])


@pytest.mark.parametrize("amplitude", [0.01, 0.3, 0.9999, 1.0001, 3.0, 20.0])
def test_quadratic_relation_against_integration(amplitude: float) -> None:
    # 2d = 1: the borders of the two ways to the root lie at 1. Measured 2e-14.
    swing = quadratic_decrement(0.5, amplitude)
    assert swing == pytest.approx(integrated_swing(0.0, 0.5, amplitude), rel=1e-12)
    # k does not matter, and angles scale with 1/d.
    assert quadratic_decrement(5.0, amplitude / 10) == pytest.approx(swing / 10, rel=1e-14)
    assert swing_amplitudes(Ship(natural_frequency=7.0, quadratic_damping=0.5), amplitude, 1)[1] == swing


def test_small_swings_keep_their_digits() -> None:
    # a − b = (2/3)m² (1 − m²/15 + …) with the mean m, where b = a − … would lose all of a − b.
    for a in (1e-1, 1e-2, 1e-4):
        b = quadratic_decrement(0.5, a)
        mean = (a + b) / 2
        assert (a - b) / mean**2 == pytest.approx(2 / 3 * (1 - mean**2 / 15), rel=2e-15 / a + mean**4)
    assert quadratic_decrement(0.5, 0.0) == 0.0
    assert quadratic_decrement(0.0, 0.3) == 0.3


def test_no_swing_comes_back_larger_than_the_inverse_of_twice_the_damping() -> None:
    assert quadratic_decrement(0.5, 30.0) == pytest.approx(1.0 - 31 * math.exp(-31), rel=1e-15)
    assert quadratic_decrement(0.5, 1e6) == 1.0
    assert quadratic_decrement(0.5, 5.0) < 1.0


def test_linear_swings_are_those_of_the_motion() -> None:
    roll = Ship(natural_frequency=0.7, damping=0.1)
    half = math.pi / math.sqrt(0.7**2 - 0.1**2)
    swings = swing_amplitudes(roll, 0.3, 6)
    motion = roll_response(roll, WaveTrain(periods=[], slopes=[]), half * np.arange(7), angle=0.3)
    assert swings == pytest.approx(np.abs(motion.angle), rel=1e-13)
    assert np.abs(motion.rate).max() < 1e-16
    assert swings[1:] / swings[:-1] == pytest.approx(np.full(6, linear_decrement(roll)), rel=1e-14)
    assert linear_decrement(Ship(natural_frequency=2.0)) == 1.0


@pytest.mark.parametrize(("n", "d"), [(0.01, 0.4), (0.3, 2.0), (0.9, 5.0), (0.05, 100.0)])
def test_both_dampings_together(n: float, d: float) -> None:
    swings = swing_amplitudes(Ship(natural_frequency=3.0, damping=3.0 * n, quadratic_damping=d), 0.6, 3)
    for before, after in pairwise(swings):
        assert after == pytest.approx(integrated_swing(n, d, before), abs=2e-12 * before)
    # More damping leaves less.
    assert (swings[1:] < swing_amplitudes(Ship(natural_frequency=3.0, quadratic_damping=d), 0.6, 3)[1:]).all()
    assert (swings[1:] < swing_amplitudes(Ship(natural_frequency=3.0, damping=3.0 * n), 0.6, 3)[1:]).all()


@pytest.mark.parametrize(("n", "d"), [(1e-7, 0.4), (0.2, 1e-9)])
def test_both_dampings_tend_to_one_alone(n: float, d: float) -> None:
    alone = (
        swing_amplitudes(Ship(natural_frequency=1.0, quadratic_damping=d), 0.5, 4)
        if n < d
        else swing_amplitudes(Ship(natural_frequency=1.0, damping=n), 0.5, 4)
    )
    # n takes πn of a swing, d takes (4/3)d A.
    assert swing_amplitudes(Ship(natural_frequency=1.0, damping=n, quadratic_damping=d), 0.5, 4) == pytest.approx(
        alone, abs=1e-6
    )
    assert (
        np.abs(swing_amplitudes(Ship(natural_frequency=1.0, damping=n, quadratic_damping=d), 0.5, 4) - alone).max()
        > 1e-11
    )


def test_froude_coefficients_of_each_damping_alone() -> None:
    roll = Ship(natural_frequency=0.5, damping=0.04)
    linear, quadratic = (
        froude_coefficients(roll),
        froude_coefficients(Ship(natural_frequency=0.5, quadratic_damping=0.3)),
    )
    assert (linear.quadratic, quadratic.linear) == (0.0, 0.0)
    swings = swing_amplitudes(roll, 0.4, 3)
    mean = (swings[1:] + swings[:-1]) / 2
    assert swings[:-1] - swings[1:] == pytest.approx(linear.linear * mean, rel=1e-13)
    assert linear.linear == pytest.approx(math.pi * 0.04 / 0.5, rel=0.01)
    swings = swing_amplitudes(Ship(natural_frequency=0.5, quadratic_damping=0.3), 0.4, 3)
    mean = (swings[1:] + swings[:-1]) / 2
    bertin = (swings[:-1] - swings[1:]) / mean**2
    assert bertin == pytest.approx(quadratic.quadratic * (1 - (0.6 * mean) ** 2 / 15), rel=1e-4)


def test_coefficients_and_dampings_are_inverse() -> None:
    ship = damping_from_froude(
        0.8, froude_coefficients(Ship(natural_frequency=0.8, damping=0.3, quadratic_damping=0.7))
    )
    assert (ship.natural_frequency, ship.damping, ship.quadratic_damping) == pytest.approx((0.8, 0.3, 0.7), rel=1e-14)


def test_fit_finds_the_coefficients_of_small_dampings() -> None:
    ship = Ship(natural_frequency=1.0, damping=0.002, quadratic_damping=0.05)
    fitted, expected = fit_froude(swing_amplitudes(ship, 0.4, 12)), froude_coefficients(ship)
    # Both dampings together add terms of the relative order of a swing's loss, 2 %.
    assert fitted.linear == pytest.approx(expected.linear, rel=0.02)
    assert fitted.quadratic == pytest.approx(expected.quadratic, rel=0.02)
    exact = fit_froude(swing_amplitudes(Ship(natural_frequency=1.0, damping=0.1), 0.4, 5))
    assert (exact.linear, exact.quadratic) == pytest.approx(
        (2 * math.tanh(0.05 * math.pi / math.sqrt(0.99)), 0.0), abs=1e-13
    )


def test_equivalent_damping_takes_the_same_energy() -> None:
    d, amplitude = 0.6, 0.35
    linear = equivalent_roll_damping(Ship(natural_frequency=0.9, damping=0.05, quadratic_damping=d), amplitude)
    period = 2 * math.pi / 0.9
    rate = lambda t: -0.9 * amplitude * math.sin(0.9 * t)  # noqa: E731
    taken = quad(lambda t: (2 * 0.05 + d * abs(rate(t))) * rate(t) ** 2, 0, period, points=[period / 2])[0]
    assert taken == pytest.approx(quad(lambda t: 2 * linear * rate(t) ** 2, 0, period)[0], rel=1e-12)


def test_tabulated_roll_decay_follows_the_law_of_both_dampings() -> None:
    """The example of the IMO's guidelines has an N that falls with the roll: N = b + a/φ_m to its last digit."""
    angle, bertin = IMO.T
    quadratic, linear = np.polyfit(angle, bertin * angle, 1)
    # Half a unit of the last digit of N.
    assert quadratic + linear / angle == pytest.approx(bertin, abs=5e-5)
    degrees = 180 / math.pi
    ship = damping_from_froude(1.0, FroudeCoefficients(linear=linear, quadratic=quadratic * degrees))
    assert ship.damping == pytest.approx(0.0085, abs=0.0005)
    assert ship.quadratic_damping == pytest.approx(0.41, abs=0.01)
    for mean, value in IMO:
        # A swing from above the mean by half of what is lost.
        swings = swing_amplitudes(ship, (mean + value * mean**2 / 2) / degrees, 1) * degrees
        lost, middle = swings[0] - swings[1], swings.mean()
        # What both dampings add to one another is one part in a hundred here.
        assert lost / middle**2 == pytest.approx(value, rel=0.02)


def test_wrong_arguments_are_named() -> None:
    for call, message in (
        (
            lambda: linear_decrement(Ship(natural_frequency=1.0, damping=1.0)),
            r"damping is 1\.0; a ship swings back and forth only below",
        ),
        (lambda: quadratic_decrement(-1.0, 1.0), r"quadratic_damping is -1\.0"),
        (lambda: quadratic_decrement(1.0, math.inf), "amplitude is inf"),
        (lambda: swing_amplitudes(Ship(natural_frequency=1.0, quadratic_damping=1.0), 1.0, -1), "count is -1"),
        (lambda: damping_from_froude(1.0, FroudeCoefficients(linear=2.0, quadratic=0.0)), r"linear is 2\.0"),
        (lambda: fit_froude([1.0, 0.5]), "at least three"),
        (lambda: fit_froude([1.0, 0.5, 0.0]), "swings must be finite and positive"),
    ):
        with pytest.raises(ValueError, match=message):
            call()
