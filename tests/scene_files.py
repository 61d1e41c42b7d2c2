"""Scenes that a test writes."""

from pathlib import Path

from hydroelastic.scenes.read import Scene, read_scene


def read_written(folder: Path, text: str) -> Scene:
    """Write the text of a scene into a folder and read it."""
    file = folder / "scene.toml"
    file.write_text(text, encoding="utf-8")
    return read_scene(file)
