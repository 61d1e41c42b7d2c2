"""The coupled problem of a tank on a mesh of its volume: A = ∫∇ψ·∇q, plates in their shapes, waves on the water."""

from __future__ import annotations

from collections.abc import Callable
from itertools import chain

from petsc4py import PETSc

from hydroelastic.fem.liquid import (
    ClosedLayer,
    LiquidSpace,
    closed_layer,
    closed_layers,
)
from hydroelastic.fem.liquid_matrices import LiquidMatrices
from hydroelastic.fem.liquid_operator import LiquidOperator
from hydroelastic.fem.pencil import CoupledPencil, coupled_pencil, loads_on_first
from hydroelastic.fem.plan.plan_pencil import PlanPlate
from hydroelastic.fem.shape_loads import shape_loads, surface_load
from hydroelastic.fem.surfaces import Body, LiquidSurface
from hydroelastic.fem.volume.loads import plate_loads
from hydroelastic.meshes.geometry import FREE_SURFACE, INTERFACE
from hydroelastic.meshes.tagged_mesh import MisplacedError

SolverOf = Callable[[LiquidSpace, PETSc.Mat, tuple[ClosedLayer, ...], int], LiquidOperator]
"""Makes A⁺ from the space, A, the layers of constant volume, and the number of parts that are alike."""


def moving_surfaces(liquid: LiquidSpace, *, waves: bool) -> tuple[LiquidSurface, ...]:
    """Return the surfaces that move under gravity: water beside the bodies, of each part of the liquid, and the
    interface of two liquids (collective)."""
    names = liquid.tank.facet_names
    found = []
    layers = [layer.name for layer in liquid.layers]
    for name in names:
        if name.startswith(INTERFACE):
            # Its name tells the parts on both sides, if there are more than two.
            below, above = (layers.index(part) for part in name.split(":")[1:]) if ":" in name else (0, 1)
            found.append(LiquidSurface(surface=name, gravity=1.0, below=below, above=above))
    if waves and FREE_SURFACE in names:
        for layer in range(len(liquid.layers)):
            if liquid.tank.mesh.comm.allreduce(len(liquid.surface_dofs((FREE_SURFACE,), layer))):
                found.append(LiquidSurface(surface=FREE_SURFACE, gravity=1.0, below=layer))
    return tuple(found)


def volume_pencil(
    liquid: LiquidSpace,
    matrices: LiquidMatrices,
    plates: tuple[PlanPlate, ...],
    floats: tuple[Body, ...],
    solver_of: SolverOf,
    *,
    surfaces: tuple[LiquidSurface, ...],
    images: int = 1,
) -> CoupledPencil[LiquidSpace] | None:
    """Assemble the coupled problem of one symmetry; ``None`` where nothing moves (collective)."""
    moving = [plate for plate in plates if plate.body.size]
    rigid = [body for body in floats if body.size]
    bodies = (*(plate.body for plate in moving), *rigid)
    if not bodies and not surfaces:
        return None
    layers = closed_layers(liquid)
    names = tuple(dict.fromkeys((*(body.surface for body in bodies), *(surface.surface for surface in surfaces))))
    load = surface_load(liquid, names) if layers else None
    closed = () if load is None else tuple(closed_layer(liquid, layer, load) for layer in layers)
    if any(layer.measure <= 0.0 for layer in closed):
        raise MisplacedError("baffles close in a part of the liquid in which nothing moves")
    of_plates = (load for plate in moving for load in plate_loads(liquid, plate))
    of_floats = (load for body in rigid for load in shape_loads(liquid, body))
    loads = (images * load for load in chain(of_plates, of_floats))
    count = sum(body.size for body in bodies)
    return coupled_pencil(
        liquid,
        bodies=bodies,
        surfaces=surfaces,
        body_coupling=loads_on_first(loads, count, matrices.laplace) if bodies else None,
        surface_blocks=matrices.surfaces,
        laplace=matrices.laplace,
        solver=solver_of(liquid, matrices.laplace, closed, images),
        closed=layers,
    )
