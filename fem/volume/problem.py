"""The problem of a symmetry class of a volume, as the common solution of tanks in three dimensions has it."""

from __future__ import annotations

from dataclasses import dataclass

from hydroelastic.fem.plan.classes import ClassProblem
from hydroelastic.fem.volume.model import VolumeModel


@dataclass(frozen=True, kw_only=True)
class VolumeProblem(ClassProblem):
    """A symmetry class of a volume, whose modes are sampled on its mesh; see `fem.volume.samples`.

    Attributes:
        model: the tank in its resolution.
    """

    model: VolumeModel
