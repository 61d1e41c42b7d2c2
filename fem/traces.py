"""Unknowns of the moving surfaces of liquids: the traces of ψ, and on an interface those of one of its two sides.

η is in the space of the traces, so that K η = λ Σρψ is solved exactly on the surface. The meshes above and below an
interface have the same facets, and the trace from below serves for both sides: upwards is out of the lower liquid and
into the upper one,

    C η = S η below,    C η = −S η at the twin unknowns above.
"""

from __future__ import annotations

import numpy as np
from petsc4py import PETSc
from scipy.spatial import cKDTree

from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.fem.surfaces import LiquidSurface
from hydroelastic.meshes.tagged_mesh import MeshError

# Twins have the same coordinates but for rounding of the cells' maps.
_ROUNDING = 1e-9


def surface_blocks(
    liquid: LiquidSpace, surface: LiquidSurface, surface_mass: PETSc.Mat
) -> tuple[PETSc.Mat, PETSc.Mat]:
    """Coupling and stiffness of one surface.

    Args:
        liquid: the space of ψ.
        surface: the surface.
        surface_mass: S = ∫ψ q over it, and maybe others, on all unknowns of ψ.

    Returns:
        C, unknowns of ψ × unknowns of η, and K = (ρ_below − ρ_above) g ∫ηη (collective).
    """
    below = _global_dofs(liquid, surface.surface, surface.below, surface_mass)
    everything = PETSc.IS().createStride(
        surface_mass.getLocalSize()[0], first=surface_mass.getOwnershipRange()[0], step=1, comm=surface_mass.comm
    )
    coupling = surface_mass.createSubMatrix(everything, below)
    stiffness = surface_mass.createSubMatrix(below, below)
    jump = liquid.layers[surface.below].density
    if surface.above is not None:
        above = _global_dofs(liquid, surface.surface, surface.above, surface_mass)
        from_above = surface_mass.createSubMatrix(everything, above)
        coupling.axpy(
            -1.0,
            from_above.matMult(_twins(liquid, above, below)),
            structure=PETSc.Mat.Structure.DIFFERENT_NONZERO_PATTERN,
        )
        jump -= liquid.layers[surface.above].density
    stiffness.scale(jump * surface.gravity)
    return coupling, stiffness


def _global_dofs(liquid: LiquidSpace, name: str, layer: int, matrix: PETSc.Mat) -> PETSc.IS:
    dofs = liquid.surface_dofs((name,), layer) + matrix.getOwnershipRange()[0]
    return PETSc.IS().createGeneral(dofs.astype(PETSc.IntType), comm=matrix.comm)


def _twins(liquid: LiquidSpace, above: PETSc.IS, below: PETSc.IS) -> PETSc.Mat:
    """Matrix from the unknowns below an interface to those at the same places above.

    A place may be on one process below and on another above: every process sees the coordinates below, which are those
    of a surface only.
    """
    comm = liquid.tank.mesh.comm
    coordinates = liquid.space.tabulate_dof_coordinates()
    first = liquid.space.dofmap.index_map.local_range[0]
    own_above, own_below = (coordinates[indices.getIndices() - first] for indices in (above, below))
    places_below = np.vstack(comm.allgather(own_below))
    distances, twins = cKDTree(places_below).query(own_above) if len(own_above) else (np.empty(0), np.empty(0, int))
    problem = len(places_below) != above.getSize() or bool(np.any(distances > _ROUNDING))
    if comm.allreduce(int(problem)):
        raise MeshError("the meshes above and below the interface do not have the same edges on it")
    matrix = PETSc.Mat().createAIJ(
        ((len(own_above), PETSc.DETERMINE), (len(own_below), PETSc.DETERMINE)), nnz=1, comm=above.comm
    )
    start = matrix.getOwnershipRange()[0]
    for row, twin in enumerate(twins):
        matrix.setValue(start + row, int(twin), 1.0)
    matrix.assemble()
    return matrix
