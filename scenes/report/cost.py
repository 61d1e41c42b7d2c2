"""The cost of a result in tables: seconds, size, memory, versions."""

from __future__ import annotations

from collections.abc import Iterator

from hydroelastic.output.provenance import Summary
from hydroelastic.output.sections import Section


def cost_sections(summary: Summary) -> Iterator[Section]:
    """Yield tables of the cost of a result; `summary` is the content of ``summary.json``."""
    timing = summary["timing"]
    rows = [(stage, f"{seconds:.3f}") for stage, seconds in timing.items()]
    yield Section(title="Seconds by stage", headings=("stage", "seconds"), rows=[*rows, _sum(timing)])
    size = [(name.replace("_", " "), _size(value)) for name, value in summary["size"].items()]
    memory = ("peak memory of all processes, MiB", f"{summary['memory_peak'] / 2**20:.0f}")
    yield Section(title="Size", headings=("quantity", "value"), rows=[*size, memory])
    yield Section(title="Versions", headings=("package", "version"), rows=list(summary["versions"].items()))


def _sum(timing: dict[str, float]) -> tuple[str, str]:
    return "sum", f"{sum(timing.values()):.3f}"


def _size(value: object) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return ", ".join(str(entry) for entry in value) or "none" if isinstance(value, list) else str(value)
