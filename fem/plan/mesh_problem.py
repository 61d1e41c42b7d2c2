"""The problem of a symmetry class of any plan, as the common solution of level tanks has it, with its modes sampled."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from dolfinx import geometry
from petsc4py import PETSc
from scipy import sparse
from slepc4py import SLEPc

from hydroelastic.fem.cells import nearest_in_cells
from hydroelastic.fem.direct import configure_direct
from hydroelastic.fem.level_bed.solution import SampledSurface
from hydroelastic.fem.mode_set import Mode
from hydroelastic.fem.plan.classes import ClassProblem
from hydroelastic.fem.plan.plan import PlanModel
from hydroelastic.fem.plan.plan_pencil import PlanPlate, PlanSpace, water_unknowns
from hydroelastic.meshes.geometry import FREE_SURFACE
from hydroelastic.physics.arrays import FloatArray

# Standing waves of a plan that carry ψ down; what is left is near the edges of plates.
_CARRIED = 120


@dataclass(frozen=True, kw_only=True)
class MeshProblem(ClassProblem):
    """A symmetry class of a tank on its plan; see `PlanProblem`.

    Attributes:
        plates: the plates as bodies.
        model: the tank on its plan.
    """

    plates: tuple[PlanPlate, ...]
    model: PlanModel

    @cached_property
    def _waves_at(self) -> dict[bytes, FloatArray]:
        """The standing waves at points that were sampled, (points, waves)."""
        return {}

    @cached_property
    def _standing_waves(self) -> tuple[FloatArray, FloatArray]:
        """The lowest k and functions of K₂v = k²M₂v on the plan, vᵀM₂v = 1, shape (waves,) and (unknowns, waves)."""
        space: PlanSpace = self.pencil.liquid.space
        solver = SLEPc.EPS().create(PETSc.COMM_SELF)
        shifted = space.stiffness.copy()
        shifted.axpy(1.0, space.mass, structure=PETSc.Mat.Structure.SAME_NONZERO_PATTERN)
        shifted.setOption(PETSc.Mat.Option.SPD, True)
        solver.setOperators(space.mass, shifted)
        solver.setProblemType(SLEPc.EPS.ProblemType.GHEP)
        solver.setDimensions(min(_CARRIED, space.size // 4))
        solver.setTolerances(1e-6, 100)
        configure_direct(solver.getST().getKSP())
        solver.solve()
        count = min(solver.getConverged(), _CARRIED)
        vector = space.mass.createVecRight()
        wavenumbers, functions = [], []
        for number in range(count):
            inverse = solver.getEigenpair(number, vector).real
            wavenumbers.append(np.sqrt(max(1.0 / inverse - 1.0, 0.0)))
            functions.append(vector.array.copy() / np.sqrt(vector.dot(space.mass * vector)))
        return np.array(wavenumbers), np.array(functions).T

    def sampled(self, mode: Mode, x: FloatArray, y: FloatArray, *, second: bool) -> SampledSurface:
        """See `PlanProblem.sampled`; there is no second mode.

        Below the surface the lowest standing waves of the plan carry ψ; the rest decays like the highest of them.
        """
        del second
        space: PlanSpace = self.pencil.liquid.space
        points = np.column_stack([x, y])
        places, sign = self.symmetry_class.folded(points.T, self.model.mirrors)
        folded = places.T
        under = [
            np.array(
                [region.outside.contains(p) and not any(hole.contains(p) for hole in region.inside) for p in points]
            )
            for region in self.model.regions[1]
        ]
        elevation = np.zeros(len(x))
        if self.pencil.surfaces:
            height = np.zeros(space.size)
            height[water_unknowns(space)] = mode.values[self.pencil.body_size :]
            water = ~np.any(under, axis=0) if under else np.full(len(x), True)
            cells = space.liquid.tank.cells(FREE_SURFACE)
            elevation[water] = sign[water] * _evaluated(space, height[:, None], folded[water], cells)[:, 0]
        position = 0
        for plate, inside in zip(self.plates, under, strict=True):
            amplitudes = mode.body_amplitudes[position : position + plate.body.size]
            position += plate.body.size
            elevation[inside] = amplitudes @ plate.deflection(points[inside].T)
        wavenumbers, functions = self._standing_waves
        potential = mode.potential.array_r
        load = (space.mass * mode.potential).array
        parts = functions.T @ load
        rest = potential - functions @ parts
        every = np.arange(space.liquid.tank.cell_count, dtype=np.int32)
        # The waves there are the same for all modes, which are sampled at the same points one after the other.
        known = self._waves_at
        key = points.tobytes()
        if key not in known:
            known[key] = sign[:, None] * _evaluated(space, functions, folded, every)
        return SampledSurface(
            elevation=elevation,
            wavenumbers=np.append(wavenumbers, wavenumbers[-1]),
            potentials=np.column_stack(
                [known[key] * parts, sign[:, None] * _evaluated(space, rest[:, None], folded, every)]
            ),
        )


def _evaluated(space: PlanSpace, coefficients: FloatArray, points: FloatArray, cells: np.ndarray) -> FloatArray:
    """Functions of the space at points, in the nearest of some cells, shape (points, functions)."""
    mesh = space.liquid.tank.mesh
    places = np.column_stack([points, np.zeros(len(points))])
    # Boxes around curved cells reach a little beyond their nodes.
    tree = geometry.bb_tree(mesh, mesh.topology.dim, entities=cells, padding=1e-9)
    middles = geometry.create_midpoint_tree(mesh, mesh.topology.dim, cells)
    nearest = geometry.compute_closest_entity(tree, middles, mesh, places).astype(np.int32)
    around = geometry.compute_collisions_points(tree, places)
    owners = np.append(np.repeat(np.arange(len(places)), np.diff(around.offsets)), np.arange(len(places)))
    candidates = np.append(around.array, nearest).astype(np.int32)
    reference, distances = nearest_in_cells(mesh, candidates, points[owners])
    order = np.lexsort([distances, owners])
    chosen = order[np.append(True, np.diff(owners[order]) > 0)] if len(order) else order
    table = space.liquid.space.element.basix_element.tabulate(0, reference[chosen])[0, :, :, 0]
    dofs = space.liquid.space.dofmap.list[candidates[chosen]]
    at = sparse.csr_matrix(
        (table.ravel(), dofs.ravel(), np.arange(0, dofs.size + 1, dofs.shape[1])),
        shape=(len(points), space.liquid.size),
    )
    values: FloatArray = at @ space.expanded(coefficients)
    return values
