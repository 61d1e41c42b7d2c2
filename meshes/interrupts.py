"""Handling of Ctrl-C and the signals that end a process."""

from __future__ import annotations

import os
import shutil
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import FrameType

UNFINISHED: set[Path] = set()
"""Folders that are being written, and that must not outlive the process."""

_MESSAGES = ["no result folder was written."]


def end_process(number: int, _frame: FrameType | None) -> None:
    """Handle a signal by ending the process, without unfinished folders.

    Nothing is raised: an exception in the midst of an import, or of a call back from gmsh or PETSc, would come out as a
    traceback of some other error.
    """
    for folder in UNFINISHED:
        shutil.rmtree(folder, ignore_errors=True)
    if number == signal.SIGINT:
        # The signal may have interrupted a print, which then refuses another one.
        with suppress(RuntimeError, OSError):
            print(f"Interrupted: {_MESSAGES[-1]}", file=sys.stderr, flush=True)
    os._exit(128 + number)


def end_on_interrupt() -> None:
    """Let Ctrl-C end the process by `end_process`; for programs, not for importers of this package.

    A job that a shell started with Ctrl-C ignored keeps ignoring it. A signal deferred by the launcher while Python
    started is delivered now.
    """
    if signal.getsignal(signal.SIGINT) != signal.SIG_IGN:
        signal.signal(signal.SIGINT, end_process)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})


@contextmanager
def interrupted_with(message: str) -> Iterator[None]:
    """Let `end_process` say something else of what Ctrl-C left within the block."""
    _MESSAGES.append(message)
    try:
        yield
    finally:
        _MESSAGES.pop()


@contextmanager
def unfinished(folder: Path) -> Iterator[None]:
    """Remove a folder if a signal ends the process within the block.

    Termination and hang-up are handled only where they would end the process anyhow: a handler of the caller,
    ``nohup`` and threads other than the main one stay as they are.
    """
    UNFINISHED.add(folder)
    replaced = []
    if threading.current_thread() is threading.main_thread():
        replaced = [number for number in (signal.SIGTERM, signal.SIGHUP) if signal.getsignal(number) == signal.SIG_DFL]
    for number in replaced:
        signal.signal(number, end_process)
    try:
        yield
    finally:
        for number in replaced:
            signal.signal(number, signal.SIG_DFL)
        UNFINISHED.discard(folder)


@contextmanager
def interrupts_deferred() -> Iterator[None]:
    """Defer signals whose handlers raise, such as Ctrl-C, to the end of the block.

    An exception while gmsh or PETSc calls back into Python would leave their objects inconsistent. Signals that end the
    process are not deferred.
    """
    if threading.current_thread() is not threading.main_thread():
        # Python delivers signals to its main thread only.
        yield
        return
    received: list[int] = []

    def note(number: int, _frame: FrameType | None) -> None:
        received.append(number)

    handlers = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    previous = {number: handler for number, handler in handlers.items() if callable(handler) and handler != end_process}
    for number in previous:
        signal.signal(number, note)
    try:
        yield
    finally:
        for number, handler in previous.items():
            signal.signal(number, handler)
    if received:
        signal.raise_signal(received[0])
