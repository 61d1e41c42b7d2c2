"""Resolution of a volume: degree of ψ, sizes of cells at the edges of plates and elsewhere, geometry, plates."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import ceil

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.plan.box_resolution import expected_eigenvalue, plate_wavenumber, water_wavenumber
from hydroelastic.fem.plan.polynomials import more_polynomials, polynomial_counts
from hydroelastic.meshes.volume import VolumeSizes
from hydroelastic.physics.plate import Rectangle
from hydroelastic.physics.volume_tank import VolumeTank

_MOST_POLYNOMIALS = 30
_DEGREE, _FINE_DEGREE, _FINE = 4, 6, 1e-8
# Largest and smallest cells, in units of the tank.
_LARGEST, _SMALLEST = 0.35, 5e-4
# Relative error of ω by waves at degree 4 over (kh)⁸, of tetrahedra of size h, and by edges over h²; measured.
_OF_WAVES, _OF_EDGES = 1.2e-7, 0.05
# At the corners of floats over h^(4/3), as ψ ~ r^(2/3).
_OF_CORNERS, _CORNER_ORDER = 0.05, 4.0 / 3.0
# At the tips of baffles over h, as ψ ~ r^(1/2).
_OF_TIPS = 0.02
# Largest and smallest ratio of successive sizes.
_LEAST_STEP, _MOST_STEP = 0.85, 0.3


@dataclass(frozen=True, kw_only=True)
class VolumeErrors:
    """Relative errors of the frequencies by cause, each of shape (modes,).

    Attributes:
        edges: by the space of ψ in the cells at the edges of plates.
        waves: by that in all other cells.
        geometry: by curved walls.
        plates: by the polynomials of the plates.
    """

    edges: NDArray[np.float64]
    waves: NDArray[np.float64]
    geometry: NDArray[np.float64]
    plates: NDArray[np.float64]

    @property
    def total(self) -> NDArray[np.float64]:
        """Their sum."""
        return self.edges + self.waves + self.geometry + self.plates

    def first(self, count: int) -> VolumeErrors:
        """Return those of the first modes."""
        return VolumeErrors(
            edges=self.edges[:count],
            waves=self.waves[:count],
            geometry=self.geometry[:count],
            plates=self.plates[:count],
        )


@dataclass(frozen=True, kw_only=True)
class VolumeResolution:
    """Degrees, sizes and polynomials.

    Attributes:
        degree: of ψ.
        sizes: of the cells.
        order: of the error by cells at edges.
        polynomials: number of polynomials along each direction of each plate.
    """

    degree: int
    sizes: VolumeSizes
    polynomials: tuple[int, ...]
    order: float = 2.0

    @property
    def coarser(self) -> VolumeResolution:
        """The resolution that confirms the number of modes, on the same mesh."""
        return replace(self, degree=2, polynomials=tuple(max(6, count - 6) for count in self.polynomials))

    def refined(self, errors: VolumeErrors, tolerance: float) -> VolumeResolution | None:
        """Return the next resolution by the parts of the error; ``None`` where it ends."""
        edges, waves, geometry, plates = (
            float(part.max(initial=0.0)) / (share * tolerance)
            for part, share in ((errors.edges, 0.5), (errors.waves, 0.3), (errors.geometry, 0.1), (errors.plates, 0.1))
        )
        sizes = self.sizes
        if edges > 1.0:
            sizes = replace(sizes, edge=sizes.edge * _step(edges, self.order))
        if waves > 1.0:
            sizes = replace(sizes, bulk=sizes.bulk * _step(waves, 2.0 * self.degree))
        if geometry > 1.0:
            sizes = replace(sizes, around=ceil(sizes.around / _step(geometry, 2.0 * (sizes.geometry // 2) + 2.0)))
        sizes = replace(sizes, edge=min(sizes.edge, sizes.bulk))
        finer = replace(self, sizes=sizes)
        if plates > 1.0:
            finer = replace(finer, polynomials=more_polynomials(self.polynomials, plates, most=_MOST_POLYNOMIALS))
        return None if finer == self or sizes.edge < _SMALLEST else finer


def _step(excess: float, order: float) -> float:
    return min(max(0.9 * excess ** (-1.0 / order), _MOST_STEP), _LEAST_STEP)


def volume_resolution(tank: VolumeTank, tolerance: float, count: int) -> VolumeResolution:
    """Return the first resolution for some modes of a dimensionless tank."""
    degree = _FINE_DEGREE if tolerance < _FINE else _DEGREE
    eigenvalue = expected_eigenvalue(tank, count)
    wavenumbers = [plate_wavenumber(tank, plate, eigenvalue) for plate in tank.plates]
    radians = (tolerance / (3.0 * _OF_WAVES)) ** (0.5 / degree)
    bulk = min(radians / max([water_wavenumber(tank, eigenvalue), *wavenumbers]), _LARGEST, 2.0 * tank.depth)
    corners = tank.floats or any(isinstance(outline, Rectangle) for outline in tank.columns)
    order = 1.0 if tank.baffles else _CORNER_ORDER if corners else 2.0
    part = _OF_TIPS if tank.baffles else _OF_CORNERS if corners else _OF_EDGES
    edge = (0.5 * tolerance / part) ** (1.0 / order)
    return VolumeResolution(
        degree=degree,
        order=order,
        sizes=VolumeSizes(
            edge=min(max(edge, 4.0 * _SMALLEST), bulk),
            bulk=bulk,
            # Between nodes, curved cells would follow no plane triangle of a hull.
            geometry=1 if any(one.hull and one.hull.is_triangulated for one in tank.floats) else 4,
            around=16,
        ),
        polynomials=polynomial_counts(tank, wavenumbers, tolerance, most=_MOST_POLYNOMIALS),
    )
