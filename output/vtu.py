"""Files of fields for ParaView: VTU with the units of its arrays, and PVD collections of such files."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING
from xml.sax.saxutils import quoteattr

if TYPE_CHECKING:
    import meshio

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


def write_vtu(path: Path, mesh: meshio.Mesh, compression: str | None = "zlib") -> None:
    """Write a mesh with its arrays; VTK's key UNITS_LABEL of an array tells its unit."""
    # Who writes no fields does without it.
    import meshio

    meshio.write(path, mesh, compression=compression)
    path.write_bytes(_ARRAY.sub(_with_unit, path.read_bytes()))


def _with_unit(found: re.Match[bytes]) -> bytes:
    unit = _UNITS.get(found[2].decode())
    if unit is None:
        return found[0]
    key = f'<InformationKey name="UNITS_LABEL" location="vtkDataArray">{unit}</InformationKey>'
    return found[1] + key.encode() + found[3]


def write_index(path: Path, parts: Iterable[str], arrays: Iterable[str]) -> None:
    """Write a PVTU file, by which ParaView reads VTU files as one.

    Args:
        path: of the file.
        parts: names of the files, relative to its folder.
        arrays: names of their arrays at points, one number each.
    """
    text = (
        '<?xml version="1.0"?>\n<VTKFile type="PUnstructuredGrid" version="0.1">\n <PUnstructuredGrid GhostLevel="0">\n'
    )
    text += '  <PPoints>\n   <PDataArray type="Float64" NumberOfComponents="3"/>\n  </PPoints>\n  <PPointData>\n'
    text += "".join(f'   <PDataArray type="Float64" Name={quoteattr(name)}/>\n' for name in arrays)
    text += "  </PPointData>\n" + "".join(f"  <Piece Source={quoteattr(part)}/>\n" for part in parts)
    path.write_text(text + " </PUnstructuredGrid>\n</VTKFile>\n", encoding="utf-8")


def write_collection(path: Path, entries: Iterable[tuple[float, int, str]]) -> None:
    """Write a PVD file, which ParaView plays.

    Args:
        path: of the file.
        entries: value of the time, number of the part, name of the file, in the order of time.
    """
    text = '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n <Collection>\n'
    text += "".join(
        f'  <DataSet timestep="{time:.12g}" part="{part}" file={quoteattr(file)}/>\n' for time, part, file in entries
    )
    path.write_text(text + " </Collection>\n</VTKFile>\n", encoding="utf-8")
