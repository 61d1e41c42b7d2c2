"""Files of fields for ParaView: VTU with the units of its arrays, and PVD collections of such files."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

Cells: TypeAlias = Sequence[tuple[str, np.ndarray[Any, Any]]]
"""Kind of the cells, as meshio calls it, and numbers of their nodes, shape (cells, nodes)."""

# Units of arrays by the first word of their names; numbers of cells' parts have none.
_UNITS = {
    "displacement": "m",
    "absolute": "m",
    "potential": "m^2",
    "pressure": "Pa",
    "tension": "N",
    "s": "m",
}
_ARRAY = re.compile(rb'(<DataArray[^>]*\bName="([^"_]*)[^"]*"[^>]*>[^<]*)(</DataArray>)')


def write_vtu(
    path: Path,
    points: np.ndarray[Any, Any],
    cells: Cells,
    point_data: Mapping[str, np.ndarray[Any, Any]],
    cell_data: Mapping[str, np.ndarray[Any, Any]] | None = None,
    *,
    compressed: bool = True,
) -> None:
    """Write a mesh with its arrays; VTK's key UNITS_LABEL of an array tells its unit."""
    starts = np.cumsum([len(nodes) for _, nodes in cells])[:-1]
    of_blocks = {name: np.split(values, starts) for name, values in (cell_data or {}).items()}
    import meshio  # only by runs that write fields

    mesh = meshio.Mesh(points, list(cells), point_data=dict(point_data), cell_data=of_blocks)
    meshio.write(path, mesh, file_format="vtu", compression="zlib" if compressed else None)
    path.write_bytes(_ARRAY.sub(_with_unit, path.read_bytes()))


def _with_unit(found: re.Match[bytes]) -> bytes:
    unit = _UNITS.get(found[2].decode())
    if unit is None:
        return found[0]
    key = f'<InformationKey name="UNITS_LABEL" location="vtkDataArray">{unit}</InformationKey>'
    return found[1] + key.encode() + found[3]


def write_index(path: Path, parts: Iterable[str], arrays: Iterable[str]) -> None:
    """Write a PVTU file, by which ParaView reads VTU files as one."""
    text = '<?xml version="1.0"?>\n<VTKFile type="PUnstructuredGrid" version="1.0">\n'
    text += '<PUnstructuredGrid GhostLevel="0">\n'
    text += '<PPoints>\n<PDataArray type="Float64" NumberOfComponents="3"/>\n</PPoints>\n<PPointData>\n'
    text += "".join(f'<PDataArray type="Float64" Name="{escape(name)}"/>\n' for name in arrays)
    text += "</PPointData>\n" + "".join(f'<Piece Source="{escape(part)}"/>\n' for part in parts)
    path.write_text(text + "</PUnstructuredGrid>\n</VTKFile>\n", encoding="utf-8")


def write_collection(path: Path, entries: Iterable[tuple[float, int, str]]) -> None:
    """Write a PVD file, which ParaView plays."""
    text = '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n <Collection>\n'
    text += "".join(
        f'  <DataSet timestep="{time:.12g}" part="{part}" file="{escape(file)}"/>\n' for time, part, file in entries
    )
    path.write_text(text + " </Collection>\n</VTKFile>\n", encoding="utf-8")
