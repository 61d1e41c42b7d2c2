"""Files that are written here byte for byte as the libraries write them whose import would take longer."""

from __future__ import annotations

import re
from pathlib import Path

import meshio
import numpy as np
import pytest
from scipy.io import netcdf_file

from hydroelastic.output.netcdf3 import StoredVariable, netcdf3
from hydroelastic.output.vtu import write_vtu

SEED = np.random.default_rng(1)
POINTS = SEED.standard_normal((500, 3))


def test_netcdf_has_the_bytes_of_scipy(tmp_path: Path) -> None:
    sizes = {"mode": 3, "point": 5, "string6": 6}
    words = np.frombuffer("ωavesand of".encode()[:6] * 3, dtype="S1").reshape(3, 6)
    variables = [
        StoredVariable(
            name="omega", dimensions=("mode",), values=SEED.standard_normal(3), attributes={"units": b"rad/s"}
        ),
        StoredVariable(
            name="number",
            dimensions=("point", "mode"),
            values=SEED.integers(0, 9, (5, 3)).astype(np.int32),
            attributes={},
        ),
        # Two rows whose lengths leave bytes to fill.
        StoredVariable(
            name="flag", dimensions=("mode",), values=np.array([1, 0, 1], dtype=np.int8), attributes={"dtype": b"bool"}
        ),
        StoredVariable(name="kind", dimensions=("mode", "string6"), values=words, attributes={"_Encoding": b"utf-8"}),
        StoredVariable(
            name="scalar", dimensions=(), values=np.array(2.5), attributes={"empty": b"", "n": np.array([1.0, 2.0])}
        ),
    ]
    attributes = {"title": "Größe".encode(), "version": np.array([3], dtype=np.int32)}
    with netcdf_file(tmp_path / "scipy.nc", "w", version=2) as file:
        for name, value in attributes.items():
            setattr(file, name, value)
        for name, size in sizes.items():
            file.createDimension(name, size)
        for one in variables:
            stored = file.createVariable(one.name, one.values.dtype, one.dimensions)
            stored.data[...] = one.values
            for name, value in one.attributes.items():
                setattr(stored, name, value)
    assert netcdf3(sizes, variables, attributes) == (tmp_path / "scipy.nc").read_bytes()


@pytest.mark.parametrize("compressed", [True, False])
@pytest.mark.parametrize(
    "blocks",
    [
        [("triangle", 900, 3)],
        [("line", 40, 2), ("line", 5, 2), ("polygon", 1, 30)],
        [("wedge", 20, 6)],
        [("tetra10", 20, 10)],
        [],
    ],
    ids=["triangles", "lines and a polygon", "wedges", "curved tetrahedra", "no cells"],
)
def test_vtu_has_the_bytes_of_meshio(tmp_path: Path, blocks: list[tuple[str, int, int]], compressed: bool) -> None:
    cells = [(kind, SEED.integers(0, len(POINTS), (count, nodes))) for kind, count, nodes in blocks]
    parts = [np.full(len(nodes), number, dtype=np.int64) for number, (_, nodes) in enumerate(cells)]
    # More than a block of compression.
    data = {"curvature": np.tile(POINTS, (1, 3)), "mark": SEED.integers(0, 5, len(POINTS)).astype(np.int32)}
    mesh = meshio.Mesh(POINTS, cells, point_data=dict(data), cell_data={"part": parts} if cells else {})
    meshio.write(tmp_path / "meshio.vtu", mesh, compression="zlib" if compressed else None)
    said = re.sub(rb"<!--.*?-->\n", b"", (tmp_path / "meshio.vtu").read_bytes())
    of_cells = {"part": np.concatenate(parts)} if cells else {}
    write_vtu(tmp_path / "own.vtu", POINTS, cells, data, of_cells, compressed=compressed)
    assert (tmp_path / "own.vtu").read_bytes() == said
