"""Products of a long eigenproblem's operator, kept in files, so that a run that is killed goes on where it ended.

The eigen-solver, from the same start vector, asks for the same products again. Those of an earlier run are read, at
the cost of no solution of Laplace's equation, as long as the vectors agree; from the first one that does not on, they
are made. With them the resolution is kept, so that coarser ones need not be solved first.
"""

from __future__ import annotations

import fcntl
import json
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path
from typing import Any

from mpi4py import MPI
from petsc4py import PETSc

from hydroelastic.fem.added_mass import Operator
from hydroelastic.fem.kernel_cache import cache_folder

_STATE = "state.json"
# Largest relative difference of vectors that are one; processes sum in different orders.
_SAME = 1e-9


class Checkpoint:
    """What is known of an unfinished run; rank 0 reads and writes the files.

    Attributes:
        state: what was kept last, in types of JSON; ``None`` of a new run.
        read: number of products that were read.
    """

    def __init__(self, folder: Path, comm: MPI.Comm) -> None:
        """Read the state of an unfinished run, if there is one (collective)."""
        self._folder, self._comm, self._number, self.read = folder, comm, 0, 0
        self.state: Any = None
        self._kept = 0
        if comm.rank == 0:
            file = folder / _STATE
            self.state = json.loads(file.read_text(encoding="utf-8")) if file.exists() else None
            self._kept = next(number for number in range(10**6) if not self._file(number).exists())
        self.state, self._kept = comm.bcast((self.state, self._kept))

    def begin(self, state: Any) -> None:
        """Keep the state of what is solved next; products are those of an earlier run only if it had the same."""
        state, self._number = json.loads(json.dumps(state)), 0
        if state == self.state:
            return
        self.state, self._kept = state, 0
        if self._comm.rank == 0:
            for file in self._folder.glob("*.products"):
                file.unlink()
            part = self._folder / f"{_STATE}.part"
            part.write_text(json.dumps(state), encoding="utf-8")
            part.rename(self._folder / _STATE)

    def of(self, operator: Operator) -> Operator:
        """Return an operator whose products are read, or made and kept."""
        return _Kept(self, operator)

    def product(self, operator: Operator, vector: PETSc.Vec, result: PETSc.Vec) -> None:
        """``result`` ← product of the operator with ``vector`` (collective)."""
        number, self._number = self._number, self._number + 1
        if number < self._kept and self._is_read(self._file(number), vector, result):
            self.read += 1
            return
        self._kept = 0
        operator.mult(None, vector, result)
        part = self._folder / "part"
        viewer = PETSc.Viewer().createBinary(str(part), "w", comm=vector.comm)
        vector.view(viewer)
        result.view(viewer)
        viewer.destroy()
        if self._comm.rank == 0:
            # Whole or not at all.
            part.rename(self._file(number))

    def _is_read(self, file: Path, vector: PETSc.Vec, result: PETSc.Vec) -> bool:
        kept = vector.duplicate()
        viewer = PETSc.Viewer().createBinary(str(file), "r", comm=vector.comm)
        kept.load(viewer)
        kept.axpy(-1.0, vector)
        same = kept.norm() <= _SAME * vector.norm()
        if same:
            result.load(viewer)
        viewer.destroy()
        return bool(same)

    def _file(self, number: int) -> Path:
        return self._folder / f"{number:06d}.products"


class _Kept:
    def __init__(self, checkpoint: Checkpoint, operator: Operator) -> None:
        self._checkpoint, self._operator = checkpoint, operator

    def mult(self, _matrix: PETSc.Mat | None, vector: PETSc.Vec, result: PETSc.Vec) -> None:
        """``result`` ← product with ``vector``."""
        self._checkpoint.product(self._operator, vector, result)


@contextmanager
def unfinished_run(problem: str, comm: MPI.Comm) -> Iterator[Checkpoint | None]:
    """Provide what an earlier run of a problem left, and remove it when the block ends without an error (collective).

    Args:
        problem: what is solved, in full.
        comm: the processes; vectors are those of as many processes.

    Yields:
        The checkpoint, or ``None`` where another run of the same problem is under way, or no file can be written.
    """
    name = sha256(f"{comm.size} {problem}".encode()).hexdigest()[:24]
    folder = cache_folder() / "unfinished" / name
    lock = None
    if comm.rank == 0:
        try:
            folder.mkdir(parents=True, exist_ok=True)
            lock = (folder / "lock").open("w", encoding="ascii")
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            lock = None
    if not comm.bcast(lock is not None):
        yield None
        return
    try:
        yield Checkpoint(folder, comm)
        if lock is not None:
            shutil.rmtree(folder, ignore_errors=True)
    finally:
        if lock is not None:
            if not (folder / _STATE).exists():
                # Of a scene that was refused nothing is kept.
                shutil.rmtree(folder, ignore_errors=True)
            lock.close()
