"""Modes of a level tank of any plan, with plates of any outline, to a tolerance."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import count as numbered
from math import ceil, inf, log, log10, pi, sqrt

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.adaptive import ErrorEstimate, adaptive_solve
from hydroelastic.fem.closed.discretization import radians
from hydroelastic.fem.level_bed.resolution import expected_eigenvalue
from hydroelastic.fem.level_bed.solution import BY_INERTIA
from hydroelastic.fem.mode_set import Mode
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.plan.classes import (
    ClassModes,
    SymmetryClass,
    count_is_confirmed,
    merged_errors,
    mirrored_classes,
    solve_classes,
)
from hydroelastic.fem.plan.plan_errors import liquid_and_pole_errors
from hydroelastic.fem.plan.plan_pencil import (
    PlanLiquid,
    PlanPlate,
    PlanSpace,
    plan_pencil,
    plan_space,
    stacked_pencil,
)
from hydroelastic.fem.plan.plates import plan_plate
from hydroelastic.fem.plan.polynomials import (
    more_polynomials,
    plate_wavenumbers,
    polynomial_counts,
    water_wavenumber,
)
from hydroelastic.fem.plan.released import ReleasedProblem, released_plan
from hydroelastic.fem.plan.truncation import plate_errors
from hydroelastic.fem.progress import Report
from hydroelastic.meshes.distribute import distribute_mesh
from hydroelastic.meshes.plan import edges_of, plan_mesh
from hydroelastic.meshes.plan_grid import are_rectangles
from hydroelastic.meshes.plan_loops import RATIO as LAYER_RATIO
from hydroelastic.meshes.plan_loops import Mirrors, PlanRegion, image_count, room_between
from hydroelastic.meshes.plan_regions import mirrors_of, plan_regions
from hydroelastic.modal.liquid.vertical_poles import VerticalPoles, vertical_poles
from hydroelastic.modal.plate.rectangle import ClassParity
from hydroelastic.physics.level_tank import LevelTank

HIGHEST_DEGREE = 10
MOST_LAYERS = 8
_MOST_ATTEMPTS = 5
# Largest cell, in parts of the plan's extent.
_OF_PLAN = 0.25
# The decay of gradients alone shows about half of a pole's energy, whose other part is d ∫(ψ_j)².
_WITH_MASS = 2.0
# Where a narrow gap makes all layers thin, cells beside them are as large as before, and each layer that is missing
# between hides another quarter of the error; measured beside walls down to gaps of 2e-4 of a box.
_OF_LAYER = 0.25
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

    def refined(self, errors: np.ndarray, tolerance: float) -> PlanResolution | None:
        """Return the next resolution by the errors of the liquid, the poles and the plates; ``None`` where it ends."""
        share, finer = tolerance / 3.0, self
        liquid, poles, plates = (float(part.max(initial=0.0)) / share for part in errors)
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
            finer = replace(finer, polynomials=more_polynomials(self.polynomials, plates))
        return None if finer == self else finer


@dataclass(frozen=True, kw_only=True)
class PlanParts:
    """What all symmetry classes of a tank share at one resolution.

    Attributes:
        space: the part of the plan between its mirror planes.
        poles: of the depth.
        missing_layers: how many layers lie between those of a narrow gap and the thickest ones elsewhere.
    """

    space: PlanSpace
    poles: VerticalPoles
    missing_layers: float


@dataclass(frozen=True, kw_only=True)
class PlanModel:
    """The problems of the symmetry classes of a plan at any resolution.

    Attributes:
        tank: the dimensionless tank.
        comm: the processes over which the poles are distributed.
    """

    tank: LevelTank
    comm: MPI.Comm

    @cached_property
    def regions(self) -> tuple[PlanRegion, tuple[PlanRegion, ...]]:
        """The inside of the walls, and the outline of each plate."""
        return plan_regions(self.tank)

    @cached_property
    def mirrors(self) -> Mirrors:
        """x and y of the mirror planes."""
        return mirrors_of(*self.regions)

    @cached_property
    def _parts(self) -> dict[PlanResolution, PlanParts]:
        return {}

    def parts(self, resolution: PlanResolution) -> PlanParts:
        """Return what all classes share; that of the last resolution is kept."""
        if resolution not in self._parts:
            self._parts.clear()
            self._parts[resolution] = self._assembled(resolution)
        return self._parts[resolution]

    def _assembled(self, resolution: PlanResolution) -> PlanParts:
        wall, plates = self.regions
        thickness = min(0.5 * resolution.size, self.tank.depth)
        room = inf if are_rectangles(wall, plates) else room_between(wall.loops, edges_of(wall, plates))
        mesh = plan_mesh(
            wall,
            plates,
            size=resolution.size,
            layers=resolution.layers,
            thickness=thickness,
            geometry_degree=min(max(resolution.degree, 4), 8),
            mirrors=self.mirrors,
        )
        return PlanParts(
            space=plan_space(distribute_mesh(MPI.COMM_SELF, mesh), resolution.degree, image_count(self.mirrors)),
            poles=vertical_poles(self.tank.depth, resolution.wavenumber, resolution.pole_error, lowest=_LOWEST),
            missing_layers=log(min(room / thickness, 1.0)) / log(LAYER_RATIO),
        )

    def _space(self, resolution: PlanResolution, parity: ClassParity) -> PlanSpace:
        return self.parts(resolution).space.of_class(parity, self.mirrors)

    def _plates(self, resolution: PlanResolution, parity: ClassParity) -> tuple[PlanPlate, ...]:
        return tuple(
            plan_plate(self.tank, index, polynomials, parity)
            for index, polynomials in enumerate(resolution.polynomials)
        )

    def problem(
        self, resolution: PlanResolution, parity: ClassParity
    ) -> tuple[CoupledPencil[PlanLiquid] | None, tuple[PlanPlate, ...]]:
        """Return the problem of a class, ``None`` where nothing moves, and the plates in its shapes (collective)."""
        space, plates = self._space(resolution, parity), self._plates(resolution, parity)
        waves, comm = self.tank.top == "free", None if self.tank.top == "pressure_release" else self.comm
        return plan_pencil(space, self.parts(resolution).poles, plates, waves=waves, comm=comm), plates

    def stacked(self, resolution: PlanResolution, parity: ClassParity) -> CoupledPencil:
        """Return the problem of a class in which something moves, to count its modes in."""
        space, plates = self._space(resolution, parity), self._plates(resolution, parity)
        return stacked_pencil(space, self.parts(resolution).poles, plates, waves=self.tank.top == "free")

    def released(self, resolution: PlanResolution, parity: ClassParity) -> ReleasedProblem:
        """Return the problem of a class with ψ = 0 on the water."""
        # ψ ~ r^{1/2} has a part in all waves as long as the innermost layer, which the poles have to follow.
        innermost = 0.5 * resolution.size * LAYER_RATIO**resolution.layers
        poles = vertical_poles(self.tank.depth, 1.0 / innermost, resolution.pole_error, lowest=_LOWEST)
        return released_plan(self._space(resolution, parity), poles, self._plates(resolution, parity))

    def errors(
        self, resolution: PlanResolution, one: SymmetryClass, plates: tuple[PlanPlate, ...], modes: list[Mode]
    ) -> np.ndarray:
        """Return relative errors of ω by the liquid, the poles and the plates, shape (3, modes) (collective)."""
        gradients, missing = liquid_and_pole_errors(one.pencil, modes, self.tank.depth)
        space, potentials = one.pencil.liquid.space, np.array([mode.potential.array_r for mode in modes])
        missing_shapes = plate_errors(plates, modes, lambda plate: potentials @ space.loads(plate).T)
        hidden = 1.0 + _OF_LAYER * self.parts(resolution).missing_layers
        return np.array([0.5 * _WITH_MASS * hidden * gradients, 0.5 * missing, missing_shapes])


@dataclass(frozen=True, kw_only=True)
class PlanSolution:
    """Modes of a dimensionless tank on its plan.

    Attributes:
        modes: the lowest modes, one more than asked for.
        plates: the plates as bodies, in the shapes of each symmetry class.
        errors: relative errors of their frequencies by cause, shape (causes, modes).
        counted: whether the number of modes is confirmed.
        sizes: numbers of the last one, by name.
        count_method: what confirms the number.
    """

    modes: ClassModes
    plates: dict[ClassParity, tuple[PlanPlate, ...]]
    errors: np.ndarray
    counted: bool
    sizes: dict[str, int]
    count_method: str = BY_INERTIA

    @property
    def relative_errors(self) -> np.ndarray:
        """Estimated relative error of each frequency, shape (modes,)."""
        errors: np.ndarray = self.errors.sum(axis=0) + _ROUNDING
        return errors


def solve_plan(
    model: PlanModel, *, tolerance: float, count: int, report: Report = lambda _message: None
) -> PlanSolution:
    """Solve a dimensionless tank on its plan (collective)."""
    attempts = numbered(1)

    def solve(resolution: PlanResolution) -> PlanSolution:
        report(f"attempt {next(attempts)}: degree {resolution.degree}, {resolution.layers} layers")
        problems = {parity: model.problem(resolution, parity) for parity in mirrored_classes(model.mirrors)}
        pencils = {parity: one for parity, (one, _) in problems.items() if one is not None}
        modes, poles = solve_classes(pencils, count + 1, tolerance), len(model.parts(resolution).poles.shifts)
        return PlanSolution(
            modes=modes,
            plates={parity: plates for parity, (_, plates) in problems.items()},
            errors=merged_errors(
                modes, 3, lambda one, own: model.errors(resolution, one, problems[one.parity][1], own)
            ),
            counted=count_is_confirmed(modes, lambda parity: model.stacked(resolution.coarser, parity)),
            sizes={
                "problems": len(modes.classes),
                "degree": resolution.degree,
                "layers": resolution.layers,
                "poles": poles,
            },
        )

    return adaptive_solve(
        plan_resolution(model.tank, tolerance, expected_eigenvalue(model.tank, count)),
        solve,
        lambda solution: ErrorEstimate(
            discretization=float(solution.relative_errors[:count].max(initial=0.0)), missing=int(not solution.counted)
        ),
        lambda resolution, solution: resolution.refined(solution.errors[:, :count], tolerance),
        tolerance,
        rounds=_MOST_ATTEMPTS,
    ).solution


def plan_resolution(tank: LevelTank, tolerance: float, eigenvalue: float, *, released: bool = False) -> PlanResolution:
    """Return the resolution for the modes of a dimensionless tank up to some λ."""
    digits = -log10(tolerance)
    degree = min(max(ceil(0.5 + 0.9 * digits), 5), HIGHEST_DEGREE - 1)
    wavenumbers = plate_wavenumbers(tank, eigenvalue)
    shortest = max([0.0 if released else water_wavenumber(tank, eigenvalue), *wavenumbers, 1.0])
    return PlanResolution(
        degree=degree,
        size=min(1.3 * radians(degree, tolerance) / shortest, _OF_PLAN),
        layers=min(max(ceil(digits / 1.4 - 1.7), 1), MOST_LAYERS - 2),
        pole_error=2.0 * tolerance,
        wavenumber=max(shortest, 3.0),
        polynomials=polynomial_counts(tank, wavenumbers, tolerance),
    )
