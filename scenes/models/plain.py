"""Values of NumPy as values of Python, which is what the models of scenes take."""

from __future__ import annotations

from typing import Any


def plain(value: Any) -> Any:
    """Return a value with the arrays and numbers of NumPy in it as lists and numbers of Python."""
    if isinstance(value, dict):
        return {key: plain(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [plain(entry) for entry in value]
    return value.tolist() if hasattr(value, "tolist") else value
