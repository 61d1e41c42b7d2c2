"""Import a module of a package without the rest of the package: of SciPy's and meshio's many formats one is written."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from types import ModuleType


@contextmanager
def bare_package(name: str) -> Iterator[None]:
    """Let imports within the block run nothing of a package's own ``__init__.py``; afterwards it can be imported as usual.

    Where it is imported already nothing changes.

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
