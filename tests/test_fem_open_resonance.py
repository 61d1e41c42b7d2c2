"""Complex resonances in open water: against multipoles, closed forms of thin floats, and an independent count."""

from __future__ import annotations

from math import inf
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from open_cases import (
    GRAVITY,
    RADIUS,
    SLOW,
    THIN_LIQUIDS,
    Scene,
    answer,
    circle,
    open_scene,
    radiation,
    section,
    slender,
    stored,
)

from hydroelastic.modal.floats.complex_moments import complex_wave_moment
from hydroelastic.modal.floats.infinite_draught import infinite_draught_float
from hydroelastic.modal.floats.open_float import open_float_estimate
from hydroelastic.modal.floats.thin_float import thin_constants
from hydroelastic.modal.floats.thin_float_radiation import natural_rate
from hydroelastic.physics.profiles import Profile, float_profile

CIRCLE = stored("open_circle.json")["resonance"]
SECTIONS = stored("open_sections.json")["cases"]
DEEP = THIN_LIQUIDS["deep"]


def resonance(scene: Scene, **asked: Any) -> SimpleNamespace:
    found = answer(scene, {"kind": "resonance"} | asked)
    assert found.status == "ok", found.summary["reasons"]
    (table,) = found.resonance
    return table


@pytest.mark.parametrize("tolerance", [1e-4, pytest.param(1e-6, marks=SLOW), pytest.param(1e-8, marks=SLOW)])
def test_circle(tolerance: float) -> None:
    table = resonance(circle(tolerance, "heave"), count=1)
    exact = complex(CIRCLE["omega"], -CIRCLE["gamma"]) * np.sqrt(GRAVITY / RADIUS)
    error = abs(table.omega[0] / exact - 1.0)
    assert error <= tolerance
    assert error <= 1.5 * table.relative_error[0]
    assert table.relative_error[0] <= tolerance
    assert table.labels == ["heave"]
    assert table.counted == 1
    assert table.residuals[0] <= 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("liquids", ["water", "deep"])
@pytest.mark.parametrize("shape", ["wedge", "parabola", "ellipse"])
def test_thin_floats(shape: Any, liquids: str) -> None:
    """In liquids without bed and lid, in which the theory has a resonance."""
    found = resonance(slender(shape, liquids, 1e-6), count=1)
    exact = open_float_estimate(float_profile(shape, 0.1 * RADIUS, RADIUS), THIN_LIQUIDS[liquids], []).resonance
    assert exact is not None
    # Measured: 4e-8 at the most, a tenth of the estimate or less.
    assert abs(found.omega[0] / exact - 1.0) <= 3e-7
    assert abs(found.omega[0] / exact - 1.0) <= found.relative_error[0] <= 1e-6


@SLOW
def test_what_thickness_does_to_an_ellipse() -> None:
    exact, thin = (
        resonance(slender("ellipse", "water", 1e-6, slenderness=0.1, boundary=boundary), count=1).omega[0]
        for boundary in ("exact", "thin")
    )
    # From multipoles of the ellipse at τ = 0.1, which were rounded to two digits.
    assert exact.real / thin.real - 1.0 == pytest.approx(-1.2e-3, abs=1e-4)
    assert exact.imag / thin.imag - 1.0 == pytest.approx(-3.4e-2, abs=1.5e-3)


@SLOW
def test_resonance_of_a_slender_float_is_a_peak() -> None:
    scene = slender("wedge", "water", 1e-6)
    omega = resonance(scene, count=1).omega[0]
    assert omega.imag < 0.0 < omega.real
    coefficients = radiation(scene, float(omega.real))
    # On the axis below a resonance of quality 14: K − ω²(M + H) ≈ −2iγω (M + a), with corrections of the order 1/Q.
    inertia = coefficients.inertia + coefficients.added_mass[0]
    assert -2.0 * omega.imag * inertia[0, 0] == pytest.approx(coefficients.radiation_damping[0, 0, 0], rel=0.1)
    natural = np.sqrt(coefficients.stiffness[0, 0] / inertia[0, 0])
    assert abs(omega) == pytest.approx(natural, rel=5e-3)


@SLOW
@pytest.mark.parametrize("number", [6, 7])
def test_section_rolls_and_heaves(number: int) -> None:
    # A trapezium and a triangle, each of a kind of its own: heave and, where it is stable, roll.
    table = resonance(section(SECTIONS[number], 1e-4), count=2, largest_damping=0.5)
    assert table.counted == len(table.omega) >= 1
    assert np.all(table.omega.imag < 0.0)
    assert set(table.labels) <= {"heave", "roll", "sway"}


def test_nothing_to_find_where_nothing_restores() -> None:
    found = resonance(circle(1e-3, "sway"))
    assert found.omega is None or not len(found.omega)
    assert found.counted == 0


def exponential(tail: float, tolerance: float) -> Scene:
    """Between two liquids, as wide as its decay length."""
    body = {"kind": "float", "shape": "exponential", "half_width": RADIUS, "half_height": RADIUS, "tail": tail}
    body |= {"at": "interface", "position": 5.0, "boundary": "thin", "motions": ["heave"]}
    liquids = tuple({"density": rho, "depth": inf} for rho in (DEEP.density_below, DEEP.density_above))
    return open_scene(body, liquids=liquids, tolerance=tolerance)


def damped(scene: Scene, count: int) -> SimpleNamespace:
    return resonance(scene, count=count, largest_damping=2.0)


def closed_form(profile: Profile, start: complex) -> complex:
    """The zero of D(z) of a thin float next to ω, also beyond the 130 degrees of `characteristic`: there R of the
    exponential is still exact, and κ runs below the pole −z² all the same."""
    constants, rate = thin_constants(profile), natural_rate(profile, DEEP)
    step = 0.03
    kappa = np.exp(step * np.arange(-2000, 2000) - 0.25j * np.pi)
    weights = step * kappa * complex_wave_moment(profile, kappa) ** 2

    def value(z: complex) -> complex:
        wave = complex_wave_moment(profile, np.array([-z * z]))[0]
        integral = (weights / (kappa + z * z)).sum() - 2j * np.pi * wave**2
        return complex(z * z * (1.0 + constants.coupling * integral) + constants.frequency_squared)

    z = 1j * (start / rate).conjugate()
    for _ in range(20):
        slope = (value(z * (1.0 + 1e-6)) - value(z * (1.0 - 1e-6))) / (2e-6 * z)
        z -= value(z) / slope
    return complex(1j * z.conjugate()) * rate


def assert_honest(found: SimpleNamespace, profile: Profile) -> None:
    """Measured at tolerances from 1e-3 to 1e-6, errors are 0.4 to 1.2 times the estimate, and far less near the axis,
    where they cancel by chance."""
    for omega, estimate in zip(found.omega, found.relative_error, strict=True):
        error = abs(omega / closed_form(profile, complex(omega)) - 1.0)
        assert error <= 1.5 * estimate
        assert -omega.imag < 0.7 * omega.real or estimate <= 4.0 * error


@pytest.mark.slow
def test_second_pole_of_the_exponential() -> None:
    tail = 1e-3
    found = damped(exponential(tail, 1e-3), count=6)
    profile = Profile(shape="exponential", half_width=RADIUS, half_height=RADIUS, tail=tail)
    infinite = infinite_draught_float(profile, DEEP)
    heave, second = infinite.resonances
    # The end moves both a little, and adds four that the float of infinite draught has not.
    assert found.omega[0] == pytest.approx(second, rel=infinite.cut)
    assert found.omega[1] == pytest.approx(heave, rel=infinite.cut)
    assert -found.omega[0].imag / found.omega[0].real == pytest.approx(1.31, abs=0.01)
    assert found.counted == len(found.omega) == 6
    assert found.residuals.max() <= 1e-9
    assert found.relative_error.max() <= 1e-3
    assert_honest(found, profile)


@pytest.mark.slow
def test_search_and_count_agree_on_a_circle() -> None:
    # Its sway has resonances beside those of the water around a circle that is held, poles of H.
    found = damped(circle(1e-4, "heave", "sway"), count=4)
    assert found.labels == ["heave", "sway", "heave", "sway"]
    assert found.counted == 5


@SLOW
@pytest.mark.parametrize(("tail", "tolerance"), [(1e-3, 1e-6), (1e-5, 1e-4)])
def test_second_pole_by_tails_and_tolerances(tail: float, tolerance: float) -> None:
    found = damped(exponential(tail, tolerance), count=2)
    profile = Profile(shape="exponential", half_width=RADIUS, half_height=RADIUS, tail=tail)
    infinite = infinite_draught_float(profile, DEEP)
    assert found.omega[0] == pytest.approx(infinite.resonances[1], rel=infinite.cut)
    assert_honest(found, profile)
