"""Resonances between the frequencies of a response: they are said, and nothing is said where the curve shows them."""

from typing import Any

import numpy as np
import pytest
from mpi4py import MPI
from open_tables import open_scene

from hydroelastic.fem.open_water.results import UnresolvedPeak
from hydroelastic.output.json_values import json_ready
from hydroelastic.output.open_water.quantities import OPEN_WATER
from hydroelastic.output.open_water.tables import open_sections
from hydroelastic.output.summary_variables import summary_variables
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.open_water.results import OpenSolution
from hydroelastic.scenes.open_water.run import run_open
from hydroelastic.scenes.open_water.solve import solve_open

BARGE = {
    "kind": "float",
    "shape": "polygon",
    "vertices": [[-5.0, 1.0], [-5.0, -3.0], [5.0, -3.0], [5.0, 1.0]],
    "position": 30.0,
    "centre_of_mass": 0.0,
    "radius_of_gyration": 4.0,
    "motions": ["heave", "sway", "roll"],
}


def barge(omega: Any, *others: dict[str, Any]) -> TankScene:
    return open_scene(
        tank={"length": 60.0, "ends": "open"},
        liquid=[{"density": 1025.0, "depth": 30.0}],
        body=[BARGE],
        analyses=[{"kind": "response", "omega": omega}, *others],
        accuracy={"tolerance": 1e-3},
    )


def solved(scene: TankScene) -> OpenSolution:
    return solve_open(scene, MPI.COMM_WORLD, lambda _message: None)


@pytest.fixture(scope="module")
def coarse() -> OpenSolution:
    return solved(barge({"start": 0.5, "stop": 1.1, "number": 7}, {"kind": "resonance"}))


def peak_of(solution: OpenSolution) -> UnresolvedPeak:
    (peak,) = solution.response[0].missed_peaks
    return peak


def test_a_resonance_between_the_frequencies_is_said(coarse: OpenSolution) -> None:
    peak = peak_of(coarse)
    resonance = coarse.resonance[0]
    roll = resonance.omega[list(resonance.labels).index("roll")]
    assert (peak.below, peak.above, peak.quantity) == (0.7, 0.8, "roll")
    # Of the width of the resonance, 1.1e-3 rad/s: two ways to the same number, each to a thousandth of |ω|.
    assert peak.omega == pytest.approx(roll.real, abs=0.05 * abs(roll.imag))
    (there,) = solved(barge([peak.omega])).response
    # The resonance is 1.4e-3 of |ω| wide; measured, the reduced basis is off by 1e-3 there.
    assert peak.value == pytest.approx(abs(there.amplitudes[0, 0, there.dofs.index("roll")]), rel=0.02)
    assert peak.drawn < 0.1 * peak.value


def test_tables_summary_and_dataset_have_it(coarse: OpenSolution) -> None:
    summary = run_open.summarized(coarse.scene, coarse)
    (told,) = summary["response"][0]["missed_peaks"]
    assert told["omega"] == peak_of(coarse).omega
    lines = [line for section in open_sections(coarse, run_open.read(summary)) for line in section.lines]
    (line,) = (line for line in lines if "NOT SHOWN" in line)
    assert "between 0.7 and 0.8 rad/s roll changes" in line
    variables = summary_variables(json_ready({"response": summary["response"]}), OPEN_WATER)
    (omega,) = (variable for variable in variables if variable.name == "missed_peak_omega")
    assert omega.values == pytest.approx(told["omega"])
    assert omega.attributes["units"] == "rad/s"


@pytest.mark.slow
def test_a_resolved_curve_has_none(coarse: OpenSolution) -> None:
    near = peak_of(coarse).omega + 1e-3 * np.arange(-10, 11)
    omegas = sorted([*np.linspace(0.3, 1.7, 15), *near])
    assert solved(barge(omegas)).response[0].missed_peaks == ()


def test_few_frequencies_are_no_curve() -> None:
    assert solved(barge([0.7, 0.8])).response[0].missed_peaks == ()
