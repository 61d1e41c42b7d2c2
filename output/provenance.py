"""Provenance of the numbers of a summary: status, size, seconds, versions and memory."""

from __future__ import annotations

import platform
import re
import resource
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.metadata import PackageNotFoundError, distribution
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

from hydroelastic.output.quantities import Group, Quantity
from hydroelastic.output.reading import Reading

if TYPE_CHECKING:
    from mpi4py import MPI


def _all_processes() -> MPI.Comm:
    # Importing MPI initializes it: only what solves needs it.
    from mpi4py import MPI

    return MPI.COMM_WORLD


OF_ALL_SCENES = Group(
    "",
    "in all summaries",
    (
        SCENE := Quantity("scene", "the scene as read, with its defaults and overrides", variable=""),
        STATUS := Quantity("status", '`"ok"` or `"unconverged"`', variable=""),
        Quantity("scene_file", "scene file relative to the folder", note='`""` without one', variable=""),
        Quantity("files", "files that the run wrote there", dimensions=("file",), variable=""),
        REASONS := Quantity("reasons", "reasons why the tolerance is not reached", dimensions=("reason",)),
        WARNINGS := Quantity("warnings", "what the model leaves out and these results show", dimensions=("warning",)),
        SECONDS := Quantity("seconds", "wall-clock time of the whole", "s", contract=False),
        MEMORY_PEAK := Quantity("memory_peak", "largest memory of all processes together", "byte", contract=False),
        VERSIONS := Quantity("versions", "version of a package", dimensions=("package",), contract=False),
    ),
)
"""Quantities that `summarize` adds."""

PROCESSES = Quantity("processes", "number of processes", "1", value=lambda _: _all_processes().size)
"""A part of the size of all problems."""

Summary: TypeAlias = dict[str, Any]
"""Content of ``summary.json``."""

PACKAGES = ("hydroelastic", "fenics-dolfinx", "petsc4py", "slepc4py", "gmsh", "numpy", "scipy", "xarray")


@cache
def versions() -> dict[str, str]:
    """Return the versions of the packages behind a solution."""
    found = {"python": platform.python_version()}
    for package in PACKAGES:
        try:
            found[package] = _version(package)
        except PackageNotFoundError:
            found[package] = "unknown"
    return found


def _version(package: str) -> str:
    """Version of an installed package, of whose metadata nothing else is parsed: that would take ten times as long."""
    files = distribution(package)
    text = next(filter(None, map(files.read_text, ("METADATA", "PKG-INFO", ""))), "")
    found = re.search(r"^Version: *(\S+)", text, re.MULTILINE)
    return found[1] if found else "unknown"


def memory_of_processes(comm: MPI.Comm) -> int:
    """Return the sum of the peak resident memory of all processes, bytes (collective)."""
    return int(comm.allreduce(memory_of_process()))


def largest_memory() -> int:
    """Return the largest peak resident memory of all processes, bytes (collective)."""
    return max(_all_processes().allgather(memory_of_process()))


def memory_of_process() -> int:
    """Return the peak resident memory of this process, bytes."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def read_summary(summary: Summary, kind: Group = OF_ALL_SCENES) -> Reading:
    """Return a summary as it is read, by what is declared of its kind of scene and of all."""
    parts = OF_ALL_SCENES.parts if kind is OF_ALL_SCENES else (*OF_ALL_SCENES.parts, *kind.parts)
    return Reading(Group("", kind.meaning, parts), summary)


def warnings_of(summary: Summary) -> tuple[str, ...]:
    """Return the warnings of a summary; results of earlier versions have none."""
    told = read_summary(summary)
    return tuple(told[WARNINGS]) if WARNINGS in told else ()


def spent(summary: Reading, memory: str = "") -> str:
    """Return seconds and memory, the end of the line on the cost of a solution."""
    return f"; seconds: {summary[SECONDS]:.2f}; peak memory {summary[MEMORY_PEAK] / 2**20:.0f} MiB{memory}."


class Solved(Protocol):
    """Interface of the solution of any scene."""

    @property
    def reasons(self) -> Sequence[str]:
        """Reasons why the requested accuracy is not reached; empty if it is."""

    # A solution may have `warnings` too: sentences on what the model leaves out and its results show.


def summarize(kind: Group, solution: Solved, scene: Mapping[str, Any], seconds: float = 0.0) -> Summary:
    """Return the content of ``summary.json`` (collective: peak memory is summed over processes)."""
    return {
        SCENE.key: scene,
        STATUS.key: "unconverged" if solution.reasons else "ok",
        REASONS.key: list(solution.reasons),
        WARNINGS.key: list(getattr(solution, "warnings", ())),
        **kind.evaluated(solution),
        SECONDS.key: seconds,
        MEMORY_PEAK.key: memory_of_processes(_all_processes()),
        VERSIONS.key: versions(),
    }
