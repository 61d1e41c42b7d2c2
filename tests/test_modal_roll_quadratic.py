"""Roll with quadratic damping: the closed form at d = 0, scaling, energy, another method, and the error estimate."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from roll_trains import TRAIN, K
from scipy.integrate import solve_ivp
from scipy.special import lambertw

from hydroelastic.modal.roll.motion import roll_response
from hydroelastic.modal.roll.quadratic import quadratic_roll_path
from hydroelastic.physics.ship import Ship
from hydroelastic.physics.wave import WaveTrain

END = 60.0
TIMES = np.linspace(-1.0, END, 400)


@pytest.mark.parametrize("ratio", [0.0, 0.1, 0.6, 1.0, 1.2, 4.0])
@pytest.mark.parametrize("tolerance", [1e-5, 1e-8, 1e-11])
def test_without_quadratic_damping_it_is_the_closed_form(ratio: float, tolerance: float) -> None:
    roll = Ship(natural_frequency=K, damping=ratio * K)
    path = quadratic_roll_path(roll, TRAIN, END, 0.05, -0.02, tolerance)
    exact, motion = roll_response(roll, TRAIN, TIMES, 0.05, -0.02), path.motion(TIMES)
    largest = np.abs(exact.angle).max()
    error = np.abs(motion.angle - exact.angle).max()
    # The estimate is that of the coarser of two motions: above the error, and here by less than a hundredfold.
    assert error <= path.angle_error <= tolerance * largest
    assert path.angle_error < 100 * error + 1e-15
    assert np.abs(motion.rate - exact.rate).max() <= path.rate_error
    assert motion.acceleration == pytest.approx(exact.acceleration, abs=30 * tolerance * largest * max(1, ratio) * K)


@pytest.mark.slow_but("0.0-0.5", "0.05-20.0")
@pytest.mark.parametrize(("ratio", "d"), [(0.0, 0.5), (0.05, 0.5), (0.05, 20.0), (0.6, 3.0), (3.0, 5.0)])
def test_another_integration(ratio: float, d: float) -> None:
    """By Radau, an implicit method of order 5, wave by wave and without regard to turns of φ'."""
    roll = Ship(natural_frequency=K, damping=ratio * K)
    path = quadratic_roll_path(replace(roll, quadratic_damping=d), TRAIN, float(TRAIN.starts[-1]), 0.1, 0.0, 1e-10)
    state = [0.1, 0.0]
    for start, period, omega, slope in zip(
        TRAIN.starts[:-1], TRAIN.periods, TRAIN.frequencies, TRAIN.slopes, strict=True
    ):
        result = solve_ivp(
            lambda t, y, a=slope, w=omega: (
                y[1],
                K**2 * (a * math.sin(w * t) - y[0]) - 2 * roll.damping * y[1] - d * abs(y[1]) * y[1],
            ),
            (0, period),
            state,
            method="Radau",
            rtol=1e-9,
            atol=1e-11,
        )
        state = result.y[:, -1].tolist()
        motion = path.motion(start + period)
        # Five waves of local errors of 1e-9 of 0.1.
        assert [float(motion.angle), float(motion.rate)] == pytest.approx(state, abs=5e-9)


def test_error_estimate_holds_in_waves() -> None:
    roll = Ship(natural_frequency=K, damping=0.02 * K)
    best = quadratic_roll_path(replace(roll, quadratic_damping=0.8), TRAIN, END, tolerance=1e-11).motion(TIMES).angle
    for tolerance in (1e-3, 1e-5, 1e-7, 1e-9):
        path = quadratic_roll_path(replace(roll, quadratic_damping=0.8), TRAIN, END, tolerance=tolerance)
        error = np.abs(path.motion(TIMES).angle - best).max()
        assert error <= path.angle_error <= tolerance * np.abs(best).max()


def test_angles_scale_with_the_inverse_of_the_damping() -> None:
    # φ → φ/3 and a → a/3 with d → 3d is the same equation; mirrored waves mirror the motion.
    roll = Ship(natural_frequency=K, damping=0.05 * K)
    first = quadratic_roll_path(replace(roll, quadratic_damping=0.5), TRAIN, END, 0.1).motion(TIMES)
    small = WaveTrain(periods=TRAIN.periods, slopes=-TRAIN.slopes / 3)
    second = quadratic_roll_path(replace(roll, quadratic_damping=1.5), small, END, -0.1 / 3).motion(TIMES)
    assert -3 * second.angle == pytest.approx(first.angle, abs=1e-9)


def test_energy_that_damping_takes() -> None:
    roll, d = Ship(natural_frequency=K, damping=0.03 * K), 0.7
    path = quadratic_roll_path(replace(roll, quadratic_damping=d), TRAIN, END, 0.2, tolerance=1e-10)
    edges = np.unique(np.concatenate([TRAIN.starts, np.linspace(0, END, 2001)]))
    nodes, weights = np.polynomial.legendre.leggauss(5)
    half = np.diff(edges) / 2
    times = edges[:-1, None] + half[:, None] * (nodes + 1)
    motion = path.motion(times)
    power = (
        K**2 * TRAIN.slope(times) - 2 * roll.damping * motion.rate - d * motion.rate * np.abs(motion.rate)
    ) * motion.rate
    work = half @ (power @ weights)
    first, last = path.motion(0.0), path.motion(END)
    energy = [float(state.rate**2 + K**2 * state.angle**2) / 2 for state in (first, last)]
    # Kinks of |φ'|φ'² cost the quadrature 1e-10 or less.
    assert energy[1] - energy[0] == pytest.approx(work, abs=1e-9)


def test_free_swings_are_those_of_the_exact_relation() -> None:
    path = quadratic_roll_path(
        Ship(natural_frequency=K, quadratic_damping=0.9),
        WaveTrain(periods=[], slopes=[]),
        40.0,
        angle=0.8,
        tolerance=1e-11,
    )
    # Swings a, b half a cycle apart, times 2d: (1 − b) e^b = (1 + a) e^{−a}, whatever k.
    swings = [1.8 * 0.8]
    for _ in range(3):
        swings.append(1 + float(lambertw(-(1 + swings[-1]) * math.exp(-1 - swings[-1])).real))
    expected = np.array(swings) / 1.8
    times = np.linspace(0, 40, 40_001)
    motion = path.motion(times)
    turns = np.flatnonzero(np.diff(np.sign(motion.rate[1:]))) + 1
    # φ at the nearest sample: k²φ (0.5 ms)²/2.
    assert np.abs(motion.angle[turns[:3]]) == pytest.approx(expected[1:], abs=1e-7)


def test_acceleration_is_the_derivative_of_the_rate() -> None:
    path, step = (
        quadratic_roll_path(
            Ship(natural_frequency=K, damping=0.05, quadratic_damping=2.0), TRAIN, END, 0.3, tolerance=1e-11
        ),
        1e-3,
    )
    times = np.linspace(1, 50, 60)
    before, here, after = (path.motion(times + shift) for shift in (-step, 0, step))
    # step²/6 of the third derivative of the rate, 0.1.
    assert (after.rate - before.rate) / (2 * step) == pytest.approx(here.acceleration, abs=2e-7)


def test_rate_that_only_touches_zero_at_the_start() -> None:
    # k²φ drives the ship one way for 1e-17 s, the wave then the other way.
    waves = WaveTrain(periods=TRAIN.periods, slopes=-TRAIN.slopes)
    plain = quadratic_roll_path(Ship(natural_frequency=K, quadratic_damping=0.5), waves, END).motion(TIMES).angle
    assert quadratic_roll_path(Ship(natural_frequency=K, quadratic_damping=0.5), waves, END, angle=-1e-18).motion(
        TIMES
    ).angle == pytest.approx(plain, abs=1e-9)


def test_ship_that_nothing_moves_rests() -> None:
    motion = quadratic_roll_path(
        Ship(natural_frequency=K, quadratic_damping=1.0), WaveTrain(periods=[5.0, 6.0], slopes=[0.0, 0.1]), 20.0
    ).motion([0.0, 3.0, 5.0, 8.0])
    assert motion.angle[:3].tolist() == [0.0, 0.0, 0.0]
    assert motion.angle[3] > 0
    still = quadratic_roll_path(
        Ship(natural_frequency=K, quadratic_damping=1.0), WaveTrain(periods=[5.0], slopes=[0.0]), 20.0
    )
    assert (still.angle_error, np.abs(still.motion(TIMES[TIMES < 20]).angle).max()) == (0.0, 0.0)


def test_wave_that_is_not_reached_is_not_integrated() -> None:
    whole = quadratic_roll_path(Ship(natural_frequency=K, quadratic_damping=0.5), TRAIN, END)
    for end in (3.0, float(TRAIN.starts[1]), 10.0):
        part = quadratic_roll_path(Ship(natural_frequency=K, quadratic_damping=0.5), TRAIN, end)
        assert float(part.motion(end).angle) == pytest.approx(float(whole.motion(end).angle), abs=1e-9)
        with pytest.raises(ValueError, match="must be finite and at most"):
            part.motion(end + 0.1)


def test_wrong_arguments_are_named() -> None:
    for arguments, message in (
        ({"end": 0.0}, r"end is 0\.0"),
        ({"tolerance": 1e-15}, "tolerance is 1e-15; it must lie between 1e-11 and 0.01"),
        ({"angle": math.nan}, "angle is nan"),
    ):
        given = {"end": 10.0} | arguments
        with pytest.raises(ValueError, match=message):
            quadratic_roll_path(Ship(natural_frequency=1.0, quadratic_damping=1.0), TRAIN, **given)
