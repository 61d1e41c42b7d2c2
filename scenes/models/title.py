"""The title of a scene: one line of printable text."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import AfterValidator, Strict

from hydroelastic.scenes.models.problems import problem


def _on_one_line(title: str) -> str:
    if not title.isprintable():
        raise problem("it holds a line break or another character that cannot be shown", allowed="one line")
    return title


Title: TypeAlias = Annotated[str, Strict(), AfterValidator(_on_one_line)]
