"""The liquid under the surface: operator, added masses, their limits and symmetries."""

import dataclasses
import itertools
import math

import numpy as np
import pytest
from base_beam import BASE

from hydroelastic.modal.beam.added_mass import cosine_cube_sum, deep_open_constant, lid_added_mass, shallow_added_mass
from hydroelastic.modal.beam.cosine_moments import cosine_moments
from hydroelastic.modal.beam.dry_modes import free_free_shape
from hydroelastic.modal.beam.gravity_added_mass import gravity_added_mass, gravity_tones
from hydroelastic.modal.beam.pressure_release import pressure_release_added_mass
from hydroelastic.modal.beam.surface_operator import surface_operator
from hydroelastic.modal.liquid.sloshing import (
    sloshing_frequencies,
)


def test_operator_has_the_eigenvalues_of_the_tank() -> None:
    # N cos kx = cos kx/(k tanh kH). 60 graded nodes a segment resolve ten cosines to 1e-11 (measured 3e-12);
    # a wrong image, depth term or weight shows at once.
    operator = surface_operator(dataclasses.replace(BASE, depth=1.0, start=1.0), [60, 60, 60])
    for number in range(1, 11):
        k = number * math.pi / 10.0
        wave = np.cos(k * operator.positions)
        response = operator.kernel @ (operator.weights * wave)
        np.testing.assert_allclose(response, wave / (k * math.tanh(k)), atol=1e-10)
    np.testing.assert_allclose(operator.kernel, operator.kernel.T, rtol=1e-12)
    assert operator.weights.sum() == pytest.approx(10.0, rel=1e-13)


def test_closed_moments_match_quadrature_even_at_the_resonance() -> None:
    # 400 Gauss points are exact to rounding; 1e-3 beside k = κ the quotient loses three digits, as the module says.
    nodes, weights = np.polynomial.legendre.leggauss(400)
    s, weights = (nodes + 1) / 2, weights / 2
    for index in (0, 1, 2, 3, 17):
        kappa = np.pi * abs(index - 0.5) / 4.0
        k = np.array([0.0, 1e-5, 0.3, 1.182510186215676, kappa, 1.0015 * kappa, 30.0])
        exact = 4.0 * np.cos(np.outer(k, 3.0 + 4.0 * s)) @ (weights * free_free_shape(index, s))
        np.testing.assert_allclose(cosine_moments(BASE, index, k), exact, atol=1e-11)


def test_cosine_cube_sum() -> None:
    # The tail after n terms is below 1/(2 n²) = 1.3e-11 at α = 0 and far less elsewhere.
    n = np.arange(1.0, 200001.0)
    for angle in (0.0, 1e-3, 0.5, 2.0, math.pi, 3.3, 6.0, 7.0, -1.0):
        assert cosine_cube_sum(angle) == pytest.approx(float(np.sum(np.cos(n * angle) / n**3)), abs=2e-11)
    # Exact: all terms of one sign alternate at π, and at 2π/3 those of multiples of three stand out; a few eps.
    zeta_3 = cosine_cube_sum(0.0)
    assert cosine_cube_sum(math.pi) == pytest.approx(-3 / 4 * zeta_3, rel=2e-15)
    assert cosine_cube_sum(2 * math.pi / 3) == pytest.approx(-4 / 9 * zeta_3, rel=2e-15)


@pytest.mark.parametrize("start", [0.0, 1e-4, 1.0, 5.999])
def test_lid_series_against_the_operator(start: float) -> None:
    # Two unrelated evaluations of the same form: n⁻³ series with its sum in closed form, and log quadrature.
    problem = dataclasses.replace(BASE, start=start)
    operator = surface_operator(problem, [0 if start == 0.0 else 64, 64, 64])
    for index in (1, 2, 3):
        load = np.zeros_like(operator.positions)
        load[operator.on_beam] = free_free_shape(index, operator.beam_coordinate)
        load *= operator.weights
        quadrature = problem.density * load @ operator.kernel @ load / problem.length
        assert lid_added_mass(problem, index) == pytest.approx(quadrature, rel=1e-11)


def test_gravity_added_mass_between_its_limits() -> None:
    # λ → 0 is the lid for a shape without volume; the first correction is O(λ).
    low = gravity_added_mass(BASE, 1e-7)
    assert low[2, 2] == pytest.approx(lid_added_mass(BASE, 2), rel=1e-8)
    assert low[1, 1] == pytest.approx(lid_added_mass(BASE, 1), rel=1e-7)
    # Heave at low frequency: the rest of the surface sinks, a negative spring −ρ g l/((L−l) λ).
    assert low[0, 0] * 1e-7 == pytest.approx(-1000 * 9.81 * 4.0 / 6.0, rel=1e-6)


def test_pressure_release_converges_exponentially() -> None:
    fine = pressure_release_added_mass(BASE, 3, 60)
    errors = [np.abs(pressure_release_added_mass(BASE, 3, terms) / fine - 1)[2, 2] for terms in (4, 6, 8, 10)]
    # Each pair of terms gains more than a factor 20 (measured 60 and more): not an algebraic rate.
    assert all(later < earlier / 20 for earlier, later in itertools.pairwise(errors))
    assert errors[-1] < 1e-8


def test_pressure_release_matrix_is_symmetric_and_positive() -> None:
    added = pressure_release_added_mass(dataclasses.replace(BASE, start=1.0), 12)
    np.testing.assert_allclose(added, added.T, rtol=0, atol=0)
    assert np.linalg.eigvalsh(added).min() > 0


def test_pressure_release_deep_and_shallow_limits() -> None:
    # Walls 100 l away act as images, O((l/L)²); the deep constant to 1e-4.
    open_water = dataclasses.replace(BASE, tank_length=400.0, start=198.0, depth=400.0)
    added = pressure_release_added_mass(open_water, 4)
    for index in (0, 1, 2, 3):
        assert added[index, index] / 4000 == pytest.approx(deep_open_constant(index), rel=2e-4)
    # Shallow: the flux of a shape without shear at its tips vanishes there, so the relative excess is O((H/l)²);
    # local rates measured 1.906, 1.955, 1.978 on the way to 2.
    excess = []
    depths = [0.2, 0.1, 0.05]
    for depth in depths:
        problem = dataclasses.replace(BASE, depth=depth)
        excess.append(pressure_release_added_mass(problem, 3)[2, 2] / shallow_added_mass(problem) - 1)
    assert np.polyfit(np.log(depths), np.log(excess), 1)[0] == pytest.approx(2.0, abs=0.1)
    assert 0 < excess[-1] < 2.2e-3


def test_heavy_rigid_beam_bobs_on_the_hydrostatic_spring() -> None:
    # m ≫ ρ l: heave² → ρ g L/((L−l) m), because the rest of the surface sinks, and pitch² → ρ g/m; the corrections
    # are O(ρ l/m) = 4e-5 in λ.
    heavy = dataclasses.replace(BASE, hydrostatic=True, mass_per_length=1e8, flexural_rigidity=1e10)
    squared = gravity_tones(heavy, (0, 1, 2), 1.0).squared_frequencies
    spring = 1000 * 9.81 / 1e8
    np.testing.assert_allclose(squared[:2], [spring, spring * 10 / 6], rtol=1e-4)
    floating = dataclasses.replace(heavy, hydrostatic=False)
    assert gravity_tones(floating, (0, 1, 2), 1.0).squared_frequencies[0] == pytest.approx(spring * 4 / 6, rel=1e-4)


def test_sloshing_limits() -> None:
    k = np.pi / 10 * np.arange(1, 6)
    np.testing.assert_allclose(sloshing_frequencies(10, 500, 9.81, 5), np.sqrt(9.81 * k), rtol=1e-14)
    # tanh x = x (1 − x²/3): with kH < 1.6e-3 the frequencies agree to 5e-7.
    np.testing.assert_allclose(sloshing_frequencies(10, 1e-3, 9.81, 5), k * np.sqrt(9.81 * 1e-3), rtol=5e-7)
