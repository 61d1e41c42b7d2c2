"""Fixtures of more than one test file."""

from typing import Any

import pytest


@pytest.fixture(scope="session")
def tanks() -> Any:
    """The tanks of `tanks.py`, each solved once; imported here because most tests need no dolfinx."""
    from tanks import Tanks

    return Tanks()


@pytest.fixture(scope="session")
def renderer() -> None:
    """Where nothing can render fields, a test that asks for it is skipped."""
    from hydroelastic.output.pictures.rendering import NoRendererError, open_plotter

    try:
        open_plotter()
    except NoRendererError as error:
        pytest.skip(str(error))
