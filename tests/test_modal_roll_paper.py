"""The printed formulas of the paper on a ship on a swell fail as the errata say, and the corrected ones do not."""

from __future__ import annotations

import math

import numpy as np
import pytest
from roll_trains import SHIPS, TRAIN, K, reference_ship

from hydroelastic.modal.roll.motion import roll_response
from hydroelastic.modal.roll.paper import (
    ALL_ROLL_SLIPS,
    PRINTED_ROLL,
    PRINTED_TRAIN,
    ROLL_ERRATA,
    RollSlip,
    paper_roll_angle,
    printed_roll_constants,
)
from hydroelastic.physics.ship import Ship

LIGHT, HEAVY = PRINTED_ROLL, Ship(natural_frequency=K, damping=0.96 * K)
TIMES = np.linspace(0, 54.6, 20_001)[1:]
THIRD = {RollSlip.THIRD_BRANCH_ARGUMENT, RollSlip.THIRD_BRANCH_DECAY}


def greatest_error(roll: Ship, slips: set[RollSlip] | frozenset[RollSlip]) -> float:
    exact = roll_response(roll, PRINTED_TRAIN, TIMES).angle
    return float(np.abs(paper_roll_angle(roll, PRINTED_TRAIN, TIMES, slips) - exact).max())


def test_errata_are_numbered_and_complete() -> None:
    assert [erratum.number for erratum in ROLL_ERRATA] == list(range(1, 9))
    for erratum in ROLL_ERRATA:
        assert erratum.printed
        assert erratum.corrected
        assert erratum.consequence


@pytest.mark.parametrize(
    "roll",
    [
        LIGHT,
        HEAVY,
        Ship(natural_frequency=K, damping=1e-3),
        Ship(natural_frequency=K, damping=K * (1 - 1e-9)),
        Ship(natural_frequency=0.9, damping=0.05),
    ],
)
def test_without_slips_it_is_the_closed_form(roll: Ship) -> None:
    # Large λ of light damping, and phases: measured 2e-13 with n = 0.002k.
    assert paper_roll_angle(roll, TRAIN, TIMES, ()) == pytest.approx(roll_response(roll, TRAIN, TIMES).angle, abs=1e-12)


@pytest.mark.parametrize(
    ("slips", "light", "heavy"),
    [
        ({RollSlip.LAMBDA}, 0.2616, 0.2920),
        ({RollSlip.ALPHA}, 1.0185, 0.6928),
        (THIRD, 0.5015, 0.3682),
        ({RollSlip.THIRD_BRANCH_DECAY}, 0.4952, 0.3684),
        (ALL_ROLL_SLIPS, 1.8826, 1.4954),
    ],
)
def test_what_each_slip_costs(slips: set[RollSlip], light: float, heavy: float) -> None:
    assert greatest_error(LIGHT, slips) == pytest.approx(light, abs=1e-4)
    assert greatest_error(HEAVY, slips) == pytest.approx(heavy, abs=1e-4)


def test_errata_name_what_each_slip_costs() -> None:
    for number, slips in ((1, {RollSlip.LAMBDA}), (2, {RollSlip.ALPHA}), (4, THIRD), (4, ALL_ROLL_SLIPS)):
        text = ROLL_ERRATA[number - 1].consequence
        for roll in (LIGHT, HEAVY):
            assert f"{greatest_error(roll, slips):.2f}" in text


def test_motion_as_printed() -> None:
    assert paper_roll_angle(LIGHT, PRINTED_TRAIN, [5, 10, 20]) == pytest.approx([-0.5376, 0.9349, -0.2633], abs=5e-5)
    assert paper_roll_angle(HEAVY, PRINTED_TRAIN, [5, 10, 20]) == pytest.approx([-0.3328, 0.7032, -0.2097], abs=5e-5)
    for name in ("ship-0.96", "ship-wave2"):
        roll, train, when = reference_ship(name)
        assert float(paper_roll_angle(roll, train, when)) == pytest.approx(float(SHIPS[name]["as_printed"]), abs=5e-9)


def test_jumps_where_waves_meet() -> None:
    starts, gap = PRINTED_TRAIN.starts[:-1], 1e-9
    for slips, expected in (
        (ALL_ROLL_SLIPS, [1.144, 0.351, 0.382, 0.881, 0.275]),
        (THIRD, [0.0, 0.404, 0.341, 0.317, 0.443]),
        (set(), [0.0] * 5),
    ):
        jumps = [paper_roll_angle(LIGHT, PRINTED_TRAIN, starts + side * gap, slips) for side in (-1, 1)]
        assert jumps[1] - jumps[0] == pytest.approx(expected, abs=6e-4)
        # At the meeting itself the later branch alone holds.
        assert paper_roll_angle(LIGHT, PRINTED_TRAIN, starts, slips) == pytest.approx(jumps[1], abs=1e-8)


def test_constants() -> None:
    for roll, amplitudes, alpha, beta in (
        (LIGHT, (0.68220, 0.47743), (0.99437, -2.14722), 0.476),
        (HEAVY, (0.53701, 0.3297), (1.18488, -1.957), 0.178),
    ):
        constants = printed_roll_constants(roll, 8.2)
        assert constants["lambda"].printed == pytest.approx(amplitudes[0], abs=5e-5)
        assert constants["lambda"].corrected == pytest.approx(amplitudes[1], abs=5e-5)
        assert constants["alpha"].printed == pytest.approx(alpha[0], abs=5e-4)
        assert constants["alpha"].corrected == pytest.approx(alpha[1], abs=5e-4)
        assert constants["beta"].printed == constants["beta"].corrected == pytest.approx(beta, abs=5e-4)
    # λ has no unit: the same ship with times in minutes.
    seconds, minutes = (
        printed_roll_constants(LIGHT, 8.2),
        printed_roll_constants(Ship(natural_frequency=60 * K, damping=36 * K), 8.2 / 60),
    )
    assert minutes["lambda"].corrected == pytest.approx(seconds["lambda"].corrected, rel=1e-14)
    assert abs(minutes["lambda"].printed / seconds["lambda"].printed - 1) > 0.5
    # Long waves turn β.
    long = printed_roll_constants(LIGHT, 40.0)["beta"]
    assert long.corrected - long.printed == pytest.approx(math.pi, rel=1e-14)
    assert greatest_error(LIGHT, {RollSlip.BETA}) < 1e-12


def test_both_dampings_give_different_curves() -> None:
    light, heavy = (roll_response(roll, PRINTED_TRAIN, TIMES).angle for roll in (LIGHT, HEAVY))
    apart, largest = np.abs(light - heavy), np.abs(light).max()
    assert apart.max() == pytest.approx(0.2249, abs=1e-4)
    assert apart.max() / largest == pytest.approx(0.37, abs=0.005)
    assert np.mean(apart < 0.05 * largest) == pytest.approx(0.2, abs=0.03)


def test_paper_treats_oscillating_ships_only() -> None:
    for roll in (Ship(natural_frequency=K, damping=K), Ship(natural_frequency=K, damping=2 * K)):
        with pytest.raises(ValueError, match="the paper treats only less"):
            paper_roll_angle(roll, TRAIN, 1.0)
        with pytest.raises(ValueError, match="the paper treats only less"):
            printed_roll_constants(roll, 8.0)
    with pytest.raises(ValueError, match=r"period is 0\.0"):
        printed_roll_constants(LIGHT, 0.0)
    with pytest.raises(ValueError, match="resonance"):
        printed_roll_constants(Ship(natural_frequency=2 * math.pi), 1.0)
