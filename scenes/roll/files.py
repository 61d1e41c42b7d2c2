"""The motion of a rolling ship as a CSV file."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hydroelastic.scenes.roll.solve import RollSolution

COLUMNS = ("time", "wave_slope", "angle", "rate", "acceleration")


def write_roll_files(solution: RollSolution, folder: Path) -> None:
    """Write ``response.csv``, one row for each time, into an existing folder; SI units."""
    motion = solution.motion
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
