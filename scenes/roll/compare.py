"""The roll of a ship compared with the paper's formulas, as printed and for each erratum."""

from __future__ import annotations

import numpy as np

from hydroelastic.modal.roll.paper import ALL_ROLL_SLIPS, ROLL_SOURCE, RollSlip, paper_roll_angle
from hydroelastic.output.sections import Section
from hydroelastic.scenes.roll.results import RollResult

# Of the largest angle: rounding of the paper's corrected sums of sines.
_ROUNDING = 1e-11


def untreated_by_paper(result: RollResult) -> str:
    """Return why the paper's formulas do not apply to a motion; empty if they do."""
    ship, train, given = result.solution.ship, result.solution.train, result.scene.roll
    if ship.quadratic_damping:
        return "damping is quadratic"
    if ship.damping >= ship.natural_frequency:
        return "damping is critical or more"
    if given.angle or given.rate:
        return "the ship is not at rest when the first wave begins"
    if not len(train.periods):
        return "there are no waves"
    if ship.damping == 0.0 and (train.frequencies == ship.natural_frequency).any():
        return "a wave meets the undamped ship in resonance"
    return ""


def paper_section(result: RollResult) -> Section:
    """Return the error by each erratum of the paper, and by all of them together.

    Args:
        result: of a motion to which the paper's formulas apply.
    """
    solution = result.solution
    exact, times = solution.motion.angle, solution.motion.times
    largest = float(np.abs(exact).max())
    printed = [("all formulas as printed", ALL_ROLL_SLIPS), *((slip.value, {slip}) for slip in RollSlip)]
    rows = []
    for name, slips in (*printed, ("all of them corrected", frozenset[RollSlip]())):
        angle = paper_roll_angle(solution.ship, solution.train, times, slips)
        difference = float(np.abs(angle - exact).max())
        small = difference <= _ROUNDING * largest
        rows.append(
            (name, *(("rounding",) * 2 if small else (f"{difference:.3g}", f"{100.0 * difference / largest:.3g} %")))
        )
    return Section(
        title="The paper's formulas beside the closed form",
        headings=("as printed", "largest difference of the angle, rad", "of the largest angle"),
        rows=rows,
        lines=(f"The paper: {ROLL_SOURCE}. What is corrected, and why: docs, errata of the string and the ship.",),
    )
