"""Scenes that a test writes."""

from pathlib import Path
from typing import Any

import pytest

import hydroelastic as he

BEAM_IN_TANK = """
kind = "tank"
[tank]
length = 10.0
[[liquid]]
density = 1000.0
depth = 5.0
[[body]]
start = 3.0
length = 4.0
flexural_rigidity = 5e3
mass_per_length = 50.0
"""

CIRCLE_IN_OPEN_WATER = """
kind = "tank"
[tank]
length = 10.0
ends = "open"
[[liquid]]
density = 1000.0
depth = inf
[[body]]
kind = "float"
shape = "ellipse"
position = 5.0
half_width = 0.5
half_height = 0.5
"""


def read_written(folder: Path, text: str) -> Any:
    """Write the text of a scene into a folder and read it."""
    file = folder / "scene.toml"
    file.write_text(text, encoding="utf-8")
    return he.read(file)


def refused(folder: Path, text: str) -> str:
    """Return what is said of the text of a scene that is refused."""
    with pytest.raises(he.SceneError) as error:
        read_written(folder, text)
    return str(error.value)
