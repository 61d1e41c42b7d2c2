"""A problem of open water, as all solvers of this package take it: liquids, bodies and tolerance."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from hydroelastic.fem.stopwatch import Stopwatch
from hydroelastic.physics.tank import Tank

if TYPE_CHECKING:
    # A scene is checked without starting MPI.
    from mpi4py import MPI

    from hydroelastic.fem.open_water.field_model import Band
    from hydroelastic.fem.open_water.solver import OpenSolver
    from hydroelastic.fem.tank.resolution import Resolution

# Tolerance of solutions that give initial values only.
_ROUGH = 1e-3


@dataclass(frozen=True, kw_only=True)
class OpenWaterProblem:
    """Bodies in open water.

    Attributes:
        comm: MPI communicator.
        tank: open water in SI units, with at least one body.
        tolerance: largest relative error that is accepted.
        watch: records the time by stage.
        solvers: the last solver, by what it was made for: several analyses of the same frequencies share it.
    """

    comm: MPI.Comm
    tank: Tank
    tolerance: float
    watch: Stopwatch
    solvers: dict[tuple[Band, Resolution], OpenSolver] = field(default_factory=dict, compare=False, repr=False)

    def rough(self) -> OpenWaterProblem:
        """Return the same problem with a coarse tolerance, for initial values."""
        return replace(self, tolerance=_ROUGH, solvers={})
