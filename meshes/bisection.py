"""Parts of a mesh for processes, by recursive bisection of its cells' middles along their longest extent.

Where a whole mesh is on one process its coordinates are known, and bisection takes a sort; the partition of its graph,
dolfinx's default, costs two processes several times what the rest of the mesh does (M. J. Berger, S. H. Bokhari, IEEE
Trans. Comput. C-36 (1987) 570).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hydroelastic.physics.arrays import FloatArray


def bisected(places: FloatArray, parts: int) -> NDArray[np.int32]:
    """Return the part of each place; all have as many, but for one at most from each division."""
    part_of = np.zeros(len(places), dtype=np.int32)
    if parts == 1 or not len(places):
        return part_of
    lower = parts // 2
    first = len(places) * lower // parts
    axis = np.ptp(places, axis=0).argmax()
    # Stable: places in one plane are divided alike on any machine.
    order = np.argsort(places[:, axis], kind="stable")
    part_of[order[:first]] = bisected(places[order[:first]], lower)
    part_of[order[first:]] = lower + bisected(places[order[first:]], parts - lower)
    return part_of
