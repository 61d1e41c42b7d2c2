"""Result folders, written atomically; files that no run wrote are kept."""

from __future__ import annotations

import contextlib
import errno
import fcntl
import glob
import json
import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hydroelastic.meshes.interrupts import unfinished
from hydroelastic.output.json_values import json_ready
from hydroelastic.output.manifest import MANIFEST, Manifest, file_names, read_manifest, write_manifest

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


def check_output(path: str | Path) -> Manifest | None:
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
    return read_manifest(target)


@contextmanager
def result_folder(path: str | Path, *, scene_file: Path | None = None) -> Iterator[Path]:
    """Provide a folder to write into; when the block ends without an error it becomes ``path``, else it is removed.

    The folder is made beside ``path``, so that moving it is a renaming within one file system. Files that a previous
    run listed and that are unchanged are replaced only then. All other files in ``path`` are kept; where the
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
            write_manifest(aside, scene_file=scene_file, place=target)
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
        if any(target.iterdir()) and read_manifest(target) is None:
            raise _refused(
                target,
                f"it is not empty and not a result folder: it lacks {MANIFEST}, the list of files of a run",
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
    earlier = read_manifest(target) or Manifest(scene="", files={})
    found = file_names(target)
    _keep([name for name in found if not earlier.is_own(target, name)], target, aside)
    # Between both moves a killed process leaves the old folder under this name, and the next run takes it back.
    previous = aside.with_suffix(".previous")
    os.replace(target, previous)
    try:
        os.replace(aside, target)
    except BaseException:
        os.replace(previous, target)
        raise
    # Files created since the listing are in the old folder.
    _keep(sorted(set(file_names(previous)) - set(found)), previous, target)
    shutil.rmtree(previous, ignore_errors=True)


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
    listed = read_manifest(folder)
    kept = [] if listed is None else sorted(set(file_names(folder)) - listed.files.keys() - {MANIFEST})
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
