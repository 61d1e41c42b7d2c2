"""Tanks of revolution as tanks in three dimensions: their modes in the records of these, sampled in plan view."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.level_bed.solution import LevelMode, LevelSolution, SampledSurface
from hydroelastic.fem.modes import Mode, ModeSet
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.stopwatch import Report
from hydroelastic.fem.surface_line import along_the_surface
from hydroelastic.fem.tank.orders import solve_by_order
from hydroelastic.fem.tank.solve import TankSolution
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.level_tank import Cylinder, LevelTank
from hydroelastic.physics.tank import Tank


@dataclass(frozen=True, kw_only=True)
class OrderProblem:
    """The problem of one azimuthal order; see `fem.level_bed.solution.PlanProblem`."""

    solution: TankSolution
    order: int
    symmetry: str = ""

    @property
    def multiplicity(self) -> int:
        """Modes cos nθ and sin nθ have one frequency."""
        return 2 if self.order else 1

    @property
    def pencil(self) -> CoupledPencil[Any]:
        """Its matrices."""
        return self.solution.field.parts[0].pencil

    @property
    def modes(self) -> ModeSet:
        """Its lowest modes."""
        return self.solution.modes

    def sampled(self, mode: Mode, x: FloatArray, y: FloatArray, *, second: bool) -> SampledSurface:
        """Return a mode at places of the plan: water, and in its place the displacement of the floats (collective)."""
        r, angle = np.hypot(x, y), np.arctan2(y, x)
        places, (potential,) = along_the_surface(self.pencil.liquid, [mode.potential])
        psi = np.interp(r, places, potential)
        elevation = mode.eigenvalue * psi
        tank, first = self.solution.tank, 0
        for index, body in enumerate(self.solution.field.bodies):
            own = mode.body_amplitudes[first : first + body.size]
            first += body.size
            left, right = tank.bodies[index].waterplane
            upwards = {"heave": np.ones_like(r), "pitch": r}
            raised = sum(
                (
                    amplitude * upwards.get(dof.motion, np.zeros_like(r))
                    for amplitude, dof in zip(body.motions @ own, body.dofs, strict=True)
                ),
                np.zeros_like(r),
            )
            elevation = np.where((left < r) & (r < right), raised, elevation)
        turn = np.sin(self.order * angle) if second else np.cos(self.order * angle)
        # The field below is not that of a level bed, and is not given.
        return SampledSurface(
            elevation=elevation * turn, wavenumbers=np.zeros(1), potentials=np.full((len(r), 1), np.nan)
        )


def round_solution(
    physical: Tank,
    *,
    tolerance: float,
    modes: int,
    comm: MPI.Comm | None = None,
    report: Report = lambda _message: None,
) -> LevelSolution:
    """Solve a tank of revolution (collective); arguments and errors are those of `solve_by_order`."""
    found = solve_by_order(physical, tolerance=tolerance, modes=modes, comm=comm, report=report)
    problems = [OrderProblem(solution=one, order=order) for order, one in enumerate(found.orders)]
    layer = physical.layers[0]
    tank = LevelTank(
        plan=Cylinder(radius=physical.length),
        depth=layer.depth,
        density=layer.density,
        gravity=physical.gravity,
        top=physical.top,
    )
    orders = found.orders
    seconds: dict[str, float] = {}
    for one in orders:
        for stage, value in one.seconds.items():
            seconds[stage] = seconds.get(stage, 0.0) + value
    return LevelSolution(
        physical=tank,
        tank=tank.scaled(),
        model="order by order in the half-plane of revolution",
        tolerance=tolerance,
        count=modes,
        modes=tuple(
            LevelMode(
                problem=problems[mode.order],
                mode=orders[mode.order].asked[mode.index],
                relative_error=mode.relative_error,
            )
            for mode in found.modes
        ),
        tones=(),
        zero_modes=sum(one.modes.zero_modes for one in orders),
        counted=all(one.counted for one in orders),
        size={
            "problems": len(orders),
            "degree": max(one.resolution.degree for one in orders),
            "layers": 0,
            "poles": 0,
            "dofs": sum(one.field.dofs for one in orders),
            "surface_unknowns": sum(one.field.surface_unknowns for one in orders),
            "plate_shapes": 0,
        },
        solves=sum(one.modes.solves for one in orders),
        attempts=max(one.attempts for one in orders),
        reasons=found.reasons,
        seconds=seconds,
    )
