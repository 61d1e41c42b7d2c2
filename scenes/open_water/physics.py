"""From a scene with open ends to what the solvers of open water take."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.requests import DecayRequest, RadiationRequest, ResonanceRequest, ResponseRequest
from hydroelastic.fem.stopwatch import Stopwatch
from hydroelastic.scenes.models.open_analyses import Decay, Radiation, Resonance, Response
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene

if TYPE_CHECKING:
    # A scene is checked without starting MPI.
    from mpi4py import MPI


def open_water_problem(scene: TankScene, comm: MPI.Comm, watch: Stopwatch) -> OpenWaterProblem:
    """Return the open water of a scene, to be solved to its tolerance."""
    return OpenWaterProblem(comm=comm, tank=physical_tank(scene), tolerance=scene.accuracy.tolerance, watch=watch)


def radiation_request(analysis: Radiation) -> RadiationRequest:
    """Return what a radiation analysis asks for."""
    return RadiationRequest(omega=analysis.omega, elastic_modes=analysis.elastic_modes)


def response_request(analysis: Response) -> ResponseRequest:
    """Return what a response analysis asks for."""
    return ResponseRequest(omega=analysis.omega, waves_from=analysis.waves_from, positions=analysis.positions)


def resonance_request(analysis: Resonance) -> ResonanceRequest:
    """Return what a resonance analysis asks for."""
    return ResonanceRequest(count=analysis.count, below=analysis.below, largest_damping=analysis.largest_damping)


def decay_request(analysis: Decay) -> DecayRequest:
    """Return what a decay analysis asks for."""
    start = analysis.displacement
    return DecayRequest(body=analysis.body - 1, heave=start.heave, roll=start.roll, times=analysis.times)
