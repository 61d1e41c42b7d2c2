"""Resonances and free motion of a thin float in deep open water: references, the equation in time, the spectrum."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
import pytest
from scipy.integrate import quad
from scipy.special import exp1, expi
from thin_floats import CASES, EPS, SHAPES, UNIT, gauss, number, of_case, of_coupling, thin

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.floats.thin_float import thin_constants, thin_float_mass
from hydroelastic.modal.floats.thin_float_decay import crossover_time, free_motion, free_motion_tail
from hydroelastic.modal.floats.thin_float_radiation import thin_float_radiation
from hydroelastic.modal.floats.thin_float_resonance import heave_pole, pole_count, second_pole
from hydroelastic.modal.floats.thin_shapes import wave_moment
from hydroelastic.modal.floats.wave_integral import greatest_angle
from hydroelastic.physics.profiles import FloatShape

MOTIONS = [name for name in CASES if name.startswith("f_")]
POLES = [name for name in CASES if name.startswith(("pole_", "f_wedge", "f_parabola", "f_ellipse"))]


def volterra(coupling: float, end: float, steps: int) -> float:
    """f(end) of f'' + Ω² f = −ε ∫ K(θ − u) f'(u) du by the trapezoidal rule; exponential, Ω² = 1 − ε/2."""
    step = end / steps
    kernel = exponential_kernel(step * np.arange(steps + 1))
    square = 1 - coupling / 2
    f, velocity, acceleration = 1.0, np.zeros(steps + 1), -square
    for i in range(1, steps + 1):
        memory = step * (kernel[i:0:-1] @ velocity[:i] - kernel[i] * velocity[0] / 2)
        # f_i = f + h(v + v_i)/2 and v_i = v + h(a + a_i)/2 with a_i = −Ω² f_i − ε (memory + h K₀ v_i/2).
        known = velocity[i - 1] + step / 2 * (
            acceleration - square * (f + step / 2 * velocity[i - 1]) - coupling * memory
        )
        velocity[i] = known / (1 + step**2 / 4 * (square + coupling * kernel[0]))
        f += step / 2 * (velocity[i - 1] + velocity[i])
        acceleration = -square * f - coupling * (memory + step / 2 * kernel[0] * velocity[i])
    return f


def exponential_kernel(theta: npt.NDArray) -> npt.NDArray:
    kernel = np.ones_like(theta)
    t = theta[theta > 0]
    kernel[theta > 0] = 1 - t / 2 * (np.exp(-t) * expi(t) + np.exp(t) * exp1(t))
    return kernel


@pytest.mark.parametrize("name", MOTIONS)
def test_reference_motions(name: str) -> None:
    case = CASES[name]
    theta = np.array([float(t) for t in case["inputs"]["theta"]])
    reference = np.array([float(f) for f in case["values"]["f"]])
    motion = free_motion(of_case(name), theta)
    # Rounding of the phase, and the digits of the references: 13 of the ellipse, in double precision, at the last time.
    ringing = np.exp(heave_pole(of_case(name)).frequency.real * theta)
    assert np.all(np.abs(motion.heave - reference) <= 8 * EPS * (1 + theta) * ringing + 2e-13 * np.abs(reference))
    assert np.all(np.abs(motion.heave - reference) <= motion.error + 2e-13 * np.abs(reference))
    assert np.all(motion.error <= 20 * EPS * (1 + theta))


@pytest.mark.parametrize("name", POLES)
def test_reference_poles(name: str) -> None:
    values = CASES[name]["values"]
    pole = heave_pole(of_case(name))
    # The references have 15 digits; residues come from a derivative on a circle.
    assert pole.frequency == pytest.approx(number(values["z1"]), abs=4 * EPS)
    assert pole.residue == pytest.approx(number(values["res1"]), abs=4 * EPS)
    # A decay rate of 4e-5 keeps its own digits, up to the rounding of the large frequency beside it.
    assert pole.frequency.real == pytest.approx(float(values["z1"][0]), abs=2 * EPS)
    if "z2" in values:
        second = second_pole(of_case(name))
        assert second.frequency == pytest.approx(number(values["z2"]), abs=4 * EPS)
        assert second.residue == pytest.approx(number(values["res2"]), abs=4 * EPS)


@pytest.mark.parametrize("coupling", [1e-4, 0.1, 0.5, 1.0, 1.9])
def test_the_exponential_has_two_poles(coupling: float) -> None:
    profile = of_coupling(coupling)
    assert pole_count(profile, math.pi) == 2
    # One between the axis and a ray between them, found apart from their positions.
    angles = sorted(np.angle([heave_pole(profile).frequency, second_pole(profile).frequency]))
    assert [pole_count(profile, a) for a in (0.5 * (math.pi / 2 + angles[0]), sum(angles) / 2)] == [0, 1]
    tau = profile.half_width
    if tau < 0.2:
        expansion = complex(-(tau / 4 + tau**3 / 128), 1 + tau**2 / 32 + tau**3 / (16 * math.pi))
        assert heave_pole(profile).frequency == pytest.approx(expansion, abs=tau**4 + 4 * EPS)


@pytest.mark.parametrize("shape", SHAPES[1:])
def test_other_shapes_have_one_pole_beside_the_axis(shape: FloatShape) -> None:
    for slenderness in (1e-4, 0.1, 0.3):
        assert pole_count(thin(shape, slenderness), greatest_angle(thin(shape, slenderness))) == 1
    assert pole_count(thin(shape, 3.0), greatest_angle(thin(shape, 3.0))) == 2
    with pytest.raises(NoEstimateError, match="exponential without end"):
        second_pole(thin(shape, 0.1))
    # γ ≈ b/2(m + a) for slender floats.
    profile = thin(shape, 1e-3)
    frequency = heave_pole(profile).frequency
    radiation = thin_float_radiation(profile, UNIT, frequency.imag)
    rate = radiation.damping / (2 * (thin_float_mass(profile, 1.0, 0.0) + radiation.added_mass))
    assert -frequency.real == pytest.approx(float(rate), rel=2e-3, abs=0)
    # No wave moment vanishes, so that no motion is trapped: b > 0.
    assert np.all(wave_moment(profile, np.geomspace(1e-12, 1e6, 200)) > 0)


@pytest.mark.slow_but("0.01-*")
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("slenderness", [1e-6, 1e-2, 1.0, 5.0])
def test_beginning_tail_and_crossover(shape: FloatShape, slenderness: float) -> None:
    profile = thin(shape, slenderness)
    constants = thin_constants(profile)
    assert free_motion(profile, 0.0).heave == pytest.approx(1, abs=16 * EPS)
    theta = np.array([0.01, 0.02])
    moment = quad(lambda u: float(wave_moment(profile, math.exp(u))) ** 2 * math.exp(u), -40, 40, limit=400)[0]
    square = constants.frequency_squared
    series = 1 - square * theta**2 / 2 + square * (square + constants.coupling * moment) * theta**4 / 24
    # The next term is (θ⁶/360) (…+ ln θ), 2e-13; the last one that is kept is 7e-9.
    np.testing.assert_allclose(free_motion(profile, theta).heave, series, rtol=0, atol=2e-12)
    late = 2e3 if slenderness >= 1 else 1e9
    if slenderness >= 1e-2:
        # Next term relative O(τ ln θ/θ²).
        tail = free_motion_tail(profile, late)
        assert float(tail) < 0
        assert free_motion(profile, late).heave == pytest.approx(float(tail), rel=2e-4 * slenderness, abs=0)
    if slenderness <= 1e-2:
        crossing = crossover_time(profile)
        pole = heave_pole(profile)
        ringing = 2 * abs(pole.residue) * math.exp(pole.frequency.real * crossing)
        assert ringing == pytest.approx(-float(free_motion_tail(profile, crossing)), rel=1e-9, abs=0)
        assert abs(free_motion_tail(profile, 2 * crossing)) > 2 * math.exp(2 * pole.frequency.real * crossing)


@pytest.mark.slow
@pytest.mark.parametrize("shape", ["exponential", "wedge"])
def test_the_whole_motion_has_mean_zero(shape: FloatShape) -> None:
    """∫ f dθ = 0: the transform vanishes at z = 0. The rest beyond T follows from the tail, next term O(ln T/T³)."""
    profile = thin(shape, 0.3)
    end = 2e3
    theta, weights = gauss(np.linspace(0, end, 1500))
    rest = -4 * 0.3 / math.pi / end
    assert weights @ free_motion(profile, theta).heave + rest == pytest.approx(0, abs=1e-7)


@pytest.mark.slow_but("0.1")
@pytest.mark.parametrize("coupling", [0.1, 0.7])
def test_motion_against_the_volterra_equation(coupling: float) -> None:
    """The integro-differential equation in time, with its kernel in closed form: no transform at all."""
    reference = CASES["kernel_K"]
    kernel = exponential_kernel(np.array([float(t) for t in reference["inputs"]["theta"]]))
    np.testing.assert_allclose(kernel, [float(k) for k in reference["values"]["exponential"]], rtol=1e-12)
    first, second, third = (volterra(coupling, 20.0, n) for n in (1000, 2000, 4000))
    # Error h², then h⁴ up to logarithms: the first extrapolations tell the error of the last.
    coarse, fine = (4 * second - first) / 3, (4 * third - second) / 3
    assert abs(fine - coarse) < 2e-7
    assert free_motion(of_coupling(coupling), 20.0).heave == pytest.approx(fine, abs=2 * abs(fine - coarse))


@pytest.mark.slow
def test_slender_floats_and_late_times() -> None:
    """τθ fixed while τ → 0: f → e^{−τθ/4} cos θ for the exponential, with a rounding of the phase of θ·ulp."""
    for slenderness in (1e-3, 1e-5, 1e-7):
        theta = np.array([0.5, 1.0, 3.0]) / slenderness
        simple = np.exp(-slenderness * theta / 4) * np.cos(theta)
        motion = free_motion(thin("exponential", slenderness), theta)
        np.testing.assert_allclose(motion.heave, simple, rtol=0, atol=2 * slenderness + 4 * EPS * theta[-1])
        assert motion.error.max() < 20 * EPS * theta[-1]
    late = free_motion(thin("wedge", 0.1), 1e30)
    assert late.heave == pytest.approx(float(free_motion_tail(thin("wedge", 0.1), 1e30)), rel=1e-12, abs=0)
    many = free_motion(thin("wedge", 0.1), np.linspace(0, 1e4, 2501).reshape(61, 41))
    assert many.heave.shape == many.error.shape == (61, 41)
    assert np.all(np.abs(many.heave) <= 1 + many.error)
