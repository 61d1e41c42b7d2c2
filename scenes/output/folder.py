"""Result folders that appear whole or not at all."""

from __future__ import annotations

import contextlib
import errno
import json
import os
import secrets
import shutil
import signal
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, Any

from hydroelastic.scenes.errors import Problem, SceneError
from hydroelastic.scenes.output.json_values import json_ready

if TYPE_CHECKING:
    from mpi4py import MPI

SUMMARY = "summary.json"
SUMMARY_KEYS = {"scene", "status"}
"""A folder is one of ours, and may be replaced, if its summary has these keys."""


def check_output(path: str | Path) -> None:
    """See, before any solving, that a result folder can be written; leaves nothing behind.

    Args:
        path: the folder to be written. Missing folders above it would be made. A previous result folder
            would be replaced, an empty folder filled.

    Raises:
        SceneError: if the path is a file, a foreign folder or the current one, or nothing can be written there.
    """
    try:
        target = Path(os.path.realpath(path))
        _refuse_occupied(target)
        if not target.exists():
            # A name that no file system takes: pathlib of Python 3.14 calls it missing and no more.
            with contextlib.suppress(FileNotFoundError):
                os.lstat(target)
        above = next(folder for folder in target.parents if folder.exists())
        os.rmdir(tempfile.mkdtemp(prefix=".hydroelastic.", dir=above))
    except OSError as error:
        raise _unwritable(path, error) from error


@contextmanager
def result_folder(path: str | Path) -> Iterator[Path]:
    """Give a folder to write into; when the block ends well it becomes ``path``, else it vanishes.

    The folder is made beside ``path``, so that moving it is a renaming within one file system. A previous result
    folder is replaced only then. Exceptions, Ctrl-C and the signals that end a job remove what was written.
    Under MPI only one rank may enter.

    Args:
        path: the result folder; missing folders above it are made.

    Yields:
        The folder to write into.

    Raises:
        SceneError: as `check_output`, or if writing or moving fails (a full disk).
    """
    check_output(path)
    target = Path(os.path.realpath(path))
    made = [folder for folder in target.parents if not folder.exists()]
    aside = target.parent / f".{target.name}.{secrets.token_hex(4)}.partial"
    try:
        with _ending_signals_raise():
            aside.mkdir(parents=True)
            yield aside
            _refuse_occupied(target)
            _move_in(aside, target)
    except BaseException as error:
        shutil.rmtree(aside, ignore_errors=True)
        _remove_if_empty(made)
        if isinstance(error, OSError) and _concerns(error, target.parent):
            raise _unwritable(target, error) from error
        raise


def _concerns(error: OSError, folder: Path) -> bool:
    """Whether an error comes from writing below ``folder``, and not from something else that the block did."""
    full_or_locked = error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EROFS)
    return full_or_locked or (error.filename is not None and Path(os.fsdecode(error.filename)).is_relative_to(folder))


def _refuse_occupied(target: Path) -> None:
    if target.is_dir():
        if Path.cwd().is_relative_to(target):
            raise _refused(target, "it is the current folder or above it", "Name a folder in it")
        if os.path.ismount(target):
            raise _refused(target, "it is a mount point and cannot be replaced", "Name a folder in it")
        if any(target.iterdir()) and not holds_result(target):
            raise _refused(target, "it is not empty and not a result folder", "Name another folder or empty this one")
    elif os.path.lexists(target):
        raise _refused(target, "it is not a folder", "Name another folder")
    above = next(folder for folder in target.parents if folder.exists())
    if not above.is_dir():
        raise _refused(target, f"{above} is not a folder", "Name another folder")


def holds_result(folder: Path) -> bool:
    """Return whether results of an earlier run are in a folder, which may be missing."""
    try:
        summary = json.loads((folder / SUMMARY).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return False
    return isinstance(summary, dict) and summary.keys() >= SUMMARY_KEYS


def _move_in(aside: Path, target: Path) -> None:
    """Put the finished folder in place of the previous one, which is kept until that has worked."""
    if not target.exists():
        aside.rename(target)
        return
    previous = aside.with_suffix(".previous")
    target.rename(previous)
    try:
        aside.rename(target)
    except BaseException:
        previous.rename(target)
        raise
    shutil.rmtree(previous, ignore_errors=True)


def _remove_if_empty(folders: list[Path]) -> None:
    for folder in folders:
        try:
            folder.rmdir()
        except OSError:
            return  # it holds something by now, and so do the folders above it


def write_summary(summary: dict[str, Any], folder: Path) -> None:
    """Write ``summary.json``, which makes a folder one of ours; infinity is the text "inf", no number is null."""
    text = json.dumps(json_ready(summary), indent=1, ensure_ascii=False, allow_nan=False)
    (folder / SUMMARY).write_text(text + "\n", encoding="utf-8")


def raise_on_all(problem: BaseException | None, comm: MPI.Comm) -> None:
    """Raise on all processes what went wrong on rank 0, which alone writes (collective).

    Raises:
        SceneError: on the other processes.
    """
    failed = comm.bcast(problem is not None, root=0)
    if problem is not None:
        raise problem
    if failed:
        raise SceneError(Problem(wrong="the first process could not write the result folder"))


@contextmanager
def _ending_signals_raise() -> Iterator[None]:
    """Turn the signals that end a job into `SystemExit`, so that blocks are left in order.

    Only where they would end the process at once: a handler of the caller, ``nohup`` and threads stay as they are.
    """
    replaced = []
    for number in (signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) == signal.SIG_DFL:
            try:
                signal.signal(number, _exit_with)
            except ValueError:
                break  # only the main thread may set handlers
            replaced.append(number)
    try:
        yield
    finally:
        for number in replaced:
            signal.signal(number, signal.SIG_DFL)


def _exit_with(number: int, frame: FrameType | None) -> None:
    raise SystemExit(128 + number)


def _refused(target: str | Path, wrong: str, remedy: str) -> SceneError:
    return SceneError(Problem(key=f"output folder {target}", wrong=wrong, remedy=remedy))


def _unwritable(target: str | Path, error: OSError) -> SceneError:
    return _refused(target, f"it cannot be written ({error.strerror or error})", "Name another folder with --out")
