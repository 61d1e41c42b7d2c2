"""The problem of a volume, as the common solution of level tanks has it."""

from __future__ import annotations

from dataclasses import dataclass

from hydroelastic.fem.level_bed.solution import SampledSurface
from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.fem.modes import Mode, ModeSet
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.plan.classes import SymmetryClass
from hydroelastic.fem.volume.model import VolumeModel
from hydroelastic.physics.arrays import FloatArray


@dataclass(frozen=True, kw_only=True)
class VolumeProblem:
    """A tank on its volume; see `PlanProblem`.

    Attributes:
        symmetry_class: its problem and modes.
        model: the tank in its resolution.
    """

    symmetry_class: SymmetryClass
    model: VolumeModel

    @property
    def order(self) -> int | None:
        """Orders are not separated."""
        return None

    @property
    def symmetry(self) -> str:
        """Name of the symmetry."""
        return self.symmetry_class.label

    @property
    def multiplicity(self) -> int:
        """Frequencies are single, but for chance."""
        return 1

    @property
    def pencil(self) -> CoupledPencil[LiquidSpace]:
        """Its matrices."""
        return self.symmetry_class.pencil

    @property
    def modes(self) -> ModeSet:
        """Its lowest modes."""
        return self.symmetry_class.modes

    def sampled(self, mode: Mode, x: FloatArray, y: FloatArray, *, second: bool) -> SampledSurface:
        """Modes of a volume are sampled on its mesh, see `fem.volume.samples`."""
        raise NotImplementedError
