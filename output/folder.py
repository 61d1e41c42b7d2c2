"""Result folders, written atomically; files that no run wrote are kept.

The files that a run wrote are listed in its ``summary.json``, which is written last: what was modified later is not
its own.
"""

from __future__ import annotations

import contextlib
import errno
import fcntl
import glob
import json
import os
import secrets
import shutil
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hydroelastic.meshes.interrupts import unfinished
from hydroelastic.output.json_values import json_ready

if TYPE_CHECKING:
    from mpi4py import MPI

SUMMARY = "summary.json"
MOST_KEPT_NAMED = 3


class FolderError(Exception):
    """A result folder that cannot be written.

    Args:
        wrong: the error, a phrase that follows the name of the folder.
        folder: the folder; ``None`` on a process that does not write.
        remedy: what to do.
    """

    def __init__(self, wrong: str, folder: str | Path | None = None, remedy: str = "") -> None:
        super().__init__(wrong if folder is None else f"output folder {folder}: {wrong}. {remedy}.")
        self.wrong, self.folder, self.remedy = wrong, folder, remedy


@dataclass(frozen=True, kw_only=True)
class Written:
    """What an earlier run wrote into a result folder: the only files that a later run may replace.

    Attributes:
        scene_file: relative to the folder, so that both may be moved together; empty where the scene came from Python.
        files: paths relative to the folder.
        time: at which the last one was written, ns.
    """

    scene_file: str = ""
    files: tuple[str, ...] = ()
    time: int = 0

    def has(self, folder: Path, name: str) -> bool:
        """Return whether a file of the folder was written by that run and not modified since."""
        path = folder / name
        is_listed = name in self.files and path.is_file() and not path.is_symlink()
        return name == SUMMARY or (is_listed and path.stat().st_mtime_ns <= self.time)

    def path_of_scene(self, folder: Path) -> Path | None:
        """Return the absolute path of the scene file; ``None`` where the scene came from Python."""
        return Path(os.path.normpath(folder.resolve() / self.scene_file)) if self.scene_file else None


def written_by_run(folder: Path) -> Written | None:
    """Return what an earlier run wrote into a folder; ``None`` if there is no such folder or list."""
    try:
        found = json.loads((folder / SUMMARY).read_text(encoding="utf-8"))
        scene_file, files, time = found["scene_file"], found["files"], (folder / SUMMARY).stat().st_mtime_ns
    except (OSError, ValueError, TypeError, LookupError):
        return None
    if not (isinstance(scene_file, str) and isinstance(files, list)):
        return None
    return Written(scene_file=scene_file, files=tuple(files), time=time)


def list_files(folder: Path, *, scene_file: Path | None, place: Path) -> None:
    """List all files of a folder, which will lie at a place, in its ``summary.json``."""
    summary = json.loads((folder / SUMMARY).read_text(encoding="utf-8")) if (folder / SUMMARY).is_file() else {}
    scene = "" if scene_file is None else os.path.relpath(os.path.realpath(scene_file), place)
    write_summary({**summary, "scene_file": scene, "files": _file_names(folder)}, folder)


def _file_names(folder: Path) -> list[str]:
    """All files and links below a folder, as paths relative to it."""
    names = []
    for place, folders, files in os.walk(folder):
        links = [name for name in folders if os.path.islink(os.path.join(place, name))]
        names += [os.path.relpath(os.path.join(place, name), folder) for name in (*files, *links)]
    return sorted(names)


def check_output(path: str | Path) -> Written | None:
    """Check, before solving, that a result folder can be written; leaves no files.

    Temporary folders of killed runs beside the folder are removed.
    """
    try:
        target = Path(os.path.realpath(path))
        _clear_remains(target)
        _refuse_occupied(target)
        if not target.exists():
            # A name that no file system takes: pathlib of Python 3.14 calls it missing and no more.
            with contextlib.suppress(FileNotFoundError):
                os.lstat(target)
        above = next(folder for folder in target.parents if folder.exists())
        with _aside(above / target.name) as aside:
            aside.rmdir()
    except OSError as error:
        raise _unwritable(path, error) from error
    return written_by_run(target)


@contextmanager
def result_folder(path: str | Path, *, scene_file: Path | None = None) -> Iterator[Path]:
    """Provide a folder to write into; when the block ends without an error it becomes ``path``, else it is removed.

    The folder is made beside ``path``, so that moving it is a renaming within one file system. Files that a previous
    run wrote and that were not modified are replaced only then. All other files in ``path`` are kept; where the
    new results have a file of that name, it gets the ending ``.kept``. Exceptions, Ctrl-C and the signals that end a
    job remove what was written. Under MPI only one rank may enter.
    """
    check_output(path)
    target = Path(os.path.realpath(path))
    made = [folder for folder in target.parents if not folder.exists()]
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        with _aside(target) as aside:
            yield aside
            list_files(aside, scene_file=scene_file, place=target)
            _refuse_occupied(target)
            _move_in(aside, target)
    except BaseException as error:
        _remove_if_empty(made)
        if isinstance(error, OSError) and _concerns(error, target.parent):
            raise _unwritable(target, error) from error
        raise


@contextmanager
def _aside(target: Path) -> Iterator[Path]:
    """Provide an empty folder beside another one; it is removed at the end of the block or of the process.

    A shared lock on it, which ends with the process, shows later runs that it is in use.
    """
    aside = target.parent / f".{target.name}.{secrets.token_hex(4)}.partial"
    with unfinished(aside):
        aside.mkdir()
        held = os.open(aside, os.O_RDONLY)
        try:
            with contextlib.suppress(OSError):  # Some network file systems have no locks.
                fcntl.flock(held, fcntl.LOCK_SH)
            # Another run may have removed it as a remainder before it was locked.
            aside.mkdir(exist_ok=True)
            yield aside
        finally:
            shutil.rmtree(aside, ignore_errors=True)
            os.close(held)


def _clear_remains(target: Path) -> None:
    """Remove temporary folders of killed runs beside a folder; undo a move that was interrupted."""
    name = f".{glob.escape(target.name)}.????????"
    for remains in target.parent.glob(f"{name}.previous"):
        if not target.exists():
            remains.rename(target)
    for remains in (*target.parent.glob(f"{name}.partial"), *target.parent.glob(f"{name}.previous")):
        with contextlib.suppress(OSError):
            held = os.open(remains, os.O_RDONLY)
            try:
                fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(remains)
            finally:
                os.close(held)


def _concerns(error: OSError, folder: Path) -> bool:
    """Whether an error comes from writing below ``folder``, and not from other operations of the block."""
    full_or_locked = error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EROFS)
    return full_or_locked or (error.filename is not None and Path(os.fsdecode(error.filename)).is_relative_to(folder))


def _refuse_occupied(target: Path) -> None:
    if target.is_dir():
        if Path.cwd().is_relative_to(target):
            raise _refused(target, "it is the current folder or above it", "Name a folder in it")
        if os.path.ismount(target):
            raise _refused(target, "it is a mount point and cannot be replaced", "Name a folder in it")
        if any(target.iterdir()) and written_by_run(target) is None:
            raise _refused(
                target,
                f"it is not empty and not a result folder: no {SUMMARY} lists files of a run",
                "Name another folder or empty this one",
            )
    elif os.path.lexists(target):
        raise _refused(target, "it is not a folder", "Name another folder")
    above = next(folder for folder in target.parents if folder.exists())
    if not above.is_dir():
        raise _refused(target, f"{above} is not a folder", "Name another folder")


def _move_in(aside: Path, target: Path) -> None:
    """Put the finished folder in place of the previous one, together with files that no run wrote."""
    if not target.exists():
        aside.rename(target)
        return
    earlier = written_by_run(target) or Written()
    found = _file_names(target)
    _keep([name for name in found if not earlier.has(target, name)], target, aside)
    # Between both moves a killed process leaves the old folder under this name, and the next run takes it back; other
    # signals wait. The old folder then has the name of the new one, under which it is removed whatever happens.
    previous = aside.with_suffix(".previous")
    waiting = signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT, signal.SIGTERM, signal.SIGHUP))
    try:
        os.replace(target, previous)
        try:
            os.replace(aside, target)
        except BaseException:
            os.replace(previous, target)
            raise
        os.replace(previous, aside)
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, waiting)
    # Files created since the listing are in the old folder.
    _keep(sorted(set(_file_names(aside)) - set(found)), aside, target)


def _keep(names: list[str], source: Path, target: Path) -> None:
    # Files that keep their name are moved first.
    for name in sorted(names, key=lambda name: os.path.lexists(target / name)):
        _link(source / name, _free_name(target / name))


def _free_name(path: Path) -> Path:
    """The path itself, or the first one with endings ``.kept`` at which there is nothing."""
    while os.path.lexists(path):
        path = path.with_name(f"{path.name}.kept")
    return path


def _link(source: Path, target: Path) -> None:
    """Hard-link a file; copy it where the file system has no hard links."""
    target.parent.mkdir(parents=True, exist_ok=True)
    try:
        os.link(source, target, follow_symlinks=False)
    except OSError:
        shutil.copy2(source, target, follow_symlinks=False)


def results_message(folder: Path, *, replaces: bool) -> str:
    """Return the message about the place of results: earlier files that were replaced, and those that are kept."""
    listed = written_by_run(folder)
    kept = [] if listed is None else sorted(set(_file_names(folder)) - {*listed.files, SUMMARY})
    said = ["replacing earlier ones"] * replaces
    if kept:
        more = f" and {len(kept) - MOST_KEPT_NAMED} more" if len(kept) > MOST_KEPT_NAMED else ""
        said.append(f"keeping {', '.join(kept[:MOST_KEPT_NAMED])}{more}")
    return f"{folder}/ ({', '.join(said)})" if said else f"{folder}/"


def _remove_if_empty(folders: list[Path]) -> None:
    for folder in folders:
        try:
            folder.rmdir()
        except OSError:
            return  # it is no longer empty, nor are the folders above it


def write_summary(summary: dict[str, Any], folder: Path) -> None:
    """Write ``summary.json``; infinity is the text "inf", no number is null."""
    text = json.dumps(json_ready(summary), indent=1, ensure_ascii=False, allow_nan=False)
    (folder / SUMMARY).write_text(text + "\n", encoding="utf-8")


def raise_on_all(problem: BaseException | None, comm: MPI.Comm) -> None:
    """Raise an error of rank 0, which alone writes, on all processes (collective)."""
    failed = comm.bcast(problem is not None, root=0)
    if problem is not None:
        raise problem
    if failed:
        raise FolderError("the first process could not write the result folder")


def _refused(target: str | Path, wrong: str, remedy: str) -> FolderError:
    return FolderError(wrong, target, remedy)


def _unwritable(target: str | Path, error: OSError) -> FolderError:
    return _refused(target, f"it cannot be written ({error.strerror or error})", "Name another folder")
