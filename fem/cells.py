"""Where the cells of this process lie: straight simplices by their corners and edge vectors."""

from __future__ import annotations

import numpy as np

from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.meshes.compat import geometry_dofmap


def cell_corners(liquid: LiquidSpace) -> np.ndarray:
    """Corners of the owned cells, shape (cells, corners, gdim)."""
    mesh = liquid.tank.mesh
    owned = mesh.topology.index_map(mesh.topology.dim).size_local
    corners: np.ndarray = mesh.geometry.x[geometry_dofmap(mesh)[:owned]][:, :, : mesh.geometry.dim]
    return corners


def cell_jacobians(corners: np.ndarray) -> np.ndarray:
    """Edge vectors from each cell's first corner to the others as columns, shape (cells, gdim, dim)."""
    edges: np.ndarray = np.swapaxes(corners[:, 1:] - corners[:, :1], 1, 2)
    return edges
