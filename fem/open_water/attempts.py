"""Solve open water at successively finer resolutions, until the tolerance of the problem is kept."""

from __future__ import annotations

import gc
from collections.abc import Callable
from typing import TypeVar

from hydroelastic.fem.open_water.basin import open_basin
from hydroelastic.fem.open_water.field_model import Band
from hydroelastic.fem.open_water.model_building import first_resolution
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.tank.attempts import Attempt, best_attempt
from hydroelastic.fem.tank.resolution import Resolution
from hydroelastic.physics.tank import Tank

Result = TypeVar("Result")

_MOST_ATTEMPTS = 4


def best_in_basin(
    tank: Tank,
    tolerance: float,
    solve: Callable[[Resolution], Attempt[Result]],
    first: Resolution,
    *,
    infinite_frequency: bool = False,
) -> Attempt[Result]:
    """Return the best of a few attempts in one basin (collective)."""

    def solved(resolution: Resolution) -> Attempt[Result]:
        if resolution is not first:
            # Of the attempt before; that of the last one is released after the analysis.
            gc.collect()
        return solve(resolution)

    return best_attempt(tank, tolerance, solved, first, rounds=_MOST_ATTEMPTS, infinite_frequency=infinite_frequency)


def best_over_band(
    problem: OpenWaterProblem, band: Band, solve: Callable[[Resolution], Attempt[Result]]
) -> Attempt[Result]:
    """Return the best of a few attempts over a range of frequencies, from the resolution that it needs (collective)."""
    tank = open_basin(problem.tank, band.wavenumbers(problem.tank)[1], reach=band.reach).tank
    return best_in_basin(tank, problem.tolerance, solve, first_resolution(problem.tank, problem.tolerance, band))
