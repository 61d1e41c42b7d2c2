"""A sweep as text, for the terminal."""

from __future__ import annotations

from pathlib import Path

from hydroelastic.output.folder import results_message
from hydroelastic.output.sections import rich_table, text_console, text_of
from hydroelastic.scenes.sweep.contents import SweepContents
from hydroelastic.scenes.sweep.files import followed_lines_of_text, sweep_rows

_MOST_ROWS = 60
# Names of columns are not cut.
_WIDTH = 200


def sweep_report(sweep: SweepContents, show: tuple[str, ...], folder: Path, *, replaces: bool) -> str:
    """Return the main quantities of all points, and where the rest was written."""
    console = text_console(_WIDTH)
    solved = sweep.solved
    headings, rows = sweep_rows(sweep, show)
    console.print(solved.scene.title or "Untitled scene", markup=False)
    console.print(rich_table(headings, rows[:_MOST_ROWS]))
    if len(rows) > _MOST_ROWS:
        console.print(f"and {len(rows) - _MOST_ROWS} more points, in sweep.csv")
    for line in followed_lines_of_text(solved):
        console.print(line, markup=False)
    if solved.resumed:
        console.print(f"{solved.resumed} points were solved before, and kept in the folder.")
    return f"{text_of(console).rstrip()}\nResults written to {results_message(folder, replaces=replaces)}"
