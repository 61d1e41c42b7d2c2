"""A closed section: from the domain to a Dataset of natural modes with estimated errors, and their fields.

    ∫∇ψ·∇q = Σ_surfaces ∫ζ q,    K ζ = ω² (M + Σ ρ CᵀA⁺C) ζ            `fem.core.forms`, `fem.core.pencil`

A tank that is its own mirror image is solved by halves: ∂ψ/∂x = 0 on the mirror plane for symmetric modes, ψ = 0 for
antisymmetric ones; both on one mesh with one matrix. The error of each frequency is the sum of

    liquid      three degrees of ψ on one mesh, whose corners are mapped and converge like all else
    dry_modes   all, half and a quarter of the dry modes of beams
    geometry    cells of another degree at curved contours
    rounding    of the matrices and of the eigenvalues in double precision

The limit of infinite frequency, ψ = 0 on the free surface and ρψ continuous across an interface, is the same problem on
a mesh of its own. It gives the pressure-release tones of beams, in which the energy of a stiff beam is in one mode, and
the added mass of floats beside fixed beams.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import ceil, inf
from time import perf_counter

import numpy as np
import xarray as xr
from dolfinx import fem
from mpi4py import MPI
from numpy.typing import NDArray
from scipy.linalg import block_diag

from hydroelastic.fem.closed.discretization import (
    CAUSES,
    MOST_MODES_TO_TONE,
    Discretization,
    SoughtModes,
    discretization_of_limit,
    discretization_of_modes,
    ends_of_motions,
    expected_tone,
    rounding_error,
    sought_modes,
)
from hydroelastic.fem.closed.outline import (
    SingularPoint,
    layer_names,
    singular_points,
    tank_outline,
    zero_on_axis,
    zero_potential_surfaces,
)
from hydroelastic.fem.closed.tones import ElasticTone, FloatMode, elastic_tone, first_elastic, float_modes
from hydroelastic.fem.core.adaptive import largest, solve_adaptive
from hydroelastic.fem.core.bodies import Body, extension, moving_bodies
from hydroelastic.fem.core.estimate import remainder
from hydroelastic.fem.core.liquid import Liquid
from hydroelastic.fem.core.modes import lowest_modes
from hydroelastic.fem.core.parts import MergedModes, merged_modes
from hydroelastic.fem.core.pencil import Loads, Pencil, Surface
from hydroelastic.fem.core.sampling import along_level
from hydroelastic.meshes.compat import coordinate_degree
from hydroelastic.meshes.distribute import NodedMesh, TankMesh, distribute_nodes
from hydroelastic.meshes.geometry import FREE_SURFACE, INTERFACE, SYMMETRY_PLANE
from hydroelastic.meshes.outline import Outline
from hydroelastic.meshes.section import SectionSizes, SectionTriangles, section_triangles
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.physics.dofs import body_name
from hydroelastic.physics.symmetry import PARITIES, Parity, is_mirror_image, shapes_of_twins
from hydroelastic.physics.tank import MIDDLE, StillLevel, Tank

Array = NDArray[np.float64]
Pencils = Mapping[Parity | None, Pencil]
"""By symmetry; ``None`` is the whole tank."""

# Number of modes per beam that contain its pressure-release tone: below it are rigid motions and modes of softer beams.
_MODES_OF_A_BEAM = 6
# Rounding of each 1/λ by the eigen-solver, relative to the largest 1/λ.
_ROUNDING_OF_SPREAD = 1e-15
# The tolerance over the rounding error, so that other errors have a part of it too.
_ROOM_FOR_ROUNDING = 5.0
# Added mass below this part of ρ times the square (roll: fourth power) of the float's extent is rounding.
_NO_LIQUID = 1e-9
# α of singular points that need no smaller cells.
_WEAK = 1.9
# Degree at which cells of two degrees of the geometry are compared.
_DEGREE_OF_GEOMETRY = 5


class DiscreteSection:
    """A tank, or its left half, on one mesh, with ψ of several degrees."""

    def __init__(
        self, comm: MPI.Comm, tank: Tank, discretization: Discretization, *, half: bool, released: bool = False
    ) -> None:
        self.comm, self.tank, self.discretization, self.half, self.released = comm, tank, discretization, half, released
        self._liquids: dict[int, Liquid] = {}
        self._pencils: dict[int, Pencils] = {}

    def changed(self, discretization: Discretization) -> DiscreteSection:
        """Another discretization, with what it has in common with this one."""
        if discretization == self.discretization:
            return self
        other = DiscreteSection(self.comm, self.tank, discretization, half=self.half, released=self.released)
        if discretization.triangles == self.discretization.triangles:
            alike = discretization.geometry_degree == self.discretization.geometry_degree
            shared = {"_triangles", "outline", *(("mesh", "_liquids") if alike else ())}
            if alike and discretization.dry_modes == self.discretization.dry_modes:
                shared.add("_pencils")
            vars(other).update({name: value for name, value in vars(self).items() if name in shared})
        return other

    @cached_property
    def points(self) -> tuple[SingularPoint, ...]:
        return singular_points(self.tank, half=self.half, released=self.released)

    @cached_property
    def mesh(self) -> TankMesh:
        return distributed(self.comm, self._noded)

    @property
    def mesh_degree(self) -> int:
        return coordinate_degree(self.mesh.mesh)

    @cached_property
    def outline(self) -> Outline:
        return tank_outline(self.tank, self.discretization.sizes, half=self.half)

    @property
    def is_curved(self) -> bool:
        return any(curve.path is not None for curve in self.outline.curves)

    @cached_property
    def _triangles(self) -> SectionTriangles:
        own, depth = self.discretization, self.tank.depth
        ends = np.array(sorted({end for curve in self.outline.curves for end in (curve.start, curve.end)}))
        near = {}
        for point in self.points:
            distances = np.hypot(*(ends - point.point).T)
            size = own.near * min(depth, float(distances[distances > 0.0].min()))
            near[point.point] = size if point.exponent < _WEAK else inf, point.largest_angle
        return section_triangles(self.outline, SectionSizes(bulk=own.bulk, points=near))

    def _noded(self) -> NodedMesh:
        own = self.discretization
        powers = {point.point: point.power(own.degree) for point in self.points}
        degree = max([own.geometry_degree if self.is_curved else 1, *powers.values()])
        return self._triangles.noded(powers, degree)

    def liquid(self, degree: int) -> Liquid:
        """ψ of a degree (collective)."""
        if degree not in self._liquids:
            # A and all that is made of it are linear in the densities: these contain the factor of the geometry.
            tank, measure = self.tank, self.tank.geometry.measure
            densities = [measure * layer.density for layer in tank.layers]
            self._liquids[degree] = Liquid(self.mesh, degree, densities, layer_names(tank), tank.geometry)
        return self._liquids[degree]

    def pencils(self, degree: int) -> Pencils:
        """The problems of all parts with ψ of a degree (collective)."""
        if degree in self._pencils:
            return self._pencils[degree]
        tank, counts, measure = self.tank, self.discretization.dry_modes, self.tank.geometry.measure
        surfaces = [
            Surface(FREE_SURFACE if level.above is None else INTERFACE, level.below, level.above, measure * level.jump)
            for level in tank.levels
            if level.moves and not (self.released and level.above is None)
        ]
        loads = Loads(self.liquid(degree), surfaces, [body_name(index + 1) for index in range(len(tank.bodies))])
        zero = (*zero_potential_surfaces(tank, infinite_frequency=self.released), *zero_on_axis(tank))
        if self.half:
            counts = shapes_of_twins(tank, counts)
        pencils: dict[Parity | None, Pencil] = {}
        for part in self.parts:
            plane = (SYMMETRY_PLANE,) if part == "antisymmetric" else ()
            pencil = loads.pencil(moving_bodies(tank, counts, part), (*zero, *plane))
            pencils[part] = pencil.released([INTERFACE]) if self.released else pencil
        self._pencils[degree] = pencils
        return pencils

    @cached_property
    def parts(self) -> tuple[Parity | None, ...]:
        """The symmetries to solve: in the limit, where no float moves, those of first dry modes."""
        if not self.half or not self.released or self.tank.rigid:
            return PARITIES if self.half else (None,)
        first = [first_elastic(self.bodies, index)[1] for index in self.tank.elastic]
        return tuple(parity for parity in PARITIES if self.extensions[parity][first].any())

    @cached_property
    def bodies(self) -> tuple[Body, ...]:
        counts = self.discretization.dry_modes
        return moving_bodies(self.tank, shapes_of_twins(self.tank, counts) if self.half else counts, None)

    @cached_property
    def extensions(self) -> dict[Parity | None, Array]:
        """From the body unknowns of each part to those of the whole tank."""
        return {parity: extension(self.tank, self.bodies, parity) for parity in (PARITIES if self.half else (None,))}

    def liquid_energies(self, vectors: Mapping[Parity | None, Array]) -> dict[Parity | None, Array]:
        """ζᵀM_aζ of vectors of each part that keep the volumes, with ψ of this degree and of the two below, shape (3,
        vectors) (collective)."""
        degree = self.discretization.degree
        pencils, coarser = self.pencils(degree), (None, self.liquid(degree - 1), self.liquid(degree - 2))
        return {
            key: np.array([pencils[key].added_energies(own, one) for one in coarser]) for key, own in vectors.items()
        }

    def geometry_errors(self, values: Callable[[Pencils], Array], count: int) -> Array:
        """Relative differences of some values, between cells of two degrees of the geometry (collective)."""
        if not self.is_curved:
            return np.zeros(count)
        own = self.discretization
        low = min(own.degree, _DEGREE_OF_GEOMETRY)
        other = self.changed(replace(own, geometry_degree=own.geometry_degree - 2))
        here, there = values(self.pencils(low)), values(other.pencils(low))
        return np.asarray(np.abs(here - there) / np.where(here == 0.0, 1.0, np.abs(here)))

    def rounding(self, values: Array) -> Array:
        lowest = values[values > 0.0].min(initial=inf)
        return (
            2.0 * rounding_error(self.discretization.degree, self.tank.depth)
            + _ROUNDING_OF_SPREAD * np.abs(values) / lowest
        )


def distributed(comm: MPI.Comm, make: Callable[[], NodedMesh]) -> TankMesh:
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


@dataclass(frozen=True, kw_only=True)
class SectionModes:
    section: DiscreteSection  # the discretization
    modes: MergedModes[Parity | None]  # of all parts
    errors: Array  # relative errors of ω, or of a growth rate, by cause, shape (causes, modes)
    # modes whose errors are to keep the tolerance
    judged: NDArray[np.int64] = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    tones: tuple[ElasticTone, ...] = ()  # of each elastic body
    float_modes: tuple[FloatMode, ...] = ()  # of each restored motion of floats
    missing: int = 0  # tones that may lie above the modes

    @property
    def total(self) -> Array:
        return np.asarray(self.errors.sum(axis=0))

    @property
    def error(self) -> float:
        """The largest error of judged modes."""
        return float(np.nan_to_num(self.total[self.judged], nan=1.0).max(initial=0.0))

    @property
    def causes(self) -> dict[str, float]:
        """The largest error of judged modes by each cause."""
        return largest(self.errors[:, self.judged], CAUSES)

    @cached_property
    def values(self) -> Array:
        return self.modes.values[self.modes.growing :]

    @cached_property
    def amplitudes(self) -> Array:
        """Of the bodies of the whole tank, of all modes, at unit generalized mass, shape (modes, body unknowns)."""
        extensions = self.section.extensions
        found = {key: part.amplitudes @ extensions[key].T for key, part in self.modes.parts.items()}
        size = sum(body.size for body in self.section.bodies)
        return self.modes.of_parts(found).reshape(len(self.modes.origins), size)

    @cached_property
    def energies(self) -> Array:
        """Shares in the potential energy of all modes: body unknowns, then surfaces, shape (modes, shares)."""
        found = {}
        for key, part in self.modes.parts.items():
            squares, size = self.section.extensions[key] ** 2, part.pencil.body_size
            of_bodies = part.energies[:, :size] @ (squares / squares.sum(axis=0)).T
            found[key] = np.hstack([of_bodies, part.energies[:, size:]])
        return self.modes.of_parts(found).reshape(len(self.modes.origins), -1)

    @property
    def surfaces(self) -> tuple[Surface, ...]:
        return tuple(surface for surface, _ in next(iter(self.modes.parts.values())).pencil.surfaces)


def estimated_modes(section: DiscreteSection, count: int) -> SectionModes:
    """The lowest modes on one discretization, and the errors that its neighbours tell (collective)."""
    own = section.discretization
    modes = merged_modes(section.pencils(own.degree), count)

    def values(pencils: Pencils) -> Array:
        found = {key: _values(pencils[key], len(part.values), part.growing) for key, part in modes.parts.items()}
        return modes.of_parts(found)

    found = modes.values
    energies = section.liquid_energies({key: part.vectors for key, part in modes.parts.items()})
    liquid = modes.of_parts(
        {key: remainder(*(part.body_energies + energies[key])) for key, part in modes.parts.items()}
    )
    geometry = section.geometry_errors(values, len(found))
    dry: Array = np.zeros(len(found))
    if section.tank.elastic:
        counts = ([ceil(fraction * shapes) for shapes in own.dry_modes] for fraction in (0.5, 0.25))
        fewer = ({key: part.pencil.of_first(first) for key, part in modes.parts.items()} for first in counts)
        dry = remainder(found, *map(values, fewer), rates=(0.01, 0.5))
    # An error of λ is twice that of ω.
    errors = 0.5 * np.array([liquid, dry, geometry, section.rounding(found)]).reshape(len(CAUSES), -1)
    return SectionModes(section=section, modes=modes, errors=errors)


def _values(pencil: Pencil, count: int, growing: int) -> Array:
    found = lowest_modes(pencil, count - growing).values[:count]
    return np.append(found, np.full(count - len(found), np.nan))


@dataclass(frozen=True, kw_only=True)
class ReleasedLimit:
    """The limit of infinite frequency on one discretization."""

    section: DiscreteSection  # the discretization
    modes: SectionModes | None  # the modes with ψ = 0 on the free surface, where there are beams
    tones: tuple[ElasticTone, ...]  # of each elastic body
    added_mass: Array | None  # of the floats' motions, dimensionless, shape (motions, motions); ``None`` without
    added_mass_error: float  # relative to the root of the product of diagonal entries
    errors: Array  # relative errors of the tones' ω and of the added masses, by cause, shape (causes, values)
    missing: int = 0

    @property
    def error(self) -> float:
        """The largest error."""
        return float(np.nan_to_num(self.errors.sum(axis=0), nan=1.0).max(initial=0.0))

    @property
    def causes(self) -> dict[str, float]:
        """The largest error by each cause."""
        return largest(self.errors, CAUSES)

    def tone(self, number: int) -> tuple[float, float] | None:
        """λ of the tone of a beam and the relative error of its ω; ``None`` where rounding hides it."""
        if self.modes is None:
            return None
        index = self.tones[number].index
        value = float(self.modes.values[index])
        # The tone of a beam that is rigid to double precision is lost in the rounding of the lowest mode.
        hidden = _ROUNDING_OF_SPREAD * value > 1e-3 * self.modes.values[0]
        return None if hidden else (value, float(self.modes.total[index]))


def released_limit(section: DiscreteSection) -> ReleasedLimit:
    """Solve the limit on one discretization (collective)."""
    tank = section.tank
    errors: list[Array] = [np.empty((len(CAUSES), 0))]
    modes: SectionModes | None = None
    tones: tuple[ElasticTone, ...] = ()
    added_mass, added_mass_error = None, 0.0
    if tank.elastic and tank.has_waves:
        count = _MODES_OF_A_BEAM * len(tank.elastic)
        while True:
            modes = estimated_modes(section, count)
            amplitudes = modes.amplitudes[modes.modes.growing :]
            tones = tuple(elastic_tone(modes.values, amplitudes, section.bodies, body) for body in tank.elastic)
            if all(tone.certain for tone in tones) or modes.modes.complete:
                break
            count *= 2
        errors.append(modes.errors[:, modes.modes.growing :][:, sorted({tone.index for tone in tones})])
    if _has_added_mass(tank):
        added_mass, of_entries = _added_mass(section)
        added_mass_error = float(of_entries.sum(axis=0).max(initial=0.0))
        errors.append(of_entries)
    return ReleasedLimit(
        section=section,
        modes=modes,
        tones=tones,
        added_mass=added_mass,
        added_mass_error=added_mass_error,
        errors=np.hstack(errors),
    )


def _has_added_mass(tank: Tank) -> bool:
    return tank.has_infinite_frequency_limit and any(tank.bodies[index].rigid_motions for index in tank.rigid)


def _added_mass(section: DiscreteSection) -> tuple[Array, Array]:
    """Added mass of the floats in their motions, and relative errors of its diagonal by cause."""
    tank, bodies = section.tank, section.bodies
    of_floats = np.repeat([index in tank.rigid for index in range(len(bodies))], [body.size for body in bodies])

    def motions(key: Parity | None, pencil: Pencil) -> Array:
        path = section.extensions[key][of_floats]
        if key is not None:
            # A body cut by the mirror plane moves alike in both halves; of mirrored bodies each half has the mean or
            # the difference.
            path = np.sqrt(2.0) * np.sign(path) / np.maximum(np.count_nonzero(path, axis=0), 1)
        return np.hstack([path, np.zeros((len(path), pencil.size - pencil.body_size))]).T

    def whole(pencils: Pencils) -> Array:
        moved = {key: motions(key, pencil) for key, pencil in pencils.items()}
        return np.asarray(sum(moved[key].T @ pencil.added_mass @ moved[key] for key, pencil in pencils.items()))

    pencils = section.pencils(section.discretization.degree)
    matrix = whole(pencils)
    diagonal = np.diag(matrix).copy()
    energies = section.liquid_energies({key: motions(key, own) for key, own in pencils.items()})
    liquid = remainder(*np.sum(list(energies.values()), axis=0))
    geometry = section.geometry_errors(lambda pencils: np.diag(whole(pencils)).copy(), len(diagonal))
    own = [(tank.hulls[index].smallest_extent, dof) for index in tank.rigid for dof in bodies[index].dofs]
    moves = diagonal > _NO_LIQUID * np.array([size ** (4 if dof.is_rotation else 2) for size, dof in own])
    rounding = np.full(len(diagonal), rounding_error(section.discretization.degree, tank.depth))
    errors = np.array([liquid, np.zeros_like(liquid), geometry, rounding])[:, moves]
    turns = block_diag(*(bodies[index].motions for index in tank.rigid))
    physical = np.linalg.solve(turns.T, np.linalg.solve(turns.T, matrix).T)
    return 0.5 * (physical + physical.T), errors


@dataclass(frozen=True, kw_only=True)
class SectionSolution:
    physical: Tank  # the tank, in SI units
    tank: Tank  # the same in its own units, in which ρ = g = L = 1
    tolerance: float  # asked relative error of frequencies
    count: int  # number of modes asked for
    sought: SoughtModes  # modes that were solved for
    found: SectionModes  # the modes
    limit: ReleasedLimit | None  # the limit of infinite frequency
    counted: bool  # whether inertia confirms that no mode is missing
    seconds: dict[str, float]  # by stage

    @cached_property
    def dataset(self) -> xr.Dataset:
        from hydroelastic.fem.closed.dataset import section_dataset

        return section_dataset(self)

    def field(self, number: int) -> fem.Function:
        """ψ of a mode, counted from 0 with the growing ones first, on the mesh of its part; dimensionless, at unit
        generalized mass of that part (collective)."""
        key, own = self.found.modes.origins[number]
        return self.found.modes.parts[key].potential(own)

    def elevation(self, number: int, level: StillLevel, x: Array) -> Array:
        """Elevation of an open surface or interface in a mode at dimensionless abscissas, at unit generalized mass of
        the whole tank; NaN beside it (collective).

        η = λ (ρψ below − ρψ above)/Δρ.
        """
        key, _ = self.found.modes.origins[number]
        psi = self.field(number).x.array
        name = FREE_SURFACE if level.above is None else INTERFACE
        liquid = next(iter(self.found.modes.parts.values())).pencil.liquid
        left = np.where(x > MIDDLE, 1.0 - x, x) if key is not None else x
        total = np.zeros(len(x))
        for layer, sign in ((level.below, 1.0), (level.above, -1.0)):
            if layer is not None:
                density = sign * self.tank.layers[layer].density
                total += density * along_level(liquid, psi[: liquid.owned], name, layer, left)
        if key is not None:
            total *= np.sqrt(0.5) * np.where((x > MIDDLE) & (key == "antisymmetric"), -1.0, 1.0)
        return np.asarray(self.found.modes.values[number] * total / level.jump)


def solve_section(
    physical: Tank,
    *,
    tolerance: float,
    modes: int,
    comm: MPI.Comm | None = None,
    halves: bool = True,
    report: Callable[[str], None] = lambda _message: None,
) -> SectionSolution:
    """Solve a section between walls to a tolerance (collective).

    Args:
        physical: the tank, in SI units.
        tolerance: relative error of frequencies.
        modes: how many, from the lowest.
        comm: processes.
        halves: whether a tank that is its own mirror image is solved by halves.
        report: told of each discretization.
    """
    comm = comm or MPI.COMM_WORLD
    began = perf_counter()
    tank = physical.scaled()
    half = halves and is_mirror_image(tank)
    workable = max(tolerance, _ROOM_FOR_ROUNDING * rounding_error(8, tank.depth))
    tones = tuple(expected_tone(tank, index) for index in tank.elastic)
    motions = tuple(end for index in tank.rigid for end in ends_of_motions(tank, index))
    sought = sought_modes(tank, modes=modes, tones=tones, motions=motions)
    limit = None
    if (tank.elastic and tank.has_waves) or _has_added_mass(tank):
        report("limit of infinite frequency")
        released = DiscreteSection(comm, tank, discretization_of_limit(tank, workable), half=half, released=True)
        limit = solve_adaptive(released.discretization, lambda own: released_limit(released.changed(own)), workable)
    limited = perf_counter()
    section = DiscreteSection(comm, tank, discretization_of_modes(tank, workable, sought), half=half)
    wanted = sought.modes

    def analysis(discretization: Discretization) -> SectionModes:
        report(f"degree {discretization.degree}, {wanted} modes")
        return _with_tones(estimated_modes(section.changed(discretization), wanted), modes, limit)

    found = solve_adaptive(section.discretization, analysis, workable)
    if _uncertain(found, sought) and wanted < MOST_MODES_TO_TONE:
        # A tone may lie above: more modes, once.
        wanted = min(ceil(1.6 * wanted), MOST_MODES_TO_TONE)
        wider = discretization_of_modes(tank, workable, replace(sought, accurate=wanted))
        section = section.changed(replace(wider, degree=max(wider.degree, section.discretization.degree)))
        found = solve_adaptive(section.discretization, analysis, workable)
    solved = perf_counter()
    counted = found.modes.is_counted()
    seconds = {"limit": limited - began, "modes": solved - limited, "count": perf_counter() - solved}
    return SectionSolution(
        physical=physical,
        tank=tank,
        tolerance=tolerance,
        count=modes,
        sought=sought,
        found=found,
        limit=limit,
        counted=counted,
        seconds=seconds,
    )


def _with_tones(found: SectionModes, asked: int, limit: ReleasedLimit | None) -> SectionModes:
    tank, growing = found.section.tank, found.modes.growing
    amplitudes, bodies = found.amplitudes[growing:], found.section.bodies
    released = [limit.tone(number) if limit is not None else None for number in range(len(tank.elastic))]
    tones = tuple(
        elastic_tone(found.values, amplitudes, bodies, body, released=None if own is None else own[0])
        for body, own in zip(tank.elastic, released, strict=True)
        if len(found.values)
    )
    added = None
    if limit is not None and limit.added_mass is not None:
        turns = block_diag(*(bodies[index].motions for index in tank.rigid))
        added = np.diag(turns.T @ limit.added_mass @ turns)
    moved = float_modes(bodies, tank.rigid, found.values, amplitudes, added, complete=found.modes.complete)
    judged = {
        *range(min(asked, len(found.values))),
        *(tone.index for tone in tones if tone.certain),
        *(mode.index for mode in moved if mode.index is not None),
    }
    indices = np.array([*range(growing), *(growing + index for index in sorted(judged))], dtype=np.int64)
    return replace(found, tones=tones, float_modes=moved, judged=indices)


def _uncertain(found: SectionModes, sought: SoughtModes) -> bool:
    return any(reached and not tone.certain for tone, reached in zip(found.tones, sought.reaches_tones, strict=False))
