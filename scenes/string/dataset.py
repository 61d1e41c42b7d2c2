"""The motion of a hanging string as labelled arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from hydroelastic.output.dataset import labelled
from hydroelastic.output.summary_variables import SummaryNames
from hydroelastic.scenes.string.results import StringResult

if TYPE_CHECKING:
    import xarray

STRING_NAMES = SummaryNames(
    dimensions={"modes": ("mode",), "steady.amplitude": ("position",)},
    prefixes={"modes": "mode"},
    units={"response.absolute_error": "m", "response.beside_fronts.absolute_error": "m"},
    reported_by_arrays=frozenset({"modes.omega", "steady.positions"}),
)


def string_dataset(result: StringResult) -> xarray.Dataset:
    """Return displacement, its error, and the free motions, SI units."""
    solution, motions = result.solution, result.solution.free_motions
    numbers, where = np.arange(1, len(motions.roots) + 1, dtype=np.int32), ("position", "time")
    shape = "shape of a free motion, its largest value 1"
    return labelled(
        {
            "displacement": (where, solution.displacement, "m", "displacement to the side"),
            "absolute_error": (where, solution.absolute_error, "m", "estimated error of the displacement"),
            "beside_front": (where, solution.beside_fronts, None, "whether a wave front is near"),
            "omega": ("mode", motions.frequencies, "rad/s", "magnitude of the root of a free motion"),
            "root": ("mode", motions.roots, "1/s", "root p of a free motion exp(pt)"),
            "mode_shape": (("mode", "position"), motions.shapes, "1", shape),
        },
        {
            "position": ("position", solution.positions, "m", "height above the free end at rest"),
            "time": ("time", solution.times, "s", "time"),
            "mode": ("mode", numbers, None, "number of the mode"),
        },
    )
