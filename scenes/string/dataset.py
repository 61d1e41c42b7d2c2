"""The motion of a hanging string as labelled arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from hydroelastic.scenes.output.summary_variables import SummaryNames
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
    # xarray takes a while to import.
    import xarray

    solution, motions = result.solution, result.solution.free_motions
    where = ("position", "time")
    return xarray.Dataset(
        {
            "displacement": (where, solution.displacement, {"units": "m", "long_name": "displacement to the side"}),
            "absolute_error": (
                where,
                solution.absolute_error,
                {"units": "m", "long_name": "estimated error of the displacement"},
            ),
            "beside_front": (where, solution.beside_fronts, {"long_name": "whether a wave front is near"}),
            "omega": (
                "mode",
                motions.frequencies,
                {"units": "rad/s", "long_name": "magnitude of the root of a free motion"},
            ),
            "root": ("mode", motions.roots, {"units": "1/s", "long_name": "root p of a free motion exp(pt)"}),
            "mode_shape": (
                ("mode", "position"),
                motions.shapes,
                {"units": "1", "long_name": "shape of a free motion, its largest value 1"},
            ),
        },
        {
            "position": (
                "position",
                solution.positions,
                {"units": "m", "long_name": "height above the free end at rest"},
            ),
            "time": ("time", solution.times, {"units": "s", "long_name": "time"}),
            "mode": ("mode", np.arange(1, len(motions.roots) + 1, dtype=np.int32), {"long_name": "number of the mode"}),
        },
    )
