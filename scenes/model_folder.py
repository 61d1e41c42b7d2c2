"""Scenes that name files beside their own."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pydantic import PrivateAttr

from hydroelastic.scenes.model_bodies import SceneModel


class SceneInFolder(SceneModel):
    """A scene that keeps the folder of its file, from which it finds tables and other scenes."""

    _folder: Path = PrivateAttr(default=Path())

    def model_post_init(self, context: Any) -> None:
        """Keep the folder that the reader of a scene file gives."""
        if context is not None:
            self._folder = context["folder"]

    @property
    def folder(self) -> Path:
        """The folder of the scene file, or the current one."""
        return self._folder
