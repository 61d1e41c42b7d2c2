"""ψ along the free surface of a section or of a half-plane of revolution."""

from __future__ import annotations

import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.facets import facet_groups
from hydroelastic.fem.liquid import LiquidSpace, as_functions
from hydroelastic.fem.shape_loads import potential_basis
from hydroelastic.meshes.geometry import FREE_SURFACE

# Points along each facet.
_ALONG = np.linspace(0.0, 1.0, 9)[:, None]
_ROUNDING = 1e-9


def along_the_surface(
    liquid: LiquidSpace, potentials: list[PETSc.Vec], farthest: float = np.inf
) -> tuple[np.ndarray, np.ndarray]:
    """Return x, ascending, shape (points,), and ψ, shape (potentials, points), on every process (collective)."""
    functions = as_functions(liquid, potentials)
    places, found = [np.zeros(0)], [np.zeros((len(functions), 0))]
    for group in facet_groups(liquid, FREE_SURFACE):
        reference = group.reference_points(_ALONG)
        x = group.physical_points(reference)[..., 0]
        inside = x.max(axis=1) <= farthest + _ROUNDING
        dofs, basis = liquid.space.dofmap.list[group.cells[inside]], potential_basis(liquid, reference)
        places.append(x[inside].ravel())
        found.append(np.array([(function.x.array[dofs] @ basis.T).ravel() for function in functions]))
    gathered = liquid.tank.mesh.comm.allgather((np.concatenate(places), np.concatenate(found, axis=1)))
    x = np.concatenate([one for one, _ in gathered])
    values = np.concatenate([other for _, other in gathered], axis=1)
    order = np.argsort(x, kind="stable")
    return x[order], values[:, order]
