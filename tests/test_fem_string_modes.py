"""Modes of the hanging string against Bessel's functions and against a solver of its own."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from mpi4py import MPI
from numpy.polynomial import legendre
from scipy.linalg import eigvals
from scipy.special import j0, j1, jn_zeros
from string_closed_forms import FREQUENCIES, tip_frequencies

from hydroelastic.fem.string.damped_modes import damped_modes
from hydroelastic.fem.string.modes import string_modes, undamped_pairs
from hydroelastic.fem.string.pencil import build_string_pencil, string_nodes
from hydroelastic.meshes.line import graded_nodes, travel_nodes
from hydroelastic.physics.string import HangingString

COMM = MPI.COMM_WORLD
ENDS = np.array([0.0, 1.0])


def plain(**options: object) -> HangingString:
    """A string whose units are those of its dimensions."""
    return HangingString(**({"length": 1.0, "linear_density": 1.0, "gravity": 1.0} | options))  # type: ignore[arg-type]


def test_nodes_have_equal_travel_times() -> None:
    for bottom, slope in ((0.0, 1.0), (0.3, 0.7), (1.0, 1e-9), (1.0, 0.0), (1.0, -0.6)):
        nodes = travel_nodes(7, bottom, slope)
        speed = np.sqrt(bottom + slope * nodes)
        # The time over an element is its length over the mean of the speeds at its ends.
        times = np.diff(nodes) / (0.5 * (speed[1:] + speed[:-1]))
        np.testing.assert_allclose(times, times.mean(), rtol=1e-12)
        assert nodes[0] == 0.0
        assert nodes[-1] == 1.0


def test_grading_bounds_the_growth_of_the_tension() -> None:
    for bottom in (1e-8, 1e-3, 0.5):
        nodes = graded_nodes(travel_nodes(5, bottom, 1.0), bottom, 1.0)
        assert np.all(np.diff(nodes) > 0.0)
        assert np.max((bottom + nodes[1:]) / (bottom + nodes[:-1])) < 4.0 * (1.0 + 1e-9)
    # Entire where the tension vanishes at the end itself.
    np.testing.assert_array_equal(graded_nodes(travel_nodes(5, 0.0, 1.0), 0.0, 1.0)[:2], travel_nodes(5, 0.0, 1.0)[:2])


@pytest.mark.mpi
def test_first_twenty_frequencies_and_shapes() -> None:
    model = HangingString(length=2.5, linear_density=0.7)
    positions = np.linspace(0.0, 2.5, 9)
    modes = string_modes(COMM, model, 20, positions)
    exact = FREQUENCIES[:20] * np.sqrt(9.81 / 2.5)
    # Measured 1e-13; rounding of K is estimated as a few times that.
    np.testing.assert_allclose(modes.frequencies, exact, rtol=2e-12)
    assert np.all(np.abs(modes.frequencies - exact) <= 3.0 * modes.errors)
    assert np.all(modes.errors < 5e-12 * exact)
    for zero, shape in zip(jn_zeros(0, 20), modes.shapes, strict=True):
        # ∫J0² dx = J1(μ)².
        np.testing.assert_allclose(
            shape, j0(zero * np.sqrt(positions / 2.5)) / abs(j1(zero)), atol=1e-10 * abs(shape[0])
        )


@pytest.mark.parametrize(("elements", "degree"), [(3, 4), (6, 3), (4, 8), (8, 6), (10, 10)])
def test_error_estimates_are_not_below_a_third(elements: int, degree: int) -> None:
    count = min(6, elements * degree // 3)
    modes = string_modes(COMM, plain(), count, ENDS, elements=elements, degree=degree)
    errors = np.abs(modes.frequencies - FREQUENCIES[:count])
    assert np.all(errors <= 3.0 * modes.errors)
    # Where it is no rounding it is no more than twice the error.
    seen = errors > 1e-11
    assert np.all(modes.errors[seen] <= 2.0 * errors[seen])


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_order_of_eigenvalues_is_twice_the_degree(degree: int) -> None:
    counts = np.array([12, 18, 27, 40]) if degree < 3 else np.array([8, 12, 18, 27])
    errors = [lowest(degree, int(count))[2] - FREQUENCIES[2] ** 2 for count in counts]
    assert min(errors) > 0.0
    order = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
    assert order == pytest.approx(2 * degree, abs=0.15)


def test_eigenvalues_converge_exponentially_with_the_degree() -> None:
    errors = np.array([lowest(degree, 3)[2] - FREQUENCIES[2] ** 2 for degree in range(2, 8)])
    ratios = errors[1:] / errors[:-1]
    # Faster than any power: each degree gains more than the last one, from three to a hundredfold and more.
    assert np.all(ratios < 0.35)
    assert ratios[-1] < 0.02


def lowest(degree: int, elements: int) -> np.ndarray:
    string = plain()
    return undamped_pairs(build_string_pencil(COMM, string, degree, string_nodes(string, elements)), 3)[0]


def test_added_and_displaced_mass_are_another_gravity() -> None:
    model = plain(linear_density=2.0, added_mass=0.5, displaced_mass=0.3, resistance=(0.4, 0.4))
    gravity, damping = (2.0 - 0.3) / 2.5, 0.4 / 2.5
    exact = FREQUENCIES[:8] * np.sqrt(gravity)
    np.testing.assert_allclose(string_modes(COMM, model, 8, ENDS).frequencies, exact, rtol=2e-12)
    roots = damped_modes(COMM, model, 8, ENDS).roots
    np.testing.assert_allclose(roots, -damping + 1j * np.sqrt(exact**2 - damping**2), rtol=2e-12)


@pytest.mark.slow_on_ranks_but("0.1")
@pytest.mark.mpi
@pytest.mark.parametrize("tip", [1e-6, 1e-3, 0.1, 1.0, 30.0])
def test_tip_mass_against_its_characteristic_equation(tip: float) -> None:
    modes = string_modes(COMM, plain(tip_mass=tip), 8, ENDS)
    exact = tip_frequencies(8, tip=tip, hung=tip)
    # Measured 1e-12, from rounding of the graded elements.
    np.testing.assert_allclose(modes.frequencies, exact, rtol=1e-10)
    assert np.all(np.abs(modes.frequencies - exact) <= 3.0 * modes.errors)


def test_tip_mass_in_a_liquid() -> None:
    model = plain(tip_mass=0.5, tip_displaced_mass=0.2, displaced_mass=0.4, added_mass=0.25)
    exact = tip_frequencies(6, tip=0.5, hung=0.3, mass=1.25, slope=0.6)
    np.testing.assert_allclose(string_modes(COMM, model, 6, ENDS).frequencies, exact, rtol=1e-11)


def test_grading_is_needed_for_a_small_tip_mass() -> None:
    string = plain(tip_mass=1e-3)
    exact = tip_frequencies(3, tip=1e-3, hung=1e-3)
    errors = []
    for nodes in (travel_nodes(4, *string.tension), string_nodes(string, 4)):
        squares, _ = undamped_pairs(build_string_pencil(COMM, string, 8, nodes), 3)
        errors.append(np.max(np.abs(np.sqrt(squares) / exact - 1.0)))
    assert errors[1] < 1e-3 * errors[0]


@pytest.mark.parametrize("damping", [0.3, 2.0, 20.0])
def test_uniform_resistance_by_both_ways(damping: float) -> None:
    model = plain(resistance=(damping, damping))
    squares = FREQUENCIES[:60] ** 2
    root = np.sqrt(damping**2 - squares + 0j)
    over = root.imag == 0.0
    slow = -squares / (damping + root.real)
    exact = np.concatenate([np.where(over, slow, -damping + root), (-damping - root)[over]])
    exact = exact[np.argsort(np.abs(exact))][:12]
    for quadratic in (False, True):
        modes = damped_modes(COMM, model, 12, ENDS, quadratic=quadratic)
        np.testing.assert_allclose(modes.roots, exact, rtol=1e-11)
        assert np.all(np.abs(modes.roots - exact) <= 3.0 * modes.errors)


def test_next_to_a_double_root_sum_and_product_are_kept() -> None:
    damping = float(FREQUENCIES[0])
    model = plain(resistance=(damping, damping))
    for quadratic in (False, True):
        modes = damped_modes(COMM, model, 4, ENDS, quadratic=quadratic)
        first = modes.roots[:2] if modes.roots[0].imag == 0.0 else np.array([modes.roots[0], modes.roots[0].conj()])
        # p itself to the root of rounding only, as its estimate says.
        assert first.sum() == pytest.approx(-2.0 * damping, rel=1e-11)
        assert first.prod() == pytest.approx(damping**2, rel=1e-11)
        assert np.all(np.abs(first + damping) <= 3.0 * modes.errors[0])
        assert modes.errors[0] < 1e-5


@pytest.mark.slow_on_ranks_but("resistance0")
@pytest.mark.mpi
@pytest.mark.parametrize("resistance", [(0.0, 0.5), (0.6, 0.1), (4.0, 1.0), (0.2, 9.0)])
def test_linear_resistance_against_legendre_polynomials(resistance: tuple[float, float]) -> None:
    modes = damped_modes(COMM, plain(resistance=resistance, tip_mass=0.2), 10, ENDS)
    exact = legendre_roots(resistance, tip=0.2)
    exact = exact[exact.imag >= 0.0]
    exact = exact[np.argsort(np.abs(exact))][:10]
    # The dense companion matrix is good for 1e-10 only.
    np.testing.assert_allclose(modes.roots, exact, rtol=1e-9)
    assert np.all(np.diff(np.abs(modes.roots)) >= 0.0)
    assert all(modes.errors < 1e-9 * np.abs(modes.roots))


def legendre_roots(resistance: tuple[float, float], tip: float, size: int = 60) -> np.ndarray:
    """p of one polynomial P_n(2x − 1) − 1 after another over the whole string, by its companion matrix."""
    points, weights = legendre.leggauss(size + 10)
    x, weights = 0.5 * (points + 1.0), 0.5 * weights
    unit = np.eye(size + 1)[1:]
    values = np.array([legendre.legval(points, row) - 1.0 for row in unit])
    slopes = np.array([2.0 * legendre.legval(points, legendre.legder(row)) for row in unit])
    ends = np.array([legendre.legval(-1.0, row) - 1.0 for row in unit])
    mass = (values * weights) @ values.T + tip * np.outer(ends, ends)
    drag = (values * weights * 2.0 * (resistance[0] + (resistance[1] - resistance[0]) * x)) @ values.T
    stiffness = (slopes * weights * (tip + x)) @ slopes.T
    zero, one = np.zeros_like(mass), np.eye(size)
    return eigvals(np.block([[zero, one], [-stiffness, -drag]]), np.block([[one, zero], [zero, mass]]))


def test_weaker_resistance_below_shifts_frequencies_to_first_order() -> None:
    # δp = −φᵀCφ/(2φᵀMφ) of real shapes: no change of the frequency, and ∫2λφ²/2∫φ² of the decay.
    small = 1e-5
    modes = damped_modes(COMM, plain(resistance=(0.0, small)), 5, ENDS)
    x, weights = legendre.leggauss(80)
    x, weights = 0.5 * (x + 1.0), 0.5 * weights
    for root, zero in zip(modes.roots, jn_zeros(0, 5), strict=True):
        square = j0(zero * np.sqrt(x)) ** 2 * weights
        assert root.real == pytest.approx(-small * (square @ x) / square.sum(), rel=1e-5)
        assert root.imag == pytest.approx(0.5 * zero, rel=1e-9)


def test_tension_may_fall_upwards() -> None:
    # Lighter than the liquid, held down by its tip mass.
    model = plain(tip_mass=1.0, displaced_mass=1.9)
    first, second = (string_modes(COMM, model, 4, ENDS, elements=count).frequencies for count in (6, 12))
    np.testing.assert_allclose(first, second, rtol=1e-9)
    for lower, upper in pairwise(second):
        assert lower < upper
