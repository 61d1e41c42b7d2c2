"""Meshes as a user brings them: written node by node, so that they can have any fault."""

from collections.abc import Callable, Sequence
from itertools import pairwise, permutations
from pathlib import Path

import numpy as np

BOX_SCENE = """
kind = "tank"
[tank]
shape = "{file}"
[[liquid]]
density = 1000.0
{depth}
[accuracy]
tolerance = 1e-2
modes = 2
"""

_LINE, _TRIANGLE, _TETRAHEDRON = 1, 2, 4


def write_msh(
    file: Path,
    points: np.ndarray,
    elements: Sequence[tuple[int, int, Sequence[int]]],
    names: dict[str, tuple[int, int]],
) -> Path:
    """Write a mesh of gmsh, format 2.2.

    Args:
        file: it.
        points: shape (nodes, 3).
        elements: gmsh's type, physical tag and nodes of each, counted from 0.
        names: dimension and tag of each physical group.
    """
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names))]
    lines += [f'{dim} {tag} "{name}"' for name, (dim, tag) in names.items()]
    lines += ["$EndPhysicalNames", "$Nodes", str(len(points))]
    lines += [f"{number} {x!r} {y!r} {z!r}" for number, (x, y, z) in enumerate(points.tolist(), 1)]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    for number, (kind, tag, nodes) in enumerate(elements, 1):
        # gmsh's own number of the curve, face or volume is the second tag.
        lines.append(" ".join(map(str, (number, kind, 2, tag, tag, *(node + 1 for node in nodes)))))
    file.write_text("\n".join([*lines, "$EndElements", ""]), encoding="ascii")
    return file


def box_mesh(
    file: Path,
    size: tuple[float, float, float] = (4.0, 1.0, 2.0),
    counts: tuple[int, int, int] = (4, 1, 2),
    *,
    split: Callable[[np.ndarray], bool] | None = None,
    at: float = 2.0,
    baffle: Callable[[np.ndarray], bool] | None = None,
    scale: float = 1.0,
) -> Path:
    """Write a box of tetrahedra, 0 < x < length, 0 < y < width, −depth < z < 0.

    Args:
        file: it.
        size: of the box.
        counts: bricks along each axis, of six tetrahedra each.
        split: which nodes in the plane x = ``at``, by their places, are doubled.
        at: that x.
        baffle: faces in that plane whose nodes are all of these are named ``baffle``.
        scale: factor of all coordinates.
    """
    x, y, z = (np.linspace(0.0, side, count + 1) for side, count in zip(size, counts, strict=True))
    places = np.stack(np.meshgrid(x, y, z - size[2], indexing="ij"), axis=-1)
    points, number = places.reshape(-1, 3).copy(), np.arange(places[..., 0].size).reshape(places.shape[:3])
    doubled = [node for node, place in enumerate(points) if split and place[0] == at and split(place)]
    copies = {node: len(points) + index for index, node in enumerate(doubled)}
    points = np.concatenate([points, points[doubled]])
    elements: list[tuple[int, int, Sequence[int]]] = []
    for corner in np.ndindex(*counts):
        for way in permutations(range(3)):
            steps = [np.array(corner)]
            for axis in way:
                steps.append(steps[-1] + np.eye(3, dtype=int)[axis])
            nodes = [int(number[tuple(step)]) for step in steps]
            if x[corner[0]] >= at:
                nodes = [copies.get(node, node) for node in nodes]
            elements.append((_TETRAHEDRON, 2, nodes))
            for leave in range(4):
                face = [node for place, node in enumerate(nodes) if place != leave]
                if (points[face, 2] == 0.0).all():
                    elements.append((_TRIANGLE, 1, face))
                in_plane = (points[face, 0] == at).all() and x[corner[0]] < at
                if baffle and in_plane and all(baffle(points[node]) for node in face):
                    elements.append((_TRIANGLE, 3, face))
    names = {"free_surface": (2, 1), "liquid": (3, 2)} | ({"baffle": (2, 3)} if baffle else {})
    return write_msh(file, scale * points, elements, names)


def section_mesh(
    file: Path,
    size: tuple[float, float] = (4.0, 2.0),
    counts: tuple[int, int] = (8, 4),
    *,
    split: Callable[[np.ndarray], bool] | None = None,
    at: float = 2.0,
    baffle: Callable[[np.ndarray], bool] | None = None,
) -> Path:
    """Write a rectangle of triangles, 0 < x < length, −depth < y < 0, as `box_mesh`.

    Args:
        file: it.
        size: of the rectangle.
        counts: of halved bricks.
        split: which nodes at x = ``at`` are doubled.
        at: that x.
        baffle: edges at that x whose nodes are all of these are named ``baffle``.
    """
    x, y = (np.linspace(0.0, side, count + 1) for side, count in zip(size, counts, strict=True))
    places = np.stack(np.meshgrid(x, y - size[1], indexing="ij"), axis=-1)
    points, number = places.reshape(-1, 2), np.arange(places[..., 0].size).reshape(places.shape[:2])
    doubled = [node for node, place in enumerate(points) if split and place[0] == at and split(place)]
    copies = {node: len(points) + index for index, node in enumerate(doubled)}
    elements: list[tuple[int, int, Sequence[int]]] = [(_LINE, 1, pair) for pair in pairwise(number[:, -1].tolist())]
    if baffle:
        line = number[int(np.flatnonzero(x == at)[0])].tolist()
        elements += [(_LINE, 3, pair) for pair in pairwise(line) if all(baffle(points[node]) for node in pair)]
    points = np.concatenate([points, points[doubled]])
    for i, j in np.ndindex(*counts):
        for nodes in ([(i, j), (i + 1, j), (i + 1, j + 1)], [(i, j), (i + 1, j + 1), (i, j + 1)]):
            cell = [int(number[node]) for node in nodes]
            elements.append((_TRIANGLE, 2, [copies.get(node, node) if x[i] >= at else node for node in cell]))
    for place in np.flatnonzero(x == at).tolist() if split and split(points[number.max()]) else ():
        # The top to the right of the plane begins at the doubled node there.
        top = copies[int(number[place, -1])]
        elements[place] = (_LINE, 1, (top, int(number[place + 1, -1])))
    names = {"free_surface": (1, 1), "liquid": (2, 2)} | ({"baffle": (1, 3)} if baffle else {})
    return write_msh(file, np.column_stack([points, np.zeros(len(points))]), elements, names)
