"""How well shaped the triangles of a mesh are."""

from __future__ import annotations

import numpy as np

from hydroelastic.meshes.tagged_mesh import TaggedMesh


def smallest_angle(mesh: TaggedMesh) -> float:
    """In degrees."""
    corners = mesh.points[mesh.cells]
    smallest = 180.0
    for corner in range(3):
        one, other = (corners[:, (corner + step) % 3] - corners[:, corner] for step in (1, 2))
        cosine = (one * other).sum(axis=1) / np.linalg.norm(one, axis=1) / np.linalg.norm(other, axis=1)
        smallest = min(smallest, float(np.degrees(np.arccos(cosine.max()))))
    return smallest
