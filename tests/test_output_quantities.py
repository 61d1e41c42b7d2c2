"""A quantity is declared once: its summary, variables, tables and reference all come from that."""

from pathlib import Path

import numpy as np
import pytest
import xarray

from hydroelastic.output.csv_files import write_csv
from hydroelastic.output.dataset import write_dataset
from hydroelastic.output.quantities import Group, Quantity
from hydroelastic.output.quantity_tables import columns, headings, listed, reference_table
from hydroelastic.output.reading import Reading
from hydroelastic.output.summary_variables import summary_variables
from hydroelastic.output.variables import Variable, array_variables, grid_columns, merged

MODES = Group(
    "modes",
    "modes",
    (
        Quantity("omega", "angular frequency", "rad/s", "ω", error="relative_error"),
        Quantity("force", "force", "N s^2/m^3", error="force_error"),
        Quantity("relative_error", "relative error", "1", shown=".1e"),
        Quantity("force_error", "error of the force", "N", printed=False),
        Quantity("shape", "shape", "m", value=lambda mode: mode["shape"], dimensions=("node",), in_summary=False),
        Quantity("node", "node", "m", value=lambda _: np.array([0.0, 1.0]), dimensions=("node",), in_summary=False),
    ),
    dimension="mode",
    prefix="",
)
KIND = Group(
    "",
    "a kind",
    (
        Quantity("count", "number", "1", value=lambda it: np.int64(it["whole"])),
        Group("none", "what there is not", (Quantity("value", "value", "m"),), record=lambda _: None),
        Group("size", "size", (Quantity("cells", "cells", "1"), Quantity("terms", "terms", "1"))),
        MODES,
        Quantity("side", "side", None, value=lambda _: ("left", "right"), dimensions=("side",), in_summary=False),
    ),
)
SOLUTION = {
    "whole": 3,
    "size": {"cells": 7},
    "modes": [
        {"omega": 1.23456789, "relative_error": 1e-5, "force": 0.1, "force_error": 0.2, "shape": np.ones(2)},
        {"omega": 2.0, "relative_error": 1e-5, "force": 12.3456, "force_error": 1e-3, "shape": np.zeros(2)},
    ],
}


def test_the_summary_has_the_declared_keys_in_plain_types() -> None:
    summary = KIND.evaluated(SOLUTION)
    assert summary["count"] == 3
    assert type(summary["count"]) is int
    assert summary["none"] is None
    # What a mapping lacks has no key; arrays of the dataset are not in the summary.
    assert summary["size"] == {"cells": 7}
    assert summary["modes"][1] == {"omega": 2.0, "force": 12.3456, "relative_error": 1e-5, "force_error": 1e-3}


def test_variables_have_name_dimensions_unit_and_meaning() -> None:
    found = {one.name: one for one in merged(summary_variables(KIND.evaluated(SOLUTION), KIND))}
    assert set(found) == {"count", "none", "size_cells", "mode", "omega", "force", "relative_error", "force_error"}
    assert found["omega"].dimensions == ("mode",)
    assert found["omega"].attributes == {"long_name": "angular frequency", "units": "rad/s"}
    assert found["mode"].values.tolist() == [1, 2]


def test_each_record_of_a_list_has_arrays_of_its_own() -> None:
    found = {one.name: one.dimensions for one in array_variables(KIND, SOLUTION)}
    # No array lies along the sides.
    assert found == {"shape": ("node",), "node": ("node",), "shape_2": ("node_2",), "node_2": ("node_2",)}


def test_cells_have_the_digits_that_are_certain() -> None:
    values = Reading(KIND, KIND.evaluated(SOLUTION))[MODES]
    assert headings(MODES) == ("ω, rad/s", "force, N·s²/m³", "relative error")
    # The first force is smaller than its error.
    assert columns(values) == [("1.2346", "0", "1.0e-05"), ("2.0000", "12.346", "1.0e-05")]
    assert listed(Reading(MODES, {"omega": 2.0, "relative_error": 1e-5}))[0] == ("angular frequency ω, rad/s", "2.0000")
    assert "| · `omega` | ω | rad/s | angular frequency | `omega` (mode) |" in reference_table(KIND)


def test_a_grid_is_written_row_by_row(tmp_path: Path) -> None:
    field = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 0.1]])
    arrays = [
        Variable(name="x", dimensions=("x",), values=np.array([0.0, 0.5])),
        Variable(name="t", dimensions=("t",), values=np.arange(3)),
        Variable(name="field", dimensions=("x", "t"), values=field),
    ]
    write_csv(tmp_path / "grid.csv", grid_columns(arrays, ("t", "x", "field"), ("t", "x")))
    rows = (tmp_path / "grid.csv").read_text(encoding="utf-8").splitlines()
    assert rows == ["t,x,field", "0,0.0,1.0", "0,0.5,4.0", "1,0.0,2.0", "1,0.5,5.0", "2,0.0,3.0", "2,0.5,0.1"]


def test_a_dataset_is_what_xarray_reads(tmp_path: Path) -> None:
    root = Variable(name="root", dimensions=("mode",), values=np.array([1 + 2j, complex(np.nan, 0.0)]))
    text = Variable(name="name", dimensions=(), values=np.array("Ψ"), attributes={"long_name": "λ"})
    further = Variable(name="period", dimensions=("mode",), values=np.ones(2), is_coordinate=True)
    empty = Variable(name="empty", dimensions=("nothing",), values=np.zeros(0))
    write_dataset(tmp_path / "d.nc", [root, text, further, empty], {"title": "∿"})
    with xarray.open_dataset(tmp_path / "d.nc") as found:
        assert found.root.dims == ("complex", "mode")
        np.testing.assert_array_equal(found.root.sel(complex="im"), [2.0, np.nan])
        assert (found.name.item(), found.name.attrs, found.title) == ("Ψ", {"long_name": "λ"}, "∿")
        assert "period" in found.coords
        assert "empty" not in found.variables
    other = Variable(name="longer", dimensions=("mode",), values=np.ones(3))
    with pytest.raises(ValueError, match="3 values along mode"):
        write_dataset(tmp_path / "d.nc", [root, other], {})
    with pytest.raises(ValueError, match="period differ"):
        merged([further], [Variable(name="period", dimensions=("mode",), values=np.zeros(2))])
