"""Resolution of the lines of an upright tank: elements, layers at edges, degree and dry modes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from math import ceil, log, log10, pi, sqrt, tanh

import numpy as np

from hydroelastic.fem.closed.discretization import radians
from hydroelastic.fem.level_bed.separation import Separation
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.beam_parts import Section
from hydroelastic.physics.level_tank import LevelTank
from hydroelastic.physics.local_waves import LevelPiece
from hydroelastic.physics.tank import ROUND_OFF

HIGHEST_DEGREE = 14
MOST_SHAPES = 120
# Rounding of frequencies is below a fifth of it, measured.
_LEAST_TOLERANCE = 1e-12
LAYER_RATIO = 0.2
"""Of successive layers at an edge."""


@dataclass(frozen=True, kw_only=True)
class LineResolution:
    """Degree, elements and dry modes; all orders have the same.

    Attributes:
        degree: polynomial degree of ψ.
        sizes: largest element on each piece of the line, between walls and edges of plates.
        layers: layers at each edge of a plate, each 0.2 times as thick as the one before, beyond those that lead down
            to the depth.
        shapes: dry modes of each plate in each order, rigid ones included.
    """

    degree: int
    sizes: tuple[float, ...]
    layers: int
    shapes: tuple[int, ...]

    def finer(self) -> LineResolution:
        """Return one degree, one layer and a quarter of the dry modes more, for the estimate of errors."""
        return replace(self, degree=self.degree + 1, layers=self.layers + 1, shapes=_more(self.shapes, 1.25))

    def refined(self) -> LineResolution | None:
        """Return what the next attempt takes; ``None`` where double precision ends."""
        if self.degree >= HIGHEST_DEGREE:
            return None
        return replace(
            self,
            degree=min(self.degree + 2, HIGHEST_DEGREE),
            sizes=tuple(0.7 * size for size in self.sizes),
            layers=self.layers + 2,
            shapes=_more(self.shapes, 1.5),
        )


def workable(tolerance: float) -> float:
    """Return the requested relative tolerance, or the smallest one that double precision keeps."""
    return max(tolerance, _LEAST_TOLERANCE)


def _more(shapes: tuple[int, ...], factor: float) -> tuple[int, ...]:
    return tuple(min(ceil(factor * count) + 2, MOST_SHAPES) for count in shapes)


def breakpoints(separation: Separation) -> FloatArray:
    """Return the walls and the edges of the plates along the line, ascending; those within rounding are one."""
    places = sorted({separation.start, separation.end, *(edge for place in separation.places for edge in place)})
    kept = [places[0]]
    kept += [place for place in places[1:] if place - kept[-1] > ROUND_OFF]
    return np.array(kept)


def line_resolution(
    tank: LevelTank,
    separation: Separation,
    tolerance: float,
    eigenvalue: float,
    *,
    exponent: float = 1.0,
    waves: bool = True,
) -> LineResolution:
    """Return the resolution for the waves up to a frequency."""
    # Cheapest for each tolerance in tanks with known modes, as in two dimensions; a line may have a degree more.
    degree = min(max(ceil(1.5 - 0.75 * log10(tolerance)), 5), HIGHEST_DEGREE - 2)
    sizes, shapes = [], [0] * len(tank.plates)
    for left, right in pairwise(breakpoints(separation)):
        plate = plate_at(separation, 0.5 * (left + right))
        moves = waves or plate is not None
        wavenumber = moving_piece(tank, right - left, plate).wavenumber(eigenvalue) if moves else 0.0
        sizes.append(min(radians(degree, tolerance) / max(wavenumber, 1e-9), 0.5 * (right - left)))
        if plate is not None:
            half_waves = 0.5 * wavenumber * (right - left)
            needed = ceil(1.1 * half_waves - 1.2 * log10(tolerance)) + 6
            if separation.round and left > 0.0:
                # Polynomials in r converge like (z + √(z² − 1))⁻ᴺ to what is singular on the axis.
                z = (right + left) / (right - left)
                needed = max(needed, ceil(half_waves - 0.5 * log(tolerance) / log(z + sqrt(z * z - 1.0))) + 6)
            shapes[plate] = min(needed, MOST_SHAPES)
    # The error falls like the thickness of the innermost layer to the power 2α.
    thinnest = (85.0 if exponent == 1.0 else 10.0) * tolerance ** (0.5 / exponent)
    layers = ceil(log(thinnest) / log(LAYER_RATIO))
    return LineResolution(degree=degree, sizes=tuple(sizes), layers=max(layers, 2), shapes=tuple(shapes))


def plate_at(separation: Separation, place: float) -> int | None:
    """Return the index of the plate at a place of the line, if there is one."""
    return next((index for index, (start, end) in enumerate(separation.places) if start < place < end), None)


def moving_piece(tank: LevelTank, length: float, index: int | None) -> LevelPiece:
    """Return a piece of the surface for its dispersion relation: water, or an elastic plate."""
    plate = tank.plates[index] if index is not None and tank.plates[index].is_elastic else None
    section = None
    if plate is not None:
        section = Section(length=length, flexural_rigidity=plate.flexural_rigidity, mass_per_length=plate.mass_per_area)
    return LevelPiece(
        length=length,
        beam=section,
        jump=1.0,
        restored=plate is None or plate.hydrostatic,
        layers=((1.0, tank.depth),),
    )


def expected_eigenvalue(tank: LevelTank, count: int, *, multiplicity: int = 1) -> float:
    """Return about the λ of the highest of some modes: that of open water with as many, by Weyl's law A k²/4π, or in a
    narrow tank of waves along it alone, kL/π."""
    waves, area, unit = multiplicity * (count + 2), tank.plan.area, tank.plan.unit
    wavenumber = min(sqrt(4.0 * pi * waves / area), pi * waves / max(unit, area / unit))
    return wavenumber * tanh(wavenumber * tank.depth)


def line_nodes(separation: Separation, resolution: LineResolution, depth: float) -> FloatArray:
    """Return the ends of the elements, with layers at the edges of the plates.

    Beside an edge ψ has scales down to nothing, and evanescent waves of the depth: layers start at the depth. Around an
    inner cylinder or hole elements are no longer than its radius.
    """
    edges = {edge for place in separation.places for edge in place}

    def is_edge(place: float) -> bool:
        return any(abs(place - edge) <= ROUND_OFF for edge in edges)

    places = [separation.start]
    for (left, right), size in zip(pairwise(breakpoints(separation)), resolution.sizes, strict=True):
        graded = is_edge(left), is_edge(right)
        count = max(ceil((right - left) / size), 1 + sum(graded))
        uniform = np.linspace(left, right, count + 1)
        step = (right - left) / count
        innermost = min(step, depth) * LAYER_RATIO**resolution.layers
        layers = ceil(log(innermost / step) / log(LAYER_RATIO))
        thickness = step * LAYER_RATIO ** np.arange(1, layers + 1)
        inner = left if separation.round and 0.0 < left < step else step
        around = (
            np.empty(0)
            if graded[0]
            else step * LAYER_RATIO ** np.arange(1, ceil(log(inner / step) / log(LAYER_RATIO)) + 1)
        )
        places += sorted(
            [
                *(left + (thickness if graded[0] else around)),
                *uniform[1:-1],
                *(right - thickness if graded[1] else ()),
                right,
            ]
        )
    return np.array(places)
