"""Compare the time of whole runs with that of importing the libraries on which they rest.

    ./hydro python results/start_up_shares.py [--repeats N]

Each is a process of its own, warm; they take turns, and the medians count: of the clock, and of the processor time,
user and system, which is less disturbed by other work. Writes start_up/shares.csv.
"""

from __future__ import annotations

import argparse
import csv
import resource
import subprocess
import sys
import tempfile
import time
from itertools import chain
from pathlib import Path
from statistics import median

FILE = Path(__file__).parent / "start_up" / "shares.csv"
LIBRARIES = "import dolfinx, petsc4py, slepc4py, gmsh"
RUN = ("-m", "hydroelastic.scenes", "run", "aquarium", "--quiet", "--out")


def seconds_of(*arguments: str) -> tuple[float, float]:
    """Seconds by the clock and of the processor that a Python process takes, with the processes that it starts."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run([sys.executable, *arguments], check=True, stdout=subprocess.DEVNULL)
    clock, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return clock, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


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
        taken: dict[str, list[tuple[float, float]]] = {name: [] for name in processes}
        # The first round fills the caches.
        for number in range(repeats + 1):
            for name, arguments in processes.items():
                seconds = seconds_of(*arguments)
                if number:
                    taken[name].append(seconds)
    medians = {name: [median(one) for one in zip(*seconds, strict=True)] for name, seconds in taken.items()}
    bare = next(iter(medians.values()))
    columns = ("clock_seconds", "clock_over_import", "processor_seconds", "processor_over_import")
    with FILE.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["process", *columns])
        for name, seconds in medians.items():
            both = ((f"{one:.3f}", f"{one / least:.2f}") for one, least in zip(seconds, bare, strict=True))
            writer.writerow([name, *chain.from_iterable(both)])
    print(FILE.read_text(encoding="utf-8"), end="")


if __name__ == "__main__":
    main()
