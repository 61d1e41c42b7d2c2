"""A moving line as a sequence for ParaView: a VTU file for each frame, and a PVD file with the times."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydroelastic.output.vtu import write_collection, write_vtu

Frame = tuple[float, NDArray[np.float64], dict[str, NDArray[np.float64]]]
"""Time, s; points of the line, m, shape (n, 3); data at them by name."""


def frame_numbers(frames: int, times: int) -> list[int]:
    """Return the indices of the times that are frames of a sequence, evenly spread."""
    count = min(frames, times)
    return sorted({int(place) for place in np.linspace(0, times - 1, count).round()})


def write_line(file: Path, points: NDArray[np.float64], data: dict[str, NDArray[np.float64]]) -> None:
    """Write one line as VTU."""
    count = len(points)
    cells = [("line", np.column_stack([np.arange(count - 1), np.arange(1, count)]))] if count > 1 else []
    write_vtu(file, points, cells, data)


def write_sequence(folder: Path, name: str, frames: Iterable[Frame]) -> None:
    """Write ``<name>_000000.vtu`` and so on, and ``<name>.pvd``."""
    entries = []
    for number, (time, points, data) in enumerate(frames):
        file = f"{name}_{number:06d}.vtu"
        write_line(folder / file, points, data)
        entries.append((time, 0, file))
    write_collection(folder / f"{name}.pvd", entries)
