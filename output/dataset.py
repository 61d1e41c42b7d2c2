"""All results of a scene as one labelled dataset, `dataset.nc`: arrays of its kind and the whole summary."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from hydroelastic.output.json_values import json_ready
from hydroelastic.output.provenance import Summary
from hydroelastic.output.summary_variables import SummaryNames, summary_variables

if TYPE_CHECKING:
    import xarray

DATASET = "dataset.nc"
SUMMARY_TEXT = "summary"
"""The variable that holds the summary as the text of ``summary.json``."""

Labelled: TypeAlias = tuple[Any, Any, str | None, str] | tuple[Any, Any, str | None, str, float | None]
"""Dimensions of an array, its values, their unit, if they have one, what they are, and their absolute error."""

# Keys of summaries whose variables come last: those about the solution and its cost.
_BOOKKEEPING = ("reasons", "solver", "size", "timing", "memory_peak", "versions")


@dataclass(frozen=True, kw_only=True)
class LabelledResults:
    """The contents of the datasets of one kind of scene.

    Attributes:
        arrays: function that returns the labelled arrays of a solution, which may be complex.
        names: of the tables of the summary.
    """

    arrays: Callable[[Any], xarray.Dataset]
    names: SummaryNames


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


def with_summary(arrays: xarray.Dataset, summary: Summary, names: SummaryNames) -> xarray.Dataset:
    """Return labelled arrays with the summary: its values as variables, and its whole text.

    Args:
        arrays: of the kind of scene.
        summary: content of ``summary.json``.
        names: of its tables.
    """
    import xarray

    content = json_ready(summary)
    # The scene is in the text only.
    told = {key: value for key, value in content.items() if key not in ("scene", "status")}
    told |= {key: told.pop(key) for key in _BOOKKEEPING if key in told}
    text = xarray.Variable((), json.dumps(content, ensure_ascii=False), {"long_name": "content of summary.json"})
    dataset = xarray.merge([arrays, summary_variables(told, names)], join="exact", compat="no_conflicts")
    return dataset.assign({SUMMARY_TEXT: text}).assign_attrs(
        Conventions="CF-1.8",
        title=content["scene"]["title"],
        source=f"hydroelastic {content['versions']['hydroelastic']}",
        status=content["status"],
        **arrays.attrs,
    )


def write_dataset(dataset: xarray.Dataset, path: Path) -> None:
    """Write a dataset as NetCDF 3, which every reader of NetCDF knows and SciPy alone can read and write, in its order.

    Complex numbers become a leading dimension `complex` of "re" and "im", as Capytaine writes them. Empty arrays, which
    this format does not have, are left out.
    """
    filled = dataset.drop_dims([name for name, size in dataset.sizes.items() if size == 0])
    _without_complex_numbers(filled).to_netcdf(path, engine="scipy", format="NETCDF3_64BIT")


def read_dataset(path: Path) -> tuple[xarray.Dataset, Summary]:
    """Read a ``dataset.nc``.

    Args:
        path: the file.

    Returns:
        The dataset, and the summary as ``summary.json`` has it.

    Raises:
        FileNotFoundError: if there is no such file.
        KeyError: if it holds no summary.
    """
    import xarray

    dataset = xarray.load_dataset(path, engine="scipy")
    return dataset, json.loads(str(dataset[SUMMARY_TEXT].values))


def _without_complex_numbers(dataset: xarray.Dataset) -> xarray.Dataset:
    import xarray

    separated = dataset.copy()
    for name, values in dataset.data_vars.items():
        if np.iscomplexobj(values):
            # Values that were not computed are NaN in both parts.
            parts = xarray.concat([values.real, values.imag], dim="complex").where(values.notnull())
            separated[name] = parts.assign_coords(complex=["re", "im"]).assign_attrs(values.attrs)
    return separated
