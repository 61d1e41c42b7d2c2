"""Load shared libraries in a thread, while Python imports what reads a scene: their import keeps Python waiting."""

from __future__ import annotations

import ctypes
import os
import sys
from contextlib import suppress
from importlib.machinery import EXTENSION_SUFFIXES
from importlib.util import find_spec
from pathlib import Path
from sysconfig import get_config_var
from threading import Thread

from hydroelastic.scenes.program import RANK_VARIABLES

MPI = "mpi4py.MPI"
"""The longest to load: Open MPI's library for Omni-Path sleeps for a tenth of a second to measure the processor."""
DOLFINX = "dolfinx.cpp"
GMSH = "gmsh"

# UCX, which comes with many MPIs, would rewrite functions of libc and move the end of the heap, to see that it learns
# of it, while other threads use both: one run in a hundred crashed. It is for network cards, between processes.
_MEMORY_EVENTS = "UCX_MEM_EVENTS"


def load_early(*modules: str) -> None:
    """Begin to load the libraries of modules, one after the other; an import of them waits until they are loaded.

    What is not found is left to the import, which tells. One of several processes that MPI has started loads nothing.

    Args:
        modules: any of `MPI`, `DOLFINX` and `GMSH`.
    """
    missing = [module for module in modules if module not in sys.modules]
    if missing and not os.environ.keys() & set(RANK_VARIABLES):
        os.environ.setdefault(_MEMORY_EVENTS, "no")
        # Not a daemon: the process must not end within `dlopen`. Where no thread may be started, nothing is lost.
        with suppress(RuntimeError):
            Thread(target=_load, args=missing).start()


def _load(*modules: str) -> None:
    # Some systems have no `dlopen` in the library of C, or packages that cannot be searched.
    with suppress(OSError, AttributeError, TypeError, ValueError):
        # Called as any function of C, it lets Python go on; `ctypes.CDLL` does not.
        dlopen = ctypes.CDLL(None).dlopen
        for module in modules:
            library = _library_of_gmsh() if module == GMSH else _compiled(*module.split("."))
            if library is not None:
                dlopen(library.encode(), ctypes.c_int(os.RTLD_NOW))


def _compiled(package: str, module: str) -> str | None:
    """The file of a compiled module. The package is not imported, and variants for other libraries are not taken."""
    spec = find_spec(package)
    folders = () if spec is None else spec.submodule_search_locations or ()
    files = (Path(folder, f"{module}{suffix}") for folder in folders for suffix in EXTENSION_SUFFIXES)
    return next((str(file) for file in files if file.is_file()), None)


def _library_of_gmsh() -> str | None:
    """The library that gmsh's module will find, around it or in the system's folder, if there is only one."""
    spec = find_spec(GMSH)
    if spec is None or spec.origin is None:
        return None
    above = Path(spec.origin).resolve().parents[:3]
    folders = (*above, *(folder / "lib" for folder in above), Path(get_config_var("LIBDIR") or "/usr/lib"))
    found = {file.resolve() for folder in folders for file in folder.glob("libgmsh.so*")}
    return str(found.pop()) if len(found) == 1 else None
