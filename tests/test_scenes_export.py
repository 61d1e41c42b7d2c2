"""What a scene needs for files of other programs."""

from typing import Any

import pytest
from hydrodynamic_bodies import BEAM, scene

from hydroelastic.scenes.errors import SceneError

EXPORT = {"formats": ["wamit"], "width": 3.0}
IMPULSE = {"kind": "impulse_response", "times": [0.0, 1.0, 2.0]}
OF_RADIATION: dict[str, Any] = {"kind": "radiation", "omega": [0.5, 1.0]}
DISC = {"kind": "plate", "outline": "disc", "radius": 5.0, "youngs_modulus": 6e9, "thickness": 1.0, "density": 900.0}
DISC |= {"poisson_ratio": 0.3}


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"export": {"formats": ["wamit"]}}, "width"),
        ({"export": EXPORT, "body": [{"kind": "float", "shape": "sphere", "radius": 1.0}]}, "solids of revolution"),
        ({"export": {"formats": ["wamit", "wamit"], "width": 1.0}}, "named twice"),
        ({"export": {"formats": ["hydrostar"], "width": 1.0}}, "formats"),
        ({"export": EXPORT, "analysis": []}, "analysis of radiation"),
        ({"export": EXPORT, "liquid": [{"density": 1025.0, "depth": 3.0}, {"density": 1.2, "depth": 5.0}]}, "two"),
        ({"export": {"formats": ["wamit"]}, "body": [DISC]}, "a plate is neither"),
        (
            {"export": EXPORT, "body": [BEAM], "analysis": [OF_RADIATION, OF_RADIATION | {"elastic_modes": 2}]},
            "different elastic_modes",
        ),
        ({"export": EXPORT | {"formats": ["bemio"]}}, "impulse responses at equally spaced times"),
        (
            {"export": EXPORT | {"formats": ["nemoh"]}, "analysis": [{"kind": "radiation", "omega": [0.5, 1.0, 2.0]}]},
            "equally spaced",
        ),
    ],
)
def test_what_files_need_is_asked_for(changes: dict[str, Any], words: str) -> None:
    with pytest.raises(SceneError, match=words):
        scene(**changes)


def test_all_files_are_possible() -> None:
    asked = scene(
        export={"formats": ["wamit", "bemio", "nemoh", "capytaine"], "width": 3.0},
        analysis=[{"kind": "radiation", "omega": [0.5, 1.0, 1.5]}, IMPULSE],
    )
    assert asked.export is not None
    assert asked.export.width == 3.0
    assert "export" not in scene().model_dump()
