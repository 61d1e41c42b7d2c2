"""The thin-float theory's estimates of the floats of a tank, with the paper's constants as printed beside them."""

from __future__ import annotations

from dataclasses import dataclass

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.floats.estimates import FloatEstimate, all_float_estimates
from hydroelastic.modal.floats.in_tank import FloatInTank
from hydroelastic.modal.floats.thin_float_paper import PrintedAndCorrected, printed_constants
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.modal.tank_estimates import two_layers
from hydroelastic.physics.floats import RigidFloat
from hydroelastic.physics.tank import Tank


@dataclass(frozen=True, kw_only=True)
class EstimatesOfFloat:
    """What the theories say of one float.

    Attributes:
        heave: estimates of the natural frequency of heave, by name.
        printed: the paper's constants as printed and corrected, by name; empty where it has none.
    """

    heave: dict[str, FloatEstimate]
    printed: dict[str, PrintedAndCorrected]


def float_estimates(tank: Tank) -> dict[int, EstimatesOfFloat]:
    """Estimates of every float that heaves at the lowest level, as if it were alone in the tank, by its index."""
    if len(tank.layers) == 1 and tank.top != "free":
        # The theories of one liquid know its free surface only.
        return {}
    layers, lowest = two_layers(tank), tank.levels[0].name
    found = {}
    for index, body in tank.floats.items():
        if "heave" in body.motions and body.level == lowest:
            floating = _float_in_tank(tank, layers, body)
            found[index] = EstimatesOfFloat(heave=all_float_estimates(floating), printed=_printed(floating))
    return found


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


def _printed(floating: FloatInTank) -> dict[str, PrintedAndCorrected]:
    if floating.profile is None or not floating.layers.density_above:
        return {}
    try:
        return printed_constants(floating.profile, floating.layers)
    except NoEstimateError:
        # The paper has constants of its own shape only.
        return {}
