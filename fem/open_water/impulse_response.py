"""Impulse response functions of radiation over time, in SI units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydroelastic.fem.open_water.field_model import OpenModel
from hydroelastic.fem.open_water.radiation_memory import WaterMemory
from hydroelastic.fem.open_water.requests import ImpulseResponseRequest
from hydroelastic.fem.time_domain.results import ImpulseResponseTable


@dataclass(frozen=True, kw_only=True)
class ImpulseResponseSolution:
    """Result of an impulse response analysis."""

    table: ImpulseResponseTable  # the results in SI units
    model: OpenModel  # the last field model
    error: float  # the largest relative error of H, that of causality among them
    highest: float  # the frequency beyond which damping is not solved for, rad/s


def solve_impulse_response(request: ImpulseResponseRequest, water: WaterMemory) -> ImpulseResponseSolution:
    """Return the impulse responses of radiation, by the memory of the water."""
    times = np.array(request.times)
    errors = water.impulse_response_errors(times)
    table = ImpulseResponseTable(
        times=times,
        dofs=water.dofs,
        impulse_response=water.memory.impulse_response(times),
        infinite_frequency_added_mass=water.memory.infinite_frequency_added_mass,
        omega=water.omega,
        added_mass=water.memory.added_mass(water.omega),
        radiation_damping=water.memory.radiation_damping(water.omega),
        causality_error=water.causality_error,
        ogilvie_error=water.ogilvie_error,
        impulse_response_error=errors,
        relative_error=max(water.error, float(errors.max())),
    )
    return ImpulseResponseSolution(
        table=table,
        model=water.model,
        error=max(water.error, float(water.causality_error.max())),
        highest=water.tail.highest,
    )
