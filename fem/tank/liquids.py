"""Meshes and liquids of tanks, made anew for each, or shared by tanks that differ in what does not touch the liquid.

Stiffness, mass and hydrostatic restoring of beams, and gravity, which is a unit, enter K and M only. The loads C on the
liquid, its operator A and the answer A⁺C stay the same as long as the shapes of the bodies do: those of a beam depend
on the ratios of its flexural rigidities alone.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.bodies.registry import ends_of_motions, expected_tones
from hydroelastic.fem.cells import is_straight
from hydroelastic.fem.liquid_pencil import answered
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.shared_answer import SharedAnswer
from hydroelastic.fem.shared_errors import SharedErrors
from hydroelastic.fem.surfaces import Body
from hydroelastic.fem.tank.error_estimates import cells_at_tips
from hydroelastic.fem.tank.field_model import build_mesh, half_bodies, whole_bodies
from hydroelastic.fem.tank.field_solution import FieldSolution, PartPencils, part_models
from hydroelastic.fem.tank.released_beam import ReleasedModes, released_modes
from hydroelastic.fem.tank.resolution import (
    Resolution,
    infinite_frequency_resolution,
    initial_resolution,
    sought_modes,
)
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.physics.beams import Beam
from hydroelastic.physics.symmetry import Parity, is_mirror_image, shapes_of_twins
from hydroelastic.physics.tank import Tank

# A dense answer of the liquid that takes more memory is not kept, bytes.
_MOST_MEMORY = 200e6


@dataclass(frozen=True, kw_only=True)
class FirstAttempt:
    """The first attempt at a tank, as far as it is made.

    Attributes:
        tank: the dimensionless tank.
        resolution: of it.
        half: whether the tank is solved as two halves.
        seconds: time that it took, by stage.
        field: its modes, if they are known.
        counted: whether an independent count confirms their number, if that is known.
    """

    tank: Tank
    resolution: Resolution
    half: bool
    seconds: Mapping[str, float] = field(default_factory=dict)
    field: FieldSolution | None = None
    counted: bool | None = None


class Liquids:
    """Makes the mesh and the matrices of each tank anew."""

    def first_attempt(self, physical: Tank, tolerance: float, modes: int, *, halves: bool = True) -> FirstAttempt:
        """Return the first attempt at a tank, in SI units, a symmetric one in two halves unless that is not wanted."""
        tank = physical.scaled()
        return FirstAttempt(
            tank=tank, resolution=self.first(tank, tolerance, modes), half=halves and is_mirror_image(tank)
        )

    def first(self, tank: Tank, tolerance: float, modes: int) -> Resolution:
        """Return the resolution of the first attempt."""
        tones, motions = expected_tones(tank), ends_of_motions(tank)
        return initial_resolution(tank, tolerance, modes=modes, tones=tones, motions=motions)

    def known(self, physical: Tank, tolerance: float, modes: int) -> object:
        """Return the solution of a tank that is solved already; ``None`` for others."""
        return None

    def first_of_limit(self, tank: Tank, tolerance: float) -> Resolution:
        """Return the resolution of the first attempt at the infinite-frequency limit."""
        return infinite_frequency_resolution(tank, tolerance, expected_tones(tank))

    def released(self, tank: Tank, count: int) -> ReleasedModes | None:
        """Return the modes of the infinite-frequency limit where these need no mesh, see `released_modes`."""
        return released_modes([tank], count)[0]

    def mesh(
        self, comm: MPI.Comm, tank: Tank, resolution: Resolution, *, half: bool, infinite_frequency: bool = False
    ) -> TankMesh:
        """Return the mesh, see `build_mesh` (collective)."""
        return build_mesh(comm, tank, resolution, half=half, infinite_frequency=infinite_frequency)

    def pencils(
        self,
        mesh: TankMesh,
        tank: Tank,
        degree: int,
        shapes: tuple[int, ...],
        *,
        half: bool,
        infinite_frequency: bool = False,
    ) -> PartPencils:
        """Return the matrices, see `part_models` (collective)."""
        return part_models(mesh, tank, degree, shapes, half=half, infinite_frequency=infinite_frequency)


ANEW = Liquids()
"""Of a single tank."""


@dataclass
class SharedLiquids(Liquids):
    """Makes mesh and matrices once for all tanks of one `liquid_key`.

    Attributes:
        of_field: elements and dry modes of the first attempt, for all of them.
        of_limit: the resolution of the first attempt at the infinite-frequency limit, for all of them.
        growing: whether what is known of the liquid grows with each tank that is solved; then results depend on those
            before.
        solved: solutions by tank in SI units, tolerance and number of modes.
        begun: first attempts that are made, by the same.
        released_modes: of the infinite-frequency limit, by dimensionless tank and number of dry modes.
    """

    of_field: Resolution
    of_limit: Resolution
    growing: bool = True
    solved: dict[tuple[Tank, float, int], object] = field(default_factory=dict)
    begun: dict[tuple[Tank, float, int], FirstAttempt] = field(default_factory=dict)
    released_modes: dict[tuple[Tank, int], ReleasedModes | None] = field(default_factory=dict)
    _meshes: dict[object, TankMesh] = field(default_factory=dict)
    _pencils: dict[object, PartPencils] = field(default_factory=dict)

    def first(self, tank: Tank, tolerance: float, modes: int) -> Resolution:
        """See `Liquids.first`; where these elements are too coarse, the estimate of the error tells."""
        tones, motions = expected_tones(tank), ends_of_motions(tank)
        return sought_modes(tank, modes=modes, tones=tones, motions=motions).with_elements(self.of_field)

    def known(self, physical: Tank, tolerance: float, modes: int) -> object:
        """See `Liquids.known`."""
        return self.solved.get((physical, tolerance, modes))

    def first_attempt(self, physical: Tank, tolerance: float, modes: int, *, halves: bool = True) -> FirstAttempt:
        """See `Liquids.first_attempt`; it is handed out once."""
        begun = self.begun.pop((physical, tolerance, modes), None)
        return begun or super().first_attempt(physical, tolerance, modes, halves=halves)

    def first_of_limit(self, tank: Tank, tolerance: float) -> Resolution:
        """See `Liquids.first_of_limit` and `first`."""
        return self.of_limit

    def released(self, tank: Tank, count: int) -> ReleasedModes | None:
        """See `Liquids.released`; those that are known are handed out once."""
        return self.released_modes.pop((tank, count), None) or super().released(tank, count)

    def mesh(
        self, comm: MPI.Comm, tank: Tank, resolution: Resolution, *, half: bool, infinite_frequency: bool = False
    ) -> TankMesh:
        """See `Liquids.mesh`."""
        sizes = replace(resolution, degree=0, shapes=(), modes=0, reaches_tones=(), widened=False)
        key = (sizes, half, infinite_frequency)
        if key not in self._meshes:
            self._meshes[key] = super().mesh(comm, tank, resolution, half=half, infinite_frequency=infinite_frequency)
        return self._meshes[key]

    def pencils(
        self,
        mesh: TankMesh,
        tank: Tank,
        degree: int,
        shapes: tuple[int, ...],
        *,
        half: bool,
        infinite_frequency: bool = False,
    ) -> PartPencils:
        """See `Liquids.pencils`."""
        key = (id(mesh), degree, shapes, half, infinite_frequency)
        if key not in self._pencils:
            made = super().pencils(mesh, tank, degree, shapes, half=half, infinite_frequency=infinite_frequency)
            at_tips = cells_at_tips(mesh, tank, half=half, infinite_frequency=infinite_frequency)
            self._pencils[key] = {
                parity: _shared(pencil, at_tips, lambda: self.growing) for parity, pencil in made.items()
            }
        return {
            parity: pencil.with_bodies(_bodies(tank, shapes, parity)) for parity, pencil in self._pencils[key].items()
        }


def _shared(pencil: CoupledPencil, at_tips: np.ndarray, grows: Callable[[], bool]) -> CoupledPencil:
    answer = pencil.answer or answered(pencil, int(_MOST_MEMORY / (8.0 * pencil.coupling.getSize()[0])))
    if answer is None or pencil.size == pencil.body_size:
        # In the infinite-frequency limit no surface moves by itself: there are no gravity modes.
        return replace(pencil, answer=answer)
    of_surfaces, errors = pencil.volumes[:, pencil.body_size :] @ answer.root, None
    if is_straight(pencil.liquid.tank.mesh):
        errors = SharedErrors(pencil.liquid, answer, at_tips, grows).away_and_at_tips
    shared = SharedAnswer(**vars(answer), bodies=pencil.body_size, volumes=of_surfaces, liquid_errors=errors)
    return replace(pencil, answer=shared)


def _bodies(tank: Tank, shapes: tuple[int, ...], parity: Parity | None) -> tuple[Body, ...]:
    half = None if parity is None else half_bodies(tank, shapes_of_twins(tank, shapes), parity)
    return tuple(body for body in (whole_bodies(tank, shapes) if half is None else half) if body.size)


def liquid_key(tank: Tank) -> object:
    """Return what the liquid of a dimensionless tank depends on; ``None`` where it is not known: with floats, whose
    principal motions change with their mass, and with beams of varying section."""
    if any(type(body) is not Beam for body in tank.bodies):
        return None
    alike = (_with_alike_shapes(tank.beams[index]) for index in range(len(tank.bodies)))
    return tank.layers, tank.levels, tuple(alike)


def _with_alike_shapes(beam: Beam) -> Beam:
    """The beam of the same shapes whose first section has EI = 1, without what does not change them."""
    first = beam.sections[0].flexural_rigidity
    return replace(
        beam,
        hydrostatic=True,
        sections=tuple(
            replace(part, flexural_rigidity=part.flexural_rigidity / first, mass_per_length=1.0)
            for part in beam.sections
        ),
        joints=tuple(replace(joint, rotational_stiffness=joint.rotational_stiffness / first) for joint in beam.joints),
    )


def finest(resolutions: Sequence[Resolution]) -> Resolution:
    """Return a resolution that is as fine as each of some in every respect, for the modes of the first one."""
    one = resolutions[0]
    tips = [other.tip_size for other in resolutions if other.tip_size is not None]
    return replace(
        one,
        degree=max(other.degree for other in resolutions),
        surface_sizes=tuple(map(min, zip(*(other.surface_sizes for other in resolutions), strict=True))),
        bulk_size=min(other.bulk_size for other in resolutions),
        tip_size=min(tips, default=None),
        ring_size=min(other.ring_size for other in resolutions),
        ring_ratio=min(other.ring_ratio for other in resolutions),
        shapes=tuple(map(max, zip(*(other.shapes for other in resolutions), strict=True))),
    )
