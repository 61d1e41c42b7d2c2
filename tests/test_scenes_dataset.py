"""`dataset.nc` of every kind of scene opens in xarray and holds all that the summary holds, under its label."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from functools import cache
from math import nan
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from scene_files import read_written

import hydroelastic as he

# A float that tips over, one whose heave and roll are coupled, and a beam beside them.
FLOATS = """
kind = "tank"
title = "Floats and a beam"
[tank]
length = 10.0
top = "free"
[[liquid]]
density = 1000.0
depth = 3.0
[[body]]
kind = "float"
shape = "rectangle"
position = 2.0
half_width = 0.4
half_height = 1.0
motions = ["heave", "sway", "roll"]
unstable = "solve"
[[body]]
kind = "float"
shape = "polygon"
position = 5.0
vertices = [[-1.0, 0.5], [-1.0, -0.4], [0.3, -0.7], [1.0, -0.4], [1.0, 0.5]]
motions = ["heave", "roll"]
[[body]]
start = 7.0
length = 2.0
flexural_rigidity = 5e3
mass_per_length = 50.0
[accuracy]
tolerance = 1e-2
modes = 4
"""
SHORT = "output.times={start=0, stop=4, number=9}"
PLATE_AND_CIRCLE = """
kind = "tank"
[tank]
length = 10.0
ends = "open"
[[liquid]]
density = 1000.0
depth = 3.0
[[body]]
kind = "float"
shape = "ellipse"
position = 2.0
half_width = 0.5
half_height = 0.5
motions = ["heave"]
[[body]]
start = 5.0
length = 4.0
flexural_rigidity = 5e3
mass_per_length = 50.0
[[analysis]]
kind = "radiation"
omega = [2.0]
[[analysis]]
kind = "response"
omega = [2.0, 4.0]
[[analysis]]
kind = "response"
omega = [2.0]
waves_from = "right"
[[analysis]]
kind = "decay"
displacement = { heave = 0.1 }
times = [0.0, 1.0]
[accuracy]
tolerance = 1e-2
"""
CHAIN = (
    'analysis=[{kind = "modes", count = 2}, {kind = "modes", count = 3}, '
    '{kind = "motion", times = [0.0, 0.5, 1.0], tolerance = 1e-2, release = [{end = "b", time = 0.25}]}]'
)
SCENES: dict[str, tuple[str, ...]] = {
    "aquarium": (),
    "float_in_two_liquids": ("accuracy.tolerance=1e-4",),
    "separator": ("accuracy.modes=3",),
    "string_sine": (SHORT,),
    "string_with_load": (SHORT, "accuracy.tolerance=1e-3"),
    "swell": ('title=""',),
    "released_chain": (CHAIN,),
    "fluttering_hose": ("analysis.1.factors={start=9.0, stop=10.0, number=3}", "accuracy.tolerance=1e-3"),
}
"""Overrides that keep shipped scenes of each kind short."""
ALL = [*SCENES, "floats", "open water"]
FAST = ("aquarium", "string_sine", "swell")


@pytest.fixture(scope="module")
def folder_of(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Returns where the results of that name are; each is made once, when it is asked for."""

    @cache
    def made(name: str) -> Path:
        folder = tmp_path_factory.mktemp("result")
        texts = {"floats": FLOATS, "open water": PLATE_AND_CIRCLE}
        scene = read_written(folder, texts[name]) if name in texts else he.read(name, SCENES[name])
        he.solve(scene).save(folder / "out", images=None)
        return folder / "out"

    return made


def read_dataset(file: Path) -> tuple[xarray.Dataset, dict[str, Any]]:
    with xarray.open_dataset(file) as opened:
        dataset = opened.load()
    return dataset, json.loads(str(dataset["summary"].item()))


@pytest.fixture(params=[name if name in FAST else pytest.param(name, marks=pytest.mark.slow) for name in ALL])
def folder(folder_of: Callable[[str], Path], request: pytest.FixtureRequest) -> Path:
    return folder_of(request.param)


def test_the_summary_comes_back_as_it_is(folder: Path) -> None:
    dataset, summary = read_dataset(folder / "dataset.nc")
    written = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    assert summary == {key: value for key, value in written.items() if key not in ("scene_file", "files")}
    assert dataset.attrs["status"] == summary["status"]
    assert dataset.attrs["title"] == summary["scene"]["title"]
    assert dataset.attrs["source"] == f"hydroelastic {summary['versions']['hydroelastic']}"


def test_no_number_and_no_word_of_a_summary_is_missing_in_the_variables(folder: Path) -> None:
    dataset, summary = read_dataset(folder / "dataset.nc")
    variables = dataset.drop_vars("summary").variables
    numbers = {float(value) for v in variables.values() if v.dtype.kind in "bif" for value in v.values.ravel()}
    words = {str(value).lower() for v in variables.values() if v.dtype.kind in "OU" for value in v.values.ravel()}
    words |= {str(value).lower() for value in dataset.attrs.values()}
    # Sides of waves are angles in a dataset.
    words |= {"left", "right"}
    for place, value in _leaves({key: part for key, part in summary.items() if key != "scene"}):
        if isinstance(value, str) and value not in ("inf", "-inf"):
            assert value.lower() in words, place
        elif value is not None and ".largest" not in place:
            # The largest values of curves, which are in the summary alone, lie between samples.
            assert float(value) in numbers, place


def _leaves(value: Any, place: str = "") -> Iterator[tuple[str, Any]]:
    if isinstance(value, dict | list):
        for key, part in value.items() if isinstance(value, dict) else enumerate(value):
            yield from _leaves(part, f"{place}.{key}")
    else:
        yield place, value


def test_every_variable_says_what_it_is(folder: Path) -> None:
    dataset, _ = read_dataset(folder / "dataset.nc")
    for name, variable in dataset.data_vars.items():
        assert "long_name" in variable.attrs, name
        if variable.dtype.kind not in "if" or str(name).startswith("thin_float_"):
            # What is compared with the thin-float theory has units of its own.
            continue
        assert "units" in variable.attrs, name
    for name, coordinate in dataset.coords.items():
        # Numbers of modes and the like have none.
        assert "units" in coordinate.attrs or coordinate.dtype.kind in "OUi", name


def test_modes_of_a_tank_lie_along_a_dimension(folder_of: Callable[[str], Path]) -> None:
    dataset, summary = read_dataset(folder_of("aquarium") / "dataset.nc")
    assert dataset.mode.values.tolist() == list(range(1, 11))
    for key in summary["modes"][0]:
        assert dataset[key].dims == ("mode",)
        assert dataset[key].values.tolist() == [mode[key] for mode in summary["modes"]]
    assert dataset.omega.attrs["units"] == "rad/s"
    assert dataset.omega.attrs["long_name"] == "angular frequency of a mode"
    assert dataset.frequency_hz.attrs["units"] == "Hz"
    assert dataset.first_elastic_omega.item() == summary["first_elastic"]["omega"]
    assert not dataset.first_elastic_shared.item()
    assert dataset.seconds.item() == summary["seconds"]
    assert dataset.versions.sel(package="numpy").item() == np.__version__
    for name, estimate in summary["estimates"].items():
        own = dataset.sel(estimate=name)
        assert own.estimate_note.item() == estimate["note"]
        for key in ("omega", "difference", "added_mass_per_length"):
            assert own[f"estimate_{key}"].item() == pytest.approx(
                nan if estimate[key] is None else estimate[key], rel=0, nan_ok=True
            )
    # Whether a bound holds: true, false, or not known.
    assert dataset.estimate_bound_holds.sel(estimate="rayleigh").item() == 1.0
    assert np.isnan(dataset.estimate_bound_holds.sel(estimate="strip").item())


def test_waves_in_a_tank_are_cosines_of_known_height(tmp_path: Path) -> None:
    """η = a cos kx, whose kinetic energy is that of a generalized mass of 1 kg/m if a² = 2k tanh kH/(ρL)."""
    he.solve(he.read("sloshing", ["accuracy.modes=3"])).save(tmp_path / "out", images=None)
    dataset, summary = read_dataset(tmp_path / "out" / "dataset.nc")
    length, (liquid,) = summary["scene"]["tank"]["length"], summary["scene"]["liquid"]
    k = dataset.mode * np.pi / length
    height = np.sqrt(2.0 * k * np.tanh(k * liquid["depth"]) / (liquid["density"] * length))
    expected = height * np.cos(k * dataset.position_on_free_surface_1)
    found = dataset.elevation_of_free_surface_1
    assert found.attrs["units"] == "m"
    assert float(found.attrs["level_at_rest"]) == 0.0
    # The sign of a mode is free. ψ errs in the energy by the root of what ω² does; measured 3 % of that.
    sign = np.sign(found[:, 0] * expected[:, 0])
    error = float(abs(found - sign * expected).max() / height.min())
    assert error < np.sqrt(2.0 * dataset.relative_error.max())


def test_bodies_move_by_their_motions(folder_of: Callable[[str], Path]) -> None:
    """Each point of a float's contour moves by heave, sway and roll about the centre of mass."""
    dataset, summary = read_dataset(folder_of("floats") / "dataset.nc")
    assert len(summary["growing"]) == 1
    assert dataset.growing_growth_rate.item() == summary["growing"][0]["growth_rate"]
    for prefix, modes in (("", 4), ("growing_", 1)):
        motion = dataset[f"{prefix}motion"]
        assert motion.sizes == {f"{prefix}mode": modes, "dof": 5}
        assert motion.attrs["units"] == "m, of roll rad"
        for number, row in enumerate(summary["floats"], 1):
            x, y = row["centre_of_mass"]
            contour = dataset[f"contour_of_body_{number}"]
            heave, roll = (motion.sel(dof=f"body_{number}__{name}") for name in ("Heave", "Roll"))
            sway = motion.sel(dof="body_1__Sway") if number == 1 else 0.0 * roll
            moved = dataset[f"{prefix}displacement_of_body_{number}"]
            across = sway - roll * (contour.sel(axis="y") - y)
            upwards = heave + roll * (contour.sel(axis="x") - x)
            size = float(abs(moved).max())
            # Rounding of the sums, at arms of metres.
            assert float(abs(moved.sel(axis="x") - across).max()) < 1e-13 * size
            assert float(abs(moved.sel(axis="y") - upwards).max()) < 1e-13 * size
    assert dataset.deflection_of_body_3.dims == ("mode", "position_on_body_3")
    assert dataset.position_on_body_3.values[[0, -1]] == pytest.approx([7.0, 9.0], rel=1e-14)
    assert {"elevation_of_free_surface_4", "growing_deflection_of_body_3"} <= set(dataset.data_vars)


def test_the_matrices_of_floats_are_those_of_the_summary(folder_of: Callable[[str], Path]) -> None:
    dataset, summary = read_dataset(folder_of("floats") / "dataset.nc")
    for number, row in enumerate(summary["floats"], 1):
        dofs = [f"body_{number}__{motion.capitalize()}" for motion in row["motions"]]
        own = dataset.sel(influenced_dof=dofs, radiating_dof=dofs)
        assert own.infinite_frequency_added_mass.values.tolist() == row["high_frequency"]["added_mass"]
        masses = [row["moment_of_inertia" if motion == "roll" else "mass"] for motion in row["motions"]]
        # To rounding: they went through the units of the tank.
        assert own.inertia_matrix.values == pytest.approx(np.diag(masses), rel=1e-13)
        stiffness = own.hydrostatic_stiffness.sel(influenced_dof=dofs[0], radiating_dof=[dofs[0], dofs[-1]])
        expected = [row["heave_stiffness"], row["coupling_stiffness"]]
        assert stiffness.values == pytest.approx(expected, rel=1e-13, abs=1e-10 * expected[0])
        turning = own.hydrostatic_stiffness.sel(influenced_dof=dofs[-1], radiating_dof=dofs[-1])
        assert turning.item() == pytest.approx(row["roll_stiffness"], rel=1e-13)
    assert dataset.float_mode_omega.dims == ("float", "float_mode")
    # The two floats move one another through the liquid.
    both = dataset.infinite_frequency_added_mass.sel(influenced_dof="body_1__Sway", radiating_dof="body_2__Roll")
    assert abs(both.item()) > 0.0


@pytest.mark.slow
def test_phases_of_forces_are_said(folder_of: Callable[[str], Path]) -> None:
    dataset, summary = read_dataset(folder_of("open water") / "dataset.nc")
    for name in ("excitation_force", "RAO", "transmission_coefficient"):
        assert "x = 0 of the scene" in dataset[name].attrs["phase"]
    assert "phase" not in dataset["added_mass"].attrs
    # Rows are those of the body that is pushed, columns those of the body that moves.
    matrix = np.array(summary["radiation"][0]["added_mass"][0])
    found = dataset["added_mass"].transpose("omega", "influenced_dof", "radiating_dof").values
    assert any(np.array_equal(found[place][: len(matrix), : len(matrix)], matrix) for place in range(len(found)))
