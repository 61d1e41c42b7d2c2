"""The scene of a ship's section, read and solved. Ships without one need neither this nor dolfinx."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hydroelastic.fem.progress import Report
from hydroelastic.scenes.errors import Problem, SceneError, UnsolvedError
from hydroelastic.scenes.models.bodies import Float
from hydroelastic.scenes.models.roll import RollScene
from hydroelastic.scenes.models.tank import TankScene

if TYPE_CHECKING:
    from mpi4py import MPI

    from hydroelastic.fem.section_roll import SectionRoll


def section_scene(scene: RollScene) -> TankScene:
    """Return the scene of the section: a tank or open water with one body, a float that may roll."""
    # SciPy takes a while to import, and most ships have no section.
    from hydroelastic.scenes.models.floats import placed_float

    # The reader of scenes knows all kinds, this one too.
    from hydroelastic.scenes.read import read_scene

    file = scene.section_file
    assert file is not None
    try:
        section = read_scene(file)
    except SceneError as error:
        raise _unusable(scene, f"that scene cannot be used: {error}") from error
    if not isinstance(section, TankScene):
        raise _unusable(scene, f'it is a scene of kind = "{section.kind}"', 'the scene of a float, kind = "tank"')
    body = section.body[0] if len(section.body) == 1 else None
    if not isinstance(body, Float) or "roll" not in body.motions:
        raise _unusable(
            scene,
            "that scene cannot be the section of a rolling ship",
            'a scene with one body, kind = "float", with "roll" among its motions',
        )
    stiffness = placed_float(section, 0).roll_stiffness
    if stiffness <= 0.0:
        raise _unusable(
            scene,
            f"the roll of that section has no restoring moment: its stiffness is {stiffness:g} N",
            "a section that floats upright: a lower centre_of_mass, or a wider waterplane",
        )
    return section


def _unusable(scene: RollScene, wrong: str, allowed: str = "") -> SceneError:
    problem = Problem(key='[roll], key "section"', value=f'"{scene.roll.section}"', wrong=wrong, allowed=allowed)
    return SceneError(problem, file=scene.source)


def solved_section(scene: RollScene, comm: MPI.Comm, report: Report) -> SectionRoll:
    """Read and solve the section (collective)."""
    section = section_scene(scene)
    from hydroelastic.fem.section_roll import SectionRollError, section_roll
    from hydroelastic.fem.solver_error import EigenSolverError
    from hydroelastic.meshes.tagged_mesh import MeshError
    from hydroelastic.scenes.models.physical import physical_tank
    from hydroelastic.scenes.tank.user_mesh import mesh_refused, user_mesh

    report("section")
    try:
        return section_roll(
            physical_tank(section),
            tolerance=section.accuracy.tolerance,
            modes=section.accuracy.modes,
            comm=comm,
            title=section.title,
            mesh=user_mesh(section, comm),
            report=report,
        )
    except MeshError as error:
        raise mesh_refused(section, error) from error
    except EigenSolverError as error:
        raise UnsolvedError(f"the eigen-solver failed: {error}") from error
    except SectionRollError as error:
        raise UnsolvedError(str(error)) from error
