"""Modes of a volume from those of a coarser space on the same mesh, of half the degree.

The coarser space has about an eighth of the unknowns. Its modes tell how many each symmetry has among the lowest ones,
and are the first approximation of those of the finer space, double ones included.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from dolfinx.fem import petsc as fem_petsc
from petsc4py import PETSc

from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.fem.mode_set import ModeSet
from hydroelastic.fem.modes import solve_modes
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.plan.classes import OF_RESIDUALS, ClassModes, solve_classes
from hydroelastic.fem.progress import Report
from hydroelastic.fem.refined_modes import refined_modes
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.volume.model import VolumeModel
from hydroelastic.fem.volume.pencil import SolverOf
from hydroelastic.modal.plate.rectangle import ClassParity

# Residual of modes over the root of the tolerance: it enters frequencies squared, over the gap to the modes beyond, and
# shapes are then more accurate than those of a mesh that keeps the tolerance.
_RESIDUAL, _LARGEST_RESIDUAL = 0.1, 3e-3
# Tolerance of the coarser space's modes: its own error is larger.
_COARSE = 1e-1


@dataclass
class _CoarserModes:
    """Modes of the coarser space, by class, more where they are asked for."""

    pencils: dict[ClassParity, CoupledPencil]
    found: dict[ClassParity, ModeSet] = field(default_factory=dict)

    def shares(self, count: int) -> dict[ClassParity, int]:
        """The number of modes of each class among the lowest, and one that shows what is beyond (collective)."""
        modes = solve_classes(self.pencils, count, _COARSE)
        self.found = {one.parity: one.modes for one in modes.classes}
        own = np.bincount([number for number, _ in modes.origins], minlength=len(modes.classes))
        beyond = 0 if len(own) == 1 else 1
        return {one.parity: int(share) + beyond for one, share in zip(modes.classes, own, strict=True)}

    def displacements(self, parity: ClassParity, count: int) -> tuple[PETSc.Vec, ...]:
        """Those of the lowest modes of a class, fewer if it has fewer (collective)."""
        if len(self.found[parity].eigenvectors) < count:
            self.found[parity] = solve_modes(self.pencils[parity], count, shapes=0, tolerance=OF_RESIDUALS * _COARSE)
        return self.found[parity].eigenvectors[:count]


def volume_modes(
    model: VolumeModel,
    pencils: dict[ClassParity, CoupledPencil],
    count: int,
    tolerance: float,
    *,
    solver_of: SolverOf,
    report: Report = lambda _message: None,
) -> ClassModes:
    """Return the lowest modes of all classes (collective)."""
    report("modes of the coarser space")
    coarser = replace(model, resolution=replace(model.resolution, degree=model.resolution.degree // 2))
    coarse = _CoarserModes({one: own for one, own in coarser.pencils(solver_of).items() if one in pencils})
    residual = min(_RESIDUAL * tolerance**0.5, _LARGEST_RESIDUAL)

    def solve(parity: ClassParity, pencil: CoupledPencil, share: int) -> ModeSet:
        lower = coarse.pencils[parity]
        given = coarse.displacements(parity, share)
        if len(given) < share:
            return solve_modes(pencil, share, shapes=0, tolerance=OF_RESIDUALS * tolerance)
        start = _prolonged(lower, pencil, given)
        return refined_modes(pencil, start, residual, beyond=len(pencils) > 1, report=report)

    try:
        return solve_classes(pencils, count, tolerance, solve=solve, shares=coarse.shares(count))
    except EigenSolverError:
        return solve_classes(pencils, count, tolerance)


def _prolonged(
    lower: CoupledPencil[LiquidSpace], upper: CoupledPencil[LiquidSpace], displacements: tuple[PETSc.Vec, ...]
) -> list[PETSc.Vec]:
    """Displacements of the same bodies and surfaces in a finer space (collective)."""
    matrix = fem_petsc.interpolation_matrix(lower.liquid.space, upper.liquid.space)
    matrix.assemble()
    fine, coarse = matrix.createVecs()[::-1]
    bodies = upper.body_size if upper.stiffness.comm.rank == 0 else 0
    found = []
    for given in displacements:
        made, first, start = upper.stiffness.createVecRight(), bodies, bodies
        made.array[:bodies] = given.array_r[:bodies]
        for surface in upper.surfaces:
            places, finer = (one.liquid.surface_dofs((surface.surface,), surface.below) for one in (lower, upper))
            coarse.set(0.0)
            coarse.array[places] = given.array_r[first : first + len(places)]
            matrix.mult(coarse, fine)
            made.array[start : start + len(finer)] = fine.array_r[finer]
            first, start = first + len(places), start + len(finer)
        found.append(made)
    return found
