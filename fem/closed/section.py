"""A closed section: from the domain to natural modes with estimated errors.

    ∫∇ψ·∇q = Σ_surfaces ∫ζ q,    K ζ = ω² (M + Σ ρ CᵀA⁺C) ζ            `fem.core.forms`, `fem.core.pencil`

A tank that is its own mirror image is solved by halves: ∂ψ/∂x = 0 on the mirror plane for symmetric modes, ψ = 0 for
antisymmetric ones; both on one mesh with one matrix. The error of each frequency is the sum of

    liquid      three degrees of ψ on one mesh, whose corners are mapped and converge like all else
    dry_modes   all, half and a quarter of the dry modes of beams
    geometry    cells of another degree at curved contours
    rounding    of the matrices and of the eigenvalues in double precision
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from math import ceil, dist, e, inf, log10

import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray

from hydroelastic.fem.core.bodies import dry_mode_count, moving_bodies
from hydroelastic.fem.core.estimate import remainder
from hydroelastic.fem.core.liquid import Liquid
from hydroelastic.fem.core.parts import MergedModes, merged_modes
from hydroelastic.fem.core.pencil import Loads, Pencil, Surface
from hydroelastic.fem.tank.outline import Sizes, layer_names, tank_outline, zero_potential_surfaces
from hydroelastic.fem.tank.singularities import tank_singular_points
from hydroelastic.meshes.distribute import TankMesh, distribute_nodes
from hydroelastic.meshes.geometry import FREE_SURFACE, INTERFACE, SYMMETRY_PLANE
from hydroelastic.meshes.section import SectionSizes, section_mesh
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.physics.dofs import body_name
from hydroelastic.physics.local_waves import moving_parts, moving_pieces, squared_frequency_of_mode
from hydroelastic.physics.symmetry import PARITIES, Parity, shapes_of_twins
from hydroelastic.physics.tank import Piece, StillLevel, Tank

Array = NDArray[np.float64]

HIGHEST_DEGREE = 10
LOWEST_DEGREE = 4
MOST_SHAPES = 400
CAUSES = ("liquid", "dry_modes", "geometry", "rounding")


@dataclass(frozen=True, kw_only=True)
class Discretization:
    """What the loop refines.

    Attributes:
        degree: of ψ.
        sizes: largest cells on each piece of the still levels, along a float's contour; in tank lengths.
        bulk: largest cells anywhere.
        near: size of cells at singular points, in parts of the distance to the next corner.
        geometry_degree: of curved cells; 1 without them.
        dry_modes: number of those of each beam, 0 for floats.
    """

    degree: int
    sizes: tuple[float, ...]
    bulk: float
    near: float
    geometry_degree: int
    dry_modes: tuple[int, ...]

    def refined(self, cause: str, excess: float) -> Discretization:
        """A finer one for the largest cause of an error that exceeds the tolerance by a factor."""
        if cause == "dry_modes":
            factor = min(max(1.3, excess ** (1.0 / 6.0)), 2.0)
            return replace(self, dry_modes=tuple(min(MOST_SHAPES, ceil(factor * count)) for count in self.dry_modes))
        if cause == "geometry":
            return replace(self, geometry_degree=self.geometry_degree + 2)
        if self.degree < HIGHEST_DEGREE:
            return replace(self, degree=min(self.degree + (1 if excess < 30.0 else 2), HIGHEST_DEGREE))
        return replace(self, sizes=tuple(0.65 * size for size in self.sizes), bulk=0.65 * self.bulk, near=0.65 * self.near)


class DiscreteSection:
    """A tank, or its left half, on one mesh, with ψ of several degrees."""

    def __init__(
        self,
        comm: MPI.Comm,
        tank: Tank,
        discretization: Discretization,
        *,
        half: bool,
        released: bool = False,
        mesh: TankMesh | None = None,
    ) -> None:
        self.comm, self.tank, self.discretization, self.half, self.released = comm, tank, discretization, half, released
        self._mesh = mesh
        self.pencils = cache(self._pencils)

    @property
    def mesh(self) -> TankMesh:
        """The mesh (collective when first asked for)."""
        if self._mesh is None:
            self._mesh = distributed(self.comm, self._made)
        return self._mesh

    def _made(self):  # type: ignore[no-untyped-def]
        tank, own = self.tank, self.discretization
        contours = {piece.body: size for piece, size in zip(tank.pieces, own.sizes, strict=True) if piece.body in tank.hulls}
        sizes = Sizes(pieces=own.sizes, contours=contours)
        outline = tank_outline(tank, sizes, half=self.half, infinite_frequency=self.released)
        points = tank_singular_points(tank, sizes, half=self.half, infinite_frequency=self.released)
        powers = {one.point: power_of(one.exponent, own.degree) for one in points if one.exponent < 3.0}
        ends = {end for curve in outline.curves for end in (curve.start, curve.end)}
        near = {
            one.point: own.near * min(tank.depth, *(dist(one.point, other) for other in ends if other != one.point))
            for one in points
        }
        curved = any(curve.path is not None for curve in outline.curves)
        degree = max([own.geometry_degree if curved else 1, *powers.values()])
        return section_mesh(outline, SectionSizes(bulk=own.bulk, points=near), powers, degree)

    def _pencils(self, degree: int) -> Mapping[Parity | None, Pencil]:
        """The problems of all parts with ψ of a degree (collective)."""
        tank, counts = self.tank, self.discretization.dry_modes
        densities = [tank.geometry.measure * layer.density for layer in tank.layers]
        liquid = Liquid(self.mesh, degree, densities, layer_names(tank), tank.geometry)
        measure = tank.geometry.measure
        surfaces = [
            Surface(FREE_SURFACE if level.above is None else INTERFACE, level.below, level.above, measure * level.jump)
            for level in tank.levels
            if level.moves and not (self.released and level.above is None)
        ]
        loads = Loads(liquid, surfaces, [body_name(index + 1) for index in range(len(tank.bodies))])
        zero = zero_potential_surfaces(tank, infinite_frequency=self.released)
        if not self.half:
            pencils = {None: loads.pencil(moving_bodies(tank, counts, None), zero)}
        else:
            counts = shapes_of_twins(tank, counts)
            pencils = {}
            for parity in PARITIES:
                own = (*zero, SYMMETRY_PLANE) if parity == "antisymmetric" else zero
                pencils[parity] = loads.pencil(moving_bodies(tank, counts, parity), own)
        if self.released:
            pencils = {key: pencil.released([INTERFACE]) for key, pencil in pencils.items()}
        return pencils


def distributed(comm: MPI.Comm, make) -> TankMesh:  # type: ignore[no-untyped-def]
    """Make a mesh on rank 0 and distribute it; its errors reach all processes (collective)."""
    noded, problem = None, ""
    if comm.rank == 0:
        try:
            noded = make()
        except Exception as error:
            problem = str(error) or type(error).__name__
    problem = comm.bcast(problem, root=0)
    if problem:
        raise MeshError(problem)
    return distribute_nodes(comm, noded)


def power_of(exponent: float, degree: int) -> int:
    """m of cells with r = sᵐ where ψ ~ r^α: mα near 2, more at high degrees."""
    if exponent < 0.6:
        return 4 if degree < 10 else 5
    if exponent < 0.9:
        return 3 if degree < 8 else 4
    return 3 if exponent < 1.5 else 2


def rounding_error(degree: int, depth: float) -> float:
    """Relative rounding of a frequency in double precision, measured on tanks with known modes."""
    return 1e-14 * (degree / 4.0) ** 3 * max(1.0, 0.1 / depth) ** 1.5


def radians(degree: int, tolerance: float) -> float:
    """Size kh of cells, in radians of a wave, for which the error (e kh/(4p))^{2p} keeps a tolerance."""
    return 4.0 / e * degree * float((0.1 * tolerance) ** (0.5 / degree))


def first_discretization(tank: Tank, tolerance: float, squared_frequency: float) -> Discretization:
    """Cells as long as their degree resolves the shortest wave up to λ, and the dry modes up to it with a tail."""
    degree = min(max(ceil(1.5 - 0.75 * log10(tolerance)), LOWEST_DEGREE + 1), HIGHEST_DEGREE)
    wavenumbers = [_wavenumber(tank, level, piece, squared_frequency) for level in tank.levels for piece in level.pieces]
    sizes = tuple(
        _contour_size(tank, piece.body)
        if piece.body in tank.hulls
        else min(1.3 * radians(degree, tolerance) / max(wavenumber, 1e-9), 0.5 * piece.length, 0.2)
        for piece, wavenumber in zip(tank.pieces, wavenumbers, strict=True)
    )
    of_bodies = {piece.body: wavenumber for piece, wavenumber in zip(tank.pieces, wavenumbers, strict=True)}
    return Discretization(
        degree=degree,
        sizes=sizes,
        bulk=min(0.3, 0.5 * max(layer.depth for layer in tank.layers)) if tank.depth > 0.1 else 0.3,
        near=0.12,
        geometry_degree=6 if tank.hulls else 1,
        dry_modes=tuple(
            min(MOST_SHAPES, dry_mode_count(tank.beams[index], of_bodies[index], tolerance)) if index in tank.beams else 0
            for index in range(len(tank.bodies))
        ),
    )


def _contour_size(tank: Tank, body: int) -> float:
    left, right, low, high = tank.hulls[body].bounds
    return min(0.5 * max(right - left, high - low), 0.25)


def _wavenumber(tank: Tank, level: StillLevel, piece: Piece, squared_frequency: float) -> float:
    return max((part.wavenumber(squared_frequency) for part in moving_parts(tank, level, piece)), default=0.0)


@dataclass(frozen=True, kw_only=True)
class SectionModes:
    """The modes of a section with their relative errors of ω by cause, shape (causes, modes)."""

    section: DiscreteSection
    modes: MergedModes[Parity | None]
    errors: Array

    @property
    def total(self) -> Array:
        return np.asarray(self.errors.sum(axis=0))


def estimated_modes(section: DiscreteSection, count: int) -> SectionModes:
    """The lowest modes on one discretization and the errors that its neighbours tell (collective)."""
    tank, own = section.tank, section.discretization
    pencils = section.pencils(own.degree)
    modes = merged_modes(pencils, count)
    liquid, dry = {}, {}
    coarser = [section.pencils(own.degree - less) for less in (1, 2)]
    for key, part in modes.parts.items():
        needed = len(part.values) - part.growing
        neighbours = [_values(of_degree[key], needed, len(part.values)) for of_degree in coarser]
        liquid[key] = remainder(part.values, *neighbours)
        dry[key] = np.zeros(len(part.values))
        if tank.beams and part.pencil.bodies:
            fewer = [
                part.pencil.of_first([ceil(fraction * shapes) for shapes in own.dry_modes]) for fraction in (0.5, 0.25)
            ]
            neighbours = [_values(pencil, needed, len(part.values)) for pencil in fewer]
            dry[key] = remainder(part.values, *neighbours, rates=(0.01, 0.5))
    values = modes.values
    lowest = values[values > 0.0].min(initial=inf)
    # An error of λ is twice that of ω.
    errors = np.array([
        0.5 * modes.of_parts(liquid),
        0.5 * modes.of_parts(dry),
        _geometry_errors(section, modes, count),
        rounding_error(own.degree, tank.depth) + 1e-15 * np.abs(values) / lowest,
    ]).reshape(len(CAUSES), len(values))
    return SectionModes(section=section, modes=modes, errors=errors)


def _values(pencil: Pencil, count: int, length: int) -> Array:
    from hydroelastic.fem.core.modes import lowest_modes

    found = lowest_modes(pencil, count).values[:length]
    return np.append(found, np.full(length - len(found), np.nan))


def _geometry_errors(section: DiscreteSection, modes: MergedModes[Parity | None], count: int) -> Array:
    return np.zeros(len(modes.origins))
