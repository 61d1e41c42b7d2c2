"""Hydroelastic field solver: ``import hydroelastic as he``.

    scene = he.read("aquarium", {"body.1.length": 3.0})
    result = he.solve(scene)
    print(result)
    result.save("results/shorter_beam")

Scenes are read from files or made of keywords, lists and dictionaries, with the keys of scene files::

    scene = he.TankScene(
        tank={"length": 10.0},
        liquid=[{"density": 1000.0, "depth": 5.0}],
        body=[{"kind": "beam", "start": 3.0, "length": 4.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0}],
    )

The names below are imported when they are first used: ``import hydroelastic`` imports no other library.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hydroelastic.fem.pictures.options import PictureOptions
    from hydroelastic.scenes.errors import SceneError, UnsolvedError
    from hydroelastic.scenes.models import (
        Accuracy,
        Beam,
        Float,
        Liquid,
        RollScene,
        StringScene,
        Tank,
        TankScene,
        ThreadScene,
    )
    from hydroelastic.scenes.read import read_scene as read
    from hydroelastic.scenes.read import shipped_scenes
    from hydroelastic.scenes.result import Result, load, solve

_MODELS = ("Accuracy", "Beam", "Float", "Liquid", "RollScene", "StringScene", "Tank", "TankScene", "ThreadScene")
_PLACES = {
    "read": "scenes.read:read_scene",
    "shipped_scenes": "scenes.read:shipped_scenes",
    **{name: f"scenes.result:{name}" for name in ("solve", "load", "Result")},
    **{name: f"scenes.models:{name}" for name in _MODELS},
    **{name: f"scenes.errors:{name}" for name in ("SceneError", "UnsolvedError")},
    "PictureOptions": "fem.pictures.options:PictureOptions",
}


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    module, _, there = _PLACES[name].partition(":")
    return getattr(import_module(f"{__name__}.{module}"), there)


def __dir__() -> list[str]:
    return sorted({*globals(), *_PLACES})
