"""Complex resonances in open water: against multipoles, closed forms of thin floats, and an independent count."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from mpi4py import MPI
from open_cases import GRAVITY, RADIUS, SLOW, THIN_LIQUIDS, circle, problem_of, radiation, section, slender, stored

from hydroelastic.fem.open_water import resonance as open_resonance
from hydroelastic.fem.open_water.requests import ResonanceRequest
from hydroelastic.fem.open_water.resonance import ResonanceSolution, solve_resonance
from hydroelastic.fem.open_water.solve import resonance_reasons
from hydroelastic.modal.floats.open_float import open_float_estimate
from hydroelastic.physics.profiles import float_profile
from hydroelastic.scenes.models.tank import TankScene

CIRCLE = stored("open_circle.json")["resonance"]
SECTIONS = stored("open_sections.json")["cases"]


def resonance(scene: TankScene, **asked: Any) -> ResonanceSolution:
    return solve_resonance(problem_of(scene), ResonanceRequest(**asked))


@pytest.mark.parametrize("tolerance", [1e-4, pytest.param(1e-6, marks=SLOW), pytest.param(1e-8, marks=SLOW)])
def test_circle(tolerance: float) -> None:
    found = resonance(circle(tolerance, "heave"), count=1)
    table = found.table
    exact = complex(CIRCLE["omega"], -CIRCLE["gamma"]) * np.sqrt(GRAVITY / RADIUS)
    error = abs(table.omega[0] / exact - 1.0)
    assert error <= tolerance
    assert error <= 1.5 * table.relative_error[0]
    assert table.relative_error[0] <= tolerance
    assert table.labels == ("heave",)
    assert table.counted == 1
    assert table.residuals[0] <= 1e-9
    assert not list(resonance_reasons(found))


@pytest.mark.slow
@pytest.mark.parametrize("liquids", THIN_LIQUIDS)
@pytest.mark.parametrize("shape", ["wedge", "parabola", "ellipse"])
def test_thin_floats(shape: Any, liquids: str) -> None:
    found = resonance(slender(shape, liquids, 1e-6), count=1).table
    exact = open_float_estimate(float_profile(shape, 0.1 * RADIUS, RADIUS), THIN_LIQUIDS[liquids], []).resonance
    assert exact is not None
    # Measured: 4e-8 at the most, a tenth of the estimate or less.
    assert abs(found.omega[0] / exact - 1.0) <= 3e-7
    assert abs(found.omega[0] / exact - 1.0) <= found.relative_error[0] <= 1e-6


@SLOW
def test_what_thickness_does_to_an_ellipse() -> None:
    exact, thin = (
        resonance(slender("ellipse", "water", 1e-6, slenderness=0.1, boundary=boundary), count=1).table.omega[0]
        for boundary in ("exact", "thin")
    )
    # From multipoles of the ellipse at τ = 0.1, which were rounded to two digits.
    assert exact.real / thin.real - 1.0 == pytest.approx(-1.2e-3, abs=1e-4)
    assert exact.imag / thin.imag - 1.0 == pytest.approx(-3.4e-2, abs=1.5e-3)


@SLOW
def test_angle_of_the_scaling_moves_no_resonance(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = circle(1e-6, "heave")
    base = resonance(scene, count=1).table.omega[0]
    monkeypatch.setattr(open_resonance, "ANGLE", 1.1)
    other = resonance(scene, count=1).table.omega[0]
    assert other != base
    assert other == pytest.approx(base, rel=1e-6)


@SLOW
def test_resonance_of_a_slender_float_is_a_peak() -> None:
    scene = slender("wedge", "water", 1e-6)
    omega = resonance(scene, count=1).table.omega[0]
    assert omega.imag < 0.0 < omega.real
    coefficients = radiation(scene, float(omega.real)).table
    # On the axis below a resonance of quality 14: K − ω²(M + H) ≈ −2iγω (M + a), with corrections of the order 1/Q.
    inertia = coefficients.inertia + coefficients.added_mass[0]
    assert -2.0 * omega.imag * inertia[0, 0] == pytest.approx(coefficients.radiation_damping[0, 0, 0], rel=0.1)
    natural = np.sqrt(coefficients.stiffness[0, 0] / inertia[0, 0])
    assert abs(omega) == pytest.approx(natural, rel=5e-3)


@SLOW
@pytest.mark.parametrize("number", [6, 7])
def test_section_rolls_and_heaves(number: int) -> None:
    # A trapezium and a triangle, each of a kind of its own: heave and, where it is stable, roll.
    found = resonance(section(SECTIONS[number], 1e-4), count=2, largest_damping=0.5)
    table = found.table
    assert not list(resonance_reasons(found))
    assert table.counted == len(table.omega) >= 1
    assert np.all(table.omega.imag < 0.0)
    assert set(table.labels) <= {"heave", "roll", "sway"}


def test_nothing_to_find_where_nothing_restores() -> None:
    scene = circle(1e-3).model_copy(update={"body": (circle(1e-3).body[0].model_copy(update={"motions": ("sway",)}),)})
    found = solve_resonance(problem_of(scene, MPI.COMM_SELF), ResonanceRequest())
    assert len(found.table.omega) == 0
    assert found.table.counted == 0
    assert not list(resonance_reasons(found))
