"""The liquid's solution operator A⁺ and the loads on it, against closed forms."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import pi, tanh
from typing import Any

import numpy as np
import pytest
from dolfinx import fem
from petsc4py import PETSc

from hydroelastic.fem.cell_matrices import CellMatrices, condensed
from hydroelastic.fem.liquid import LiquidSolver, cell_values, closed_layer, constrained_dofs
from hydroelastic.fem.liquid_matrices import laplace_matrix
from hydroelastic.fem.numbering import numbered
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.shape_loads import surface_load as surface_load_of
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.modal.beam.dry_modes import free_free_shape, free_free_wavenumber

pytestmark = pytest.mark.mpi

LENGTH, DEPTH = 1.0, 0.5  # of the scaled tank of the case base_s0


def as_vector(pencil: CoupledPencil, values: Callable[[np.ndarray], np.ndarray]) -> PETSc.Vec:
    """The interpolant of a function of the points, as a vector on all unknowns of ψ."""
    function = fem.Function(pencil.liquid.space)
    function.interpolate(values)
    vector = pencil.coupling.createVecLeft()
    vector.array[:] = function.x.array[pencil.liquid.numbering.owned_dofs]
    return vector


def solved(pencil: CoupledPencil, load: PETSc.Vec, solver: LiquidSolver | None = None) -> PETSc.Vec:
    potential = pencil.coupling.createVecLeft()
    (solver or pencil.solver).solve(load, potential)
    return potential


def random_load(pencil: CoupledPencil, seed: int) -> PETSc.Vec:
    """Entries that depend on the point alone, so that they are the same on any number of processes."""
    return as_vector(pencil, lambda x: np.sin(1e3 * seed * (x[0] + 1.7 * x[1]) + seed))


def surface_load(pencil: CoupledPencil) -> PETSc.Vec:
    """∫q over the water: the water's columns of C times one."""
    ones, load = pencil.coupling.createVecRight(), pencil.coupling.createVecLeft()
    ones.set(1.0)
    pencil.coupling.mult(ones, load)
    return load


@pytest.fixture(scope="module")
def water(tanks: Any) -> CoupledPencil:
    """A tank without a body at degree 8, elements of an eighth of its length."""
    return tanks.pencil(tanks.scene(), degree=8, size=0.125)


@pytest.fixture(scope="module")
def beam(tanks: Any) -> CoupledPencil:
    """The case base_s0 on coarse elements, two along the beam, with 62 shapes: the last has index 61."""
    return tanks.pencil(tanks.scene(tanks.beam()), degree=5, shapes=62, size=0.25, tip_size=None)


# The operator's condition times a double's 2e-16: measured 6e-13 between two constrained unknowns at degree 8.
ROUND_OFF = 1e-11


@pytest.mark.parametrize("pressure_release", [False, True])
def test_the_solution_operator_is_symmetric(tanks: Any, pressure_release: bool) -> None:
    pencil = tanks.pencil(tanks.scene(tanks.beam()), pressure_release=pressure_release)
    one, other = random_load(pencil, 1), random_load(pencil, 2)
    forth, back = other.dot(solved(pencil, one)), one.dot(solved(pencil, other))
    size = np.sqrt(one.dot(solved(pencil, one)) * other.dot(solved(pencil, other)))
    # One factorization serves both ways: measured 2e-15, with rings down to 1e-8.
    assert abs(forth - back) <= 1e-13 * size


def test_the_solution_operator_is_positive(water: CoupledPencil) -> None:
    for seed in range(1, 6):
        load = random_load(water, seed)
        assert load.dot(solved(water, load)) > 0.0


def test_which_unknown_is_constrained_makes_no_difference(water: CoupledPencil) -> None:
    load = random_load(water, 1)
    expected = solved(water, load)
    size = water.laplace.getLocalSize()[0]
    for place in (size - 1, size // 2):
        last_rank = water.laplace.comm.rank == water.laplace.comm.size - 1
        constrained = np.array([place] if last_rank else [], dtype=np.int32)
        other = LiquidSolver(water.laplace, constrained, (closed_layer(water.liquid, 0, surface_load(water).array),))
        difference = solved(water, load, other)
        difference.axpy(-1.0, expected)
        assert difference.norm() <= ROUND_OFF * expected.norm()


@pytest.mark.parametrize("closed", [True, False])
def test_all_loads_at_once_are_those_one_by_one(water: CoupledPencil, closed: bool) -> None:
    """Held unknowns are zero exactly, for their rows are those of the identity."""
    if water.laplace.comm.size > 1:
        pytest.skip("all loads at once are for one process")
    size = water.laplace.getSize()[0]
    held = np.array([size // 2]) if closed else np.arange(0, size, 7)
    layers = (closed_layer(water.liquid, 0, surface_load(water).array),) if closed else ()
    solver = LiquidSolver(water.laplace, held.astype(np.int32), layers)
    answers = solver.solve_all(water.coupling)
    load = water.coupling.createVecLeft()
    for column in (0, answers.shape[1] // 2, answers.shape[1] - 1):
        water.coupling.getColumnVector(column, load)
        expected = solved(water, load, solver).array_r
        assert np.linalg.norm(answers[:, column] - expected) <= ROUND_OFF * np.linalg.norm(expected)
    if not closed:
        assert not answers[held].any()


def test_a_constant_load_along_the_water_moves_nothing(water: CoupledPencil) -> None:
    """A⁺ projects the net flux out: a closed liquid cannot give way to it."""
    load = surface_load(water)
    assert load.sum() == pytest.approx(LENGTH, rel=1e-12)
    assert solved(water, load).norm(PETSc.NormType.NORM_INFINITY) <= ROUND_OFF


def test_the_mean_potential_over_the_water_is_zero(water: CoupledPencil) -> None:
    potential = solved(water, random_load(water, 3))
    assert abs(surface_load(water).dot(potential)) <= ROUND_OFF * potential.norm()


def wave_quotient(pencil: CoupledPencil, number: int) -> float:
    """<η, N η>/<η, η> of η = cos kx, k = nπ/L, which is exactly 1/(k tanh kH)."""
    wave = as_vector(pencil, lambda x: np.cos(number * pi * x[0] / LENGTH))
    # Cᵀψ takes any potential to ∫φψ: the surface part of the wave, against itself, is <η, η>.
    dofs = pencil.liquid.surface_dofs((pencil.surfaces[0].surface,))
    elevation = pencil.coupling.createVecRight()
    elevation.array[:] = wave.array_r[dofs]
    load, weighted = pencil.coupling.createVecLeft(), pencil.coupling.createVecRight()
    pencil.coupling.mult(elevation, load)
    pencil.coupling.multTranspose(wave, weighted)
    return float(load.dot(solved(pencil, load)) / elevation.dot(weighted))


@pytest.mark.parametrize("number", [1, 2, 5])
def test_a_surface_wave_has_its_exact_added_mass(water: CoupledPencil, number: int) -> None:
    # Interpolation by degree 8 in elements of h = 1/8 leaves (kh/4)^9/9!: 4e-9 for n = 5, squared in a quotient.
    # Measured 2e-13 and below.
    wavenumber = number * pi / LENGTH
    assert wave_quotient(water, number) == pytest.approx(1.0 / (wavenumber * tanh(wavenumber * DEPTH)), rel=1e-11)


@pytest.mark.slow_on_ranks_but
def test_long_waves_over_a_thin_layer_keep_their_digits(tanks: Any) -> None:
    """ω² = gk tanh kH over a depth of a hundredth of the length. Measured: 3e-13; 9e-12 where the cells' matrices leave
    a constant the energy of rounding."""
    scene = tanks.scene(depth=0.1)
    wavenumbers = pi * np.arange(1, 5) / 10.0
    exact = np.sqrt(9.81 * wavenumbers * np.tanh(0.1 * wavenumbers))
    assert tanks.omega(scene)[:4] == pytest.approx(exact, rel=2e-12)


def test_the_added_mass_of_a_wave_converges_exponentially_in_the_degree(tanks: Any) -> None:
    """The wave is smooth: each degree gains a factor of about (kh/2p)², which is 0.04 at degree 4 and falls on."""
    wavenumber = 4 * pi / LENGTH
    errors = []
    for degree in range(3, 8):
        pencil = tanks.pencil(tanks.scene(), degree=degree, size=0.125)
        errors.append(1.0 - wave_quotient(pencil, 4) * wavenumber * tanh(wavenumber * DEPTH))
    # The sizes: interpolation of the wave may err to either side.
    assert np.all(np.abs(errors[1:]) < 0.25 * np.abs(errors[:-1]))


def volumes(pencil: CoupledPencil) -> np.ndarray:
    return pencil.body_values(pencil.constraints[0].volume)


def test_heave_displaces_the_beams_length_and_no_other_shape_anything(beam: CoupledPencil) -> None:
    # The largest entry of C is about the length of an element; sums of some hundred such entries round to 1e-15.
    assert volumes(beam)[0] == pytest.approx(0.4, rel=1e-14)
    assert np.abs(volumes(beam)[1:]).max() <= 1e-14


def test_the_water_displaces_its_length(beam: CoupledPencil) -> None:
    assert beam.constraints[0].volume.sum() - volumes(beam).sum() == pytest.approx(0.6, rel=1e-13)


def exact_load(index: int, power: int, start: float, length: float) -> float:
    """∫φ s^power ds·l over the beam, s = 0 … 1, for an elastic shape, from φ'''' = b⁴φ and φ'' = φ''' = 0 at the ends.

    By parts, four times: b⁴∫φf = [φ'f'' − φf''']₀¹ + ∫φf'''' (derivatives with respect to s), and again for f''''.
    """
    root = free_free_wavenumber(index)
    ends = np.array([0.0, 1.0])
    value, slope = free_free_shape(index, ends), free_free_shape(index, ends, 1)
    total, factor, order = 0.0, 1.0, power
    while order >= 2:
        factor /= root**4
        second = order * (order - 1) * ends ** (order - 2)
        third = order * (order - 1) * (order - 2) * ends ** max(order - 3, 0) if order >= 3 else np.zeros(2)
        total += factor * float(np.diff(slope * second - value * third)[0])
        factor *= order * (order - 1) * (order - 2) * (order - 3)
        order -= 4
        if factor == 0.0:
            break
    return length * total


@pytest.mark.slow_on_ranks_but("3-60")
@pytest.mark.parametrize("index", [2, 3, 20, 59, 60, 61])
@pytest.mark.parametrize("power", [2, 3, 4, 5])
def test_loads_of_high_dry_modes_are_exact_on_coarse_elements(beam: CoupledPencil, index: int, power: int) -> None:
    """Against a polynomial of the elements' degree, which ψ represents; thirty waves lie in an element of 0.2.

    An integral that the quadrature missed would be of the size of ∫|φ| over an element, 0.2.
    """
    start, length = 0.3, 0.4
    polynomial = as_vector(beam, lambda x: ((x[0] - start) / length) ** power)
    loads = beam.coupling.createVecRight()
    beam.coupling.multTranspose(polynomial, loads)
    assert beam.body_values(loads)[index] == pytest.approx(exact_load(index, power, start, length), abs=1e-13)


@pytest.mark.slow_on_ranks_but("3-60")
@pytest.mark.parametrize("index", [2, 60, 61])
@pytest.mark.parametrize("power", [1, 3, 5])
def test_loads_on_a_single_element_are_exact(beam: CoupledPencil, index: int, power: int) -> None:
    """Sums over elements may hide errors that cancel. Powers of (x − 0.5)₊ live on the beam's right element alone.

    The reference is a rule of 400 points where thirty half waves need some forty. The mesher puts the node at 0.5 to
    1e-13, which changes the load by up to 1e-14.
    """
    on_beam = beam.liquid.tank.facets("body_1")
    assert beam.liquid.tank.mesh.comm.allreduce(len(on_beam)) == 2
    places, weights = np.polynomial.legendre.leggauss(400)
    x = 0.6 + 0.1 * places
    expected = 0.1 * (weights * free_free_shape(index, (x - 0.3) / 0.4)) @ (x - 0.5) ** power
    loads = beam.coupling.createVecRight()
    beam.coupling.multTranspose(as_vector(beam, lambda x: np.maximum(x[0] - 0.5, 0.0) ** power), loads)
    assert beam.body_values(loads)[index] == pytest.approx(expected, abs=2e-14)


def test_condensed_unknowns_inside_of_cells_follow_as_solved(tanks: Any) -> None:
    """Against the same matrix with all unknowns: the answer to one load, on the boundaries of cells and inside."""
    pencil = tanks.pencil(tanks.scene(tanks.beam()), degree=6, size=0.25)
    condensed = pencil.liquid
    liquid = replace(condensed, cells=CellMatrices(numbering=numbered(condensed.space, condensed=False)))
    load = as_vector(pencil, lambda x: x[0])
    moved = pencil.coupling.createVecRight()
    pencil.coupling.multTranspose(load, moved)
    pencil.coupling.mult(moved, load)
    matrix = laplace_matrix(liquid)
    whole, answer = matrix.createVecs()
    whole.array[condensed.numbering.owned_dofs] = load.array_r
    # The constant carries flux; its projection needs ∫q on each set of unknowns.
    surface = tuple(dict.fromkeys([one.surface for one in (*pencil.bodies, *pencil.surfaces)]))
    solver = LiquidSolver(
        matrix, constrained_dofs(liquid), (closed_layer(liquid, 0, surface_load_of(liquid, surface)),)
    )
    solver.solve(whole, answer)
    (expected,) = cell_values(liquid, [answer])
    (found,) = cell_values(condensed, [solved(pencil, load)])
    # The operator's condition times a double's rounding.
    assert np.abs(found - expected).max() <= ROUND_OFF * np.abs(expected).max()


def test_similar_triangles_share_their_matrices(tanks: Any) -> None:
    """Against each cell's own matrix, condensed: in the rings around both tips most cells are similar to others."""
    liquid = tanks.pencil(tanks.scene(tanks.beam()), degree=6, size=0.25).liquid
    numbering = liquid.numbering
    cells = np.arange(len(liquid.cells.laplace), dtype=np.int32)
    full = liquid.cells.integrals(cells, np.ones((len(cells), 1, 2)))
    laplace, extension = condensed(full, len(numbering.outside))
    different = len(np.unique(liquid.cells.laplace, axis=0))
    assert liquid.tank.mesh.comm.allreduce(different) < liquid.tank.cell_count
    assert liquid.cells.laplace == pytest.approx(laplace, rel=0.0, abs=1e-10 * np.abs(laplace).max(initial=0.0))
    assert liquid.cells.extension == pytest.approx(extension, rel=0.0, abs=1e-10)


def test_a_matrix_that_is_not_positive_definite_is_refused(water: CoupledPencil) -> None:
    matrix = water.laplace.copy()
    matrix.zeroRowsColumns([matrix.size[0] // 2], diag=0.0)
    with pytest.raises(EigenSolverError, match="not positive definite"):
        LiquidSolver(matrix, constrained_dofs(water.liquid), ())


def test_factors_that_were_given_back_are_made_again(water: CoupledPencil) -> None:
    solver = LiquidSolver(water.laplace, constrained_dofs(water.liquid), ())
    load = random_load(water, 1)
    before = solved(water, load, solver)
    solver.release()
    solver.release()
    after = solved(water, load, solver)
    after.axpy(-1.0, before)
    # The same factorization: rounding of sums over processes only.
    assert after.norm() <= 1e-12 * before.norm()
