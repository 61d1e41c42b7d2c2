"""Thin float in open water: added mass, damping, resonances, free motion, against references and other methods."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
from numpy.polynomial.legendre import leggauss
from scipy.integrate import quad
from scipy.special import exp1, expi

from hydroelastic.modal import (
    FloatInTank,
    NoEstimateError,
    TwoLayers,
    box_modes,
    channel_free_motion,
    channel_resonance,
    complex_added_mass,
    crossover_time,
    float_profile,
    free_motion,
    free_motion_tail,
    heave_pole,
    open_float_estimate,
    pole_count,
    released_float,
    second_pole,
    thin_constants,
    thin_float_mass,
    thin_float_radiation,
    thin_float_stiffness,
)
from hydroelastic.modal import thin_float_decay as decay
from hydroelastic.modal.complex_moments import complex_wave_moment
from hydroelastic.modal.float_profiles import FloatShape, Profile
from hydroelastic.modal.thin_float_radiation import natural_rate
from hydroelastic.modal.thin_shapes import inertia_factor, wave_moment
from hydroelastic.modal.wave_integral import greatest_angle, wave_integral

REFERENCE = json.loads((Path(__file__).parent / "reference" / "two_fluid_float.json").read_text(encoding="utf-8"))
CASES = {case["id"]: case for case in REFERENCE["cases"]}
MOTIONS = [name for name in CASES if name.startswith("f_")]
POLES = [name for name in CASES if name.startswith(("pole_", "f_wedge", "f_parabola", "f_ellipse"))]
EPS = np.finfo(float).eps
SHAPES: tuple[FloatShape, ...] = ("exponential", "wedge", "parabola", "ellipse")
# Half-height, total density and g* are 1, so that SI values are those in units of b².
UNIT = TwoLayers(density_below=1.0, depth_below=math.inf, gravity=1.0)
CHANNEL = TwoLayers(density_below=1.0, density_above=0.8, depth_below=2.0, depth_above=1.5, gravity=9.81)


def thin(shape: FloatShape, slenderness: float, tail: float = 0.0) -> Profile:
    return float_profile(shape, slenderness, 1.0, tail=tail)


def of_case(name: str) -> Profile:
    inputs = CASES[name]["inputs"]
    # A half-height other than 1 shows that only τ counts.
    return float_profile(inputs["shape"], 2.5 * float(inputs["tau"]), 2.5, tail=0.0)


def of_coupling(coupling: float) -> Profile:
    return thin("exponential", math.pi * coupling / (2 - coupling))


def number(pair: list[str]) -> complex:
    return complex(float(pair[0]), float(pair[1]))


def gauss(edges: npt.ArrayLike, points: int = 20) -> tuple[npt.NDArray, npt.NDArray]:
    nodes, weights = leggauss(points)
    half = np.diff(np.asarray(edges, dtype=float))[:, None] / 2
    return (np.asarray(edges)[:-1, None] + half * (nodes + 1)).ravel(), (half * weights).ravel()


def spectral(profile: Profile, layers: TwoLayers, time: npt.NDArray, cut: float) -> npt.NDArray:
    """f = (2/π) ∫ c b cos ωt/|c − ω²(m + a) − iωb|² dω, for floats wide enough to have a broad resonance."""
    omega, weights = gauss(np.concatenate([[0.0], np.geomspace(1e-9, 1e-2, 40), np.linspace(0.02, cut, 60 * int(cut))]))
    radiation = thin_float_radiation(profile, layers, omega)
    mass = thin_float_mass(profile, layers.density_below, layers.density_above)
    stiffness = thin_float_stiffness(profile, layers.density_below, layers.density_above, layers.gravity)
    answer = stiffness - omega**2 * (mass + radiation.added_mass) - 1j * omega * radiation.damping
    density = 2 / math.pi * stiffness * radiation.damping / np.abs(answer) ** 2
    return np.cos(np.multiply.outer(time, omega)) @ (weights * density)


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
    # Rounding of the phase, and the digits of the references: 14 of the slender parabola at the last time.
    ringing = np.exp(heave_pole(of_case(name)).frequency.real * theta)
    assert np.all(np.abs(motion.heave - reference) <= 8 * EPS * (1 + theta) * ringing + 1e-12 * np.abs(reference))
    assert np.all(np.abs(motion.heave - reference) <= motion.error + 1e-12 * np.abs(reference))
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


@pytest.mark.parametrize("name", ["ab_exponential", "ab_parabola"])
def test_reference_added_mass_and_damping(name: str) -> None:
    inputs, values = CASES[name]["inputs"], CASES[name]["values"]
    kappa = np.array([float(k) for k in inputs["kappa0"]])
    profile = thin(inputs["shape"], 0.1)
    radiation = thin_float_radiation(profile, UNIT, np.sqrt(kappa))
    added_mass = [float(a) for a in values["a_hat"]]
    # a crosses zero at κ = 1 for the exponential, and is a difference of terms of the size of J: absolute.
    np.testing.assert_allclose(radiation.added_mass / 0.1**2, added_mass, rtol=8 * EPS, atol=8 * EPS)
    np.testing.assert_allclose(
        radiation.damping / np.sqrt(kappa) / 0.1**2, [float(b) for b in values["b_hat"]], rtol=16 * EPS
    )
    assert radiation.infinite_added_mass == pytest.approx(0.1**2 * float(values["a_hat_inf"]), rel=4 * EPS, abs=0)


def test_reference_channel() -> None:
    case = CASES["open_parabola_rho0.8"]
    omega = np.array([float(w) for w in case["inputs"]["omega"]])
    radiation = thin_float_radiation(thin("parabola", 0.1), CHANNEL, omega)
    # The two methods behind the reference agree to 9e-14.
    np.testing.assert_allclose(radiation.added_mass, [float(a) for a in case["values"]["a"]], rtol=2e-13)
    np.testing.assert_allclose(radiation.damping, [float(b) for b in case["values"]["b"]], rtol=2e-14)


@pytest.mark.parametrize("shape", SHAPES)
def test_limits_of_added_mass_and_damping(shape: FloatShape) -> None:
    profile = thin(shape, 0.1)
    kappa = np.array([1e-12, 1e-10, 1e6, 4e6])
    radiation = thin_float_radiation(profile, UNIT, np.sqrt(kappa))
    added_mass, damping = radiation.added_mass / 0.01, radiation.damping / np.sqrt(kappa) / 0.01
    # a ~ −(4/π) ln κ and b → 4 up to O(κ ln κ) and O(κ).
    assert added_mass[0] - added_mass[1] == pytest.approx(4 / math.pi * math.log(100), rel=1e-8, abs=0)
    assert damping[0] == pytest.approx(4, rel=1e-11, abs=0)
    # a ~ a_∞ − (4/π) ∫R² dκ/κ₀, next term O(ln κ/κ²).
    whole = quad(lambda u: float(wave_moment(profile, math.exp(u))) ** 2 * math.exp(u), -40, 40, limit=400)[0]
    missing = 2 / math.pi * inertia_factor(profile) - added_mass[2:]
    np.testing.assert_allclose(missing * kappa[2:], 4 / math.pi * whole, rtol=5e-5)
    # R ~ 1/κ where the slope is −b/h at y = 0, 2/κ² or 1/κ² where it is −2by/h² or −by/h².
    moment = {"exponential": 1 / kappa, "wedge": 1 / kappa, "parabola": 2 / kappa**2, "ellipse": 1 / kappa**2}[shape]
    np.testing.assert_allclose(damping[2:], 4 * moment[2:] ** 2, rtol=1e-5)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("layers", [UNIT, CHANNEL], ids=["deep", "channel"])
def test_added_mass_and_damping_are_a_hilbert_pair(shape: FloatShape, layers: TwoLayers) -> None:
    """a − a_∞ = (2/π) PV∫ b dω'/(ω'² − ω²), with the pole midway between nodes of the trapezoidal rule in ln ω'."""
    profile = thin(shape, 0.1, tail=0.3)
    for omega in (0.2, 1.0, 3.0):
        nodes = omega * np.exp(0.1 * (np.arange(-360, 360) + 0.5))
        # b falls at least like 1/ω³, and does not grow towards ω = 0: 1e-12/ω² is left there.
        damping = np.zeros_like(nodes)
        felt = (nodes < 1e6) & (nodes > 1e-12)
        damping[felt] = thin_float_radiation(profile, layers, nodes[felt]).damping
        integral = 0.1 * np.sum(nodes * damping / (nodes**2 - omega**2))
        radiation = thin_float_radiation(profile, layers, omega)
        difference = radiation.added_mass - radiation.infinite_added_mass
        assert difference == pytest.approx(2 / math.pi * integral, abs=1e-8 * radiation.infinite_added_mass)


def test_channel_tends_to_deep_water_and_to_long_waves() -> None:
    profile = thin("parabola", 0.1)
    omega = np.array([0.5, 1.3, 5.0])
    deep = TwoLayers(density_below=1.0, density_above=0.8, depth_below=math.inf, gravity=9.81)
    far = thin_float_radiation(profile, deep, omega)
    for below, above in ((1e4, 1e4), (math.inf, 1e4), (1e4, math.inf)):
        layers = TwoLayers(density_below=1.0, density_above=0.8, depth_below=below, depth_above=above, gravity=9.81)
        near = thin_float_radiation(profile, layers, omega)
        # The bottom is felt as (h/depth)²/κ.
        np.testing.assert_allclose(near.added_mass, far.added_mass, rtol=1e-6)
        np.testing.assert_allclose(near.damping, far.damping, rtol=1e-13)
    slow = thin_float_radiation(profile, CHANNEL, [1e-6, 1e-5])
    speed = math.sqrt(0.2 * 9.81 / (0.8 / 1.5 + 1 / 2))
    np.testing.assert_allclose(slow.damping, 2 * 0.1**2 * 0.2 * 9.81 / speed, rtol=1e-9)
    assert slow.added_mass[0] == pytest.approx(slow.added_mass[1], rel=1e-8, abs=0)


def test_complex_added_mass_is_that_of_real_frequencies_and_vanishes_with_the_stiffness_at_resonance() -> None:
    layers = TwoLayers(density_below=1000.0, density_above=850.0, depth_below=math.inf, gravity=9.81)
    for shape in SHAPES:
        profile = float_profile(shape, 0.3, 2.0, tail=0.0)
        omega = np.array([0.1, 1.0, 4.0])
        radiation = thin_float_radiation(profile, layers, omega)
        expected = radiation.added_mass + 1j * radiation.damping / omega
        # Rounding of the complex value, whose real part is not small beside a_∞.
        scale = radiation.infinite_added_mass
        np.testing.assert_allclose(
            complex_added_mass(profile, layers, -1j * omega), expected, rtol=0, atol=1e-14 * scale
        )
        estimate = open_float_estimate(profile, layers, omega)
        assert estimate.resonance is not None
        rate = -1j * estimate.resonance
        force = (estimate.mass + complex_added_mass(profile, layers, rate)) * rate**2 + estimate.stiffness
        assert abs(force) < 1e-13 * estimate.stiffness


@pytest.mark.parametrize("shape", SHAPES)
def test_wave_integral_is_analytic(shape: FloatShape) -> None:
    """No jump on the imaginary axis, where ln z² for 2 Ln z would have one; Cauchy's integral around a point on it."""
    profile = thin(shape, 0.1)
    for centre in (1j, 1e-3j, 30j):
        around = centre * (1 + 0.4 * np.exp(2j * math.pi * np.arange(64) / 64))
        here = complex(wave_integral(profile, centre))
        assert np.mean(wave_integral(profile, around)) == pytest.approx(here, rel=4e-15, abs=0)
    # On the axis Im G = −πR².
    z = 1j * np.geomspace(1e-3, 5, 7)
    waves = -math.pi * wave_moment(profile, np.abs(z) ** 2) ** 2
    np.testing.assert_allclose(wave_integral(profile, z).imag, waves, rtol=0, atol=1e-14)
    assert complex(wave_integral(profile, 0.3 - 2j)) == complex(wave_integral(profile, 0.3 + 2j)).conjugate()
    with pytest.raises(ValueError, match="must not be 0"):
        wave_integral(profile, 0.0)
    if shape != "exponential":
        with pytest.raises(ValueError, match="angle"):
            wave_integral(profile, -1.0 + 0.1j)


def test_wave_integral_of_the_exponential_by_both_ways() -> None:
    """The trapezoidal rule of other shapes, for the exponential with a very distant end, beside the closed form."""
    z = np.array([1 + 1j, 0.3 + 1e-3j, 1j, 1e-6j, 1e3j, -0.4 + 1j, -0.1 + 1j, 1.001, 0.9, 0.87])
    endless = wave_integral(thin("exponential", 0.1), z)
    np.testing.assert_allclose(wave_integral(thin("exponential", 0.1, tail=1e-300), z), endless, rtol=1e-14)
    # z = 1 is no singularity, z = −1 a double pole at which F is finite: −1.
    assert complex(wave_integral(thin("exponential", 0.1), 1.0)) == pytest.approx(0.5, rel=EPS, abs=0)
    constants = thin_constants(thin("exponential", 0.1))
    close = -1 + 1e-7j
    inertia = 1 + constants.coupling * complex(wave_integral(thin("exponential", 0.1), close))
    assert close * inertia / (close**2 * inertia + constants.frequency_squared) == pytest.approx(-1, abs=1e-6)


@pytest.mark.parametrize("profile", [thin(shape, 0.1, tail=0.2) for shape in SHAPES], ids=SHAPES)
def test_complex_moment_against_adaptive_quadrature(profile: Profile) -> None:
    """|κ| on both sides of every change of formula."""
    for size in (1e-6, 0.5, 1.999, 2.001, 30.0, 199.0, 201.0, 1e3):
        for angle in (0.0, 0.7, -1.3):
            kappa = size * np.exp(1j * angle)
            y, weights = gauss(np.concatenate([[0.0], np.geomspace(1e-6, 1, 400)]))
            if profile.shape == "ellipse":
                height = np.sin(math.pi / 2 * y)
                value = np.sum(math.pi / 2 * weights * height * np.exp(-kappa * height))
            else:
                y, weights = profile.extent * y, profile.extent * weights
                value = np.sum(-profile.slope_at(y) / 0.1 * weights * np.exp(-kappa * y))
            assert complex(complex_wave_moment(profile, kappa)) == pytest.approx(complex(value), abs=1e-14, rel=1e-11)


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


def test_crossover_of_the_references() -> None:
    assert crossover_time(of_coupling(1e-4)) == pytest.approx(9.2e5, rel=5e-3, abs=0)
    assert crossover_time(of_coupling(0.1)) == pytest.approx(316, rel=2e-3, abs=0)
    with pytest.raises(NoEstimateError, match="at all times"):
        crossover_time(of_coupling(1.99))


@pytest.mark.parametrize("shape", ["exponential", "wedge"])
def test_the_whole_motion_has_mean_zero(shape: FloatShape) -> None:
    """∫ f dθ = 0: the transform vanishes at z = 0. The rest beyond T follows from the tail, next term O(ln T/T³)."""
    profile = thin(shape, 0.3)
    end = 2e3
    theta, weights = gauss(np.linspace(0, end, 1500))
    rest = -4 * 0.3 / math.pi / end
    assert weights @ free_motion(profile, theta).heave + rest == pytest.approx(0, abs=1e-7)


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


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("slenderness", [1.0, 2.0, 5.0])
def test_wide_floats_against_the_spectrum(shape: FloatShape, slenderness: float) -> None:
    """f from a and b at real frequencies, for floats whose second pole comes near the ray."""
    profile = thin(shape, slenderness, tail=0.05)
    theta = np.array([0.0, 0.7, 3.0, 20.0])
    # The integrand falls like ω⁻⁷ at least: 2e-9 is left beyond 30.
    np.testing.assert_allclose(
        free_motion(profile, theta).heave, spectral(profile, UNIT, theta, 30.0), rtol=0, atol=2e-8
    )


def test_both_plans_of_the_ray_agree(monkeypatch: pytest.MonkeyPatch) -> None:
    """Near ε = 1/2, where the poles of the exponential are closest, one or both of them to the right of the ray."""
    theta = np.array([0.0, 0.1, 2.0, 30.0, 1e3])
    for coupling in (0.3, 0.45, 0.5, 0.6):
        motions = []
        for threshold in (0.0, 1.0):
            monkeypatch.setattr(decay, "_BOTH_POLES", threshold)
            decay._plan.cache_clear()
            motions.append(free_motion(of_coupling(coupling), theta).heave)
        np.testing.assert_allclose(*motions, rtol=1e-12, atol=4 * EPS)
    decay._plan.cache_clear()


def test_slender_floats_and_late_times() -> None:
    """τθ fixed while τ → 0: f → e^{−τθ/4} cos θ for the exponential, with a rounding of the phase of θ·ulp."""
    for slenderness in (1e-3, 1e-5, 1e-7):
        theta = np.array([0.5, 1.0, 3.0]) / slenderness
        simple = np.exp(-slenderness * theta / 4) * np.cos(theta)
        motion = free_motion(thin("exponential", slenderness), theta)
        np.testing.assert_allclose(motion.heave, simple, rtol=0, atol=2 * slenderness + 4 * EPS * theta[-1])
        assert motion.error.max() < 20 * EPS * theta[-1]
    many = free_motion(thin("wedge", 0.1), np.linspace(0, 1e4, 2501).reshape(61, 41))
    assert many.heave.shape == many.error.shape == (61, 41)
    assert np.all(np.abs(many.heave) <= 1)


@pytest.mark.parametrize("shape", SHAPES)
def test_motion_in_a_channel_is_that_in_a_long_box_before_waves_return(shape: FloatShape) -> None:
    """Modes of a closed box of length L: no wave is back before L/c₀, and up to then box and channel cannot differ."""
    profile = thin(shape, 0.1, tail=0.3)
    length = 100.0
    body = FloatInTank(
        layers=CHANNEL,
        tank_length=length,
        position=length / 2,
        mass=thin_float_mass(profile, 1.0, 0.8),
        stiffness=thin_float_stiffness(profile, 1.0, 0.8, 9.81),
        profile=profile,
    )
    modes = box_modes(body, 1200)
    rise = 2 * 0.1 / length
    weights = modes.participation / (1 + rise)
    time = np.array([0.0, 0.5, 2.0, 5.0, 12.0, 20.0, 30.0])
    assert time[-1] < 0.5 * length / math.sqrt(0.2 * 9.81 / (0.8 / 1.5 + 1 / 2))
    box = rise / (1 + rise) + np.cos(np.multiply.outer(time, modes.omega)) @ weights
    motion = released_float(profile, CHANNEL, time)
    # What the first modes leave out, from their sum at t = 0: 4e-11 for the parabola, 4e-7 for the exponential.
    assert abs(box[0] - 1) < 1e-6
    np.testing.assert_allclose(motion.heave, box, rtol=0, atol=2 * abs(box[0] - 1) + 1e-10)
    assert motion.error.max() < 1e-11


def test_channel_motion_and_resonance_tend_to_those_of_deep_water() -> None:
    profile = thin("ellipse", 0.1)
    deep = TwoLayers(density_below=1.0, density_above=0.8, depth_below=math.inf, gravity=9.81)
    far = TwoLayers(density_below=1.0, density_above=0.8, depth_below=1e3, depth_above=1e3, gravity=9.81)
    time = np.array([0.0, 3.0, 10.0, 30.0])
    reference = released_float(profile, deep, time).heave
    np.testing.assert_array_equal(reference, free_motion(profile, time * natural_rate(profile, deep)).heave)
    # The bottom acts at the order (h/depth)², and later.
    np.testing.assert_allclose(released_float(profile, far, time).heave, reference, rtol=0, atol=2e-5)
    assert channel_resonance(profile, far) == pytest.approx(
        open_float_estimate(profile, deep, 1.0).resonance, rel=1e-7, abs=0
    )


def test_channel_resonance_is_the_late_motion() -> None:
    """Two late values of f fall as e^{−iωt} does: without a tail it is all that is left."""
    profile = thin("parabola", 0.1)
    resonance = channel_resonance(profile, CHANNEL)
    time = np.linspace(60, 100, 81)
    basis = np.exp(-1j * resonance * time)
    design = np.stack([basis.real, basis.imag], axis=1)
    motion = channel_free_motion(profile, CHANNEL, time).heave
    fit, *_ = np.linalg.lstsq(design, motion, rcond=None)
    assert np.linalg.norm(design @ fit - motion) < 1e-4 * np.linalg.norm(motion)
    for offset in (1e-3, 1e-3j):
        other = np.exp(-1j * (resonance + offset) * time)
        wrong = np.stack([other.real, other.imag], axis=1)
        fit, *_ = np.linalg.lstsq(wrong, motion, rcond=None)
        assert np.linalg.norm(wrong @ fit - motion) > 1e-3 * np.linalg.norm(motion)


def test_estimate_in_si_units() -> None:
    """Densities enter by their sum and by g*, lengths by the half-height."""
    profile = float_profile("wedge", 0.4, 4.0)
    layers = TwoLayers(density_below=1025.0, density_above=900.0, depth_below=math.inf, gravity=9.81)
    rate = math.sqrt(9.81 * 125 / 1925 / 4)
    estimate = open_float_estimate(profile, layers, [])
    assert estimate.radiation.added_mass.shape == (0,)
    z = number(CASES["f_wedge_tau0.1"]["values"]["z1"])
    assert estimate.resonance == pytest.approx(complex(z.imag, z.real) * rate, rel=1e-14, abs=0)
    assert estimate.crossover_time == pytest.approx(crossover_time(thin("wedge", 0.1)) / rate, rel=1e-12, abs=0)
    motion = released_float(profile, layers, 3.0 / rate)
    assert motion.heave == pytest.approx(float(CASES["f_wedge_tau0.1"]["values"]["f"][2]), abs=1e-14)
    assert open_float_estimate(thin("parabola", 0.1), CHANNEL, [1.0]).crossover_time is None


def test_refusals() -> None:
    blunt = float_profile("rectangle", 0.1, 1.0)
    for refused in (
        lambda: thin_float_radiation(blunt, UNIT, 1.0),
        lambda: free_motion(blunt, 1.0),
        lambda: heave_pole(blunt),
        lambda: wave_integral(blunt, 1j),
        lambda: open_float_estimate(blunt, CHANNEL, 1.0),
    ):
        with pytest.raises(NoEstimateError, match="flat edges"):
            refused()
    with pytest.raises(NoEstimateError, match="reaches"):
        released_float(thin("exponential", 0.1), CHANNEL, 1.0)
    free = TwoLayers(density_below=1.0, density_above=0.8, depth_below=2.0, depth_above=2.0, gravity=9.81, top="free")
    with pytest.raises(NoEstimateError, match="rigid lid"):
        thin_float_radiation(thin("wedge", 0.1), free, 1.0)
    with pytest.raises(NoEstimateError, match="too many"):
        channel_free_motion(thin("wedge", 0.1), CHANNEL, 1e7)
    with pytest.raises(NoEstimateError, match="so wide"):
        free_motion(thin("wedge", 1e4), 1.0)
    for time in (-1.0, math.nan, math.inf):
        with pytest.raises(ValueError, match="times"):
            free_motion(thin("wedge", 0.1), time)
        with pytest.raises(ValueError, match="times"):
            channel_free_motion(thin("wedge", 0.1), CHANNEL, time)
    for omega in (0.0, -1.0, math.nan):
        with pytest.raises(ValueError, match="frequencies"):
            thin_float_radiation(thin("wedge", 0.1), UNIT, omega)
    with pytest.raises(ValueError, match="angle"):
        pole_count(thin("wedge", 0.1), 3.0)
