"""Motion, extremes and errors of a rolling ship together, from a ship, waves and times alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from roll_trains import TRAIN, K

from hydroelastic.modal.roll.motion import roll_response
from hydroelastic.modal.roll.quadratic import RollIntegrationError
from hydroelastic.modal.roll.solution import roll_solution
from hydroelastic.physics.ship import Ship

SHIP = Ship(natural_frequency=K, damping=0.05 * K)
TIMES = np.linspace(0.0, 60.0, 121)


def test_without_quadratic_damping_it_is_the_closed_form() -> None:
    solution = roll_solution(SHIP, TRAIN, TIMES, angle=0.05)
    assert solution.motion.angle.tolist() == roll_response(SHIP, TRAIN, TIMES, 0.05).angle.tolist()
    assert abs(solution.statistics.largest_angle) >= np.abs(solution.motion.angle).max()
    assert 0.0 < solution.relative_error < 1e-13


def test_the_error_of_an_integration_is_that_to_a_tighter_one() -> None:
    ship = replace(SHIP, quadratic_damping=0.8)
    solution, exact = (roll_solution(ship, TRAIN, TIMES, tolerance=tolerance) for tolerance in (1e-5, 1e-11))
    error = float(np.abs(solution.motion.angle - exact.motion.angle).max())
    # Never below a third of the true error; the estimate is that of a motion of ten times the tolerance.
    assert error <= 3.0 * solution.angle_error
    assert solution.relative_error <= 1e-5


@pytest.mark.parametrize("change", [1e-6, 1e-4])
def test_errors_of_the_ship_bound_their_effect(change: float) -> None:
    solution = roll_solution(SHIP, TRAIN, TIMES, relative_ship_error=change)
    for sign, other in ((1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)):
        off = Ship(natural_frequency=K * (1.0 + sign * change), damping=SHIP.damping + other * change * K)
        difference = np.abs(roll_response(off, TRAIN, TIMES).angle - solution.motion.angle).max()
        # To first order the sum of both effects; second order is the change times the periods followed, 5 · 2π.
        assert difference <= solution.ship_error * (1.0 + 40.0 * change)
    # Not thirty times too large.
    assert difference > solution.ship_error / 30.0


def test_an_integration_that_cannot_be_that_close_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    from hydroelastic.modal.roll import quadratic

    # Coarse steps, and no refinement of them is allowed.
    monkeypatch.setattr(quadratic, "_FIRST_STEPS", 1e9)
    monkeypatch.setattr(quadratic, "_LEAST_STEPS", 1.0)
    with pytest.raises(RollIntegrationError, match="no better than"):
        roll_solution(replace(SHIP, quadratic_damping=0.8), TRAIN, TIMES, tolerance=1e-11)
