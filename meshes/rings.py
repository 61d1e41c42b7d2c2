"""Structured rings of triangles around corners: radii in geometric progression, sectors of at most 60 degrees.

ψ is singular at corners of the liquid: r ln r at the end of a floating beam, r^{1/2} where ψ = 0 on the water, r^{π/ω}
at a corner of angle ω of a rigid body. Rings whose radii shrink by a constant ratio towards the corner, with a high
polynomial degree, give exponential convergence in spite of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, log, pi

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.tagged_mesh import MeshError

# A half disc is cut into three sectors of 60 degrees: the innermost triangles are equilateral.
_WIDEST_SECTOR = pi / 3.0
# Narrower wedges between two curves are refused: their triangles would degenerate.
_NARROWEST_WEDGE = pi / 180.0


def ring_radii(inner: float, outer: float, ratio: float) -> NDArray[np.float64]:
    """Radii of the rings from the innermost, at most ``inner`` unless it is the only one, to the outermost."""
    count = max(1, 1 + ceil(log(max(outer / inner, 1.0)) / -log(ratio)))
    radii: NDArray[np.float64] = outer * ratio ** np.arange(count - 1, -1, -1.0)
    return radii


def ring_triangles(rings: int, rays: int) -> NDArray[np.int64]:
    """Triangles of a wedge, shape (triangles, 3): a fan about the corner, then ring after ring.

    Nodes are numbered with the corner first, then ring after ring from the inside, each from the first to the last ray.
    """
    # Of each ring and sector, the node that both of its triangles share on the inside.
    nodes = (1 + rays * np.arange(rings - 1))[:, None] + np.arange(rays - 1)
    corners = np.array([[0, rays, rays + 1], [0, rays + 1, 1]])
    triangles = nodes[:, None, :, None] + corners[:, None]
    ray = np.arange(rays - 1)
    return np.vstack([np.column_stack([np.zeros_like(ray), 1 + ray, 2 + ray]), triangles.reshape(-1, 3)])


@dataclass(frozen=True, kw_only=True)
class RingEnds:
    """Where the rings of one corner meet one curve."""

    parameters: NDArray[np.float64]  # of the curve, from the innermost ring to the outermost, shape (rings,)
    points: NDArray[np.float64]  # nodes, shape (rings, 2)
    angles: NDArray[np.float64]  # directions from the corner to the nodes, shape (rings,)


def wedge_nodes(
    corner: NDArray[np.float64], radii: NDArray[np.float64], incoming: RingEnds, outgoing: RingEnds
) -> NDArray[np.float64]:
    """Nodes of the rings in one region, shape (rings, rays, 2)."""
    # In (0, 2π]: at the tip of a slit the liquid has the full angle.
    openings = 2.0 * pi - np.mod(outgoing.angles - incoming.angles, 2.0 * pi)
    if openings.min() < _NARROWEST_WEDGE or np.ptp(openings) > pi:
        raise MeshError("at a corner two curves bound a wedge of less than a degree")
    sectors = ceil(float(openings.max()) / _WIDEST_SECTOR - 1e-6)
    parts = np.linspace(0.0, openings, sectors + 1, axis=1)
    directions = incoming.angles[:, None] - parts
    nodes = corner + radii[:, None, None] * np.stack([np.cos(directions), np.sin(directions)], axis=2)
    nodes[:, 0], nodes[:, -1] = incoming.points, outgoing.points
    return nodes
