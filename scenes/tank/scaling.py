"""Scenes in units of the tank: L = ρ = g = 1, so that metres and millimetres give the same digits."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt

from hydroelastic.scenes.models.bodies import Beam, BeamJoint
from hydroelastic.scenes.models.tank import TankScene


@dataclass(frozen=True, kw_only=True)
class Scales:
    """Units of the dimensionless model.

    Attributes:
        length: the tank's length, m.
        density: ρ, kg/m³.
        gravity: g, m/s².
    """

    length: float
    density: float
    gravity: float

    @property
    def frequency(self) -> float:
        """Unit of ω, rad/s."""
        return sqrt(self.gravity / self.length)

    @property
    def mass_per_length(self) -> float:
        """Unit of mass per length and metre of width, kg/m²."""
        return self.density * self.length

    @property
    def flexural_rigidity(self) -> float:
        """Unit of EI per metre of width, N·m."""
        return self.density * self.gravity * self.length**4

    @property
    def rotational_stiffness(self) -> float:
        """Unit of the stiffness of joints per metre of width, N·m/rad."""
        return self.flexural_rigidity / self.length

    def hertz(self, omega: float) -> float:
        """Frequency in Hz of a dimensionless ω."""
        return omega * self.frequency / (2 * pi)


def scales(scene: TankScene) -> Scales:
    """Units of a scene."""
    return Scales(length=scene.tank.length, density=scene.liquid[0].density, gravity=scene.tank.gravity)


def scaled_beam(beam: Beam, units: Scales, start: float, end: float) -> Beam:
    """The beam in the units of the tank, between the given dimensionless ends."""
    given: dict[str, object] = {"start": start, "joints": _scaled_joints(beam, units)}
    given |= {"hydrostatic": beam.hydrostatic, "ends": beam.ends}
    parts = [
        {
            "length": part.length * ((end - start) / beam.length),
            "flexural_rigidity": part.flexural_rigidity / units.flexural_rigidity,
            "mass_per_length": part.mass_per_length / units.mass_per_length,
        }
        for part in beam.parts
    ]
    return Beam.model_validate(given | ({"sections": parts} if beam.sections else parts[0] | {"length": end - start}))


def _scaled_joints(beam: Beam, units: Scales) -> tuple[BeamJoint, ...]:
    return tuple(
        BeamJoint(
            at=joint.at / units.length,
            rotational_stiffness=joint.rotational_stiffness / units.rotational_stiffness,
        )
        for joint in beam.joints
    )
