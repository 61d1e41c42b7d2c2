"""Roll on a train of waves in closed form: references, exponentials of matrices, integration in time, resonance."""

from __future__ import annotations

import math
from decimal import Decimal, localcontext

import numpy as np
import pytest
from roll_trains import PRINTED, SHIPS, TRAIN, K, exponential_motion, reference_ship
from scipy.integrate import solve_ivp

from hydroelastic.modal.damped_pair import damped_pair
from hydroelastic.modal.roll.motion import response_from_rest, roll_path, roll_response
from hydroelastic.physics.ship import Ship
from hydroelastic.physics.wave import WaveTrain

DAMPINGS = [0.0, 1e-6, 0.1, 0.96, 1 - 1e-9, 1.0, 1 + 1e-9, 1.5, 4.0, 200.0]
"""n/k."""


@pytest.mark.parametrize("name", SHIPS)
def test_references(name: str) -> None:
    roll, train, when = reference_ship(name)
    motion = roll_response(roll, train, when)
    # Measured: 3e-15 or less.
    assert float(motion.angle) == pytest.approx(float(SHIPS[name]["value"]), abs=1e-13)
    assert float(motion.rate) == pytest.approx(float(SHIPS[name]["derivative"]), abs=1e-13)


@pytest.mark.parametrize("ratio", DAMPINGS)
@pytest.mark.parametrize("start", [(0.0, 0.0), (0.4, -0.3)])
def test_is_the_exponential_of_the_matrix(ratio: float, start: tuple[float, float]) -> None:
    roll = Ship(natural_frequency=K, damping=ratio * K)
    times = np.random.default_rng(1).uniform(0, 80, 100)
    expected = exponential_motion(roll, TRAIN, times, *start)
    motion = roll_response(roll, TRAIN, times, *start)
    # expm keeps about 13 digits; with n = 200k its norm grows to 2e3 and it keeps 12.
    assert motion.angle == pytest.approx(expected[0], abs=1e-12)
    assert motion.rate == pytest.approx(expected[1], abs=1e-12)


@pytest.mark.parametrize("k", [1e-3, 0.05, 20.0])
def test_waves_much_shorter_and_longer_than_the_free_period(k: float) -> None:
    times = np.linspace(0, 60, 50)
    for ratio in (0.0, 0.3, 1.0, 2.0):
        roll = Ship(natural_frequency=k, damping=ratio * k)
        expected = exponential_motion(roll, TRAIN, times)[0]
        assert roll_response(roll, TRAIN, times).angle == pytest.approx(expected, abs=1e-12 * np.abs(expected).max())


@pytest.mark.parametrize("ratio", [1.5, 20.0, 200.0, 1e5])
@pytest.mark.parametrize("relative", [1e-4, 0.01, 1.0, 100.0])
def test_far_from_resonance_it_is_the_steady_and_the_free_motion(ratio: float, relative: float) -> None:
    n, omega = ratio, relative
    t = np.linspace(0, 2 * math.pi / omega, 30)
    denominator = (1 - omega**2) ** 2 + (2 * n * omega) ** 2
    p, q = (1 - omega**2) / denominator, -2 * n * omega / denominator
    cosine, sine = (pair[0] for pair in damped_pair(1.0, n, t))
    angle = p * (np.sin(omega * t) - omega * sine) + q * (np.cos(omega * t) - cosine - n * sine)
    # Roundings of p and q, of which differences are left.
    assert response_from_rest(1.0, n, omega, t).imag == pytest.approx(angle, abs=2e-15 * max(abs(p), abs(q)))


@pytest.mark.parametrize("ratio", [0.0, 0.6, 3.0])
def test_integration_in_time(ratio: float) -> None:
    roll, state, times = Ship(natural_frequency=K, damping=ratio * K), [0.1, 0.05], np.linspace(0, 1, 9)
    motion = roll_path(roll, TRAIN, *state)
    for start, period, omega, slope in zip(TRAIN.starts, TRAIN.periods, TRAIN.frequencies, TRAIN.slopes, strict=False):
        result = solve_ivp(
            lambda t, y, a=slope, w=omega: (
                y[1],
                K**2 * (a * math.sin(w * t) - y[0]) - 2 * roll.damping * y[1],
            ),
            (0, period),
            state,
            method="DOP853",
            rtol=1e-12,
            atol=1e-14,
            t_eval=times * period,
        )
        here = motion.motion(start + times * period)
        # Local errors of 1e-12, some tens of steps.
        assert here.angle == pytest.approx(result.y[0], abs=2e-11)
        assert here.rate == pytest.approx(result.y[1], abs=2e-11)
        state = result.y[:, -1].tolist()


def test_resonance_without_damping_grows_by_the_secular_term() -> None:
    roll, train = Ship(natural_frequency=K), WaveTrain(periods=[2 * math.pi / K] * 10, slopes=[1.0] * 10)
    t = np.linspace(0, 120, 1001)[:-1]
    motion = roll_response(roll, train, t)
    # φ grows to 31 rad, the phase kt to 63 rad: roundings of its own size in the expected values too.
    assert motion.angle == pytest.approx((np.sin(K * t) - K * t * np.cos(K * t)) / 2, abs=1e-12)
    assert motion.rate == pytest.approx(K**2 * t * np.sin(K * t) / 2, abs=1e-12)


@pytest.mark.parametrize("damping", [0.0, 1e-16, 1e-12, 1e-9, 1e-6, 1e-3])
@pytest.mark.parametrize("side", [-1, 1])
def test_neighbourhood_of_resonance_keeps_all_digits(damping: float, side: int) -> None:
    """The steady motion reaches 1e16 there, and the digits of what is left of it would be lost."""
    for distance in [0.0, *10.0 ** np.arange(-16, 0)]:
        omega = 1 + side * distance
        for duration in (0.3, 2.0, 2 * math.pi):
            angle, rate = taylor_response(damping, omega, duration)
            value = response_from_rest(1.0, damping, [omega], [duration])[0]
            # |y| is at most π; measured 2.4e-15.
            assert value.imag == pytest.approx(angle, abs=5e-15)
            assert omega * value.real == pytest.approx(rate, abs=5e-15)
    train = WaveTrain(periods=2 * math.pi / (1 + side * np.array([1e-15, 1e-9, 1e-4])), slopes=[1.0, 1.0, 1.0])
    times = np.linspace(0, 25, 40)
    motion = roll_response(Ship(natural_frequency=1.0, damping=damping), train, times)
    assert motion.angle == pytest.approx(
        exponential_motion(Ship(natural_frequency=1.0, damping=damping), train, times)[0], abs=1e-12
    )


def taylor_response(damping: float, omega: float, duration: float) -> tuple[float, float]:
    """Return φ and φ' of φ'' + 2nφ' + φ = sin ωt from rest, by their Taylor series with 50 digits."""
    with localcontext() as context:
        context.prec = 50
        n, w, t = Decimal(damping), Decimal(omega), Decimal(duration)
        terms = [Decimal(0), Decimal(0)]
        for j in range(80):
            sine = Decimal((0, 1, 0, -1)[j % 4]) * w**j / math.factorial(j)
            terms.append((sine - 2 * n * (j + 1) * terms[j + 1] - terms[j]) / ((j + 1) * (j + 2)))
        angle = sum(term * t**j for j, term in enumerate(terms))
        rate = sum(j * term * t ** (j - 1) for j, term in enumerate(terms) if j)
        return float(angle), float(rate)


def test_regular_at_critical_damping() -> None:
    angles = [
        float(roll_response(Ship(natural_frequency=K, damping=ratio * K), PRINTED, 20.0).angle)
        for ratio in (1 - 1e-6, 1.0, 1 + 1e-6)
    ]
    assert angles == pytest.approx([0.274478845, 0.274478639, 0.274478433], abs=1e-9)


def test_times_may_stand_in_any_order_and_shape() -> None:
    roll = Ship(natural_frequency=K, damping=0.1)
    times = np.array([[50.0, -1.0, 3.0], [0.0, 8.2, 12.0]])
    motion = roll_response(roll, TRAIN, times, 0.1, 0.2)
    for field in ("times", "angle", "rate", "acceleration"):
        values = getattr(motion, field)
        assert values.shape == (2, 3)
        for index in np.ndindex(2, 3):
            single = roll_response(roll, TRAIN, times[index], 0.1, 0.2)
            assert values[index] == pytest.approx(float(getattr(single, field)), abs=1e-16)
    assert (motion.angle[0, 1], motion.rate[0, 1], motion.acceleration[0, 1]) == (0.0, 0.0, 0.0)
    assert (motion.angle[1, 0], motion.rate[1, 0]) == (0.1, 0.2)
    assert roll_response(roll, TRAIN, []).angle.shape == (0,)


@pytest.mark.parametrize("ratio", [0.0, 0.6, 1.0, 5.0])
def test_motion_is_smooth_where_waves_meet(ratio: float) -> None:
    roll, tick = Ship(natural_frequency=K, damping=ratio * K), 1e-4
    inner = TRAIN.starts[1:-1]
    before, after = (roll_response(roll, TRAIN, inner + shift) for shift in (-1e-10, 1e-10))
    for field in ("angle", "rate", "acceleration"):
        # The next derivative is below 0.1, and acts for 2e-10 s.
        assert getattr(after, field) == pytest.approx(getattr(before, field), abs=1e-10)
    far = [roll_response(roll, TRAIN, inner + shift * tick).acceleration for shift in (-2, -1, 1, 2)]
    jerks = (far[3] - far[2] - far[1] + far[0]) / tick
    expected = K**2 * np.diff(TRAIN.slopes * TRAIN.frequencies)
    # Differences over 1e-4 s of what changes at rates up to 3/s (n = 5k).
    assert jerks == pytest.approx(expected, abs=3e-5)


def test_rate_and_acceleration_are_derivatives() -> None:
    times, step = np.linspace(1, 60, 40), 1e-4
    for ratio in (0.0, 0.5, 1.0, 3.0):
        before, here, after = (
            roll_response(Ship(natural_frequency=K, damping=ratio * K), TRAIN, times + d) for d in (-step, 0, step)
        )
        # Central differences: step²/6 of the third derivative and 1e-17/step, both near 1e-11.
        assert (after.angle - before.angle) / (2 * step) == pytest.approx(here.rate, abs=1e-10)
        assert (after.rate - before.rate) / (2 * step) == pytest.approx(here.acceleration, abs=1e-9)


def test_without_waves_the_ship_moves_freely() -> None:
    t = np.array([0.0, 1.0, 30.0])
    motion = roll_response(Ship(natural_frequency=2.0), WaveTrain(periods=[], slopes=[]), t, angle=0.1, rate=0.3)
    assert motion.angle == pytest.approx(0.1 * np.cos(2 * t) + 0.15 * np.sin(2 * t), abs=1e-15)


def test_late_waves_begin_where_their_periods_add_up_to() -> None:
    periods = np.random.default_rng(3).uniform(5, 15, 10_000)
    starts = WaveTrain(periods=periods, slopes=np.ones(10_000)).starts
    assert starts[:2].tolist() == [0.0, periods[0]]
    # One rounding of 1e5 s; rounded sums would be wrong by 30 of them.
    assert starts[-1] == pytest.approx(math.fsum(periods), abs=1.5e-11)


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [0.0, 0.02, 1.0, 200.0])
def test_ten_thousand_waves(ratio: float) -> None:
    random = np.random.default_rng(2)
    train = WaveTrain(periods=random.uniform(5, 15, 10_000), slopes=random.uniform(0.01, 0.05, 10_000))
    times = random.uniform(0, train.starts[-1], 100_000)
    motion = roll_response(Ship(natural_frequency=K, damping=ratio * K), train, times)
    late = np.sort(times)[-5:]
    expected = exponential_motion(Ship(natural_frequency=K, damping=ratio * K), train, late)
    # The undamped ship rolls by 18 rad. The exponentials differ by 1.1e-9; steady and free motions, summed up in
    # extended precision, differ by 5e-13 from the closed form.
    largest = np.abs(motion.angle).max()
    assert roll_response(Ship(natural_frequency=K, damping=ratio * K), train, late).angle == pytest.approx(
        expected[0], abs=1e-10 * largest
    )


def test_wrong_arguments_are_named() -> None:
    with pytest.raises(ValueError, match=r"natural_frequency is 0\.0; it must be finite and positive"):
        Ship(natural_frequency=0.0)
    with pytest.raises(ValueError, match=r"damping is -1\.0"):
        Ship(natural_frequency=1.0, damping=-1.0)
    with pytest.raises(ValueError, match=r"damping is nan"):
        Ship(natural_frequency=1.0, damping=math.nan)
    with pytest.raises(ValueError, match=r"quadratic_damping is -1\.0"):
        Ship(natural_frequency=1.0, quadratic_damping=-1.0)
    with pytest.raises(ValueError, match="the closed form is that of linear damping"):
        roll_response(Ship(natural_frequency=1.0, quadratic_damping=0.1), TRAIN, 0.0)
    with pytest.raises(ValueError, match=r"periods have shape \(2,\) and slopes \(1,\)"):
        WaveTrain(periods=[1.0, 2.0], slopes=[1.0])
    with pytest.raises(ValueError, match=r"periods\[1\] is 0\.0"):
        WaveTrain(periods=[1.0, 0.0], slopes=[1.0, 1.0])
    with pytest.raises(ValueError, match=r"slopes\[0\] is inf"):
        WaveTrain(periods=[1.0], slopes=[math.inf])
    with pytest.raises(ValueError, match="times contain nan"):
        roll_response(Ship(natural_frequency=1.0), TRAIN, [0.0, math.nan])
    with pytest.raises(ValueError, match="rate is inf"):
        roll_response(Ship(natural_frequency=1.0), TRAIN, 0.0, rate=math.inf)
