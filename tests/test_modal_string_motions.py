"""Motions of the upper end that are given by tables and functions, against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from uniform_strings import uniform_string

from hydroelastic.modal.string.response import string_response
from hydroelastic.physics.string_motions import Ramp, Sine, Smooth, Step, TabulatedMotion, sampled, tabulated

Floats = NDArray[np.float64]
POSITIONS = np.array([0.0, 0.1, 0.45, 0.8, 0.99])
TIMES = np.linspace(0.1, 3.9, 9)
END = 4.0


def _sine(times: Floats) -> Floats:
    return np.sin(5 * times)


def _smooth(times: Floats) -> Floats:
    return (1 - np.exp(-4 * times)) ** 2


def _step(times: Floats) -> Floats:
    return np.ones_like(times)


@pytest.mark.parametrize(
    "motion",
    [
        Ramp(speed=2.0),
        Sine(amplitude=1.5, omega=3.0),
        Smooth(amplitude=0.7, rate=2.0),
        Step(amplitude=0.3),
        tabulated([0, 1, 2, 4], [0, 1, 1, 5], "cubic"),
    ],
)
def test_derivatives_are_those_of_the_values(motion: Ramp | Sine | Smooth | Step | TabulatedMotion) -> None:
    times, step = np.array([0.3, 1.5, 3.2]), 1e-4
    below, at, above = (motion.value(times + shift) for shift in (-step, 0, step))
    # Central differences, of error step²/6 times a fourth derivative below 300, and of rounding over step².
    assert (above - below) / (2 * step) == pytest.approx(motion.slope(times), abs=1e-6)
    assert (above - 2 * at + below) / step**2 == pytest.approx(motion.curvature(times), abs=1e-6)
    assert motion.breaks[0] == 0


def test_values_of_motions() -> None:
    assert Ramp(speed=2.0).value(3.0) == pytest.approx(6.0)
    assert Sine(amplitude=2.0, omega=0.5).value(3.0) == pytest.approx(2 * math.sin(1.5))
    assert Smooth(amplitude=2.0, rate=0.5).value(3.0) == pytest.approx(2 * (1 - math.exp(-1.5)) ** 2)
    assert Step(amplitude=2.0).value(0.0) == 2
    table = tabulated([0.0, 1.0, 3.0], [1.0, 2.0, 0.0])
    assert table.value([0.0, 0.5, 1.0, 2.0, 3.0]) == pytest.approx([1.0, 1.5, 2.0, 1.0, 0.0])
    assert table.end == 3
    assert table.breaks == pytest.approx([0.0, 1.0])


@pytest.mark.slow
@pytest.mark.parametrize("damping", [0.0, 0.5, 3.766067388420842, 30.0])
@pytest.mark.parametrize(
    ("function", "motion"),
    [(_sine, Sine(amplitude=1.0, omega=5.0)), (_smooth, Smooth(amplitude=1.0, rate=4.0)), (_step, Step(amplitude=1.0))],
)
def test_functions_move_the_string_as_closed_forms_do(function: object, motion: Sine, damping: float) -> None:
    string = uniform_string(damping=damping)
    found = string_response(string, sampled(function, END, 1e-9), POSITIONS, TIMES)  # type: ignore[arg-type]
    exact = string_response(string, motion, POSITIONS, TIMES)
    # The deviation of the spline, 1e-9, is focused at the lower end: measured 3e-8 and less.
    assert found.values == pytest.approx(exact.values, abs=6e-8)


@pytest.mark.slow_but("0.0-linear", "200.0-cubic")
@pytest.mark.parametrize("interpolation", ["linear", "cubic"])
@pytest.mark.parametrize("damping", [0.0, 3.0, 200.0])
def test_a_table_of_a_ramp_is_the_ramp(interpolation: str, damping: float) -> None:
    string = uniform_string(damping=damping)
    rows = np.sort(np.random.default_rng(3).random(150)) * END
    rows = np.concatenate([[0.0], rows, [END]])
    found = string_response(string, tabulated(rows, 2 * rows, interpolation), POSITIONS, TIMES)  # type: ignore[arg-type]
    exact = string_response(string, Ramp(speed=2.0), POSITIONS, TIMES)
    error = np.abs(found.values - exact.values)
    assert (error <= 3 * (found.errors + exact.errors)).all()
    # Rounding of 28 s × 2 m/s, times 150 rows, for the heaviest damping.
    assert error.max() < 1e-11


def test_rounding_of_a_long_table_is_told() -> None:
    """Slow modes keep what is rounded at every row, and equal rows round to the same side."""
    string = uniform_string(damping=200.0)
    rows = np.linspace(0, END, 2001)
    found = string_response(string, tabulated(rows, 2 * rows), POSITIONS, TIMES)
    exact = string_response(string, Ramp(speed=2.0), POSITIONS, TIMES)
    error = np.abs(found.values - exact.values)
    assert error.max() > 1e-12
    assert (error <= 3 * (found.errors + exact.errors)).all()
    assert found.errors.max() < 30 * error.max()


@pytest.mark.slow_but("cubic-4")
@pytest.mark.parametrize(("interpolation", "order"), [("linear", 2), ("cubic", 4)])
def test_tables_converge(interpolation: str, order: int) -> None:
    string = uniform_string(damping=1.0)
    random = np.random.default_rng(11)
    positions, instants = random.random(40), END * random.random(40)
    exact = string_response(string, Sine(amplitude=1.0, omega=5.0), positions, instants).values
    errors = []
    for rows in (101, 201):
        times = np.linspace(0, END, rows)
        table = tabulated(times, _sine(times), interpolation)  # type: ignore[arg-type]
        errors.append(np.median(np.abs(string_response(string, table, positions, instants).values - exact)))
    # That of the interpolation.
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.2)


@pytest.mark.slow
def test_superposition() -> None:
    string = uniform_string(length=3.0, damping=0.4)
    times = np.linspace(0, END, 60)
    random = np.random.default_rng(5)
    first, second = random.standard_normal((2, 60))
    parts = [string_response(string, tabulated(times, rows), POSITIONS, TIMES) for rows in (first, second)]
    whole = string_response(string, tabulated(times, 2 * first - 3 * second), POSITIONS, TIMES)
    error = np.abs(whole.values - 2 * parts[0].values + 3 * parts[1].values)
    assert (error <= 3 * (whole.errors + 2 * parts[0].errors + 3 * parts[1].errors)).all()
    assert np.median(error) < 1e-12


def test_a_motion_may_begin_with_a_jump_and_be_broken() -> None:
    """A rise to 1, then from t = 1 on the same again, by a function with a jump: two steps, one after the other."""
    string = uniform_string(damping=0.6)
    stairs = sampled(lambda times: np.where(times < 1, 1.0, 3.0), END, 1e-9, breaks=[1.0])
    found = string_response(string, stairs, POSITIONS, TIMES)
    first = string_response(string, Step(amplitude=1.0), POSITIONS, TIMES)
    later = string_response(string, Step(amplitude=2.0), POSITIONS, np.maximum(TIMES - 1, 0))
    expected = first.values + later.values
    far = first.errors + later.errors < 1e-10
    assert found.values[far] == pytest.approx(expected[far], abs=1e-10)


def test_motion_is_continuous_where_a_table_goes_on() -> None:
    table = tabulated([0.0, 1.0, 2.0], [0.0, 1.0, 0.0])
    string = uniform_string(damping=0.3)
    below, above = string_response(string, table, 0.4, [1 - 1e-9, 1 + 1e-9]).values[0]
    # Velocities are below 10 m/s.
    assert below == pytest.approx(above, abs=2e-8)


@pytest.mark.parametrize(
    ("times", "values", "message"),
    [
        ([0.0], [1.0], "2 is allowed"),
        ([0.0, 1.0], [1.0], "shapes"),
        ([0.5, 1.0], [1.0, 2.0], "begins with 0.5"),
        ([0.0, 1.0, 1.0], [1.0, 2.0, 3.0], "1.0 after 1.0"),
        ([0.0, math.nan], [1.0, 2.0], "finite"),
    ],
)
def test_refuses_bad_tables(times: list[float], values: list[float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        tabulated(times, values)


def test_refuses_what_is_not_allowed() -> None:
    string = uniform_string()
    with pytest.raises(ValueError, match=r"times goes to 3\.0 s.*known up to 2\.0"):
        string_response(string, tabulated([0.0, 2.0], [0.0, 1.0]), 0.5, [1.0, 3.0])
    with pytest.raises(ValueError, match=r"times has -1\.0"):
        string_response(string, Ramp(speed=1.0), 0.5, [-1.0, 3.0])
    with pytest.raises(ValueError, match=r"positions has 2\.0"):
        string_response(string, Ramp(speed=1.0), 2.0, 1.0)
    with pytest.raises(ValueError, match="most_terms is 3"):
        string_response(string, Ramp(speed=1.0), 0.5, 1.0, most_terms=3)
    with pytest.raises(ValueError, match="tolerance is 0"):
        string_response(string, Ramp(speed=1.0), 0.5, 1.0, tolerance=0.0)
    with pytest.raises(ValueError, match="interpolation is 'quintic'"):
        tabulated([0.0, 1.0], [0.0, 1.0], "quintic")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="rate is 0"):
        Smooth(amplitude=1.0, rate=0.0)
    with pytest.raises(ValueError, match="speed is nan"):
        Ramp(speed=math.nan)


def test_refuses_functions_that_cannot_be_followed() -> None:
    with pytest.raises(ValueError, match="breaks may be missing"):
        sampled(lambda times: np.where(times < 1, 0.0, 1.0), END, 1e-9)
    with pytest.raises(ValueError, match="not finite"):
        sampled(lambda times: np.where(times < 2, 1.0, np.nan), END)
    with pytest.raises(ValueError, match="end is -1"):
        sampled(np.sin, -1.0)
    with pytest.raises(ValueError, match="outside"):
        sampled(np.sin, 1.0, breaks=[2.0])
