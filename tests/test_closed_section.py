"""Closed sections by the weak form in UFL: exact references, with errors that are told."""

import json
from pathlib import Path

import numpy as np
import pytest
from given_meshes import section_mesh
from mpi4py import MPI

import hydroelastic as he
from hydroelastic.fem.closed.section import SectionSolution, solve_section
from hydroelastic.meshes.tagged_mesh import TaggedMesh
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.tank.user_mesh import user_mesh

CASES = {
    case["name"]: case
    for case in json.loads((Path(__file__).parent / "reference" / "aquarium.json").read_text(encoding="utf-8"))["cases"]
}


def case_scene(name: str, **changes: object) -> he.TankScene:
    """The scene of a case of the references."""
    given = CASES[name]["inputs"]
    beam = {
        "kind": "beam",
        "start": given["x1"],
        "length": given["l"],
        "flexural_rigidity": given["EI"],
        "mass_per_length": given["m"],
        "hydrostatic": bool(given["s"]),
        "ends": given.get("ends", "free"),
    }
    return he.TankScene(
        tank={"length": given["L"], "gravity": given["g"]},
        liquid=[{"density": given["rho"], "depth": given["H"]}],
        body=[beam] if given["l"] else [],
        **changes,
    )


def solved(name: str, tolerance: float) -> SectionSolution:
    """The solution of a case of the references."""
    return solve_section(physical_tank(case_scene(name)), tolerance=tolerance, modes=len(CASES[name]["omega"]))


@pytest.mark.parametrize("tolerance", [1e-6, 1e-8])
@pytest.mark.parametrize("name", ["base_s0", "offcentre_s0", "wide_0.9_s1", "full_free_s1"])
def test_modes_are_those_of_the_reference_within_their_estimates(name: str, tolerance: float) -> None:
    solution = solved(name, tolerance)
    data, exact = solution.dataset, np.array(CASES[name]["omega"])
    # The references have eleven certain digits at least, so a smaller error is not known.
    error = np.abs(data.omega.values[: len(exact)] / exact - 1.0)
    estimate = data.relative_error.values[: len(exact)]
    assert np.all(estimate <= tolerance)
    # The sum of the causes, each with its safety; rule of the project: never below a third of the true error.
    assert np.all(error <= 3.0 * estimate + 1e-11)
    assert data.attrs["counted"] == 1
    assert data.attrs["status"] == "ok"
    assert data.attrs["reasons"] == []
    assert data.attrs["zero_modes"] == (1 if name.endswith("s0") else 0)


def test_tones_of_the_base_tank() -> None:
    data, exact = solved("base_s0", 1e-8).dataset, CASES["base_s0"]
    tone = float(data.first_elastic_omega[0])
    assert tone == pytest.approx(exact["elastic1"]["omega"], rel=1e-8)
    released = float(data.first_elastic_pressure_release_omega[0])
    assert released == pytest.approx(exact["psi0"]["elastic_omega"], rel=1e-8)
    # An added mass from ω has twice the relative error of ω, times (m + m_a)/m_a < 1.2.
    added = float(data.first_elastic_added_mass_per_length[0])
    assert added == pytest.approx(exact["elastic1"]["added_mass_hs"], rel=3e-8)


def test_a_tolerance_below_rounding_is_refused_with_its_reason() -> None:
    scene = case_scene("base_s0")
    scene = he.TankScene(**scene.model_dump(exclude={"liquid"}), liquid=[{"density": 1000.0, "depth": 1e-2}])
    data = solve_section(physical_tank(scene), tolerance=1e-11, modes=4).dataset
    # Rounding grows like (L/H)^{3/2} in thin layers: 3e-14 · 8 · 100^{3/2} at degree 8.
    assert data.attrs["status"] == "unconverged"
    assert "mode" in data.attrs["reasons"][0]
    assert "rounding alone leaves" in data.attrs["reasons"][0]
    assert "a tolerance of" in data.attrs["reasons"][0]


def rectangle(length: float, depth: float, columns: int, rows: int, start: float, end: float) -> TaggedMesh:
    """A uniform mesh of one liquid with a beam from start to end on it."""
    x, y = np.linspace(0.0, length, columns + 1), np.linspace(-depth, 0.0, rows + 1)
    number = np.arange(len(x) * len(y)).reshape(len(x), len(y))
    a, b, c, d = (part.ravel() for part in (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]))
    top = np.column_stack([number[:-1, -1], number[1:, -1]])
    middle = 0.5 * (x[1:] + x[:-1])
    return TaggedMesh(
        points=np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2),
        cells=np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])]),
        cell_tags=np.ones(2 * len(a), dtype=np.int32),
        facets=top,
        facet_tags=np.where((middle > start) & (middle < end), 2, 1).astype(np.int32),
        cell_names={"liquid": 1},
        facet_names={"free_surface": 1, "body_1": 2},
    )


def test_a_uniform_mesh_of_ones_own_has_the_modes_of_the_reference() -> None:
    exact = CASES["base_s0"]
    solution = solve_section(
        physical_tank(case_scene("base_s0")),
        tolerance=1e-7,
        modes=len(exact["omega"]),
        mesh=rectangle(10.0, 5.0, 20, 10, 3.0, 7.0),
    )
    data = solution.dataset
    error = np.abs(data.omega.values[: len(exact["omega"])] / exact["omega"] - 1.0)
    assert data.attrs["status"] == "ok"
    # Cells of a sixth of the beam touch its tips: without r = s^m the error would not fall below 1e-5.
    assert np.all(error <= 3.0 * data.relative_error.values[: len(error)])
    tone = float(data.first_elastic_pressure_release_omega[0])
    assert tone == pytest.approx(exact["psi0"]["elastic_omega"], rel=1e-7)


def test_a_baffle_in_a_mesh_of_ones_own(tmp_path: Path) -> None:
    section_mesh(tmp_path / "tank.msh", (10.0, 2.0), (20, 10), at=5.0, baffle=lambda place: bool(place[-1] > -1.0))
    scene = he.TankScene(
        tank={"length": 10.0},
        liquid=[{"density": 900.0, "depth": 2.0}],
        mesh={"file": str(tmp_path / "tank.msh")},
        accuracy={"tolerance": 1e-2, "modes": 4},
    )
    before = he.solve(scene).dataset
    data = solve_section(physical_tank(scene), tolerance=1e-2, modes=4, mesh=user_mesh(scene, MPI.COMM_WORLD)).dataset
    assert data.omega.values[:4] == pytest.approx(before.omega.values, rel=1e-2)


SHAPES = ("elevation", "deflection", "displacement", "motion")


@pytest.mark.mpi
@pytest.mark.parametrize("name", ["aquarium", "float_wedge", "float_in_two_liquids", "interface_beam", "off_centre"])
def test_shapes_and_matrices_are_those_of_the_dataset_on_file(name: str) -> None:
    scene = he.read(name, {"accuracy.modes": 5})
    before = he.solve(scene).dataset
    solution = solve_section(physical_tank(scene), tolerance=scene.accuracy.tolerance, modes=5)
    shapes = solution.shapes
    for quantity in set(shapes.variables) - {"sign"}:
        assert shapes[quantity].dims == before[quantity].dims
        if shapes[quantity].dtype.kind != "f":
            assert list(shapes[quantity].values) == list(before[quantity].values)
            continue
        # Errors of frequencies are squares of those of shapes, which at tips are by r ln r not smooth.
        largest = np.abs(before[quantity]).max()
        tolerance = 1e-3 if str(quantity).startswith(SHAPES) else 1e-12
        assert float(np.abs(shapes[quantity] - before[quantity]).max() / largest) < tolerance, quantity
    assert {str(one) for one in before.variables if str(one).startswith(SHAPES)} <= set(map(str, shapes.variables))


@pytest.mark.mpi
@pytest.mark.parametrize("halves", [True, False])
def test_the_liquid_moves_with_its_surface_and_keeps_its_volume(halves: bool) -> None:
    scene = he.read("aquarium", {"accuracy.modes": 4})
    solution = solve_section(physical_tank(scene), tolerance=1e-8, modes=4, halves=halves)
    omega, shapes, samples = solution.dataset.omega.values, solution.shapes, solution.samples()
    if samples is None:
        assert MPI.COMM_WORLD.rank
        return
    corners = samples.position.values[samples.vertex.values]
    areas = 0.5 * np.linalg.det(corners[:, 1:] - corners[:, :1])
    assert np.all(areas > 0.0)
    assert areas.sum() == pytest.approx(50.0, rel=1e-12)
    at_wall = np.flatnonzero(np.all(np.abs(samples.position.values) < 1e-12, axis=1))[0]
    for mode in range(4):
        # On the surface η = ψ_y = ω²ψ/g: the weak form tells the first, ψ the second.
        eta = float(shapes.elevation_of_free_surface_1[mode, 0])
        assert float(samples.displacement[mode, at_wall, 1]) == pytest.approx(eta, rel=1e-4)
        assert omega[mode] ** 2 / 9.81 * float(samples.potential[mode, at_wall]) == pytest.approx(eta, rel=1e-9)
