"""The coupled problem of liquids in a volume: bodies and moving surfaces on a space of polynomials."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.liquid import (
    LiquidSolver,
    LiquidSpace,
    closed_layer,
    closed_layers,
    constrained_dofs,
)
from hydroelastic.fem.liquid_answer import LiquidAnswer, liquid_answer
from hydroelastic.fem.liquid_matrices import LiquidMatrices
from hydroelastic.fem.pencil import CoupledPencil, coupled_pencil
from hydroelastic.fem.surfaces import Body, LiquidSurface

# Measured on one process: up to so many surface unknowns the answers to all of them at once, and dense linear algebra
# after it, take less time than the answers that the Krylov–Schur method asks for one by one and a sparse count.
_FEW = 300


def build_pencil(
    liquid: LiquidSpace,
    matrices: LiquidMatrices,
    *,
    bodies: tuple[Body, ...],
    of_bodies: list[np.ndarray],
    surfaces: tuple[LiquidSurface, ...],
) -> CoupledPencil[LiquidSpace]:
    """Assemble the coupled problem."""
    laplace = matrices.laplace
    layers = closed_layers(liquid)
    fluxes = {body.surface: loads[-1] for body, loads in zip(bodies, of_bodies, strict=True)}
    load = surface_fluxes(liquid, matrices, surfaces, tuple(fluxes.values())) if layers else None
    closed = () if load is None else tuple(closed_layer(liquid, layer, load) for layer in layers)
    pencil = coupled_pencil(
        liquid,
        bodies=bodies,
        surfaces=surfaces,
        body_coupling=_body_coupling(of_bodies, laplace) if bodies else None,
        surface_blocks=matrices.surfaces,
        laplace=laplace,
        # A layer without moving surfaces has no flux to balance.
        solver=LiquidSolver(laplace, constrained_dofs(liquid), tuple(layer for layer in closed if layer.measure > 0.0)),
        closed=layers,
    )
    return replace(pencil, answer=answered(pencil, _FEW))


def surface_fluxes(
    liquid: LiquidSpace,
    matrices: LiquidMatrices,
    surfaces: tuple[LiquidSurface, ...],
    of_bodies: tuple[np.ndarray, ...],
) -> np.ndarray:
    """∫q over all moving surfaces, owned entries, from those over the surfaces of bodies (collective)."""
    load = sum(of_bodies, np.zeros(len(liquid.numbering.owned_dofs)))
    for surface, blocks in zip(surfaces, matrices.surfaces, strict=True):
        # A constant elevation; upwards is into the layer above.
        elevation, flux = blocks.coupling.createVecs()
        elevation.set(1.0)
        blocks.coupling.mult(elevation, flux)
        load += np.where(liquid.owned_layer_of == surface.above, -1.0, 1.0) * flux.array_r
    return load


def answered(pencil: CoupledPencil[LiquidSpace], most: int) -> LiquidAnswer | None:
    """Return the answer of the liquid to all surface unknowns: n solutions of Laplace's equation at once, after which a
    product with a matrix takes the place of each; ``None`` on several processes, or with more unknowns than that."""
    if pencil.coupling.comm.size > 1 or not 0 < pencil.size <= most:
        return None
    assert isinstance(pencil.solver, LiquidSolver)
    potentials = pencil.solver.solve_all(pencil.coupling)
    # Few unknowns of ψ are on the moving surfaces.
    starts, columns, values = pencil.momentum.getValuesCSR()
    moving = np.flatnonzero(np.diff(starts))
    loads = np.zeros((len(moving), pencil.size))
    loads[np.repeat(np.arange(len(moving)), np.diff(starts)[moving]), columns] = values
    return liquid_answer(potentials, loads.T @ potentials[moving], pencil.dense_restoring)


def _body_coupling(of_bodies: list[np.ndarray], laplace: PETSc.Mat) -> PETSc.Mat:
    """Columns ∫φᵢ q over each body's wetted surface, from `loads_with_fluxes`; they lie on rank 0."""
    loads = np.concatenate([rows[:-1] for rows in of_bodies])
    count, own = loads.shape
    # Few unknowns are at the bodies, and see all of their shapes.
    wetted = loads.any(axis=0)
    starts = np.append(0, np.cumsum(count * wetted)).astype(PETSc.IntType)
    columns = np.tile(np.arange(count, dtype=PETSc.IntType), np.count_nonzero(wetted))
    sizes = ((own, PETSc.DETERMINE), (count if laplace.comm.rank == 0 else 0, count))
    return PETSc.Mat().createAIJ(sizes, csr=(starts, columns, loads[:, wetted].T.ravel()), comm=laplace.comm)
