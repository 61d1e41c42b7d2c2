"""The solution of the scene of a tank between walls."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from mpi4py import MPI

from hydroelastic.fem.closed.section import SectionSolution
from hydroelastic.fem.progress import Report
from hydroelastic.fem.tank.liquids import ANEW, Liquids
from hydroelastic.fem.tank.solve import TankSolution, solve_tank
from hydroelastic.meshes.tagged_mesh import MeshError, TaggedMesh
from hydroelastic.modal.estimate import Estimate
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene

if TYPE_CHECKING:
    from hydroelastic.modal.floats.estimates import FloatEstimate


@dataclass(frozen=True, kw_only=True)
class EstimatedTank:
    """The field solution of a closed tank, and the estimates for comparison.

    Attributes:
        scene: the scene.
        tank: its field solution.
        beam: the estimates of the beam, by name.
        floats: those of the floats, by body; ``None`` without floats.
    """

    scene: TankScene
    tank: SectionSolution
    beam: dict[str, Estimate] = field(default_factory=dict)
    floats: dict[int, dict[str, FloatEstimate]] | None = None

    @property
    def reasons(self) -> tuple[str, ...]:
        """Reasons why the tolerance is not kept; empty if it is."""
        return tuple(self.tank.dataset.attrs["reasons"])


def solve_scene(
    scene: TankScene,
    *,
    comm: MPI.Comm | None = None,
    mesh: TaggedMesh | None = None,
    halves: bool = True,
    liquids: Liquids = ANEW,
    report: Report = lambda _message: None,
) -> TankSolution:
    """Solve a scene to its tolerance; see `fem.tank.solve.solve_tank` (collective)."""
    comm = comm or MPI.COMM_WORLD
    if scene.mesh is not None and not comm.bcast(mesh is not None, root=0):
        raise MeshError(f"the scene brings the mesh {scene.mesh.file}: load it and hand it over")
    asked = scene.accuracy
    return solve_tank(
        physical_tank(scene),
        tolerance=asked.tolerance,
        modes=asked.modes,
        comm=comm,
        mesh=mesh,
        halves=halves,
        liquids=liquids,
        report=report,
    )
