"""The endless float of the paper beside the one of a scene, which ends where its tail says."""

from __future__ import annotations

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.floats.endless_float import EndlessFloat, endless_float
from hydroelastic.modal.floats.open_float import lone_profile
from hydroelastic.modal.floats.thin_float_radiation import is_deep
from hydroelastic.modal.tank_estimates import two_layers
from hydroelastic.scenes.models.open_analyses import Decay, Resonance
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene


def endless_comparison(scene: TankScene) -> EndlessFloat | None:
    """The endless float of the paper beside a lone exponential that is released in endless liquids; else nothing."""
    tank = physical_tank(scene)
    profile, layers = lone_profile(tank), two_layers(tank)
    if profile is None or profile.shape != "exponential" or not is_deep(layers):
        return None
    if not any(isinstance(analysis, Decay | Resonance) for analysis in scene.analyses):
        return None
    try:
        return endless_float(profile, layers)
    except NoEstimateError:
        return None


def endless_words(endless: EndlessFloat) -> str:
    """How far the endless float is, in words."""
    return (
        "The float ends where the scene's tail says. After a release it differs from the endless one of the paper by "
        f"up to about {endless.cut:.1g} of the displacement at first, which no estimated error of the field solution "
        "holds: that is of the float with its end. A smaller tail brings them together."
    )
