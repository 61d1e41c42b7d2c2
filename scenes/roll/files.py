"""The motion of a rolling ship as a CSV file."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hydroelastic.scenes.roll.results import RollResult

COLUMNS = ("time", "wave_slope", "angle", "rate", "acceleration")


def write_roll_files(result: RollResult, folder: Path) -> None:
    """Write ``response.csv``, one row for each time, into an existing folder; SI units."""
    solution, motion = result.solution, result.solution.motion
    values = (motion.times, solution.train.slope(motion.times), motion.angle, motion.rate, motion.acceleration)
    np.savetxt(
        folder / "response.csv",
        np.column_stack(values),
        delimiter=",",
        fmt="%.17g",
        header=",".join(COLUMNS),
        comments="",
        encoding="utf-8",
    )
