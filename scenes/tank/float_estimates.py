"""The thin-float theory's estimates of a scene's floats, with the paper's constants as printed beside them."""

from __future__ import annotations

from dataclasses import dataclass

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.floats.estimates import FloatEstimate, all_float_estimates
from hydroelastic.modal.floats.in_tank import FloatInTank
from hydroelastic.modal.floats.thin_float_paper import PrintedAndCorrected, printed_constants
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.scenes.models.floats import float_section, placed_float
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.tank.estimates import two_layers


@dataclass(frozen=True, kw_only=True)
class EstimatesOfFloat:
    """What the theories say of one float.

    Attributes:
        heave: estimates of the natural frequency of heave, by name.
        printed: the paper's constants as printed and corrected, by name; empty where it has none.
    """

    heave: dict[str, FloatEstimate]
    printed: dict[str, PrintedAndCorrected]


def float_estimates(scene: TankScene) -> dict[int, EstimatesOfFloat]:
    """Estimates of every float that heaves at the lowest level, as if it were alone in the tank, by its index."""
    if len(scene.layers) == 1 and scene.top != "free":
        # The theories of one liquid know its free surface only.
        return {}
    layers = two_layers(scene)
    lowest = "surface" if len(scene.layers) == 1 else "interface"
    found = {}
    for index, body in scene.floats:
        if "heave" in body.motions and scene.level_of(body) == lowest:
            floating = _float_in_tank(scene, layers, index)
            found[index] = EstimatesOfFloat(heave=all_float_estimates(floating), printed=_printed(floating))
    return found


def _float_in_tank(scene: TankScene, layers: TwoLayers, index: int) -> FloatInTank:
    rest = placed_float(scene, index).hydrostatics
    body = dict(scene.floats)[index]
    at_reference_level = rest.reference_level == rest.level
    return FloatInTank(
        layers=layers,
        tank_length=scene.tank.length,
        position=0.5 * sum(rest.waterplane),
        mass=rest.mass,
        stiffness=rest.heave_stiffness,
        profile=float_section(body) if at_reference_level else None,
    )


def _printed(floating: FloatInTank) -> dict[str, PrintedAndCorrected]:
    if floating.profile is None or not floating.layers.density_above:
        return {}
    try:
        return printed_constants(floating.profile, floating.layers)
    except NoEstimateError:
        # The paper has constants of its own shape only.
        return {}
