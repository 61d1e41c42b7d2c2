"""Meshes in and out of files (.msh, .vtu, .xdmf) through meshio, physical names included."""

from __future__ import annotations

import io
import json
import warnings
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import meshio
import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.formats import FORMATS
from hydroelastic.meshes.tagged_mesh import FARTHEST, MeshError, TaggedMesh

_TAG = "gmsh:physical"

# Twice the area of a triangle over the squares of its sides: less is rounding.
_FLAT = 1e-12


def save_mesh(mesh: TaggedMesh, path: Path) -> None:
    """Write a mesh with its groups; the format follows the file's suffix.

    A `.msh` file carries the physical names itself; beside `.vtu` and `.xdmf`, which have no place for them, a small
    ``<file>.names.json`` is written.
    """
    _check_suffix(path)
    if mesh.curved is not None:
        raise MeshError(
            f"mesh file {path} cannot be written: files hold straight triangles only, and this mesh has curved cells; "
            "make it with geometry degree 1"
        )
    points = np.column_stack([mesh.points, np.zeros(len(mesh.points))])
    content = meshio.Mesh(
        points,
        [("line", mesh.facets), ("triangle", mesh.cells)],
        cell_data={_TAG: [mesh.facet_tags.astype(np.int32), mesh.cell_tags.astype(np.int32)]},
        field_data={
            **{name: np.array([tag, 1]) for name, tag in mesh.facet_names.items()},
            **{name: np.array([tag, 2]) for name, tag in mesh.cell_names.items()},
        },
    )
    if path.suffix.lower() == ".msh":
        content.cell_data["gmsh:geometrical"] = content.cell_data[_TAG]
        meshio.write(path, content, file_format="gmsh22", binary=False)
        return
    options = {"data_format": "XML"} if path.suffix.lower() == ".xdmf" else {}
    meshio.write(path, content, **options)
    names = {"cells": mesh.cell_names, "facets": mesh.facet_names}
    _names_file(path).write_text(json.dumps(names, indent=1) + "\n", encoding="utf-8")


def load_mesh(path: Path) -> TaggedMesh:
    """Read a mesh of straight triangles with named groups, ours or the user's own."""
    _check_suffix(path)
    if not path.is_file():
        raise MeshError(f"mesh file {path} does not exist")
    content = _read(path)
    blocks = {"triangle": [], "line": []}  # type: dict[str, list[tuple[np.ndarray, np.ndarray]]]
    for block, tags in zip(content.cells, content.cell_data.get(_TAG, []), strict=False):
        if block.type in blocks:
            blocks[block.type].append((np.asarray(block.data), np.asarray(tags)))
        elif block.type != "vertex":
            raise MeshError(f"mesh file {path} holds elements of type {block.type}; only straight triangles are read")
    if not blocks["triangle"] or not blocks["line"]:
        raise MeshError(
            f"mesh file {path} holds no triangles or no boundary edges with physical groups ({_TAG}); "
            "give every boundary edge and every cell a physical group"
        )
    cell_names, facet_names = _names(path, content)
    cells = np.vstack([data for data, _ in blocks["triangle"]]).astype(np.int64)
    _check_geometry(path, np.asarray(content.points, dtype=np.float64), cells)
    used, renumbered = np.unique(cells, return_inverse=True)
    order = np.full(len(content.points), -1, dtype=np.int64)
    order[used] = np.arange(len(used))
    edges = np.vstack([data for data, _ in blocks["line"]]).astype(np.int64)
    facets = order[np.clip(edges, 0, len(order) - 1)]
    if np.any(facets < 0) or np.any(edges != np.clip(edges, 0, len(order) - 1)):
        raise MeshError(f"mesh file {path} has tagged edges that belong to no triangle")
    return TaggedMesh(
        points=np.asarray(content.points, dtype=np.float64)[used, :2],
        cells=renumbered.reshape(cells.shape),
        cell_tags=np.concatenate([tags for _, tags in blocks["triangle"]]).astype(np.int32),
        facets=facets,
        facet_tags=np.concatenate([tags for _, tags in blocks["line"]]).astype(np.int32),
        cell_names=cell_names,
        facet_names=facet_names,
    )


def _read(path: Path) -> meshio.Mesh:
    try:
        # meshio prints messages, and exits the process on some unreadable files.
        with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()), warnings.catch_warnings():
            # NumPy only warns of truncated numbers.
            warnings.filterwarnings("error", message="string or file could not be read")
            return meshio.read(path)
    except (Exception, SystemExit) as error:
        allowed = FORMATS[path.suffix.lower()]
        raise MeshError(f"mesh file {path} cannot be read: it is broken, or not {allowed}") from error


def _check_geometry(path: Path, points: NDArray[np.float64], cells: NDArray[np.int64]) -> None:
    if not (np.abs(points) < FARTHEST).all():
        raise MeshError(f"mesh file {path} holds a node whose coordinates are not finite, or beyond {FARTHEST:g} m")
    if cells.min() < 0 or cells.max() >= len(points):
        raise MeshError(f"mesh file {path} holds a triangle with a node that is not there")
    sides = points[cells[:, 1:], :2] - points[cells[:, :1], :2]
    doubled_areas = np.abs(sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0])
    flat = doubled_areas <= _FLAT * (sides**2).sum(axis=(1, 2))
    if flat.any():
        x, y = points[cells[np.argmax(flat)], :2].mean(axis=0)
        raise MeshError(f"mesh file {path} holds a triangle without area near ({x:g}, {y:g})")


def _names(path: Path, content: meshio.Mesh) -> tuple[dict[str, int], dict[str, int]]:
    if _names_file(path).is_file():
        try:
            names = json.loads(_names_file(path).read_text(encoding="utf-8"))
            return _tags(names["cells"]), _tags(names["facets"])
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise MeshError(
                f'{_names_file(path)} must hold {{"cells": {{name: tag}}, "facets": {{name: tag}}}} with whole tags'
            ) from error
    cells = {name: int(tag) for name, (tag, dim) in content.field_data.items() if dim == 2}
    facets = {name: int(tag) for name, (tag, dim) in content.field_data.items() if dim == 1}
    if not cells or not facets:
        raise MeshError(f"mesh file {path} has no physical names, and there is no {_names_file(path).name} beside it")
    return cells, facets


def _tags(names: dict[str, int]) -> dict[str, int]:
    if not all(isinstance(tag, int) for tag in names.values()):
        raise TypeError("tags are whole numbers")
    return dict(names)


def _names_file(path: Path) -> Path:
    return path.with_name(path.name + ".names.json")


def _check_suffix(path: Path) -> None:
    if path.suffix.lower() not in FORMATS:
        raise MeshError(f"mesh file {path} must end in one of {', '.join(FORMATS)}")
