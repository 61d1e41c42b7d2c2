"""The thin-float theory's estimates of the floats of a tank."""

from __future__ import annotations

from hydroelastic.modal.floats.estimates import FloatEstimate, all_float_estimates
from hydroelastic.modal.floats.in_tank import FloatInTank
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.modal.tank_estimates import two_layers
from hydroelastic.physics.floats import RigidFloat
from hydroelastic.physics.tank import Tank


def float_estimates(tank: Tank) -> dict[int, dict[str, FloatEstimate]]:
    """Estimates of heave, by name, of every float that heaves at the lowest level, as if alone, by its index."""
    if len(tank.layers) == 1 and tank.top != "free":
        # The theories of one liquid know its free surface only.
        return {}
    layers, lowest = two_layers(tank), tank.levels[0].name
    return {
        index: all_float_estimates(_float_in_tank(tank, layers, body))
        for index, body in tank.floats.items()
        if "heave" in body.motions and body.level == lowest
    }


def _float_in_tank(tank: Tank, layers: TwoLayers, body: RigidFloat) -> FloatInTank:
    rest = body.hydrostatics
    return FloatInTank(
        layers=layers,
        tank_length=tank.length,
        position=0.5 * sum(rest.waterplane),
        mass=rest.mass,
        stiffness=float(body.stiffness[0, 0]),
        profile=body.hull.profile if rest.reference_level == rest.level else None,
    )
