"""A thin float in a closed box: references, two other methods, limits, hard cases."""

from __future__ import annotations

import dataclasses
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.linalg import eigh
from vertical_modes import added_masses

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.floats.box import box_modes, float_mode
from hydroelastic.modal.floats.box_inertia import interface_moment, layer_inertia, layer_wave_moment, liquid_inertia
from hydroelastic.modal.floats.in_tank import FloatInTank
from hydroelastic.modal.floats.thin_float import thin_float_mass, thin_float_stiffness
from hydroelastic.modal.floats.thin_shapes import sine_moment
from hydroelastic.modal.liquid.two_layer import TwoLayers, interface_frequencies
from hydroelastic.physics.profiles import float_profile

REFERENCE = json.loads((Path(__file__).parent / "reference" / "two_fluid_float.json").read_text(encoding="utf-8"))
CASES = {case["id"]: case for case in REFERENCE["cases"]}
BOXES = ["box_1_parabola", "box_2_wedge"]


def box(
    shape: str = "parabola",
    half_width: float = 0.1,
    half_height: float = 1.0,
    depths: tuple[float, float] = (2.0, 1.5),
    density_above: float = 0.8,
    length: float = 12.0,
    **keys: Any,
) -> FloatInTank:
    """A box with the float of the displaced mass in its middle, ρ₂ = 1."""
    profile = float_profile(shape, half_width, half_height, **keys)
    layers = TwoLayers(
        density_below=1.0, density_above=density_above, depth_below=depths[0], depth_above=depths[1], gravity=9.81
    )
    return FloatInTank(
        layers=layers,
        tank_length=length,
        position=length / 2,
        mass=thin_float_mass(profile, 1.0, density_above),
        stiffness=thin_float_stiffness(profile, 1.0, density_above, 9.81),
        profile=profile,
    )


def reference_box(name: str) -> FloatInTank:
    inputs = CASES[name]["inputs"]
    values = {key: float(value) for key, value in inputs.items() if key not in ("shape", "mass")}
    return box(
        inputs["shape"],
        values["half_beam"],
        values["half_height"],
        (values["h2"], values["h1"]),
        values["rho1"],
        2 * values["L_half"],
    )


def numbers(name: str, key: str) -> np.ndarray:
    return np.array(CASES[name]["values"][key], dtype=float)


@pytest.mark.parametrize("name", BOXES)
def test_reference_boxes(name: str) -> None:
    # References from 30-digit arithmetic, given to 20 and (masses) 15 digits; this code is good to a few roundings.
    body = reference_box(name)
    modes = box_modes(body, 6)
    np.testing.assert_allclose(modes.omega, numbers(name, "omega"), rtol=1e-14)
    np.testing.assert_allclose(modes.modal_mass, numbers(name, "modal_mass"), rtol=5e-14)
    np.testing.assert_allclose(modes.waves, numbers(name, "sigma_n"), rtol=1e-14)
    assert body.mass == pytest.approx(float(CASES[name]["values"]["body_mass"]), rel=1e-14)
    assert body.stiffness == pytest.approx(float(CASES[name]["values"]["stiffness_open"]), rel=1e-14)
    k = np.arange(1, 100) * 2 * math.pi / body.tank_length
    inertia = body.mass + liquid_inertia(body.section(), body.layers, body.tank_length, k)
    assert inertia == pytest.approx(float(CASES[name]["values"]["M_inf"]), rel=1e-14)
    mode = float_mode(body)
    assert mode.index == CASES[name]["values"]["float_mode_index"]
    assert mode.omega == pytest.approx(float(CASES[name]["values"]["omega_float"]), rel=1e-14)
    assert mode.modal_mass == pytest.approx(float(CASES[name]["values"]["modal_mass_float"]), rel=5e-14)
    assert mode.modal_mass == pytest.approx(modes.modal_mass.min(), rel=5e-14)


def test_without_the_volume_the_float_is_too_slow() -> None:
    # Six digits as the theory states them.
    body = reference_box("box_1_parabola")
    assert float_mode(body).omega == pytest.approx(1.234606, abs=5e-7)
    assert float_mode(body, volume_term=False).omega == pytest.approx(1.228003, abs=5e-7)


def test_release_in_the_box() -> None:
    # s/s₀ = r/(1 + r) + (1/(1 + r)) Σ p cos ωt with r = 2b/L and the participations p; 150 modes leave 1 − Σp = 4e-16.
    case = CASES["box_1_release"]
    modes = box_modes(reference_box("box_1_parabola"), 150)
    ratio = 0.1 / 6
    for time, expected in zip(case["inputs"]["t"], case["values"]["f"], strict=True):
        motion = (ratio + np.sum(modes.participation * np.cos(modes.omega * float(time)))) / (1 + ratio)
        assert motion == pytest.approx(float(expected), abs=1e-10)


@pytest.mark.parametrize(("shape", "limit"), [("wedge", 5e-9), ("parabola", 2e-13), ("ellipse", 1e-13)])
def test_participations_sum_to_one(shape: str, limit: float) -> None:
    # What n modes leave out falls like n⁻³ (R ~ 1/k) or n⁻⁵ (1/k²); with 512 of them 3.8e-9, 7e-14, 1e-14 was measured.
    rest = 1 - box_modes(box(shape), 512).participation.sum()
    assert 0 < rest + 1e-14 < limit


@pytest.mark.slow_but("0.8-depths0-wedge*", "*-exponential-*")
@pytest.mark.parametrize(
    ("shape", "keys", "order", "limit"),
    [
        ("wedge", {}, 2, 1e-9),
        ("parabola", {}, 4, 1e-13),
        ("ellipse", {}, 4, 1e-13),
        ("exponential", {"half_height": 0.15}, 2, 2e-7),
    ],
)
@pytest.mark.parametrize(("density_above", "depths"), [(0.8, (1.3, 1.9)), (0.98, (1.9, 1.3)), (0.0, (1.4, 9.0))])
def test_roots_of_a_truncated_pencil(
    shape: str, keys: dict[str, float], order: int, limit: float, density_above: float, depths: tuple[float, float]
) -> None:
    # K, M over (s, η₁ … η_N), the waves above N without potential energy: from above, with an error O(N⁻²) for R ~ 1/k
    # and O(N⁻⁴) for 1/k². Extrapolated values were measured to differ by 1.4e-10, 2e-14, 2e-14, 8e-8.
    body = box(shape, depths=depths, density_above=density_above, length=7.0, **keys)
    omega = box_modes(body, 8).omega
    first, second, coarse, fine = (_pencil_roots(body, count)[:8] for count in (50, 100, 200, 400))
    assert np.all(fine / omega > 1 - 1e-13)
    rate = np.log2(np.max(first - omega) / np.max(second - omega))
    assert rate == pytest.approx(order, abs=0.1)
    np.testing.assert_allclose(fine + (fine - coarse) / (2**order - 1), omega, rtol=limit)


def _pencil_roots(body: FloatInTank, count: int) -> np.ndarray:
    layers, profile, half = body.layers, body.section(), body.tank_length / 2
    k = np.arange(1, count + 1) * math.pi / half
    restoring = (layers.density_below - layers.density_above) * layers.gravity
    (sigma,) = interface_frequencies(layers, k).values()
    load = restoring / sigma**2
    coupling = load * interface_moment(profile, layers, k)
    mass = np.diag(np.concatenate([[0.0], 4 / half * load]))
    inertia = body.mass + liquid_inertia(profile, layers, body.tank_length, k)
    mass[0, 0] = inertia + 4 / half * np.sum(coupling**2 / load)
    mass[0, 1:] = mass[1:, 0] = 4 / half * coupling
    rise = 1 + profile.half_width / half
    stiffness = np.diag(np.concatenate([[body.stiffness * rise], np.full(count, 4 / half * restoring)]))
    return np.sqrt(eigh(stiffness, mass, eigvals_only=True))


@pytest.mark.slow_but("0.8-depths0-parabola-*", "0.95-depths1-exponential-*", "0.95-depths1-wedge-*")
@pytest.mark.parametrize(
    ("shape", "half_height", "order", "tolerance"),
    # Orders of the sum over the depth; after extrapolation 2e-10, 6e-10, 9e-7, 2e-11 of m was measured.
    [
        ("wedge", 0.8, 2, 1e-9),
        ("parabola", 0.8, 2, 2e-9),
        ("ellipse", 0.8, 1, 2e-6),
        ("exponential", 0.1, 4, 2e-10),
    ],
)
@pytest.mark.parametrize(("density_above", "depths"), [(0.8, (1.0, 1.4142135)), (0.95, (1.2345678, 1.0)), (0, (1, 9))])
def test_modes_over_the_depth_balance_the_float(
    shape: str,
    half_height: float,
    order: int,
    tolerance: float,
    density_above: float,
    depths: tuple[float, float],
) -> None:
    body = box(shape, half_height=half_height, depths=depths, density_above=density_above, length=5.0)
    for omega in box_modes(body, 3).omega:
        coarse, fine = added_masses(body, omega**2, [400, 800])
        added = fine + (fine - coarse) / (2**order - 1)
        assert body.stiffness / omega**2 == pytest.approx(body.mass + added, abs=tolerance * body.mass)


def test_layer_inertia_against_its_series() -> None:
    # J_j = 4 Σ Q_s(λ)²/(2m + 1), whose terms fall like m⁻³: up to λ = 6e5 it leaves less than 1e-12.
    for shape in ("parabola", "wedge"):
        profile = float_profile(shape, 0.3, 1.0)
        for depth in (1 + 1e-12, 1.001, 1.5, 5.0):
            number = np.arange(int(2e5 * depth))
            moment = 0.3 * sine_moment(profile, (number + 0.5) * math.pi / depth)
            assert layer_inertia(profile, depth) == pytest.approx(4 * np.sum(moment**2 / (2 * number + 1)), rel=2e-11)


def test_layer_moment_is_that_of_the_cosines() -> None:
    s, weights = np.polynomial.legendre.leggauss(200)
    y, weights = (s + 1) / 2 * 0.8, weights * 0.4
    k = np.array([1e-3, 0.4, 3.0, 25.0, 59.0, 65.0])
    for shape in ("parabola", "wedge", "exponential"):
        profile = float_profile(shape, 0.1, 0.8 if shape != "exponential" else 0.8 / math.log(1e3))
        kernel = np.exp(-np.outer(k, y)) + np.exp(-np.outer(k, 2 * 0.81 - y))
        expected = kernel / (1 + np.exp(-2 * 0.81 * k))[:, None] @ (-weights * profile.slope_at(y))
        np.testing.assert_allclose(layer_wave_moment(profile, 0.81, k), expected, rtol=5e-13)


def test_a_single_root_lies_between_neighbouring_waves() -> None:
    for density_above in (0.0, 0.5, 1 / 1.02, 1 - 1e-9):
        modes = box_modes(box(density_above=density_above, depths=(1.5, 1.5)), 40)
        assert modes.omega[0] < modes.waves[0]
        assert np.all(modes.waves[:-1] < modes.omega[1:])
        assert np.all(modes.omega < modes.waves)


@pytest.mark.slow
def test_modes_that_hardly_couple_keep_their_distance() -> None:
    # Far above its resonance the float stands still: Λ − σ² → w σ²/(Λ M − c'), far below rounding of Λ for mode 3000.
    body = box(half_width=1e-3, length=200.0)
    modes = box_modes(body, 3000)
    distance = np.sqrt(modes.modal_mass[-1])
    assert modes.omega[-1] == pytest.approx(modes.waves[-2], rel=1e-12)
    # In that limit M = w σ²/(Λ − σ²)², smooth in n to a few per cent and free of the jumps of rounding.
    assert distance > 1e3
    assert np.abs(np.diff(np.log(modes.modal_mass[-200:]))).max() < 0.01


def test_limit_of_a_vanishing_float() -> None:
    # b → 0: waves and c/m stay, with errors O(b).
    for half_width in (1e-4, 1e-6):
        body = box(half_width=half_width)
        modes = box_modes(body, 8)
        own = math.sqrt(body.stiffness / body.mass)
        expected = np.sort([*modes.waves[:7], own])
        np.testing.assert_allclose(modes.omega, expected, rtol=3 * half_width)


def test_small_density_difference_only_scales_time() -> None:
    # ρ₂ − ρ₁ → 0: ω/√(g*) depends on ρ₁/ρ₂ only through terms O(ρ₂ − ρ₁).
    near = [box_modes(box(density_above=1 - delta), 5).omega / math.sqrt(delta / (2 - delta)) for delta in (1e-6, 1e-9)]
    np.testing.assert_allclose(near[0], near[1], rtol=2e-6)


def test_equal_depths_know_the_total_density_only() -> None:
    # h₁ = h₂: two liquids are one with g* and ρ₁ + ρ₂.
    two = box_modes(box(depths=(1.5, 1.5), density_above=0.6), 10).omega / math.sqrt(0.4 / 1.6)
    one = box_modes(box(depths=(1.5, 1.5), density_above=0.0), 10).omega
    np.testing.assert_allclose(two, one, rtol=1e-13)


def test_units_do_not_matter() -> None:
    metres = reference_box("box_1_parabola")
    profile = float_profile("parabola", 100.0, 1000.0)
    layers = TwoLayers(density_below=1e-9, density_above=8e-10, depth_below=2e3, depth_above=1.5e3, gravity=9810.0)
    millimetres = FloatInTank(
        layers=layers,
        tank_length=12e3,
        position=6e3,
        mass=thin_float_mass(profile, 1e-9, 8e-10),
        stiffness=thin_float_stiffness(profile, 1e-9, 8e-10, 9810.0),
        profile=profile,
    )
    np.testing.assert_allclose(box_modes(millimetres, 20).omega, box_modes(metres, 20).omega, rtol=1e-13)


def test_a_float_close_to_the_bottom() -> None:
    # The inertia grows as the end comes near, and stays finite: its logarithm can be integrated.
    gaps = (1e-3, 1e-6, 1e-9, 1e-12)
    wedge, parabola = (
        np.array([box_modes(box(shape, depths=(1 + gap, 3.0)), 4).omega for gap in gaps])
        for shape in ("wedge", "parabola")
    )
    assert np.all(np.diff(wedge, axis=0) < 0)
    assert np.all(np.diff(parabola, axis=0) < 0)
    for found in (wedge, parabola):
        steps = np.abs(np.diff(found, axis=0)).max(axis=1)
        assert steps[2] < steps[0] / 100


@pytest.mark.slow
def test_the_float_mode_is_found_in_a_long_tank() -> None:
    # Dense spectrum: the resonance is spread over many modes, and its centre does not move.
    mode = float_mode(box(length=600.0))
    assert mode.index > 100
    assert mode.participation < 0.1
    assert mode.omega == pytest.approx(float_mode(box(length=1200.0)).omega, rel=5e-3)


@pytest.mark.slow
def test_no_later_mode_takes_more_of_the_heave() -> None:
    # Shallow liquid: 46 waves more than deep ones would be are slower than the float, so that the search must go on.
    body = box(half_width=1.0, half_height=1.13, depths=(2.0, 1.17), density_above=0.9, length=1000.0)
    participation = box_modes(body, 400).participation
    mode = float_mode(body)
    assert mode.index == np.argmax(participation) + 1
    assert mode.participation == pytest.approx(participation.max(), rel=1e-9)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"position": 5.0}, "middle"),
        ({"profile": None}, "not a known symmetric shape"),
        ({"profile": float_profile("rectangle", 0.1, 1.0)}, "flat edges"),
        ({"layers": dataclasses.replace(box().layers, top="free")}, "rigid lid"),
        ({"layers": dataclasses.replace(box().layers, depth_above=math.inf, depth_below=math.inf)}, "infinitely deep"),
        ({"tank_length": 1e9, "position": 5e8}, "so long"),
    ],
)
def test_what_the_equation_does_not_cover_says_so(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(NoEstimateError, match=message):
        box_modes(dataclasses.replace(box(), **changes), 2)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"mass": 0.0}, "mass"),
        ({"stiffness": math.nan}, "stiffness"),
        ({"position": 12.0}, "position"),
        ({"position": 0.05}, "reaches a wall"),
        ({"profile": float_profile("wedge", 0.1, 1.5)}, "the float reaches"),
    ],
)
def test_floats_outside_the_tank_are_refused(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        dataclasses.replace(box(), **changes)


def test_counts_are_checked() -> None:
    with pytest.raises(ValueError, match="count"):
        box_modes(box(), 0)
