"""Fixtures of more than one test file."""

from collections.abc import Iterator
from typing import Any

import pytest


@pytest.fixture(scope="session")
def tanks() -> Any:
    """The tanks of `tanks.py`, each solved once; imported here because most tests need no dolfinx."""
    from tanks import Tanks

    return Tanks()


@pytest.fixture(scope="module")
def canvas() -> Iterator[Any]:
    """What renders pictures; where nothing can render, a test that asks for it is skipped."""
    from hydroelastic.output.pictures.rendering import Canvas, NoRendererError

    try:
        opened = Canvas()
    except NoRendererError as error:
        pytest.skip(str(error))
    with opened:
        yield opened
