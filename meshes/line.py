"""Meshes of a hanging line: nodes at equal travel times of waves, graded towards a singular end.

The square of the wave speed on 0 ≤ x ≤ 1 is linear, c² = a + bx. Waves of one frequency have equal wavelengths in the
travel time ∫dx/c, not in x. Where c² vanishes at an end of the line the solutions are entire functions of x, but where
it vanishes just outside, at x = −a/b, they behave like ln(a + bx): elements next to it must not be much longer than
their distance from that point.
"""

from __future__ import annotations

from itertools import pairwise

import basix.ufl
import numpy as np
from dolfinx.mesh import GhostMode, Mesh, create_mesh
from mpi4py import MPI
from numpy.typing import NDArray

from hydroelastic.meshes.compat import cell_partitioner

# Largest ratio of c² over an element, unless it vanishes at one end: a polynomial of degree n on an element
# from d to 4d away from a logarithm converges like 3^{−n}.
_GROWTH = 4.0


def travel_nodes(count: int, bottom: float, slope: float) -> NDArray[np.float64]:
    """Nodes between which waves travel for equal times."""
    lowest, highest = np.sqrt(bottom), np.sqrt(bottom + slope)
    part = np.linspace(0.0, 1.0, count + 1)
    speed = lowest + (highest - lowest) * part
    # (c² − a)/b, which would be 0/0 for a constant speed.
    nodes: NDArray[np.float64] = part * (speed + lowest) / (highest + lowest)
    nodes[-1] = 1.0
    return nodes


def graded_nodes(nodes: NDArray[np.float64], bottom: float, slope: float) -> NDArray[np.float64]:
    """Divide elements that are long relative to their distance from the zero of a + bx outside the line."""
    pieces: list[NDArray[np.float64]] = [nodes[:1]]
    for start, end in pairwise(nodes):
        first, last = bottom + slope * start, bottom + slope * end
        if min(first, last) > 0.0:
            count = int(np.ceil(abs(np.log(last / first)) / np.log(_GROWTH) - 1e-9))
            if count > 1:
                between = np.geomspace(first, last, count + 1)[1:-1]
                pieces.append(np.asarray((between - bottom) / slope, dtype=np.float64))
        pieces.append(np.array([end]))
    return np.concatenate(pieces)


def line_mesh(comm: MPI.Comm, nodes: NDArray[np.float64], *, ghosts: bool = False) -> Mesh:
    """Distribute a line over the processes."""
    element = basix.ufl.element("Lagrange", "interval", 1, shape=(1,))
    count = len(nodes) - 1
    if comm.rank == 0:
        cells = np.column_stack([np.arange(count), np.arange(1, count + 1)]).astype(np.int64)
        points = np.ascontiguousarray(nodes[:, None])
    else:
        cells, points = np.empty((0, 2), dtype=np.int64), np.empty((0, 1))
    mode = GhostMode.shared_facet if ghosts else GhostMode.none
    return create_mesh(comm, cells=cells, x=points, e=element, partitioner=cell_partitioner(mode))
