"""Fixtures of more than one test file."""

import importlib.util
from pathlib import Path
from typing import Any

import pytest


@pytest.fixture(scope="session")
def tanks() -> Any:
    """The tanks of `tanks.py`, each solved once; loaded here because most tests need no dolfinx."""
    spec = importlib.util.spec_from_file_location("tanks", Path(__file__).with_name("tanks.py"))
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.Tanks()
