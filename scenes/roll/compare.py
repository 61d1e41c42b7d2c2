"""The roll of a ship beside the paper's formulas, as printed and slip by slip."""

from __future__ import annotations

import numpy as np

from hydroelastic.modal.roll.paper import ALL_ROLL_SLIPS, ROLL_SOURCE, RollSlip, paper_roll_angle
from hydroelastic.scenes.output.sections import Section
from hydroelastic.scenes.roll.solve import RollSolution

# Of the largest angle: what the sums of sines of the paper differ by without any slip.
_ROUNDING = 1e-11


def untreated_by_paper(solution: RollSolution) -> str:
    """Return why the paper's formulas do not treat a motion; empty if they do."""
    roll, train, given = solution.roll, solution.train, solution.scene.roll
    if given.quadratic_damping:
        return "damping is quadratic"
    if roll.damping >= roll.natural_frequency:
        return "damping is critical or more"
    if given.angle or given.rate:
        return "the ship is not at rest when the first wave begins"
    if not len(train.periods):
        return "there are no waves"
    if roll.damping == 0.0 and (train.frequencies == roll.natural_frequency).any():
        return "a wave meets the undamped ship in resonance"
    return ""


def paper_section(solution: RollSolution) -> Section:
    """Return what each of the paper's slips costs, and all of them together.

    Args:
        solution: of a motion that the paper treats.
    """
    exact, times = solution.motion.angle, solution.motion.times
    largest = float(np.abs(exact).max())
    printed = [("all formulas as printed", ALL_ROLL_SLIPS), *((slip.value, {slip}) for slip in RollSlip)]
    rows = []
    for name, slips in (*printed, ("all of them corrected", frozenset[RollSlip]())):
        angle = paper_roll_angle(solution.roll, solution.train, times, slips)
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
