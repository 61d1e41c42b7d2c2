"""Compare the processor time of whole runs with that of importing the libraries on which they rest.

    ./hydro python results/start_up_shares.py [--repeats N]

Each is a process of its own, warm; they take turns, and the medians count. Processor time, user and system, is less
disturbed by other work than the clock. Writes start_up/shares.csv.
"""

from __future__ import annotations

import argparse
import csv
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median

FILE = Path(__file__).parent / "start_up" / "shares.csv"
LIBRARIES = "import dolfinx, petsc4py, slepc4py, gmsh"
RUN = ("-m", "hydroelastic.scenes", "run", "aquarium", "--quiet", "--out")


def processor_seconds(*arguments: str) -> float:
    """Seconds that a Python process takes, with the processes that it starts."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, *arguments], check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    """Measure, write and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeats", type=int, default=7)
    repeats = parser.parse_args().repeats
    with tempfile.TemporaryDirectory() as scratch:
        out = str(Path(scratch) / "result")
        processes = {
            "import of dolfinx, petsc4py, slepc4py, gmsh": ("-c", LIBRARIES),
            "run aquarium --no-images": (*RUN, out, "--no-images"),
            "run aquarium": (*RUN, out),
        }
        taken: dict[str, list[float]] = {name: [] for name in processes}
        # The first round fills the caches.
        for number in range(repeats + 1):
            for name, arguments in processes.items():
                seconds = processor_seconds(*arguments)
                if number:
                    taken[name].append(seconds)
    medians = {name: median(seconds) for name, seconds in taken.items()}
    bare = next(iter(medians.values()))
    with FILE.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["process", "processor_seconds", "over_import"])
        writer.writerows((name, f"{seconds:.3f}", f"{seconds / bare:.2f}") for name, seconds in medians.items())
    print(FILE.read_text(encoding="utf-8"), end="")


if __name__ == "__main__":
    main()
