"""Solids of revolution in the sea and in round tanks, and canals: results, closed forms of tanks, theories beside."""

from __future__ import annotations

import json
from math import pi, sqrt, tanh
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from open_cases import answer, in_dataset, sea

import hydroelastic as he

SHIPPED = Path(__file__).parent.parent / "results" / "shipped"
CYLINDER: dict[str, Any] = {"kind": "float", "shape": "cylinder", "radius": 1.0, "draught": 1.0}


def modes_of(tolerance: float, modes: int, **keys: Any) -> he.Result:
    return he.solve({"kind": "tank", "accuracy": {"modes": modes, "tolerance": tolerance}} | keys)


def test_the_capture_width_is_the_power_of_the_damper_over_that_of_a_metre_of_crest() -> None:
    """½Bω²|ξ|² over ½ρg c_g of deep water, c_g = g/(2ω)."""
    omega, damping = 2.0, 4e3
    scene = sea(CYLINDER | {"motions": ["heave"]}, attachment=[{"damping": [damping, 0.0, 0.0]}], tolerance=1e-2)
    (table,) = answer(scene, {"kind": "response", "omega": [omega]}).response
    taken = damping * omega**2 * abs(table.amplitudes[0, 0, 0]) ** 2
    # The same motion, so that rounding is left.
    assert table.capture_width[0, 0] == pytest.approx(taken / (1000.0 * 9.81**2 / (2.0 * omega)), rel=1e-9)


def test_theories_and_statics_stand_beside_the_field() -> None:
    scene = sea(CYLINDER | {"motions": ["heave", "surge"]}, depth=10.0, tolerance=1e-3)
    found = answer(scene, {"kind": "radiation", "omega": [1.0]}, {"kind": "response", "omega": [1.0]})
    (response,) = found.response
    assert response.reflection is None
    # A floating body without damping absorbs nothing; it scatters to all sides.
    assert response.capture_width == [[0.0]]
    orders = np.where(np.arange(response.partial_waves.shape[-1]) == 0, 1.0, 2.0)
    power = 4.0 / response.wavenumbers[0, 0] * (np.abs(response.partial_waves[0, 0, 0]) ** 2 @ orders)
    assert response.scattering_width[0, 0] == pytest.approx(power)
    angles = np.asarray(found.result.dataset.scattering_angle)
    around = in_dataset(found.result, "directional_scattering", wave_direction=0.0).ravel()
    # The trapezoidal rule is exact of a few orders, over both sides.
    assert 2.0 * np.trapezoid(around, angles) == pytest.approx(power, rel=1e-12)
    # ρgπ of long waves, the displaced mass, MacCamy and Fuchs' force over the draught: at Ka = 0.1 too large, so that
    # their squares, the dampings, are 1.42 and 1.59 times those of the field.
    rows = found.summary["estimates"]["round_body"]["rows"]
    assert rows[0]["theory"] == pytest.approx(9810.0 * pi)
    assert rows[2]["theory"] == pytest.approx(1000.0 * pi)
    np.testing.assert_allclose([row["difference"] for row in rows], [0.193, 0.424, 0.631, 0.262, 0.592], atol=2e-3)
    # m = ρπ; c33 = ρgπ; c55 = ρgπ(1/4 − 1/2), of a homogeneous cylinder as high above the water as below it.
    text = str(found.result)
    assert "a, kg" in text
    assert f"{-9810.0 * pi / 4:.6g}" in text


@pytest.mark.slow
def test_results_of_round_plates_have_strain_and_every_order() -> None:
    body = {"kind": "plate", "outline": "ring", "radius": 2.0, "inner_radius": 0.5, "youngs_modulus": 1e7}
    scene = sea(body | {"thickness": 0.05, "density": 500.0}, depth=10.0, tolerance=1e-3)
    (table,) = answer(scene, {"kind": "response", "omega": [2.0], "positions": 20}).response
    assert table.dofs[:2] == ["heave", "pitch"]
    assert {"elastic 0-1", "elastic 1-1", "elastic 4-1"} <= set(table.dofs)
    (plate,) = table.plates
    assert (plate.positions[0], plate.positions[-1]) == (-2.0, 2.0)
    # σ = E ε/(1 − ν) at most, where both principal strains are alike, and E ε/(1 + ν) at least.
    assert 1e7 / 1.3 < plate.largest_stress[0, 0] / plate.largest_strain[0, 0] < 1e7 / 0.7


def test_a_round_tank_with_a_float_or_a_bed_is_solved_by_order() -> None:
    tank = {"radius": 3.0, "outline": [[0.0, -3.0], [3.0, -1.0]]}
    keys = {"tank": tank, "liquid": [{"density": 1000.0, "depth": 3.0}], "body": [CYLINDER]}
    modes = modes_of(1e-3, 4, **keys).summary["modes"]
    assert [mode["order"] for mode in modes] == [1, 0, 2, 3]
    assert [mode["multiplicity"] for mode in modes] == [2, 1, 2, 2]
    assert modes[1]["kind"] == "heave"


@pytest.mark.parametrize(
    ("outline", "wrong"),
    [
        ([[0.0, -3.0], [2.0, -1.0]], "from the axis to the wall"),
        ([[0.0, -2.0], [3.0, -1.0]], "lowest corner"),
    ],
)
def test_a_bed_that_does_not_fit_is_refused(outline: list[list[float]], wrong: str) -> None:
    tank = {"radius": 3.0, "outline": outline}
    with pytest.raises(he.SceneError, match=wrong):
        he.read({"kind": "tank", "tank": tank, "liquid": [{"density": 1000.0, "depth": 3.0}]})


def test_a_tank_of_one_section_over_a_width_is_solved_by_order() -> None:
    """A V canal of 45 degrees: ω² = g/H across, (gk/√2) tanh(kH/√2) along."""
    bed = [[0.0, 0.0], [2.0, -2.0], [4.0, 0.0]]
    keys = {"tank": {"length": 4.0, "width": 7.0, "outline": bed}, "liquid": [{"density": 1000.0, "depth": 2.0}]}
    summary = modes_of(1e-4, 3, **keys).summary
    modes, (exact,) = summary["modes"], summary["exact"]
    assert exact["order"] == 1
    assert abs(exact["difference"]) < 1e-6
    k = pi / 7.0 / 2.0**0.5
    assert [mode["order"] for mode in modes] == [1, 0, 2]
    assert {mode["multiplicity"] for mode in modes} == {1}
    # Both ψ are smooth.
    assert modes[0]["omega"] == pytest.approx((9.81 * k * tanh(2.0 * k)) ** 0.5, rel=1e-6)
    assert modes[1]["omega"] == pytest.approx((9.81 / 2.0) ** 0.5, rel=1e-6)


@pytest.mark.parametrize("top", ["free", "rigid"])
def test_two_liquids_in_a_box_are_solved_by_order(top: str) -> None:
    """Lamb, Hydrodynamics, § 231: with b = ω²/gk, (ρ₂c₁c₂ + ρ₁)b² − ρ₂(c₁ + c₂)b + ρ₂ − ρ₁ = 0, or
    (ρ₂c₂ + ρ₁c₁)b = ρ₂ − ρ₁ under a lid, cᵢ = coth khᵢ."""
    two = [{"density": 1000.0, "depth": 0.7}, {"density": 800.0, "depth": 0.5}]
    result = modes_of(1e-6, 5, tank={"length": 2.0, "width": 1.0, "top": top}, liquid=two)
    exact = []
    for along, across in ((1, 0), (2, 0), (0, 1), (1, 1), (2, 1), (3, 0), (0, 2)):
        k = pi * np.hypot(along / 2.0, across)
        above, below = 1.0 / np.tanh(0.5 * k), 1.0 / np.tanh(0.7 * k)
        free = [1000.0 * above * below + 800.0, -1000.0 * (above + below), 200.0]
        covered = [1000.0 * below + 800.0 * above, -200.0]
        exact += [(9.81 * k * ratio) ** 0.5 for ratio in np.roots(free if top == "free" else covered)]
    found = [mode["omega"] for mode in result.summary["modes"]]
    np.testing.assert_allclose(found, np.sort(exact)[:5], rtol=1e-6)


@pytest.mark.slow
def test_without_waves_across_a_section_of_finite_width_is_the_plane() -> None:
    body = {"kind": "float", "shape": "rectangle", "half_width": 0.5, "half_height": 0.4, "position": 1.2}
    keys = {"liquid": [{"density": 1000.0, "depth": 2.0}], "body": [body]}
    wide, plane = (
        modes_of(1e-6, 5, tank=tank, **keys).summary["modes"]
        for tank in ({"length": 4.0, "width": 2.5}, {"length": 4.0})
    )
    found = [mode["omega"] for mode in wide if mode["order"] == 0]
    known = [mode["omega"] for mode in plane]
    assert len(found) >= 2
    # Both to 1e-6.
    np.testing.assert_allclose(found, known[: len(found)], rtol=2e-6)


def test_the_shipped_spar_heaves_with_the_water_of_its_plate() -> None:
    """Added mass of a disc with a column upon it, as naval architects estimate it: L. Tao et al., J. Sound Vib. 302."""
    stored = json.loads((SHIPPED / "spar" / "summary.json").read_text(encoding="utf-8"))
    disc, column, density = 20.0, 8.0, 1025.0
    z = sqrt(disc**2 - column**2) / pi
    added = density / 12.0 * (2.0 * disc**3 + 3.0 * pi * (disc**2 - column**2) * z - (pi * z) ** 3)
    heave = complex(*stored["resonance"][0]["omega"][0])
    mass = density * pi * (40.0 * 4.0**2 + 10.0**2)
    stiffness = density * 9.81 * pi * 4.0**2
    # The estimate is of a thin plate far from the surface; the radiated waves are weak, |ω| that of the undamped spar.
    assert abs(heave) == pytest.approx(sqrt(stiffness / (mass + added)), rel=0.03)
