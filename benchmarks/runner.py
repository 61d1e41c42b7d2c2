"""The one runner: methods take turns, each in a process of its own; medians, errors, a table as CSV, a page, a figure.

A method is a function of what is given and of a resolution; it returns numbers, how many unknowns it had, and perhaps a
note; or a function that gives these, which is not timed. Seconds are processor time, of the processes that it starts as
well, so that other work of the machine does not enter; those by the clock stand beside them.
"""

from __future__ import annotations

import contextlib
import csv
import gc
import importlib
import io
import json
import multiprocessing
import os
import platform
import resource
import signal
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from datetime import date
from importlib.metadata import PackageNotFoundError, version
from itertools import zip_longest
from math import isnan, nan
from pathlib import Path
from statistics import median, quantiles
from typing import Any

import numpy as np

from hydroelastic.benchmarks.peers import PeerError, cache_folder, peer_folder
from hydroelastic.benchmarks.problems import Method, Problem, Resolution

COLUMNS = ("case", "method", "resolution", "unknowns", "error", "seconds", "spread", "cold", "clock", "rounds", "note")
Row = dict[str, Any]
Report = Callable[[str], None]

_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "BLIS_NUM_THREADS", "NGS_NUM_THREADS")
_REFERENCES = Path(__file__).parent / "references.json"
_OWN_PACKAGES = ("hydroelastic", "fenics-dolfinx", "gmsh", "numpy", "scipy")
# Exact to the last digit is drawn there, and logarithms are taken.
_LEAST = 1e-16


class FailedError(RuntimeError):
    """A method did not start, failed, or its process ended; the message says how."""


def serve(connection: Any, function: str, folder: str) -> None:
    """Answer the parent's cases in a process that imports one method alone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches the whole group; the parent ends this process
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # what libraries print
    sys.path += [folder] * bool(folder)
    module, name = function.split(":")
    try:
        run = getattr(importlib.import_module(f"hydroelastic.benchmarks.{module}"), name)
        connection.send("")
        while True:
            given, chosen = connection.recv()
            gc.collect()
            start = _clocks()
            answer = run(given, **chosen)
            seconds = _clocks() - start
            answer = answer() if callable(answer) else answer
            connection.send((seconds, *answer, *[""] * (3 - len(answer))))
    except EOFError:
        pass
    except Exception as error:  # whatever a code raises is its result
        connection.send(f"{type(error).__name__}: {error}")


def _clocks() -> Any:
    """Seconds of processor time, and by the clock."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return np.array([time.process_time() + children.ru_utime + children.ru_stime, time.perf_counter()])


class _Worker:
    def __init__(self, method: Method, folder: str) -> None:
        context = multiprocessing.get_context("spawn")
        self.connection, other = context.Pipe()
        self.process = context.Process(target=serve, args=(other, method.function, folder), daemon=True)
        self.process.start()
        other.close()
        self.receive()

    def receive(self) -> Any:
        try:
            message = self.connection.recv()
        except EOFError:
            self.process.join(5.0)
            raise FailedError(f"its process ended with code {self.process.exitcode}") from None
        if isinstance(message, str) and message:
            raise FailedError(message)
        return message

    def solve(self, given: Any, chosen: Resolution) -> Any:
        self.connection.send((given, chosen))
        return self.receive()


def measure(problem: Problem, name: str, *, quick: bool, repeats: int, install: bool, report: Report) -> list[Row]:
    """Return a row for each case, method and resolution, and one with a note for each method that was not measured."""
    os.environ |= dict.fromkeys(_THREADS, "1")
    os.environ.setdefault("CAPYTAINE_CACHE_DIR", str(cache_folder() / "capytaine"))
    workers: dict[int, _Worker] = {}
    failed: dict[int, str] = {}
    rows: list[Row] = []
    try:
        for case in list(problem.cases)[: 1 if quick and not problem.base else None]:
            queues = [_queue(problem, number, case, quick) for number in range(len(problem.methods))]
            # All methods in turn, so that a busy moment of the machine hits all of them alike.
            mixed = [one for turn in zip_longest(*queues) for one in turn if one is not None]
            found: dict[int, list[Any]] = {place: [] for place in range(len(mixed))}
            for turn in range(repeats + 1):
                first = turn * len(mixed) // (repeats + 1)
                for place in (*range(first, len(mixed)), *range(first)):
                    number, chosen = mixed[place]
                    method = problem.methods[number]
                    if number in failed:
                        continue
                    report(f"{case}, round {turn} of {repeats}: {method.name}, {in_words(chosen)}")
                    try:
                        if number not in workers:
                            folder = peer_folder(method.peer, install=install, report=report) if method.peer else ""
                            workers[number] = _Worker(method, folder)
                        found[place].append(workers[number].solve(problem.cases[case], chosen))
                    except (PeerError, FailedError) as error:
                        failed[number] = str(error)
                        rows.append(_row(case, method, chosen, f"not measured: {error}"))
            for place in sorted(found, key=lambda place: mixed[place][0]):
                number, chosen = mixed[place]
                if len(found[place]) == repeats + 1:
                    expected = _reference(problem.references.get(case, name), case)
                    rows.append(
                        _measured(case, problem.methods[number], chosen, found[place], expected, problem.common)
                    )
    finally:
        for worker in workers.values():
            worker.process.kill()
    return rows


def _queue(problem: Problem, number: int, case: str, quick: bool) -> list[tuple[int, Resolution]]:
    method = problem.methods[number]
    if method.cases and case not in method.cases:
        return []
    return [(number, chosen) for chosen in method.resolutions[:: 3 if quick else 1]]


def _reference(name: str, case: str) -> Any:
    exact = np.array(json.loads(_REFERENCES.read_text(encoding="utf-8")).get(name, {}).get(case, []), dtype=float)
    return exact if exact.ndim < 2 else exact[:, 0] + 1j * exact[:, 1]


def _measured(case: str, method: Method, chosen: Resolution, found: list[Any], exact: Any, common: bool) -> Row:
    cold, *warm = (seconds for seconds, *_ in found)
    _, values, unknowns, note = found[-1]
    kept = np.isfinite(exact)
    error = nan
    if len(exact):
        away = np.abs(np.asarray(values)[kept] - exact[kept])
        error = float((away / (np.abs(exact[kept]).max() if common else np.abs(exact[kept]))).max())
    processor = [float(seconds[0]) for seconds in warm]
    first, _, third = quantiles(processor, n=4, method="inclusive") if len(warm) > 1 else (0.0, 0.0, 0.0)
    told = {"unknowns": unknowns, "error": error, "seconds": median(processor), "spread": third - first}
    told |= {"cold": float(cold[0]), "clock": median(float(seconds[1]) for seconds in warm), "rounds": len(warm)}
    return _row(case, method, chosen, note) | told


def _row(case: str, method: Method, chosen: Resolution, note: str) -> Row:
    named = {"case": case, "method": method.name, "resolution": in_words(chosen), "note": note}
    return dict.fromkeys(COLUMNS, "") | {"seconds": nan, "error": nan} | named


def in_words(chosen: Resolution) -> str:
    """Return a resolution in words; ways that are off, and what is run, are left out."""
    named = {key: value for key, value in chosen.items() if value is not False and key not in ("arguments", "method")}
    return ", ".join(key.replace("_", " ") if value is True else f"{key} {value:g}" for key, value in named.items())


def seconds_at(rows: Sequence[Row], error: float) -> float:
    """Return the seconds in which an error is reached: logarithms, interpolated among those that no other surpasses."""
    front: list[tuple[float, float]] = []
    for seconds, found in sorted((row["seconds"], max(row["error"], _LEAST)) for row in rows if row["seconds"] > 0.0):
        if not isnan(found) and (not front or found < front[-1][1]):
            front.append((seconds, found))
    if not front or error * 1.01 < front[-1][1]:
        return nan
    seconds, errors = np.log(np.array(front)).T
    return float(np.exp(np.interp(-np.log(error), -errors, seconds)))


def equal_error(problem: Problem, rows: Sequence[Row]) -> str:
    """Return the table of milliseconds at equal error, and of ratios: above 1 this solver is slower."""
    own = list(dict.fromkeys(method.name for method in problem.methods if method.own and method.name != problem.base))
    peers = list(dict.fromkeys(method.name for method in problem.methods if not method.own))
    lines = []
    for case in dict.fromkeys(row["case"] for row in rows):
        for error in problem.errors:
            mine = [row for row in rows if row["case"] == case]
            found = {name: seconds_at([row for row in mine if row["method"] == name], error) for name in (*own, *peers)}
            if all(map(isnan, found.values())):
                continue
            best = min((found[name] for name in own if not isnan(found[name])), default=nan)
            ratios = [_ratio(best / found[name]) for name in peers]
            lines.append([case, f"{error:.0e}", *(_milliseconds(found[name]) for name in (*own, *peers)), *ratios])
    return table(["case", "error", *own, *peers, *(f"÷ {name}" for name in peers)], lines)


def ratios(problem: Problem, rows: Sequence[Row]) -> str:
    """Return the table of all measurements, with ratios to the base of the problem if it has one."""
    base = next((row for row in rows if row["method"] == problem.base), None)
    head = ["case", "method", "resolution", "unknowns", "error", "ms", "spread", "cold", "by the clock", "note"]
    over = ["÷ base", "÷ base, cold", "÷ base, clock"] if base else []
    lines = []
    for row in rows:
        times = [_milliseconds(row[key]) for key in ("seconds", "spread", "cold", "clock")]
        error = "—" if isnan(row["error"]) else f"{row['error']:.1e}"
        cells = [row["case"], row["method"], row["resolution"], str(row["unknowns"] or "—"), error, *times, row["note"]]
        if base:
            keys = (("seconds", "seconds"), ("cold", "seconds"), ("clock", "clock"))
            cells += [_ratio(row[mine] / base[its]) if row[mine] else "—" for mine, its in keys]
        lines.append(cells)
    return table([*head, *over], lines)


def _milliseconds(seconds: Any) -> str:
    return "—" if seconds == "" or isnan(seconds) else f"{1e3 * seconds:.1f}"


def _ratio(value: float) -> str:
    return "—" if isnan(value) else f"{value:.0f}" if value > 10.0 else f"{value:.2g}"


def table(head: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    """Return a table in Markdown."""
    return "\n".join("| " + " | ".join(cells) + " |" for cells in [head, ["---"] * len(head), *lines])


def page(problem: Problem, rows: Sequence[Row]) -> str:
    """Return the page of a problem in Markdown."""
    parts = [f"# {problem.title}", problem.told]
    if problem.cases.keys() - {"processes"}:
        parts += [f"![Error against seconds]({problem.file}.png)"] * (not problem.base)
        parts += ["## Milliseconds at equal error", equal_error(problem, rows)]
    parts += ["## All measurements", "Times are processor time on one thread, medians of warm rounds; *cold* is the"]
    parts[-1] += (
        " first one, which compiles forms and fills caches. Imports do not count, but where processes are timed."
    )
    measured = [f"- {processor()}, {platform.system()}, Python {platform.python_version()}; {date.today().isoformat()}"]
    busy = os.getloadavg()[0]
    measured += [f"- other work kept the machine busy: a load of {busy:.0f}"] * (busy > 1.5 * (os.cpu_count() or 1))
    measured += [f"- {name} {_version(name)}" for name in (*_OWN_PACKAGES, *_peers(problem))]
    return "\n\n".join([*parts, ratios(problem, rows), "## Measured on", "\n".join(measured)]) + "\n"


def _peers(problem: Problem) -> list[str]:
    return list(dict.fromkeys(method.peer for method in problem.methods if method.peer))


def _version(package: str) -> str:
    with contextlib.suppress(PackageNotFoundError, PeerError):
        folder = "" if package in _OWN_PACKAGES else peer_folder(package, install=False, report=print)
        found = importlib.metadata.distributions(name=package, path=[folder]) if folder else ()
        return next((one.version for one in found), None) or version(package)
    return "not installed"


def processor() -> str:
    """Return the model of the processor, without names of machines."""
    with contextlib.suppress(OSError):
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.machine()


def figure(problem: Problem, rows: Sequence[Row], path: Path) -> None:
    """Draw error against seconds, a panel for each case."""
    from matplotlib.figure import Figure

    cases, names = (list(dict.fromkeys(row[key] for row in rows)) for key in ("case", "method"))
    columns = min(3, len(cases))
    lines = -(-len(cases) // columns)
    drawn = Figure(figsize=(4.2 * columns, 3.6 * lines + 0.8), layout="constrained")
    panels = drawn.subplots(lines, columns, sharex=True, sharey=True, squeeze=False).ravel()
    for panel, case in zip(panels, cases, strict=False):
        for number, name in enumerate(names):
            mine = [row for row in rows if (row["case"], row["method"]) == (case, name) and row["error"] >= 0.0]
            points = sorted((row["seconds"], max(row["error"], _LEAST)) for row in mine)
            panel.loglog(*np.array(points).reshape(-1, 2).T, f"C{number}" + "os^Dv"[number % 5], label=name)
            best = [point for place, point in enumerate(points) if all(point[1] < one[1] for one in points[:place])]
            panel.loglog(*np.array(best).reshape(-1, 2).T, f"C{number}-", linewidth=1.0)
        panel.set(title=case, xlabel="processor time, s", ylabel="error")
        panel.xaxis.set_minor_formatter("")
        panel.tick_params(labelbottom=True, labelleft=True)
        panel.grid(alpha=0.3)
    for panel in panels[len(cases) :]:
        panel.set_axis_off()
    drawn.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    drawn.suptitle(problem.title)
    drawn.savefig(path, dpi=110)


def as_csv(rows: Sequence[Row]) -> str:
    """Return all rows at full precision."""
    text = io.StringIO()
    writer = csv.DictWriter(text, COLUMNS, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def read_csv(path: Path) -> Iterator[Row]:
    """Yield the rows of a file that `as_csv` wrote."""
    with path.open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            yield row | {key: float(row[key] or nan) for key in ("seconds", "error", "spread", "cold", "clock")}


def write(problem: Problem, rows: Sequence[Row], folder: Path) -> None:
    """Write table, page and figure of a problem."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{problem.file}.csv").write_text(as_csv(rows), encoding="utf-8")
    (folder / f"{problem.file}.md").write_text(page(problem, rows), encoding="utf-8")
    if not problem.base:
        figure(problem, rows, folder / f"{problem.file}.png")
