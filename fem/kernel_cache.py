"""The folder in which dolfinx keeps compiled kernels: written by one process at a time; damaged kernels are removed.

dolfinx marks a kernel as being compiled by its C file, for which other processes wait. The mark of a killed process
stays, and others wait for it in vain. Here a file lock, which ends with its process, is acquired first, and the lock
file records whether a compilation is under way: a process that acquires the lock and finds this record knows that
another one was killed, and removes its files.
"""

from __future__ import annotations

import fcntl
import logging
import os
import time
from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from dolfinx.jit import get_options
from mpi4py import MPI

_LOG = logging.getLogger(__name__)
_LOCK = "hydroelastic.lock"
_COMPILING = "compiling"
# Age, s, after which unfinished files of programs that do not use the lock count as abandoned.
_GIVEN_UP = 60.0
# Time of the last change of each folder when it was last checked.
_looked_at: dict[Path, int] = {}


def cache_folder() -> Path:
    """Return the folder of compiled kernels.

    The launcher gives each environment a cache of its own. Elsewhere other programs, which do not use the lock, compile
    into the folder of dolfinx; ours is a subfolder of it.
    """
    shared = Path(get_options()["cache_dir"])
    return shared if "HYDROELASTIC_INSIDE" in os.environ else shared / "hydroelastic"


@contextmanager
def kernels_locked(comm: MPI.Comm) -> Iterator[None]:
    """Hold the lock on compiled kernels on rank 0, which compiles for all; damaged ones are removed first
    (collective)."""
    # A barrier: no process may wait for the lock on behalf of another communicator while the others wait for it.
    comm.Barrier()
    if comm.rank != 0:
        yield
        return
    folder = cache_folder()
    with _written(folder), (folder / _LOCK).open("a+", encoding="ascii") as lock:
        with suppress(OSError):  # Some network file systems have no locks: dolfinx then waits as it always does.
            fcntl.flock(lock, fcntl.LOCK_EX)
            lock.seek(0)
            _remove_damaged(folder, killed=lock.read() == _COMPILING)
        lock.truncate(0)
        lock.write(_COMPILING)
        lock.flush()
        try:
            yield
        finally:
            lock.truncate(0)


@contextmanager
def _written(folder: Path) -> Iterator[None]:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        yield
    except OSError as error:
        wrong = f"the cache of compiled kernels cannot be written ({error.strerror}); set XDG_CACHE_HOME to another one"
        raise OSError(error.errno, wrong, str(folder)) from error


def _remove_damaged(folder: Path, *, killed: bool) -> None:
    """Remove the files of incomplete kernels; to be called by the holder of the lock only."""
    if not killed and _looked_at.get(folder) == folder.stat().st_mtime_ns:
        return
    kernels = defaultdict(set)
    for file in os.listdir(folder):
        name, dot, ending = file.partition(".")
        if name.startswith("libffcx_"):
            kernels[name].add(dot + ending)
    unfinished = {name for name, endings in kernels.items() if ".c" in endings and ".c.cached" not in endings}
    waited_for = set() if killed else {name for name in unfinished if _age(folder / f"{name}.c") < _GIVEN_UP}
    finished = kernels.keys() - unfinished
    broken = {name for name in finished if not _is_whole(kernels[name])}
    damaged = (unfinished - waited_for) | broken
    for name in damaged:
        for ending in kernels[name]:
            (folder / f"{name}{ending}").unlink()
    if damaged:
        _LOG.warning("hydroelastic: %d unfinished or damaged kernels in %s are compiled anew", len(damaged), folder)
    if not waited_for:
        _looked_at[folder] = folder.stat().st_mtime_ns


def _age(file: Path) -> float:
    return time.time() - file.stat().st_mtime


def _is_whole(endings: set[str]) -> bool:
    """Whether a finished kernel can be loaded, or no file prevents its compilation."""
    libraries = [ending for ending in endings if ending.endswith(".so")]
    if not libraries and ".c.cached" not in endings:
        return True
    return bool(libraries) and {".c", ".c.cached"} <= endings
