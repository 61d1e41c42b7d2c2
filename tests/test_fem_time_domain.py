"""Impulse responses as exponentials, and Cummins' equation, without any solver of the frequency domain."""

from math import pi

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from hydroelastic.fem.time_domain.motion import MovingBodies, UnsolvedMotionError, WaveForces
from hydroelastic.fem.time_domain.radiation_memory import RadiationMemory, damping_tail, memory_on_ray, ray_radii
from hydroelastic.physics.attachments import OutsideForces

# K̂ = C p/(p² + 2γp + ω₀²), so that K = C e^{−γt} (cos νt − (γ/ν) sin νt), ν² = ω₀² − γ².
STRENGTH, GAMMA, NATURAL = 1.3, 0.6, 1.4
ANGLE = 0.2
LIMIT = np.array([[2.0]])
NO_POLES: dict[str, np.ndarray] = {"poles": np.zeros(0, dtype=complex), "residues": np.zeros((0, 1, 1), dtype=complex)}


def beyond_limit(p: np.ndarray) -> np.ndarray:
    return np.asarray(STRENGTH / (p**2 + 2.0 * GAMMA * p + NATURAL**2))


@pytest.fixture(scope="module")
def memory() -> RadiationMemory:
    radii = ray_radii(1e-6, 1e14, ANGLE, 1e-10)
    p = -1j * radii * np.exp(-1j * ANGLE)
    return memory_on_ray(beyond_limit(p)[:, None, None], LIMIT, radii, ANGLE, **NO_POLES)


def test_poles_before_the_ray_are_exponentials_of_their_own() -> None:
    """K of the same oscillator nearly without damping, whose poles the ray passes by: without them K is zero."""
    damping, natural = 0.01, 1.3
    radii = ray_radii(1e-6, 1e6, ANGLE, 1e-10)
    p = -1j * radii * np.exp(-1j * ANGLE)
    nu = np.sqrt(natural**2 - damping**2)
    pole = -damping + 1j * nu

    def kernel(rate: np.ndarray) -> np.ndarray:
        return np.asarray(STRENGTH / (rate**2 + 2.0 * damping * rate + natural**2))

    # K̂ = pS/((p − p₁)(p − p̄₁)).
    residues = np.array([[[2.0 * pole * STRENGTH / (pole - pole.conjugate())]]])
    found = memory_on_ray(
        kernel(p)[:, None, None],
        LIMIT,
        radii,
        ANGLE,
        poles=np.array([pole]),
        residues=residues,
    )
    times = np.linspace(0.1, 12.0, 40)
    known = STRENGTH * np.exp(-damping * times) * (np.cos(nu * times) - damping / nu * np.sin(nu * times))
    # The rule's 1e-10, and the cut end of the ray.
    np.testing.assert_allclose(found.impulse_response(times)[:, 0, 0], known, atol=1e-8)


def test_what_is_beyond_the_ray_is_fitted() -> None:
    """A ray that ends at the highest frequency, of the same oscillator, whose damping falls like ω⁻²."""
    highest = 8.0
    radii = highest / ray_radii(1.0, 1e8, ANGLE, 1e-10)[::-1]
    p = -1j * radii * np.exp(-1j * ANGLE)
    ray = memory_on_ray(beyond_limit(p)[:, None, None], LIMIT, radii, ANGLE, **NO_POLES)

    def hydrodynamic(omega: np.ndarray) -> np.ndarray:
        return np.asarray(LIMIT + beyond_limit(-1j * omega)[:, None, None])

    tail = damping_tail(hydrodynamic, highest, np.array([1e-9]), np.array([2.0]), has_peaks=False)
    # K(0) = C, of which what is beyond the highest frequency is C (2/π) 2γ/ω or 10 %.
    assert tail.beyond[0, 0] > 0.05 * STRENGTH
    assert abs(tail.start[0, 0] - STRENGTH) < tail.error[0] * STRENGTH < 0.02 * STRENGTH
    fitted, others = np.geomspace(0.01, highest, 100), np.geomspace(0.013, 0.9 * highest, 23)
    rates = 1j * np.exp(1j * ANGLE) * highest * np.exp(np.arange(np.log(0.5), np.log(60.0), 0.1))
    found = ray.completed(fitted, hydrodynamic(fitted), rates, tail, (1e-6, 1e-3))
    assert np.abs(ray.hydrodynamic(others) - hydrodynamic(others)).max() > 1e-3
    # The error of H in the fit, ten times at the ends.
    np.testing.assert_allclose(found.hydrodynamic(others), hydrodynamic(others), atol=1e-5)
    assert abs(found.impulse_response(np.zeros(1))[0, 0, 0] - STRENGTH) < tail.error[0] * STRENGTH


def test_added_mass_and_damping_come_back(memory: RadiationMemory) -> None:
    omega = np.geomspace(1e-2, 30.0, 50)
    whole = LIMIT[0, 0] + beyond_limit(-1j * omega)
    # The rule's 1e-10, and the cut ends of the ray.
    np.testing.assert_allclose(memory.added_mass(omega)[:, 0, 0], whole.real, rtol=0.0, atol=1e-8)
    np.testing.assert_allclose(memory.radiation_damping(omega)[:, 0, 0], omega * whole.imag, rtol=0.0, atol=1e-8)


def test_impulse_response_is_the_closed_form(memory: RadiationMemory) -> None:
    # K(0) is that of the ray without its end.
    times = np.linspace(0.1, 12.0, 40)
    nu = np.sqrt(NATURAL**2 - GAMMA**2)
    exact = STRENGTH * np.exp(-GAMMA * times) * (np.cos(nu * times) - GAMMA / nu * np.sin(nu * times))
    np.testing.assert_allclose(memory.impulse_response(times)[:, 0, 0], exact, rtol=0.0, atol=1e-5)


def bodies(
    memory: RadiationMemory, *, damping: float = 0.0, quadratic: float = 0.0, spring: float = 3.0
) -> MovingBodies:
    return MovingBodies(
        memory=memory,
        inertia=np.array([[1.0]]),
        stiffness=np.array([[1.0]]),
        outside=OutsideForces(
            stiffness=np.array([[spring - 1.0]]),
            damping=np.array([[damping]]),
            drag=np.array([quadratic] if quadratic else []),
            paths=np.ones((1 if quadratic else 0, 1)),
        ),
    )


@pytest.mark.parametrize("damping", [0.4, pytest.param(0.0, marks=pytest.mark.slow)])
def test_regular_waves_end_in_the_motion_of_the_frequency_domain(memory: RadiationMemory, damping: float) -> None:
    moving = bodies(memory, damping=damping)
    waves = WaveForces(omega=np.array([0.9, 1.7]), forces=np.array([[1.0 + 0.5j], [0.3j]]), ramp=10.0)
    times = np.linspace(0.0, 400.0, 401)
    displacement, velocity = moving.motion(waves, times, 1e-9)
    turning = np.exp(-1j * np.outer(times, waves.omega))
    amplitudes = np.array(
        [
            force / (3.0 - w**2 * (1.0 + LIMIT[0, 0] + beyond_limit(np.array(-1j * w))) - 1j * w * damping)
            for w, force in zip(waves.omega, waves.forces, strict=True)
        ]
    )
    late = times > 360.0
    # The transient has decayed to less than 1e-7; the exponentials without states are left out to (1/30)³ of the last
    # part of K̂, 10 %.
    np.testing.assert_allclose(displacement[late], (turning @ amplitudes).real[late], rtol=0.0, atol=4e-6)
    np.testing.assert_allclose(
        velocity[late], (turning @ (-1j * waves.omega[:, None] * amplitudes)).real[late], rtol=0.0, atol=4e-6
    )
    np.testing.assert_allclose(moving.steady(waves), amplitudes, rtol=1e-8)


def test_quadratic_damping_dissipates_as_its_equivalent_linear_one(memory: RadiationMemory) -> None:
    omega, quadratic = 1.05, 0.5
    waves = WaveForces(omega=np.array([omega]), forces=np.array([[1.0 + 0.0j]]), ramp=20.0)
    times = np.linspace(0.0, 200.0, 2001)
    displacement, _ = bodies(memory, quadratic=quadratic).motion(waves, times, 1e-8)
    amplitude = np.abs(displacement[times > 150.0]).max()
    # 8/(3π) β ωA does the same work in a period. Third harmonics, which it leaves out, are of a per cent.
    linear = bodies(memory, damping=8.0 / (3.0 * pi) * quadratic * omega * amplitude)
    assert abs(linear.steady(waves)[0, 0]) == pytest.approx(amplitude, rel=0.01)
    assert abs(bodies(memory, quadratic=quadratic).steady(waves)[0, 0]) == pytest.approx(amplitude, rel=0.01)
    assert abs(bodies(memory).steady(waves)[0, 0]) > 1.1 * amplitude


def test_drag_in_many_waves_is_damping_by_the_deviation_of_the_velocity(memory: RadiationMemory) -> None:
    """√(8/π) βσ, σ² = ½ Σ |ωξ|²."""
    quadratic = 0.5
    waves = WaveForces(omega=np.array([0.9, 1.05, 1.7]), forces=np.array([[1.0 + 0.5j], [0.8], [0.3j]]))
    found = bodies(memory, quadratic=quadratic).steady(waves)
    deviation = np.sqrt(0.5 * np.sum(np.abs(waves.omega * found[:, 0]) ** 2))
    linear = bodies(memory, damping=np.sqrt(8.0 / pi) * quadratic * deviation)
    # The iteration for the damping ends at 1e-12.
    np.testing.assert_allclose(found, linear.steady(waves), rtol=1e-10)


def test_waves_grow_smoothly_to_their_height() -> None:
    waves = WaveForces(omega=np.zeros(1), forces=np.array([[2.0 + 0.0j]]), ramp=6.0)
    grown = [waves.at(time)[0] for time in (0.0, 2.0, 3.0, 4.0, 6.0, 9.0)]
    # 1 − cos 0°, 60°, 90°, 120°, 180°.
    assert grown == pytest.approx([0.0, 0.5, 1.0, 1.5, 2.0, 2.0], abs=1e-15)


@pytest.mark.parametrize("amplitude", [2.0, pytest.param(0.05, marks=pytest.mark.slow)])
def test_a_release_with_drag_is_that_of_an_independent_integration(memory: RadiationMemory, amplitude: float) -> None:
    """The force of the waves, K̂ξ̂′, is r′ of r″ + 2γr′ + ω₀²r = Cξ′: four states, integrated by another method."""
    damping, quadratic, spring = 0.1, 0.7, 3.0

    def rates(_time: float, state: np.ndarray) -> list[float]:
        x, v, r, s = state
        force = -spring * x - damping * v - quadratic * abs(v) * v - s
        return [v, force / (1.0 + LIMIT[0, 0]), s, STRENGTH * v - 2.0 * GAMMA * s - NATURAL**2 * r]

    times = np.linspace(0.0, 12.0, 25)
    known = solve_ivp(rates, (0.0, 12.0), [amplitude, 0.0, 0.0, 0.0], "Radau", times, rtol=1e-9, atol=1e-11).y
    still = WaveForces(omega=np.zeros(0), forces=np.zeros((0, 1), dtype=complex))
    moving = bodies(memory, damping=damping, quadratic=quadratic, spring=spring)
    displacement, velocity = moving.motion(still, times, 1e-7, np.array([amplitude]))
    # The exponentials without states are left out to (1/30)³ of the last part of K̂.
    np.testing.assert_allclose(displacement[:, 0], known[0], rtol=0.0, atol=4e-6 * amplitude)
    np.testing.assert_allclose(velocity[:, 0], known[1], rtol=0.0, atol=8e-6 * amplitude)


def test_what_grows_without_bound_is_refused(memory: RadiationMemory) -> None:
    waves = WaveForces(omega=np.array([1.0]), forces=np.array([[1.0 + 0.0j]]))
    with pytest.raises(UnsolvedMotionError):
        bodies(memory, spring=-40.0).motion(waves, np.linspace(0.0, 100.0, 11), 1e-6)
