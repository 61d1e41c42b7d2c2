"""Motions of bodies in waves over time, in SI units: the frequency domain gives what Cummins' equation needs.

Excitation forces are those of a radiation analysis at the frequencies of the waves, added mass at infinite frequency
and impulse responses those of `radiation_memory`; a(ω) and b(ω) of the former check the latter.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf

import numpy as np

from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.radiation import solve_radiation
from hydroelastic.fem.open_water.radiation_memory import WaterMemory
from hydroelastic.fem.open_water.requests import MotionRequest, RadiationRequest
from hydroelastic.fem.time_domain.motion import MovingBodies, WaveForces
from hydroelastic.fem.time_domain.results import MotionTable

# Errors of the steps of the integration, relative to the tolerance.
_STEPS = 1e-3


@dataclass(frozen=True, kw_only=True)
class MotionSolution:
    """Result of a motion analysis."""

    table: MotionTable  # the results in SI units
    model: OpenModel  # the last field model
    # the largest error of a motion, relative to the largest in the same unit: by those of forces, of added mass and
    # damping, and of causality
    error: float


def solve_motion(problem: OpenWaterProblem, request: MotionRequest, water: WaterMemory) -> MotionSolution:
    """Solve for the motion from rest or a release in waves, or in still water (collective)."""
    omega, amplitude, phase = (
        np.array([getattr(wave, name) for wave in request.waves]) for name in ("omega", "amplitude", "phase")
    )
    times = np.array(request.times)
    distinct, place = np.unique(omega, return_inverse=True)
    # Inertia and stiffness are needed without waves, too.
    asked = RadiationRequest(omega=tuple(distinct.tolist()) or (inf,), elastic_modes=request.elastic_modes)
    radiation = solve_radiation(problem, asked)
    table = radiation.table
    tank = problem.tank
    middle = (0.0 if tank.geometry.is_revolved else sum(tank.bodies[0].waterplane) / 2.0) - tank.phase_at
    direction = 0 if request.waves_from == "left" else 1
    # The given phases are those at the first body.
    travelled = (1.0, -1.0)[direction] * table.wavenumbers[place, 0] * middle
    waves = amplitude * np.exp(1j * phase)
    forces = WaveForces(
        omega=omega,
        forces=table.excitation_force[place, 0, direction] * (waves * np.exp(-1j * travelled))[:, None],
        ramp=request.ramp,
    )
    bodies = MovingBodies(
        memory=water.memory,
        inertia=table.inertia,
        stiffness=table.stiffness,
        outside=water.model.scale.outside(water.model.outside),
    )
    initial, steps = np.array(request.initial(table.dofs)), _STEPS * problem.tolerance
    displacement, velocity = bodies.motion(forces, times, steps, initial)
    turning = np.exp(-1j * np.outer(times, omega))
    relative = max(radiation.error, water.error, float(water.causality_error.max()))
    errors, sizes = bodies.errors(forces, relative), np.abs(bodies.steady(forces)).sum(axis=0) + np.abs(initial)
    if initial.any():
        other, _ = replace(bodies, memory=water.memory.scaled(1.0 + relative)).motion(forces, times, steps, initial)
        errors = errors + np.abs(other - displacement).max(axis=0)
    turns = np.array([dof.is_rotation for dof in table.dofs])
    # An order of a solid may be at rest.
    error = max(
        float(errors[turns == turn].max() / (sizes[turns == turn].max() or 1.0)) for turn in set(turns.tolist())
    )
    return MotionSolution(
        table=MotionTable(
            times=times,
            dofs=table.dofs,
            waves_from=request.waves_from,
            wave_omega=omega,
            wave_amplitude=amplitude,
            wave_phase=phase,
            ramp=request.ramp,
            initial=initial,
            elevation=forces.grown(times) * (turning @ waves).real,
            displacement=displacement,
            velocity=velocity,
            steady=(turning @ bodies.steady(forces)).real,
            relative_error=error,
        ),
        model=water.model,
        error=error,
    )
