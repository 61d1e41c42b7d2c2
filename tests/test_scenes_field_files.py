"""Files of fields say the same to meshio and to VTK, which ParaView reads with, and the same as `dataset.nc`."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
import pyvista
import vtk
import xarray

import hydroelastic as he

SCENES: dict[str, tuple[str, ...]] = {
    "sloshing": ("accuracy.modes=3", "accuracy.tolerance=1e-9"),
    "float_in_two_liquids": ("accuracy.modes=3", "accuracy.tolerance=1e-4"),
    "aquarium": ("accuracy.modes=3", "accuracy.tolerance=1e-4"),
    "open_plate": ("analysis.1.omega=[3.0]", "accuracy.tolerance=1e-3"),
    "string_table": ("output.frames=3", "output.times={start=0, stop=8, number=33}"),
    "released_chain": (
        "output.frames=3",
        'analysis=[{kind = "motion", times = [0.0, 0.5, 1.0], tolerance = 1e-2, release = [{end = "b", time = 0.25}]}]',
    ),
}


@pytest.fixture(scope="module")
def folder_of(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Returns where the results of a scene are; each is solved when it is asked for first."""

    @cache
    def made(name: str) -> Path:
        folder = tmp_path_factory.mktemp("fields") / name
        he.solve(he.read(name, SCENES[name])).save(folder, images=None)
        return folder

    return made


def both(file: Path) -> tuple[meshio.Mesh, Any]:
    """What meshio and VTK read of a file, having seen that it is the same."""
    one, other = meshio.read(file), pyvista.read(file)
    np.testing.assert_array_equal(one.points, other.points)
    kinds = pyvista.CellType
    names = {kinds.TRIANGLE: "triangle", kinds.LINE: "line", kinds.POLY_LINE: "line", kinds.POLYGON: "polygon"}
    assert set(one.cells_dict) == {names[kind] for kind in other.cells_dict}
    for kind, cells in other.cells_dict.items():
        np.testing.assert_array_equal(one.cells_dict[names[kind]], cells)
    assert set(one.point_data) == set(other.point_data)
    for name, values in one.point_data.items():
        np.testing.assert_array_equal(values, other.point_data[name])
        # ParaView has no complex numbers.
        assert values.dtype == np.float64
    assert set(one.cell_data) == set(other.cell_data)
    for name, blocks in one.cell_data.items():
        np.testing.assert_array_equal(np.concatenate(blocks), other.cell_data[name])
    return one, other


def results(folder: Path) -> tuple[xarray.Dataset, dict[str, Any]]:
    return xarray.load_dataset(folder / "dataset.nc"), json.loads((folder / "summary.json").read_text("utf-8"))


def test_waves_on_the_surface_are_those_of_the_dataset(folder_of: Callable[[str], Path]) -> None:
    """At y = 0 ψ is η g/ω², and ∂ψ/∂y is η."""
    mesh, _ = both(folder_of("sloshing") / "fields" / "modes.vtu")
    dataset, summary = results(folder_of("sloshing"))
    assert set(mesh.point_data) == {f"{what}_{n:03d}" for what in ("potential", "displacement") for n in (1, 2, 3)}
    assert set(np.concatenate(mesh.cell_data["liquid"])) == {1}
    top = np.abs(mesh.points[:, 1]) < 1e-12
    x, gravity = mesh.points[top, 0], summary["scene"]["tank"]["gravity"]
    along = dataset.position_on_free_surface_1
    for mode, number in zip(dataset.mode, (1, 2, 3), strict=True):
        elevation = dataset.elevation_of_free_surface_1.sel(mode=mode)
        expected = np.interp(x, along, elevation)
        height = float(abs(elevation).max())
        # Between points h apart a chord misses a cosine by (kh)²/8 of its height; of that 93 % were measured.
        chord = (number * np.pi / summary["scene"]["tank"]["length"] * float(np.diff(along).max())) ** 2 / 8.0 * height
        potential = mesh.point_data[f"potential_{number:03d}"][top]
        assert potential * float(dataset.omega.sel(mode=mode)) ** 2 / gravity == pytest.approx(expected, abs=chord)
        # ∇ψ errs in the energy by the root of what ω² does.
        more = float(np.sqrt(2.0 * dataset.relative_error.sel(mode=mode))) * height
        upwards = mesh.point_data[f"displacement_{number:03d}"][top, 1]
        assert upwards == pytest.approx(expected, abs=chord + more)
        assert not mesh.point_data[f"displacement_{number:03d}"][:, 2].any()


def test_two_liquids_are_told_apart(folder_of: Callable[[str], Path]) -> None:
    mesh, read = both(folder_of("float_in_two_liquids") / "fields" / "modes.vtu")
    dataset, _ = results(folder_of("float_in_two_liquids"))
    middle = read.cell_centers().points[:, 1]
    np.testing.assert_array_equal(read.cell_data["liquid"], np.where(middle < 0.0, 1, 2))
    assert read.bounds[:4] == pytest.approx((0.0, 10.0, -4.0, 4.0), rel=1e-14)
    assert {name[-3:] for name in mesh.point_data} == {f"{number:03d}" for number in dataset.mode.values}


def test_bodies_move_as_the_dataset_says(folder_of: Callable[[str], Path]) -> None:
    """Under the names that the liquid's displacements have, so that ParaView warps both by the same one."""
    fields = folder_of("aquarium") / "fields"
    mesh, _ = both(fields / "bodies.vtu")
    dataset, _ = results(folder_of("aquarium"))
    assert set(mesh.point_data) == {name for name in meshio.read(fields / "modes.vtu").point_data if "disp" in name}
    parts = {1: ("free_surface_1", "free_surface_2"), 3: ("body_1",)}
    cells, kinds = mesh.cells_dict["line"], np.concatenate(mesh.cell_data["part"])
    assert set(kinds) == set(parts)
    for kind, names in parts.items():
        places = np.unique(cells[kinds == kind])
        x = np.concatenate([dataset[f"position_on_{name}"] for name in names])
        np.testing.assert_array_equal(mesh.points[places], np.column_stack([x, 0.0 * x, 0.0 * x]))
        for mode in dataset.mode.values:
            moved = [
                dataset[f"{'deflection' if kind == 3 else 'elevation'}_of_{name}"].sel(mode=mode) for name in names
            ]
            displacement = mesh.point_data[f"displacement_{mode:03d}"][places]
            np.testing.assert_array_equal(displacement[:, 1], np.concatenate(moved))
            assert not displacement[:, [0, 2]].any()


def test_the_liquid_moves_with_the_beam_on_it(folder_of: Callable[[str], Path]) -> None:
    """∂ψ/∂y under a beam is its deflection, with its sign."""
    mesh, _ = both(folder_of("aquarium") / "fields" / "modes.vtu")
    dataset, _ = results(folder_of("aquarium"))
    first, last = dataset.position_on_body_1.values[[0, -1]]
    margin = 0.2 * (last - first)  # where the logarithm at the ends of the beam is resolved
    x, y, _ = mesh.points.T
    under = (np.abs(y) < 1e-12) & (x > first + margin) & (x < last - margin)
    assert under.sum() > 3
    for mode in dataset.mode.values:
        deflection = dataset.deflection_of_body_1.sel(mode=mode)
        upwards = mesh.point_data[f"displacement_{mode:03d}"][under, 1]
        # Gradients err by the root of what the energy does, which is asked to 1e-4; measured 1e-4 of the largest.
        expected = np.interp(x[under], dataset.position_on_body_1, deflection)
        assert upwards == pytest.approx(expected, abs=1e-3 * float(abs(deflection).max()))


def test_floats_are_polygons_that_move_as_bodies_do(folder_of: Callable[[str], Path]) -> None:
    fields = folder_of("float_in_two_liquids") / "fields"
    mesh, read = both(fields / "bodies.vtu")
    dataset, _ = results(folder_of("float_in_two_liquids"))
    assert set(np.concatenate(mesh.cell_data["part"])) == {2, 4}
    ((*corners,),) = mesh.cells_dict["polygon"]
    np.testing.assert_array_equal(mesh.points[corners, :2], dataset.contour_of_body_1)
    for mode in dataset.mode.values:
        name = f"displacement_{mode:03d}"
        np.testing.assert_array_equal(mesh.point_data[name][corners, :2], dataset.displacement_of_body_1.sel(mode=mode))
        # A rigid motion that is small leaves the area as it is.
        before, after = (one.compute_cell_sizes()["Area"][-1] for one in (read, read.warp_by_vector(name, factor=1e-6)))
        assert after == pytest.approx(before, rel=1e-9)


@pytest.mark.slow
def test_bodies_of_open_water_move_with_the_water(folder_of: Callable[[str], Path]) -> None:
    mesh, _ = both(folder_of("open_plate") / "fields" / "response_1_bodies.vtu")
    liquid, _ = both(folder_of("open_plate") / "fields" / "response_1.vtu")
    dataset, _ = results(folder_of("open_plate"))
    assert set(mesh.point_data) == {name for name in liquid.point_data if name.startswith("displacement")}
    assert mesh.points[:, 0].min() == pytest.approx(liquid.points[:, 0].min(), abs=1e-12)
    assert mesh.points[:, 0].max() == pytest.approx(liquid.points[:, 0].max(), rel=1e-12)
    places = np.unique(mesh.cells_dict["line"][np.concatenate(mesh.cell_data["part"]) == 3])
    waves = dataset.squeeze(["omega", "wave_direction"]).deflection_of_body_1
    for part, name in (("re", "real"), ("im", "imaginary")):
        expected = np.interp(mesh.points[places, 0], dataset.position_on_body_1, waves.sel(complex=part))
        # Solved for once more, in a wider basin, to the accuracy of a picture: 1e-3 of energies.
        assert mesh.point_data[f"displacement_{name}"][places, 1] == pytest.approx(expected, abs=np.sqrt(1e-3))


def test_waves_of_open_water_are_those_of_the_dataset(folder_of: Callable[[str], Path]) -> None:
    """Far from the plate η = ω²ψ/g is T e^{ikx} behind it and e^{ikx} + R e^{−ikx} before it; on it, its deflection."""
    mesh, _ = both(folder_of("open_plate") / "fields" / "response_1.vtu")
    dataset, summary = results(folder_of("open_plate"))
    parts = ("potential", "pressure", "displacement")
    assert set(mesh.point_data) == {f"{part}_{what}" for part in parts for what in ("real", "imaginary", "magnitude")}
    data = mesh.point_data
    for part in parts:
        whole = np.stack([data[f"{part}_real"], data[f"{part}_imaginary"]], axis=-1).reshape(len(mesh.points), -1)
        np.testing.assert_allclose(data[f"{part}_magnitude"], np.linalg.norm(whole, axis=1), rtol=1e-13)
    waves = dataset.squeeze(["omega", "wave_direction"])
    ratios = waves[["reflection_coefficient", "transmission_coefficient", "deflection_of_body_1"]]
    found = ratios.sel(complex="re") + 1j * ratios.sel(complex="im")
    x, top = mesh.points[:, 0], np.abs(mesh.points[:, 1]) < 1e-9
    scale = float(waves.omega) ** 2 / summary["scene"]["tank"]["gravity"]
    elevation = scale * (data["potential_real"] + 1j * data["potential_imaginary"])
    wave = np.exp(1j * float(waves.wavenumber) * x)
    behind, before = top & (x > 20.0), top & (x < 1.0)
    # The asked tolerance, waves having height 1; measured a tenth of it.
    transmitted = found.transmission_coefficient.item() * wave[behind]
    assert elevation[behind] == pytest.approx(transmitted, abs=1e-3)
    reflected = found.reflection_coefficient.item() / wave[before]
    assert elevation[before] == pytest.approx(wave[before] + reflected, abs=1e-3)
    # ∇ψ has half the digits, and fewer still at the ends of the plate; measured 5e-3 half a metre from them.
    places = dataset.position_on_body_1
    on_plate = top & (x > float(places[0]) + 0.5) & (x < float(places[-1]) - 0.5)
    deflection = found.deflection_of_body_1
    for part, values in (("real", deflection.real), ("imaginary", deflection.imag)):
        expected = np.interp(x[on_plate], places, values)
        assert data[f"displacement_{part}"][on_plate, 1] == pytest.approx(expected, abs=np.sqrt(1e-3))


def test_paraview_plays_a_string(folder_of: Callable[[str], Path]) -> None:
    dataset, _ = results(folder_of("string_table"))
    played = _played(folder_of("string_table") / "fields" / "string.pvd")
    assert [time for time, _ in played] == [0.0, 4.0, 8.0]
    for time, line in played:
        moved = dataset.displacement.sel(time=time)
        np.testing.assert_array_equal(line.points[:, 0], moved)
        np.testing.assert_array_equal(line.points[:, 1], dataset.position)
        np.testing.assert_array_equal(line.point_data["displacement"], moved)
        np.testing.assert_array_equal(line.point_data["absolute_error"], dataset.absolute_error.sel(time=time))


@pytest.mark.slow
def test_paraview_plays_a_thread(folder_of: Callable[[str], Path]) -> None:
    folder = folder_of("released_chain")
    dataset, summary = results(folder)
    played = _played(folder / "fields" / "motion.pvd")
    assert [time for time, _ in played] == [0.0, 0.5, 1.0]
    for time, line in played:
        np.testing.assert_array_equal(line.points, dataset.motion_position.sel(time=time))
        np.testing.assert_array_equal(line.point_data["tension"], dataset.motion_tension.sel(time=time))
        np.testing.assert_array_equal(line.point_data["s"], dataset.node)
    rest, _ = both(folder / "fields" / "equilibrium.vtu")
    np.testing.assert_array_equal(rest.points, dataset.position)
    np.testing.assert_array_equal(rest.point_data["tension"], dataset.tension)
    assert rest.points[:, 2].min() == summary["equilibrium"]["lowest_point"]


def _played(collection: Path) -> list[tuple[float, meshio.Mesh]]:
    """The frames of a sequence, as VTK finds them: unbroken lines, the same by meshio."""
    reader = pyvista.get_reader(collection)
    found = []
    for time, entry in zip(reader.time_values, reader.datasets, strict=True):
        mesh, _ = both(collection.parent / entry.path)
        np.testing.assert_array_equal(mesh.cells_dict["line"], list(pairwise(range(len(mesh.points)))))
        reader.set_active_time_value(time)
        np.testing.assert_array_equal(reader.read()[0].points, mesh.points)
        found.append((time, mesh))
    return found


@pytest.mark.parametrize(
    ("scene", "file", "units"),
    [
        ("sloshing", "modes.vtu", {"potential_001": "m^2", "displacement_003": "m"}),
        ("sloshing", "bodies_002.vtu", {"displacement": "m"}),
        ("open_plate", "response_1.vtu", {"pressure_real": "Pa", "potential_imaginary": "m^2"}),
    ],
)
def test_arrays_tell_their_units(
    scene: str, file: str, units: dict[str, str], folder_of: Callable[[str], Path]
) -> None:
    mesh = pyvista.read(folder_of(scene) / "fields" / file)
    for name, unit in units.items():
        array = mesh.point_data.VTKObject.GetArray(name)
        assert array.GetInformation().Get(vtk.vtkDataArray.UNITS_LABEL()) == unit


def test_modes_are_played_by_their_frequencies(folder_of: Callable[[str], Path]) -> None:
    folder = folder_of("sloshing")
    reader = pyvista.get_reader(folder / "fields" / "modes.pvd")
    modes = json.loads((folder / "summary.json").read_text())["modes"]
    # Twelve digits are written.
    np.testing.assert_allclose(reader.time_values, [mode["omega"] for mode in modes], rtol=1e-11)
    all_modes = pyvista.read(folder / "fields" / "bodies.vtu")
    for number in range(1, len(modes) + 1):
        reader.set_active_time_point(number - 1)
        np.testing.assert_array_equal(
            reader.read()[0].point_data["displacement"], all_modes.point_data[f"displacement_{number:03d}"]
        )
