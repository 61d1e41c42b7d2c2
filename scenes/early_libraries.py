"""Load shared libraries in a thread, while Python reads the scene: it keeps all others waiting when it loads them."""

from __future__ import annotations

import ctypes
import os
from ctypes.util import find_library
from importlib.util import find_spec
from pathlib import Path
from threading import Thread

GMSH = "gmsh"
MPI = "mpi4py/MPI"
"""Open MPI's library for Omni-Path sleeps for a tenth of a second, to measure the clock of the processor."""
DOLFINX = "dolfinx/cpp"


def load_early(*names: str) -> None:
    """Begin to load libraries, one after the other; a later import of them waits until they are there.

    What is not found is left to its import, which tells.

    Args:
        names: of libraries of the system, or of compiled modules as package/module.
    """
    Thread(target=_load, args=names).start()


def _load(*names: str) -> None:
    # Called as a function of the library of C, it lets others run; `ctypes.CDLL` does not.
    dlopen = ctypes.CDLL(None).dlopen
    for name in names:
        file = _file(name)
        if file is not None:
            dlopen(file.encode(), ctypes.c_int(os.RTLD_NOW))


def _file(name: str) -> str | None:
    package, _, module = name.partition("/")
    if not module:
        return find_library(name)
    spec = find_spec(package)
    folders = () if spec is None else spec.submodule_search_locations or ()
    return next((str(file) for folder in folders for file in Path(folder).glob(f"{module}.*.so")), None)
