"""Element size wanted at a point: those of the sources, growing with the distance from each."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.nearest import Sources
from hydroelastic.meshes.outline import Curve, Point

# Up to so many sources are evaluated one by one at a single point: NumPy takes longer.
_FEW = 16


@dataclass(frozen=True, kw_only=True)
class Discs:
    """Round sources: within a disc elements have its size."""

    centres: NDArray[np.float64]  # centres (x, y) in the unit of the outline, shape (n, 2)
    radii: NDArray[np.float64]  # radii in the unit of the outline, shape (n,)
    sizes: NDArray[np.float64]  # sizes of elements in the unit of the outline, shape (n,)


class SizeField:
    """h(x) = min(bulk size, h_i + growth · max(|x − source i| − r_i, 0)) over all sources i.

    Sources are straight curves with a size (r_i = 0), the corners with their rings (r_i = h_i is the outermost radius)
    and short pieces of curved ones.
    """

    def __init__(
        self,
        *,
        bulk_size: float,
        growth: float,
        straight: list[Curve],
        rings: list[tuple[Point, float]],
        bends: list[Discs],
    ) -> None:
        self._bulk_size = bulk_size
        corners = np.array([centre for centre, _ in rings]).reshape(-1, 2)
        outermost = np.array([radius for _, radius in rings])
        discs = [Discs(centres=corners, radii=outermost, sizes=outermost), *bends]
        centres = np.concatenate([_complex(part.centres) for part in discs])
        self._sources = Sources(
            starts=np.concatenate([_complex(np.array([curve.start for curve in straight]).reshape(-1, 2)), centres]),
            ends=np.concatenate([_complex(np.array([curve.end for curve in straight]).reshape(-1, 2)), centres]),
            radii=np.concatenate([np.zeros(len(straight)), *(part.radii for part in discs)]),
            sizes=np.concatenate([[curve.size for curve in straight], *(part.sizes for part in discs)]),
            growth=growth,
        )

    def __call__(self, x: float, y: float) -> float:
        if len(self._sources.sizes) <= _FEW:
            return min(self._bulk_size, self._sources.least_at(complex(x, y)))
        return float(self._sources.least(np.array([complex(x, y)]), self._bulk_size)[0])

    def along(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Element size at points of shape (n, 2)."""
        return self._sources.least(_complex(points), self._bulk_size)


def _complex(points: NDArray[np.float64]) -> NDArray[np.complex128]:
    return points[:, 0] + 1j * points[:, 1]
