"""Every estimate against the exact reference cases of the floating beam in a tank."""

import functools
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hydroelastic.modal.beam.added_mass import (
    deep_open_added_mass,
    deep_open_constant,
    lid_added_mass,
    shallow_constant,
    strip_added_mass,
)
from hydroelastic.modal.beam.dry_modes import free_free_roots
from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.modal.beam.grammel import beam_quotients, best_term, one_term_root, term_tones
from hydroelastic.modal.beam.gravity_added_mass import gravity_added_mass, gravity_tones
from hydroelastic.modal.beam.pressure_release import pressure_release_added_mass
from hydroelastic.modal.beam.rayleigh import (
    pressure_release_tones,
    rayleigh,
    rayleigh_dry_mode,
    rayleigh_lid,
    rayleigh_pressure_release,
)
from hydroelastic.modal.beam.tone_pencil import Tones

REFERENCE = json.loads((Path(__file__).parent / "reference" / "aquarium.json").read_text(encoding="utf-8"))
CASES: dict[str, dict[str, Any]] = {case["name"]: case for case in REFERENCE["cases"]}
FREE_BEAMS = [name for name, case in CASES.items() if "rayleigh" in case]
WITH_WATER = [name for name in FREE_BEAMS if "psi0" in CASES[name]]


def beam_of(inputs: dict[str, Any]) -> FloatingBeam:
    return FloatingBeam(
        tank_length=inputs["L"],
        depth=inputs["H"],
        density=inputs["rho"],
        gravity=inputs["g"],
        start=inputs["x1"],
        length=inputs["l"],
        flexural_rigidity=inputs["EI"],
        mass_per_length=inputs["m"],
        hydrostatic=bool(inputs["s"]),
    )


@functools.cache
def beam(name: str) -> FloatingBeam:
    return beam_of(CASES[name]["inputs"])


@functools.cache
def terms_of(name: str, terms: int, volume_term: bool = True) -> Tones:
    return term_tones(beam(name), terms, volume_term=volume_term)


def test_published_constants() -> None:
    # Printed to 15 or 16 digits.
    constants = REFERENCE["constants"]
    np.testing.assert_allclose(free_free_roots(3), constants["kappa_l"], rtol=1e-15)
    deep = constants["C_j deep, laterally open, psi=0 on F: m_a = C_j rho l (dry modes 1..3)"]
    np.testing.assert_allclose([deep_open_constant(index) for index in (2, 3, 4)], deep, rtol=3e-15)
    shallow = constants["shallow limit psi=0: m_a = s_j rho l^2/H, s_j = sig b (sig b - 2)/b^4"]
    np.testing.assert_allclose([shallow_constant(index) for index in (3, 4)], shallow[1:], rtol=3e-15)
    # The reference prints s_1 = 0.0245775186|3846|4576. Its own formula in 50-digit arithmetic gives the value below:
    # two digits are swapped in the eleventh and twelfth place, so the printed one is good to 1.5e-10 only.
    assert shallow_constant(2) == pytest.approx(0.02457751863486457529792532941252679, rel=3e-15)
    assert shallow_constant(2) == pytest.approx(shallow[0], rel=2e-10)
    heave, pitch = constants["rigid heave / pitch, same limit: m_a = pi/8 rho l ; I_a = pi/256 rho l^4 (w = x - xc)"]
    # The pitch shape is √3 (2s − 1) = (2√3/l)(x − x_c): m_a l = 12/l² · I_a.
    assert deep_open_constant(0) == pytest.approx(heave, rel=1e-14)
    assert deep_open_constant(1) == pytest.approx(12 * pitch, rel=1e-14)


@pytest.mark.parametrize("row", [row for row in REFERENCE["fluid_tests"]["rows"] if row["lam"] not in ("inf", 0.0)])
def test_added_mass_on_gravity_waves(row: dict[str, Any]) -> None:
    # Two solvers of the reference agree to 7e-14. The graded nodes leave 3e-11 (measured at λ = 100, λl/g = 41);
    # relative to the largest entry, since the coupling nearly vanishes at λ = 10.
    added = gravity_added_mass(beam_of(REFERENCE["fluid_tests"]["inputs"]), row["lam"])
    expected = np.array([row["heave"], row["pitch"], row["dry1"], row["heave_dry1"]])
    actual = added[[0, 1, 2, 0], [0, 1, 2, 2]]
    np.testing.assert_allclose(actual, expected, rtol=0, atol=2e-10 * abs(row["dry1"]) + 1e-13 * np.abs(expected).max())
    np.testing.assert_allclose(added[1, [0, 2]], 0.0, atol=1e-8)


def test_fluid_limits_of_low_and_high_frequency() -> None:
    # λ → ∞ row: the reference's own two solvers agree to 1e-10 there. λ = 0 is the rigid lid.
    problem = beam_of(REFERENCE["fluid_tests"]["inputs"])
    infinite, zero = REFERENCE["fluid_tests"]["rows"][-2:]
    added = pressure_release_added_mass(problem, 3)
    expected = [infinite["heave"], infinite["pitch"], infinite["dry1"], infinite["heave_dry1"]]
    np.testing.assert_allclose(added[[0, 1, 2, 0], [0, 1, 2, 2]], expected, rtol=4e-10)
    assert lid_added_mass(problem, 1) == pytest.approx(zero["pitch"], rel=1e-12)
    assert lid_added_mass(problem, 2) == pytest.approx(zero["dry1"], rel=1e-12)


@pytest.mark.parametrize("name", FREE_BEAMS)
def test_closed_form_added_masses(name: str) -> None:
    expected = CASES[name]["rayleigh"]
    # The tail of the lid series is asked to 1e-12; the others are closed forms.
    assert lid_added_mass(beam(name)) == pytest.approx(expected["lid"]["added_mass"], rel=1e-12)
    assert rayleigh_lid(beam(name)).omega == pytest.approx(expected["lid"]["omega"], rel=1e-12)
    assert strip_added_mass(beam(name)) == pytest.approx(expected["strip"]["added_mass"], rel=1e-14)
    assert deep_open_added_mass(beam(name)) == pytest.approx(expected["deep_open"]["added_mass"], rel=1e-14)


@pytest.mark.slow_but("base_s*", "offcentre_s0", "shallow_0.01_s0")
@pytest.mark.parametrize("name", FREE_BEAMS)
def test_rayleigh_with_the_free_surface(name: str) -> None:
    # 14-digit reference; measured 2e-14 … 1.4e-12, and 4e-10 where the depth sets the node count (H/L = 0.01).
    expected = CASES[name]["rayleigh"]
    case = expected["gravity_rigid"]
    estimate = rayleigh(beam(name))
    assert estimate.omega == pytest.approx(case["omega"], rel=1e-9)
    assert estimate.added_mass_per_length == pytest.approx(case["added_mass"], rel=1e-8)
    assert estimate.mode_index == case["index"]
    if "gravity" in expected:
        assert rayleigh_dry_mode(beam(name)).omega == pytest.approx(expected["gravity"]["omega"], rel=1e-9)


@pytest.mark.parametrize("name", WITH_WATER)
def test_pressure_release_limit(name: str) -> None:
    expected = CASES[name]["psi0"]
    # The Rayleigh mass agrees between two solvers to 8 … 12 digits, the off-diagonal matrix to 3e-10 (second solver).
    added = pressure_release_added_mass(beam(name), 3)
    digits = expected["rayleigh_added_mass_digits"]
    assert added[2, 2] == pytest.approx(expected["rayleigh_added_mass"], rel=max(10.0**-digits, 1e-11))
    matrix = np.array(expected["rigid_added_mass"])
    np.testing.assert_allclose(added, matrix, rtol=4e-10, atol=4e-10 * matrix.max())
    assert rayleigh_pressure_release(beam(name)).omega == pytest.approx(expected["ritz3_omega"], rel=1e-9)


@pytest.mark.parametrize("name", WITH_WATER)
def test_pressure_release_tones_approach_the_exact_ones_from_above(name: str) -> None:
    # 20 dry shapes: the Ritz error falls like index⁻⁷ (measured below 1e-7 for the tone, 1.2e-7 at l/L = 0.94).
    exact = CASES[name]["psi0"]
    tones = pressure_release_tones(beam(name), 20)
    omega = np.sqrt(tones.squared_frequencies[: len(exact["omega"])])
    error = omega / exact["omega"] - 1
    assert np.all(error > -1e-9)
    assert math.sqrt(tones.elastic_squared_frequency) == pytest.approx(exact["elastic_omega"], rel=2e-7)


@pytest.mark.parametrize(
    "name", ["base_s0", "base_s1", "offcentre_s0", "paper_x1_0", "narrow_s0", "heavy_s1", "soft_s0"]
)
def test_many_dry_shapes_on_gravity_waves_give_the_exact_frequencies(name: str) -> None:
    # The exact problem itself: 24 dry shapes leave a Ritz error below 2e-8 in ω (measured, eighth mode of narrow_s0),
    # never a negative one. Catches a wrong kernel, volume constraint, recoil, hydrostatics or free-surface term.
    exact = np.array(CASES[name]["omega"])
    tones = gravity_tones(beam(name), tuple(range(24)), (1.3 * exact[-1]) ** 2)
    error = np.sqrt(tones.squared_frequencies[: len(exact)]) / exact - 1
    assert error.min() > -1e-12
    assert error.max() < 3e-8


@pytest.mark.parametrize("name", FREE_BEAMS)
def test_one_term_roots(name: str) -> None:
    # The same function by closed form and by dry shapes, both to rounding; 7e-12 is the largest difference measured.
    expected = CASES[name]["grammel"]
    assert best_term(beam(name)) == expected["best_term"]
    for number, (root, _) in expected["one_term_roots"].items():
        assert one_term_root(beam(name), int(number)) == pytest.approx(root, rel=3e-11)


@pytest.mark.slow_but("*base_s0", "*offcentre_s0", "*narrow_s0")
@pytest.mark.parametrize("name", FREE_BEAMS)
@pytest.mark.parametrize("terms", [8, 32])
def test_many_term_tones(name: str, terms: int) -> None:
    # The overlap S is rank deficient, so where it is cut shows at 1e-8 in the high tones, less in the elastic one.
    rows = CASES[name]["grammel"]["N_term"]
    for key, volume_term in (("with_const", True), ("paper_no_const", False)):
        row = next(row for row in rows[key] if row["N"] == terms)
        tones = terms_of(name, terms, volume_term)
        omega = np.sqrt(tones.squared_frequencies[: len(row["omega"])])
        np.testing.assert_allclose(omega, row["omega"], rtol=5e-8)
        assert tones.elastic_index == row["elastic_index"]
        assert math.sqrt(tones.elastic_squared_frequency) == pytest.approx(row["elastic_omega"], rel=1e-9)
        assert tones.participation.max() == pytest.approx(row["p"], rel=1e-8)


@pytest.mark.slow_but("base_s0")
@pytest.mark.parametrize("name", ["base_s0", "base_s1", "offcentre_s0", "paper_x1_0", "narrow_s0"])
def test_many_term_tones_lie_above_the_exact_modes(name: str) -> None:
    # Ritz bound, index by index. The cut of the rank may cost a few 1e-9.
    exact = np.array(CASES[name]["omega"])
    for terms in (32, 64):
        omega = np.sqrt(terms_of(name, terms).squared_frequencies[: len(exact)])
        assert np.all(omega > exact * (1 - 1e-8))


@pytest.mark.parametrize("name", FREE_BEAMS)
def test_quotients_are_ordered_and_end_at_the_references(name: str) -> None:
    result = beam_quotients(beam(name))
    # The inequality is strict here; rounding of λ is below 1e-12.
    assert result.exact * (1 - 1e-12) <= result.grammel <= result.rayleigh * (1 + 1e-12)
    if name in WITH_WATER:
        psi0 = CASES[name]["psi0"]
        assert math.sqrt(result.rayleigh) == pytest.approx(psi0["ritz3_omega"], rel=1e-9)
        # 24 shapes for the exact space: measured 3e-8 and less.
        assert math.sqrt(result.exact) == pytest.approx(psi0["elastic_omega"], rel=5e-8)
        assert math.sqrt(result.grammel) >= psi0["elastic_omega"] * (1 - 1e-10)
    else:
        assert math.sqrt(result.rayleigh) == pytest.approx(CASES[name]["rayleigh"]["lid"]["omega"], rel=1e-12)
        assert math.sqrt(result.exact) == pytest.approx(CASES[name]["omega"][result.index - 1], rel=1e-8)
        assert result.grammel < result.rayleigh


@pytest.mark.slow_but("*base_s0", "*offcentre_s0", "*narrow_s0")
@pytest.mark.parametrize("name", [name for name in FREE_BEAMS if name != "steel_plate_s0"])
def test_stated_bounds_hold(name: str) -> None:
    exact = CASES[name]["omega"]
    for estimate in (rayleigh(beam(name)), rayleigh_dry_mode(beam(name)), rayleigh_lid(beam(name))):
        if estimate.bound == "above_mode_index" and estimate.mode_index <= len(exact):
            assert estimate.omega > exact[estimate.mode_index - 1] * (1 - 1e-9)
    elastic = CASES[name]["elastic1"]
    if rayleigh(beam(name)).mode_index == elastic["index"]:
        assert rayleigh(beam(name)).omega > elastic["omega"] * (1 - 1e-12)
    if name in WITH_WATER:
        released = rayleigh_pressure_release(beam(name))
        assert released.bound == "above_pressure_release_tone"
        assert released.omega > CASES[name]["psi0"]["omega"][released.mode_index - 1]
