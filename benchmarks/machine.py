"""On what was measured, without names of machines or paths."""

from __future__ import annotations

import os
import platform
from pathlib import Path


def processor() -> str:
    """Model of the processor."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        lines = []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.machine()


def cores() -> int:
    """How many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def linear_algebra() -> str:
    """The dense linear algebra that this process has loaded."""
    try:
        loaded = Path("/proc/self/maps").read_text(encoding="utf-8", errors="replace").lower()
    except OSError:
        return "unknown"
    for mark, name in (("libmkl", "MKL"), ("openblas", "OpenBLAS"), ("libblis", "BLIS"), ("libblas", "reference")):
        if mark in loaded:
            return name
    return "unknown"
