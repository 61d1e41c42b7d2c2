"""The printed constants of the thin float fail, the corrected ones do not."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from section_panels import added_masses

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.floats.box import box_modes
from hydroelastic.modal.floats.in_tank import FloatInTank
from hydroelastic.modal.floats.thin_float import thin_float_mass, thin_float_stiffness
from hydroelastic.modal.floats.thin_float_paper import THIN_FLOAT_ERRATA, printed_constants
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.profiles import float_profile

REFERENCE = json.loads((Path(__file__).parent / "reference" / "two_fluid_float.json").read_text(encoding="utf-8"))
CASES = {case["id"]: case for case in REFERENCE["cases"]}
LAYERS = TwoLayers(density_below=1000.0, density_above=800.0, depth_below=math.inf, gravity=9.81)
REDUCED = 9.81 * 200 / 1800


def test_errata_are_numbered_and_complete() -> None:
    assert [erratum.number for erratum in THIN_FLOAT_ERRATA] == list(range(1, 16))
    for erratum in THIN_FLOAT_ERRATA:
        assert erratum.printed
        assert erratum.corrected
        assert erratum.consequence


def test_inertia_factor_by_its_integral() -> None:
    # J = 2 ∫ k C² dk, C = ∫ e^{−y} cos ky dy = 1/(1 + k²).
    exact = 2 * quad(lambda k: k / (1 + k**2) ** 2, 0, math.inf)[0]
    value = printed_constants(float_profile("exponential", 0.1, 1.0), LAYERS)["inertia_factor"]
    assert value.corrected == pytest.approx(exact, rel=1e-9)
    assert value.printed == pytest.approx(exact / 2, rel=1e-9)


def test_added_mass_of_the_section_itself() -> None:
    # The exact section far above the waves, by source panels: 1.8 % over the thin theory at τ = 0.05, 0.9 % at 0.025.
    profile = float_profile("exponential", 0.05, 1.0, tail=1e-4)
    half = np.sinh(np.linspace(0, 4, 161)) / math.sinh(4) * profile.extent
    y = -np.concatenate([half, half[::-1][1:]])
    x = profile.half_width_at(y) * np.repeat([-1.0, 1.0], [161, 160])
    exact = 1.8 * added_masses(x + 1j * y, 1.0)[0, 0]
    layers = TwoLayers(density_below=1.0, density_above=0.8, depth_below=math.inf, gravity=9.81)
    values = printed_constants(profile, layers)
    assert exact / values["added_mass"].corrected == pytest.approx(1, abs=0.02)
    assert exact / values["added_mass"].printed == pytest.approx(2, abs=0.04)
    mass = 1.8 * 2 * 0.05
    for kind in ("printed", "corrected"):
        ratio = getattr(values["inertia_ratio"], kind)
        assert 1 + getattr(values["added_mass"], kind) / mass == pytest.approx(ratio, rel=1e-14)
        assert getattr(values["frequency_squared"], kind) == pytest.approx(1 / ratio, rel=1e-14)
        assert getattr(values["omega"], kind) == pytest.approx(math.sqrt(9.81 / 9 / ratio), rel=1e-14)


@pytest.mark.slow
def test_motion_in_a_long_tank_is_that_of_the_corrected_coupling() -> None:
    """Before its waves come back from the walls a float moves as in unbounded liquid, with the coupling of its τ."""
    for name in ("f_exp_eps0.1", "f_exp_eps0.01"):
        inputs, expected = CASES[name]["inputs"], CASES[name]["values"]["f"]
        profile = float_profile("exponential", float(inputs["tau"]), 1.0, tail=1e-9)
        layers = TwoLayers(density_below=1.0, depth_below=60.0, gravity=1.0)
        body = FloatInTank(
            layers=layers,
            tank_length=800.0,
            position=400.0,
            mass=thin_float_mass(profile, 1.0, 0.0),
            stiffness=thin_float_stiffness(profile, 1.0, 0.0, 1.0),
            profile=profile,
        )
        modes = box_modes(body, 1000)
        assert modes.participation.sum() > 1 - 1e-4
        for theta, f in zip(inputs["theta"], expected, strict=True):
            if 0 < float(theta) <= 20:
                motion = np.sum(modes.participation * np.cos(modes.omega * float(theta)))
                # Finite depth: measured 7.2e-4 and less, 4.9e-4 with a depth of 200.
                assert motion == pytest.approx(float(f), abs=1e-3)
        coupling = printed_constants(profile, LAYERS)["coupling"]
        assert coupling.corrected == pytest.approx(float(inputs["eps_star"]), rel=1e-14)
        assert coupling.printed / coupling.corrected == pytest.approx(math.pi, rel=0.1)


def test_kernel_factor_and_coupling_are_one() -> None:
    # ε_* = δ μ l²/ν² with ν² = g*μ, in both versions: the slip of (4.4) and (5.1) is that of (5.8).
    values = printed_constants(float_profile("exponential", 0.3, 2.0), LAYERS)
    for kind in ("printed", "corrected"):
        kernel, coupling = getattr(values["kernel"], kind), getattr(values["coupling"], kind)
        assert kernel * 0.3**2 / REDUCED == pytest.approx(coupling, rel=1e-14)


@pytest.mark.parametrize("name", ["f_exp_eps0.5", "f_exp_eps0.1"])
def test_late_motion(name: str) -> None:
    inputs = CASES[name]["inputs"]
    profile = float_profile("exponential", 2 * float(inputs["tau"]), 2.0)
    value = printed_constants(profile, LAYERS)["tail"]
    theta = float(inputs["theta"][-1])
    time_squared = theta**2 * 2.0 / REDUCED
    # The next term of the tail, of order (ε/θ²) ln θ, is below 2e-6 at θ = 1e4.
    assert float(CASES[name]["values"]["f"][-1]) * time_squared == pytest.approx(value.corrected, rel=2e-6)
    assert value.corrected == pytest.approx(-4 / math.pi * profile.half_width / REDUCED, rel=1e-14)
    assert value.printed > 0


def test_other_shapes_have_no_printed_constants() -> None:
    with pytest.raises(NoEstimateError, match="no constants for the wedge"):
        printed_constants(float_profile("wedge", 0.1, 1.0), LAYERS)
