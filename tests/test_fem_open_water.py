"""The complex symmetric pencil of open water and its parts, on problems that are solved by hand."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from mpi4py import MPI
from open_cases import Scene, circle, circle_omega, sea, section, stored, two_liquids
from petsc4py import PETSc

import hydroelastic as he
from hydroelastic.fem.open_water.complex_direct import ShiftedSolver
from hydroelastic.fem.open_water.complex_scaling import ComplexMatrix, complex_product
from hydroelastic.fem.open_water.field_model import Band, OpenModel
from hydroelastic.fem.open_water.incident_waves import incidence, incident_waves
from hydroelastic.fem.open_water.model_building import first_resolution, open_model
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.resonance_search import ResonanceSearch
from hydroelastic.fem.open_water.solver import OpenSolver
from hydroelastic.physics.geometry import PLANE
from hydroelastic.scenes.open_water.physics import open_water_problem

SECTION_ROWS = stored("open_sections.json")["cases"]
TWO_LIQUIDS = stored("open_two_liquids.json")["cases"]


def problem_of(scene: Scene, comm: MPI.Comm = MPI.COMM_WORLD) -> OpenWaterProblem:
    read: Any = he.read(scene)
    return open_water_problem(read, comm)


def model_of(scene: Scene, omega: float, angle: float | None = None) -> OpenModel:
    return first_model(problem_of(scene), omega, angle)


def first_model(problem: OpenWaterProblem, omega: float, angle: float | None = None) -> OpenModel:
    band = Band(lowest=omega, highest=omega)
    return open_model(problem, band, first_resolution(problem.tank, problem.tolerance, band), angle=angle)


@pytest.fixture(scope="module")
def rectangle() -> OpenModel:
    row = SECTION_ROWS[6]
    return model_of(section(row, 1e-5), row["omega"])


@pytest.fixture(scope="module")
def layered() -> OpenModel:
    row = TWO_LIQUIDS[1]
    return model_of(two_liquids(row, 1e-5), row["omega"])


def dense(matrix: np.ndarray) -> PETSc.Mat:
    rows = [[(column, value) for column, value in enumerate(row)] for row in matrix]
    made = PETSc.Mat().createAIJ(matrix.shape, nnz=matrix.shape[1], comm=MPI.COMM_SELF)
    for row, entries in enumerate(rows):
        made.setValues(row, [column for column, _ in entries], [value for _, value in entries])
    made.assemble()
    return made


def complex_matrix(matrix: np.ndarray) -> ComplexMatrix:
    return ComplexMatrix(real=dense(matrix.real.copy()), imaginary=dense(matrix.imag.copy()))


@pytest.mark.parametrize("eigenvalue", [0.7, 0.7 - 0.4j, -0.2j])
def test_real_form_solves_complex_systems(eigenvalue: complex) -> None:
    numbers = np.random.default_rng(3)
    parts = [numbers.normal(size=(6, 6)) + 1j * numbers.normal(size=(6, 6)) for _ in range(2)]
    stiffness, mass = (part + part.T for part in parts)
    solver = ShiftedSolver(complex_matrix(stiffness), complex_matrix(mass))
    load = numbers.normal(size=6) + 1j * numbers.normal(size=6)
    for value in (1.3, eigenvalue):
        # The second time the pattern is known, and one of the parts may vanish.
        solver.shift(value)
        np.testing.assert_allclose(solver.solve(load), np.linalg.solve(stiffness - value * mass, load), rtol=1e-10)
    assert solver.factorizations == 2


def test_products_are_complex() -> None:
    numbers = np.random.default_rng(4)
    matrix = numbers.normal(size=(5, 5)) + 1j * numbers.normal(size=(5, 5))
    vector = numbers.normal(size=5) + 1j * numbers.normal(size=5)
    np.testing.assert_allclose(complex_product(complex_matrix(matrix), vector), matrix @ vector, rtol=1e-13)


@pytest.mark.parametrize("name", ["rectangle", "layered"])
def test_matrices_are_symmetric_not_hermitian(name: str, request: pytest.FixtureRequest) -> None:
    pencil = request.getfixturevalue(name).pencil
    numbers = np.random.default_rng(5)
    one, other = (numbers.normal(size=pencil.size) + 1j * numbers.normal(size=pencil.size) for _ in range(2))
    for matrix in (pencil.laplace, pencil.mass):
        there, back = one @ complex_product(matrix, other), other @ complex_product(matrix, one)
        assert there == pytest.approx(back, rel=1e-11)
        assert matrix.imaginary.norm() > 0.0


@pytest.mark.parametrize("name", ["rectangle", "layered"])
def test_fluxes_of_waves_by_themselves(name: str, request: pytest.FixtureRequest) -> None:
    model = request.getfixturevalue(name)
    omega = (SECTION_ROWS[6] if name == "rectangle" else TWO_LIQUIDS[1])["omega"]
    waves = incident_waves(model.basin.waves(omega / model.basin.units.frequency), PLANE)
    met = incidence(model, waves)
    count = len(waves) // 2
    # A wave is no source within the bodies: ∫ρ(φ∂φ'/∂n − φ'∂φ/∂n) vanishes around each.
    np.testing.assert_allclose(met.own, met.own.T, rtol=0, atol=1e-10 * max(np.abs(met.own).max(), 1e-6))
    np.testing.assert_array_equal(met.reversed[met.reversed], np.arange(2 * count))
    amplitudes = np.random.default_rng(7).normal(size=(2 * count, 3)) + 0j
    np.testing.assert_allclose(met.amplitudes(met.fluxes_of(amplitudes)), amplitudes, rtol=1e-13)


@pytest.mark.parametrize("name", ["rectangle", "layered"])
def test_reduced_basis_meets_what_it_was_given(name: str, request: pytest.FixtureRequest) -> None:
    model = request.getfixturevalue(name)
    omega = (SECTION_ROWS[6] if name == "rectangle" else TWO_LIQUIDS[1])["omega"]
    solver = OpenSolver(model)
    solved = [solver.frequency(factor * omega) for factor in (0.9, 1.0, 1.1)]
    reduced = solver.frequency_between(omega)
    np.testing.assert_allclose(reduced[0].hydrodynamic, solved[1].hydrodynamic, rtol=0, atol=1e-11)
    # The residual comes from products, whose rounding leaves half of the digits.
    assert reduced[1] <= 1e-7
    between, residual = solver.frequency_between(1.05 * omega)
    exact = solver.frequency(1.05 * omega)
    scale = np.abs(exact.hydrodynamic).max()
    error = np.abs(between.hydrodynamic - exact.hydrodynamic).max() / scale
    # Second order: forces err like the square of the residual, up to a factor that the sweep measures.
    assert 0.0 < error <= 30.0 * residual**2 + 1e-12
    assert between.diffraction_force == pytest.approx(exact.diffraction_force, abs=2e-2 * residual * scale + 1e-9)


def test_the_norm_of_a_damped_resonance_is_the_slope_of_the_dynamic_stiffness(rectangle: OpenModel) -> None:
    """xᵀT'x = aᵀD'a of D = K − iωB − λ(M + H), on which the residues of motions after a release depend."""
    pencil, mass = rectangle.pencil, rectangle.mass
    damping = 0.3 * np.sqrt(np.outer(np.diag(mass), np.diag(mass)))
    guess = float(np.max(np.diag(rectangle.stiffness) / np.diag(mass)))
    pair = ResonanceSearch(pencil, rectangle.stiffness, mass, damping).refined(guess * (0.5 - 0.2j))
    solver, loads = pencil.solver(), pencil.loads.astype(complex)

    def dynamic(squared: complex) -> complex:
        solver.shift(squared)
        added = pencil.products(loads, np.array([solver.solve(load) for load in loads]))
        matrix = rectangle.stiffness - 1j * np.sqrt(squared) * damping - squared * (mass + added)
        return complex(pair.bodies @ matrix @ pair.bodies)

    step = 1e-4 * pair.eigenvalue
    slope = (dynamic(pair.eigenvalue + step) - dynamic(pair.eigenvalue - step)) / (2.0 * step)
    # Central differences leave some 1e-8.
    assert pair.norm == pytest.approx(slope, rel=1e-6)


@pytest.mark.parametrize("name", ["rectangle", "layered"])
def test_how_the_sea_is_cut_changes_nothing(name: str, request: pytest.FixtureRequest) -> None:
    """What the ends of the absorbing layer reflect would turn with the angle."""
    model = request.getfixturevalue(name)
    row = SECTION_ROWS[6] if name == "rectangle" else TWO_LIQUIDS[1]
    scene = section(row, 1e-5) if name == "rectangle" else two_liquids(row, 1e-5)
    other = model_of(scene, row["omega"], angle=0.8 * model.absorbing_layer.angle)
    found, known = (OpenSolver(one).frequency(row["omega"]).hydrodynamic for one in (other, model))
    assert np.abs(found - known).max() > 0.0
    # The tolerance.
    np.testing.assert_allclose(found, known, rtol=0, atol=1e-5 * np.abs(known).max())


def test_coordinates_turn_outwards_alone(rectangle: OpenModel) -> None:
    scaling_low, scaling_high = rectangle.basin.bounds
    # Over a bed only sideways.
    assert scaling_low == (0.0, -math.inf)
    assert scaling_high == (1.0, math.inf)
    deep = model_of(circle(1e-3), circle_omega(1.0))
    low, _ = deep.basin.bounds
    assert low[0] == 0.0
    assert -1.0 < low[1] < 0.0


@pytest.mark.only_on_ranks
@pytest.mark.mpi
def test_two_processes_assemble_the_same() -> None:
    row = TWO_LIQUIDS[1]
    together, alone = (
        first_model(problem_of(two_liquids(row, 1e-4), comm), row["omega"]).pencil
        for comm in (MPI.COMM_WORLD, MPI.COMM_SELF)
    )
    assert together.size == alone.size
    for one, other in ((together.laplace, alone.laplace), (together.mass, alone.mass)):
        for part in ("real", "imaginary"):
            assert getattr(one, part).norm() == pytest.approx(getattr(other, part).norm(), rel=1e-12)


@pytest.mark.mpi
def test_each_process_has_the_loads_of_its_unknowns() -> None:
    """Loads by quadrature equal those of the matrices; of some discs one of two processes has no facet."""
    comm, is_bare = MPI.COMM_WORLD, False
    for depth in (6.0, 7.0, 12.0, 24.0, 26.0):
        plate = {"kind": "plate", "outline": "disc", "radius": 250.0, "mass_per_area": 500.0}
        plate |= {"youngs_modulus": 1e10, "thickness": 2.0, "poisson_ratio": 0.3}
        model = first_model(problem_of(sea(plate, depth=depth, tolerance=1e-4)).of_order(0), 0.45)
        (surface,) = model.wetted
        is_bare |= 0 in comm.allgather(len(surface.points))
        found = surface.loads(surface.shapes.astype(complex))[:, model.pencil.free]
        # Two ways to the same integrals: rounding remains.
        np.testing.assert_allclose(found, model.pencil.loads, atol=1e-14)
    assert is_bare == (comm.size > 1)
