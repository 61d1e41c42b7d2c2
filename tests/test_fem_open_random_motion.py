"""Motions in random waves with drag, simulated, beside the stochastic linearisation of drag in the frequency domain."""

import numpy as np
import pytest
from mpi4py import MPI

from hydroelastic.fem.open_water.requests import MotionRequest, RegularWave, SpectrumRequest
from hydroelastic.fem.open_water.solve import solve_open_water
from hydroelastic.fem.stopwatch import Stopwatch
from hydroelastic.physics.wave_components import wave_components
from hydroelastic.physics.wave_spectrum import PeakedSpectrum
from hydroelastic.scenes.models import SeaScene
from hydroelastic.scenes.open_water.physics import open_water_problem

pytestmark = pytest.mark.slow

SPECTRUM = PeakedSpectrum(height=1.5, period=5.0, enhancement=3.3)
RAMP, DURATION, SEEDS = 30.0, 400.0, (1, 2)
# Standard deviations of the sample variance within which 99 % of samples lie.
CONFIDENCE = 2.58


def test_simulated_motions_have_the_standard_deviation_of_stochastic_linearisation() -> None:
    """With 99 % confidence, of sway with strong drag and of heave without.

    The variance of a sample of duration T of a Gaussian response with the spectrum S has the variance (2π/T) ∫S² dω
    (J. S. Bendat and A. G. Piersol, Random Data, 2010, § 8.2).
    """
    keys = {
        "liquid": [{"density": 1025.0, "depth": 20.0}],
        "body": [
            {
                "kind": "float",
                "shape": "ellipse",
                "half_width": 2.0,
                "half_height": 2.0,
                "motions": ["heave", "sway"],
            }
        ],
        # What is asked of the solver follows below.
        "analysis": [{"kind": "radiation", "omega": [1.0]}],
        "accuracy": {"tolerance": 1e-2},
    }
    mooring = {"stiffness": [0.0, 1.5e4, 0.0], "quadratic_damping": [0.0, 2e4, 0.0]}
    times = tuple(np.arange(0.0, RAMP + DURATION, 0.5).tolist())
    motions = []
    for seed in SEEDS:
        parts = zip(*wave_components(SPECTRUM, 200, seed), strict=True)
        waves = tuple(RegularWave(omega=omega, amplitude=size, phase=phase) for omega, size, phase in parts)
        motions.append(MotionRequest(times=times, waves=waves, ramp=RAMP))
    request = SpectrumRequest(spectrum=SPECTRUM, words="")
    dragged, free = (
        open_water_problem(SeaScene(**keys, attachment=[one]), MPI.COMM_WORLD, Stopwatch())
        for one in (mooring, {"stiffness": mooring["stiffness"]})
    )
    solution = solve_open_water(dragged, (request, *motions))
    (table,) = solution.spectrum
    expected = np.array([0.5 * one.significant_amplitude for one in table.responses])
    samples = np.concatenate([one.displacement[one.times >= RAMP] for one in solution.motion])
    found = np.sqrt((samples**2).mean(axis=0))
    spread = np.trapezoid(table.response_density**2, table.omega, axis=0) * 2.0 * np.pi / (len(SEEDS) * DURATION)
    # Relative, of the standard deviation half of that of the variance; beside it the tolerance of both solutions.
    certain = 0.5 * CONFIDENCE * np.sqrt(spread) / expected**2 + 2e-2
    assert np.all(certain < 0.2), certain
    assert np.all(np.abs(found / expected - 1.0) < certain), (found, expected, certain)
    (without,) = solve_open_water(free, (request,)).spectrum
    # Drag matters far more than that.
    assert 0.5 * without.responses[1].significant_amplitude > 1.3 * expected[1]
