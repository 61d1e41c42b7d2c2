"""The outcome of a run of any scene."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from hydroelastic.output.folder import results_message
from hydroelastic.output.provenance import REASONS, STATUS, Summary, read_summary
from hydroelastic.output.sections import Section, printed_sections


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """The outcome of a run.

    Attributes:
        solution: the solution, of a type for each kind of scene.
        summary: content of ``summary.json``.
        sections: the tables that a person reads.
        cost: a line about size and time.
        notes: whether the notes of the tables are printed.
        folder: where the results were written; ``None`` if nowhere.
        replaces: whether results of an earlier run were replaced.
        warnings: requests besides the solution that could not be fulfilled.
    """

    solution: Any
    summary: Summary
    sections: tuple[Section, ...]
    cost: str
    notes: bool = False
    folder: Path | None = None
    replaces: bool = False
    warnings: tuple[str, ...] = ()

    @property
    def status(self) -> str:
        """The word "ok", or "unconverged"."""
        return str(read_summary(self.summary)[STATUS])

    @property
    def reasons(self) -> tuple[str, ...]:
        """Reasons why the requested accuracy is not reached; empty if it is."""
        return tuple(read_summary(self.summary)[REASONS])

    @cached_property
    def tables(self) -> str:
        """The tables for a terminal."""
        return printed_sections(self.summary, self.sections, self.cost, notes=self.notes)

    def table(self) -> str:
        """The tables for a terminal, and the place of the results."""
        if self.folder is None:
            return self.tables
        return f"{self.tables}\nResults written to {results_message(self.folder, replaces=self.replaces)}"
