"""Extremes, swings and means of roll motions: known ones, and those that an output in time would miss."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from roll_trains import PRINTED, TRAIN, K, free_swings

from hydroelastic.modal.bracketed_roots import bracketed_roots, sign_change_roots
from hydroelastic.modal.roll.motion import roll_path
from hydroelastic.modal.roll.quadratic import quadratic_roll_path
from hydroelastic.modal.roll.statistics import roll_statistics
from hydroelastic.physics.ship import Ship
from hydroelastic.physics.wave import WaveTrain

NO_WAVES = WaveTrain(periods=[], slopes=[])


def test_free_decay() -> None:
    k, n, first = 2.0, 0.1, 0.3
    own = math.sqrt(k**2 - n**2)
    # Ends in the middle of the tenth half cycle, while |φ| grows: at the end it stands higher than its next swing will.
    end = 9.5 * math.pi / own + 0.3
    result = roll_statistics(roll_path(Ship(natural_frequency=k, damping=n), NO_WAVES, angle=first), end)
    halves = np.arange(10)
    expected = first * (-1.0) ** halves * np.exp(-n * halves * math.pi / own)
    assert result.extreme_times == pytest.approx(halves[1:] * math.pi / own, rel=1e-14)
    assert result.extreme_angles == pytest.approx(expected[1:], rel=1e-13)
    # The release counts, the piece that is cut by the end does not.
    assert result.swing_angles == pytest.approx(expected, rel=1e-13)
    assert result.swing_times[0] == 0.0
    assert (result.largest_time, result.largest_angle) == (0.0, first)
    assert result.significant_angle == pytest.approx(np.mean(np.abs(expected[:3])), rel=1e-13)
    sizes = np.abs(expected)
    for count in range(1, 10):
        assert result.swings_above(math.sqrt(sizes[count] * sizes[count - 1])) == count
    assert result.swings_above(0.0) == 10
    assert result.swings_above(first) == 0


def test_later_start_leaves_out_the_swing_it_cuts() -> None:
    path = roll_path(Ship(natural_frequency=1.0), NO_WAVES, angle=1.0)
    result = roll_statistics(path, 3 * math.pi + 0.1, start=0.5)
    assert result.swing_times == pytest.approx([math.pi, 2 * math.pi, 3 * math.pi], rel=1e-14)
    assert result.largest_angle == pytest.approx(-1.0, abs=1e-14) or result.largest_angle == pytest.approx(1.0)
    # A motion that only grows until the end has no swing, but a largest angle.
    growing = roll_statistics(roll_path(Ship(natural_frequency=1.0), NO_WAVES, rate=1.0), 1.0)
    assert growing.swing_angles.size == 0
    assert growing.significant_angle == 0.0
    assert (growing.largest_time, growing.largest_angle) == (1.0, pytest.approx(math.sin(1.0)))


def test_ship_that_nothing_moves_has_no_swings() -> None:
    result = roll_statistics(roll_path(Ship(natural_frequency=1.0), WaveTrain(periods=[3.0], slopes=[0.0])), 10.0)
    assert result.largest_angle == result.root_mean_square == result.significant_angle == 0.0
    assert result.extreme_times.size == result.swing_times.size == 0


def test_root_mean_square() -> None:
    # cos over 3.25 periods, and a decay beyond critical damping with a layer of 1/400 of its slow part.
    end = 6.5 * math.pi
    result = roll_statistics(roll_path(Ship(natural_frequency=1.0), NO_WAVES, angle=1.0), end)
    assert result.root_mean_square == pytest.approx(math.sqrt(0.5 + math.sin(2 * end) / (4 * end)), rel=1e-14)
    root = math.sqrt(10.0**2 - 1)
    slow, fast = -1 / (10 + root), -(10 + root)
    result = roll_statistics(roll_path(Ship(natural_frequency=1.0, damping=10.0), NO_WAVES, rate=1.0), 30.0)
    parts = sum(sign * math.expm1(p * 30) / p for sign, p in ((1, 2 * slow), (-2, slow + fast), (1, 2 * fast))) / (
        4 * root**2
    )
    assert result.root_mean_square == pytest.approx(math.sqrt(parts / 30), rel=1e-12)
    assert result.largest_time == pytest.approx(math.log(fast / slow) / (2 * root), rel=1e-12)


def test_peaks_of_the_printed_example() -> None:
    result = roll_statistics(roll_path(Ship(natural_frequency=K, damping=0.6 * K), PRINTED), 39.6)
    expected = {4.45: 0.60995, 8.93: -0.52308, 12.89: 0.41982, 20.47: 0.40411, 28.34: 0.50360}
    for when, angle in expected.items():
        nearest = np.abs(result.extreme_times - when).argmin()
        # Printed digits; the angle is flat at its extreme.
        assert result.extreme_times[nearest] == pytest.approx(when, abs=1e-2)
        assert result.extreme_angles[nearest] == pytest.approx(angle, abs=2e-5)
    assert result.largest_angle == pytest.approx(0.60995277, abs=1e-8)


@pytest.mark.parametrize("ratio", [0.0, 0.1, 0.6, 1.0, 1.5, 20.0])
def test_against_a_hundred_thousand_times(ratio: float) -> None:
    random = np.random.default_rng(5)
    train = WaveTrain(periods=random.uniform(2, 40, 60), slopes=random.uniform(-0.05, 0.05, 60))
    path = roll_path(Ship(natural_frequency=K, damping=ratio * K), train, rate=0.02)
    end = train.starts[-1] + 10
    result = roll_statistics(path, end)
    times = np.linspace(0, end, 400_001)
    motion = path.motion(times)
    largest = np.abs(motion.angle).max()
    # Samples miss extremes by φ'' (3.5 ms)²/8, and never exceed them.
    assert largest <= abs(result.largest_angle) * (1 + 1e-14)
    assert largest == pytest.approx(abs(result.largest_angle), rel=1e-4)
    turns = np.flatnonzero(np.diff(np.sign(motion.rate)) != 0)
    turns = turns[turns > 0]
    assert result.extreme_times == pytest.approx(times[turns], abs=2 * times[1])
    # The roots are rounded to 2e-16 of a time of 1e3 s, where φ'' reaches 0.1.
    assert np.abs(path.motion(result.extreme_times).rate).max() < 1e-13
    # Largest sample of each piece between changes of sign.
    pieces = np.split(np.abs(motion.angle), np.flatnonzero(np.diff(np.sign(motion.angle[1:]))) + 2)
    largest_of_pieces = np.array([piece.max() for piece in pieces])
    whole = largest_of_pieces[:-1] if pieces[-1].argmax() == len(pieces[-1]) - 1 else largest_of_pieces
    assert np.abs(result.swing_angles) == pytest.approx(whole, abs=1e-4 * largest)
    assert result.root_mean_square == pytest.approx(math.sqrt(np.mean(motion.angle**2)), rel=1e-4)
    parted = np.sort(whole)[::-1][: len(whole) // 3]
    assert result.significant_angle == pytest.approx(parted.mean(), abs=1e-4 * largest)


@pytest.mark.parametrize("depth", [1e-4, 1e-6])
def test_two_extremes_within_a_step_are_not_missed(depth: float) -> None:
    """A motion whose rate dips below 0 by little and for a short time, in the middle of a wave."""
    roll, train, when = Ship(natural_frequency=0.9), WaveTrain(periods=[2 * math.pi], slopes=[1.0]), 4.0
    # The rate and the acceleration there depend on the state at the start in a straight line.
    basis = [roll_path(roll, train, *state).motion(when) for state in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))]
    values = np.array([[float(motion.rate), float(motion.acceleration)] for motion in basis])
    for sign in (1, -1):
        state = np.linalg.solve((values[1:] - values[0]).T, np.array([-sign * depth, 0.0]) - values[0])
        path = roll_path(roll, train, *state)
        step = 1e-3
        jerk = float(np.diff(path.motion(np.array([when - step, when + step])).acceleration)[0]) / (2 * step)
        if jerk * sign < 0:
            continue
        result = roll_statistics(path, 2 * math.pi)
        near = result.extreme_times[np.abs(result.extreme_times - when) < 0.2]
        # rate ≈ ∓depth + jerk s²/2; the next derivative moves both by a part of their distance.
        expected = math.sqrt(2 * depth / abs(jerk))
        assert near - when == pytest.approx([-expected, expected], rel=0.1)
        return
    raise AssertionError("no dip was made")


@pytest.mark.slow_but("0.05")
@pytest.mark.parametrize("ratio", [0.0, 0.05, 2.0])
def test_ten_thousand_waves(ratio: float) -> None:
    random = np.random.default_rng(2)
    train = WaveTrain(periods=random.uniform(5, 15, 10_000), slopes=random.uniform(0.01, 0.05, 10_000))
    path = roll_path(Ship(natural_frequency=K, damping=ratio * K), train)
    result = roll_statistics(path, float(train.starts[-1]))
    assert 15_000 < len(result.swing_times) <= len(result.extreme_times) + 1 < 25_000


def test_quadratic_damping() -> None:
    roll, d = Ship(natural_frequency=K, damping=0.02 * K), 0.6
    path = quadratic_roll_path(replace(roll, quadratic_damping=d), NO_WAVES, 60.0, angle=0.5, tolerance=1e-10)
    result = roll_statistics(path, 60.0)
    expected = free_swings(replace(roll, quadratic_damping=d), 0.5, len(result.swing_angles) - 1)
    assert np.abs(result.swing_angles) == pytest.approx(expected, abs=1e-10)
    # The mean with other nodes.
    times = np.linspace(0, 60, 200_001)
    squares = path.motion(times).angle ** 2
    mean = squares.mean() - (squares[0] + squares[-1]) / (2 * len(squares))
    # The trapezoidal rule, h²/12 of the slopes at the ends and 1/n of the mean.
    assert result.root_mean_square == pytest.approx(math.sqrt(mean), rel=1e-5)


def test_in_waves_quadratic_damping_that_vanishes_gives_the_same() -> None:
    roll = Ship(natural_frequency=K, damping=0.05 * K)
    exact = roll_statistics(roll_path(roll, TRAIN), 39.6)
    other = roll_statistics(quadratic_roll_path(roll, TRAIN, 39.6), 39.6)
    assert other.swing_angles == pytest.approx(exact.swing_angles, abs=1e-9)
    assert other.extreme_times == pytest.approx(exact.extreme_times, abs=1e-7)
    assert other.root_mean_square == pytest.approx(exact.root_mean_square, rel=1e-8)


def test_roots_are_found_to_rounding_and_where_the_function_is_tiny() -> None:
    knots = np.linspace(0, 30, 40)
    assert sign_change_roots(np.sin, knots, np.sin(knots)) == pytest.approx(np.arange(1, 10) * math.pi, rel=4e-16)
    tiny = sign_change_roots(lambda x: 1e-300 * (x**3 - 2), np.array([0.0, 1.0, 2.0]), 1e-300 * np.array([-2.0, -1, 6]))
    assert tiny == pytest.approx([2 ** (1 / 3)], rel=4e-16)
    # A root at a knot is found, one that is only touched is none.
    assert sign_change_roots(lambda x: x - 1, np.array([0.0, 1.0, 2.0]), np.array([-1.0, 0.0, 1.0])) == pytest.approx(
        [1.0]
    )
    assert sign_change_roots(lambda x: x**2, np.array([-1.0, 0.0, 1.0]), np.array([1.0, 0.0, 1.0])).size == 0
    steep = bracketed_roots(
        lambda x: np.expm1(50 * (x - 0.9)), np.array([0.0]), np.array([1.0]), np.array([-1.0]), np.expm1([5.0])
    )
    assert steep == pytest.approx([0.9], rel=1e-15)


def test_wrong_arguments_are_named() -> None:
    path = roll_path(Ship(natural_frequency=1.0), NO_WAVES, angle=1.0)
    for start, end in ((-1.0, 2.0), (2.0, 2.0), (0.0, math.inf), (0.0, math.nan)):
        with pytest.raises(ValueError, match=r"start is .* and end .*; they must be finite, 0 ≤ start < end"):
            roll_statistics(path, end, start)
    with pytest.raises(ValueError, match="too often"):
        roll_statistics(path, 1e9)
    with pytest.raises(ValueError, match=r"level is -1\.0"):
        roll_statistics(path, 10.0).swings_above(-1.0)
