"""Singular edges of a tank in gmsh: the curves towards which cells become small, and the edges of cells on them."""

from __future__ import annotations

import gmsh
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from hydroelastic.meshes.distribute import NodedMesh
from hydroelastic.meshes.geometry import BAFFLE
from hydroelastic.meshes.plan_loops import Mirrors
from hydroelastic.meshes.volume_solids import box_around
from hydroelastic.physics.dofs import body_number
from hydroelastic.physics.plate import Rectangle
from hydroelastic.physics.volume_tank import VolumeTank

# The vertical part of the normal of a wall that meets the still surface at right angles is less.
_UPRIGHT = 0.1
# By so much boxes around edges are larger than these.
_BOXES = 1e-6
# Cosine of the angle between two segments from which they meet in a corner: 45° from straight. Of circles segments are
# eighths at most.
_STRAIGHT = -0.7


def singular_edges(tank: VolumeTank, faces: dict[int, str], mirrors: Mirrors) -> set[int]:
    """Return the curves of gmsh's current model beside which ψ is singular.

    Edges of plates, corners of floats and columns, and tips of baffles; not those that planes of symmetry make, nor
    where walls of a float meet the still surface at right angles.
    """
    found: set[int] = set()
    beside: set[int] = set()
    tips: list[int] = []
    for tag, name in faces.items():
        edges = [edge for _, edge in gmsh.model.getBoundary([(2, tag)], oriented=False)]
        if name == BAFFLE:
            tips += edges
            continue
        beside |= {*edges, *(edge for dim, edge in gmsh.model.mesh.getEmbedded(2, tag) if dim == 1)}
        number = body_number(name)
        if number is None:
            continue
        for edge in edges:
            box = box_around((1, edge))
            level = number > len(tank.plates) and np.abs(box[:, 2]).max() < _BOXES and _is_upright(tag, edge)
            if not level and not any(
                mirror is not None and np.abs(box[:, axis] - mirror).max() < _BOXES
                for axis, mirror in enumerate(mirrors)
            ):
                found.add(edge)
    found |= {edge for edge in tips if tips.count(edge) == 1} - beside
    corners = [corner for outline in tank.columns if isinstance(outline, Rectangle) for corner in outline.corners]
    for edge in beside if corners else ():
        low, high = box_around((1, edge))
        if any(np.abs([*(low[:2] - corner), *(high[:2] - corner)]).max() < _BOXES for corner in corners):
            found.add(edge)
    return found


def singular_segments(mesh: NodedMesh, edges: set[int]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the edges of cells on curves of gmsh's current model, and the points in which these meet at an angle."""
    corners = np.unique(mesh.cells[:, :4])
    nearest = cKDTree(mesh.points[corners])
    found = [np.empty((0, 2), np.int64)]
    for edge in sorted(edges):
        # Of each edge of a cell the ends come first, then the nodes between them.
        tags, coordinates, _ = gmsh.model.mesh.getNodes(1, edge, includeBoundary=True)
        places = dict(zip(tags, coordinates.reshape(-1, 3), strict=True))
        kinds, _, nodes = gmsh.model.mesh.getElements(1, edge)
        # The pole of a sphere is a curve without any.
        for kind, own in zip(kinds, nodes, strict=True):
            ends = own.reshape(-1, gmsh.model.mesh.getElementProperties(kind)[3])[:, :2]
            found.append(corners[nearest.query([[places[end] for end in pair] for pair in ends])[1]])
    every = np.concatenate(found)
    ends, counts = np.unique(every, return_counts=True)
    angles = []
    for end in ends[counts > 1]:
        own = every[(every == end).any(axis=1)]
        along = mesh.points[own[own != end]] - mesh.points[end]
        along /= np.linalg.norm(along, axis=1)[:, None]
        if len(along) > 2 or along[0] @ along[1] > _STRAIGHT:
            angles.append(end)
    return every, np.array(angles, dtype=np.int64)


def _is_upright(face: int, edge: int) -> bool:
    """Whether a face meets the still surface at right angles, in the middle of an edge of it."""
    (start,), (end,) = gmsh.model.getParametrizationBounds(1, edge)
    place = gmsh.model.getValue(1, edge, [0.5 * (start + end)])
    normal = gmsh.model.getNormal(face, gmsh.model.getParametrization(2, face, place))
    return bool(abs(normal[2]) < _UPRIGHT)
