"""Typed, frozen, validated scenes."""

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
