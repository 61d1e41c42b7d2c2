"""The paper on a ship on a swell: printed formulas beside corrected ones, slip by slip, and the list of errata."""

from __future__ import annotations

import enum
import math
from collections.abc import Collection

import numpy as np
import numpy.typing as npt

from hydroelastic.modal.beam.paper_model import Erratum, PrintedAndCorrected
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.ship import Ship
from hydroelastic.physics.wave import WaveTrain

ROLL_SOURCE = 'I. A. Bobrova, "Operational method for problems of physics on oscillatory processes" (in Russian)'


class RollSlip(enum.Enum):
    """One printed formula that is wrong."""

    LAMBDA = "(2nω/k)² in the amplitude"
    ALPHA = "principal arctan in the phase of the wave"
    BETA = "principal arctan in the phase of the free motion"
    THIRD_BRANCH_ARGUMENT = "sin(k₁(t − t_{i−1}) + β) twice after the wave"
    THIRD_BRANCH_DECAY = "e^{−nT} for e^{+nT} after the wave"


ALL_ROLL_SLIPS = frozenset(RollSlip)
"""The motion as printed."""

PRINTED_ROLL = Ship(natural_frequency=math.pi / 6, damping=0.6 * math.pi / 6)
"""The ship of the printed example, free period 12 s, with the first of its dampings, 0.6 k; the other one is 0.96 k."""

PRINTED_TRAIN = WaveTrain(periods=np.array([8.2, 7.7, 7.5, 8.5, 7.7]), slopes=np.ones(5))
"""The waves of the printed example, for a unit slope."""


def printed_roll_constants(ship: Ship, period: float) -> dict[str, PrintedAndCorrected]:
    """Return the constants of one wave, φ = aλ[sin(ωτ + α) + (ω/k₁) e^{−nτ} sin(k₁τ + β)], as printed and corrected.

    With k₁ = √(k² − n²), dimensionless:

        lambda   λ = [(1 − ω²/k²)² + (2nω/k)²]^{−1/2},  … (2nω/k²)² …
        alpha    α = −arctan(2nω/(k² − ω²)),            −atan2(2nω, k² − ω²) in [−π, 0]
        beta     β = arctan(2nk₁/(2n² − k² + ω²)),      atan2(2nk₁, 2n² − k² + ω²) in [0, π]

    Args:
        ship: the ship.
        period: T of the wave, s.

    Raises:
        ValueError: if the damping is critical or more, for which the paper has no formula, or the period is not
            finite and positive, or the period is the free one and n = 0.
    """
    _check_paper_treats(ship)
    if not 0 < period < math.inf:
        raise ValueError(f"period is {period}; it must be finite and positive")
    printed, corrected = _Wave(ship, period, ALL_ROLL_SLIPS), _Wave(ship, period, ())
    return {
        "lambda": PrintedAndCorrected(printed=printed.amplitude, corrected=corrected.amplitude),
        "alpha": PrintedAndCorrected(printed=printed.alpha, corrected=corrected.alpha),
        "beta": PrintedAndCorrected(printed=printed.beta, corrected=corrected.beta),
    }


def paper_roll_angle(
    ship: Ship, train: WaveTrain, times: npt.ArrayLike, slips: Collection[RollSlip] = ALL_ROLL_SLIPS
) -> FloatArray:
    """Return φ of the paper's sum over waves, each with three branches, with some of the printed slips.

    Before wave i it contributes nothing, within it what `printed_roll_constants` says, and after it, corrected,

        aλ(ω/k₁) [e^{−n(t − t_{i−1})} sin(k₁(t − t_{i−1}) + β) − e^{−n(t − t_i)} sin(k₁(t − t_i) + β)].

    Printed is aλ(ω/k₁) e^{−n(t − t_{i−1})} [sin(k₁(t − t_{i−1}) + β) − e^{−nT} sin(k₁(t − t_{i−1}) + β)].

    Args:
        ship: the ship.
        train: the waves.
        times: t, s, of any shape.
        slips: which formulas are taken as printed. Without any the sum is `roll_response`.

    Returns:
        φ, rad, in the shape of the times.

    Raises:
        ValueError: if the damping is critical or more, or 0 in resonance, for which the paper has no formula.
    """
    _check_paper_treats(ship)
    times = np.asarray(times, float)
    angle = np.zeros(times.shape)
    for number, slope in enumerate(train.slopes):
        start, end = train.starts[number : number + 2]
        wave = _Wave(ship, float(train.periods[number]), slips)
        within, after = (times >= start) & (times < end), times >= end
        angle[within] += slope * wave.within(times[within] - start)
        angle[after] += slope * wave.after(times[after] - start)
    return angle


class _Wave:
    """A wave of unit slope: the constants of its motion, and its branches within and after the wave."""

    def __init__(self, ship: Ship, period: float, slips: Collection[RollSlip]) -> None:
        self.ship, self.period, self.slips = ship, period, slips
        self.omega = omega = 2 * math.pi / period
        k, n, own = ship.natural_frequency, ship.damping, ship.damped_frequency
        damping = 2 * n * omega / (k if RollSlip.LAMBDA in slips else k**2)
        stiffness = 1 - (omega / k) ** 2
        if not (stiffness or damping):
            raise ValueError(
                f"a wave of {period} s meets the undamped ship in resonance, for which the paper has no formula"
            )
        self.amplitude = 1 / math.hypot(stiffness, damping)
        self.alpha = -_phase(2 * n * omega, (k - omega) * (k + omega), RollSlip.ALPHA in slips)
        self.beta = _phase(2 * n * own, 2 * n**2 - k**2 + omega**2, RollSlip.BETA in slips)

    def within(self, local: FloatArray) -> FloatArray:
        return self.amplitude * np.sin(self.omega * local + self.alpha) + self._free(local, local)

    def after(self, local: FloatArray) -> FloatArray:
        since = local - self.period
        decaying = local + self.period if RollSlip.THIRD_BRANCH_DECAY in self.slips else since
        swinging = local if RollSlip.THIRD_BRANCH_ARGUMENT in self.slips else since
        return self._free(local, local) - self._free(decaying, swinging)

    def _free(self, decaying: FloatArray, swinging: FloatArray) -> FloatArray:
        own = self.ship.damped_frequency
        motion = np.exp(-self.ship.damping * decaying) * np.sin(own * swinging + self.beta)
        return np.asarray(self.amplitude * self.omega / own * motion)


def _phase(rise: float, run: float, principal: bool) -> float:
    return math.atan(rise / run) if principal and run else math.atan2(rise, run)


def _check_paper_treats(ship: Ship) -> None:
    if ship.damping >= ship.natural_frequency:
        raise ValueError(
            f"damping is {ship.damping}; the paper treats only less than the natural_frequency, "
            f"{ship.natural_frequency}"
        )


ROLL_ERRATA: tuple[Erratum, ...] = (
    Erratum(
        number=1,
        printed="λ_i: (2nω_i/k)² under the root",
        corrected="(2nω_i/k²)²",
        consequence="A rate is added to a number. In the example φ is wrong by up to 0.26 (n = 0.6k) and 0.29 "
        "(n = 0.96k), where the largest |φ| are 0.61 and 0.46 times the wave slope.",
    ),
    Erratum(
        number=2,
        printed="tan α_i = −2nω_i/(k² − ω_i²), read as a principal arctan",
        corrected="α_i = −atan2(2nω_i, k² − ω_i²), from −π to 0",
        consequence="α_i is wrong by π for all waves shorter than the free period, as all of the example are: φ is "
        "wrong by up to 1.02 and 0.69, and does not begin with 0.",
    ),
    Erratum(
        number=3,
        printed="tan β_i = 2nk₁/(2n² − k² + ω_i²), read as a principal arctan",
        corrected="β_i = atan2(2nk₁, 2n² − k² + ω_i²), from 0 to π",
        consequence="None in the example; β_i is wrong by π for long waves, ω_i² < k² − 2n².",
    ),
    Erratum(
        number=4,
        printed="after the wave, twice: e^{−n(t − t_{i−1})} [sin(k₁(t − t_{i−1}) + β_i) − e^{−nT_i} "
        "sin(k₁(t − t_{i−1}) + β_i)]",
        corrected="e^{−n(t − t_{i−1})} sin(k₁(t − t_{i−1}) + β_i) − e^{−n(t − t_i)} sin(k₁(t − t_i) + β_i)",
        consequence="Argument and decay of the second term are those of the beginning of the wave: φ is wrong by up to "
        "0.50 and 0.37, and jumps by 0.4 at the end of the first wave, where φ, φ' and φ'' are continuous. With "
        "numbers 1 and 2 it is wrong by up to 1.88 and 1.50.",
    ),
    Erratum(
        number=5,
        printed="the image of one wave, for a_i e^{−pt_{i−1}}(1 − e^{−pT_i}) …",
        corrected="only for pω/((p² + ω²)(p² + 2np + k²))",
        consequence="None: the shifts in time are made afterwards.",
    ),
    Erratum(
        number=6,
        printed="n → k is a resonance, with another solution; the curve falls onto the axis",
        corrected="n = k is critical damping; φ is regular there",
        consequence="φ(20 s) of the example is 0.2745 for n = (1 − 10⁻⁶)k, k and (1 + 10⁻⁶)k. Resonance is ω_i = k "
        "with n = 0.",
    ),
    Erratum(
        number=7,
        printed="n > k is not treated",
        corrected="(e^{p₁t} − e^{p₂t})/(p₁ − p₂) in place of e^{−nt} sin(k₁t)/k₁",
        consequence="Heavily damped ships have no formula.",
    ),
    Erratum(
        number=8,
        printed="the curves for n = 0.6k and 0.96k mostly coincide",
        corrected="they differ by up to 0.225, 37 % of the largest angle",
        consequence="They lie within 5 % of it of one another during a fifth of the time only.",
    ),
)
