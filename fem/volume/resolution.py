"""Resolution of a volume: degree of ψ, sizes of cells at the edges of plates and elsewhere, geometry, plates."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from math import ceil, log, pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.level_bed.resolution import expected_eigenvalue
from hydroelastic.fem.plan.box_resolution import plate_wavenumber, water_wavenumber
from hydroelastic.fem.plan.polynomials import more_polynomials, polynomial_counts
from hydroelastic.fem.volume.memory import DIRECT_UNKNOWNS
from hydroelastic.meshes.plan_loops import Mirrors
from hydroelastic.meshes.volume import CELLS_OF_A_CUBE, VolumeSizes
from hydroelastic.physics.level_tank import FilePlan
from hydroelastic.physics.plate import Rectangle
from hydroelastic.physics.volume_tank import VolumeTank

LARGEST_MESH = 100_000
"""Up to so many cells gmsh makes the whole mesh; it makes 27,000 in a second, on one process."""

_MOST_POLYNOMIALS = 30
_DEGREE, _FINE_DEGREE, _FINE = 4, 6, 1e-8
# The higher degree pays from larger errors on where cells at singular edges are in layers; measured on plates.
_FINE_LAYERED = 3e-6
# Largest and smallest cells, in units of the tank.
_LARGEST, _SMALLEST = 0.35, 5e-4
# Relative error of ω by waves over (kh)^2p, of tetrahedra of size h and degree p: of degree 2, and of higher ones. By
# edges over a power of h, and by corners of floats over h^(4/3), as ψ ~ r^(2/3). Measured.
_OF_WAVES = {2: 1e-3, 4: 1.2e-7}
_OF_EDGES, _EDGE_ORDER = {2: 0.2, 4: 0.05}, {2: 1.5, 4: 2.0}
_OF_CORNERS, _CORNER_ORDER = {2: 0.12, 4: 0.05}, 4.0 / 3.0
# At the tips of baffles over h, as ψ ~ r^(1/2).
_OF_TIPS = 0.02
# Layers at edges of plates, corners and tips, and the errors and their orders with them; measured. More layers add
# nothing: the error is in the first ones.
_LAYERS_OF_EDGES, _LAYERS_OF_CORNERS, _LAYERS_OF_TIPS = 2, 3, 5
_OF_LAYERED_EDGES, _LAYERED_EDGE_ORDER = {4: 3.5e-4, 6: 3e-5}, 1.2
_OF_LAYERED_CORNERS, _OF_LAYERED_TIPS = {4: 6e-4, 6: 2e-4}, {4: 6e-4, 6: 2e-4}
# Cells that layers add to each cell along an edge, over n (n + 1); measured.
_CELLS_OF_LAYERS = 10.0
# Cells that grow from edges of plates with the size h there, over their length over h; measured.
_CELLS_OF_EDGES = 37.0
_MOST_REFINEMENTS = 4
# Seconds that an unknown of degree 4 costs by multigrid, over those of one of degree 2; measured.
_DEARER = 3.0
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


def resolution_of(kept: dict[str, Any]) -> VolumeResolution:
    """Return a resolution that was kept by its fields, in types of JSON."""
    sizes, polynomials = VolumeSizes(**kept["sizes"]), tuple(kept["polynomials"])
    return VolumeResolution(**{**kept, "sizes": sizes, "polynomials": polynomials})


def _step(excess: float, order: float) -> float:
    return min(max(0.9 * excess ** (-1.0 / order), _MOST_STEP), _LEAST_STEP)


def volume_resolution(tank: VolumeTank, tolerance: float, count: int, mirrors: Mirrors) -> VolumeResolution:
    """Return the first resolution for some modes of a dimensionless tank.

    It has degree 4, and 6 for small errors, and layers at singular edges, which a factorization takes. Where these
    would be too many unknowns for one, cells are alike in all directions; and where those of degree 2 then cost less,
    because edges and not waves ask for small cells or the error may be large, it is degree 2. Baffles, an interface and
    cells of a file keep the higher one.
    """
    is_of_mesh = _is_of_mesh(tank)
    if not is_of_mesh and (tank.plates or tank.floats or tank.baffles or _has_corners(tank)):
        for degree in (_FINE_DEGREE, _DEGREE) if tolerance < _FINE_LAYERED else (_DEGREE,):
            layered = _of_degree(degree, tank, tolerance, count, layered=True)
            if _expected_unknowns(tank, layered, mirrors) <= DIRECT_UNKNOWNS:
                return layered
    first = _of_degree(_FINE_DEGREE if tolerance < _FINE else _DEGREE, tank, tolerance, count)
    second = _of_degree(2, tank, tolerance, count)
    many, few = (_expected_unknowns(tank, one, mirrors) for one in (first, second))
    takes_second = not (tank.baffles or tank.interface or is_of_mesh)
    return second if takes_second and many > max(few / _DEARER, DIRECT_UNKNOWNS) else first


def _has_corners(tank: VolumeTank) -> bool:
    """Whether ψ has the singularity of a right-angled corner in the liquid."""
    return bool(tank.floats) or any(isinstance(outline, Rectangle) for outline in tank.columns)


def _of_degree(
    degree: int, tank: VolumeTank, tolerance: float, count: int, *, layered: bool = False
) -> VolumeResolution:
    kind = min(degree, 4)
    eigenvalue = expected_eigenvalue(tank, count)
    wavenumbers = [plate_wavenumber(tank, plate, eigenvalue) for plate in tank.plates]
    radians = (tolerance / (3.0 * _OF_WAVES[kind])) ** (0.5 / degree)
    shortest = max(water_wavenumber(tank, eigenvalue), *wavenumbers, radians / _LARGEST)
    bulk = min(radians / shortest, 2.0 * tank.depth)
    if tank.baffles:
        order, part, layers = 1.0, _OF_LAYERED_TIPS[degree] if layered else _OF_TIPS, _LAYERS_OF_TIPS
    elif _has_corners(tank):
        order, layers = _CORNER_ORDER, _LAYERS_OF_CORNERS
        part = _OF_LAYERED_CORNERS[degree] if layered else _OF_CORNERS[kind]
    else:
        order, layers = _LAYERED_EDGE_ORDER if layered else _EDGE_ORDER[kind], _LAYERS_OF_EDGES
        part = _OF_LAYERED_EDGES[degree] if layered else _OF_EDGES[kind]
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
            layers=layers if layered else 0,
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
    of_edges = _CELLS_OF_EDGES + _CELLS_OF_LAYERS * sizes.layers * (sizes.layers + 1)
    cells = CELLS_OF_A_CUBE * tank.plan.area * tank.depth / sizes.bulk**3 + of_edges * sum(lengths) / sizes.edge
    return float(cells / 2 ** sum(mirror is not None for mirror in mirrors))


def _expected_unknowns(tank: VolumeTank, resolution: VolumeResolution, mirrors: Mirrors) -> float:
    return resolution.degree**3 / 6.0 * expected_cells(tank, resolution.sizes, mirrors)


def _is_of_mesh(tank: VolumeTank) -> bool:
    """Whether the cells are those of a file."""
    return isinstance(tank.plan, FilePlan) and tank.plan.file.suffix.lower() == ".msh"
