"""Resolution of a volume: degree of ψ, sizes of cells at the edges of plates and elsewhere, geometry, plates."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from math import ceil, log, pi

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.cost import DIRECT_UNKNOWNS
from hydroelastic.fem.level_bed.resolution import expected_eigenvalue
from hydroelastic.fem.plan.polynomials import (
    more_polynomials,
    plate_wavenumbers,
    polynomial_counts,
    water_wavenumber,
)
from hydroelastic.meshes.edge_layers import LAYER_RATIO
from hydroelastic.meshes.plan_loops import Mirrors, image_count
from hydroelastic.meshes.volume import CELLS_OF_A_CUBE, CELLS_OF_EDGES, VolumeSizes
from hydroelastic.physics.level_tank import FilePlan
from hydroelastic.physics.plate import Rectangle
from hydroelastic.physics.volume_tank import VolumeTank

LARGEST_MESH = 100_000
"""Up to so many cells gmsh makes the whole mesh; it makes 27,000 in a second, on one process."""

_MOST_POLYNOMIALS = 30
_DEGREE, _FINE_DEGREE, _FINE = 4, 6, 1e-8
# Largest and smallest cells, in units of the tank.
_LARGEST, _SMALLEST = 0.35, 5e-4
# Of a first resolution, at edges.
_LEAST_EDGE = 4.0 * _SMALLEST
# Relative error of ω by waves over (kh)^2p, of tetrahedra of size h and degree p: of degree 2, and of higher ones.
# Measured.
_OF_WAVES = {2: 1e-3, 4: 1.2e-7}
# Errors at singular edges over those by the measured constants, which are of plates without hydrostatic restoring, of
# tips and of corners: least ones measured, of plates that follow the water.
_MILD = 0.01
# A first attempt for mild edges is made where one for others has so many times its unknowns.
_MUCH_LARGER = 2.0
# Part of the tolerance that the edges take where their error is known.
_OF_KNOWN_EDGES = 0.7
# Within this factor unknowns are expected, of plates.
_WITHIN = 2.0
# Part of an error up to which it counts as the same.
_LITTLE_MORE = 1.2
# Cells that layers add to each cell along an edge, over n (n + 1); measured.
_CELLS_OF_LAYERS = 10.0
_MOST_REFINEMENTS = 4
# Seconds that an unknown of degree 4 costs by multigrid, over those of one of degree 2; measured.
_DEARER = 3.0
# Largest and smallest ratio of successive sizes.
_LEAST_STEP, _MOST_STEP = 0.85, 0.3


@dataclass(frozen=True, kw_only=True)
class _Edges:
    """Relative error of ω by singular edges of one kind, over powers of the size of cells there; measured.

    More layers than the most add nothing, as the error is then in the first ones; fewer do at loose tolerances.

    Attributes:
        alone: of cells alike in all directions, by degree.
        order: its power, by degree; each layer divides the error as cells of its width would.
        layered: with layers, by degree.
        layered_order: its power.
        least, most: numbers of layers. The estimate for plates needs one.
    """

    alone: dict[int, float]
    order: dict[int, float]
    layered: dict[int, float]
    layered_order: float
    least: int
    most: int

    def error(self, degree: int, size: float, layers: int) -> float:
        """With layers; 4 is the highest degree that ``alone`` tells."""
        order = self.order[min(degree, 4)]
        of_size = self.alone[min(degree, 4)] * (LAYER_RATIO**layers * size) ** order
        return of_size + self.layered[degree] * size**self.layered_order

    def layers(self, degree: int, size: float, error: float) -> int:
        """Return how many leave little more than an error."""
        numbers = range(self.least, self.most)
        return next((some for some in numbers if self.error(degree, size, some) <= _LITTLE_MORE * error), self.most)


# Edges of plates; corners of floats and columns, where ψ ~ r^(2/3); tips of baffles, where ψ ~ r^(1/2).
_PLATES = _Edges(
    alone={2: 0.2, 4: 0.05},
    order={2: 1.5, 4: 2.0},
    layered={4: 3.5e-4, 6: 3e-5},
    layered_order=1.2,
    least=1,
    most=2,
)
_CORNERS = _Edges(
    alone={2: 0.12, 4: 0.05},
    order=dict.fromkeys((2, 4), 4.0 / 3.0),
    layered={4: 6e-4, 6: 2e-4},
    layered_order=4.0 / 3.0,
    least=0,
    most=3,
)
_TIPS = _Edges(
    alone=dict.fromkeys((2, 4), 0.02),
    order=dict.fromkeys((2, 4), 1.0),
    layered={4: 6e-4, 6: 2e-4},
    layered_order=1.0,
    least=0,
    most=5,
)


@dataclass(frozen=True, kw_only=True)
class VolumeErrors:
    """Relative errors of the frequencies by cause, each of shape (modes,).

    Attributes:
        edges: by the space of ψ in the cells at the edges of plates.
        waves: by that in all other cells.
        geometry: by curved walls.
        plates: by the polynomials of the plates.
        iteration: by the eigen-solver.
    """

    edges: NDArray[np.float64]
    waves: NDArray[np.float64]
    geometry: NDArray[np.float64]
    plates: NDArray[np.float64]
    iteration: NDArray[np.float64]

    @property
    def total(self) -> NDArray[np.float64]:
        """Their sum."""
        return self.edges + self.waves + self.geometry + self.plates + self.iteration

    def first(self, count: int) -> VolumeErrors:
        """Return those of the first modes."""
        return VolumeErrors(**{one.name: getattr(self, one.name)[:count] for one in fields(self)})


@dataclass(frozen=True, kw_only=True)
class VolumeResolution:
    """Degrees, sizes and polynomials.

    Attributes:
        degree: of ψ.
        sizes: of the cells.
        order: of the error by cells at edges.
        polynomials: number of polynomials along each direction of each plate.
        foreseen: error by edges of usual severity; 0 where that of these is known already.
    """

    degree: int
    sizes: VolumeSizes
    polynomials: tuple[int, ...]
    order: float = 2.0
    foreseen: float = 0.0

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


def volume_resolution(
    tank: VolumeTank,
    tolerance: float,
    count: int,
    mirrors: Mirrors,
    *,
    severity: float | None = None,
    times: float = 1.0,
) -> VolumeResolution:
    """Return the first resolution for some modes of a dimensionless tank.

    It has layers at singular edges, which a factorization takes, and of degree 4 and 6 the one with fewer unknowns.
    Where these would be too many for a factorization, cells are alike in all directions, of degree 4, and of 6 for
    small errors; and where those of degree 2 then cost less, because edges and not waves ask for small cells or the
    error may be large, it is degree 2. Baffles, an interface and cells of a file keep the higher one.
    """
    if severity is None:
        mild, usual = (volume_resolution(tank, tolerance, count, mirrors, severity=one) for one in (_MILD, 1.0))
        few, many = (expected_unknowns(tank, one, mirrors) for one in (mild, usual))
        return mild if mild.foreseen and (many > _MUCH_LARGER * few or not usual.foreseen) else usual
    is_of_mesh = _is_of_mesh(tank)
    if not is_of_mesh and (tank.plates or tank.floats or tank.baffles or _has_corners(tank)):
        layered = _layered(tank, tolerance, count, mirrors, severity, times)
        if layered is not None:
            return layered
    first = _of_degree(_FINE_DEGREE if tolerance < _FINE else _DEGREE, tank, tolerance, count, severity)
    second = _of_degree(2, tank, tolerance, count, severity)
    many, few = (expected_unknowns(tank, one, mirrors) for one in (first, second))
    # Of degree 2 even the smallest cells would then leave too large an error.
    is_coarse = second.sizes.edge <= _LEAST_EDGE
    takes_second = not (tank.baffles or tank.interface or is_of_mesh or is_coarse)
    return second if takes_second and many > max(few / _DEARER, DIRECT_UNKNOWNS) else first


def _layered(
    tank: VolumeTank, tolerance: float, count: int, mirrors: Mirrors, severity: float, times: float
) -> VolumeResolution | None:
    """The cheapest resolution with layers; where none keeps the tolerance, that of the higher degree; ``None`` where
    they have too many unknowns for a factorization."""
    found = []
    for degree in (_DEGREE, _FINE_DEGREE):
        one = _of_degree(degree, tank, tolerance, count, severity, layered=True)
        unknowns = times * expected_unknowns(tank, one, mirrors)
        if unknowns <= DIRECT_UNKNOWNS:
            # Seconds of an unknown grow with the degree: of 6 over 4 by 1.1 on straight cells, 1.7 on curved ones.
            is_coarse = one.sizes.edge <= _LEAST_EDGE
            found.append((is_coarse, -degree if is_coarse else degree * unknowns, one))
    return min(found, key=lambda entry: entry[:2])[2] if found else None


def next_resolution(
    last: VolumeResolution,
    unknowns: int,
    errors: VolumeErrors,
    tank: VolumeTank,
    tolerance: float,
    count: int,
    mirrors: Mirrors,
) -> VolumeResolution | None:
    """Return the resolution after one whose errors are known; ``None`` where it ends.

    After a first one with layers the error that was found at edges decides their degree and size anew, and the unknowns
    that it had whether layers are cheap: around hulls of many short edges they are not.
    """
    finer = last.refined(errors, tolerance)
    if finer is None or not last.foreseen or finer.sizes.edge == last.sizes.edge:
        return finer
    severity = float(errors.edges.max()) / last.foreseen
    rest = max(tolerance - float((errors.total - errors.edges).max()), 0.5 * tolerance)
    severity *= 0.5 * tolerance / (_OF_KNOWN_EDGES * rest)
    times = max(1.0, unknowns / (_WITHIN * expected_unknowns(tank, last, mirrors)))
    planned = volume_resolution(tank, tolerance, count, mirrors, severity=severity, times=times)
    # Half of the size costs a fifth more where cells elsewhere are as large, and one attempt then suffices.
    edge = min(planned.sizes.edge, (0.5 if planned.degree == last.degree else 1.0) * last.sizes.edge)
    bulk = min(planned.sizes.bulk, finer.sizes.bulk)
    sizes = replace(planned.sizes, edge=edge, bulk=bulk, around=finer.sizes.around)
    return replace(planned, sizes=sizes, polynomials=finer.polynomials, foreseen=0.0)


def _has_corners(tank: VolumeTank) -> bool:
    """Whether ψ has the singularity of a right-angled corner in the liquid."""
    return bool(tank.floats) or any(isinstance(outline, Rectangle) for outline in tank.columns)


def _of_degree(
    degree: int, tank: VolumeTank, tolerance: float, count: int, severity: float, *, layered: bool = False
) -> VolumeResolution:
    kind = min(degree, 4)
    eigenvalue = expected_eigenvalue(tank, count)
    wavenumbers = plate_wavenumbers(tank, eigenvalue)
    radians = (tolerance / (3.0 * _OF_WAVES[kind])) ** (0.5 / degree)
    shortest = max(water_wavenumber(tank, eigenvalue), *wavenumbers, radians / _LARGEST)
    bulk = min(radians / shortest, 2.0 * tank.depth)
    edges = _TIPS if tank.baffles else _CORNERS if _has_corners(tank) else _PLATES
    aim = 0.5 * tolerance / severity
    part, order = (edges.layered[degree], edges.layered_order) if layered else (edges.alone[kind], edges.order[kind])
    edge = min(max((aim / part) ** (1.0 / order), _LEAST_EDGE), bulk)
    layers = edges.layers(degree, edge, aim) if layered else 0
    return VolumeResolution(
        degree=degree,
        order=order,
        foreseen=edges.error(degree, edge, layers) if layered else 0.0,
        sizes=VolumeSizes(
            edge=edge,
            bulk=bulk,
            # Between nodes, curved cells would follow no plane triangle of a hull.
            geometry=1 if any(one.hull and one.hull.is_triangulated for one in tank.floats) else 4,
            around=16,
            layers=layers,
        ),
        polynomials=polynomial_counts(tank, wavenumbers, tolerance, most=_MOST_POLYNOMIALS),
    )


def with_refinements(tank: VolumeTank, sizes: VolumeSizes, mirrors: Mirrors) -> VolumeSizes:
    """Return sizes with as many refinements that gmsh makes no more than about `LARGEST_MESH` cells."""
    if _is_of_mesh(tank) or sizes.layers:
        return sizes
    levels = ceil(log(expected_cells(tank, sizes, mirrors) / LARGEST_MESH, 8))
    return replace(sizes, refinements=min(max(0, levels), _MOST_REFINEMENTS))


def expected_cells(tank: VolumeTank, sizes: VolumeSizes, mirrors: Mirrors) -> float:
    """Return about the number of cells of a mesh between planes of symmetry, without making it."""
    lengths = [4.0 * plate.outline.area**0.5 for plate in tank.plates]
    lengths += [pi * sum(solid.size) / 2.0 for solid in tank.floats]
    of_edges = CELLS_OF_EDGES + _CELLS_OF_LAYERS * sizes.layers * (sizes.layers + 1)
    cells = CELLS_OF_A_CUBE * tank.plan.area * tank.depth / sizes.bulk**3 + of_edges * sum(lengths) / sizes.edge
    return float(cells / image_count(mirrors))


def expected_unknowns(tank: VolumeTank, resolution: VolumeResolution, mirrors: Mirrors) -> float:
    """Return about the number of unknowns of ψ between planes of symmetry, without a mesh; measured within 1.7."""
    return resolution.degree**3 / 6.0 * expected_cells(tank, resolution.sizes, mirrors)


def _is_of_mesh(tank: VolumeTank) -> bool:
    return isinstance(tank.plan, FilePlan) and tank.plan.file.suffix.lower() == ".msh"
