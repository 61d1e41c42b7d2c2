"""Modes of a level tank of any plan, with plates of any outline, to a tolerance."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import count as numbered
from math import ceil, log10, pi, sqrt

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.adaptive import ErrorEstimate, adaptive_solve
from hydroelastic.fem.modes import Mode
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.plan.box_resolution import expected_eigenvalue, plate_wavenumber, water_wavenumber
from hydroelastic.fem.plan.classes import ClassModes, count_is_confirmed, solve_classes
from hydroelastic.fem.plan.plan_errors import liquid_and_pole_errors
from hydroelastic.fem.plan.plan_pencil import PlanPlate, PlanSpace, plan_pencil, plan_space, stacked_pencil
from hydroelastic.fem.plan.plates import anticlockwise, plan_plate
from hydroelastic.fem.stopwatch import Report
from hydroelastic.fem.tank.resolution import radians
from hydroelastic.meshes.distribute import distribute_mesh
from hydroelastic.meshes.geometry import FREE_SURFACE
from hydroelastic.meshes.plan import plan_mesh
from hydroelastic.meshes.plan_loops import CircleLoop, Loop, PlanRegion, PolygonLoop
from hydroelastic.modal.liquid.vertical_poles import VerticalPoles, vertical_poles
from hydroelastic.physics.dofs import body_name
from hydroelastic.physics.level_tank import Box, Cylinder, LevelTank, PolygonPlan
from hydroelastic.physics.plate import Disc, Plate, Polygon, Rectangle

HIGHEST_DEGREE = 10
MOST_LAYERS = 8
MOST_POLYNOMIALS = 40
_MOST_ATTEMPTS = 5
# Largest cell, in parts of the plan's extent.
_OF_PLAN = 0.25
# The decay of gradients alone shows about half of a pole's energy, whose other part is d ∫(ψ_j)².
_WITH_MASS = 2.0
_ROUNDING = 1e-12
# The lowest wavenumber of a convex plan is π over its diameter at least (Payne and Weinberger 1960), 2.2 in a square of
# unit length; a half of that, for other plans.
_LOWEST = 0.5 * pi / sqrt(2.0)


@dataclass(frozen=True, kw_only=True)
class PlanResolution:
    """Degree, cells, poles and polynomials.

    Attributes:
        degree: of ψ.
        size: largest cell, in units of the tank.
        layers: on each side of an edge of a plate.
        pole_error: largest ε of the poles that is accepted.
        wavenumber: of the shortest wave of interest.
        polynomials: number of polynomials along each direction of each plate.
    """

    degree: int
    size: float
    layers: int
    pole_error: float
    wavenumber: float
    polynomials: tuple[int, ...]

    @property
    def coarser(self) -> PlanResolution:
        """The resolution that confirms the number of modes."""
        return replace(
            self,
            degree=max(3, self.degree - 3),
            layers=1,
            pole_error=1e-3,
            polynomials=tuple(max(6, count - 6) for count in self.polynomials),
        )

    def refined(self, errors: PlanErrors, tolerance: float) -> PlanResolution | None:
        """Return the next resolution by the parts of the error; ``None`` where it ends."""
        share, finer = tolerance / 3.0, self
        liquid, poles, plates = (
            float(part.max(initial=0.0)) / share for part in (errors.liquid, errors.poles, errors.plates)
        )
        if liquid > 1.0:
            more = 1 + int(liquid > 30.0)
            finer = replace(
                finer,
                degree=min(self.degree + more, HIGHEST_DEGREE),
                layers=min(self.layers + more, MOST_LAYERS),
                size=self.size * (0.7 if self.degree == HIGHEST_DEGREE else 0.9),
            )
        if poles > 1.0:
            finer = replace(finer, pole_error=self.pole_error / (2.0 * poles))
        if plates > 1.0:
            factor = min(max(1.2 * plates ** (1.0 / 8.0), 1.2), 2.0)
            finer = replace(
                finer, polynomials=tuple(min(ceil(factor * count), MOST_POLYNOMIALS) for count in self.polynomials)
            )
        return None if finer == self else finer


@dataclass(frozen=True, kw_only=True)
class PlanErrors:
    """Relative errors of the frequencies by cause, each of shape (modes,).

    Attributes:
        liquid: by the space of ψ.
        poles: a bound of that by the poles of the depth.
        plates: by the polynomials of the plates.
    """

    liquid: np.ndarray
    poles: np.ndarray
    plates: np.ndarray

    @property
    def total(self) -> np.ndarray:
        """Their sum, and rounding."""
        errors: np.ndarray = self.liquid + self.poles + self.plates + _ROUNDING
        return errors

    def first(self, count: int) -> PlanErrors:
        """Return those of the first modes."""
        return PlanErrors(liquid=self.liquid[:count], poles=self.poles[:count], plates=self.plates[:count])


@dataclass(frozen=True, kw_only=True)
class PlanSolution:
    """Modes of a dimensionless tank on its plan.

    Attributes:
        tank: the tank.
        resolution: the last one.
        space: the plan.
        plates: the plates as bodies.
        poles: of the depth.
        modes: the lowest modes, one more than asked for.
        errors: of their frequencies.
        counted: whether a coarser model confirms the number of modes.
        attempts: number of resolutions that were solved.
    """

    tank: LevelTank
    resolution: PlanResolution
    space: PlanSpace
    plates: tuple[PlanPlate, ...]
    poles: VerticalPoles
    modes: ClassModes
    errors: PlanErrors
    counted: bool
    attempts: int

    @property
    def sizes(self) -> dict[str, int]:
        """Numbers of its resolution, by name."""
        return {
            "problems": 1,
            "degree": self.resolution.degree,
            "layers": self.resolution.layers,
            "poles": len(self.poles.shifts),
        }

    @property
    def relative_errors(self) -> np.ndarray:
        """Estimated relative error of each frequency, shape (modes,)."""
        return self.errors.total


def solve_plan(
    tank: LevelTank,
    *,
    tolerance: float,
    count: int,
    comm: MPI.Comm | None = None,
    report: Report = lambda _message: None,
) -> PlanSolution:
    """Solve a dimensionless tank on its plan (collective).

    Args:
        tank: the tank, with waves or a lid beside the plates.
        tolerance: largest relative error of the frequencies that is accepted.
        count: number of modes, from the lowest.
        comm: the processes over which the poles are distributed; all by default.
        report: receives messages on the progress.

    Raises:
        MeshError: if the plan cannot be meshed.
    """
    processes = comm or MPI.COMM_WORLD
    attempts = numbered(1)

    def solve(resolution: PlanResolution) -> PlanSolution:
        attempt = next(attempts)
        report(f"attempt {attempt}: degree {resolution.degree}, {resolution.layers} layers")
        space, plates, poles = _parts(tank, resolution)
        pencil = plan_pencil(space, poles, plates, waves=tank.top == "free", comm=processes)
        modes = solve_classes({(None, None): pencil}, count + 1)
        found = [modes.completed(index) for index in range(len(modes.eigenvalues))]
        gradients, missing = liquid_and_pole_errors(pencil, found, tank.depth, _LOWEST)
        errors = PlanErrors(
            liquid=0.5 * _WITH_MASS * gradients,
            poles=0.5 * missing,
            plates=_plate_errors(plates, found),
        )

        def coarse(_: object) -> CoupledPencil:
            space, plates, poles = _parts(tank, resolution.coarser)
            return stacked_pencil(space, poles, plates, waves=tank.top == "free")

        return PlanSolution(
            tank=tank,
            resolution=resolution,
            space=space,
            plates=plates,
            poles=poles,
            modes=modes,
            errors=errors,
            counted=count_is_confirmed(modes, coarse),
            attempts=attempt,
        )

    return adaptive_solve(
        plan_resolution(tank, tolerance, count),
        solve,
        lambda solution: ErrorEstimate(
            discretization=float(solution.relative_errors[:count].max(initial=0.0)), missing=int(not solution.counted)
        ),
        lambda _, solution: solution.resolution.refined(solution.errors.first(count), tolerance),
        tolerance,
        rounds=_MOST_ATTEMPTS,
    ).solution


def plan_resolution(tank: LevelTank, tolerance: float, count: int) -> PlanResolution:
    """Return the resolution for some modes of a dimensionless tank."""
    digits = -log10(tolerance)
    degree = min(max(ceil(0.5 + 0.9 * digits), 5), HIGHEST_DEGREE - 1)
    eigenvalue = expected_eigenvalue(tank, count)
    wavenumbers = [plate_wavenumber(tank, plate, eigenvalue) for plate in tank.plates]
    shortest = max([water_wavenumber(tank, eigenvalue), *wavenumbers])
    return PlanResolution(
        degree=degree,
        size=min(1.3 * radians(degree, tolerance) / shortest, _OF_PLAN),
        layers=min(max(ceil(digits / 1.4 - 1.7), 1), MOST_LAYERS - 2),
        pole_error=2.0 * tolerance,
        wavenumber=max(shortest, 3.0),
        polynomials=tuple(
            min(ceil(1.1 * wavenumber * _extent(plate) / pi + 1.2 * digits) + 4, MOST_POLYNOMIALS)
            for plate, wavenumber in zip(tank.plates, wavenumbers, strict=True)
        ),
    )


def _extent(plate: Plate) -> float:
    outline = plate.outline
    if isinstance(outline, Disc):
        return 2.0 * outline.radius
    if isinstance(outline, Rectangle):
        return max(outline.size)
    assert isinstance(outline, Polygon)
    return float(np.ptp(np.array(outline.points), axis=0).max())


def _parts(tank: LevelTank, resolution: PlanResolution) -> tuple[PlanSpace, tuple[PlanPlate, ...], VerticalPoles]:
    wall, plates = plan_regions(tank)
    mesh = plan_mesh(
        wall,
        plates,
        size=lambda _: resolution.size,
        layers=resolution.layers,
        thickness=min(0.5 * resolution.size, tank.depth),
        geometry_degree=min(max(resolution.degree, 4), 8),
    )
    space = plan_space(distribute_mesh(MPI.COMM_SELF, mesh), resolution.degree)
    bodies = tuple(plan_plate(tank, index, polynomials) for index, polynomials in enumerate(resolution.polynomials))
    poles = vertical_poles(tank.depth, resolution.wavenumber, resolution.pole_error, lowest=_LOWEST)
    return space, bodies, poles


def plan_regions(tank: LevelTank) -> tuple[PlanRegion, tuple[PlanRegion, ...]]:
    """Return the inside of the walls, and the outline of each plate."""
    wall = _wall(tank)
    return wall, tuple(_region(tank, index, wall) for index in range(len(tank.plates)))


def _wall(tank: LevelTank) -> PlanRegion:
    plan = tank.plan
    if isinstance(plan, Cylinder):
        outer: Loop = CircleLoop(centre=np.zeros(2), radius=plan.radius)
        inner = (CircleLoop(centre=np.zeros(2), radius=plan.inner_radius),) if plan.inner_radius else ()
        return PlanRegion(name=FREE_SURFACE, outside=outer, inside=inner)
    if isinstance(plan, Box):
        corners = np.array([[0.0, 0.0], [plan.length, 0.0], [plan.length, plan.width], [0.0, plan.width]])
    else:
        assert isinstance(plan, PolygonPlan)
        corners = anticlockwise(np.array(plan.points))
    return PlanRegion(name=FREE_SURFACE, outside=PolygonLoop(corners=corners))


def _region(tank: LevelTank, index: int, wall: PlanRegion) -> PlanRegion:
    """The outline of a plate; that of the wall itself where it covers the plan."""
    outline, name = tank.plates[index].outline, body_name(index + 1)
    if outline.area > tank.plan.area * (1.0 - 1e-9):
        return PlanRegion(name=name, outside=wall.outside, inside=wall.inside)
    if isinstance(outline, Disc):
        centre = np.array(outline.position)
        hole = (CircleLoop(centre=centre, radius=outline.inner_radius),) if outline.inner_radius else ()
        return PlanRegion(name=name, outside=CircleLoop(centre=centre, radius=outline.radius), inside=hole)
    if isinstance(outline, Rectangle):
        (x, y), (length, width) = outline.position, outline.size
        half = 0.5 * np.array([[-length, -width], [length, -width], [length, width], [-length, width]])
        return PlanRegion(name=name, outside=PolygonLoop(corners=np.array([x, y]) + half))
    assert isinstance(outline, Polygon)
    return PlanRegion(name=name, outside=PolygonLoop(corners=anticlockwise(np.array(outline.points))))


def _plate_errors(plates: tuple[PlanPlate, ...], modes: list[Mode]) -> np.ndarray:
    errors = np.zeros(len(modes))
    first = 0
    for plate in plates:
        last = first + plate.body.size
        errors += plate.missing_energy(
            np.array([mode.body_amplitudes[first:last] for mode in modes]).reshape(len(modes), last - first)
        )
        first = last
    return 0.5 * errors / np.array([mode.eigenvalue for mode in modes])
