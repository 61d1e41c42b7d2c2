"""The limit of long waves about solids of revolution: ∂ψ/∂z = 0 on the water, the pencil at λ = 0.

In infinitely deep liquids every motion has a limit, and so have surge and pitch over a bed. There heave drives the
volume ρA_w in and out over a ring of the depth H, and its added mass grows like −(ρA_w²/(2πH)) ln ka.
"""

from __future__ import annotations

import numpy as np

from hydroelastic.fem.open_water.attempts import best_over_band
from hydroelastic.fem.open_water.basin import open_basin
from hydroelastic.fem.open_water.field_model import Band, open_model
from hydroelastic.fem.open_water.low_frequency import is_infinitely_deep
from hydroelastic.fem.open_water.motion_scale import motion_scale
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.tank.attempts import Attempt
from hydroelastic.fem.tank.field_model import whole_bodies
from hydroelastic.fem.tank.resolution import Resolution

# Frequencies over √(g/length) whose absorbing layer ends far enough for ψ ~ 1/R.
_SLOW = (1e-3, 3e-3)


def zero_frequency_added_mass(problem: OpenWaterProblem) -> tuple[np.ndarray, float]:
    """Return the added mass of the motions of one order at ω = 0, in SI units, and its relative error (collective).

    Entries that grow without limit are infinite.
    """
    basin = open_basin(problem.tank, 0.0)
    if problem.tank.geometry.order == 0 and not is_infinitely_deep(problem.tank):
        bodies = whole_bodies(basin.tank, (0,) * len(basin.tank.bodies))
        count = len(motion_scale(basin, bodies).dofs)
        return np.full((count, count), np.inf), 0.0
    band = Band(lowest=_SLOW[0] * basin.units.frequency, highest=_SLOW[1] * basin.units.frequency)

    def solve(resolution: Resolution) -> Attempt[np.ndarray]:
        model = open_model(problem, band, resolution)
        loads = model.pencil.loads.astype(complex)
        with problem.watch.stage("solve"):
            solver = model.pencil.solver()
            solver.shift(0.0)
            radiated = np.array([solver.solve(load) for load in loads]).reshape(loads.shape)
        matrix = model.pencil.products(loads, radiated)
        with problem.watch.stage("errors"):
            causes = model.errors(radiated, np.abs(np.diag(matrix)))
        return Attempt(result=model.scale.masses(matrix).real, causes=causes, resolution=resolution)

    attempt = best_over_band(problem, band, solve)
    return attempt.result, attempt.error
