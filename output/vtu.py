"""Files of fields for ParaView: VTU with the units of its arrays, and PVD collections of such files."""

from __future__ import annotations

import sys
import zlib
from base64 import b64encode
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
# VTK's numbers of the kinds of cells.
_KINDS = {"line": 3, "triangle": 5, "polygon": 7, "quad": 9, "tetra": 10, "hexahedron": 12, "wedge": 13, "tetra10": 24}
# VTK turns a wedge the other way.
_ORDERS = {"wedge": [0, 2, 1, 3, 5, 4]}
_TYPES = {"f8": "Float64", "f4": "Float32", "i8": "Int64", "i4": "Int32", "i1": "Int8", "u1": "UInt8"}
# Bytes that are compressed together.
_BLOCK = 32768


def write_vtu(
    path: Path,
    points: np.ndarray[Any, Any],
    cells: Cells,
    point_data: Mapping[str, np.ndarray[Any, Any]],
    cell_data: Mapping[str, np.ndarray[Any, Any]] | None = None,
    *,
    compressed: bool = True,
) -> None:
    """Write a mesh with its arrays; VTK's key UNITS_LABEL of an array tells its unit.

    The bytes are those that meshio writes, whose import takes longer than writing.

    Args:
        path: of the file.
        points: shape (points, 3).
        cells: one block after the other.
        point_data: arrays of the points, by name.
        cell_data: arrays of all cells, by name.
        compressed: whether arrays are compressed.
    """
    compressor = ' compressor="vtkZLibDataCompressor"' if compressed else ""
    count = sum(len(nodes) for _, nodes in cells)

    def group(name: str, arrays: Mapping[str, np.ndarray[Any, Any]]) -> Iterable[str]:
        if arrays:
            yield f"<{name}>\n"
            yield from (_array(key, values, compressed) for key, values in arrays.items())
            yield f"</{name}>\n"

    lengths = np.array([size for _, nodes in cells for size in [nodes.shape[1]] * len(nodes)], dtype=np.int64)
    mesh = (
        {
            "connectivity": np.concatenate([nodes[:, _ORDERS.get(kind, slice(None))].ravel() for kind, nodes in cells]),
            "offsets": np.cumsum(lengths),
            "types": np.array([_KINDS[kind] for kind, nodes in cells for _ in nodes]),
        }
        if cells
        else {}
    )
    with path.open("w", encoding="utf-8") as file:
        file.write('<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="0.1" ')
        file.write(f'byte_order="{sys.byteorder.capitalize()}Endian"{compressor}>\n<UnstructuredGrid>\n')
        file.write(f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{count}">\n')
        file.writelines(group("Points", {"Points": points}))
        file.writelines(group("Cells", mesh))
        file.writelines(group("PointData", point_data))
        file.writelines(group("CellData", cell_data or {}))
        file.write("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")


def _array(name: str, values: np.ndarray[Any, Any], compressed: bool) -> str:
    components = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
    unit = _UNITS.get(name.partition("_")[0])
    label = f'<InformationKey name="UNITS_LABEL" location="vtkDataArray">{unit}</InformationKey>' if unit else ""
    kind, content = _TYPES[values.dtype.str[1:]], values.tobytes()
    text = _compressed(content) if compressed else b64encode(_header(len(content)) + content)
    head = f'<DataArray type="{kind}" Name="{escape(name)}"{components} format="binary">'
    return f"{head}\n{text.decode()}\n{label}</DataArray>\n"


def _compressed(content: bytes) -> bytes:
    blocks = [content[start : start + _BLOCK] for start in range(0, len(content), _BLOCK)]
    packed = [zlib.compress(block) for block in blocks]
    last = len(blocks[-1]) if blocks else _BLOCK
    return b64encode(_header(len(blocks), _BLOCK, last, *map(len, packed))) + b64encode(b"".join(packed))


def _header(*numbers: int) -> bytes:
    return np.array(numbers, dtype=np.uint32).tobytes()


def write_index(path: Path, parts: Iterable[str], arrays: Iterable[str]) -> None:
    """Write a PVTU file, by which ParaView reads VTU files as one.

    Args:
        path: of the file.
        parts: names of the files, relative to its folder.
        arrays: names of their arrays at points, one number each.
    """
    text = '<?xml version="1.0"?>\n<VTKFile type="PUnstructuredGrid" version="1.0">\n'
    text += '<PUnstructuredGrid GhostLevel="0">\n'
    text += '<PPoints>\n<PDataArray type="Float64" NumberOfComponents="3"/>\n</PPoints>\n<PPointData>\n'
    text += "".join(f'<PDataArray type="Float64" Name="{escape(name)}"/>\n' for name in arrays)
    text += "</PPointData>\n" + "".join(f'<Piece Source="{escape(part)}"/>\n' for part in parts)
    path.write_text(text + "</PUnstructuredGrid>\n</VTKFile>\n", encoding="utf-8")


def write_collection(path: Path, entries: Iterable[tuple[float, int, str]]) -> None:
    """Write a PVD file, which ParaView plays.

    Args:
        path: of the file.
        entries: value of the time, number of the part, name of the file, in the order of time.
    """
    text = '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n <Collection>\n'
    text += "".join(
        f'  <DataSet timestep="{time:.12g}" part="{part}" file="{escape(file)}"/>\n' for time, part, file in entries
    )
    path.write_text(text + " </Collection>\n</VTKFile>\n", encoding="utf-8")
