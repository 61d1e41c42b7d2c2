"""What a solution says of its own error, against errors that are known: by degree, by mesh, by dry modes left out."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from mpi4py import MPI

from hydroelastic.fem.modes import solve_modes
from hydroelastic.fem.spectral_error import cell_errors
from hydroelastic.fem.truncation import truncation_errors
from hydroelastic.modal.liquid.sloshing import sloshing_frequencies

# Below, rounding has a part in an error of λ (1e-13 (p/4)⁵ and less, with some room).
ROUNDING = 2e-11


def liquid_estimates(pencil: Any, count: int) -> tuple[np.ndarray, np.ndarray]:
    """λ of the lowest modes, and (λ_h − λ)/λ as estimated from ψ (collective)."""
    found = solve_modes(pencil, count)
    cells = cell_errors(pencil.liquid, [mode.potential for mode in found.modes])
    return found.eigenvalues, MPI.COMM_WORLD.allreduce(cells.sum(axis=1), op=MPI.SUM)


def assert_seen(estimates: np.ndarray, errors: np.ndarray, *, low: float, high: float) -> None:
    clear = errors > ROUNDING
    assert clear.any()
    ratios = (estimates / errors)[clear]
    assert low <= ratios.min(), ratios
    assert ratios.max() <= high, ratios


@pytest.mark.slow_on_ranks_but("0.25-5")
@pytest.mark.mpi
@pytest.mark.parametrize("degree", [4, 5, 6, 7])
@pytest.mark.parametrize("size", [0.25, 0.15])
def test_the_error_of_smooth_waves_is_seen(tanks: Any, degree: int, size: float) -> None:
    """Sloshing has a closed form; even and odd waves miss every other degree in some cells. Measured 1.7 to 15."""
    scene = tanks.scene()
    exact = (sloshing_frequencies(10.0, 5.0, 9.81, 6) / np.sqrt(9.81 / 10.0)) ** 2
    values, estimates = liquid_estimates(tanks.pencil(scene, degree=degree, size=size, tip_size=None), 6)
    assert_seen(estimates, values / exact - 1.0, low=1.0 / 3.0, high=30.0)


@pytest.mark.slow_but("base_s0-*")
@pytest.mark.parametrize("tip_size", [1e-6, None])
@pytest.mark.parametrize("degree", [4, 6, 8])
@pytest.mark.parametrize("name", ["base_s0", "offcentre_s0", "wide_0.9_s1"])
def test_the_error_at_tips_is_seen_with_rings_and_without(
    tanks: Any, name: str, degree: int, tip_size: float | None
) -> None:
    """Without rings r ln r leaves an error that falls like p⁻⁴ only. Measured 0.42 (degree 4 without rings) to 3.2."""
    case = tanks.cases[name]
    given = case["inputs"]
    exact = np.array(case["omega"]) ** 2 * given["L"] / given["g"]
    pencil = tanks.pencil(tanks.case_scene(name), degree=degree, shapes=60, size=0.08, tip_size=tip_size)
    values, estimates = liquid_estimates(pencil, 8)
    missing = truncation_errors(pencil.bodies, solve_modes(pencil, 8).elastic_amplitudes, values)
    assert_seen(estimates + missing, values / exact - 1.0, low=1.0 / 3.0, high=30.0)


@pytest.mark.slow_on_ranks_but("5")
@pytest.mark.mpi
@pytest.mark.parametrize("degree", [5, 9])
def test_the_error_where_the_water_has_no_weight_is_seen(tanks: Any, degree: int) -> None:
    """ψ ~ r^{1/2} on coarse elements is the hardest singularity there is. Measured 1.2 to 2.9."""
    case = tanks.cases["base_s0"]
    scene = tanks.scene(tanks.beam(), top="pressure_release")
    exact = np.array(case["psi0"]["omega"][:4]) ** 2 * 10.0 / 9.81
    values, estimates = liquid_estimates(tanks.pencil(scene, degree=degree, shapes=40, size=0.1, tip_size=None), 4)
    assert_seen(estimates, values / exact - 1.0, low=1.0 / 3.0, high=30.0)


@pytest.mark.slow_but("base_s0")
@pytest.mark.parametrize("name", ["base_s0", "narrow_s1", "wide_0.9_s1", "full_free_s0", "soft_s0", "paper_x1_0"])
def test_what_dry_modes_left_out_would_add_is_seen(tanks: Any, name: str) -> None:
    """λ with N dry modes against λ with 120 on the same mesh, which has the same error of the liquid."""
    scene = tanks.case_scene(name)
    tank, tagged = tanks.graded_mesh(scene, size=0.1, tip_size=1e-4)
    mesh = tanks.distribute(tagged)
    full = solve_modes(tanks.pencil_on(mesh, tank, degree=6, shapes=120), 8, shapes=0).eigenvalues
    for count in (16, 24, 32, 48):
        pencil = tanks.pencil_on(mesh, tank, degree=6, shapes=count)
        found = solve_modes(pencil, 8, shapes=0)
        errors = found.eigenvalues / full - 1.0
        estimates = truncation_errors(pencil.bodies, found.elastic_amplitudes, found.eigenvalues)
        # Measured 0.58 (wide_0.9_s1, where 24 shapes do not yet fall like n⁻⁸) to 8.1.
        if (errors > ROUNDING).any():
            assert_seen(estimates, errors, low=1.0 / 3.0, high=30.0)


def test_a_degree_too_low_to_judge_is_refused(tanks: Any) -> None:
    pencil = tanks.pencil(tanks.scene(), degree=3, tip_size=None)
    with pytest.raises(ValueError, match="degree 4"):
        cell_errors(pencil.liquid, [])
