"""Coupling of ψ to the elevations η of free surfaces and interfaces.

η is in the space of the boundary values of ψ, so that K η = λ Σρψ is solved exactly on the surface. The meshes above
and below an interface have the same facets, and the unknowns below serve for both sides: upwards is out of the lower
liquid and
into the upper one,

    C η = S η below,    C η = −S η at the twin unknowns above.
"""

from __future__ import annotations

import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.facets import facet_groups
from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.fem.surfaces import LiquidSurface
from hydroelastic.meshes.tagged_mesh import MeshError

# Shift of unknowns towards the middle of their facets, by which those at one point are distinguished; less than half.
_DRAWN = 0.25


def surface_blocks(liquid: LiquidSpace, surface: LiquidSurface, surface_mass: PETSc.Mat) -> tuple[PETSc.Mat, PETSc.Mat]:
    """Coupling and stiffness of one surface."""
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
            from_above.matMult(_pairs(liquid, surface.surface, above, below)),
            structure=PETSc.Mat.Structure.DIFFERENT_NONZERO_PATTERN,
        )
        jump -= liquid.layers[surface.above].density
    stiffness.scale(jump * surface.gravity)
    return coupling, stiffness


def _global_dofs(liquid: LiquidSpace, name: str, layer: int, matrix: PETSc.Mat) -> PETSc.IS:
    dofs = liquid.surface_dofs((name,), layer) + matrix.getOwnershipRange()[0]
    return PETSc.IS().createGeneral(dofs.astype(PETSc.IntType), comm=matrix.comm)


def _pairs(liquid: LiquidSpace, name: str, above: PETSc.IS, below: PETSc.IS) -> PETSc.Mat:
    """Matrix from the unknowns below an interface to those at the same places above.

    A place may be on one process below and on another above: every process sees the places below, which are those of a
    surface only.
    """
    from scipy.spatial import cKDTree  # slow to import, so only where there is an interface

    comm = liquid.tank.mesh.comm
    places = _places(liquid, name)
    first = liquid.numbering.first
    own_above, own_below = (places[indices.getIndices() - first] for indices in (above, below))
    places_below = np.vstack(comm.allgather(own_below))
    twins = cKDTree(places_below).query(own_above)[1] if len(own_above) and len(places_below) else np.empty(0, int)
    paired = np.unique(np.concatenate(comm.allgather(twins)))
    if not len(places_below) == len(paired) == above.getSize():
        raise MeshError("the meshes above and below the interface do not have the same edges on it")
    matrix = PETSc.Mat().createAIJ(
        ((len(own_above), PETSc.DETERMINE), (len(own_below), PETSc.DETERMINE)), nnz=1, comm=above.comm
    )
    start = matrix.getOwnershipRange()[0]
    for row, twin in enumerate(twins):
        matrix.setValue(start + row, int(twin), 1.0)
    matrix.assemble()
    return matrix


def _places(liquid: LiquidSpace, name: str) -> np.ndarray:
    """Positions of the owned unknowns of a surface, shifted slightly towards the middle of their facets.

    At a slit that crosses the interface there are two unknowns at one point, and only their facets distinguish them.
    Shape (owned unknowns, gdim).
    """
    mesh = liquid.tank.mesh
    sums = np.zeros((1 + mesh.geometry.dim, len(liquid.layer_of)))
    for group in facet_groups(liquid, name):
        middles = group.physical_points(group.reference_corners).mean(axis=1)
        dofs = liquid.space.dofmap.list[group.cells][:, liquid.facet_dofs(group.place)]
        for row, values in enumerate([np.ones(len(middles)), *middles.T]):
            np.add.at(sums[row], dofs, values[:, None])
    count, *middle = liquid.numbering.summed(sums)
    points = liquid.unknown_positions()
    drawn: np.ndarray = points + _DRAWN * (np.array(middle).T / np.maximum(count, 1.0)[:, None] - points)
    return drawn


def density_jump(liquid: LiquidSpace, surface: LiquidSurface, surface_mass: PETSc.Mat) -> PETSc.Mat:
    """∫[ρψ][ρq]/([ρ] g) over one surface, [ρψ] = ρψ below less ρψ above; on all unknowns of ψ (collective)."""
    density = liquid.layers[surface.below].density
    below = _global_dofs(liquid, surface.surface, surface.below, surface_mass)
    jump = _selection(below, surface_mass)
    jump.scale(density)
    difference = density
    if surface.above is not None:
        above_density = liquid.layers[surface.above].density
        above = _global_dofs(liquid, surface.surface, surface.above, surface_mass)
        from_above = _pairs(liquid, surface.surface, above, below).transposeMatMult(_selection(above, surface_mass))
        jump.axpy(-above_density, from_above, structure=PETSc.Mat.Structure.DIFFERENT_NONZERO_PATTERN)
        difference -= above_density
    product = surface_mass.createSubMatrix(below, below).ptap(jump)
    product.scale(1.0 / (difference * surface.gravity))
    return product


def _selection(rows: PETSc.IS, matrix: PETSc.Mat) -> PETSc.Mat:
    local = rows.getLocalSize()
    selection = PETSc.Mat().createAIJ(((local, PETSc.DETERMINE), matrix.getSizes()[1]), nnz=1, comm=rows.comm)
    start = selection.getOwnershipRange()[0]
    for row, column in enumerate(rows.getIndices()):
        selection.setValue(start + row, int(column), 1.0)
    selection.assemble()
    return selection
