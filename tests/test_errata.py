"""The errata of the four papers: what each printed formula gives, beside the corrected one, as the pages show it.

docs/theory_aquarium.md § 1.3, docs/theory_two_liquids.md § 9 and docs/errata_string_and_roll.md list the errors. Here
every printed formula that has a value is evaluated, and so is the project's own, which other tests compare with
references that are independent of the papers. Notation is that of the pages.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.special import jv
from uniform_strings import uniform_string

from hydroelastic.modal.beam.added_mass import lid_added_mass
from hydroelastic.modal.beam.cosine_moments import cosine_moments
from hydroelastic.modal.beam.dry_modes import free_free_roots
from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.modal.bessel_zeros import bessel_zeros
from hydroelastic.modal.estimate import added_mass_from_frequency
from hydroelastic.modal.floats.thin_float import thin_constants, thin_float_added_mass, thin_float_mass
from hydroelastic.modal.roll.motion import roll_response
from hydroelastic.modal.string.closed_form import (
    bessel_ratio,
    first_oscillating_mode,
    natural_frequencies,
    natural_frequency,
    participations,
    relative_roots,
    steady_amplitude,
    transfer,
)
from hydroelastic.modal.string.partial_sum import partial_sum
from hydroelastic.modal.string.resonance import string_resonance
from hydroelastic.modal.string.response import string_response
from hydroelastic.modal.string.truncation import weights
from hydroelastic.physics.profiles import Profile
from hydroelastic.physics.ship import Ship
from hydroelastic.physics.string import HangingString
from hydroelastic.physics.string_motions import Motion, Ramp, Sine, Smooth, Step
from hydroelastic.physics.wave import WaveTrain

DOCS = Path(__file__).parent.parent / "docs"
STRING_PAGE, ROLL_PAGE = (DOCS / "errata_string_and_roll.md").read_text(encoding="utf-8").split("## The ship on")
Pair = tuple[float, float]  # as printed, corrected


# The beam in an aquarium: theory_aquarium.md § 1.3

BEAM = FloatingBeam(
    tank_length=10.0,
    depth=5.0,
    density=1000.0,
    gravity=9.81,
    start=0.0,
    length=4.0,
    flexural_rigidity=5e3,
    mass_per_length=50.0,
    hydrostatic=False,
)


def test_beam_4_printed_determinant_loses_the_roots_of_the_free_beam() -> None:
    for b in map(float, free_free_roots(3)):
        printed = (math.cosh(b) - math.cos(b)) ** 2 - (math.sinh(b) - math.sin(b)) ** 2
        corrected = (math.cosh(b) - math.cos(b)) ** 2 - (math.sinh(b) - math.sin(b)) * (math.sinh(b) + math.sin(b))
        # Rounding of cosh², relative to the sum of its terms.
        assert corrected == pytest.approx(0.0, abs=1e-14 * math.cosh(b) ** 2)
        assert abs(printed) > math.cosh(b)


def test_beam_5_printed_bracket_depends_on_the_unit_of_length() -> None:
    def bracket(tank: float, depth: float, beam: float) -> Pair:
        k = math.pi / tank
        sines = (math.sin(2 * k * tank) - math.sin(2 * k * beam)) / 4
        printed = math.cos(2 * k * beam) / 2 + beam / 2 + (tank - beam) / 2 + sines
        return k * math.tanh(k * depth) * printed, k * math.tanh(k * depth) * tank / 2

    metres, millimetres = bracket(10.0, 5.0, 4.0), bracket(1e4, 5e3, 4e3)
    assert millimetres[1] == pytest.approx(metres[1], rel=1e-14)
    assert abs(millimetres[0] / metres[0] - 1.0) > 0.01


def test_beam_2_printed_load_makes_the_added_mass_negative() -> None:
    # The terms of the lid's series ρ c_n²/(l T_nn), T_nn = k tanh(kH) L/2; with the printed load each is negative.
    k = np.pi / 10.0 * np.arange(1, 400)
    terms = 1000.0 * cosine_moments(BEAM, 2, k) ** 2 / (4.0 * k * np.tanh(5.0 * k) * 5.0)
    # What the series leaves after n = 400 is below Σ n⁻³ ~ 3e-6 of its first terms.
    assert float(terms.sum()) == pytest.approx(lid_added_mass(BEAM), rel=2e-5)


def test_beam_9_printed_added_mass_forgets_hydrostatics() -> None:
    page = (DOCS / "theory_aquarium.md").read_text(encoding="utf-8")
    soft = FloatingBeam(**(vars(BEAM) | {"start": 3.0, "flexural_rigidity": 50.0, "hydrostatic": True}))
    omega = 4.28573
    printed = (soft.first_dry_stiffness - soft.hydrostatic_stiffness) / omega**2
    assert f"μ* = {printed:.1f} kg/m²" in page
    assert f"$m_a$ = {added_mass_from_frequency(soft, omega):.0f} kg/m²" in page


# The float between two liquids: theory_two_liquids.md § 9


def test_float_constants_are_those_of_the_page() -> None:
    # b = 0.1 m, h = 1 m, ρ = 0.8 and 1 kg/m³; τ = b/h, g* = g/9, ν² = g*/h, α = 1.
    profile = Profile(shape="exponential", half_width=0.1, half_height=1.0)
    tau, reduced, density = 0.1, 9.81 / 9.0, 1.8
    mass, constants = thin_float_mass(profile, 1.0, 0.8), thin_constants(profile)
    added = thin_float_added_mass(profile, 1.0, 0.8)

    def row(ratio: float, coupling: float, omega_squared: float, kernel: float, tail: float) -> str:
        omega = math.sqrt(omega_squared)
        return f"{ratio:.6f} | {(ratio - 1) * mass:.6f} | {coupling:.6f} | {omega:.6f} | {kernel:.4f} | {tail:+.6f} |"

    ratio = 1.0 + tau / (2.0 * math.pi)
    coupling = 2.0 * tau / ratio
    printed = row(ratio, coupling, reduced / ratio, 4.0 * reduced * density / (mass * ratio), coupling / reduced)
    right = constants.coupling, constants.frequency_squared
    kernel = 4.0 / math.pi * reduced * density / (mass + added)
    corrected = row(1 + added / mass, right[0], right[1] * reduced, kernel, -2.0 * right[0] / (right[1] * reduced))
    page = (DOCS / "theory_two_liquids.md").read_text(encoding="utf-8").replace("−", "-")
    assert f"| printed | {printed}" in page
    assert f"| corrected | {corrected}" in page


# The hanging string


def string(damping: float) -> HangingString:
    return uniform_string(damping=damping)


def response(given: HangingString, motion: Motion, position: float, time: float) -> float:
    return float(string_response(given, motion, position, time).values[0, 0])


def critical_damping() -> Pair:
    return math.sqrt(9.81 * float(bessel_zeros(1)[0]) / 2), natural_frequency(string(0.0), 1)


def lowest_oscillating_mode() -> Pair:
    """The lowest k with α ≤ √(gμ_k/2l), and with α < Ω_k, for α = 30 1/s."""
    zero = 2 * 30.0**2 / 9.81
    printed = int(np.searchsorted(bessel_zeros(int(zero / math.pi) + 2), zero)) + 1
    return printed, first_oscillating_mode(string(30.0))


def static_series() -> Pair:
    term = 0.05 * 0.7 * (0.7 + 2 * 0.4)
    return 1 - term, 1 + term + term**2 / 4


def static_slope() -> Pair:
    term = 0.05 * 0.7 * (0.7 + 2 * 0.4)
    return -0.05 * 1.1, 0.05 * 1.1 * (2 + term)


def ramp_motion() -> Pair:
    """(28): 4al/(gμ_k) under the root, for 4a²l/(gμ_k²); the differences of the modes fall as 1/k³."""
    given, count, time = string(3.0), 4096, 1.0
    zeros, frequencies = bessel_zeros(count), natural_frequencies(given, count)
    damped = np.sqrt((frequencies - 3.0) * (frequencies + 3.0))
    phase = np.arctan2(9.0 - damped**2, 6.0 * damped)
    shapes = participations(zeros, relative_roots(given, [0.25]))[0] * weights(np.arange(1, count + 1), count)
    motion = shapes * math.exp(-3.0 * time) * np.cos(damped * time - phase)
    excess = float(motion @ (1 / (frequencies * np.sqrt(1 - 4 * 3.0 / (9.81 * zeros))) - 1 / damped))
    corrected = response(given, Ramp(speed=1.0), 0.25, time)
    return corrected + excess, corrected


def resonance_frequency() -> Pair:
    found = string_resonance(string(2.0), 1)
    return found.free_frequency, found.peak_frequency


def sine_amplitude() -> Pair:
    """(41): |J₀(μr)|², for |J₀(μr)|/|J₀(μ)|."""
    given, omega = string(0.5), 5.0
    argument = given.travel_time * np.sqrt(omega**2 - 1j * omega)
    printed = abs(jv(0, argument * float(relative_roots(given, 0.1)))) ** 2
    return float(printed), float(steady_amplitude(given, omega, 0.1)[0])


def smooth_motion(damping: float, rate: float, position: float, time: float) -> Pair:
    """(49) and (51): principal arctangents, and z₂ with 1 − 2a/b for 1 − a/b."""
    given = string(damping)
    corrected, decay = response(given, Smooth(amplitude=1.0, rate=rate), position, time), math.exp(-rate * time)
    first, second = transfer(given, [-rate, -2 * rate], position)[0].real
    argument = 2 * given.travel_time * np.sqrt(np.array([rate * (rate - 2 * damping)], dtype=complex))
    printed_second = float(bessel_ratio(argument, relative_roots(given, [position]))[0, 0].real)
    modes = corrected - (1 - 2 * first * decay + second * decay**2)
    sign = math.copysign(1.0, (rate - damping) * (2 * rate - damping))
    return 1 - 2 * first * decay + printed_second * decay**2 + sign * modes, corrected


def step_motion() -> Pair:
    corrected = response(string(0.0), Step(amplitude=1.0), 0.25, 1.1)
    return (1.0 + corrected) / 2, corrected


def few_terms(damping: float, motion: Motion) -> Pair:
    """Largest error of three terms over the largest motion, up to 4R, for "10 to 15 %"."""
    given = string(damping)
    positions, times = np.linspace(0, 1, 81) ** 2, 4 * given.travel_time * (np.arange(400) + 0.5) / 400
    exact = string_response(given, motion, positions, times).values
    error = np.abs(partial_sum(given, motion, positions, times, 3) - exact).max()
    return 0.15, float(error / np.abs(exact).max())


ROOT = math.sqrt(9.81)
STRING: dict[tuple[int, str], Callable[[], Pair]] = {
    (1, "damping from which mode 1 is aperiodic, 1/s"): critical_damping,
    (2, "lowest mode that oscillates, a = 30 1/s"): lowest_oscillating_mode,
    (5, "I₀ at x/g = 0.05 s², p = 0.7, a = 0.4 1/s"): static_series,
    (6, "its derivative by p there, s"): static_slope,
    (8, "U/V, s, ramp, a = 3 1/s, x = 0.25 m, t = 1 s"): ramp_motion,
    (10, "ω of the largest motion at x = 0, a = 2 1/s"): resonance_frequency,
    (11, "A/Δ at x = 0.1 m, a = 0.5 1/s, ω = 5 rad/s"): sine_amplitude,
    (13, "U/Δ, smooth, a = 2, b = 1.6 1/s, x = 0.3 m, t = 1.2 s"): lambda: smooth_motion(2.0, 1.6, 0.3, 1.2),
    (14, "U/Δ, smooth, a = 1, b = 1.2 1/s, x = 0.05 m, t = 0.6 s"): lambda: smooth_motion(1.0, 1.2, 0.05, 0.6),
    (15, "U/Δ, step, a = 0, x = 0.25 m, t = 1.1 s"): step_motion,
    (16, "error of 3 terms, ramp, a = 0"): lambda: few_terms(0.0, Ramp(speed=1.0)),
    (16, "error of 3 terms, sine of 10 √(g/l), a = 0"): lambda: few_terms(0.0, Sine(amplitude=1.0, omega=10 * ROOT)),
    (16, "error of 3 terms, step, a = √(g/l)"): lambda: few_terms(ROOT, Step(amplitude=1.0)),
}


@pytest.mark.parametrize("key", STRING, ids=lambda key: key[1])
def test_string(key: tuple[int, str]) -> None:
    shown_on(STRING_PAGE, key, STRING[key]())


# The ship on a swell: k₁ = √(k² − n²); the printed example has a free period of 12 s and n = 0.6 k

K = math.pi / 6
SHIP = Ship(natural_frequency=K, damping=0.6 * K)
TRAIN = WaveTrain(periods=np.array([8.2, 7.7, 7.5, 8.5, 7.7]), slopes=np.ones(5))
TIMES = np.linspace(0.0, 54.6, 10921)[1:]
ALL = frozenset({"lambda", "alpha", "beta", "after"})


def wave_constants(period: float, slips: frozenset[str]) -> tuple[float, float, float]:
    """λ, α and β of a wave, some as printed."""
    omega, n, damped = 2 * math.pi / period, SHIP.damping, SHIP.damped_frequency
    amplitude = 1 / math.hypot(1 - (omega / K) ** 2, 2 * n * omega / (K if "lambda" in slips else K**2))
    rise, run = 2 * n * omega, K**2 - omega**2
    alpha = -(math.atan(rise / run) if "alpha" in slips else math.atan2(rise, run))
    rise, run = 2 * n * damped, 2 * n**2 - K**2 + omega**2
    return amplitude, alpha, math.atan(rise / run) if "beta" in slips else math.atan2(rise, run)


def paper_angle(times: np.ndarray, slips: frozenset[str]) -> np.ndarray:
    """The paper's sum of waves with three branches each; number 4 is its third branch."""
    angle = np.zeros(times.shape)
    for start, period in zip(TRAIN.starts[:-1], TRAIN.periods, strict=True):
        local, omega = times - start, 2 * math.pi / period
        amplitude, alpha, beta = wave_constants(period, slips)

        def free(decaying: np.ndarray, swinging: np.ndarray, scale: float = amplitude * omega, beta: float = beta):
            damped = SHIP.damped_frequency
            return scale / damped * np.exp(-SHIP.damping * decaying) * np.sin(damped * swinging + beta)

        within, after = (local >= 0) & (local < period), local >= period
        forced = amplitude * np.sin(omega * local + alpha) + free(local, local)
        since = local - period
        second = free(local + period, local) if "after" in slips else free(since, since)
        angle += np.where(within, forced, 0.0) + np.where(after, free(local, local) - second, 0.0)
    return angle


def angle_at(ship: Ship, time: float) -> float:
    return float(roll_response(ship, TRAIN, time).angle)


def largest_error(*slips: str) -> Pair:
    return float(np.abs(paper_angle(TIMES, frozenset(slips)) - roll_response(SHIP, TRAIN, TIMES).angle).max()), 0.0


def of_constant(number: int, period: float) -> Pair:
    return wave_constants(period, ALL)[number], wave_constants(period, frozenset())[number]


def of_two_dampings() -> Pair:
    one, other = (
        roll_response(Ship(natural_frequency=K, damping=factor * K), TRAIN, TIMES).angle for factor in (0.6, 0.96)
    )
    return 0.0, float(np.abs(one - other).max())


ROLL: dict[tuple[int, str], Callable[[], Pair]] = {
    (1, "λ of the first wave"): lambda: of_constant(0, 8.2),
    (1, "largest error by this alone"): lambda: largest_error("lambda"),
    (2, "α of the first wave"): lambda: of_constant(1, 8.2),
    (2, "largest error by this alone"): lambda: largest_error("alpha"),
    (3, "β of a wave of 30 s"): lambda: of_constant(2, 30.0),
    (4, "largest error by this alone"): lambda: largest_error("after"),
    (4, "largest error by all of them"): lambda: largest_error(*ALL),
    **{
        (4, f"φ at {time} s"): lambda time=time: (float(paper_angle(np.array([time]), ALL)[0]), angle_at(SHIP, time))
        for time in (5, 10, 20)
    },
    (6, "φ at 20 s, n = k"): lambda: (math.nan, angle_at(Ship(natural_frequency=K, damping=K), 20.0)),
    (8, "largest difference between n = 0.6 k and 0.96 k"): of_two_dampings,
}


@pytest.mark.parametrize("key", ROLL, ids=lambda key: f"{key[0]} {key[1]}")
def test_ship(key: tuple[int, str]) -> None:
    shown_on(ROLL_PAGE, key, ROLL[key]())


def test_ship_without_slips_is_the_closed_form() -> None:
    # Rounding of sums of sines of five waves.
    assert largest_error()[0] < 1e-12


def shown_on(page: str, key: tuple[int, str], pair: Pair) -> None:
    """The row of the page has both numbers; an erratum that changes nothing would be none."""
    printed, corrected = pair
    assert f"| {key[0]} | {key[1]} | {printed:.5g} | {corrected:.5g} |" in page
    assert math.isnan(printed) or abs(printed - corrected) > 1e-3 * abs(corrected)
