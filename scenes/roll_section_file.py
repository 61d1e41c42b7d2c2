"""The scene of a ship's section, read and solved. Ships without one need neither this nor dolfinx."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hydroelastic.scenes.errors import Problem, SceneError
from hydroelastic.scenes.model_roll import RollScene
from hydroelastic.scenes.models import TankScene
from hydroelastic.scenes.stopwatch import Report, Stopwatch

if TYPE_CHECKING:
    from mpi4py import MPI

    from hydroelastic.scenes.roll_section import SectionRoll


def section_scene(scene: RollScene) -> TankScene:
    """Return the scene of the section.

    Raises:
        SceneError: if it cannot be read, or is not that of a float.
    """
    # The reader of scenes knows all kinds, this one too.
    from hydroelastic.scenes.read import read_scene

    file = scene.section_file
    assert file is not None
    section = read_scene(file)
    if isinstance(section, TankScene):
        return section
    problem = Problem(
        key='[roll], key "section"',
        value=f'"{file}"',
        wrong=f'it is a scene of kind = "{section.kind}"',
        allowed='the scene of a float, kind = "tank"',
    )
    raise SceneError(problem)


def solved_section(scene: RollScene, comm: MPI.Comm, watch: Stopwatch, report: Report) -> SectionRoll:
    """Read and solve the section (collective).

    Raises:
        SceneError: if its scene cannot be used.
        UnsolvedError: if it cannot be solved to its tolerance.
    """
    section = section_scene(scene)
    with watch.stage("import"):
        from hydroelastic.scenes.roll_section import section_roll
    file = scene.section_file
    assert file is not None
    return section_roll(section, file, comm, watch, report)
