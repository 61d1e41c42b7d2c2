"""The liquid's solution operator A⁺ and the loads on it, against closed forms."""

from __future__ import annotations

from collections.abc import Callable
from math import pi, tanh
from typing import Any

import numpy as np
import pytest
from dolfinx import fem
from petsc4py import PETSc

from hydroelastic.fem.liquid import LiquidSolver, closed_layer
from hydroelastic.fem.pencil import CoupledPencil
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
