"""Matrices of the liquid on all unknowns of one space."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import basix
import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.cells import CURVED_QUADRATURE, is_straight, owned_cells
from hydroelastic.fem.facets import facet_groups
from hydroelastic.fem.interface_coupling import surface_blocks
from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.fem.pencil import SurfaceBlocks
from hydroelastic.fem.surfaces import LiquidSurface


@dataclass(frozen=True, kw_only=True)
class LiquidMatrices:
    """Matrices on all unknowns of one space, the same on whichever surface ψ = 0.

    Attributes:
        laplace: A = ∫∇ψ·∇q.
        surfaces: the blocks of each moving surface of the liquids.
    """

    laplace: PETSc.Mat
    surfaces: list[SurfaceBlocks]


def liquid_matrices(liquid: LiquidSpace, surfaces: tuple[LiquidSurface, ...]) -> LiquidMatrices:
    """Assemble what the problems on one space share (collective)."""
    blocks = []
    mass = surface_mass_matrix(liquid, tuple(one.surface for one in surfaces)) if surfaces else None
    for surface in surfaces:
        coupling, stiffness = surface_blocks(liquid, surface, mass)
        blocks.append(SurfaceBlocks(coupling=coupling, stiffness=stiffness))
    return LiquidMatrices(laplace=laplace_matrix(liquid), surfaces=blocks)


def laplace_matrix(liquid: LiquidSpace) -> PETSc.Mat:
    """Assemble A = ∫∇ψ·∇q, or ∫(1/ρ)∇ψ·∇q of a continuous pressure, every unknown included (collective)."""
    cells, numbering = liquid.cells.laplace, liquid.numbering
    if liquid.continuous_pressure:
        cells = cells * liquid.cell_densities()[:, None, None]
    dofs = liquid.space.dofmap.list[: len(owned_cells(liquid.tank.mesh)), numbering.outside]
    return numbering.assembled([(dofs, cells)])


def surface_mass_matrix(
    liquid: LiquidSpace, names: tuple[str, ...], weight: Callable[[np.ndarray, np.ndarray], np.ndarray] | None = None
) -> PETSc.Mat:
    """Assemble S = ∫ψ q w over named surfaces, every unknown included (collective)."""
    more = 0 if is_straight(liquid.tank.mesh) else CURVED_QUADRATURE
    blocks = []
    for group in (group for name in names for group in facet_groups(liquid, name)):
        local, weights = basix.make_quadrature(group.facet_type, 2 * liquid.degree + more)
        reference = group.reference_points(local)
        _, measures = group.normals(reference)
        places = liquid.facet_dofs(group.place)
        basis = liquid.space.element.basix_element.tabulate(0, reference)[0][:, places, 0]
        abscissas = group.physical_points(reference)[..., 0]
        varying = liquid.geometry.weight(abscissas) if weight is None else weight(group.cells, abscissas)
        weighed = (measures * weights * varying)[:, :, None] * basis
        blocks.append((liquid.space.dofmap.list[group.cells][:, places], basis.T @ weighed))
    return liquid.numbering.assembled(blocks)
