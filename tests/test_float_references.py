"""The references of floats and of two liquids are true: against closed forms, other methods, and themselves."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import surface_reference as surface
from float_added_mass import high_frequency_added_mass
from float_reference import reference_modes
from float_sections import section
from float_tanks import Fineness, float_tank

FOLDER = Path(__file__).parent / "reference"
FLOATS: dict[str, Any] = json.loads((FOLDER / "floats.json").read_text(encoding="utf-8"))["cases"]
BEAMS: dict[str, Any] = json.loads((FOLDER / "two_liquid_beams.json").read_text(encoding="utf-8"))["cases"]


def numbers(strings: list[str]) -> np.ndarray:
    return np.array([float(string) for string in strings])


def tank(length: float, *liquids: tuple[float, float], top: str) -> dict[str, Any]:
    return {
        "tank": {"length": length, "gravity": 9.81, "top": top},
        "liquid": [{"density": density, "depth": depth} for density, depth in liquids],
    }


def rigid(shape: str, position: float, width: float, height: float, **keys: Any) -> dict[str, Any]:
    return {"kind": "float", "shape": shape, "position": position, "half_width": width, "half_height": height} | keys


@pytest.mark.slow
@pytest.mark.parametrize("name", ["circle_off_centre", "wedge", "two_liquids_ellipse"])
def test_stored_floats_are_made_anew(name: str) -> None:
    """One of each kind; the others take ten minutes, and their digits are those of two finenesses."""
    modes = reference_modes(float_tank(FLOATS[name]["scene"]), 6, Fineness(corner=22, waves=70))
    # What is stored has the digits that two other finenesses share, ten at least.
    np.testing.assert_allclose(modes.omega, numbers(FLOATS[name]["omega"]), rtol=2e-10)


@pytest.mark.parametrize("name", FLOATS)
def test_floats_have_ten_digits(name: str) -> None:
    # Measured: 1.2e-11 for the parabola, 2e-12 at right angles, 1e-15 without submerged corners.
    assert FLOATS[name]["self_convergence"] <= 2e-11
    # Measured: 5e-11 for the parabola, whose panels end 1e-6 from its tips, 1e-12 without submerged corners.
    assert FLOATS[name]["agreement"] is None or FLOATS[name]["agreement"] <= 1e-10


@pytest.mark.parametrize("name", BEAMS)
def test_beams_have_eleven_digits(name: str) -> None:
    # Measured: 9e-12 and 3e-12 where λ spans five decades (full_cover), 1e-13 and 4e-15 else.
    assert max(BEAMS[name]["self_convergence"].values()) <= 2e-11
    assert BEAMS[name]["agreement"] is None or BEAMS[name]["agreement"] <= 1e-11


def test_two_free_levels_obey_their_dispersion_relation() -> None:
    """(ρ₂ coth kh₂ coth kh₁ + ρ₁) λ² − ρ₂ gk (coth kh₁ + coth kh₂) λ + (ρ₂ − ρ₁) g²k² = 0 (Lamb, § 231)."""
    scene = tank(1.0, (1000.0, 0.3), (850.0, 0.2), top="free") | {"body": []}
    wavenumbers, g = np.pi * np.arange(1, 9), 9.81
    below, above = 1.0 / np.tanh(0.3 * wavenumbers), 1.0 / np.tanh(0.2 * wavenumbers)
    squares = 1000.0 * below * above + 850.0
    middle, last = 1000.0 * g * wavenumbers * (below + above), 150.0 * (g * wavenumbers) ** 2
    root = np.sqrt(middle**2 - 4.0 * squares * last)
    expected = np.sqrt(np.sort(np.concatenate([(middle - root), (middle + root)]) / np.tile(2.0 * squares, 2))[:8])
    np.testing.assert_allclose(reference_modes(float_tank(scene), 8).omega, expected, rtol=1e-13)


@pytest.mark.slow
def test_thin_floats_are_those_of_the_series() -> None:
    """A parabola and a wedge amid a box, to which a series in cosines gives 18 digits; their flux is symmetric."""
    box = tank(12.0, (1.0, 2.0), (0.8, 1.5), top="rigid") | {
        "body": [rigid("parabola", 6.0, 0.1, 1.0, boundary="thin")]
    }
    modes = reference_modes(float_tank(box), 8)
    symmetric = [0.63162177521778065, 1.02341384544808389, 1.2346058274144639, 1.32795651393963655]
    # Measured 3e-13 for waves of this tank, 12 times longer than its float.
    np.testing.assert_allclose(modes.omega[[1, 3, 5, 7]], symmetric, rtol=1e-12)
    masses = [25.4801467762671, 4.47566291495407, 0.411530878903539, 1.00905914845144]
    np.testing.assert_allclose(modes.modal_masses[0, [1, 3, 5, 7]], masses, rtol=1e-8)
    box = tank(6.0, (1.0, 1.0), top="free") | {"body": [rigid("wedge", 3.0, 0.05, 0.5, boundary="thin")]}
    symmetric = [2.79076548369819506, 4.40413471841151785, 5.44295338557233661, 6.11362518488795165]
    np.testing.assert_allclose(reference_modes(float_tank(box), 8).omega[1::2], symmetric, rtol=1e-12)


@pytest.mark.slow
def test_added_mass_of_half_immersed_ellipses() -> None:
    """π/2 (ρ₁ + ρ₂) l² in heave in unbounded liquids; two layers of one depth are one liquid of density ρ₁ + ρ₂."""
    body = {"body": [rigid("ellipse", 20.0, 0.1, 0.2)]}
    two = float_tank(tank(40.0, (1000.0, 20.0), (800.0, 20.0), top="rigid") | body)
    one = float_tank(tank(40.0, (1800.0, 20.0), top="free") | body)
    (heave,), (alone,) = (high_frequency_added_mass(each).matrix.ravel() for each in (two, one))
    # Walls at a distance d are felt like ((l + h)/d)², 1e-4 here.
    assert heave == pytest.approx(np.pi / 2 * 1800.0 * 0.1**2, rel=1.2e-4)
    assert heave == pytest.approx(alone, rel=1e-9)


@pytest.mark.slow
def test_roll_of_a_circle_is_sway_of_its_centre() -> None:
    """A circle does not push the liquid when it turns about its own centre."""
    matrix = high_frequency_added_mass(float_tank(FLOATS["circle_off_centre"]["scene"])).matrix
    arm = -0.1
    np.testing.assert_allclose(matrix[2], arm * matrix[1], rtol=1e-11)


def test_hydrostatics_of_a_cut_rectangle() -> None:
    """A box of 0.8 × 0.4 with 192 kg between 1000 and 200 kg/m³, off-centre: all by hand."""
    shape = rigid("rectangle", 1.0, 0.4, 0.2, mass=192.0, centre_of_mass=0.05, radius_of_gyration=0.3)
    part = section(shape, (1000.0, 200.0), 9.81)
    # 1000 · 0.8 d + 200 · 0.8 (0.4 − d) = 192: d = 0.2, with centres of buoyancy at ∓0.1.
    assert part.mass == pytest.approx(192.0)
    assert part.inertia == pytest.approx(192.0 * 0.09)
    moment = 9.81 * (1000.0 * 0.16 * (-0.1 - 0.05) + 200.0 * 0.16 * (0.1 - 0.05))
    expected = [800.0 * 9.81 * 0.8, 800.0 * 9.81 * 0.8**3 / 12 + moment]
    np.testing.assert_allclose(np.diag(part.stiffness)[[0, 2]], expected, rtol=1e-12)


@pytest.mark.parametrize("name", ["oil_and_water", "without_a_beam"])
def test_two_liquids_under_a_lid_are_those_of_an_older_reference(name: str) -> None:
    """Eight digits, by Ritz's method on the interface in cosines."""
    older = {
        "oil_and_water": [1.2657389, 2.145503, 2.7050183, 3.3636479, 3.6336618, 4.3440594, 4.4899407, 5.1803849],
        "without_a_beam": [1.2659905, 2.1252356, 2.7037451, 3.151093, 3.531525, 3.8711132, 4.1820344, 4.471009],
    }
    np.testing.assert_allclose(numbers(BEAMS[name]["omega"]), older[name], rtol=4e-8)


@pytest.mark.slow
def test_values_come_from_above() -> None:
    scene = FLOATS["rectangle"]["scene"]
    coarse = reference_modes(float_tank(scene), 6, Fineness(corner=8, inner=8, waves=30, powers=0)).omega
    above = coarse / numbers(FLOATS["rectangle"]["omega"]) - 1.0
    assert above.min() > 0.0
    assert above.max() < 1e-2


def test_waves_on_two_layers() -> None:
    """λ = (ρ₂ − ρ₁) gk/(ρ₁ coth kh₁ + ρ₂ coth kh₂), of which the surface reference is made."""
    given = surface.ReferenceTank(depth=0.3, beams=(), upper=(0.85, 0.02))
    wavenumbers = np.pi * np.arange(1, 11)
    expected = 0.15 * wavenumbers / (1.0 / np.tanh(0.3 * wavenumbers) + 0.85 / np.tanh(0.02 * wavenumbers))
    np.testing.assert_allclose(surface.reference_modes(given, 10).eigenvalues, expected, rtol=1e-13)
    assert surface.layer_wavenumber(expected[4], given.layers) == pytest.approx(wavenumbers[4], rel=1e-12)
