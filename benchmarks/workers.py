"""The processes that solve, one for each code, all on one thread."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import IO, Any

from hydroelastic.benchmarks.cases import Answer, Case, Code
from hydroelastic.benchmarks.peers import cache_folder

_ONE_THREAD = dict.fromkeys(
    ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "BLIS_NUM_THREADS", "NGS_NUM_THREADS"), "1"
)
# Capytaine writes the table of its Green function there, and looks when it is imported.
_CAPYTAINE_CACHE = "CAPYTAINE_CACHE_DIR"
_SECONDS_TO_END = 2


class WorkerError(RuntimeError):
    """A code did not start, failed, or ended; the message says how."""


class Worker:
    """A running process of one code; `start_worker` makes it.

    Attributes:
        versions: what computes, by name.
    """

    def __init__(self, process: subprocess.Popen[str], said: IO[bytes]) -> None:
        """Wait until the process has imported its code."""
        self._process, self._said = process, said
        self.versions: dict[str, str] = self._receive()["versions"]

    def solve(self, case: Case) -> tuple[float, Answer]:
        """Solve a case: seconds, and the answer."""
        assert self._process.stdin is not None
        with contextlib.suppress(BrokenPipeError):  # its last words are read below
            print(json.dumps(asdict(case)), file=self._process.stdin, flush=True)
        message = self._receive()
        return message["seconds"], Answer(**message["answer"])

    def _receive(self) -> dict[str, Any]:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line:
            raise WorkerError(f"its process ended with code {self._process.wait()}: {self._last_words()}")
        message: dict[str, Any] = json.loads(line)
        if "problem" in message:
            raise WorkerError(message["problem"])
        return message

    def _last_words(self) -> str:
        self._said.seek(0)
        lines = self._said.read().decode("utf-8", errors="replace").strip().splitlines()
        return lines[-1] if lines else "without a message"


@contextlib.contextmanager
def start_worker(code: Code, folder: Path | None) -> Iterator[Worker]:
    """Start the process of a code; it ends with the block, at once if it is still solving."""
    command = [sys.executable, "-m", "hydroelastic.benchmarks.worker", code, *([str(folder)] if folder else [])]
    with (
        tempfile.TemporaryFile() as said,
        subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=said,
            text=True,
            encoding="utf-8",
            env={_CAPYTAINE_CACHE: str(cache_folder() / "capytaine")} | os.environ | _ONE_THREAD,
        ) as process,
    ):
        try:
            yield Worker(process, said)
        finally:
            _end(process)


def _end(process: subprocess.Popen[str]) -> None:
    assert process.stdin is not None
    with contextlib.suppress(BrokenPipeError):
        process.stdin.close()
    try:
        process.wait(timeout=_SECONDS_TO_END)
    except subprocess.TimeoutExpired:
        process.kill()
