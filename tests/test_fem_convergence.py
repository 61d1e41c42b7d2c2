"""Errors fall at the rates that theory gives, and refinement never harms."""

from __future__ import annotations

from math import log
from typing import Any

import numpy as np
import pytest

from hydroelastic.fem.modes import solve_modes
from hydroelastic.meshes.nested import halved
from hydroelastic.modal.liquid.sloshing import sloshing_frequencies
from hydroelastic.physics.tank import Tank
from hydroelastic.scenes.models.tank import TankScene


def values_on_halved_meshes(
    tanks: Any, scene: TankScene, *, degree: int, meshes: int, size: float, pressure_release: bool = False
) -> np.ndarray:
    """λ of the three lowest modes, shape (meshes, 3), each mesh half the size of the one before."""
    tank, tagged = tanks.graded_mesh(scene, size=size, tip_size=None)
    rows = []
    for _ in range(meshes):
        pencil = tanks.pencil_on(
            tanks.distribute(tagged), tank, degree=degree, shapes=24, pressure_release=pressure_release
        )
        rows.append(solve_modes(pencil, 3).eigenvalues)
        tagged = halved(tagged)
    return np.array(rows)


def fitted_order(errors: np.ndarray) -> float:
    """Slope of ln error against ln size where each size is half the one before, by least squares."""
    assert np.all(errors > 0.0)
    return float(-np.polyfit(np.arange(len(errors)) * log(2.0), np.log(errors), 1)[0])


def scaled_eigenvalues(omega: Any) -> np.ndarray:
    """λ in units of the tank of ω in the tank of base_s0, 10 m long."""
    return np.asarray(omega) ** 2 * 10.0 / 9.81


@pytest.mark.slow_but("2-*")
@pytest.mark.parametrize(("degree", "last"), [(1, 1.25e-3), (2, 2.9e-5), (3, 6.8e-6)])
def test_waves_beside_a_beam_converge_with_order_two_on_uniform_meshes(tanks: Any, degree: int, last: float) -> None:
    """ψ ~ r ln r at the tips: λ errs like h² ln h whatever the degree, and the logarithm bends the slope by 0.1.

    The lowest mode, in which the tips count for more than the waves' length.
    """
    case = tanks.cases["base_s0"]
    values = values_on_halved_meshes(tanks, tanks.case_scene("base_s0"), degree=degree, meshes=5, size=0.2)
    errors = values[:, 0] / scaled_eigenvalues(case["omega"][0]) - 1.0
    assert fitted_order(errors[1:]) == pytest.approx(2.0, abs=0.2)
    # Not only the slope: the error measured on elements of L/80, to a quarter.
    assert errors[-1] == pytest.approx(last, rel=0.25)


@pytest.mark.slow_but("2-0.1")
@pytest.mark.parametrize(("degree", "size"), [(2, 0.1), (3, 0.2)])
def test_pressure_release_converges_with_order_one_on_uniform_meshes(tanks: Any, degree: int, size: float) -> None:
    """ψ ~ r^{1/2} at the tips: λ errs like h, whatever the degree, once elements of few waves are left behind."""
    exact = scaled_eigenvalues(tanks.cases["base_s0"]["psi0"]["elastic_omega"])
    scene = tanks.case_scene("base_s0")
    values = values_on_halved_meshes(tanks, scene, degree=degree, meshes=5, size=size, pressure_release=True)
    assert fitted_order(values[1:, 0] / exact - 1.0) == pytest.approx(1.0, abs=0.15)


@pytest.mark.slow_but("2")
@pytest.mark.parametrize("degree", [1, 2, 3])
def test_smooth_waves_converge_with_twice_the_degree(tanks: Any, degree: int) -> None:
    """Without a body ψ is analytic: order 2p. The third mode has seven elements a wave at first, hence the margin."""
    exact = scaled_eigenvalues(sloshing_frequencies(10.0, 5.0, 9.81, 3))
    values = values_on_halved_meshes(tanks, tanks.scene(), degree=degree, meshes=5 if degree == 1 else 4, size=0.2)
    for mode in (1, 2):
        # Measured 2.0, 3.9 and 5.9. Five significant digits of 3e-10 are above rounding.
        assert fitted_order(values[-4:, mode] / exact[mode] - 1.0) == pytest.approx(2.0 * degree, abs=0.2)


@pytest.fixture(scope="module")
def on_graded_mesh(tanks: Any) -> Any:
    """ω/ω_reference − 1 of the eight lowest modes of base_s0, by degree and tip size."""
    scene = tanks.case_scene("base_s0")
    exact = scaled_eigenvalues(tanks.cases["base_s0"]["omega"])
    found: dict[tuple[int, float], np.ndarray] = {}

    def errors(degree: int, tip_size: float) -> np.ndarray:
        if (degree, tip_size) not in found:
            tank: Tank
            tank, tagged = tanks.graded_mesh(scene, size=0.1, tip_size=tip_size)
            # With 40 dry modes what the beam leaves out is below 1e-11.
            pencil = tanks.pencil_on(tanks.distribute(tagged), tank, degree=degree, shapes=40)
            found[degree, tip_size] = np.sqrt(solve_modes(pencil, 8).eigenvalues / exact) - 1.0
        return found[degree, tip_size]

    return errors


def test_errors_fall_exponentially_in_the_degree_on_graded_meshes(on_graded_mesh: Any) -> None:
    degrees = np.arange(3, 10)
    for mode in (0, 1, 3):
        logarithms = np.log10([on_graded_mesh(int(degree), 1e-7)[mode] for degree in degrees])
        slope, start = np.polyfit(degrees, logarithms, 1)
        # With rings of ratio 0.3 each degree gains a factor of ten, measured 9 to 12.
        assert -1.2 < slope < -0.8
        # Exponential and not algebraic: a straight line in p to half a digit over six digits.
        assert np.abs(start + slope * degrees - logarithms).max() < 0.5


@pytest.mark.slow_but("1e-06")
@pytest.mark.parametrize("tip_size", [1e-4, 1e-6, 1e-8])
def test_refinement_never_makes_an_answer_worse_than_1e_9(on_graded_mesh: Any, tip_size: float) -> None:
    """Rounding must not grow with the degree or towards the tips. A tip of 1e-4 itself leaves less than 1e-9."""
    for degree in (8, 9, 10):
        assert np.abs(on_graded_mesh(degree, tip_size)).max() <= 1e-9


@pytest.mark.slow
def test_more_dry_modes_never_make_an_answer_worse_than_1e_9(tanks: Any) -> None:
    """The stiffest of 120 shapes is 10⁷ times as stiff as the first: beams on the liquid's mesh would lose digits."""
    tank, tagged = tanks.graded_mesh(tanks.case_scene("base_s0"), size=0.1)
    mesh = tanks.distribute(tagged)
    exact = np.array(tanks.cases["base_s0"]["omega"])
    for shapes in (30, 60, 120):
        found = solve_modes(tanks.pencil_on(mesh, tank, degree=8, shapes=shapes), 8).eigenvalues
        assert np.abs(np.sqrt(found * 0.981) / exact - 1.0).max() <= 1e-9


def test_a_high_degree_without_rings_is_no_help(tanks: Any) -> None:
    """Guards the tests above: it is the rings that bring the digits."""
    scene = tanks.case_scene("base_s0")
    tank, uniform = tanks.graded_mesh(scene, size=0.1, tip_size=None)
    pencil = tanks.pencil_on(tanks.distribute(uniform), tank, degree=8, shapes=40)
    exact = scaled_eigenvalues(tanks.cases["base_s0"]["omega"][0])
    # Measured 2e-6; with rings 2e-10.
    assert solve_modes(pencil, 1).eigenvalues[0] / exact - 1.0 > 1e-7
