"""High-frequency added masses: against source panels, published values, limits."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from section_panels import added_masses

from hydroelastic.modal.floats.rigid_limits import half_immersed_ellipse, interface_ellipse, section_heave_added_mass
from hydroelastic.modal.floats.thin_float import thin_float_added_mass
from hydroelastic.physics.profiles import float_profile

PANELS = 3e-4
"""Error of the extrapolated panels over the largest added mass; at most 1.0e-4 was measured in these tests."""


def graded(count: int) -> np.ndarray:
    """0 … 1, finer at both ends, where corners and the waterline are."""
    s = np.linspace(0, 1, count + 1)
    return s**3 * (10 - 15 * s + 6 * s**2)


def arc(half_width: float, height: float, start: float, end: float, count: int) -> np.ndarray:
    angle = start + (end - start) * graded(count)
    return half_width * np.cos(angle) + 1j * height * np.sin(angle)


def broken_line(corners: list[complex], count: int) -> np.ndarray:
    pieces = [a + (b - a) * graded(count)[:-1] for a, b in itertools.pairwise(corners)]
    return np.concatenate([*pieces, [corners[-1]]])


def ellipse_by_panels(b: float, h: float, below: float, above: float = 0.0) -> np.ndarray:
    """Extrapolated: flat panels on a curve err in proportion to their length, measured 2.0 per halving."""
    found = []
    for count in (150, 300):
        outline = arc(b, h, -np.pi, 0, count)
        if above:
            outline = np.concatenate([outline, arc(b, h, 0, np.pi, count)[1:]])
        found.append(added_masses(outline, below, above))
    return 2 * found[1] - found[0]


@pytest.mark.parametrize(("half_width", "draught"), [(1.0, 1.0), (1.0, 0.4), (0.3, 1.2)])
def test_half_immersed_ellipse(half_width: float, draught: float) -> None:
    exact = half_immersed_ellipse(half_width, draught, 1.2)
    found = ellipse_by_panels(half_width, draught, 1.2)
    scale = PANELS * max(exact.heave, exact.sway)
    assert found[0, 0] == pytest.approx(exact.heave, abs=scale)
    assert found[1, 1] == pytest.approx(exact.sway, abs=scale)
    assert found[2, 2] == pytest.approx(exact.roll, abs=scale)
    assert found[1, 2] == pytest.approx(exact.sway_roll, abs=scale)
    assert found[2, 1] == pytest.approx(exact.sway_roll, abs=scale)
    # Heave is symmetric, sway and roll are not.
    assert np.abs(found[0, 1:]).max() < 1e-10


@pytest.mark.parametrize("density_above", [0.2, 0.85, 0.999])
def test_ellipse_between_two_liquids(density_above: float) -> None:
    exact = interface_ellipse(0.5, 1.0, 1.0, density_above)
    found = ellipse_by_panels(0.5, 1.0, 1.0, density_above)
    scale = PANELS * exact.sway
    assert found[0, 0] == pytest.approx(exact.heave, abs=scale)
    assert found[1, 1] == pytest.approx(exact.sway, abs=scale)
    assert found[2, 2] == pytest.approx(exact.roll, abs=scale)
    assert found[1, 2] == pytest.approx(exact.sway_roll, abs=scale)


@pytest.mark.parametrize(("half_width", "half_height"), [(1.0, 1.0), (0.2, 1.0), (1.0, 0.3)])
def test_heave_of_wedge_and_rectangle(half_width: float, half_height: float) -> None:
    b, h = half_width, half_height
    corners = {"wedge": [-b, -1j * h, b], "rectangle": [-b, -b - 1j * h, b - 1j * h, b]}
    for shape, line in corners.items():
        exact = section_heave_added_mass(float_profile(shape, b, h), 1.3)
        found = added_masses(broken_line([complex(z) for z in line], 160), 1.3)[0, 0]
        # Singular sources at the corners; at most 2.2e-4 was measured.
        assert found == pytest.approx(exact, rel=5e-4)


def test_published_values() -> None:
    # Square in unbounded liquid 4.754 ρa² for the side 2a (Newman, "Marine Hydrodynamics", table 4.3), half of it here.
    square = section_heave_added_mass(float_profile("rectangle", 1.0, 1.0), 1.0)
    assert 2 * square == pytest.approx(4.754, abs=5e-4)
    # Half-immersed circle: heave πρa²/2, sway 4/π² of it.
    circle = half_immersed_ellipse(1.0, 1.0, 1.0)
    assert circle.heave == pytest.approx(math.pi / 2)
    assert circle.sway == pytest.approx(4 / math.pi**2 * math.pi / 2)
    assert circle.roll == 0
    # Plate of length l on the water: heave πρl²/8, pitch πρl⁴/256 (docs, theory of the aquarium, § 2).
    plate = half_immersed_ellipse(2.0, 0.0, 1.0)
    assert plate.heave == pytest.approx(math.pi / 8 * 16)
    assert plate.roll == pytest.approx(math.pi / 256 * 256)
    assert plate.sway == plate.sway_roll == 0


def test_thin_sections_approach_the_thin_float() -> None:
    # The theory's a∞ is the leading term in τ = b/h: exact for the ellipse, error O(τ ln τ) for the wedge.
    for shape, tolerance in (("ellipse", 1e-14), ("wedge", 5e-4)):
        profile = float_profile(shape, 1e-3, 1.0)
        thin = thin_float_added_mass(profile, 1.0, 0.7)
        assert section_heave_added_mass(profile, 1.0, 0.7) == pytest.approx(thin, rel=tolerance)
    coarse, fine = (
        section_heave_added_mass(float_profile("wedge", b, 1.0), 1.0) / (4 / math.pi * math.log(2) * b**2) - 1
        for b in (0.02, 0.01)
    )
    assert 1.7 < coarse / fine < 2.3


def test_roll_about_another_point() -> None:
    # The square of a combined motion: x = y_G sway + roll, and twice the shift is two shifts.
    found = half_immersed_ellipse(0.5, 1.0, 1.0)
    matrix = ellipse_by_panels(0.5, 1.0, 1.0)
    combined = np.array([0.0, 0.3, 1.0])
    assert found.about(0.3).roll == pytest.approx(combined @ matrix @ combined, rel=PANELS)
    assert found.about(0.3).sway_roll == pytest.approx(np.array([0.0, 1.0, 0.0]) @ matrix @ combined, rel=PANELS)
    assert found.about(0.1).about(0.2).roll == pytest.approx(found.about(0.3).roll, rel=1e-14)
