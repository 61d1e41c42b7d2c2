"""Typed, frozen, validated scenes. The names below are imported when they are first used: a scene needs few of them."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hydroelastic.scenes.models.bodies import Beam, Float
    from hydroelastic.scenes.models.open_analyses import Decay, Radiation, Resonance, Response
    from hydroelastic.scenes.models.roll import RollScene
    from hydroelastic.scenes.models.sea import SeaScene
    from hydroelastic.scenes.models.sea_states import Spectrum
    from hydroelastic.scenes.models.string import StringScene
    from hydroelastic.scenes.models.tank import TankScene
    from hydroelastic.scenes.models.tank_parts import Accuracy, Liquid, MeshFile, Tank
    from hydroelastic.scenes.models.thread import ThreadScene

__all__ = [
    "Accuracy",
    "Beam",
    "Decay",
    "Float",
    "Liquid",
    "MeshFile",
    "Radiation",
    "Resonance",
    "Response",
    "RollScene",
    "SeaScene",
    "Spectrum",
    "StringScene",
    "Tank",
    "TankScene",
    "ThreadScene",
]

_FILES = {
    **dict.fromkeys(("Beam", "Float"), "bodies"),
    **dict.fromkeys(("Decay", "Radiation", "Resonance", "Response"), "open_analyses"),
    **dict.fromkeys(("Accuracy", "Liquid", "MeshFile", "Tank"), "tank_parts"),
    **{f"{kind.title()}Scene": kind for kind in ("tank", "sea", "string", "thread", "roll")},
    "Spectrum": "sea_states",
}


def __getattr__(name: str) -> Any:
    if name not in _FILES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"{__name__}.{_FILES[name]}"), name)
