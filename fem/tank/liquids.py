"""Meshes and liquids of tanks, made anew for each, or shared by tanks that differ in what does not touch the liquid.

Stiffness, mass and hydrostatic restoring of beams, and gravity, which is a unit, enter K and M only. The loads C on the
liquid, its operator A and the answer A⁺C stay the same as long as the shapes of the bodies do: those of a beam depend
on the ratios of its flexural rigidities alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from mpi4py import MPI

from hydroelastic.fem.bodies.registry import ends_of_motions, expected_tones
from hydroelastic.fem.closed.discretization import sought_modes
from hydroelastic.fem.liquid_pencil import answered
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.surfaces import Body
from hydroelastic.fem.tank.field_model import build_mesh, half_bodies, whole_bodies
from hydroelastic.fem.tank.field_solution import PartPencils, part_models
from hydroelastic.fem.tank.resolution import (
    Resolution,
    infinite_frequency_resolution,
    initial_resolution,
    of_modes,
)
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.physics.beams import Beam
from hydroelastic.physics.symmetry import Parity, shapes_of_twins
from hydroelastic.physics.tank import Tank

# A dense answer of the liquid that takes more memory is not kept, bytes.
_MOST_MEMORY = 200e6


class Liquids:
    """Makes the mesh and the matrices of each tank anew."""

    def first(self, tank: Tank, tolerance: float, modes: int) -> Resolution:
        """Return the resolution of the first attempt."""
        tones, motions = expected_tones(tank), ends_of_motions(tank)
        return initial_resolution(tank, tolerance, modes=modes, tones=tones, motions=motions)

    def first_of_limit(self, tank: Tank, tolerance: float) -> Resolution:
        """Return the resolution of the first attempt at the infinite-frequency limit."""
        return infinite_frequency_resolution(tank, tolerance, expected_tones(tank))

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
    """

    of_field: Resolution
    of_limit: Resolution
    _meshes: dict[object, TankMesh] = field(default_factory=dict)
    _pencils: dict[object, PartPencils] = field(default_factory=dict)

    def first(self, tank: Tank, tolerance: float, modes: int) -> Resolution:
        """See `Liquids.first`; where these elements are too coarse, the estimate of the error tells."""
        tones, motions = expected_tones(tank), ends_of_motions(tank)
        return of_modes(self.of_field, sought_modes(tank, modes=modes, tones=tones, motions=motions))

    def first_of_limit(self, tank: Tank, tolerance: float) -> Resolution:
        """See `Liquids.first_of_limit` and `first`."""
        return self.of_limit

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
            self._pencils[key] = {parity: _with_answer(pencil) for parity, pencil in made.items()}
        return {
            parity: pencil.with_bodies(_bodies(tank, shapes, parity)) for parity, pencil in self._pencils[key].items()
        }


def _with_answer(pencil: CoupledPencil) -> CoupledPencil:
    most = int(_MOST_MEMORY / (8.0 * pencil.coupling.getSize()[0]))
    return replace(pencil, answer=pencil.answer or answered(pencil, most))


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
