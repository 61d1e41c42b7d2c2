"""The motion of a rolling ship over time, as a PNG file."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hydroelastic.scenes.curve_style import COLOURS, dress, figure_file
from hydroelastic.scenes.roll_solve import RollSolution

_SHADE = "#bbbbbb"
_LEVEL = "#555555"
# Beyond this many waves their limits would cover the curve.
_MOST_LIMITS = 60


def draw_roll(solution: RollSolution, folder: Path) -> None:
    """Draw ``roll.png`` into an existing folder: angle and wave slope, and the rate, over time."""
    motion, statistics = solution.motion, solution.statistics
    with figure_file(solution.scene.title, folder / "roll.png", width=11.0, height=7.0) as figure:
        upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(2, 1))
        slope = np.degrees(solution.train.slope(motion.times))
        upper.fill_between(motion.times, slope, color=_SHADE, alpha=0.6, linewidth=0.0, label="slope of the waves")
        upper.plot(motion.times, np.degrees(motion.angle), color=COLOURS[0], linewidth=1.4, label="angle of roll φ")
        largest = float(np.degrees(statistics.largest_angle))
        upper.plot(
            [statistics.largest_time],
            [largest],
            "o",
            color=COLOURS[1],
            markersize=6,
            label=f"largest: {largest:.4g}° at {statistics.largest_time:.4g} s",
        )
        for place, level in enumerate(np.degrees(solution.scene.output.levels)):
            for side in (level, -level):
                label = "levels of exceedance" if place == 0 and side > 0 else None
                upper.axhline(side, color=_LEVEL, linewidth=0.7, linestyle="--", label=label)
        lower.plot(motion.times, np.degrees(motion.rate), color=COLOURS[2], linewidth=1.2)
        starts = solution.train.starts
        for axes in (upper, lower):
            axes.axhline(0.0, color="black", linewidth=0.6)
            axes.set_xlim(motion.times[0], motion.times[-1])
            for start in starts if len(starts) <= _MOST_LIMITS else ():
                axes.axvline(start, color=_SHADE, linewidth=0.6)
        dress(upper, "", "degrees", legend=False)
        upper.legend(frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=4)
        dress(lower, "t, s", "rate φ', degrees/s", legend=False)
