"""The tanks on this solver: the whole of `solve_scene`, with estimate, count of modes and pressure-release tone."""

from __future__ import annotations

from importlib.metadata import version

from petsc4py import PETSc
from slepc4py import SLEPc

from hydroelastic.benchmarks.cases import Answer, Case
from hydroelastic.benchmarks.tank.cases import MODES, tank_named
from hydroelastic.fem.tank.solve import TankSolution
from hydroelastic.modal.beam.pressure_release import dimensionless_added_mass
from hydroelastic.scenes.models.bodies import Beam
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.models.tank_parts import Accuracy, Liquid, Tank
from hydroelastic.scenes.tank.solve import solve_scene


def versions() -> dict[str, str]:
    """What computes."""
    return {
        "hydroelastic": version("hydroelastic"),
        "dolfinx": version("fenics-dolfinx"),
        "PETSc": ".".join(map(str, PETSc.Sys.getVersion())),
        "SLEPc": ".".join(map(str, SLEPc.Sys.getVersion())),
        "gmsh": version("gmsh"),
    }


def prepare(case: Case) -> TankScene:
    """The tank of a case as a scene."""
    beam = tank_named(case.tank).beam
    return TankScene(
        tank=Tank(length=beam.tank_length, gravity=beam.gravity),
        liquid=(Liquid(density=beam.density, depth=beam.depth),),
        body=(
            Beam(
                start=beam.start,
                length=beam.length,
                flexural_rigidity=beam.flexural_rigidity,
                mass_per_length=beam.mass_per_length,
                hydrostatic=beam.hydrostatic,
            ),
        ),
        accuracy=Accuracy(tolerance=case.tolerance, modes=MODES),
    )


def solve(scene: TankScene) -> Answer:
    """Solve a scene and report as `hydroelastic run` does, but for files and pictures."""
    # What an earlier round left of the same tank would be no work of this one.
    dimensionless_added_mass.cache_clear()
    solution = solve_scene(scene)
    estimate = float(solution.relative_errors[:MODES].max())
    return Answer(
        values=frequencies(solution),
        unknowns=solution.field.dofs,
        note="; ".join([f"estimate {estimate:.1e}", *solution.reasons]),
    )


def frequencies(solution: TankSolution) -> tuple[float, ...]:
    """ω of the modes asked for, rad/s."""
    return tuple(solution.omega(mode.eigenvalue) for mode in solution.asked)
