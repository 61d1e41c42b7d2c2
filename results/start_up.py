"""Measure what a run costs from the command to the pictures, stage by stage, with empty and with filled caches.

    ./hydro python results/start_up.py [--scene SCENE] [--repeats N]

Each run is a process of its own. A cold one begins with an empty cache, so that the renderer compiles every shader
and a scene with forms every form; a warm one repeats it with the cache that the cold one left. The caches are temporary
folders. The least of the repeats is kept, stage by stage. Writes start_up/start_up.csv and start_up/start_up.md.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).parent / "start_up"
WHAT = {
    "start": "interpreter, reading the scene, printing, exit",
    "import": "dolfinx, PETSc, SLEPc, SciPy",
    "plan": "choosing the resolution",
    "mesh": "gmsh: import, initialization, mesh",
    "pressure release": "the tone with ψ = 0 on the water: mesh, assembly, solution",
    "assemble": "matrices and factorizations",
    "solve": "eigenvalues and modes",
    "count": "inertia",
    "errors": "estimates of the errors",
    "estimates": "the older theories",
    "sample": "fields at points",
    "write": "tables and fields",
    "draw": "pictures",
}
SHOWN_LIBRARIES = 10

Seconds = dict[str, float]


def measure_run(scene: str, cache: Path, *, images: bool) -> tuple[Seconds, dict[str, Any]]:
    """Run a scene in a process of its own."""
    with tempfile.TemporaryDirectory() as scratch:
        out = Path(scratch) / "result"
        command = [sys.executable, "-m", "hydroelastic.scenes", "run", scene, "--out", str(out)]
        begin = time.perf_counter()
        subprocess.run(
            command if images else [*command, "--no-images"],
            check=True,
            stdout=subprocess.DEVNULL,
            env=_environment(cache),
        )
        total = time.perf_counter() - begin
        summary: dict[str, Any] = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    timing: Seconds = summary["timing"]
    return {"start": total - sum(timing.values()), **timing, "total": total}, summary


def measure_imports() -> Seconds:
    """Seconds that importing what `run` needs takes in each library's own files, most first."""
    program = "import hydroelastic.scenes.command_line, hydroelastic.scenes.tank.run, hydroelastic.scenes.tank.shapes"
    with tempfile.TemporaryDirectory() as cache:
        told = subprocess.run(
            [sys.executable, "-X", "importtime", "-c", program],
            check=True,
            capture_output=True,
            text=True,
            env=_environment(Path(cache)),
        ).stderr
    seconds: Counter[str] = Counter()
    for line in told.splitlines():
        microseconds, _, module = line.removeprefix("import time:").partition("|")
        if microseconds.strip().isdigit():
            library = module.rpartition("|")[2].strip().partition(".")[0]
            seconds[library] += int(microseconds) * 1e-6  # type: ignore[assignment]
    return dict(seconds)


def _environment(cache: Path) -> dict[str, str]:
    """The environment with another cache; bytecode is kept, as it is for users."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return kept | {"XDG_CACHE_HOME": str(cache)}


def least(measured: Iterable[Seconds]) -> Seconds:
    """The smallest of repeated measurements, stage by stage."""
    smallest: Seconds = {}
    for seconds in measured:
        for name, value in seconds.items():
            smallest[name] = min(value, smallest.get(name, value))
    return smallest


def measure(scene: str, repeats: int) -> tuple[list[tuple[str, float, float]], Seconds, dict[str, Any]]:
    """Repeat cold and warm runs."""
    cold, warm, bare, imports = [], [], [], []
    for number in range(1, repeats + 1):
        print(f"repeat {number} of {repeats}", flush=True)
        with tempfile.TemporaryDirectory() as cache:
            seconds, summary = measure_run(scene, Path(cache), images=True)
            cold.append(seconds)
            warm.append(measure_run(scene, Path(cache), images=True)[0])
            bare.append(measure_run(scene, Path(cache), images=False)[0])
        imports.append(measure_imports())
    cold_least, warm_least = least(cold), least(warm)
    rows = [(name, cold_least[name], warm_least[name]) for name in [*WHAT, "total"] if name in warm_least]
    # Without pictures nothing else changes but the time of drawing.
    without = cold_least["total"] - cold_least["draw"]
    return [*rows, ("total without images", without, least(bare)["total"])], least(imports), summary


def write(
    rows: list[tuple[str, float, float]], imports: Seconds, summary: dict[str, Any], scene: str, repeats: int
) -> str:
    """Write the tables; gives the readable one."""
    FOLDER.mkdir(exist_ok=True)
    with open(FOLDER / "start_up.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["stage", "cold_seconds", "warm_seconds"])
        writer.writerows((name, f"{cold:.3f}", f"{warm:.3f}") for name, cold, warm in rows)
        largest = sorted(imports.items(), key=lambda item: -item[1])
        writer.writerows((f"import of {name}", "", f"{value:.3f}") for name, value in largest[:SHOWN_LIBRARIES])
    text = _readable(rows, largest, summary, scene, repeats)
    (FOLDER / "start_up.md").write_text(text, encoding="utf-8")
    return text


def _readable(
    rows: list[tuple[str, float, float]],
    imports: list[tuple[str, float]],
    summary: dict[str, Any],
    scene: str,
    repeats: int,
) -> str:
    versions = ", ".join(f"{name} {summary['versions'][name]}" for name in ("python", "fenics-dolfinx", "gmsh"))
    lines = [
        "# Start-up",
        "",
        f"`run {scene}`, {len(summary['modes']) + 1} pictures, one process; seconds, the least of {repeats} runs. "
        "Cold: nothing is compiled yet.",
        f"Written by `./hydro python results/start_up.py` with {versions}.",
        "",
        "| stage | cold | warm | what |",
        "|---|---|---|---|",
        *(f"| {name} | {cold:.2f} | {warm:.2f} | {WHAT.get(name, '')} |" for name, cold, warm in rows),
        "",
        "Imports, by library (`python -X importtime`, which itself takes some of the time):",
        "",
        "| library | seconds |",
        "|---|---|",
        *(f"| {name} | {value:.3f} |" for name, value in imports[:SHOWN_LIBRARIES]),
    ]
    return "\n".join(lines) + "\n"


def main() -> None:
    """Measure, write and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scene", default="aquarium")
    parser.add_argument("--repeats", type=int, default=3)
    asked = parser.parse_args()
    print(write(*measure(asked.scene, asked.repeats), asked.scene, asked.repeats))


if __name__ == "__main__":
    main()
