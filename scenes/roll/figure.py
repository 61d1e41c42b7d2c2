"""The motion of a rolling ship over time, as a picture."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hydroelastic.output.plots import BLUE, GREEN, GREY, VERMILLION, PictureOptions, Sheets, label_axes
from hydroelastic.scenes.roll.results import RollResult

_WAVES = "#999999"


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
