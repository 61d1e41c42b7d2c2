"""Modes of a tank on a mesh of its volume to a tolerance."""

from __future__ import annotations

import gc
from dataclasses import dataclass, replace
from functools import partial
from itertools import count as numbered
from sys import maxsize

import numpy as np
from mpi4py import MPI
from petsc4py import PETSc

from hydroelastic.fem.adaptive import ErrorEstimate, adaptive_solve
from hydroelastic.fem.cells import cell_corners, owned_cells
from hydroelastic.fem.cost import DIRECT_UNKNOWNS, cost, free_memory
from hydroelastic.fem.level_bed.solution import BY_INERTIA
from hydroelastic.fem.liquid import ClosedLayer, LiquidSolver, LiquidSpace, constrained_dofs
from hydroelastic.fem.liquid_operator import LiquidOperator
from hydroelastic.fem.mode_set import Mode
from hydroelastic.fem.plan.classes import (
    ClassModes,
    SymmetryClass,
    count_is_confirmed,
    merged_errors,
    no_mode_is_beyond,
    solve_classes,
)
from hydroelastic.fem.plan.plan_pencil import PlanPlate
from hydroelastic.fem.plan.truncation import plate_errors
from hydroelastic.fem.progress import Report
from hydroelastic.fem.solver_error import TooLargeError
from hydroelastic.fem.spectral_error import cell_errors
from hydroelastic.fem.volume.cubic_errors import DEGREE, cubic_errors
from hydroelastic.fem.volume.distribution import distributed_volume
from hydroelastic.fem.volume.eigenmodes import volume_modes
from hydroelastic.fem.volume.loads import plate_loads
from hydroelastic.fem.volume.model import VolumeModel, volume_mirrors
from hydroelastic.fem.volume.multigrid import MultigridSolver
from hydroelastic.fem.volume.resolution import (
    VolumeErrors,
    VolumeResolution,
    next_resolution,
    volume_resolution,
    with_refinements,
)
from hydroelastic.meshes.plan_loops import image_count
from hydroelastic.meshes.tagged_mesh import MeshError, NodedMesh
from hydroelastic.meshes.tetrahedra import unknown_count
from hydroelastic.physics.volume_tank import VolumeTank

_MOST_ATTEMPTS = 5
# True errors over those shown at edges of plates, at tips of baffles, at corners of floats and of waves; measured on
# plates in boxes and cylinders, a baffle on a bed, and floating cylinders. By the decay of the energy with the
# degree 0.36 to 0.57 of the error is shown at edges, all of it at corners; by what the third degree adds to the second
# one, which has no tips, 0.8, 0.62, and 0.95 of waves.
_DECAY = (3.0, 1.8, 2.4, 1.8)
_CUBIC = (1.5, 1.9, 1.9, 1.2)
# Cells up to this multiple of the size at edges belong to them.
_AT_EDGES = 4.0
_ROUNDING = 1e-11
# Of the asked tolerance, that of Laplace's equation by iteration; measured: 1e-9 changes frequencies by 1e-11.
_INNER = 1e-2
# Tolerance for which Laplace's equation is solved in the coarser space that modes are sought in first.
_COARSE = 1e-4


@dataclass(frozen=True, kw_only=True)
class VolumeSolution:
    """Modes of a dimensionless tank on a mesh of its volume.

    Attributes:
        model: the tank in its last resolution.
        modes: the lowest modes, one more than asked for.
        errors: of their frequencies.
        counted: whether the number of modes is confirmed.
        count_method: by what: the inertia of a coarser model, or a second start.
        iterations: mean number of iterations of Laplace's equation; 0 of a direct solver.
    """

    model: VolumeModel
    modes: ClassModes
    errors: VolumeErrors
    counted: bool
    count_method: str
    iterations: float

    @property
    def sizes(self) -> dict[str, int]:
        """Numbers of its resolution, by name."""
        return {
            "problems": len(self.modes.classes),
            "degree": self.model.resolution.degree,
            "cells": self.model.mesh.cell_count,
            "iterations": round(self.iterations),
            "layers": 0,
            "poles": 0,
        }

    @property
    def remark(self) -> str:
        """What the model of volumes adds to its name."""
        quadratic = self.model.resolution.degree == DEGREE
        return ", of the second degree with errors by what the third adds" if quadratic else ""

    @property
    def relative_errors(self) -> np.ndarray:
        """Estimated relative error of each frequency, shape (modes,)."""
        return self.errors.total + _ROUNDING


def solve_volume(
    tank: VolumeTank,
    *,
    tolerance: float,
    count: int,
    comm: MPI.Comm | None = None,
    report: Report = lambda _message: None,
) -> VolumeSolution:
    """Solve a dimensionless tank on its volume (collective)."""
    processes = comm or MPI.COMM_WORLD
    mirrors, attempts = volume_mirrors(tank), numbered(1)

    def solve(resolution: VolumeResolution) -> VolumeSolution:
        attempt = next(attempts)
        sizes = with_refinements(tank, resolution.sizes, mirrors)
        layered = bool(resolution.sizes.layers)

        def require_room(cells: NodedMesh, refinements: int) -> None:
            unknowns, problems = unknown_count(cells, resolution.degree, refinements), image_count(mirrors)
            needed, free = (
                cost(unknowns, resolution.degree, count, "volume", problems, layered).memory,
                free_memory() + cost(0, 1, 0, "volume").memory,
            )  # of the program
            if needed > free:
                raise TooLargeError(
                    f"{unknowns} unknowns of degree {resolution.degree} need about {needed / 1e9:.1f} GB, and "
                    f"{free / 1e9:.1f} GB are free: ask for a larger tolerance or fewer modes"
                )

        mesh, geometry = distributed_volume(tank, sizes, mirrors, processes, require_room)
        model = VolumeModel(tank=tank, resolution=resolution, mesh=mesh, mirrors=mirrors)
        size = model.liquid.size
        report(f"attempt {attempt}: {mesh.cell_count} cells, degree {resolution.degree}, {size} unknowns")
        solver_of = partial(direct_or_multigrid, tolerance=tolerance)
        # Multigrid would hardly converge on layers.
        pencils = model.pencils(partial(solver_of, largest=maxsize) if layered else solver_of)
        # Motions that grow have no second start, and are of small tanks.
        growing = any(len(one.unstable) for one in pencils.values())
        coarser = replace(model, resolution=resolution.coarser)
        by_inertia = growing or coarser.liquid.size <= DIRECT_UNKNOWNS

        def told(message: str) -> None:
            iterations = _mean_iterations([one.solver for one in pencils.values()])
            each = f" of {iterations:.0f} iterations each" if iterations else ""
            report(f"attempt {attempt}, {size} unknowns: {message}{each}")

        def is_counted(found: ClassModes) -> bool:
            if not by_inertia:
                return no_mode_is_beyond(found)
            return count_is_confirmed(found, lambda parity: coarser.pencil(parity, _no_solver), repeated=True)

        def found_by_one_start() -> ClassModes:
            return solve_classes(pencils, count + 1, tolerance)

        if growing:
            modes = found_by_one_start()
            counted = is_counted(modes)
        else:
            coarse_solver = partial(solver_of, tolerance=_COARSE, largest=maxsize if layered else DIRECT_UNKNOWNS)
            modes = volume_modes(model, pencils, count + 1, tolerance, solver_of=coarse_solver, report=told)
            report(f"attempt {attempt}, {size} unknowns: count of the modes")
            counted = is_counted(modes)
            if not counted:
                # One that the coarser space does not have.
                modes = found_by_one_start()
                counted = is_counted(modes)

        def errors_of(one: SymmetryClass, some: list[Mode]) -> np.ndarray:
            edges, waves = _liquid_errors(one, model, some)

            def pressures_of(plate: PlanPlate) -> np.ndarray:
                potentials = np.array([mode.potential.array_r for mode in some])
                own = [potentials @ load for load in plate_loads(one.pencil.liquid, plate)]
                found: np.ndarray = model.images * processes.allreduce(np.reshape(own, (-1, len(some))).T)
                return found

            plates = plate_errors(model.plates[one.parity], some, pressures_of)
            return np.array([model.images * edges, model.images * waves, plates])

        edges, waves, plates = merged_errors(modes, 3, errors_of)
        return VolumeSolution(
            model=model,
            modes=modes,
            errors=VolumeErrors(
                edges=edges,
                waves=waves,
                geometry=np.full(len(edges), geometry),
                plates=plates,
                iteration=0.5 * modes.bounds,
            ),
            counted=counted,
            count_method=BY_INERTIA if by_inertia else "residuals, and a second start vector",
            iterations=_mean_iterations([one.pencil.solver for one in modes.classes]),
        )

    return adaptive_solve(
        volume_resolution(tank, tolerance, count, mirrors),
        solve,
        lambda solution: ErrorEstimate(
            discretization=float(solution.relative_errors[:count].max(initial=0.0)), missing=int(not solution.counted)
        ),
        lambda _, solution: _refined(solution, count, tolerance),
        tolerance,
        rounds=_MOST_ATTEMPTS,
        failures=(MeshError,),
    ).solution


def _mean_iterations(solvers: list[LiquidOperator]) -> float:
    """Iterations of a solution of Laplace's equation; 0 of direct solvers."""
    own = [one for one in solvers if isinstance(one, MultigridSolver)]
    return sum(one.iterations for one in own) / max(sum(one.solves for one in own), 1)


def _refined(solution: VolumeSolution, count: int, tolerance: float) -> VolumeResolution | None:
    """The next resolution, ``None`` where there is none; the factors of the last one are given back (collective)."""
    model = solution.model
    finer = next_resolution(
        model.resolution,
        model.liquid.size,
        solution.errors.first(count),
        model.tank,
        tolerance,
        count,
        model.mirrors,
    )
    if finer is not None:
        for one in solution.modes.classes:
            if isinstance(one.pencil.solver, LiquidSolver):
                one.pencil.solver.release()
        # On several processes PETSc keeps objects until all let go, which Python does at other times on each.
        gc.collect()
        PETSc.garbage_cleanup(solution.model.mesh.mesh.comm)
    return finer


def direct_or_multigrid(
    liquid: LiquidSpace,
    laplace: PETSc.Mat,
    closed: tuple[ClosedLayer, ...],
    images: int,
    *,
    tolerance: float,
    largest: int = DIRECT_UNKNOWNS,
) -> LiquidOperator:
    """A factorization of small problems, multigrid of large ones (collective)."""
    if liquid.size <= largest:
        return LiquidSolver(laplace, constrained_dofs(liquid), closed)
    return MultigridSolver(liquid, laplace, closed, images, tolerance=_INNER * tolerance)


def _no_solver(
    _liquid: LiquidSpace, _laplace: PETSc.Mat, _closed: tuple[ClosedLayer, ...], _images: int
) -> LiquidOperator:
    return _Unused()


class _Unused:
    """A⁺ where only the inertia of the matrices is taken: a factorization for it would cost as much as the count."""

    solves = 0

    def solve(self, load: PETSc.Vec, potential: PETSc.Vec) -> None:
        raise AssertionError("a problem that is only counted in has no solver")


def _liquid_errors(one: SymmetryClass, model: VolumeModel, modes: list[Mode]) -> tuple[np.ndarray, np.ndarray]:
    """Relative errors of ω by ψ at edges and elsewhere, in one of the parts that are alike (collective)."""
    quadratic = model.resolution.degree == DEGREE
    if quadratic:
        cells = cubic_errors(one.pencil, model.plates[one.parity], modes)
    else:
        cells = cell_errors(one.pencil.liquid, [mode.potential for mode in modes])
    mesh = model.mesh.mesh
    corners = cell_corners(mesh, owned_cells(mesh))
    # The edge of the regular tetrahedron of the same volume.
    sizes = np.cbrt(np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) * np.sqrt(2.0))
    small = sizes < _AT_EDGES * model.resolution.sizes.edge
    parts = np.array([cells[:, small].sum(axis=1), cells[:, ~small].sum(axis=1)])
    edges, waves = 0.5 * mesh.comm.allreduce(parts)
    of_edges, of_tips, of_corners, of_waves = _CUBIC if quadratic else _DECAY
    singular = of_edges if model.tank.plates else of_tips if model.tank.baffles else of_corners
    return singular * edges, of_waves * waves
