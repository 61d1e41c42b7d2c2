"""The motion of a rolling ship as files: CSV, and a labelled dataset."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hydroelastic.scenes.provenance import versions
from hydroelastic.scenes.roll_solve import RollSolution

COLUMNS = ("time", "wave_slope", "angle", "rate", "acceleration")
_UNITS = ("s", "rad", "rad", "rad/s", "rad/s^2")


def write_roll_files(solution: RollSolution, folder: Path) -> None:
    """Write ``response.csv``, one row for each time, and ``dataset.nc``, into an existing folder; SI units."""
    motion = solution.motion
    slope = solution.train.slope(motion.times)
    values = (motion.times, slope, motion.angle, motion.rate, motion.acceleration)
    np.savetxt(
        folder / "response.csv",
        np.column_stack(values),
        delimiter=",",
        fmt="%.17g",
        header=",".join(COLUMNS),
        comments="",
        encoding="utf-8",
    )
    # xarray takes a while to import.
    import xarray

    dataset = xarray.Dataset(
        {
            name: ("time", value, {"units": unit})
            for name, value, unit in zip(COLUMNS[1:], values[1:], _UNITS[1:], strict=True)
        },
        {"time": ("time", motion.times, {"units": _UNITS[0]})},
        {
            "title": solution.scene.title,
            "natural_frequency": solution.roll.natural_frequency,
            "damping": solution.roll.damping,
            "angle_absolute_error": solution.angle_error,
            "hydroelastic_version": versions()["hydroelastic"],
            "status": "unconverged" if solution.reasons else "ok",
        },
    )
    dataset.to_netcdf(folder / "dataset.nc")
