"""A problem of open water, as all solvers of this package take it: liquids, bodies and tolerance."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from hydroelastic.physics.tank import Tank

if TYPE_CHECKING:
    # A scene is checked without starting MPI.
    from mpi4py import MPI

# A band is widened to that of another analysis down to this part of its lowest and up to this multiple of its highest
# frequency: both analyses then share mesh, matrices and solutions.
_LOWER, _HIGHER = 0.4, 2.0
# Tolerance of solutions that give initial values only.
_ROUGH = 1e-3


@dataclass(frozen=True, kw_only=True)
class OpenWaterProblem:
    """Bodies in open water."""

    comm: MPI.Comm  # MPI communicator
    tank: Tank  # open water in SI units, with at least one body
    tolerance: float  # largest relative error that is accepted
    bands: tuple[tuple[float, float], ...] = ()  # lowest and highest frequency of each analysis, rad/s
    # the last solver of each azimuthal order, of sections order 0, with what it was made for: several analyses of the
    # same frequencies share it
    solvers: dict[int, Any] = field(default_factory=dict, compare=False, repr=False)

    def of_order(self, order: int) -> OpenWaterProblem:
        """Return the problem of one azimuthal order; a section is its own."""
        return replace(self, tank=self.tank.of_order(order))

    def shared_band(self, lowest: float, highest: float) -> tuple[float, float]:
        """Return the range of frequencies of an analysis, rad/s, widened to those of others that hardly cost more."""
        near = [band for band in self.bands if band[0] >= _LOWER * lowest and band[1] <= _HIGHER * highest]
        lows, highs = zip((lowest, highest), *near, strict=True)
        return min(lows), max(highs)

    def rough(self) -> OpenWaterProblem:
        """Return the same problem with a coarse tolerance, for initial values."""
        return replace(self, tolerance=_ROUGH, solvers={})
