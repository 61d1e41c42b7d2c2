"""A thin float in a closed box: references, two other methods, limits, hard cases."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.linalg import eigh

from hydroelastic.modal.floats.box import box_modes, float_mode
from hydroelastic.modal.floats.box_inertia import interface_moment, liquid_inertia
from hydroelastic.modal.floats.in_tank import FloatInTank
from hydroelastic.modal.floats.thin_float import thin_float_mass, thin_float_stiffness
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
