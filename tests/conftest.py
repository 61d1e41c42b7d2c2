"""Fixtures of more than one test file."""

from typing import Any

import pytest


@pytest.fixture(scope="session")
def tanks() -> Any:
    """The tanks of `tanks.py`, each solved once; imported here because most tests need no dolfinx."""
    from tanks import Tanks

    return Tanks()
