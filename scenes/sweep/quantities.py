"""The quantities of a sweep: every number, word and truth value of the summaries of its points, as labelled variables.

This is the only place where a sweep asks what results there are.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from hydroelastic.scenes.output.provenance import Summary
from hydroelastic.scenes.output.summary_variables import SummaryNames, summary_variables

if TYPE_CHECKING:
    import xarray

POINT = "point"
"""The dimension along which the points lie."""

# They tell of a single run, or stand elsewhere in the results of a sweep.
_LEFT_OUT = frozenset(("scene", "status", "reasons", "timing", "memory_peak", "versions"))


def quantities(summaries: Sequence[Summary | None], names: SummaryNames) -> xarray.Dataset:
    """Return the values of all summaries, each variable with the dimension `POINT` first.

    Args:
        summaries: content of ``summary.json`` of each point; ``None`` where it failed, which gives NaN and "".
        names: of the tables of a summary.
    """

    def moved(places: Any) -> dict[str, Any]:
        return {f"{POINT}.{place}": value for place, value in places.items()}

    told = [{key: value for key, value in (one or {}).items() if key not in _LEFT_OUT} for one in summaries]
    return summary_variables(
        {POINT: told},
        SummaryNames(
            dimensions={POINT: (POINT,)} | moved(names.dimensions),
            prefixes={POINT: ""} | moved(names.prefixes),
            units=moved(names.units),
            reported_by_arrays=frozenset(f"{POINT}.{place}" for place in names.reported_by_arrays),
        ),
    )


def columns(dataset: xarray.Dataset, most: int = 100) -> dict[str, np.ndarray]:
    """Return the variables as columns of a table, one entry for each point, by name.

    Entries along a further dimension are numbered from 1: ``omega_3`` is that of the third mode.

    Args:
        dataset: from `quantities`.
        most: entries of a variable; one with more stays in the dataset only.
    """
    found = {}
    for name, values in dataset.data_vars.items():
        table = values.values.reshape(len(values), -1)
        if table.shape[1] <= most:
            for place, column in zip(np.ndindex(values.shape[1:]), table.T, strict=True):
                numbers = [index + 1 for index, size in zip(place, values.shape[1:], strict=True) if size > 1]
                found["_".join(map(str, (name, *numbers)))] = column
    return found
