"""The journal of a sweep: each solved point is a line of a file, so that an interrupted sweep goes on where it was."""

from __future__ import annotations

import contextlib
import fcntl
import json
import os
from collections.abc import Iterator
from pathlib import Path

from mpi4py import MPI

from hydroelastic.output.folder import check_output, list_files, written_by_run
from hydroelastic.scenes.errors import Problem, SceneError, folder_errors
from hydroelastic.scenes.sweep.point import SolvedPoint

JOURNAL = "sweep.journal"


class Journal:
    """Points by their keys, see `point_key`; points of other sweeps in the same file stay there, and are not used."""

    def __init__(self, descriptor: int | None = None, file: Path | None = None) -> None:
        """Read an open file to its end; without one, keep the points in memory only."""
        self._descriptor, self._file = descriptor, file
        self._points: dict[str, SolvedPoint] = {}
        if descriptor is None:
            return
        with open(descriptor, "rb", closefd=False) as lines:
            for line in lines:
                # A killed process may leave half a line, which may end within a character.
                with contextlib.suppress(ValueError, LookupError, TypeError, AttributeError, RecursionError):
                    entry = json.loads(line)
                    self._points[entry["key"]] = SolvedPoint.from_json(entry["point"])

    def __contains__(self, key: str) -> bool:
        return key in self._points

    def __getitem__(self, key: str) -> SolvedPoint:
        return self._points[key]

    def share(self) -> None:
        """Give all processes the points that the first one has read (collective)."""
        self._points = MPI.COMM_WORLD.bcast(self._points)

    def add(self, key: str, point: SolvedPoint) -> None:
        """Keep a point; what is on disk outlives this process."""
        self._points[key] = point
        if self._descriptor is None:
            return
        line = f"\n{json.dumps({'key': key, 'point': point.as_json()}, ensure_ascii=False)}".encode()
        try:
            # On a disk that becomes full a part is written.
            while line:
                line = line[os.write(self._descriptor, line) :]
        except OSError as error:
            wrong = f"a point that is solved cannot be written ({error.strerror})"
            remedy = "Make room, and start the sweep again: the points before it are kept"
            raise SceneError(Problem(key=f"journal {self._file}", wrong=wrong, remedy=remedy)) from error


@contextlib.contextmanager
def open_journal(folder: Path | None, *, scene_file: Path | None) -> Iterator[Journal]:
    """Open the journal in a result folder, and lock it for this sweep alone."""
    if folder is None:
        yield Journal()
        return
    with folder_errors():
        check_output(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if written_by_run(folder) is None:
            # It marks the folder as one of results.
            list_files(folder, scene_file=scene_file, place=Path(os.path.realpath(folder)))
        descriptor = os.open(folder / JOURNAL, os.O_RDWR | os.O_APPEND | os.O_CREAT, 0o666)
    except OSError as error:
        wrong = f"it cannot be written ({error.strerror})"
        problem = Problem(key=f"output folder {folder}", wrong=wrong, remedy="Name another folder")
        raise SceneError(problem) from error
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            problem = Problem(
                key=f"output folder {folder}",
                wrong="another sweep is writing into it",
                remedy="Wait for its end, or name another folder",
            )
            raise SceneError(problem) from error
        except OSError:  # Some network file systems have no locks.
            pass
        yield Journal(descriptor, folder / JOURNAL)
    finally:
        os.close(descriptor)
