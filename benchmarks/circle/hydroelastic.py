"""The circle on this solver: scene to added mass and damping, with estimate and energy balance."""

from __future__ import annotations

from math import inf

from mpi4py import MPI

from hydroelastic.benchmarks.cases import Answer, Case
from hydroelastic.benchmarks.circle.cases import DENSITY, GRAVITY, RADIUS, circle_frequency, unit_added_mass
from hydroelastic.benchmarks.tank.hydroelastic import versions as versions
from hydroelastic.fem.open_water.radiation import solve_radiation
from hydroelastic.scenes.models.bodies import Float
from hydroelastic.scenes.models.open_analyses import Radiation
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.models.tank_parts import Accuracy, Liquid, Tank
from hydroelastic.scenes.open_water.physics import open_water_problem

_STRETCH = 10.0  # is drawn only; the answers do not depend on it


def solve(case: Case) -> Answer:
    """Make the scene of a case and solve it."""
    omega = circle_frequency(case.tank).omega
    asked = Radiation(omega=(omega,))
    scene = TankScene(
        tank=Tank(length=_STRETCH, gravity=GRAVITY, ends="open"),
        liquid=(Liquid(density=DENSITY, depth=inf),),
        body=(
            Float(
                position=_STRETCH / 2.0,
                shape="ellipse",
                half_width=RADIUS,
                half_height=RADIUS,
                motions=("heave", "sway"),
            ),
        ),
        analysis=(asked,),
        accuracy=Accuracy(tolerance=case.tolerance),
    )
    solution = solve_radiation(open_water_problem(scene, MPI.COMM_WORLD), asked.request)
    table = solution.table
    values: list[float] = []
    for place in (table.dofs.index("heave"), table.dofs.index("sway")):
        values.append(float(table.added_mass[0, place, place]) / unit_added_mass())
        values.append(float(table.radiation_damping[0, place, place]) / unit_added_mass() / omega)
    assert solution.model is not None
    return Answer(
        values=tuple(values),
        unknowns=solution.model.pencil.size,
        note=f"estimate {solution.error:.1e}",
    )
