"""Sweep the position of the beam of the aquarium, and keep the picture and the tables of the followed modes.

    ./hydro python results/sweeps.py

The same as ``./hydro sweep aquarium --vary body.1.start=0:6:41`` without the whole table and dataset.
"""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path

from regenerate import keep_picture

from hydroelastic.output.plots import PictureOptions
from hydroelastic.scenes.sweep.axes import grid_from_texts
from hydroelastic.scenes.sweep.result import Sweep
from hydroelastic.scenes.sweep.run import SweepOptions, solve_sweep

FOLDER = Path(__file__).parent / "sweeps" / "aquarium_position"
KEPT = ("summary.md", "summary.json", "branches.csv", "encounters.csv")


def main() -> None:
    """Solve, and keep what is small."""
    grid = grid_from_texts(["body.1.start=0:6:41"])
    found = Sweep(solved=solve_sweep("aquarium", grid, options=SweepOptions()))
    with tempfile.TemporaryDirectory() as scratch:
        whole = Path(scratch) / "sweep"
        found.save(whole, images=PictureOptions(dpi=85))
        FOLDER.mkdir(parents=True, exist_ok=True)
        for name in KEPT:
            shutil.copy(whole / name, FOLDER)
        keep_picture(whole / "sweep.png", FOLDER / "sweep.png")
    print(found)


if __name__ == "__main__":
    main()
