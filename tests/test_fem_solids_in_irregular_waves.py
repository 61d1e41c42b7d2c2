"""Solids of revolution in irregular waves and over time, against their response in regular waves."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from solids_at_sea import GRAVITY, MOTIONS, problem_of, solved

from hydroelastic.fem.open_water.requests import (
    ImpulseResponseRequest,
    MotionRequest,
    RadiationRequest,
    RegularWave,
    ResponseRequest,
    SpectrumRequest,
)
from hydroelastic.fem.open_water.spectrum import _further_orders
from hydroelastic.physics.wave_spectrum import PeakedSpectrum

pytestmark = pytest.mark.slow

SPHERE: dict[str, Any] = {"shape": "sphere", "radius": 1.0, "vertical_centre_of_gravity": -0.5}
HELD: dict[str, Any] = {
    "attachment": [{"body": 1, "at": [0.0, -0.5], "stiffness": [0.0, 2e3, 0.0], "damping": [1e3, 5e2, 0.0]}]
}
SPECTRUM = PeakedSpectrum(height=1.0, period=3.0, enhancement=3.3)
POINT = (0.5, 0.25)


def test_waves_of_fixed_orders_are_told_at_the_frequencies_asked_for() -> None:
    """With their errors: those of all frequencies of the order ended spectra of floes with a traceback."""
    request = SpectrumRequest(spectrum=SPECTRUM, words="", highest=5.0)
    omegas = np.linspace(1.5, 4.5, 5)
    curves = _further_orders(problem_of([SPHERE], math.inf, 1e-2), request, omegas)(2)
    assert len(curves.responses) == len(curves.errors) == len(curves.reduced) == len(omegas)


def test_irregular_waves_are_regular_ones_summed() -> None:
    """Transfer functions of motions and of a point, the mean drift force and the power of the damper."""
    request = SpectrumRequest(spectrum=SPECTRUM, words="", points=((0, POINT),), highest=5.0)
    (found,) = solved([SPHERE], math.inf, 1e-4, request, **HELD).spectrum
    assert found.dofs == MOTIONS
    omegas = np.geomspace(*request.band, 60)
    (regular,) = solved([SPHERE], math.inf, 1e-4, ResponseRequest(omega=tuple(omegas)), **HELD).response
    amplitudes = regular.amplitudes[:, 0]
    heave, surge, pitch = amplitudes.T
    # Pitch lifts what lies at x > 0, and pushes back what lies above its centre.
    known = np.stack([*amplitudes.T, heave + POINT[0] * pitch, surge - (POINT[1] + 0.5) * pitch], axis=1)
    between = CubicSpline(found.omega, found.transfer[:, :5])(omegas)
    sizes = np.abs(known).max(axis=0)
    np.testing.assert_allclose(between / sizes, known / sizes, atol=1e-3)
    # Sums over sixty frequencies, which cubic splines join to 1e-3.
    fine = np.linspace(omegas[0], omegas[-1], 20001)
    density = SPECTRUM.density(fine)
    drift = CubicSpline(omegas, regular.drift_force[:, 0])(fine)
    # Waves beyond the last one push as that does.
    mean = 2.0 * (np.trapezoid(drift * density, fine) + drift[-1] * SPECTRUM.tail(float(omegas[-1]), 0))
    assert found.mean_drift_force == pytest.approx(mean, rel=3e-3)
    speeds = 1e3 * np.abs(omegas * heave) ** 2 + 5e2 * np.abs(omegas * surge) ** 2
    power = np.trapezoid(CubicSpline(omegas, speeds)(fine) * density, fine)
    assert found.mean_absorbed_power == pytest.approx(power, rel=3e-3)


@pytest.mark.parametrize("depth", [math.inf, 2.0])
def test_impulse_responses_give_added_mass_and_damping_back(depth: float) -> None:
    """To 1e-6, of all motions together; over a bed heave has a logarithm at low frequencies."""
    request = ImpulseResponseRequest(times=(0.0, 1.0, 10.0))
    (table,) = solved([SPHERE], depth, 1e-6, request).impulse_response
    # Measured 2.5e-7 in deep water; the estimate, 1.3e-5, is of the whole ray.
    assert table.causality_error.max() < 1e-6
    assert table.causality_error.max() < table.relative_error < 2e-5
    omega = float(table.omega[12])
    (known,) = solved([SPHERE], depth, 1e-6, RadiationRequest(omega=(omega, math.inf))).radiation
    size = np.abs(known.added_mass[0]).max()
    np.testing.assert_allclose(table.added_mass[12], known.added_mass[0], atol=2e-6 * size)
    np.testing.assert_allclose(table.radiation_damping[12], known.radiation_damping[0], atol=2e-6 * omega * size)
    np.testing.assert_allclose(table.infinite_frequency_added_mass, known.added_mass[1], atol=2e-6 * size)


def test_water_that_sloshes_in_a_gap_rings_on_in_the_impulse_response() -> None:
    """The resonance of order 1 between a spar and a ring about it gives K most of its size."""
    spar = {"shape": "cylinder", "radius": 1.0, "draught": 2.0}
    ring = {"shape": "cylinder", "radius": 3.0, "inner_radius": 2.0, "draught": 0.5}
    request = ImpulseResponseRequest(times=(0.0, 10.0, 20.0))
    (table,) = solved([spar, ring], 8.0, 1e-3, request, motions=("surge",)).impulse_response
    # Without its exponential 2.6; infinitely many weaker ones lie beyond the highest frequency of the mesh.
    assert table.causality_error.max() < 2e-3


def test_motions_settle_to_those_in_regular_waves() -> None:
    omega, amplitude = 2.0, 0.3
    times = tuple(np.linspace(60.0, 70.0, 21).tolist())
    wave = RegularWave(omega=omega, amplitude=amplitude, phase=0.4)
    requests = MotionRequest(times=times, waves=(wave,), ramp=10.0), ResponseRequest(omega=(omega,))
    solution = solved([SPHERE], math.inf, 1e-5, *requests, **HELD)
    (table,), (regular,) = solution.motion, solution.response
    turning = np.exp(-1j * omega * np.array(times))[:, None]
    known = (turning * amplitude * np.exp(0.4j) * regular.amplitudes[0, 0]).real
    sizes = np.abs(known).max(axis=0)
    np.testing.assert_allclose(table.steady / sizes, known / sizes, atol=1e-4)
    # Surge on its spring of 2 kN/m and pitch die out slowly.
    np.testing.assert_allclose(table.displacement / sizes, known / sizes, atol=2e-2)


def test_a_tuned_absorber_takes_the_wavelength_over_two_pi() -> None:
    """At resonance with a damping equal to that of radiation a heaving body takes the power of 1/k of a crest."""
    omega = 2.0
    (free,) = solved([SPHERE], math.inf, 1e-5, RadiationRequest(omega=(omega,)), motions=("heave",)).radiation
    spring = float(omega**2 * (free.inertia + free.added_mass[0])[0, 0] - free.stiffness[0, 0])
    held = [{"body": 1, "stiffness": [spring, 0.0, 0.0], "damping": [float(free.radiation_damping[0, 0, 0]), 0.0, 0.0]}]
    (response,) = solved(
        [SPHERE], math.inf, 1e-5, ResponseRequest(omega=(omega,)), motions=("heave",), attachment=held
    ).response
    # Absorption is told over the power of 1/k of the crest.
    assert response.absorption[0, 0] == pytest.approx(1.0, abs=1e-4)
    assert response.wavenumbers[0, 0] == pytest.approx(omega**2 / GRAVITY)
