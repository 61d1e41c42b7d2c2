"""A heaving buoy on this solver: scene to added mass and damping, with estimate, excitation and energy balance."""

from __future__ import annotations

from mpi4py import MPI

from hydroelastic.benchmarks.buoy.cases import DENSITY, GRAVITY, RADIUS, buoy_named
from hydroelastic.benchmarks.cases import Answer, Case
from hydroelastic.benchmarks.tank.hydroelastic import versions as versions
from hydroelastic.fem.open_water.radiation import solve_radiation
from hydroelastic.scenes.models.open_analyses import Radiation
from hydroelastic.scenes.models.revolved_floats import RevolvedFloat
from hydroelastic.scenes.models.sea import Sea, SeaScene
from hydroelastic.scenes.models.tank_parts import Accuracy, Liquid
from hydroelastic.scenes.open_water.physics import open_water_problem


def solve(case: Case) -> Answer:
    """Make the scene of a case and solve it."""
    buoy = buoy_named(case.tank)
    asked = Radiation(omega=(buoy.omega,))
    shape = "sphere" if buoy.draught is None else "cylinder"
    scene = SeaScene(
        sea=Sea(gravity=GRAVITY),
        liquid=(Liquid(density=DENSITY, depth=buoy.depth),),
        body=(RevolvedFloat(shape=shape, radius=RADIUS, draught=buoy.draught, motions=("heave",)),),
        analysis=(asked,),
        accuracy=Accuracy(tolerance=case.tolerance),
    )
    solution = solve_radiation(open_water_problem(scene, MPI.COMM_WORLD).of_order(0), asked.request)
    table = solution.table
    assert solution.model is not None
    return Answer(
        values=(float(table.added_mass[0, 0, 0]), float(table.radiation_damping[0, 0, 0]) / buoy.omega),
        unknowns=solution.model.pencil.size,
        note=f"estimate {solution.error:.1e}",
    )
