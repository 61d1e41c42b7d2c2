"""Fronts of a hanging string, what is exact about them, and the honesty of the errors next to them."""

from __future__ import annotations

import numpy as np
import pytest
from string_bromwich import bromwich
from string_cases import image_of
from uniform_strings import uniform_string

from hydroelastic.modal.string.closed_form import front_jump
from hydroelastic.modal.string.response import string_response
from hydroelastic.physics.string import HangingString
from hydroelastic.physics.string_motions import Ramp, Sine, Smooth, Step, tabulated

MOTIONS = [Ramp(speed=1.3), Sine(amplitude=0.4, omega=7.0), Smooth(amplitude=1.0, rate=4.0), Step(amplitude=0.5)]
STRING = uniform_string(length=2.0, damping=0.8)


@pytest.mark.parametrize("motion", MOTIONS)
def test_nothing_moves_before_the_front(motion: Ramp | Sine | Smooth | Step) -> None:
    positions = np.array([0.0, 0.1, 1.0, 1.9])
    found = string_response(STRING, motion, positions, STRING.arrival_times(positions) * (1 - 1e-12))
    ahead = np.subtract.outer(STRING.arrival_times(positions), STRING.arrival_times(positions)) >= 0
    assert (found.values[ahead] == 0).all()
    assert (found.errors[ahead] == 0).all()
    assert string_response(STRING, motion, positions, 0.0).values.tolist() == [[0.0]] * 4


@pytest.mark.parametrize("motion", MOTIONS)
def test_the_upper_end_is_where_it_is_moved_to(motion: Ramp | Sine | Smooth | Step) -> None:
    times = np.linspace(0, 9, 7)
    found = string_response(STRING, motion, 2.0, times)
    assert found.values[0] == pytest.approx(motion.value(times), abs=1e-15)


@pytest.mark.parametrize(
    ("damping", "position", "expected"), [(0.0, 0.6, None), (0.8, 0.36, 1.05240), (3.0, 0.09, 0.47761)]
)
def test_height_of_the_front_of_a_step(damping: float, position: float, expected: float | None) -> None:
    string = uniform_string(damping=damping)
    front, jump = float(string.arrival_times(position)), float(front_jump(string, position))
    assert jump == pytest.approx(position**-0.25 * np.exp(-damping * front), rel=1e-14)
    if expected:
        # Numbers of the theory.
        assert jump == pytest.approx(expected, abs=6e-6)
    after = np.array([1e-3, 2e-3]) * string.travel_time
    first, second = string_response(string, Step(amplitude=1.0), position, front + after).values[0]
    # Behind the front the motion is smooth: its value there by a straight line, of error (10⁻³)² times a few.
    assert 2 * first - second == pytest.approx(jump, rel=2e-5)


def _random_points(seed: int) -> tuple[HangingString, np.ndarray, np.ndarray]:
    random = np.random.default_rng(seed)
    damping = 10 ** random.uniform(-2, 1) * (random.random() > 0.2)
    string = uniform_string(length=10 ** random.uniform(-1, 1), damping=damping)
    ratios = np.concatenate([[0.0], random.random(8), 1 - 10 ** random.uniform(-5, -1, 3)])
    return string, string.length * ratios**2, string.travel_time * random.uniform(0, 6, 12)


TABLE_TIMES = np.linspace(0, 40, 81)
TABLE = np.sin(2 * TABLE_TIMES) + 0.3 * np.cos(5 * TABLE_TIMES)
ALL_MOTIONS = [
    *MOTIONS,
    Smooth(amplitude=1.0, rate=300.0),
    tabulated([0.0, 1.0, 2.0, 40.0], [0.5, 1.0, 0.0, 0.0]),
    tabulated(TABLE_TIMES, TABLE),
    tabulated(TABLE_TIMES, TABLE, "cubic"),
]


@pytest.mark.slow_but("motion[01]")
@pytest.mark.parametrize("motion", ALL_MOTIONS)
def test_errors_are_honest(motion: Ramp | Sine | Smooth | Step) -> None:
    errors, estimates = [], []
    for seed in range(10):
        string, positions, times = _random_points(seed)
        few = string_response(string, motion, positions, times, most_terms=512)
        many = string_response(string, motion, positions, times, most_terms=2**14)
        known = many.errors < few.errors / 10
        errors.append(np.abs(few.values - many.values)[known])
        estimates.append(few.errors[known])
    error, estimate = np.concatenate(errors), np.concatenate(estimates)
    assert len(error) > 50
    # The estimate bounds the envelope of an oscillating tail; measured: at most 1.4 times too small.
    assert (error < 3 * estimate).all()
    # … 5 times too large for three of four points (measured), where the error is none of rounding.
    large = error > 1e-13
    assert np.quantile(estimate[large] / error[large], 0.75) < 10


@pytest.mark.parametrize("seed", range(20))
def test_random_points_by_the_integral(seed: int) -> None:
    string, positions, times = _random_points(100 + seed)
    motion = MOTIONS[seed % 4]
    found = string_response(string, motion, positions, times)
    random = np.random.default_rng(seed)
    for row, column in random.integers(0, 12, (6, 2)):
        ratio, phase = np.sqrt(positions[row] / string.length), times[column] / string.travel_time
        distances = [abs(phase - odd - sign * ratio) for odd in range(-1, 10, 2) for sign in (-1, 1)]
        if phase < 1 - ratio or min(distances) < 0.01:
            continue
        expected = bromwich(
            image_of(motion),
            length=string.length,
            damping=string.damping,
            gravity=9.81,
            position=positions[row],
            time=times[column],
            highest=7.0 if isinstance(motion, Sine) else 0.0,
        )
        # e^3 of rounding in the integral.
        assert found.values[row, column] == pytest.approx(expected, rel=1e-12, abs=2e-12)


@pytest.mark.parametrize("motion", [Step(amplitude=1.0), Smooth(amplitude=1.0, rate=6.0)])
def test_right_behind_the_front_with_single_points(motion: Step | Smooth) -> None:
    for ratio in (0.0, 0.2, 0.6, 0.95):
        found = string_response(STRING, motion, 2.0 * ratio**2, STRING.travel_time * (1 - ratio + 0.002))
        # The step at the lower end is 15 m high there, of terms that fall as k^{−1/2}.
        assert found.errors[0, 0] < 1e-10


def test_many_points_need_fewer_modes_than_few() -> None:
    positions, times = np.linspace(0, 2, 300), np.linspace(0, 3, 300)
    grid = string_response(STRING, Step(amplitude=1.0), positions, times)
    alone = string_response(STRING, Step(amplitude=1.0), positions[37], times)
    assert grid.terms < alone.terms
    both = grid.errors[37] + alone.errors[0]
    assert (np.abs(grid.values[37] - alone.values[0]) <= 3 * both).all()
    # What the grid leaves unresolved is next to its fronts.
    assert np.mean(grid.errors > 1e-9) < 0.02


@pytest.mark.slow
@pytest.mark.parametrize("motion", MOTIONS)
def test_a_million_points_need_few_modes_and_keep_their_errors(motion: Ramp | Sine | Smooth | Step) -> None:
    positions, times = np.linspace(0, 2, 1000), np.linspace(0, 4, 1000)
    found = string_response(STRING, motion, positions, times)
    # With 10,000 points eight times as many: the cost of many points is bounded.
    assert found.terms <= 4096
    assert np.mean(found.errors > 1e-9) < 0.02
