"""The exponential float of infinite draught compared with that of a scene, which ends at its tail."""

from __future__ import annotations

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.floats.infinite_draught import InfiniteDraughtFloat, infinite_draught_float
from hydroelastic.modal.floats.open_float import lone_profile
from hydroelastic.modal.floats.thin_float_radiation import is_deep
from hydroelastic.modal.tank_estimates import two_layers
from hydroelastic.scenes.models.open_analyses import Decay, Resonance
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank_parts import TankParts


def infinite_draught_comparison(scene: TankParts) -> InfiniteDraughtFloat | None:
    """Return the float of infinite draught for a single exponential released in infinitely deep liquids; else
    ``None``."""
    tank = physical_tank(scene)
    profile, layers = lone_profile(tank), two_layers(tank)
    if profile is None or profile.shape != "exponential" or not is_deep(layers):
        return None
    if not any(isinstance(analysis, Decay | Resonance) for analysis in scene.analyses):
        return None
    try:
        return infinite_draught_float(profile, layers)
    except NoEstimateError:
        return None
