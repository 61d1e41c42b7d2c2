"""Tanks of revolution, and of one section over a width, as tanks in three dimensions: their modes in the records of
these, sampled in plan view."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf
from typing import Any

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.bodies.round_plate import RoundShapes, plate_of
from hydroelastic.fem.level_bed.solution import LevelMode, LevelSolution, PlateTone, SampledSurface
from hydroelastic.fem.mode_set import Mode, ModeSet
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.progress import Report
from hydroelastic.fem.surface_line import along_the_surface
from hydroelastic.fem.surfaces import Body
from hydroelastic.fem.tank.orders import solve_by_order
from hydroelastic.fem.tank.solve import TankSolution, ToneSolution
from hydroelastic.meshes.geometry import FREE_SURFACE
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.level_tank import Box, Cylinder, LevelTank
from hydroelastic.physics.plate import Disc, Plate
from hydroelastic.physics.tank import ROUND_OFF, Tank


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
        elevation = np.zeros_like(r)
        # A lid, or a plate from wall to wall, leaves none.
        if FREE_SURFACE in self.pencil.liquid.tank.facet_names:
            places, (potential,) = along_the_surface(self.pencil.liquid, [mode.potential])
            elevation += mode.eigenvalue * np.interp(r, places, potential)
        tank, first = self.solution.tank, 0
        for index, body in enumerate(self.solution.field.bodies):
            own = mode.body_amplitudes[first : first + body.size]
            first += body.size
            if index in tank.floats or _is_on_top(tank, index):
                left, right = tank.bodies[index].waterplane
                covered = (left - ROUND_OFF < r) & (r < right + ROUND_OFF)
                elevation[covered] = self._raised(index, body, own, r[covered])
        turn = np.sin(self.order * angle) if second else np.cos(self.order * angle)
        # The field below is not that of a level bed, and is not given.
        return SampledSurface(
            elevation=elevation * turn, wavenumbers=np.zeros(1), potentials=np.full((len(r), 1), np.nan)
        )

    def _raised(self, index: int, body: Body, amplitudes: FloatArray, r: FloatArray) -> FloatArray:
        """The upward displacement of a body at radii, or abscissae, within its waterplane."""
        tank = self.solution.tank
        if index not in tank.floats:
            points, upwards = np.vstack([r, np.zeros_like(r)]), np.array([[0.0], [1.0]])
            shapes = body.shapes(points, upwards)
        else:
            middle = tank.floats[index].hydrostatics.centre_of_mass[0]
            rigid = {"heave": np.ones_like(r), "pitch": r, "roll": r - middle}
            shapes = np.reshape([rigid.get(dof.motion, np.zeros_like(r)) for dof in body.dofs], (body.size, len(r)))
        raised: FloatArray = shapes.T @ (body.motions @ amplitudes)
        return raised


def _is_on_top(tank: Tank, body: int) -> bool:
    return tank.level_of(body) is tank.levels[-1]


def _outlined(tank: Tank, body: int) -> Plate:
    """A round plate as one of a level tank, whose outline is drawn; a membrane has no rigidity."""
    plate = plate_of(tank.bodies[body])
    return Plate(
        outline=Disc(radius=plate.radius, inner_radius=plate.inner_radius),
        flexural_rigidity=plate.flexural_rigidity or inf,
        mass_per_area=plate.mass_per_area,
        poisson_ratio=plate.poisson_ratio,
        hydrostatic=plate.hydrostatic,
    )


def _plate_tone(problem: OrderProblem, tone: ToneSolution) -> PlateTone:
    """The first elastic tone of a round plate as that of a level tank."""
    solution, body = problem.solution, problem.solution.field.bodies[tone.body]
    first = [dof.is_first_elastic for dof in body.dofs].index(True)
    stiffness, mass = float(body.stiffness[first]), float(body.mass[first, first])
    shapes = RoundShapes(plate_of(solution.tank.bodies[tone.body]), first + 1)
    found = PlateTone(
        plate=tone.body,
        order=problem.order,
        dry=stiffness / mass if mass else inf,
        squares=solution.tank.geometry.measure * float(shapes.squares[first]),
        stiffness=stiffness,
        mass=mass,
        reason=tone.reason,
        pressure_release=tone.pressure_release,
        pressure_release_error=tone.pressure_release_error,
    )
    if tone.tone is None:
        return found
    return replace(
        found,
        tone=tone.tone,
        eigenvalue=float(problem.modes.eigenvalues[tone.tone.index]),
        relative_error=float(solution.relative_errors[tone.tone.index]),
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
        plates=tuple(_outlined(physical, index) for index in physical.elastic if _is_on_top(physical, index)),
    )
    orders, unit = found.orders, tank.plan.unit / physical.length
    problems = [OrderProblem(solution=one, order=order, unit=unit) for order, one in enumerate(orders)]
    scaled = tank.scaled()
    return LevelSolution(
        physical=tank,
        tank=scaled,
        model="one problem in the half-plane of revolution for each order n of cos nθ"
        if geometry.is_revolved
        else "one problem in the section for each order n of cos nπy/B",
        tolerance=tolerance,
        count=modes,
        modes=tuple(
            LevelMode(
                problem=problems[mode.order],
                bodies=orders[mode.order].field.bodies,
                mode=orders[mode.order].asked[mode.index],
                relative_error=mode.relative_error,
            )
            for mode in found.modes
        ),
        tones=tuple(_plate_tone(problem, tone) for problem in problems for tone in problem.solution.tones),
        zero_modes=sum(one.multiplicity * one.modes.zero_modes for one in problems),
        counted=all(one.counted for one in orders),
        size={
            "problems": len(orders),
            "degree": max(one.resolution.degree for one in orders),
            "layers": 0,
            "poles": 0,
            "dofs": sum(one.field.dofs for one in orders),
            "surface_unknowns": sum(one.field.surface_unknowns for one in orders),
            "plate_shapes": sum(one.field.bodies[index].size for one in orders for index in one.tank.elastic),
        },
        reasons=found.reasons,
    )
