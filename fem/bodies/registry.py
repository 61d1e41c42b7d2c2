"""The model of each body of a tank, and estimates of their frequencies."""

from __future__ import annotations

from hydroelastic.fem.bodies.model import BodyModel
from hydroelastic.physics.round_plates import RoundPlate
from hydroelastic.physics.tank import Tank


def body_model(tank: Tank, index: int) -> BodyModel:
    """Return the model of a body of a scaled tank."""
    if isinstance(tank.bodies[index], RoundPlate):
        from hydroelastic.fem.bodies.round_plate import RoundPlateModel

        return RoundPlateModel(tank=tank, index=index)
    if tank.bodies[index].is_elastic:
        from hydroelastic.fem.bodies.beam import BeamModel

        return BeamModel(tank=tank, index=index)
    # Contours need SciPy's root finders, which take a while to import.
    from hydroelastic.fem.bodies.rigid_float import FloatModel

    return FloatModel(tank=tank, index=index)


def expected_tones(tank: Tank) -> tuple[float, ...]:
    """Estimate the dimensionless λ of the first elastic tone of each elastic body."""
    return tuple(tone for index in range(len(tank.bodies)) for tone in body_model(tank, index).expected_tones())


def toned_bodies(tank: Tank) -> tuple[int, ...]:
    """Return the indices of the elastic bodies whose first elastic tone is one of the tank's order."""
    return tuple(index for index in tank.elastic if body_model(tank, index).has_tone)


def ends_of_motions(tank: Tank) -> tuple[float, ...]:
    """Return the dimensionless λ up to which the modes of the motions of all bodies are sought."""
    return tuple(end for index in range(len(tank.bodies)) for end in body_model(tank, index).ends_of_motions())
