"""The coupled problem of liquids in a volume: bodies and moving surfaces on a space of polynomials."""

from __future__ import annotations

from petsc4py import PETSc

from hydroelastic.fem.interface_coupling import surface_blocks
from hydroelastic.fem.liquid import (
    LiquidSolver,
    LiquidSpace,
    closed_layer,
    closed_layers,
    constrained_dofs,
)
from hydroelastic.fem.liquid_matrices import LiquidMatrices
from hydroelastic.fem.pencil import CoupledPencil, SurfaceBlocks, coupled_pencil, loads_on_first
from hydroelastic.fem.shape_loads import shape_loads, surface_load
from hydroelastic.fem.surfaces import Body, LiquidSurface


def build_pencil(
    liquid: LiquidSpace,
    matrices: LiquidMatrices,
    *,
    bodies: tuple[Body, ...],
    surfaces: tuple[LiquidSurface, ...],
) -> CoupledPencil[LiquidSpace]:
    """Assemble the coupled problem.

    Args:
        liquid: space of the potential.
        matrices: A and S on that space.
        bodies: the floating bodies.
        surfaces: those of the liquids that move under gravity: free surface and interface.

    Returns:
        The matrices, with the liquid factorized (collective).
    """
    laplace = matrices.laplace
    blocks = []
    for surface in surfaces:
        assert matrices.surface_mass is not None
        coupling, stiffness = surface_blocks(liquid, surface, matrices.surface_mass)
        blocks.append(SurfaceBlocks(coupling=coupling, stiffness=stiffness))
    names = tuple(dict.fromkeys([*(body.surface for body in bodies), *(surface.surface for surface in surfaces)]))
    layers = closed_layers(liquid)
    load = surface_load(liquid, names) if layers else None
    closed = () if load is None else tuple(closed_layer(liquid, layer, load) for layer in layers)
    return coupled_pencil(
        liquid,
        bodies=bodies,
        surfaces=surfaces,
        body_coupling=_body_coupling(liquid, bodies, laplace) if bodies else None,
        surface_blocks=blocks,
        laplace=laplace,
        # A layer without moving surfaces has no flux to balance.
        solver=LiquidSolver(laplace, constrained_dofs(liquid), tuple(layer for layer in closed if layer.measure > 0.0)),
        closed=layers,
    )


def _body_coupling(liquid: LiquidSpace, bodies: tuple[Body, ...], laplace: PETSc.Mat) -> PETSc.Mat:
    """Columns ∫φᵢ q over each body's wetted surface."""
    loads = (load for body in bodies for load in shape_loads(liquid, body))
    return loads_on_first(loads, sum(body.size for body in bodies), laplace)
