"""Run the scene of a rolling ship: solve, tabulate, write and draw."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from pydantic import ValidationError

from hydroelastic.fem.progress import Report
from hydroelastic.modal.roll.quadratic import RollIntegrationError
from hydroelastic.modal.roll.solution import roll_solution
from hydroelastic.output.csv_files import write_csv
from hydroelastic.output.plots import BLUE, GREEN, GREY, OF_CURVES, VERMILLION, PictureOptions, Sheets, label_axes
from hydroelastic.output.roll.quantities import ROLL
from hydroelastic.output.roll.tables import roll_cost, roll_sections
from hydroelastic.output.variables import array_variables
from hydroelastic.scenes.errors import UnsolvedError
from hydroelastic.scenes.models.problems import require_fit
from hydroelastic.scenes.models.roll import RollScene, motion_can_be_followed, rates_are_comparable
from hydroelastic.scenes.roll.physics import RollResult, rolling_ship, wave_train
from hydroelastic.scenes.roll.section_file import solved_section
from hydroelastic.scenes.staged_run import StagedRun
from hydroelastic.scenes.validation_errors import scene_error

if TYPE_CHECKING:
    from mpi4py import MPI

_WAVES = "#999999"


def _write(result: RollResult, folder: Path) -> None:
    """Write ``response.csv``, one row for each time; SI units."""
    write_csv(folder / "response.csv", {array.name: array.values for array in array_variables(ROLL, result)})


def solve_roll(scene: RollScene, comm: MPI.Comm, report: Report = lambda _message: None) -> RollResult:
    """Solve for the motion of the ship (collective if there is a section)."""
    section = solved_section(scene, comm, report) if scene.roll.section is not None else None
    ship = rolling_ship(scene, section)
    if section is not None:
        _check_with(scene, ship.natural_frequency)
    report("roll")
    try:
        solution = roll_solution(
            ship,
            wave_train(scene),
            np.array(scene.times(ship.natural_frequency)),
            angle=scene.roll.angle,
            rate=scene.roll.rate,
            tolerance=scene.accuracy.tolerance,
            relative_ship_error=None if section is None else section.relative_error,
        )
    except RollIntegrationError as error:
        raise UnsolvedError(f"the motion with quadratic damping was not found: {error}") from error
    return RollResult(scene=scene, solution=solution, section=section)


def _check_with(scene: RollScene, natural_frequency: float) -> None:
    """Check the requests of the scene, now that k is known."""
    ship = scene.roll.model_copy(update={"section": None, "natural_frequency": natural_frequency})
    known = scene.model_copy(update={"roll": ship})
    try:
        require_fit(known, [(rates_are_comparable, motion_can_be_followed)])
    except ValidationError as error:
        raise scene_error(error, RollScene) from error


def draw_roll(result: RollResult, folder: Path, options: PictureOptions) -> None:
    """Draw ``roll.png`` into an existing folder: slope of the waves, angle and rate over time."""
    solution = result.solution
    motion, statistics = solution.motion, solution.statistics
    sheets = Sheets(folder=folder, title=result.scene.title, options=options)
    with sheets.sheet("roll", "roll", width=11.0, height=8.0) as figure:
        waves, upper, lower = figure.subplots(3, 1, sharex=True, height_ratios=(1, 2, 1))
        slope = np.degrees(solution.train.slope(motion.times))
        waves.fill_between(motion.times, slope, color=_WAVES, linewidth=0.0)
        upper.plot(motion.times, np.degrees(motion.angle), color=BLUE, label="angle of roll φ")
        largest = float(np.degrees(statistics.largest_angle))
        label = f"largest: {largest:.4g}° at {statistics.largest_time:.4g} s".replace("-", "−")
        upper.plot([statistics.largest_time], [largest], "o", color=VERMILLION, markersize=6, label=label)
        for place, level in enumerate(np.degrees(result.scene.output.levels)):
            for side in (level, -level):
                name = "levels whose exceedances are counted" if place == 0 and side > 0 else None
                upper.axhline(side, color=GREY, linewidth=0.8, linestyle="--", label=name)
        lower.plot(motion.times, np.degrees(motion.rate), color=GREEN, linewidth=1.3)
        for axes in (waves, upper, lower):
            axes.axhline(0.0, color="black", linewidth=0.6)
        lower.set_xlim(motion.times[0], motion.times[-1])
        label_axes(waves, "", "slope of the waves,\ndegrees", legend="")
        label_axes(upper, "", "angle of roll φ, degrees", legend="")
        upper.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
        figure.align_ylabels()
        label_axes(lower, "time t, s", "rate φ',\ndegrees/s", legend="")


run_roll = StagedRun(
    solve=solve_roll,
    kind=ROLL,
    write=_write,
    draw=lambda result, folder, options, _report: draw_roll(result, folder, options),
    used_options=OF_CURVES,
    sections=lambda _solution, summary: roll_sections(summary),
    cost=roll_cost,
)
