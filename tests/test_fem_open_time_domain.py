"""Impulse responses of bodies in open water, and their motions over time, beside the frequency domain."""

from dataclasses import replace
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from mpi4py import MPI

from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.radiation import solve_radiation
from hydroelastic.fem.open_water.radiation_memory import solve_memory
from hydroelastic.fem.open_water.requests import (
    DecayRequest,
    ImpulseResponseRequest,
    MotionRequest,
    RadiationRequest,
    RegularWave,
    ResponseRequest,
)
from hydroelastic.fem.open_water.response import solve_response
from hydroelastic.fem.open_water.solve import OpenWaterSolution, solve_open_water
from hydroelastic.scenes.models import SeaScene, TankScene
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.open_water.run import solve_open

TOLERANCE, CREST = 1e-2, 1.5
WAVE = RegularWave(omega=2.2, amplitude=0.05, phase=0.3)
TIMES = tuple(np.linspace(0.0, 60.0, 301).tolist())


@cache
def problem(depth: float) -> OpenWaterProblem:
    body: dict[str, Any] = {"kind": "float", "shape": "ellipse", "position": 5.0, "half_width": 1.0, "half_height": 1.0}
    scene = TankScene(
        tank={"length": 10.0, "ends": "open"},
        liquid=[{"density": 1000.0, "depth": depth}],
        body=[{**body, "motions": ["heave"]}],
        analysis=[],
    )
    tank = replace(physical_tank(scene), phase_at=CREST)
    return OpenWaterProblem(comm=MPI.COMM_WORLD, tank=tank, tolerance=TOLERANCE)


@cache
def solved(depth: float) -> OpenWaterSolution:
    requests = (
        ImpulseResponseRequest(times=(0.0, 0.5, 2.0, 20.0)),
        MotionRequest(times=TIMES, waves=(WAVE,), waves_from="right", ramp=5.0),
    )
    return solve_open_water(problem(depth), requests)


@pytest.mark.slow_but("bed")
@pytest.mark.parametrize("depth", [np.inf, 3.0], ids=["inf", "bed"])
def test_impulse_responses_give_added_mass_and_damping_back(depth: float) -> None:
    solution = solved(depth)
    table = solution.impulse_response[0]
    assert not solution.reasons
    # Measured: 2e-5 in deep water, 1e-5 over a bed, both in the longest waves; the discretization error is larger.
    assert table.causality_error.max() < 2e-4
    assert np.median(table.causality_error) < 1e-5
    assert table.ogilvie_error.max() < 2e-4
    # Another mesh, another basis.
    places = slice(2, -3, 4)
    other = solve_radiation(problem(depth), RadiationRequest(omega=tuple(table.omega[places].tolist()))).table
    omega = other.omega[:, None, None]
    whole, own = (
        one.added_mass[chosen] + 1j * one.radiation_damping[chosen] / omega
        for one, chosen in ((other, slice(None)), (table, places))
    )
    # Over a bed b/ω of long waves is far larger than a.
    np.testing.assert_array_less(np.abs(own - whole), TOLERANCE * np.abs(whole))


def test_the_memory_of_water_that_sloshes_in_a_gap_gives_them_back_too() -> None:
    """Its resonances are terms of their own, and there is a sharp peak at each."""
    barge: dict[str, Any] = {"kind": "float", "shape": "rectangle", "half_width": 1.0, "half_height": 0.5}
    scene = TankScene(
        tank={"length": 10.0, "ends": "open"},
        liquid=[{"density": 1000.0, "depth": np.inf}],
        body=[barge | {"position": x, "motions": ["heave"]} for x in (3.85, 6.15)],
        analysis=[],
    )
    water = OpenWaterProblem(comm=MPI.COMM_WORLD, tank=physical_tank(scene), tolerance=TOLERANCE)
    memory = solve_memory(water, 20.0, 0)
    # Measured 3e-5, in the longest waves; of half of a resonance half of the peak is missed.
    assert memory.causality_error.max() < 2e-4


@pytest.mark.slow
def test_added_mass_and_damping_come_back_to_a_millionth() -> None:
    fine = replace(problem(np.inf), tolerance=2e-6)
    table = solve_open_water(fine, (ImpulseResponseRequest(times=(0.0, 50.0)),)).impulse_response[0]
    # Measured: 1.5e-7 of both.
    assert table.causality_error.max() < 1e-6
    assert table.ogilvie_error.max() < 1e-6


@pytest.mark.slow
def test_impulse_response_of_a_circle_decays_like_an_inverse_square() -> None:
    table = solved(np.inf).impulse_response[0]
    # b ~ hω of long waves in deep water leaves K ~ −(2/π) h/t², with h = ρ (2R)²: the waterplane is a wavemaker.
    h = 1000.0 * 4.0
    expected = -2.0 / np.pi * h / table.times[-1] ** 2
    # The next term is smaller by g^{-1}R/t² times a logarithm.
    assert table.impulse_response[-1, 0, 0] == pytest.approx(expected, rel=0.05)


@pytest.mark.slow_but("bed")
@pytest.mark.parametrize("depth", [np.inf, 3.0], ids=["inf", "bed"])
def test_regular_waves_end_in_the_response_of_the_frequency_domain(depth: float) -> None:
    table = solved(depth).motion[0]
    request = ResponseRequest(omega=(WAVE.omega,), waves_from="right")
    response = solve_response(problem(depth), request).table
    # The response is beside that crest; waves from the right have travelled from x = 5 to there.
    amplitude = response.amplitudes[0, 0, 0] * np.exp(1j * (5.0 - CREST) * response.wavenumbers[0, 0])
    wave = WAVE.amplitude * np.exp(1j * (WAVE.phase - WAVE.omega * table.times))
    late = table.times > 40.0
    grown = table.times >= table.ramp
    np.testing.assert_allclose(table.elevation[grown], wave.real[grown], rtol=0.0, atol=1e-12)
    expected = (amplitude * wave).real
    # Both keep the tolerance; after the transient an algebraic tail of 1e-4 of the amplitude is left.
    np.testing.assert_allclose(table.displacement[late, 0], expected[late], rtol=0.0, atol=2e-3 * abs(amplitude * 0.05))
    np.testing.assert_allclose(table.steady[:, 0], expected, rtol=0.0, atol=1e-3 * abs(amplitude * 0.05))


@pytest.mark.slow
def test_a_release_over_time_is_the_decay_of_the_frequency_domain() -> None:
    """Cummins' equation from a displacement, and the inverse Fourier transform of `decay.py`."""
    times = tuple(np.linspace(0.0, 20.0, 101).tolist())
    requests = (MotionRequest(times=times, waves=(), displacement={"heave": 0.1}), DecayRequest(heave=0.1, times=times))
    solution = solve_open_water(problem(np.inf), requests)
    assert not solution.reasons
    (motion,), (decay,) = solution.motion, solution.decay
    assert motion.displacement[0, 0] == pytest.approx(0.1)
    np.testing.assert_allclose(motion.displacement, decay.displacement, rtol=0.0, atol=TOLERANCE * 0.1)


@pytest.mark.slow
def test_a_moored_float_that_is_pulled_aside_swings_back_at_its_resonance() -> None:
    body = {"kind": "float", "shape": "ellipse", "half_width": 1.0, "half_height": 1.0, "motions": ["sway"]}
    times = tuple(np.linspace(0.0, 40.0, 801).tolist())
    scene = SeaScene(
        liquid=[{"density": 1000.0, "depth": 3.0}],
        body=[body],
        attachment=[{"stiffness": [0.0, 500.0, 0.0]}],
        analysis=[
            {"kind": "motion", "displacement": {"sway": 0.1}, "times": times},
            {"kind": "resonance", "count": 1},
        ],
        accuracy={"tolerance": TOLERANCE},
    )
    solution = solve_open(scene, MPI.COMM_WORLD, lambda _message: None)
    assert not solution.reasons
    (motion,), (resonance,) = solution.motion, solution.resonance
    sway, omega = motion.displacement[:, 0], resonance.omega[0]
    assert sway[0] == pytest.approx(0.1)
    # Re C e^{−iωt} between two zeros: half a period apart, with extremes that decrease by e^{−π γ/ω}.
    zeros = _zeros(motion.times, sway)
    assert np.diff(zeros)[1:3] == pytest.approx(np.pi / omega.real, rel=TOLERANCE)
    extremes = [np.abs(sway[(motion.times > low) & (motion.times < high)]).max() for low, high in pairwise(zeros[:4])]
    assert extremes[2] / extremes[1] == pytest.approx(np.exp(np.pi * omega.imag / omega.real), rel=3.0 * TOLERANCE)


def _zeros(times: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Times at which a motion passes zero."""
    before = np.flatnonzero(values[1:] * values[:-1] < 0.0)
    parts = values[before] / (values[before] - values[before + 1])
    return np.asarray(times[before] + parts * (times[before + 1] - times[before]))
