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

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import ceil, inf
from time import perf_counter

import numpy as np
import xarray as xr
from dolfinx import fem
from mpi4py import MPI
from numpy.typing import NDArray

from hydroelastic.fem.closed.discretization import (
    MOST_MODES_TO_TONE,
    Discretization,
    SoughtModes,
    discretization_of_limit,
    discretization_of_modes,
    rounding_error,
    sought_modes,
    workable_tolerance,
)
from hydroelastic.fem.closed.outline import (
    SingularPoint,
    layer_names,
    released_surfaces,
    singular_points,
    tank_outline,
    tank_triangles,
)
from hydroelastic.fem.closed.tones import ElasticTone, FloatMode, elastic_tone, float_modes
from hydroelastic.fem.core.adaptive import largest, solve_adaptive
from hydroelastic.fem.core.bodies import Body, extension, moving_bodies
from hydroelastic.fem.core.estimate import remainder
from hydroelastic.fem.core.liquid import Liquid
from hydroelastic.fem.core.modes import lowest_modes
from hydroelastic.fem.core.parts import MergedModes, merged_modes
from hydroelastic.fem.core.pencil import Loads, Pencil, Surface
from hydroelastic.fem.core.sampling import along_level
from hydroelastic.meshes.compat import coordinate_degree
from hydroelastic.meshes.distribute import TankMesh, distribute_nodes
from hydroelastic.meshes.geometry import FREE_SURFACE, INTERFACE, SYMMETRY_PLANE
from hydroelastic.meshes.outline import Outline
from hydroelastic.meshes.section import SectionTriangles, given_triangles
from hydroelastic.meshes.tagged_mesh import MeshError, NodedMesh, TaggedMesh
from hydroelastic.physics.dofs import body_name
from hydroelastic.physics.symmetry import PARITIES, Parity, is_mirror_image, shapes_of_twins
from hydroelastic.physics.tank import MIDDLE, StillLevel, Tank

Array = NDArray[np.float64]
Pencils = Mapping[Parity | None, Pencil]
"""By symmetry; ``None`` is the whole tank."""

CAUSES = ("liquid", "dry_modes", "geometry", "rounding")

# Number of modes per beam that contain its pressure-release tone: below it are rigid motions and modes of softer beams.
_MODES_OF_A_BEAM = 6
# Rounding of each 1/λ by the eigen-solver, relative to the largest 1/λ.
_ROUNDING_OF_SPREAD = 1e-15
# Added mass below this part of ρ times the square (roll: fourth power) of the float's extent is rounding.
_NO_LIQUID = 1e-9
# Degree at which cells of two degrees of the geometry are compared.
_DEGREE_OF_GEOMETRY = 5


class DiscreteSection:
    """A tank, or its left half, on one mesh, with ψ of several degrees."""

    def __init__(
        self, comm: MPI.Comm, tank: Tank, discretization: Discretization, *, half: bool, released: bool = False
    ) -> None:
        """Nothing is made before it is asked for.

        Args:
            comm: processes.
            tank: dimensionless.
            discretization: of it.
            half: whether of its left half.
            released: whether in the limit of infinite frequency.
        """
        self.comm, self.tank, self.discretization, self.half, self.released = comm, tank, discretization, half, released
        self._pencils: dict[int, Pencils] = {}

    def refined(self, discretization: Discretization) -> DiscreteSection:
        """Another discretization, with what it has in common with this one."""
        other = DiscreteSection(self.comm, self.tank, discretization, half=self.half, released=self.released)
        if discretization.cells == self.discretization.cells:
            vars(other).update(
                {name: vars(self)[name] for name in ("mesh", "_triangles", "outline") if name in vars(self)}
            )
            if discretization.dry_modes == self.discretization.dry_modes:
                other._pencils = self._pencils
        return other

    @cached_property
    def points(self) -> tuple[SingularPoint, ...]:
        """The singular points."""
        return singular_points(self.tank, half=self.half, released=self.released)

    @cached_property
    def mesh(self) -> TankMesh:
        """The mesh (collective)."""
        return distributed(self.comm, self._noded)

    @property
    def mesh_degree(self) -> int:
        """Degree of the cells' geometry."""
        return coordinate_degree(self.mesh.mesh)

    @cached_property
    def outline(self) -> Outline:
        """The outline with its sizes."""
        return tank_outline(self.tank, self.discretization.sizes, half=self.half, released=self.released)

    @property
    def is_curved(self) -> bool:
        """Whether cells follow curves."""
        return self.is_made and any(curve.path is not None for curve in self.outline.curves)

    @property
    def is_made(self) -> bool:
        """Whether the mesh is not one of one's own."""
        return len(self.discretization.sizes) > 0

    @cached_property
    def _triangles(self) -> SectionTriangles:
        return tank_triangles(self.tank, self.outline, self.points, self.discretization)

    def _noded(self) -> NodedMesh:
        own = self.discretization
        powers = {point.point: point.power(own.degree) for point in self.points}
        degree = max([own.geometry_degree if self.is_curved else 1, *powers.values()])
        return self._triangles.noded(powers, degree)

    def pencils(self, degree: int) -> Pencils:
        """The problems of all parts with ψ of a degree (collective)."""
        if degree not in self._pencils:
            self._pencils[degree] = self._made(degree)
        return self._pencils[degree]

    def _made(self, degree: int) -> Pencils:
        tank, counts, measure = self.tank, self.discretization.dry_modes, self.tank.geometry.measure
        # A and all that is made of the liquid are linear in the densities: these contain the factor of the geometry.
        densities = [measure * layer.density for layer in tank.layers]
        liquid = Liquid(self.mesh, degree, densities, layer_names(tank), tank.geometry)
        surfaces = [
            Surface(FREE_SURFACE if level.above is None else INTERFACE, level.below, level.above, measure * level.jump)
            for level in tank.levels
            if level.moves and not (self.released and level.above is None)
        ]
        loads = Loads(liquid, surfaces, [body_name(index + 1) for index in range(len(tank.bodies))])
        zero = released_surfaces(tank, released=self.released)
        pencils: dict[Parity | None, Pencil]
        if self.half:
            counts = shapes_of_twins(tank, counts)
            planes = {parity: (*zero, SYMMETRY_PLANE) if parity == "antisymmetric" else zero for parity in PARITIES}
            pencils = {parity: loads.pencil(moving_bodies(tank, counts, parity), planes[parity]) for parity in PARITIES}
        else:
            pencils = {None: loads.pencil(moving_bodies(tank, counts, None), zero)}
        return {key: pencil.released([INTERFACE]) for key, pencil in pencils.items()} if self.released else pencils

    @cached_property
    def bodies(self) -> tuple[Body, ...]:
        """The bodies of the whole tank."""
        counts = self.discretization.dry_modes
        return moving_bodies(self.tank, shapes_of_twins(self.tank, counts) if self.half else counts, None)

    @cached_property
    def extensions(self) -> dict[Parity | None, Array]:
        """From the body unknowns of each part to those of the whole tank."""
        return {parity: extension(self.tank, self.bodies, parity) for parity in (PARITIES if self.half else (None,))}

    def other_geometry(self) -> DiscreteSection:
        """The same with cells of another degree."""
        own = self.discretization
        changed = replace(own, geometry_degree=own.geometry_degree - 2)
        other = DiscreteSection(self.comm, self.tank, changed, half=self.half, released=self.released)
        vars(other).update({name: vars(self)[name] for name in ("_triangles", "outline") if name in vars(self)})
        return other

    def errors_of(self, finest: Array, values: Callable[[Pencils], Array]) -> tuple[Array, Array]:
        """Relative errors of some values by the liquid and by the geometry, from values of neighbours (collective)."""
        degree = self.discretization.degree
        liquid = remainder(finest, *(values(self.pencils(degree - less)) for less in (1, 2)))
        geometry = np.zeros(len(finest))
        if self.is_curved:
            low = min(degree, _DEGREE_OF_GEOMETRY)
            here, there = values(self.pencils(low)), values(self.other_geometry().pencils(low))
            geometry = np.abs(here - there) / np.where(here == 0.0, 1.0, np.abs(here))
        return liquid, geometry

    def rounding(self, values: Array) -> Array:
        """Relative rounding of λ."""
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
    """Modes on one discretization.

    Attributes:
        section: the discretization.
        modes: of all parts.
        errors: relative errors of ω, or of a growth rate, by cause, shape (causes, modes).
        judged: modes whose errors are to keep the tolerance.
        tones: of each elastic body.
        float_modes: of each restored motion of floats.
        missing: tones that may lie above the modes.
    """

    section: DiscreteSection
    modes: MergedModes[Parity | None]
    errors: Array
    judged: NDArray[np.int64] = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    tones: tuple[ElasticTone, ...] = ()
    float_modes: tuple[FloatMode, ...] = ()
    missing: int = 0

    @property
    def total(self) -> Array:
        """The sum of all causes."""
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
        """λ of the modes that oscillate."""
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
        """The surfaces under gravity."""
        return tuple(surface for surface, _ in next(iter(self.modes.parts.values())).pencil.surfaces)


def estimated_modes(section: DiscreteSection, count: int) -> SectionModes:
    """The lowest modes on one discretization, and the errors that its neighbours tell (collective)."""
    own = section.discretization
    modes = merged_modes(section.pencils(own.degree), count)

    def values(pencils: Pencils) -> Array:
        found = {key: _values(pencils[key], len(part.values), part.growing) for key, part in modes.parts.items()}
        return modes.of_parts(found)

    found = modes.values
    liquid, geometry = section.errors_of(found, values)
    dry: Array = np.zeros(len(found))
    if section.tank.elastic:
        fewer = (
            {
                key: part.pencil.of_first([ceil(fraction * shapes) for shapes in own.dry_modes])
                for key, part in modes.parts.items()
            }
            for fraction in (0.5, 0.25)
        )
        dry = remainder(found, *map(values, fewer), rates=(0.01, 0.5))
    # An error of λ is twice that of ω.
    errors = 0.5 * np.array([liquid, dry, geometry, section.rounding(found)]).reshape(len(CAUSES), -1)
    return SectionModes(section=section, modes=modes, errors=errors)


def _values(pencil: Pencil, count: int, growing: int) -> Array:
    """The first λ of a part; NaN where there are fewer."""
    found = lowest_modes(pencil, count - growing).values[:count]
    return np.append(found, np.full(count - len(found), np.nan))


@dataclass(frozen=True, kw_only=True)
class ReleasedLimit:
    """The limit of infinite frequency on one discretization.

    Attributes:
        section: the discretization.
        modes: the modes with ψ = 0 on the free surface, where there are beams.
        tones: of each elastic body.
        added_mass: of the floats' motions, dimensionless, shape (motions, motions); ``None`` without.
        added_mass_error: relative to the root of the product of diagonal entries.
        errors: relative errors of the tones' ω and of the added masses, by cause, shape (causes, values).
    """

    section: DiscreteSection
    modes: SectionModes | None
    tones: tuple[ElasticTone, ...]
    added_mass: Array | None
    added_mass_error: float
    errors: Array
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

    def whole(pencils: Pencils) -> Array:
        matrix = np.zeros((of_floats.sum(),) * 2)
        for key, pencil in pencils.items():
            path = section.extensions[key][of_floats]
            if key is not None:
                # A body cut by the mirror plane has the same motion in both halves; of two mirrored bodies each half
                # has the mean, or the difference.
                path = np.sqrt(2.0) * np.sign(path) / np.maximum(np.count_nonzero(path, axis=0), 1)
            size = pencil.body_size
            matrix += path @ pencil.added_mass[:size, :size] @ path.T
        return matrix

    matrix = whole(section.pencils(section.discretization.degree))
    diagonal = np.diag(matrix).copy()
    liquid, geometry = section.errors_of(diagonal, lambda pencils: np.diag(whole(pencils)).copy())
    scales = np.array(
        [
            tank.hulls[index].smallest_extent ** (4 if dof.is_rotation else 2)
            for index in tank.rigid
            for dof in bodies[index].dofs
        ]
    )
    moves = diagonal > _NO_LIQUID * scales
    rounding = np.full(len(diagonal), rounding_error(section.discretization.degree, tank.depth))
    errors = np.array([liquid, np.zeros_like(liquid), geometry, rounding])[:, moves]
    turns = np.zeros_like(matrix)
    first = 0
    for index in tank.rigid:
        size = bodies[index].size
        turns[first : first + size, first : first + size] = bodies[index].motions
        first += size
    physical = np.linalg.solve(turns.T, np.linalg.solve(turns.T, matrix).T)
    return 0.5 * (physical + physical.T), errors


@dataclass(frozen=True, kw_only=True)
class SectionSolution:
    """The solution of a closed section.

    Attributes:
        physical: the tank, in SI units.
        tank: the same in its own units, in which ρ = g = L = 1.
        tolerance: asked relative error of frequencies.
        count: number of modes asked for.
        sought: modes that were solved for.
        found: the modes.
        limit: the limit of infinite frequency.
        counted: whether inertia confirms that no mode is missing.
        seconds: by stage.
    """

    physical: Tank
    tank: Tank
    tolerance: float
    count: int
    sought: SoughtModes
    found: SectionModes
    limit: ReleasedLimit | None
    counted: bool
    seconds: dict[str, float]

    @cached_property
    def dataset(self) -> xr.Dataset:
        """All results in SI units."""
        from hydroelastic.fem.closed.dataset import section_dataset

        return section_dataset(self)

    def field(self, number: int) -> fem.Function:
        """ψ of a mode, counted from 0 with the growing ones first, on the mesh of its part; dimensionless, at unit
        generalized mass of that part (collective)."""
        if number not in self._fields:
            key, own = self.found.modes.origins[number]
            self._fields[number] = self.found.modes.parts[key].potential(own)
        return self._fields[number]

    @cached_property
    def _fields(self) -> dict[int, fem.Function]:
        return {}

    def elevations(self, numbers: Sequence[int], level: StillLevel, x: Array) -> Array:
        """Elevation of an open surface or interface in some modes at dimensionless abscissas, at unit generalized mass
        of the whole tank, shape (modes, points); NaN beside it (collective).

        η = λ (ρψ below − ρψ above)/Δρ.
        """
        keys = [self.found.modes.origins[number][0] for number in numbers]
        name = FREE_SURFACE if level.above is None else INTERFACE
        is_half = self.found.section.half
        on_right = ((x > MIDDLE) | (x.min() >= MIDDLE)) & is_half
        total = np.zeros((len(numbers), len(x)))
        for layer, sign in ((level.below, 1.0), (level.above, -1.0)):
            if layer is not None:
                fields = [self.field(number) for number in numbers]
                at = np.where(on_right, 1.0 - x, x)
                density = sign * self.tank.layers[layer].density
                total += density * along_level(self.liquid, fields, name, layer, at)
        if is_half:
            odd = np.array([key == "antisymmetric" for key in keys])
            total *= np.sqrt(0.5) * np.where(odd[:, None] & on_right, -1.0, 1.0)
        return np.asarray(self.found.modes.values[list(numbers), None] * total / level.jump)

    @property
    def liquid(self) -> Liquid:
        """ψ, of all parts."""
        return next(iter(self.found.modes.parts.values())).pencil.liquid

    @cached_property
    def shapes(self) -> xr.Dataset:
        """Shapes of the modes asked for and of growing ones along surfaces and bodies, in SI units (collective)."""
        from hydroelastic.fem.closed.shapes import mode_shapes

        return mode_shapes(self)

    def samples(self) -> xr.Dataset | None:
        """The same modes in the liquids on small triangles, on rank 0, in SI units (collective)."""
        from hydroelastic.fem.closed.shapes import liquid_samples

        return liquid_samples(self)


def solve_section(
    physical: Tank,
    *,
    tolerance: float,
    modes: int,
    comm: MPI.Comm | None = None,
    mesh: TaggedMesh | None = None,
    halves: bool = True,
    report: Callable[[str], None] = lambda _message: None,
) -> SectionSolution:
    """Solve a section between walls to a tolerance (collective).

    Args:
        physical: the tank, in SI units.
        tolerance: relative error of frequencies.
        modes: how many, from the lowest.
        comm: processes.
        mesh: one's own, straight, in m, with the names of `meshes.geometry`; on rank 0.
        halves: whether a tank that is its own mirror image is solved by halves.
        report: told of each discretization.
    """
    comm = comm or MPI.COMM_WORLD
    began = perf_counter()
    tank = physical.scaled()
    is_given = comm.bcast(mesh is not None, root=0)
    half = halves and not is_given and is_mirror_image(tank)
    given = mesh.scaled(1.0 / physical.length) if mesh is not None else None
    workable = workable_tolerance(tolerance, tank.depth)
    sought = sought_modes(tank, modes)
    limit = None
    if (tank.elastic and tank.has_waves) or _has_added_mass(tank):
        report("limit of infinite frequency")
        sections = _Sections(comm, tank, given, half=half, released=True)
        first = discretization_of_limit(tank, workable)
        limit = solve_adaptive(
            replace(first, sizes=()) if is_given else first, lambda own: released_limit(sections.of(own)), workable
        )
    limited = perf_counter()
    sections = _Sections(comm, tank, given, half=half)
    wanted = sought.modes

    def analysis(discretization: Discretization) -> SectionModes:
        report(f"degree {discretization.degree}, {wanted} modes")
        return _with_tones(estimated_modes(sections.of(discretization), wanted), modes, limit)

    first = discretization_of_modes(tank, workable, sought)
    found = solve_adaptive(replace(first, sizes=()) if is_given else first, analysis, workable)
    if _uncertain(found, sought) and wanted < MOST_MODES_TO_TONE:
        # A tone may lie above: more modes, once.
        wanted = min(ceil(1.6 * wanted), MOST_MODES_TO_TONE)
        wider = discretization_of_modes(tank, workable, replace(sought, accurate=wanted))
        wider = replace(wider, degree=max(wider.degree, first.degree), sizes=() if is_given else wider.sizes)
        found = solve_adaptive(wider, analysis, workable)
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


class _Sections:
    """The last discretization, whose parts the next one may have in common with it."""

    def __init__(
        self, comm: MPI.Comm, tank: Tank, given: TaggedMesh | None, *, half: bool, released: bool = False
    ) -> None:
        self._comm, self._tank, self._given, self._half, self._released = comm, tank, given, half, released
        self._last: DiscreteSection | None = None

    def of(self, own: Discretization) -> DiscreteSection:
        if self._last is None:
            self._last = DiscreteSection(self._comm, self._tank, own, half=self._half, released=self._released)
            if self._given is not None:
                angles = {point.point: point.largest_angle for point in self._last.points}
                self._last.__dict__["_triangles"] = given_triangles(self._given, angles)
        else:
            self._last = self._last.refined(own)
        return self._last


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
        parts: list[Array] = [np.empty(0)]
        first = 0
        for index in tank.rigid:
            motions = bodies[index].motions
            own = slice(first, first + len(motions))
            parts.append(np.diag(motions.T @ limit.added_mass[own, own] @ motions))
            first += len(motions)
        added = np.concatenate(parts)
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
