"""Matrices of volumes, whose cells are too many to keep a matrix of each."""

from __future__ import annotations

import ufl
from dolfinx import fem
from dolfinx.fem import petsc as fem_petsc
from petsc4py import PETSc

from hydroelastic.fem.cells import CURVED_QUADRATURE, is_straight
from hydroelastic.fem.interface_coupling import surface_blocks
from hydroelastic.fem.kernels import compiled_form
from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.fem.liquid_matrices import LiquidMatrices, surface_mass_matrix
from hydroelastic.fem.pencil import SurfaceBlocks
from hydroelastic.fem.surfaces import LiquidSurface


def volume_laplace(liquid: LiquidSpace, images: int = 1) -> PETSc.Mat:
    """Assemble ∫∇ψ·∇q times the number of parts that are alike, every unknown included (collective)."""
    space = liquid.space
    trial, test = ufl.TrialFunction(space), ufl.TestFunction(space)
    more = 0 if is_straight(space.mesh) else CURVED_QUADRATURE
    dx = ufl.Measure("dx", domain=space.mesh, metadata={"quadrature_degree": 2 * liquid.degree - 2 + more})
    form: fem.Form = compiled_form(ufl.inner(ufl.grad(trial), ufl.grad(test)) * dx)
    matrix = fem_petsc.assemble_matrix(form)
    matrix.assemble()
    matrix.scale(float(images))
    return matrix


def volume_matrices(liquid: LiquidSpace, surfaces: tuple[LiquidSurface, ...], images: int) -> LiquidMatrices:
    """Assemble what the problems of all symmetries share, with energies of all parts that are alike (collective)."""
    blocks = []
    for surface in surfaces:
        mass = surface_mass_matrix(liquid, (surface.surface,))
        mass.scale(float(images))
        coupling, stiffness = surface_blocks(liquid, surface, mass)
        blocks.append(SurfaceBlocks(coupling=coupling, stiffness=stiffness))
    return LiquidMatrices(laplace=volume_laplace(liquid, images), surfaces=blocks)
