"""The open water of a scene, for tests of its mesh and of its operator."""

from __future__ import annotations

from typing import Any

from mpi4py import MPI

import hydroelastic as he
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.stopwatch import Stopwatch
from hydroelastic.scenes.open_water.physics import open_water_problem


def problem_of(scene: dict[str, Any], comm: MPI.Comm = MPI.COMM_WORLD) -> OpenWaterProblem:
    """Return the open water of a scene."""
    read: Any = he.read(scene)
    return open_water_problem(read, comm, Stopwatch())
