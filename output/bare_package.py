"""Import a part of a library without what else the library imports: of the many formats of SciPy and of meshio one each
is written."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from importlib.util import find_spec
from types import ModuleType
from typing import Any


@contextmanager
def bare_package(name: str) -> Iterator[None]:
    """Let imports of modules of a package, within the block, leave out its own ``__init__.py``.

    Afterwards it can be imported as usual. Where it is imported already nothing changes.

    Args:
        name: of the package.

    Raises:
        ModuleNotFoundError: if there is no such package.
    """
    if name in sys.modules:
        yield
        return
    spec = find_spec(name)
    if spec is None or spec.submodule_search_locations is None:
        raise ModuleNotFoundError(f"No package named {name!r}", name=name)
    package = sys.modules[name] = ModuleType(name)
    package.__path__ = list(spec.submodule_search_locations)
    try:
        yield
    finally:
        del sys.modules[name]


@contextmanager
def imported_when_called(module: str, name: str) -> Iterator[None]:
    """Let imports of a class, within the block, give a function that imports its module when it is called.

    Where the module is imported already nothing changes.

    Args:
        module: that has the class.
        name: of the class.
    """
    if module in sys.modules:
        yield
        return
    stand_in = sys.modules[module] = ModuleType(module)
    setattr(stand_in, name, lambda *values, **named: _called(module, name, *values, **named))
    try:
        yield
    finally:
        del sys.modules[module]


def _called(module: str, name: str, *values: Any, **named: Any) -> Any:
    return getattr(import_module(module), name)(*values, **named)
