"""What the run of any scene gives."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from hydroelastic.scenes.provenance import Summary


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """What a run gave.

    Attributes:
        summary: content of ``summary.json``.
        tables: the tables for a terminal.
        folder: where the results were written; ``None`` if nowhere.
        warnings: what was asked and could not be done, beside the solution.
    """

    summary: Summary
    tables: str
    folder: Path | None = None
    warnings: tuple[str, ...] = ()

    @property
    def status(self) -> str:
        """The word "ok", or "unconverged"."""
        return str(self.summary["status"])

    @property
    def reasons(self) -> tuple[str, ...]:
        """Why the solution does not keep what was asked; empty if it does."""
        return tuple(self.summary["reasons"])

    def table(self) -> str:
        """The tables for a terminal, and where the results are."""
        return self.tables if self.folder is None else f"{self.tables}\nResults written to {self.folder}/"
