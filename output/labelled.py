"""Labelled arrays whose quantities are not declared yet, as datasets of xarray."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from hydroelastic.output.variables import Variable

if TYPE_CHECKING:
    import xarray

Labelled: TypeAlias = tuple[Any, Any, str | None, str] | tuple[Any, Any, str | None, str, float | None]
"""Dimensions of an array, its values, their unit, if they have one, what they are, and their absolute error."""


def labelled(
    arrays: Mapping[str, Labelled], coordinates: Mapping[str, Labelled], labels: Mapping[str, Sequence[str]] = {}
) -> xarray.Dataset:
    """Return labelled arrays, by name.

    Args:
        arrays: variables.
        coordinates: places along their dimensions.
        labels: of dimensions that have names instead of places.
    """
    # xarray takes a while to import.
    import xarray

    def variable(dimensions: Any, values: Any, unit: str | None, said: str, error: float | None = None) -> Any:
        attributes = {"units": unit, "long_name": said, "absolute_error": error}
        return dimensions, values, {name: value for name, value in attributes.items() if value is not None}

    places = {name: variable(*one) for name, one in coordinates.items()} | {name: list(labels[name]) for name in labels}
    return xarray.Dataset({name: variable(*one) for name, one in arrays.items()}, places)


def variables_of(dataset: xarray.Dataset) -> list[Variable]:
    """Return the arrays of a dataset."""
    return [
        Variable(
            name=str(name),
            dimensions=tuple(map(str, one.dims)),
            values=np.asarray(one.values),
            attributes=one.attrs,
            is_coordinate=name in dataset.coords and one.dims != (name,),
        )
        for name, one in dataset.variables.items()
    ]
