"""The motion of a rolling ship as labelled arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hydroelastic.output.dataset import labelled
from hydroelastic.output.summary_variables import SummaryNames
from hydroelastic.scenes.roll.results import RollResult

if TYPE_CHECKING:
    import xarray

ROLL_NAMES = SummaryNames(
    dimensions={"response.exceedances": ("exceedance",), "section.followers": ("follower",)},
    prefixes={"response.exceedances": "exceedance"},
    units={"response.absolute_error": "rad"},
)


def roll_dataset(result: RollResult) -> xarray.Dataset:
    """Return the slope of the waves and the angle of the ship with its derivatives, SI units."""
    solution, motion = result.solution, result.solution.motion
    return labelled(
        {
            "wave_slope": ("time", solution.train.slope(motion.times), "rad", "slope of the waves"),
            "angle": ("time", motion.angle, "rad", "angle of roll"),
            "rate": ("time", motion.rate, "rad/s", "rate of roll"),
            "acceleration": ("time", motion.acceleration, "rad/s^2", "acceleration of roll"),
        },
        {"time": ("time", motion.times, "s", "time")},
    )
