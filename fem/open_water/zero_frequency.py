"""The limit of long waves about solids of revolution: ∂ψ/∂z = 0 on the water, the pencil at λ = 0.

In infinitely deep liquids every motion has a limit, and so have surge and pitch over a bed. There heave drives the
volume ρA_w in and out over a ring of the depth H, and its added mass grows like −(ρA_w²/(2πH)) ln ka.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hydroelastic.fem.open_water.attempts import best_over_band
from hydroelastic.fem.open_water.basin import open_basin
from hydroelastic.fem.open_water.field_model import Band
from hydroelastic.fem.open_water.low_frequency import is_infinitely_deep
from hydroelastic.fem.open_water.model_building import open_model
from hydroelastic.fem.open_water.motion_scale import motion_scale
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.tank.attempts import Attempt
from hydroelastic.fem.tank.field_model import whole_bodies
from hydroelastic.fem.tank.resolution import Resolution

# Frequencies over √(g/length) whose absorbing layer ends far enough for ψ ~ 1/R.
_SLOW = (1e-3, 3e-3)


def zero_frequency_added_mass(problem: OpenWaterProblem, shapes: tuple[int, ...]) -> tuple[np.ndarray, float]:
    """Return the added mass of the motions of one order at ω = 0, in SI units, and its relative error (collective).

    Over a bed heave, which displaces a volume, grows without limit; its entries are infinite. Bending modes displace
    none: they are orthogonal to heave.
    """
    basin = open_basin(problem.tank, 0.0)
    dofs = motion_scale(basin, whole_bodies(basin.tank, shapes)).dofs
    is_shallow = problem.tank.geometry.order == 0 and not is_infinitely_deep(problem.tank)
    grows = np.array([is_shallow and dof.motion == "heave" for dof in dofs])
    if grows.all():
        return np.full((len(dofs), len(dofs)), np.inf), 0.0
    band = Band(lowest=_SLOW[0] * basin.units.frequency, highest=_SLOW[1] * basin.units.frequency)

    def solve(resolution: Resolution) -> Attempt[np.ndarray]:
        model = open_model(problem, band, replace(resolution, shapes=shapes))
        loads = model.pencil.loads.astype(complex)
        solver = model.pencil.solver()
        solver.shift(0.0)
        radiated = np.array([solver.solve(load) for load in loads]).reshape(loads.shape)
        matrix = model.pencil.products(loads, radiated)
        causes = model.errors(radiated, np.abs(np.diag(matrix)))
        masses = np.where(np.outer(grows, grows), np.inf, model.scale.masses(matrix).real)
        return Attempt(result=masses, causes=causes, resolution=resolution)

    attempt = best_over_band(problem, band, solve)
    return attempt.result, attempt.error
