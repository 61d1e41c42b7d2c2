"""Resolution of a box with rectangular plates: cells, layers at edges, degree and polynomials of the plates."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from math import ceil, log10

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.level_bed.interval import IntervalSpace
from hydroelastic.fem.plan.polynomials import more_polynomials, polynomial_counts
from hydroelastic.fem.tank.resolution import radians
from hydroelastic.physics.beam_parts import Section
from hydroelastic.physics.level_tank import Box, LevelTank
from hydroelastic.physics.local_waves import LevelPiece
from hydroelastic.physics.plate import Plate

HIGHEST_DEGREE = 12
MOST_LAYERS = 9
# Largest cell, in parts of a box's side.
_OF_SIDE = 0.3


@dataclass(frozen=True, kw_only=True)
class BoxResolution:
    """Degree, cells and polynomials.

    Attributes:
        degree: of ψ along each axis.
        largest: size of the largest cell, in tank lengths.
        layers: layers beside each edge of a plate, each 0.2 times as thick as the one before.
        polynomials: number of Legendre polynomials along each side of each plate.
    """

    degree: int
    largest: float
    layers: int
    polynomials: tuple[int, ...]

    def finer(self) -> BoxResolution:
        """Return the resolution whose answer shows the error of this one: one layer and two degrees more."""
        return replace(self, degree=self.degree + 2, layers=self.layers + 1)

    def coarser(self) -> BoxResolution:
        """Return the resolution that confirms the number of modes."""
        return replace(
            self,
            degree=3,
            layers=0,
            polynomials=tuple(max(6, count - 6) for count in self.polynomials),
        )

    def refined(self, liquid: float, plates: float) -> BoxResolution | None:
        """Return the next resolution by the errors over their parts of the tolerance; ``None`` where it ends."""
        finer = self
        if liquid > 1.0:
            # A layer divides the error of an edge by 25, a degree that of the waves by five or more.
            more = 1 + int(liquid > 30.0)
            finer = replace(
                finer,
                degree=min(self.degree + more, HIGHEST_DEGREE),
                layers=min(self.layers + more, MOST_LAYERS),
                largest=self.largest * (0.7 if self.degree >= HIGHEST_DEGREE else 0.9),
            )
        if plates > 1.0:
            finer = replace(finer, polynomials=more_polynomials(self.polynomials, plates))
        return None if finer == self or (self.degree, self.layers) == (HIGHEST_DEGREE, MOST_LAYERS) else finer


def box_resolution(tank: LevelTank, tolerance: float, eigenvalue: float, *, released: bool = False) -> BoxResolution:
    """Return the resolution for the modes of a dimensionless tank up to some λ."""
    digits = -log10(tolerance)
    degree = min(max(ceil(0.5 + 0.75 * digits), 4), HIGHEST_DEGREE - 2)
    wavenumbers = [plate_wavenumber(tank, plate, eigenvalue) for plate in tank.plates]
    shortest = max([0.0 if released else water_wavenumber(tank, eigenvalue), *wavenumbers, 1.0])
    assert isinstance(tank.plan, Box)
    return BoxResolution(
        degree=degree,
        largest=min(radians(degree, tolerance) / shortest, _OF_SIDE * max(tank.plan.length, tank.plan.width)),
        layers=min(max(ceil(digits / 1.4 - 1.9), 1), MOST_LAYERS - 2),
        polynomials=polynomial_counts(tank, wavenumbers, tolerance),
    )


def water_wavenumber(tank: LevelTank, eigenvalue: float) -> float:
    """Return the wavenumber of waves of a λ on open water."""
    return LevelPiece(length=1.0, beam=None, jump=1.0, restored=True, layers=((1.0, tank.depth),)).wavenumber(
        eigenvalue
    )


def plate_wavenumber(tank: LevelTank, plate: Plate, eigenvalue: float) -> float:
    """Return the wavenumber of waves of a λ in an elastic plate on water; 0 of a rigid one."""
    if not plate.is_elastic:
        return 0.0
    section = Section(length=1.0, flexural_rigidity=plate.flexural_rigidity, mass_per_length=plate.mass_per_area)
    piece = LevelPiece(length=1.0, beam=section, jump=1.0, restored=plate.hydrostatic, layers=((1.0, tank.depth),))
    return piece.wavenumber(eigenvalue)


@lru_cache(maxsize=16)
def axis_space(resolution: BoxResolution, length: float, edges: tuple[float, ...], parity: int | None) -> IntervalSpace:
    """Return the space along one axis, of half of it where it has a symmetry."""
    end = length if parity is None else 0.5 * length
    places = tuple(place for place in edges if place <= end)
    nodes: NDArray[np.float64] = graded_nodes(0.0, end, places, largest=resolution.largest, layers=resolution.layers)
    return IntervalSpace(nodes=nodes, degree=resolution.degree, zero_at_end=parity == 1)


def graded_nodes(
    start: float,
    end: float,
    edges: tuple[float, ...],
    *,
    largest: float,
    layers: int,
    ratio: float = 0.2,
) -> NDArray[np.float64]:
    """Return nodes of an interval that are graded geometrically towards edges inside it."""
    inside = sorted({place for place in edges if start < place < end} | {start, end})
    graded = set(edges)
    nodes = [start]
    for left, right in pairwise(inside):
        length = right - left
        both = (left in graded) + (right in graded)
        # The outermost layer is as large as its neighbours.
        outermost = min(largest, length / (both + 1)) if both and layers else 0.0
        distances = outermost * ratio ** np.arange(layers)[::-1] if layers else np.empty(0)
        from_left = left + distances if left in graded else np.empty(0)
        from_right = right - distances[::-1] if right in graded else np.empty(0)
        low = from_left[-1] if len(from_left) else left
        high = from_right[0] if len(from_right) else right
        cells = max(1, int(np.ceil((high - low) / largest - 1e-9)))
        nodes += [
            *from_left,
            *np.linspace(low, high, cells + 1)[1:-1],
            *([high] if len(from_right) else []),
            *from_right[1:],
            right,
        ]
    return np.array(nodes)
