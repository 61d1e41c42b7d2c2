"""The references of open water are true: against published values, energy, limits, other methods, and themselves."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import open_circle
import pytest
from open_levels import Level, one_liquid
from open_plates import Plate, Segment, plate_of, rigid_radiation, scattering
from open_sections import Water, section_answer
from open_two_liquids import TwoLiquids
from scipy.optimize import brentq

FOLDER = Path(__file__).parent / "reference"


def stored(name: str) -> dict[str, Any]:
    content: dict[str, Any] = json.loads((FOLDER / name).read_text(encoding="utf-8"))
    return content


def some_slow(rows: list[dict[str, Any]], fast: set[int]) -> list[Any]:
    marks = [[] if number in fast else [pytest.mark.slow] for number in range(len(rows))]
    return [
        pytest.param(row, marks=mark, id=str(number + 1))
        for number, (row, mark) in enumerate(zip(rows, marks, strict=True))
    ]


PUBLISHED = stored("open_water.json")
CIRCLE = stored("open_circle.json")
PLATES = stored("open_plates.json")
TWO_LIQUIDS = stored("open_two_liquids.json")
SECTIONS = stored("open_sections.json")


@pytest.mark.slow_but("Ka=0.15", "Ka=2.5")
@pytest.mark.parametrize("row", PUBLISHED["cylinder"]["rows"], ids=lambda row: f"Ka={row['Ka']}")
def test_circle_as_published(row: dict[str, Any]) -> None:
    heave, sway = (open_circle.radiation(row["Ka"], motion, 80).impedance for motion in open_circle.MOTIONS)
    found = [heave.real, heave.imag, sway.real, sway.imag]
    # The rows have an absolute error of 1e-6; measured: 1.4e-7.
    np.testing.assert_allclose(
        found, [row[key] for key in ("heave_a", "heave_b", "sway_a", "sway_b")], rtol=0, atol=3e-7
    )


@pytest.mark.slow_but("Ka=0.01", "Ka=1.1")
@pytest.mark.parametrize("row", CIRCLE["radiation"], ids=lambda row: f"Ka={row['Ka']}")
def test_stored_circle_is_made_anew(row: dict[str, Any]) -> None:
    assert row["error"] <= 3e-12
    for motion in open_circle.MOTIONS:
        result = open_circle.radiation(row["Ka"], motion, 160)
        # Measured: 2e-10 at Ka = 10 (sway).
        assert result.impedance == pytest.approx(complex(row[f"{motion}_a"], row[f"{motion}_b"]), abs=1e-9)
        # The waves carry what the motion loses.
        assert result.impedance.imag == pytest.approx(result.flux_damping, abs=1e-9)


def test_circle_at_high_frequency() -> None:
    # ψ = 0 on the water: a' = 1 and 4/π²; the next term is of the order 1/Ka.
    heave, sway = (open_circle.radiation(400.0, motion, 400).impedance for motion in open_circle.MOTIONS)
    assert heave.real == pytest.approx(1.0, abs=2 / 400)
    assert sway.real == pytest.approx(4 / math.pi**2, abs=2 / 400)


def test_circle_at_low_frequency() -> None:
    # a' + (8/π²) ln Ka tends to a constant, like Ka ln² Ka.
    sums = [
        open_circle.radiation(ka, "heave", 40).impedance.real + 8 / math.pi**2 * math.log(ka) for ka in (1e-6, 1e-5)
    ]
    assert sums[0] == pytest.approx(sums[1], abs=1e-3)


def test_resonance_of_the_circle() -> None:
    resonance = CIRCLE["resonance"]
    found = open_circle.resonance(80)
    assert found == pytest.approx(complex(resonance["omega"], -resonance["gamma"]), abs=1e-10)


@pytest.mark.slow
def test_released_circle() -> None:
    times, values = np.array(CIRCLE["release"]["t"]), np.array(CIRCLE["release"]["s"])
    found = open_circle.release(np.concatenate([[0.0, 0.02], times]), 32)
    # Measured with 32 multipoles: 8e-10. s(0) = 1 is the energy balance, s''(0) = −c/(m + a(∞)) = −2/π.
    np.testing.assert_allclose(found[2:], values, rtol=0, atol=5e-9)
    assert found[0] == pytest.approx(1.0, abs=5e-9)
    assert (found[1] - 1) * 2 / 0.02**2 == pytest.approx(-2 / math.pi, abs=1e-4)
    # Ursell 1964: −(4/π)/t², the next term is of the order ln t/t⁴.
    assert values[-1] * times[-1] ** 2 == pytest.approx(-4 / math.pi, rel=1e-3)


@pytest.mark.slow
def test_release_is_its_resonance_and_its_tail() -> None:
    omega = open_circle.resonance(80)
    slope = (_deficit_of_release(omega + 1e-4) - _deficit_of_release(omega - 1e-4)) / 2e-4
    times = np.array([10.0, 20.0, 30.0])
    # The residue of c/(ω D(ω)), D = c − ω²(1 + h), at both resonances ±ω − iγ; the rest is the algebraic tail.
    oscillation = -2 * np.real(4 / math.pi / (omega * slope) * np.exp(-1j * omega * times))
    rest = open_circle.release(times, 32) - oscillation
    np.testing.assert_allclose(rest * times**2, -4 / math.pi, rtol=1e-3)


def _deficit_of_release(omega: complex) -> complex:
    return 4 / math.pi - omega**2 * (1 + open_circle.radiation(omega**2, "heave", 80).impedance)


def wave_series(level: Level, rates: np.ndarray, x: np.ndarray) -> np.ndarray:
    """c Q(x) as the sum of its residues, waves and evanescent modes, which the kernel does not use."""

    circle = 1e-3 * np.exp(2j * math.pi * np.arange(32) / 32)
    steps = rates[:, None] * circle
    residues = np.mean(steps / (level.stiffness - level.symbol(1j * rates[:, None] + steps)), axis=1)
    k = np.concatenate([level.wave_numbers, 1j * rates])
    strengths = np.concatenate([level.residues, residues])
    return np.asarray(1j * level.stiffness * np.exp(1j * np.outer(x, k)) @ strengths)


def test_kernel_of_one_liquid_is_its_series() -> None:
    level = one_liquid(4.0, density=1000.0, depth=1.3)
    ends = np.arange(1, 80) * math.pi / 1.3
    rates = [brentq(lambda k: level.deep / math.tan(1.3 * k) + k, end - 1.2, end - 1e-9, xtol=1e-14) for end in ends]
    x = np.array([0.8, 2.5, 6.0])
    # Measured: 1e-14.
    np.testing.assert_allclose(level.kernel(6.0)(x), wave_series(level, np.array(rates), x), rtol=0, atol=1e-12)


@pytest.mark.parametrize("lid", [True, False])
@pytest.mark.parametrize("ratio", [0.5, 0.9])
def test_kernel_of_two_liquids_is_its_series(ratio: float, lid: bool) -> None:
    liquids = TwoLiquids(densities=(1000.0, 1000.0 * ratio), depths=(1.2, 0.47), lid=lid)
    rates, x = liquids.evanescent(2.0, 60), np.array([1.2, 2.5, 6.0])
    for level in [liquids.interface(2.0)] if lid else [liquids.interface(2.0), liquids.surface(2.0)]:
        np.testing.assert_allclose(level.symbol(level.wave_numbers) / level.stiffness, 1.0, rtol=1e-8)
        np.testing.assert_allclose(level.symbol(1j * rates[:20]) / level.stiffness, 1.0, rtol=1e-8)
        np.testing.assert_allclose(level.kernel(6.0)(x), wave_series(level, rates, x), rtol=0, atol=1e-11)


@pytest.mark.slow
@pytest.mark.parametrize("row", PUBLISHED["plates"]["rows"], ids=lambda row: f"{row['case']}-{row['omega_rad_s']}")
def test_plates_as_published(row: dict[str, Any]) -> None:
    level = one_liquid(row["omega_rad_s"], density=1025.0, depth=row["H_m"])
    plate = Plate((Segment(length=row["L_m"], rigidity=row["EI_Nm"], mass=row["m_kg_m2"]),))
    result = scattering(plate, level, np.array([0.0, 0.5, 1.0]) * row["L_m"], order=10)
    found = np.abs([*result.reflected, *result.transmitted, *result.deflection])
    published = [row[key] for key in ("absR", "absT", "w0", "wmid", "wL")]
    # The rows state their own error; their values are rounded to 1e-7 and 1e-6.
    np.testing.assert_allclose(found, published, rtol=0, atol=row["diff_N40"] + 1e-6)
    assert np.sum(found[:2] ** 2) == pytest.approx(1.0, abs=1e-10)


@pytest.mark.slow
@pytest.mark.slow_but("xi=625")
@pytest.mark.parametrize("row", PUBLISHED["compound_plate"]["rows"], ids=lambda row: f"xi={row['xi']}")
def test_compound_plate_as_published(row: dict[str, Any]) -> None:
    stiff, soft = (Segment(length=x, rigidity=ei, mass=8.36) for x, ei in ((2.5, 47100.0), (10.0, 471.0)))
    level = one_liquid(4.397971190, density=1025.0, depth=1.1)
    points = PUBLISHED["compound_plate"]["deflection"]
    x = np.array([point["x_over_L"] for point in points]) * 12.5
    result = scattering(Plate((stiff, soft), (row["xi"] * 47100 / 12.5,)), level, x, order=10)
    column = {0: "abs_w_xi0", 625: "abs_w_xi625"}.get(row["xi"], "abs_w_rigid_joint")
    # The rows have an error of about 1e-5; measured: 4e-6.
    assert np.abs([result.reflected[0], result.transmitted[0]]) == pytest.approx([row["R"], row["T"]], abs=1e-5)
    np.testing.assert_allclose(np.abs(result.deflection), [point[column] for point in points], rtol=0, atol=1e-5)


def complex_of(values: Any) -> np.ndarray:
    array = np.array(values)
    return np.asarray(array[..., 0] + 1j * array[..., 1])


@pytest.mark.slow
@pytest.mark.parametrize("row", some_slow(PLATES["plates"], {4, 14}))
def test_stored_plates_are_made_anew(row: dict[str, Any]) -> None:
    assert row["error"] <= 2e-11
    depth = math.inf if row["depth"] is None else row["depth"]
    level, plate = one_liquid(row["omega"], density=row["density"], depth=depth), plate_of(row)
    result = scattering(plate, level, np.linspace(0, 1, 11) * plate.length, order=10)
    # Measured: 1e-10 with polynomials of degree 9.
    assert result.reflected[0] == pytest.approx(complex_of(row["reflected"]), abs=1e-9)
    assert result.transmitted[0] == pytest.approx(complex_of(row["transmitted"]), abs=1e-9)
    np.testing.assert_allclose(result.deflection, complex_of(row["deflection"]), rtol=0, atol=1e-9)


@pytest.mark.slow
def test_transmission_is_the_same_from_both_sides() -> None:
    row = PLATES["plates"][16]
    level = one_liquid(row["omega"], density=row["density"], depth=row["depth"])
    there, back = (
        scattering(plate_of(row, turned=turned), level, np.array([0.0]), order=10) for turned in (False, True)
    )
    # A plate of two rigidities: also the phase of T is the same, that of R is not.
    assert there.transmitted[0] == pytest.approx(back.transmitted[0], abs=1e-10)
    assert abs(there.reflected[0]) == pytest.approx(abs(back.reflected[0]), abs=1e-10)


@pytest.mark.slow
@pytest.mark.parametrize("row", some_slow(TWO_LIQUIDS["cases"], {2, 9}))
def test_stored_two_liquids_are_made_anew(row: dict[str, Any]) -> None:
    assert row["error"] <= 1e-11
    liquids = TwoLiquids(densities=tuple(row["densities"]), depths=tuple(row["depths"]), lid=row["top"] == "lid")
    level = liquids.surface(row["omega"]) if row["level"] == "surface" else liquids.interface(row["omega"])
    plate = Plate((Segment(**row["plate"]),))
    flux = np.array(row["flux"])
    for wave, stored_row in enumerate(row["waves_in"]):
        result = scattering(plate, level, np.linspace(0, 1, 11) * plate.length, wave, order=10)
        np.testing.assert_allclose(result.reflected, complex_of(stored_row["reflected"]), rtol=0, atol=1e-9)
        np.testing.assert_allclose(result.transmitted, complex_of(stored_row["transmitted"]), rtol=0, atol=1e-9)
        np.testing.assert_allclose(result.deflection, complex_of(stored_row["deflection"]), rtol=0, atol=1e-9)
        outgoing = np.abs(result.reflected) ** 2 + np.abs(result.transmitted) ** 2
        assert flux @ outgoing / flux[wave] == pytest.approx(1.0, abs=1e-9)
    impedance, _ = rigid_radiation(plate.length, level, 10)
    np.testing.assert_allclose(np.diag(impedance.real), row["rigid"]["added_mass"], rtol=1e-9)
    np.testing.assert_allclose(np.diag(impedance.imag) * row["omega"], row["rigid"]["damping"], rtol=1e-9)


@pytest.mark.slow
def test_light_upper_liquid_is_one_liquid() -> None:
    # The upper liquid adds terms of the order of its density.
    below = one_liquid(3.0, density=1000.0, depth=1.2)
    both = TwoLiquids(densities=(1000.0, 1e-6), depths=(1.2, 0.5), lid=True).interface(3.0)
    expected, found = (rigid_radiation(1.5, level, 8)[0] for level in (below, both))
    np.testing.assert_allclose(found, expected, rtol=1e-7, atol=1e-5)


@pytest.mark.slow
def test_two_equal_symmetric_layers_are_one_liquid() -> None:
    # Equal depths under a lid: ψ is odd in y, the interface is a surface of density ρ₁ + ρ₂ and gravity Δρ g/(ρ₁ + ρ₂).
    both = TwoLiquids(densities=(1000.0, 900.0), depths=(0.8, 0.8), lid=True).interface(1.0)
    one = one_liquid(1.0, density=1900.0, depth=0.8, gravity=9.81 * 100 / 1900)
    found, expected = (rigid_radiation(1.5, level, 8)[0] for level in (both, one))
    np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("row", some_slow(SECTIONS["cases"], {7}))
def test_stored_sections_are_made_anew(row: dict[str, Any]) -> None:
    assert row["error"] <= 1e-10
    depth = math.inf if row["depth"] is None else row["depth"]
    answer = section_answer(np.array(row["corners"]), Water(omega=row["omega"], density=1000.0, depth=depth), order=5)
    added, damping = np.array(row["added_mass"]), np.array(row["damping"])
    scale = np.sqrt(np.outer(np.diag(added), np.diag(added)))
    # Measured with polynomials of degree 4: 2e-7.
    np.testing.assert_allclose((answer.impedance.real - added) / scale, 0, rtol=0, atol=2e-6)
    np.testing.assert_allclose((answer.impedance.imag - damping / row["omega"]) / scale, 0, rtol=0, atol=2e-6)
    np.testing.assert_allclose(answer.excitation, complex_of(row["excitation"]), rtol=2e-6)
    # Waves carry away what motions lose: radiation and Haskind's excitation agree.
    np.testing.assert_allclose(answer.flux_damping, np.diag(answer.impedance.imag) * row["omega"], rtol=1e-5)


@pytest.mark.slow
def test_thin_box_is_a_plate() -> None:
    plate, _ = rigid_radiation(1.0, one_liquid(3.0, density=1000.0, depth=1.0), 8)
    gaps = []
    for draught in (0.02, 0.01):
        corners = np.array([[-0.5, 0.0], [-0.5, -draught], [0.5, -draught], [0.5, 0.0]])
        answer = section_answer(corners, Water(omega=3.0, density=1000.0, depth=1.0), order=4)
        gaps.append((answer.impedance[1:, 1:] - plate).diagonal())
    # The draught adds terms D and D² ln D: half the draught, half the distance.
    assert np.all(np.abs(gaps[1] / gaps[0] - 0.5) < 0.08)
    assert abs(gaps[1][0]) < 0.02 * abs(plate[0, 0])
