"""The cost of a result in tables: seconds, size, memory, versions."""

from __future__ import annotations

from collections.abc import Iterator

from hydroelastic.output.provenance import MEMORY_PEAK, SECONDS, VERSIONS, Summary, read_summary
from hydroelastic.output.sections import Section
from hydroelastic.scenes.report.families import size_of


def cost_sections(summary: Summary) -> Iterator[Section]:
    """Yield tables of the cost of a result; `summary` is the content of ``summary.json``."""
    told = read_summary(summary)
    size = [(name.replace("_", " "), _size(value)) for name, value in size_of(summary).values.items()]
    memory = ("peak memory of all processes, MiB", f"{told[MEMORY_PEAK] / 2**20:.0f}")
    seconds = ("seconds", f"{told[SECONDS]:.3f}")
    yield Section(title="Size and time", headings=("quantity", "value"), rows=[*size, memory, seconds])
    yield Section(title="Versions", headings=("package", "version"), rows=list(told[VERSIONS].items()))


def _size(value: object) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return ", ".join(str(entry) for entry in value) or "none" if isinstance(value, list) else str(value)
