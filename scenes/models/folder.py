"""Scenes that name files beside their own."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pydantic import PrivateAttr

from hydroelastic.scenes.models.scene_model import SceneModel


class SceneInFolder(SceneModel):
    """A scene that keeps its file, in whose folder it finds tables and other scenes."""

    _folder: Path = PrivateAttr(default=Path())
    _source: str | None = PrivateAttr(default=None)

    def model_post_init(self, context: Any) -> None:
        """Keep the folder of the scene file and its name in messages."""
        if context is not None:
            self._folder = context["folder"]
            self._source = context.get("source")

    @property
    def folder(self) -> Path:
        """The folder of the scene file, or the current one."""
        return self._folder

    @property
    def source(self) -> str | None:
        """Name of the scene file in messages, with its overrides; ``None`` if there is no file."""
        return self._source
