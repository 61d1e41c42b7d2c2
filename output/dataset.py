"""All results of a scene as one labelled dataset, `dataset.nc`: arrays of its kind and the whole summary."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.io import netcdf_file

from hydroelastic.output.json_values import json_ready
from hydroelastic.output.provenance import OF_ALL_SCENES, SCENE, STATUS, VERSIONS, Summary, read_summary
from hydroelastic.output.quantities import Group
from hydroelastic.output.summary_variables import summary_variables
from hydroelastic.output.variables import PARTS, Variable, merged, separate_parts

if TYPE_CHECKING:
    import xarray

DATASET = "dataset.nc"
SUMMARY_TEXT = "summary"
"""The variable that holds the summary as the text of ``summary.json``."""


def complete_variables(arrays: Iterable[Variable], summary: Summary, kind: Group) -> list[Variable]:
    """Return labelled arrays with the summary: its values as variables, and its whole text."""
    content = json_ready(summary)
    text = Variable(
        name=SUMMARY_TEXT,
        dimensions=(),
        values=np.array(json.dumps(content, ensure_ascii=False)),
        attributes={"long_name": "content of summary.json"},
    )
    return merged(arrays, summary_variables(content, kind, OF_ALL_SCENES), [text])


def global_attributes(summary: Summary) -> dict[str, str]:
    """Return the attributes of a dataset as a whole."""
    told = read_summary(summary)
    return {
        "Conventions": "CF-1.8",
        "title": told[SCENE]["title"],
        "source": f"hydroelastic {told[VERSIONS]['hydroelastic']}",
        "status": told[STATUS],
    }


def write_dataset(path: Path, variables: Iterable[Variable], attributes: Mapping[str, Any]) -> None:
    """Write a dataset as NetCDF 3, which every reader of NetCDF knows and SciPy alone can read and write.

    Complex numbers become a leading dimension `complex` of "re" and "im", as Capytaine writes them. Texts and truth
    values are written as xarray does, which reads them back. Empty arrays, which this format does not have, are left
    out.
    """
    found = [separate_parts(variable) for variable in variables if variable.values.size]
    if any("complex" in variable.dimensions for variable in found):
        found = merged(found, [PARTS])
    further = [variable.name for variable in found if variable.is_coordinate]
    sizes: dict[str, int] = {}
    with netcdf_file(path, "w", version=2) as file:
        for name, text in {**attributes, **({"coordinates": " ".join(further)} if further else {})}.items():
            setattr(file, name, _attribute(text))
        for variable in found:
            values, dimensions, coding = _stored(variable)
            for name, size in zip(dimensions, values.shape, strict=True):
                if sizes.setdefault(name, size) != size:
                    raise ValueError(f"{variable.name} has {size} values along {name}, others have {sizes[name]}")
                if name not in file.dimensions:
                    file.createDimension(name, size)
            stored = file.createVariable(variable.name, values.dtype, dimensions)
            stored.data[...] = values
            for name, value in {**variable.attributes, **coding}.items():
                setattr(stored, name, _attribute(value))


def _stored(variable: Variable) -> tuple[np.ndarray[Any, Any], tuple[str, ...], dict[str, str]]:
    """Values in a type of NetCDF 3, their dimensions, and attributes by which xarray reads the type."""
    values = np.asarray(variable.values)
    if values.dtype.kind in "UO":
        signs = np.char.encode(values.astype(np.str_), "utf-8")
        length = max(signs.dtype.itemsize, 1)
        signs = np.ascontiguousarray(signs).reshape(values.shape).astype(f"S{length}")
        cut = np.frombuffer(signs.tobytes(), dtype="S1").reshape(*values.shape, length)
        return cut, (*variable.dimensions, f"string{length}"), {"_Encoding": "utf-8"}
    if values.dtype.kind == "b":
        return values.astype(np.int8), variable.dimensions, {"dtype": "bool"}
    return values.astype(np.int32 if values.dtype.kind in "iu" else np.float64), variable.dimensions, {}


def _attribute(value: Any) -> Any:
    """An attribute in a type of NetCDF 3."""
    if isinstance(value, str):
        return value.encode()
    return np.atleast_1d(np.asarray(value, dtype=np.int32 if isinstance(value, int) else np.float64))


def read_dataset(path: Path) -> tuple[xarray.Dataset, Summary]:
    """Read a ``dataset.nc``."""
    # xarray takes a while to import.
    import xarray

    dataset = xarray.load_dataset(path, engine="scipy")
    return dataset, json.loads(str(dataset[SUMMARY_TEXT].values))
