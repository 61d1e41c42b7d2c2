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

from hydroelastic.meshes.session_folder import remove_session_folder

remove_session_folder()

if TYPE_CHECKING:
    from hydroelastic.output.plots import PictureOptions
    from hydroelastic.scenes.errors import SceneError, UnsolvedError
    from hydroelastic.scenes.models import (
        Accuracy,
        Beam,
        Float,
        Liquid,
        RollScene,
        SeaScene,
        StringScene,
        Tank,
        TankScene,
        ThreadScene,
    )
    from hydroelastic.scenes.read import read_scene as read
    from hydroelastic.scenes.read import shipped_scenes
    from hydroelastic.scenes.result import Result, load, solve
    from hydroelastic.scenes.study.result import Study, study
    from hydroelastic.scenes.sweep.result import Sweep, sweep

__all__ = [
    "Accuracy",
    "Beam",
    "Float",
    "Liquid",
    "PictureOptions",
    "Result",
    "RollScene",
    "SceneError",
    "SeaScene",
    "StringScene",
    "Study",
    "Sweep",
    "Tank",
    "TankScene",
    "ThreadScene",
    "UnsolvedError",
    "load",
    "read",
    "shipped_scenes",
    "solve",
    "study",
    "sweep",
]

_ELSEWHERE = {
    "PictureOptions": "output.plots",
    **dict.fromkeys(("Result", "load", "solve"), "scenes.result"),
    **dict.fromkeys(("Study", "study"), "scenes.study.result"),
    **dict.fromkeys(("Sweep", "sweep"), "scenes.sweep.result"),
    **dict.fromkeys(("SceneError", "UnsolvedError"), "scenes.errors"),
    **dict.fromkeys(("read", "shipped_scenes"), "scenes.read"),
}
"""Where names come from that are not models of scenes."""


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    module = import_module(f"{__name__}.{_ELSEWHERE.get(name, 'scenes.models')}")
    return getattr(module, "read_scene" if name == "read" else name)


def __dir__() -> list[str]:
    return sorted({*(name for name in globals() if name.startswith("__")), *__all__})
