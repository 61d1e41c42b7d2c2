"""The problems of a tank on a mesh of its volume, one for each symmetry."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

from hydroelastic.fem.liquid import ONE_LIQUID, Layer, LiquidSpace, liquid_space
from hydroelastic.fem.liquid_matrices import LiquidMatrices
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.plan.classes import mirrored_classes
from hydroelastic.fem.plan.plan_pencil import PlanPlate
from hydroelastic.fem.plan.plates import plan_plate
from hydroelastic.fem.surfaces import LiquidSurface
from hydroelastic.fem.volume.floats import float_body
from hydroelastic.fem.volume.matrices import volume_matrices
from hydroelastic.fem.volume.pencil import SolverOf, moving_surfaces, volume_pencil
from hydroelastic.fem.volume.resolution import VolumeResolution
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.meshes.geometry import FREE_SURFACE, LIQUID, LOWER_LIQUID
from hydroelastic.meshes.plan_loops import Mirrors, image_count
from hydroelastic.meshes.plan_regions import mirrors_of, plan_regions
from hydroelastic.meshes.volume import MIRRORS
from hydroelastic.modal.plate.rectangle import ClassParity
from hydroelastic.physics.dofs import body_name
from hydroelastic.physics.level_tank import FilePlan
from hydroelastic.physics.obstacles import VerticalBaffle, mirrored_outline
from hydroelastic.physics.solid_floats import SolidFloat
from hydroelastic.physics.volume_tank import SlopingBed, SurveyedBed, VolumeTank

# A float this close to a plane of symmetry, in units of the tank, is in it.
_MIDDLE = 1e-7


def volume_mirrors(tank: VolumeTank) -> Mirrors:
    """Return x and y of the planes of symmetry of a dimensionless tank, ``None`` where there is none."""
    if isinstance(tank.plan, FilePlan) or isinstance(tank.bed, SurveyedBed):
        return None, None
    along, across = (
        mirror if mirror is not None and all(_is_in_plane(one, axis, mirror) for one in tank.floats) else None
        for axis, mirror in enumerate(mirrors_of(*plan_regions(tank)))
    )
    along, across = (
        mirror if mirror is not None and _are_symmetric(tank, axis, mirror) else None
        for axis, mirror in enumerate((along, across))
    )
    if isinstance(tank.bed, SlopingBed):
        along, across = (
            None if slope else mirror for mirror, slope in zip((along, across), tank.bed.slope, strict=True)
        )
    return along, across


def _is_in_plane(solid: SolidFloat, axis: int, middle: float) -> bool:
    alike = solid.hull is None or solid.hull.symmetric[axis]
    return alike and abs(solid.position[axis] - middle) < _MIDDLE


def _are_symmetric(tank: VolumeTank, axis: int, middle: float) -> bool:
    """Whether a plane through the middle has as many columns and baffles on both sides, and no baffle in it."""
    columns = {mirrored_outline(mirrored_outline(one, axis, middle), axis, middle) for one in tank.columns}
    baffles = {one.mirrored(axis, middle).mirrored(axis, middle) for one in tank.baffles}
    return (
        {mirrored_outline(one, axis, middle) for one in columns} == columns
        and {one.mirrored(axis, middle) for one in baffles} == baffles
        and not any(
            isinstance(one, VerticalBaffle) and abs(one.start[axis] - middle) + abs(one.end[axis] - middle) < _MIDDLE
            for one in baffles
        )
    )


def _layers(tank: VolumeTank, mesh: TankMesh) -> tuple[Layer, ...]:
    """The liquids from the bottom up, or all of their parts that baffles divide."""
    if tuple(mesh.cell_names) == (LIQUID,):
        return ONE_LIQUID
    return tuple(
        Layer(name=name, density=tank.lower.density if tank.lower and name.startswith(LOWER_LIQUID) else 1.0)
        # Lower liquids come before upper ones.
        for name in sorted(mesh.cell_names)
    )


@dataclass(frozen=True, kw_only=True)
class VolumeModel:
    """A tank in one resolution.

    Attributes:
        tank: the dimensionless tank.
        resolution: of it.
        mesh: of the part between the planes of symmetry.
        mirrors: x and y of these planes.
    """

    tank: VolumeTank
    resolution: VolumeResolution
    mesh: TankMesh
    mirrors: Mirrors

    @property
    def images(self) -> int:
        """Number of parts that are alike."""
        return image_count(self.mirrors)

    @cached_property
    def liquid(self) -> LiquidSpace:
        """The space of ψ that all symmetries share (collective)."""
        zero = (FREE_SURFACE,) if self.tank.top == "pressure_release" else ()
        return liquid_space(self.mesh, self.resolution.degree, zero, _layers(self.tank, self.mesh))

    @cached_property
    def _matrices(self) -> LiquidMatrices:
        return volume_matrices(self.liquid, self._surfaces, self.images)

    @cached_property
    def _surfaces(self) -> tuple[LiquidSurface, ...]:
        return moving_surfaces(self.liquid, waves=self.tank.top == "free")

    @cached_property
    def plates(self) -> dict[ClassParity, tuple[PlanPlate, ...]]:
        """The plates in the shapes of each symmetry."""
        return {
            parity: tuple(
                plan_plate(self.tank, index, number, parity) for index, number in enumerate(self.resolution.polynomials)
            )
            for parity in mirrored_classes(self.mirrors)
        }

    def pencil(self, parity: ClassParity, solver_of: SolverOf) -> CoupledPencil[LiquidSpace] | None:
        """Return the problem of a symmetry, ``None`` where nothing moves in it (collective)."""
        odd = tuple(name for name, own in zip(MIRRORS, parity, strict=True) if own == 1)
        liquid = replace(self.liquid, zero_potential=(*self.liquid.zero_potential, *odd))
        floats = tuple(
            float_body(solid, body_name(number), parity)
            for number, solid in enumerate(self.tank.floats, len(self.tank.plates) + 1)
        )
        return volume_pencil(
            liquid, self._matrices, self.plates[parity], floats, solver_of, surfaces=self._surfaces, images=self.images
        )

    def pencils(self, solver_of: SolverOf) -> dict[ClassParity, CoupledPencil]:
        """Return the problems in which something moves (collective)."""
        found = {parity: self.pencil(parity, solver_of) for parity in mirrored_classes(self.mirrors)}
        return {parity: pencil for parity, pencil in found.items() if pencil is not None}
