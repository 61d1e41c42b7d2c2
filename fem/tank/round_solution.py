"""Tanks of revolution, and of one section over a width, as tanks in three dimensions: their modes in the records of
these, sampled in plan view."""

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
from hydroelastic.physics.level_tank import Box, Cylinder, LevelTank
from hydroelastic.physics.tank import Tank


@dataclass(frozen=True, kw_only=True)
class OrderProblem:
    """The problem of one order; see `fem.level_bed.solution.PlanProblem`.

    Attributes:
        solution: of the order.
        order: azimuthal, or number of half waves across the section.
        unit: unit of the plan's coordinates in that of the section.
    """

    solution: TankSolution
    order: int
    unit: float
    symmetry: str = ""

    @property
    def multiplicity(self) -> int:
        """Modes cos nθ and sin nθ have one frequency."""
        return 2 if self.order and self.solution.tank.geometry.is_revolved else 1

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
        geometry = self.solution.tank.geometry
        r, angle = np.hypot(x, y) * self.unit, np.arctan2(y, x)
        if not geometry.is_revolved:
            r, angle = x * self.unit, np.pi * y * self.unit / geometry.width
        places, (potential,) = along_the_surface(self.pencil.liquid, [mode.potential])
        psi = np.interp(r, places, potential)
        elevation = mode.eigenvalue * psi
        tank, first = self.solution.tank, 0
        for index, body in enumerate(self.solution.field.bodies):
            own = mode.body_amplitudes[first : first + body.size]
            first += body.size
            left, right = tank.bodies[index].waterplane
            middle = tank.floats[index].hydrostatics.centre_of_mass[0]
            upwards = {"heave": np.ones_like(r), "pitch": r, "roll": r - middle}
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
    """Solve a tank of revolution, or of one section over a width (collective); see `solve_by_order`."""
    found = solve_by_order(physical, tolerance=tolerance, modes=modes, comm=comm, report=report)
    layer, geometry = physical.layers[0], physical.geometry
    width = geometry.width
    tank = LevelTank(
        plan=Cylinder(radius=physical.length) if geometry.is_revolved else Box(length=physical.length, width=width),
        depth=layer.depth,
        density=layer.density,
        gravity=physical.gravity,
        top=physical.top,
    )
    orders, unit = found.orders, tank.plan.unit / physical.length
    problems = [OrderProblem(solution=one, order=order, unit=unit) for order, one in enumerate(orders)]
    seconds: dict[str, float] = {}
    for one in orders:
        for stage, value in one.seconds.items():
            seconds[stage] = seconds.get(stage, 0.0) + value
    return LevelSolution(
        physical=tank,
        tank=tank.scaled(),
        model=f"order by order in the {'half-plane of revolution' if geometry.is_revolved else 'section'}",
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
