"""The string's motion to a tolerance: closed forms, error estimates, fronts, and options that have no closed form."""

from __future__ import annotations

import numpy as np
import pytest
from mpi4py import MPI
from numpy.polynomial import chebyshev
from scipy.integrate import quad
from string_closed_forms import FREQUENCIES, Motion, ramp, sine, smooth, step

from hydroelastic.fem.string.response import field_response
from hydroelastic.fem.string.smoothed_motion import SmoothedMotion
from hydroelastic.physics.string import HangingString

COMM = MPI.COMM_WORLD
MOTIONS = {"ramp": ramp(), "sine": sine(1.7), "smooth": smooth(2.0), "step": step(), "fast": smooth(15.0)}
POSITIONS = np.array([0.0, 0.04, 0.1, 0.25, 0.36, 0.5, 0.7, 0.9])
# None nearer than 0.09 to a front, which passes at 2(1 ∓ √x), 2(3 ∓ √x).
TIMES = np.array([0.5, 1.1, 1.7, 2.8, 3.3, 4.7])


def plain(damping: float) -> HangingString:
    return HangingString(length=1.0, linear_density=1.0, gravity=1.0, resistance=(damping, damping))


@pytest.mark.slow_but("0.001-ramp-1.2*")
@pytest.mark.parametrize("damping", [0.0, float(FREQUENCIES[0]), 9.0])
@pytest.mark.parametrize("name", list(MOTIONS))
@pytest.mark.parametrize("tolerance", [1e-3, 1e-5])
def test_closed_forms_are_met_to_the_tolerance(tolerance: float, name: str, damping: float) -> None:
    motion = MOTIONS[name]
    exact = motion.answer(damping, POSITIONS, TIMES)
    solution = field_response(COMM, plain(damping), motion, POSITIONS, TIMES, tolerance=tolerance)
    errors = np.abs(solution.values - exact)
    assert solution.converged, solution.problem
    assert errors.max() <= tolerance
    worst = np.max(errors / (solution.errors + 1e-11 / 3.0))
    assert worst <= 3.0
    assert solution.errors.max() <= tolerance


@pytest.mark.slow_on_ranks_but
@pytest.mark.mpi
def test_smooth_motion_to_seven_digits_in_si_units() -> None:
    # U(0.36 m, 0.9 s) of a metre of string with damping 0.5 1/s moved by (1 − e^{−4t})² m: a series of 20 digits.
    model = HangingString(length=1.0, linear_density=2.0, resistance=(1.0, 1.0))
    solution = field_response(COMM, model, smooth(4.0), [0.36], [0.9], tolerance=1e-7)
    assert solution.values[0, 0] == pytest.approx(1.0619715878918396711, abs=1e-9)
    assert solution.converged


@pytest.mark.slow
def test_other_lengths_and_gravities() -> None:
    model = HangingString(length=25.0, linear_density=0.3, resistance=(0.09, 0.09))
    solution = field_response(COMM, model, step(), [4.0], [5.2], tolerance=1e-7)
    # A series of 20 digits.
    assert solution.values[0, 0] == pytest.approx(1.2385595747368938928, abs=1e-8)


@pytest.mark.slow
def test_what_hardly_moves_and_what_moves_long() -> None:
    # α = 200 1/s for 50 s, and a slow sine after 300 s: the steady parts of series of 20 digits.
    heavy = HangingString(length=1.0, linear_density=1.0, resistance=(200.0, 200.0))
    solution = field_response(COMM, heavy, ramp(), [0.3], [50.0], tolerance=1e-3)
    assert solution.values[0, 0] == pytest.approx(26.146073912107334526, abs=1e-5)
    slow = HangingString(length=1.0, linear_density=1.0, resistance=(0.5, 0.5))
    solution = field_response(COMM, slow, sine(0.01), [0.2], [300.0], tolerance=1e-3)
    assert solution.values[0, 0] == pytest.approx(0.14192842121993356893, abs=1e-6)
    assert solution.sizes.steps < 10_000


@pytest.mark.slow
def test_silence_before_the_front_but_for_ripples() -> None:
    times = np.array([0.2, 0.5, 0.9])
    for motion in (step(), ramp(), smooth(4.0)):
        solution = field_response(COMM, plain(0.1), motion, [0.0, 0.1], times, tolerance=1e-4)
        # At 0.1 the front passes after 1.37.
        assert np.all(np.abs(solution.values) <= 1e-4)
        assert solution.converged


@pytest.mark.slow
def test_values_in_a_front_are_not_claimed() -> None:
    # At x = 0.25 the front of a step passes at t = 1: what is given is the mean of both sides, off by half of the jump.
    damping = 0.2
    jump = 0.25**-0.25 * np.exp(-damping)
    solution = field_response(
        COMM, plain(damping), step(), [0.25], [1.0], tolerance=1e-4, most_unknowns=1500, most_steps=3000
    )
    assert not solution.converged
    assert "front" in solution.problem
    assert solution.values[0, 0] == pytest.approx(0.5 * jump, abs=0.02)
    assert solution.errors[0, 0] > 0.5 * jump
    # A smooth start is no worse for it than its square.
    soft = field_response(COMM, plain(damping), smooth(2.0), [0.25], [1.0], tolerance=1e-4)
    assert soft.converged
    assert abs(soft.values[0, 0]) <= soft.errors[0, 0]


@pytest.mark.slow
def test_the_upper_end_moves_as_it_is_told() -> None:
    solution = field_response(COMM, plain(0.1), step(), [0.5, 1.0], [0.7, 1.5], tolerance=1e-4)
    np.testing.assert_array_equal(solution.values[1], 1.0)
    np.testing.assert_array_equal(solution.errors[1], 0.0)


def test_steady_oscillation_with_all_options() -> None:
    model = HangingString(
        length=2.0,
        linear_density=0.8,
        resistance=(3.0, 1.8),
        tip_mass=0.6,
        tip_displaced_mass=0.1,
        added_mass=0.3,
        displaced_mass=0.2,
    )
    omega = 5.0
    positions = np.array([0.0, 0.3, 1.1, 1.8])
    # Free motions decay like e^{−1.6t} at the least, so that 1e-8 of them is left.
    times = np.array([12.0, 12.3])
    solution = field_response(COMM, model, sine(omega), positions, times, tolerance=1e-4)
    amplitude = steady(model, omega, positions)
    exact = np.imag(amplitude[:, None] * np.exp(1j * omega * times))
    assert solution.converged
    np.testing.assert_allclose(solution.values, exact, atol=1e-4)
    # Without the tip's inertia, or with its weight alone, it would be another motion.
    assert np.abs(amplitude - steady(model, omega, positions, tip=0.0)).max() > 0.05


def steady(model: HangingString, omega: float, positions: np.ndarray, tip: float | None = None) -> np.ndarray:
    """U e^{−iωt} of U(l) = e^{iωt} by Chebyshev's polynomials at points: (TU')' = (−mω² + 2iωλ)U, TU'(0) = −Mω²U(0)."""
    size = 40
    points = -np.cos(np.pi * np.arange(size + 1) / size)
    x = 0.5 * model.length * (points + 1.0)
    unit, scale = np.eye(size + 1), 2.0 / model.length
    values = np.array([chebyshev.chebval(points, row) for row in unit]).T
    first = scale * np.array([chebyshev.chebval(points, chebyshev.chebder(row)) for row in unit]).T
    second = scale**2 * np.array([chebyshev.chebval(points, chebyshev.chebder(row, 2)) for row in unit]).T
    slope = model.gravity * (model.linear_density - model.displaced_mass)
    bottom = model.gravity * (model.tip_mass - model.tip_displaced_mass)
    drag = model.resistance[0] + (model.resistance[1] - model.resistance[0]) * x / model.length
    inertia = -(omega**2) * (model.linear_density + model.added_mass) + 2j * omega * drag
    system = (bottom + slope * x)[:, None] * second + slope * first - inertia[:, None] * values
    system[0] = bottom * first[0] + omega**2 * (model.tip_mass if tip is None else tip) * values[0]
    system[-1] = values[-1]
    coefficients = np.linalg.solve(system, np.append(np.zeros(size), 1.0))
    return np.asarray(chebyshev.chebval(2.0 * positions / model.length - 1.0, coefficients))


@pytest.mark.parametrize("order", [0, 1, 2])
def test_soft_motion_is_a_convolution(order: int) -> None:
    motion = MOTIONS["fast"]
    soft = SmoothedMotion(motion, 0.3, 8.0)

    def kernel(t: float) -> float:
        width = 0.3 / np.sqrt(16.0 * np.log(10.0))
        return float(soft.middle / np.pi * np.sinc(soft.middle * t / np.pi) * np.exp(-0.5 * (t / width) ** 2))

    functions = (soft.value, soft.slope, soft.curvature)
    for time in (-0.2, 0.0, 0.11, 0.25):
        if order == 0:
            expected = quad(
                lambda s, t=time: kernel(t - s) * motion.value(s), 0.0, time + 0.3, epsabs=1e-12, limit=400
            )[0]
            assert functions[0](time) == pytest.approx(expected, abs=1e-10)
        else:
            # Of fourth order.
            h = 1e-4
            below = functions[order - 1]
            expected = (8.0 * (below(time + h) - below(time - h)) - below(time + 2 * h) + below(time - 2 * h)) / (
                12.0 * h
            )
            assert functions[order](time) == pytest.approx(float(expected), rel=1e-6, abs=1e-6)
    assert functions[order](-0.31) == 0.0
    assert functions[order](0.31) == (motion.value, motion.slope, motion.curvature)[order](0.31)


def test_a_step_is_softened_with_its_jump() -> None:
    soft = SmoothedMotion(step(), 0.2, 9.0)
    times = np.linspace(-0.2, 0.2, 2001)
    # From 0 to 1, odd about ½; rate and curvature are those of the kernel.
    np.testing.assert_allclose(soft.value(times) + soft.value(times)[::-1], 1.0, atol=1e-8)
    np.testing.assert_allclose(np.gradient(soft.value(times), times)[5:-5], soft.slope(times)[5:-5], atol=0.3)
    assert np.trapezoid(soft.slope(times), times) == pytest.approx(1.0, abs=1e-8)
    # φ'' in the middle.
    bend = -soft.middle / np.pi * (soft.middle**2 / 3.0 + soft.width**-2)
    for time in (1e-7, 1e-5):
        assert soft.curvature(time) == pytest.approx(bend * time, rel=1e-4)


@pytest.mark.slow
def test_tables_with_an_end() -> None:
    # A table of straight lines that ends with the last output time.
    knots, heights = np.array([0.0, 0.4, 1.0, 2.0]), np.array([0.0, 0.2, -0.1, 0.3])
    rates = np.diff(heights) / np.diff(knots)

    def slope(times: object) -> np.ndarray:
        place = np.clip(np.searchsorted(knots, np.asarray(times), side="right") - 1, 0, 2)
        return rates[place]

    one = ramp()
    table = Motion(
        lambda t: np.interp(t, knots, heights),
        slope,
        lambda t: 0.0 * np.asarray(t, float),
        one.answer,
        tuple(knots[:-1]),
        2.0,
    )
    times, positions = np.array([1.3, 2.0]), np.array([0.1, 0.6])
    solution = field_response(COMM, plain(0.2), table, positions, times, tolerance=1e-5)
    exact = np.zeros((2, 2))
    for knot, kink in zip(knots[:-1], np.diff(rates, prepend=0.0), strict=True):
        for number, time in enumerate(times):
            # At rest until the front of this kink comes.
            come = time - knot > 2.0 * (1.0 - np.sqrt(positions))
            exact[:, number] += kink * np.where(
                come, one.answer(0.2, positions, np.array([max(time - knot, 0.0)]))[:, 0], 0.0
            )
    assert np.all(np.abs(solution.values - exact) <= np.maximum(3.0 * solution.errors, 1e-5))


@pytest.mark.parametrize(
    ("positions", "times", "tolerance", "name"),
    [
        ([1.5], [1.0], 1e-3, "positions"),
        ([-0.1], [1.0], 1e-3, "positions"),
        ([0.5], [-1.0], 1e-3, "times"),
        ([0.5], [2.0, 1.0], 1e-3, "times"),
        ([0.5], [1.0], 0.0, "tolerance"),
    ],
)
def test_bad_arguments_are_refused(positions: list[float], times: list[float], tolerance: float, name: str) -> None:
    with pytest.raises(ValueError, match=name):
        field_response(COMM, plain(0.0), ramp(), positions, times, tolerance=tolerance)
